"""Tasks as MuJoCo models: what is solid, extruded; a robot on two slides, driven by a damper."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np

from preimage.configuration.obstacles import c_obstacles, configuration_space, grown
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area, Floats
from preimage.physics.pieces import convex_pieces
from preimage.physics.plant import Plant, length_of
from preimage.task.robot import Robot
from preimage.task.task import Task
from preimage.task.workspace import Side

Box = tuple[float, float, float, float]

BALL = 0.03
"""A point robot is a ball of so many lengths at most."""

BLUNT = 0.03
"""Its obstacles' tips are blunted by so many lengths at most."""

MOST_FRICTION = 100.0
"""The largest coefficient, that of 89.4 degrees: for an engine friction is finite."""

FLAT = 1e-4
"""Pieces thinner than so many lengths are nothing for an engine, whose meshes are of floats."""

SOFTNESS = 4.0
"""Time constant of the contacts, in steps."""

COLOURS = {"solid": "0.42 0.47 0.53 1", "robot": "0.8 0.36 0.1 1", "ground": "0.8 0.8 0.78 1"}

HEIGHT = 1.0 / 30.0
"""Obstacles rise so far above the plane and below it, as a part of the window's larger side."""


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A task as the engine sees it. Its lengths are multiples of `length`, its times likewise.

    Parameters
    ----------
    task : what it is a scene of.
    space : the configuration space that the outcome is judged in.
    plant : the robot as a physical thing.
    length : what the engine calls 1.
    mjcf : the model, to be looked at in any MuJoCo viewer.
    """

    task: Task
    space: ConfigurationSpace
    plant: Plant
    length: float
    mjcf: str


def scene(task: Task, plant: Plant | None = None) -> Scene:
    """The MuJoCo model of a task.

    A point is a small ball among the C-obstacles, which are thinner by its radius: their sides
    stop its centre where they should, their tips are blunted. A polygon is itself, in the
    workspace. Both slide along x and y and do not turn. The commanded velocity pulls through
    a damper, `m dv/dt = B (v - v*)` and contact forces: with the mass gone, the generalised damper
    (theory 2), of which this is the *damper* law of sliding.

    Open sides of the window are not there; who walls them in is the task.
    """
    plant = plant or Plant()
    space = configuration_space(task)
    length = length_of(task)
    extent = max(space.window[2] - space.window[0], space.window[3] - space.window[1])
    height = HEIGHT * extent
    root = _frame(task, plant)
    asset, world = ElementTree.SubElement(root, "asset"), root.find("worldbody")
    assert world is not None
    body = _body(world)
    if task.robot.is_point:
        ball, solid = _ball(space, areas.union(space.obstacles, *_walls(task, space)), length)
        size = f"{ball / length:.9g}"
        ElementTree.SubElement(
            body, "geom", {"type": "sphere", "size": size, **_ROBOT}, name="ball"
        )
        _prisms(asset, world, "obstacle", [solid], length, (-height, height), _SOLID)
    else:
        shape = np.asarray(task.robot.shape, dtype=np.float64)
        solids = [_workspace(task, space, shape), *_walls(task, space, shape)]
        _prisms(asset, world, "obstacle", solids, length, (-height, height), _SOLID)
        middle = (-0.5 * height, 1.5 * height)
        _prisms(asset, body, "robot", [Area.polygon(shape)], length, middle, _ROBOT)
    for name, colour in COLOURS.items():
        ElementTree.SubElement(asset, "material", name=name, rgba=colour, specular="0.1")
    actuator = ElementTree.SubElement(root, "actuator")
    for axis in ("x", "y"):
        damping = f"{1.0 / plant.settling:.9g}"
        ElementTree.SubElement(actuator, "velocity", name=axis, joint=axis, kv=damping)
    _onlooker(world, space, length)
    ElementTree.indent(root)
    return Scene(task, space, plant, length, ElementTree.tostring(root, encoding="unicode"))


# --- what is solid --------------------------------------------------------------------------


def _workspace(task: Task, space: ConfigurationSpace, shape: Floats) -> Area:
    """The workspace's obstacles, as far as the robot's polygon reaches."""
    reach = float(np.max(np.hypot(shape[:, 0], shape[:, 1])))
    box = grown(space.window, reach)
    return c_obstacles(task.workspace, Robot(), box, space.tolerance)


def _walls(task: Task, space: ConfigurationSpace, shape: Floats | None = None) -> Iterable[Area]:
    """The walled sides of the window: boxes that stop the robot where its reference point is."""
    xmin, ymin, xmax, ymax = space.window
    points = np.zeros((1, 2)) if shape is None else shape
    (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
    thick = 0.1 * max(xmax - xmin, ymax - ymin)
    inner = (xmin + left, ymin + low, xmax + right, ymax + high)
    outer = grown(inner, thick)
    boxes = {
        Side.LEFT: (outer[0], outer[1], inner[0], outer[3]),
        Side.BOTTOM: (outer[0], outer[1], outer[2], inner[1]),
        Side.RIGHT: (inner[2], outer[1], outer[2], outer[3]),
        Side.TOP: (outer[0], inner[3], outer[2], outer[3]),
    }
    return [Area.box(*box) for side, box in boxes.items() if side in task.workspace.walls]


def _ball(space: ConfigurationSpace, solid: Area, length: float) -> tuple[float, Area]:
    """A ball for a point, and what stops its centre where the solid begins.

    The ball is made smaller until nothing of the solid is further than `BLUNT` from where the
    ball is stopped: thin walls stay, and tips are blunted no more.
    """
    radius = BALL * length
    while True:
        inner = areas.shrunk(solid, radius)
        if areas.is_subset(solid, inflate.grow(inner, radius + BLUNT * length), 0.0):
            return radius, inner
        if radius < space.tolerance.length:
            return radius, solid
        radius *= 0.5


# --- the model's text -----------------------------------------------------------------------

_SOLID = {"contype": "1", "conaffinity": "0", "material": "solid"}
_ROBOT = {"contype": "0", "conaffinity": "1", "material": "robot"}


def _frame(task: Task, plant: Plant) -> ElementTree.Element:
    root = ElementTree.Element("mujoco", model=task.name)
    ElementTree.SubElement(root, "compiler", autolimits="true")
    option = ElementTree.SubElement(
        root,
        "option",
        timestep=f"{plant.step:.9g}",
        gravity="0 0 0",
        integrator="implicitfast",
        cone="elliptic",
        impratio="10",  # friction gives way ten times less than the faces do
        tolerance="1e-10",
        iterations="50",
        ccd_tolerance="1e-8",
    )
    ElementTree.SubElement(option, "flag", gravity="disable", sensor="disable")
    default = ElementTree.SubElement(root, "default")
    slide = math.tan(min(task.friction, math.atan(MOST_FRICTION)))
    ElementTree.SubElement(
        default,
        "geom",
        condim="3",
        friction=f"{slide:.9g} 0 0",  # of two geoms the larger counts: they are equal
        # Stiffer is possible, down to 2 steps, but then a sliding contact comes and goes.
        solref=f"{SOFTNESS * plant.step:.9g} 1",
        solimp="0.99 0.99 0.001",
    )
    visual = ElementTree.SubElement(root, "visual")
    ElementTree.SubElement(visual, "global", offwidth="1280", offheight="960")
    ElementTree.SubElement(visual, "headlight", ambient=".45 .45 .45", diffuse=".3 .3 .3")
    ElementTree.SubElement(root, "worldbody")
    return root


def _body(world: ElementTree.Element) -> ElementTree.Element:
    """The robot's body: of mass 1, on two slides that nothing resists."""
    body = ElementTree.SubElement(world, "body", name="robot")
    ElementTree.SubElement(body, "inertial", pos="0 0 0", mass="1", diaginertia="1 1 1")
    for axis, along in (("x", "1 0 0"), ("y", "0 1 0")):
        ElementTree.SubElement(body, "joint", name=axis, type="slide", axis=along)
    return body


def _prisms(
    asset: ElementTree.Element,
    parent: ElementTree.Element,
    name: str,
    solids: Iterable[Area],
    length: float,
    levels: tuple[float, float],
    looks: dict[str, str],
) -> None:
    """Convex prisms: a mesh each, of which the engine takes the hull."""
    number = 0
    for solid in solids:
        for piece in convex_pieces(solid):
            if _thickness(piece) < FLAT * length:
                continue
            mesh = f"{name}-{number}"
            points = [(x, y, level) for level in levels for x, y in piece]
            numbers = " ".join(f"{value / length:.9g}" for point in points for value in point)
            ElementTree.SubElement(asset, "mesh", name=mesh, vertex=numbers, inertia="shell")
            ElementTree.SubElement(
                parent, "geom", {"type": "mesh", "mesh": mesh, **looks}, name=mesh
            )
            number += 1


def _thickness(piece: Floats) -> float:
    """At most the width of a convex polygon: twice its size over half its circumference."""
    x, y = piece.T
    ahead = np.roll(piece, -1, axis=0)
    size = 0.5 * float(np.sum(x * ahead[:, 1] - y * ahead[:, 0]))
    return 4.0 * size / float(np.sum(np.hypot(*(ahead - piece).T)))


def _onlooker(world: ElementTree.Element, space: ConfigurationSpace, length: float) -> None:
    """A camera above the window, a light, and a ground to look at."""
    xmin, ymin, xmax, ymax = (bound / length for bound in space.window)
    x, y, extent = (xmin + xmax) / 2.0, (ymin + ymax) / 2.0, max(xmax - xmin, ymax - ymin)
    above = f"{x:.9g} {y:.9g} {1.3 * extent:.9g}"
    ElementTree.SubElement(world, "camera", name="above", pos=above, fovy="45")
    ElementTree.SubElement(
        world, "light", pos=above, dir="0.3 0.4 -1", type="directional", diffuse=".4 .4 .4"
    )
    ground = {"type": "plane", "material": "ground", "contype": "0", "conaffinity": "0"}
    place = f"{x:.9g} {y:.9g} {-HEIGHT * extent:.9g}"
    size = f"{2.0 * extent:.9g} {2.0 * extent:.9g} 1"
    ElementTree.SubElement(world, "geom", ground, name="ground", pos=place, size=size)
