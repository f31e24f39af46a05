"""Monotonicity, and what the combined method contains (theory 8)."""

import math
from collections.abc import Iterator
from dataclasses import replace
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import box

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, union
from preimage.geometry.area import Area
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.reachability.backprojection import backproject
from preimage.recognition.kernel import kernel
from preimage.task.options import Method
from preimage.task.task import SlidingLaw
from preimage.task.uncertainty import Uncertainty
from tests.laws.similarity import within
from tests.laws.tasks import random_setting
from tests.strategies import Scene, random_target, space_of

SLACK = 1e-5
Case = tuple[str, Region, Region, float]
"""A law's name, what should lie in what, and up to which thickness."""


def changed(setting: Setting, **bounds: Any) -> Setting:
    senses = replace(setting.uncertainty, **bounds)
    return Setting(setting.space, senses, setting.friction, setting.sliding, setting.arc_tolerance)


def kernel_of(setting: Setting, target: Region, direction: float) -> Region:
    sets = setting.command(direction).readings
    return kernel(setting.space, sets, target, setting.uncertainty)


def arcs(setting: Setting) -> float:
    """How far arcs may be off: their tangents turn with the cone, and come and go with corners."""
    rho = setting.uncertainty.position
    return SLACK + (2.0 * rho * setting.arc_tolerance if math.isfinite(rho) else 0.0)


def backprojections(setting: Setting, scene: Scene, more: Region, rng: Random) -> Iterator[Case]:
    def back(setting: Setting, target: Region) -> Region:
        sources = setting.command(scene.direction).sources
        return backproject(scene.space, target, sources).region

    found = back(setting, scene.target)
    yield "B holds its target", scene.target, found, SLACK
    yield "B grows with the target", found, back(setting, more), SLACK
    theta = setting.uncertainty.control
    for wider in (theta + 1e-9, theta + rng.uniform(0.0, 1.0) * (1.5 - theta)):
        less = back(changed(setting, control=wider), scene.target)
        yield "B shrinks with theta", less, found, SLACK


def kernels(setting: Setting, scene: Scene, more: Region, rng: Random) -> Iterator[Case]:
    def core(setting: Setting, target: Region = scene.target) -> Region:
        return kernel_of(setting, target, scene.direction)

    senses, found = setting.uncertainty, core(setting)
    yield "a kernel lies in its target", found, scene.target, SLACK
    yield "kernels grow with the target", found, core(setting, more), arcs(setting)
    worse: dict[str, Setting] = {}
    theta = senses.control + rng.uniform(0.0, 1.0) * (1.5 - senses.control)
    worse["theta"] = changed(setting, control=theta)
    if math.isfinite(senses.position):
        for rho in (senses.position + 0.01, 2.0 * senses.position + 0.01, math.inf):
            worse[f"rho {rho}"] = changed(setting, position=rho)
    low, high = senses.force_thresholds
    if math.isfinite(low):
        turn = senses.force_angle
        worse["eps"] = changed(setting, force_angle=turn + rng.random() * (3.1 - turn))
        worse["w2"] = changed(setting, force_thresholds=(low, high + rng.choice((0.01, 0.3, 2))))
        worse["w1"] = changed(setting, force_thresholds=(low * rng.choice((0.0, 0.5)), high))
    for name, other in worse.items():
        yield f"kernels shrink as {name} gets worse", core(other), found, arcs(setting)


def preimages(setting: Setting, scene: Scene, more: Region, rng: Random) -> Iterator[Case]:
    senses = setting.uncertainty
    theta = senses.control + rng.uniform(0.0, 1.0) * (1.5 - senses.control)
    combined = preimage(setting, scene.target, scene.direction, Method.COMBINED).region
    for method in Method:

        def found(
            setting: Setting, target: Region = scene.target, method: Method = method
        ) -> Region:
            return preimage(setting, target, scene.direction, method).region

        made = found(setting)
        yield f"combined contains {method.value}", made, combined, SLACK
        yield f"{method.value} grows with the goal", made, found(setting, more), 2.0 * arcs(setting)
        if math.isfinite(senses.position):
            other = changed(setting, position=2.0 * senses.position + 0.01)
            yield f"{method.value} shrinks with rho", found(other), made, 2.0 * arcs(setting)
        other = changed(setting, control=theta)
        yield f"{method.value} shrinks with theta", found(other), made, 2.0 * arcs(setting)


LAWS = (backprojections, kernels, preimages)


def check(rng: Random) -> None:
    setting, scene = random_setting(rng)
    extra = random_target(rng, scene.space, scene.direction, rng.random() < 0.5)
    more = union(scene.target, extra, scene.space.tolerance)
    for law in LAWS:
        for name, small, large, slack in law(setting, scene, more, rng):
            assert within(small, large, slack), name


@pytest.mark.parametrize("first", range(0, 120, 30))
def test_random_scenes(first: int) -> None:
    for seed in range(first, first + 30):
        try:
            check(Random(seed))
        except AssertionError as error:
            error.add_note(f"seed {seed}")
            raise


@pytest.mark.slow
@pytest.mark.parametrize("first", range(40_000, 42_000, 100))
def test_random_scenes_at_length(first: int) -> None:
    for seed in range(first, first + 100):
        try:
            check(Random(seed))
        except AssertionError as error:
            error.add_note(f"seed {seed}")
            raise


@given(st.randoms(use_true_random=False))
@settings(max_examples=30)
def test_drawn_scenes(rng: Random) -> None:
    check(rng)


def test_a_larger_threshold_can_help() -> None:
    """What reads 0 cannot be mistaken for a floor (theory 8): a wall that is pressed lightly."""
    space = space_of([box(-6, -6, 6, 0), box(2, 0, 6, 6)])
    floor = int(np.flatnonzero(np.isclose(space.contact.normal, 0.5 * math.pi))[0])
    wall = int(np.flatnonzero(np.isclose(space.contact.normal, math.pi))[0])
    corner = max(floor, wall, key=lambda i: (space.contact.points[i] == (2.0, 0.0)).all())
    contact = ContactSet.of([floor], [0.0], [float(space.contact.length[floor])], [corner], 1e-9)
    goal = Region(Area.empty(), contact)
    lengths = []
    for threshold in (0.05, 0.6):
        senses = Uncertainty(0.0, 0.5, math.radians(46), (threshold, threshold))
        setting = Setting(space, senses, 0.0, SlidingLaw.PROJECTION, 0.005)
        lengths.append(kernel_of(setting, goal, math.radians(290)).contact.total_length)
    assert lengths == pytest.approx([8.0 - 1.0, 8.0])
