"""Runs begin in the start of the task."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from preimage.configuration.location import edges_at
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.start import start_region
from preimage.physics.starts import draw_start
from preimage.task.examples import named_task
from preimage.task.initial import Everywhere, Initial, InitialDisc, InitialEdges, InitialPoint

TASK = named_task("peg-in-hole-point")


@pytest.mark.parametrize(
    "initial",
    [
        InitialPoint((-4.0, 2.5)),
        InitialPoint((-4.0, 0.0)),
        InitialDisc((-4.0, 2.5), 0.5),
        InitialDisc((-4.0, 0.0), 0.5),
        InitialEdges((((-5.0, 0.0), (-3.0, 0.0)),)),
        Everywhere(),
    ],
)
def test_a_start_is_drawn_from_the_start(initial: Initial) -> None:
    task = replace(TASK, initial=initial)
    space = configuration_space(task)
    start = start_region(task, space)
    generator = np.random.default_rng(3)
    near = space.tolerance.length
    for _ in range(50):
        x, y = draw_start(start, space, generator)
        assert space.free.contains(x, y) or space.free.distance(x, y) <= near
        if isinstance(initial, InitialDisc):
            assert np.hypot(x - initial.center[0], y - initial.center[1]) <= 1.01 * initial.radius
        if isinstance(initial, InitialEdges):
            assert len(edges_at(space.contact, (x, y), near)[0])
            assert -5.0 <= x <= -3.0
        if isinstance(initial, InitialPoint):
            assert (x, y) == initial.point
