"""The engine against the generalised damper in closed form (theory 2), and what stops the robot."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from preimage.physics.engine import Engine
from preimage.physics.scene import Scene, scene
from preimage.task.examples import named_task, named_tasks
from preimage.task.parse import parse_task
from preimage.task.task import Task
from preimage.task.workspace import Side

pytest.importorskip("mujoco")

FLOORS = {"flat-floor": (0.0, 0.02), "peg-in-hole": (-9.0, 0.02)}
"""A point and a polygon a little above a floor at height 0."""


def played(task: Task, x: float, y: float) -> tuple[Scene, Engine]:
    stage = scene(task)
    engine = Engine(stage)
    engine.place(x, y)
    return stage, engine


def along_the_floor(engine: Engine, angle: float) -> tuple[float, tuple[float, float]]:
    """Speed and mean force of a steady slide, pulled down at an angle from the vertical."""
    down = angle - math.pi / 2.0
    engine.move(down, 400)
    (before, _), began = engine.position, engine.time
    engine.move(down, 1600)
    return (engine.position[0] - before) / (engine.time - began), engine.force


@pytest.mark.parametrize("name", FLOORS)
@pytest.mark.parametrize("friction", [0.0, 10.0, 35.0, 60.0])
@pytest.mark.parametrize("angle", [0.0, 8.0, 37.0, -52.0, 65.0, -80.0])
def test_slides_and_sticks_as_the_damper(name: str, friction: float, angle: float) -> None:
    phi, a = math.radians(friction), math.radians(angle)
    _, engine = played(replace(named_task(name), friction=phi), *FLOORS[name])
    speed, (fx, fy) = along_the_floor(engine, a)
    if abs(a) <= phi:
        assert abs(speed) <= 2e-3  # soft friction creeps
        assert (fx, fy) == pytest.approx((-math.sin(a), math.cos(a)), abs=2e-3)
    else:
        expected = math.copysign(math.sin(abs(a) - phi) / math.cos(phi), a)
        assert speed == pytest.approx(expected, abs=3e-3)
        size = math.cos(a) / math.cos(phi)
        reaction = math.pi / 2.0 + math.copysign(phi, a)
        assert fx == pytest.approx(size * math.cos(reaction), abs=0.02)
        assert fy == pytest.approx(size * math.sin(reaction), abs=0.02)


def test_free_flight_is_at_the_commanded_velocity() -> None:
    stage, engine = played(named_task("figure-16"), 0.0, 0.0)
    engine.move(0.7, 2000)
    settling = stage.plant.settling * stage.length
    x, y = engine.position
    assert math.atan2(y, x) == pytest.approx(0.7)
    assert math.hypot(x, y) == pytest.approx(engine.time - settling, rel=1e-3)
    assert engine.force == (0.0, 0.0)


@pytest.mark.parametrize("name", named_tasks())
def test_every_named_task_becomes_a_scene(name: str) -> None:
    stage, engine = played(named_task(name), 0.0, 0.0)
    assert engine.model.nv == 2
    assert engine.time == 0.0
    assert stage.mjcf.startswith("<mujoco")


@pytest.mark.parametrize("side", [Side.LEFT, Side.RIGHT, Side.TOP])
@pytest.mark.parametrize("name", ["figure-16", "peg-in-hole"])
def test_walls_stop_the_reference_point_and_open_sides_do_not(name: str, side: Side) -> None:
    task = named_task(name)
    xmin, ymin, xmax, ymax = task.workspace.window.bounds
    start = 6.0 if name == "peg-in-hole" else (xmin + xmax) / 2.0, 0.5 * (ymin + ymax) + 1.0
    ways = {Side.LEFT: (math.pi, xmin), Side.RIGHT: (0.0, xmax), Side.TOP: (math.pi / 2.0, ymax)}
    way, bound = ways[side]
    for walls in (frozenset(), frozenset({side})):
        walled = replace(task, workspace=replace(task.workspace, walls=walls))
        stage, engine = played(walled, *start)
        for _ in range(400):
            engine.move(way, 50)
            if engine.time > 2.0 * max(xmax - xmin, ymax - ymin):
                break
        place = engine.position[0 if way in (0.0, math.pi) else 1]
        beyond = place - bound if way != math.pi else bound - place
        if walls:
            assert abs(beyond) <= 0.01 * stage.length
            assert math.hypot(*engine.force) == pytest.approx(1.0, abs=1e-3)
        else:
            assert beyond > stage.length


@pytest.mark.parametrize("start", np.linspace(-0.9, 0.9, 5))
def test_a_point_stops_on_faces_and_in_corners(start: float) -> None:
    stage, engine = played(named_task("peg-in-hole-point"), start, 1.0)
    engine.move(-math.pi / 2.0, 4000)
    assert engine.position == pytest.approx((start, -3.0), abs=0.01 * stage.length)
    engine.move(-math.pi / 4.0, 12000)
    assert engine.position == pytest.approx((1.0, -3.0), abs=0.01 * stage.length)
    assert engine.depth <= 0.01 * stage.length


def test_the_unit_of_length_does_not_matter() -> None:
    def text(factor: float) -> str:
        def scaled(*numbers: float) -> list[float]:
            return [factor * number for number in numbers]

        data = {
            "version": 1,
            "name": "scaled",
            "window": scaled(-8, -8, 8, 8),
            "walls": ["left"],
            "obstacles": [{"polygon": [scaled(0, 0), scaled(3, 1), scaled(1, 1), scaled(1, 4)]}],
            "robot": {"polygon": [scaled(0, 0), scaled(1, 0), scaled(0, 2)], "reference": [0, 0]},
            "uncertainty": {"control": 5, "position": 0.25 * factor},
            "initial": {"point": scaled(-4, -4)},
            "goal": {"polygons": [[scaled(4, 4), scaled(5, 4), scaled(5, 5)]]},
        }
        return scene(parse_task(data, name="scaled")).mjcf

    assert text(1024.0) == text(1.0)
