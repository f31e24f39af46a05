"""Sensors, settings and whole tasks at random, for the laws of theory 8."""

from __future__ import annotations

import math
from dataclasses import replace
from random import Random

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from preimage.configuration.obstacles import configuration_space
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import TaskError
from preimage.preimages.setting import Setting
from preimage.task.initial import Initial
from preimage.task.options import Method, PlannerOptions, SearchOrder, uniform_directions
from preimage.task.robot import Robot
from preimage.task.task import Everywhere, Goal, InitialPoint, InitialPolygon, SlidingLaw, Task
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import PolygonObstacle, Side, Window, Workspace
from tests.strategies import CONTROLS, FRICTIONS, HALF, SHAPES, Scene, random_scene

Point = tuple[float, float]
Ring = tuple[Point, ...]

POSITIONS = (0.0, 0.01, 0.05, 0.1, 0.3, 0.5, 1.0, math.inf)
FORCE_ANGLES = tuple(math.radians(angle) for angle in (0, 0, 5, 10, 30, 90, 179))
THRESHOLDS = (
    (0.0, 0.0), (0.05, 0.05), (0.05, 0.05), (0.3, 0.3), (0.1, 0.5), (0.0, 1.0), (1.0, 1.0),
    (math.inf, math.inf),
)  # fmt: skip
ROBOTS: tuple[Ring, ...] = (
    ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)),
    ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)),
    ((-0.5, 0.0), (0.5, 0.0), (0.5, 1.0), (0.25, 1.0), (0.25, 0.25), (-0.5, 0.25)),
)
SHORTEST = 1e-3
CLEARANCE = 0.01


def random_senses(rng: Random, control: float) -> Uncertainty:
    """Any sensors: exact, coarse, with one threshold or two, or none at all."""
    position, turn = rng.choice(POSITIONS), rng.choice(FORCE_ANGLES)
    thresholds = rng.choice(THRESHOLDS)
    return Uncertainty(control, position, turn if math.isfinite(thresholds[0]) else 0.0, thresholds)


def random_setting(rng: Random) -> tuple[Setting, Scene]:
    """A scene, and all bounds on errors."""
    scene = random_scene(rng)
    senses = random_senses(rng, scene.control)
    return Setting(scene.space, senses, scene.friction, rng.choice(list(SlidingLaw)), 0.005), scene


def random_task(rng: Random) -> Task:
    """A small task that may have a plan: the goal is in contact, or about a contact edge."""
    while True:
        lattice = rng.random() < 0.6
        task = _without_ends(rng, lattice)
        try:
            space = configuration_space(task)
        except TaskError:
            continue
        if not len(space.contact.edges) or space.contact.length.min() < SHORTEST:
            continue
        return replace(task, goal=_goal(rng, space, lattice), initial=_initial(rng, space, lattice))


def _without_ends(rng: Random, lattice: bool) -> Task:
    """A task whose goal and start do not matter yet."""
    shapes = [rng.choice(SHAPES)(rng, lattice) for _ in range(rng.randint(1, 5))]
    obstacles = tuple(
        PolygonObstacle(_ring(part.exterior), tuple(_ring(hole) for hole in part.interiors))
        for shape in shapes
        for part in shapely.get_parts(shape)
    )
    control, friction = rng.choice(CONTROLS[:4]), rng.choice(FRICTIONS)
    senses = random_senses(rng, control)
    if rng.random() < 0.6:
        turn = math.radians(rng.choice((2, 10)))
        senses = Uncertainty(control, rng.choice((0.02, 0.1)), turn, (0.05, 0.05))
    elif rng.random() < 0.2:
        friction = 0.5 * math.pi
    walls = frozenset(side for side in Side if rng.random() < 0.4)
    return Task(
        workspace=Workspace(Window(-HALF, -HALF, HALF, HALF), walls, obstacles),
        robot=Robot(rng.choice(ROBOTS)) if rng.random() < 0.3 else Robot(),
        uncertainty=senses,
        friction=friction,
        sliding=rng.choice(list(SlidingLaw)),
        initial=Everywhere(),
        goal=Goal(points=((0.0, 0.0),)),
        options=PlannerOptions(
            directions=uniform_directions(rng.choice((2, 4, 4, 8))),
            method=rng.choice(list(Method)),
            max_steps=4,
            search=rng.choice(list(SearchOrder)),
            max_regions=60,
        ),
    )


def _ring(ring: BaseGeometry) -> Ring:
    return tuple(_point(point) for point in shapely.get_coordinates(ring)[:-1])


def _point(point: NDArray[np.float64]) -> Point:
    return float(point[0]), float(point[1])


def _square(x: float, y: float, half: float) -> Ring:
    return (x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)


def _any_edge(rng: Random, space: ConfigurationSpace) -> tuple[Point, Point]:
    edge = int(rng.choice(space.contact.edges.tolist()))
    return _point(space.contact.points[edge]), _point(space.contact.ends[edge])


def _goal(rng: Random, space: ConfigurationSpace, lattice: bool) -> Goal:
    (ax, ay), (bx, by) = edge = _any_edge(rng, space)
    kind = rng.choice(("edge", "edge", "part", "point", "polygon", "two"))
    if kind == "part":
        low, high = sorted(rng.choice((0.0, 0.25, 0.5, 1.0)) if lattice else rng.random()
                           for _ in range(2))  # fmt: skip
        if high - low > 0.1:
            begin = ax + low * (bx - ax), ay + low * (by - ay)
            return Goal(edges=((begin, (ax + high * (bx - ax), ay + high * (by - ay))),))
    if kind == "point":
        vertex = int(rng.choice(space.contact.vertices.tolist()))
        return Goal(points=(_point(space.contact.points[vertex]),))
    if kind == "polygon":
        middle = 0.5 * (ax + bx), 0.5 * (ay + by)
        return Goal(polygons=(_square(*middle, rng.choice((1.0, 2.0, 3.0))),))
    if kind == "two":
        return Goal(edges=(edge, _any_edge(rng, space)))
    return Goal(edges=(edge,))


def _initial(rng: Random, space: ConfigurationSpace, lattice: bool) -> Initial:
    contact = space.contact
    kind = rng.choice(("free", "free", "free", "edge", "vertex", "area", "everywhere"))
    if kind == "edge":
        (ax, ay), (bx, by) = _any_edge(rng, space)
        return InitialPoint((0.5 * (ax + bx), 0.5 * (ay + by)))
    beside = contact.open | contact.open[contact.previous]
    corners = contact.vertices[~beside[contact.vertices]]
    if kind == "vertex" and len(corners):
        return InitialPoint(_point(contact.points[int(rng.choice(corners.tolist()))]))
    if kind != "everywhere":
        roomy = space.free.geometry.buffer(-CLEARANCE)
        reach = int(HALF) - 1
        for _ in range(100):
            x, y = rng.uniform(-reach, reach), rng.uniform(-reach, reach)
            if lattice and rng.random() < 0.5:
                x, y = float(rng.randint(-reach, reach)), float(rng.randint(-reach, reach))
            if roomy.intersects(shapely.Point(x, y)):
                if kind == "area":
                    return InitialPolygon(_square(x, y, rng.choice((0.1, 0.5))))
                return InitialPoint((x, y))
    return Everywhere()
