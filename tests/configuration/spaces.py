"""Tasks for the tests of configuration space, from obstacles on a lattice or turned off it."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import strategies as st
from shapely.geometry.base import BaseGeometry

from preimage.configuration.obstacles import space_among
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area
from preimage.geometry.overlay import united
from preimage.task.robot import Robot
from preimage.task.task import Everywhere, Goal, Initial, Task
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import Obstacle, PolygonObstacle, Side, Window, Workspace

SIZE = 8
Box = tuple[float, float, float, float]
WINDOW: Box = (0.0, 0.0, float(SIZE), float(SIZE))
Point = tuple[float, float]

lattice = st.integers(0, SIZE)


@st.composite
def boxes(draw: st.DrawFn) -> BaseGeometry:
    x, y = draw(lattice), draw(lattice)
    return shapely.box(x, y, x + draw(st.integers(1, 3)), y + draw(st.integers(1, 3)))


@st.composite
def rooms(draw: st.DrawFn) -> BaseGeometry:
    x, y = draw(lattice), draw(lattice)
    wide, high = draw(st.integers(3, 5)), draw(st.integers(3, 5))
    inner = shapely.box(x + 1, y + 1, x + wide - 1, y + high - 1)
    return shapely.difference(shapely.box(x, y, x + wide, y + high), inner)


@st.composite
def hulls(draw: st.DrawFn) -> BaseGeometry:
    points = draw(st.lists(st.tuples(lattice, lattice), min_size=3, max_size=6, unique=True))
    hull = shapely.MultiPoint(points).convex_hull
    return hull if hull.area > 0.0 else draw(boxes())


@st.composite
def scattered(draw: st.DrawFn) -> BaseGeometry:
    """A polygon off the lattice, star-shaped."""
    x, y = draw(st.floats(0.0, SIZE)), draw(st.floats(0.0, SIZE))
    count = draw(st.integers(3, 8))
    reach = np.array(draw(st.lists(st.floats(0.2, 3.0), min_size=count, max_size=count)))
    turn = draw(st.floats(0.0, math.tau))
    angle = turn + math.tau * np.arange(count) / count
    around = np.column_stack((np.cos(angle), np.sin(angle)))
    return shapely.Polygon(np.array([x, y]) + reach[:, None] * around)


shapes = st.one_of(boxes(), boxes(), rooms(), hulls(), scattered())
lattice_shapes = st.one_of(boxes(), boxes(), rooms(), hulls())
scenes = st.lists(shapes, min_size=1, max_size=7)
lattice_scenes = st.lists(lattice_shapes, min_size=1, max_size=7)
walls = st.frozensets(st.sampled_from(list(Side)))


def union(scene: list[BaseGeometry]) -> Area:
    return united([Area(shape) for shape in scene], 2.0**-36)


def space_in(
    scene: list[BaseGeometry], sides: frozenset[Side] = frozenset(), window: Box = WINDOW
) -> ConfigurationSpace:
    """The space of a point among shapes."""
    return space_among(union(scene), window, sides)


def turned(scene: list[BaseGeometry], angle: float, scale: float = 1.0) -> list[BaseGeometry]:
    """Each shape turned by itself, so that rounding takes apart what touched."""
    about = (0.5 * SIZE, 0.5 * SIZE)
    return [
        shapely.affinity.scale(
            shapely.affinity.rotate(shape, angle, origin=about, use_radians=True),
            scale,
            scale,
            origin=about,
        )
        for shape in scene
    ]


def task_of(
    obstacles: list[Obstacle],
    window: Box = WINDOW,
    sides: frozenset[Side] = frozenset(),
    robot: Robot | None = None,
    initial: Initial | None = None,
    goal: Goal | None = None,
) -> Task:
    return Task(
        workspace=Workspace(Window(*window), sides, tuple(obstacles)),
        robot=robot or Robot(),
        uncertainty=Uncertainty(0.1, 0.1),
        initial=initial or Everywhere(),
        goal=goal or Goal(points=((0.0, 0.0),)),
    )


def box(x: float, y: float, wide: float = 1.0, high: float = 1.0) -> PolygonObstacle:
    return PolygonObstacle(((x, y), (x + wide, y), (x + wide, y + high), (x, y + high)))


def obstacle(shape: BaseGeometry) -> PolygonObstacle:
    """A shapely polygon as an obstacle."""
    return PolygonObstacle(
        tuple(shape.exterior.coords)[:-1],
        tuple(tuple(hole.coords)[:-1] for hole in shape.interiors),
    )
