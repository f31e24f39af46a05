"""Scenes against configuration space: the engine stops the robot where contact space is.

For polygons that is a test of the C-obstacles too: the engine knows the workspace only.
"""

from __future__ import annotations

import math
from random import Random
from typing import Any

import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

from preimage.errors import TaskError
from preimage.physics.engine import Engine
from preimage.physics.scene import scene
from preimage.task.examples import named_task
from preimage.task.parse import parse_task
from preimage.task.task import Task

pytest.importorskip("mujoco")

NEAR = 0.05
"""So far into an obstacle, or off it, in lengths, is at it."""


def star(rng: Random, x: float, y: float, low: float, high: float) -> list[list[float]]:
    """A polygon around a point, seldom convex."""
    count = rng.randint(3, 7)
    turn = rng.uniform(0.0, math.tau)
    return [
        [x + far * math.cos(angle), y + far * math.sin(angle)]
        for far, angle in (
            (rng.uniform(low, high), turn + math.tau * corner / count) for corner in range(count)
        )
    ]


def random_task(rng: Random) -> Task:
    data: dict[str, Any] = {
        "version": 1,
        "window": [-8, -8, 8, 8],
        "walls": ["left", "right", "bottom", "top"],
        "obstacles": [
            {"polygon": star(rng, rng.uniform(-6, 6), rng.uniform(-6, 6), 0.8, 3.0)}
            for _ in range(rng.randint(1, 4))
        ],
        "uncertainty": {"control": 5, "position": 0.3},
        "friction": rng.choice([0, 20, 50]),
        "initial": "everywhere",
        "goal": {"polygons": [[[-8, -8], [8, -8], [8, 8], [-8, 8]]]},
    }
    if rng.random() < 0.6:
        data["robot"] = {"polygon": star(rng, 0.0, 0.0, 0.3, 1.2), "reference": [0, 0]}
    return parse_task(data, name="random")


def pushed_about(task: Task, rng: Random, pushes: int) -> None:
    """Push a robot about, and compare where it stops with contact space."""
    stage = scene(task)
    engine, free, near = Engine(stage), stage.space.free, NEAR * stage.length
    xmin, ymin, xmax, ymax = stage.space.window
    for _ in range(pushes):
        x, y = rng.uniform(xmin, xmax), rng.uniform(ymin, ymax)
        if not free.contains(x, y) or free.depth(x, y) <= near:
            continue
        engine.place(x, y)
        for _ in range(3):
            way = rng.uniform(-math.pi, math.pi)
            for _ in range(60):
                engine.move(way, 10)
                x, y = engine.position
                if not (xmin < x < xmax and ymin < y < ymax):
                    break
                assert free.distance(x, y) <= near
                touching = math.hypot(*engine.force) > 1e-9
                if free.contains(x, y) and free.depth(x, y) > 2.0 * near:
                    assert not touching


@settings(max_examples=25)
@given(st.randoms(use_true_random=False))
def test_random_scenes(rng: Random) -> None:
    try:
        task = random_task(rng)
        scene(task)
    except TaskError:
        reject()  # no free space is left, or two vertices are too near each other
    pushed_about(task, rng, 4)


@pytest.mark.parametrize(
    "name", ["connector", "cradle", "rails", "l-room", "cluttered-hall", "figure-6", "comb-3"]
)
def test_named_scenes(name: str) -> None:
    pushed_about(named_task(name), Random(5), 8)
