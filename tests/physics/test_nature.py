"""Nature keeps within the bounds of the task."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from preimage.geometry.angles import wrap
from preimage.physics.nature import Nature, Sensing, Steering
from preimage.physics.plant import Plant, length_of
from preimage.physics.trials import NATURES
from preimage.task.examples import named_task
from preimage.task.task import Task

TASK = named_task("peg-in-hole-point")


def nature(
    task: Task, steering: Steering, sensing: Sensing, reserve: float = 0.0, seed: int = 1
) -> Nature:
    generator = np.random.default_rng(seed)
    return Nature(task, Plant(reserve=reserve), steering, sensing, generator)


@pytest.mark.parametrize(("steering", "sensing"), NATURES)
@pytest.mark.parametrize("reserve", [0.0, 0.1])
def test_errors_are_within_their_bounds(
    steering: Steering, sensing: Sensing, reserve: float
) -> None:
    bounds = TASK.uncertainty
    within = (1.0 - reserve) * (1.0 + 1e-12)
    for seed in range(5):
        drawn = nature(TASK, steering, sensing, reserve, seed)
        for time in np.linspace(0.0, 20.0, 300).tolist():
            assert abs(drawn.deviation(time)) <= bounds.control
            x, y = drawn.position((1.0, 2.0))
            assert math.hypot(x - 1.0, y - 2.0) <= within * bounds.position
            read = drawn.force((0.0, 1.0))
            assert read is not None
            assert abs(wrap(read - math.pi / 2.0)) <= within * bounds.force_angle


@pytest.mark.parametrize("steering", Steering)
def test_an_offset_stays(steering: Steering) -> None:
    drawn = nature(TASK, steering, Sensing.OFFSET)
    assert len({drawn.position((0.0, 0.0)) for _ in range(10)}) == 1
    assert len({drawn.force((0.0, 1.0)) for _ in range(10)}) == 1
    off = math.hypot(*drawn.position((0.0, 0.0)))
    assert off == pytest.approx(TASK.uncertainty.position)


def test_independent_errors_differ() -> None:
    drawn = nature(TASK, Steering.STEADY, Sensing.INDEPENDENT)
    assert len({drawn.position((0.0, 0.0)) for _ in range(10)}) == 10


def test_steering() -> None:
    times = np.linspace(0.0, 100.0, 500).tolist()
    steady = nature(TASK, Steering.STEADY, Sensing.OFFSET)
    assert len({steady.deviation(time) for time in times}) == 1
    extreme = nature(TASK, Steering.EXTREME, Sensing.OFFSET)
    ends = [extreme.deviation(time) for time in times]
    assert set(ends) == {TASK.uncertainty.control, -TASK.uncertainty.control}
    wandering = nature(TASK, Steering.WANDERING, Sensing.OFFSET)
    changes = [a != b for a, b in pairwise(wandering.deviation(time) for time in times)]
    assert 20 < sum(changes) < 400


def test_weak_forces_read_zero() -> None:
    low, _ = TASK.uncertainty.force_thresholds
    drawn = nature(TASK, Steering.STEADY, Sensing.INDEPENDENT)
    assert drawn.force((0.0, low)) is None
    assert drawn.force((0.0, 1.01 * low)) is not None


def test_between_two_thresholds_either_is_read() -> None:
    uncertainty = replace(TASK.uncertainty, force_thresholds=(0.1, 0.5))
    drawn = nature(replace(TASK, uncertainty=uncertainty), Steering.STEADY, Sensing.OFFSET)
    readings = {drawn.force((0.3, 0.0)) is None for _ in range(50)}
    assert readings == {True, False}


def test_who_has_no_sensors_reads_nothing() -> None:
    task = named_task("blind-corner")
    drawn = nature(task, Steering.STEADY, Sensing.OFFSET)
    assert all(math.isnan(value) for value in drawn.position((0.0, 0.0)))
    assert drawn.force((5.0, 5.0)) is None


def test_the_length_of_a_task() -> None:
    assert length_of(TASK) == TASK.uncertainty.position
    blind = named_task("blind-corner").workspace.window
    assert length_of(named_task("blind-corner")) == (blind.xmax - blind.xmin) / 50.0
    exact = replace(TASK, uncertainty=replace(TASK.uncertainty, position=0.0))
    assert length_of(exact) == pytest.approx(0.02)
    vague = replace(TASK, uncertainty=replace(TASK.uncertainty, position=100.0))
    assert length_of(vague) == pytest.approx(1.0)
