"""Reading sets of one's own: by sampling nature's choices, and against the planner's."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
from shapely import Polygon

from preimage.recognition.readings import alike, readings
from preimage.task.uncertainty import Uncertainty
from preimage.verification.reading_sets import reading_sets
from tests.recognition.scenes import edge_at, space_of, vertex_at
from tests.strategies import Scene, random_scene

SAMPLES = 400


def senses(rng: Random, control: float) -> Uncertainty:
    low = rng.choice((0.0, 0.05, 0.3, math.inf))
    high = max(low, rng.choice((0.0, 0.1, 0.5)))
    error = math.radians(rng.choice((0, 5, 10, 30)))
    return Uncertainty(control, 0.3, error, (low, high))


def scene_of(seed: int) -> tuple[Scene, Uncertainty]:
    rng = Random(seed)
    scene = random_scene(rng)
    return scene, senses(rng, scene.control)


@pytest.mark.parametrize("seed", range(30))
def test_agree_with_the_planners_own(seed: int) -> None:
    scene, errors = scene_of(seed)
    contact, near = scene.space.contact, scene.space.tolerance
    own = reading_sets(contact, scene.direction, errors, scene.friction, near.angle)
    theirs = readings(contact, scene.direction, errors, scene.friction, near)
    assert np.array_equal(own.zero, theirs.zero)
    felt = own.low <= own.high
    assert np.array_equal(felt, theirs.half >= 0.0)
    half = np.minimum(0.5 * (own.high - own.low)[felt], math.pi)
    assert half == pytest.approx(theirs.half[felt], abs=1e-9)
    every = np.arange(len(own.zero))
    for feature in range(0, len(every), 5):
        assert np.array_equal(own.alike(feature), alike(theirs, feature, every))


@pytest.mark.parametrize("seed", range(20))
def test_hold_what_edges_and_notches_push_back_with(seed: int) -> None:
    """The table of theory 2, for many of nature's choices."""
    scene, errors = scene_of(seed)
    contact, friction = scene.space.contact, scene.friction
    own = reading_sets(contact, scene.direction, errors, friction, scene.space.tolerance.angle)
    count = len(contact)
    for offset in np.linspace(-errors.control, errors.control, SAMPLES):
        pressing = np.mod(scene.direction + offset - contact.normal, math.tau) - math.pi
        off = np.abs(pressing)
        slides = (off > friction) & (off <= 0.5 * math.pi)
        size = np.where(off <= friction, 1.0, np.where(slides, np.cos(off) / math.cos(friction), 0))
        angle = contact.normal + np.clip(pressing, -friction, friction)
        turn = np.mod(angle - scene.direction, math.tau) - math.pi  # from -v
        known = ~contact.open
        for edge in np.flatnonzero(known & (size > errors.force_thresholds[0])):
            for feature in (edge, count + edge, count + int(contact.next[edge])):
                low, high = own.low[feature] - 1e-9, own.high[feature] + 1e-9
                assert any(
                    low <= turn[edge] + shift <= high for shift in (-math.tau, 0.0, math.tau)
                )
        for edge in np.flatnonzero(known & (size <= errors.force_thresholds[1])):
            assert own.zero[edge]
            assert own.zero[count + edge]


def test_a_notch_reads_like_a_floor() -> None:
    """Both walls push to the sides; the corner between them pushes straight back."""
    solid = [(-10, 0), (2, 0), (3, -1), (4, 0), (10, 0), (10, -6), (-10, -6)]
    space = space_of([Polygon(solid)])
    errors = Uncertainty(math.radians(10), 0.5, math.radians(5), (0.05, 0.05))
    sets = reading_sets(
        space.contact, math.radians(270), errors, math.radians(20), space.tolerance.angle
    )
    floor, wall = edge_at(space, 0, 0), edge_at(space, 2.5, -0.5)
    bottom = len(space.contact) + vertex_at(space, 3, -1)
    assert not sets.alike(floor)[wall]
    assert sets.alike(floor)[bottom]
    assert sets.common(floor, bottom) == pytest.approx(0.0)
    assert sets.common(floor, wall) is None
