"""On which side each part of a task errs, whatever it is drawn as."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from preimage.exchange.importing import import_task
from preimage.task.initial import Everywhere, InitialDisc, InitialPoint, InitialPolygon
from preimage.task.task import Task
from preimage.task.workspace import PolygonObstacle

ELLIPSE = '<ellipse id="{}" cx="50" cy="40" rx="20" ry="8"/>'
CIRCLE = '<circle id="{}" cx="50" cy="40" r="12"/>'
LEAF = '<path id="{}" d="M 30 40 C 40 20 60 20 70 40 S 40 60 30 40 z"/>'
FLOOR = '<rect id="wall" y="90" width="100" height="10"/>'
START = '<circle id="start" cx="50" cy="80" r="0"/>'
GOAL = '<line id="goal" x1="20" y1="90" x2="30" y2="90"/>'
WINDOW = '<rect id="window" width="100" height="100"/>'


def read(folder: Path, *inside: str, **options: Any) -> Task:
    path = folder / "drawing.svg"
    path.write_text(f'<svg viewBox="0 0 100 100">{"".join(inside)}</svg>')
    return import_task(path, curves=0.5, **options).task


def border(shape: str) -> Any:
    turn = np.linspace(0, 2 * np.pi, 721)
    if shape == LEAF:
        t = np.linspace(0, 1, 500)[:, None]

        def cubic(*control: tuple[float, float]) -> Any:
            a, b, c, d = map(np.array, control)
            return (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d

        upper = cubic((30, 60), (40, 80), (60, 80), (70, 60))
        lower = cubic((70, 60), (80, 40), (40, 40), (30, 60))
        return np.concatenate((upper, lower))
    rx, ry = (20, 8) if shape == ELLIPSE else (12, 12)
    return np.stack((50 + rx * np.cos(turn), 60 + ry * np.sin(turn)), axis=1)


def holds(area: shapely.Geometry, shape: str) -> bool:
    return bool(shapely.distance(area, shapely.points(border(shape))).max() <= 1e-9)


def within(area: shapely.Geometry, shape: str) -> bool:
    spots = shapely.points(border(shape))
    inside = shapely.contains(area, spots)
    return bool(shapely.distance(area.boundary, spots[inside]).max(initial=0.0) <= 1e-9)


def close(area: shapely.Geometry, shape: str) -> bool:
    return bool(shapely.hausdorff_distance(area, shapely.Polygon(border(shape))) <= 0.55)


@pytest.mark.parametrize("shape", [ELLIPSE, CIRCLE, LEAF])
def test_obstacles_are_never_smaller(tmp_path: Path, shape: str) -> None:
    task = read(tmp_path, FLOOR, START, GOAL, WINDOW, shape.format("obstacle"))
    _, obstacle = task.workspace.obstacles
    assert isinstance(obstacle, PolygonObstacle)
    area = shapely.Polygon(obstacle.exterior)
    assert holds(area, shape)
    assert close(area, shape)
    assert not within(area, shape)


@pytest.mark.parametrize("shape", [ELLIPSE, CIRCLE, LEAF])
def test_robots_are_never_smaller(tmp_path: Path, shape: str) -> None:
    task = read(tmp_path, FLOOR, GOAL.replace("90", "82"), WINDOW, shape.format("robot"), snap=30.0)
    area = shapely.Polygon(task.robot.polygon)
    assert holds(area, shape)
    assert close(area, shape)
    assert isinstance(task.initial, InitialPoint)
    assert shapely.Point(task.initial.point).within(area)


@pytest.mark.parametrize("shape", [ELLIPSE, LEAF])
def test_starts_are_never_smaller(tmp_path: Path, shape: str) -> None:
    task = read(tmp_path, FLOOR, GOAL, WINDOW, shape.format("start"))
    assert isinstance(task.initial, InitialPolygon)
    area = shapely.Polygon(task.initial.vertices)
    assert holds(area, shape)
    assert close(area, shape)


def test_a_start_that_is_a_circle_is_a_disc(tmp_path: Path) -> None:
    task = read(tmp_path, FLOOR, GOAL, WINDOW, CIRCLE.format("start"))
    assert task.initial == InitialDisc((50.0, 60.0), 12.0)


@pytest.mark.parametrize("shape", [ELLIPSE, CIRCLE, LEAF])
def test_goals_are_never_larger(tmp_path: Path, shape: str) -> None:
    task = read(tmp_path, FLOOR, START, WINDOW, shape.format("goal"))
    (ring,) = task.goal.polygons
    area = shapely.Polygon(ring)
    assert within(area, shape)
    assert close(area, shape)
    assert not holds(area, shape)


@pytest.mark.parametrize("shape", [ELLIPSE, CIRCLE, LEAF])
def test_rooms_are_never_larger(tmp_path: Path, shape: str) -> None:
    box = '<polygon id="goal" points="48,41 52,41 52,44"/>'
    task = read(tmp_path, box, shape.format("room"), initial=Everywhere())
    (solid,) = task.workspace.obstacles
    assert isinstance(solid, PolygonObstacle)
    (hole,) = solid.holes
    assert within(shapely.Polygon(hole), shape)
    assert close(shapely.Polygon(hole), shape)


def test_a_goal_keeps_its_holes_and_a_start_fills_them(tmp_path: Path) -> None:
    ring = '<path id="{}" fill-rule="evenodd" d="M10 10h20v20h-20z M15 15h10v10h-10z"/>'
    task = read(tmp_path, FLOOR, START, WINDOW, ring.format("goal"))
    assert sum(shapely.Polygon(piece).area for piece in task.goal.polygons) == 300
    task = read(tmp_path, FLOOR, GOAL, WINDOW, ring.format("start"))
    assert isinstance(task.initial, InitialPolygon)
    assert shapely.Polygon(task.initial.vertices).area == 400
