"""The scene of a task: obstacles, the window's sides, goal and start, the robot."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from matplotlib.patches import Circle, Patch, PathPatch, Rectangle
from matplotlib.path import Path
from numpy.typing import NDArray

from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import c_obstacles, configuration_space
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, start_region
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.rendering.layers import area_path, draw_lines, draw_markers, draw_region
from preimage.rendering.panel import FRAME, Panel
from preimage.rendering.placing import depth
from preimage.rendering.style import (
    C_OBSTACLE_GREY,
    FADED,
    INK,
    OBSTACLE_GREY,
    PAPER,
    REGIONS,
    Layer,
)
from preimage.task.initial import Everywhere
from preimage.task.robot import Robot
from preimage.task.task import Task
from preimage.task.workspace import Side

Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]

OBSTACLE_COST = 0.6
"""What it costs to cover a cell of an obstacle, as against one of a region."""


@dataclass(frozen=True, eq=False)
class Scene:
    """What pictures of one task have in common.

    Parameters
    ----------
    task : None where only a configuration space is known.
    goal, start : None where the task is not known.
    """

    space: ConfigurationSpace
    task: Task | None
    goal: Region | None
    start: Start | None

    @classmethod
    def of(cls, task: Task, space: ConfigurationSpace | None = None) -> Scene:
        """The scene of a task; its space is computed if it is not given."""
        space = configuration_space(task) if space is None else space
        return cls(space, task, goal_region(task, space), start_region(task, space))

    @property
    def starts_anywhere(self) -> bool:
        """Whether the start is all of valid space; that needs no drawing."""
        return self.task is not None and isinstance(self.task.initial, Everywhere)

    @cached_property
    def c_obstacles(self) -> Area:
        """The C-obstacles in the window."""
        return areas.within_box(self.space.obstacles, *self.space.window)

    @cached_property
    def obstacles(self) -> Area:
        """The workspace's obstacles in the window, if they are not the C-obstacles."""
        if self.task is None or self.task.robot.is_point:
            return Area.empty()
        window, tolerance = self.space.window, self.space.tolerance
        solid = c_obstacles(self.task.workspace, Robot(), window, tolerance)
        return areas.within_box(solid, *window)

    @cached_property
    def robot(self) -> Floats | None:
        """(n, 2) the robot's outline at the start; None for a point, and for a start anywhere."""
        if self.task is None or self.task.robot.is_point or self.start is None:
            return None
        if self.starts_anywhere:
            return None
        shape: Floats = np.asarray(self.task.robot.shape, dtype=np.float64)
        outline: Floats = shape + np.array(self._somewhere_in(self.start))
        return outline

    @cached_property
    def box(self) -> Box:
        """The window, and the robot at the start."""
        xmin, ymin, xmax, ymax = self.space.window
        if self.robot is None:
            return xmin, ymin, xmax, ymax
        (left, bottom), (right, top) = self.robot.min(axis=0), self.robot.max(axis=0)
        return (
            min(xmin, float(left)), min(ymin, float(bottom)),
            max(xmax, float(right)), max(ymax, float(top)),
        )  # fmt: skip

    def _somewhere_in(self, start: Start) -> tuple[float, float]:
        """A position well in the start."""
        if start.point is not None:
            return start.point
        region = start.region
        if region.area.is_empty:
            contact, longest = region.contact, int(np.argmax(np.diff(_spans(region))[:, 0]))
            middle = 0.5 * (contact.low + contact.high)
            x, y = self.space.contact.at(contact.edge, middle)[longest].tolist()
            return x, y
        return inner_point(region.area)


def _spans(region: Region) -> Floats:
    return np.stack((region.contact.low, region.contact.high), axis=1)


def inner_point(area: Area) -> tuple[float, float]:
    """A point well inside an area, by a coarse lattice."""
    xmin, ymin, xmax, ymax = area.bounds
    x, y = (
        low + (np.arange(41) + 0.5) * (high - low) / 41
        for low, high in ((xmin, xmax), (ymin, ymax))
    )
    columns, rows = np.meshgrid(x, y)
    inside = area.contains_all(np.stack((columns.ravel(), rows.ravel()), axis=1))
    if not inside.any():
        first = area.rings[0][0]
        return float(first[0]), float(first[1])
    best = int(np.argmax(depth(inside.reshape(columns.shape))))
    return float(columns.flat[best]), float(rows.flat[best])


def draw_scene(panel: Panel, scene: Scene, *, start: bool = True) -> None:
    """Draw all that is there before anything is planned.

    Parameters
    ----------
    start : whether the start, and the robot there, are drawn.
    """
    _draw_obstacles(panel, scene)
    _draw_sides(panel, scene)
    if scene.goal is not None:
        draw_region(panel, Layer.GOAL, scene.goal)
    if start and scene.start is not None:
        _draw_robot(panel, scene)
        _draw_start(panel, scene, scene.start)


def _draw_obstacles(panel: Panel, scene: Scene) -> None:
    for layer, area, color, order in (
        (Layer.C_OBSTACLE, scene.c_obstacles, C_OBSTACLE_GREY, 2.0),
        (Layer.OBSTACLE, scene.obstacles, OBSTACLE_GREY, 2.5),
    ):
        if area.is_empty:
            continue
        solid = PathPatch(
            area_path(area), facecolor=color, edgecolor=INK, linewidth=0.0, zorder=order
        )
        panel.add(solid, layer)
    panel.lattice.cost += OBSTACLE_COST * panel.lattice.inside(scene.c_obstacles)


def _draw_sides(panel: Panel, scene: Scene) -> None:
    """Open sides are dashed; closed ones get a band, hatched for a wall and solid for an obstacle.

    A side that nothing is said about, for want of a task, counts as a wall where it is closed.
    """
    contact, window = scene.space.contact, scene.space.window
    starts, ends = contact.points, contact.ends
    if contact.open.any():
        lines = np.stack((starts, ends), axis=1)[contact.open]
        draw_lines(panel, Layer.OPEN_SIDE, lines, "", FADED, 0.8, (0.0, (5.0, 3.5)), 3.0)
    walls = frozenset(Side) if scene.task is None else scene.task.workspace.walls
    bands: dict[Layer, list[Floats]] = {Layer.WALL: [], Layer.CLOSED_SIDE: []}
    wide = FRAME * panel.unit
    for side, axis, at, out in (
        (Side.LEFT, 0, window[0], -wide),
        (Side.BOTTOM, 1, window[1], -wide),
        (Side.RIGHT, 0, window[2], wide),
        (Side.TOP, 1, window[3], wide),
    ):
        on = (starts[:, axis] == at) & (ends[:, axis] == at) & ~contact.open
        shift = np.zeros(2)
        shift[axis] = out
        layer = Layer.WALL if side in walls else Layer.CLOSED_SIDE
        for first, last in zip(starts[on], ends[on], strict=True):
            bands[layer].append(np.array((first, last, last + shift, first + shift)))
    for layer, boxes in bands.items():
        if boxes:
            _draw_bands(panel, layer, boxes)


def _draw_bands(panel: Panel, layer: Layer, boxes: list[Floats]) -> None:
    path = Path.make_compound_path(*(Path([*box, box[0]], closed=True) for box in boxes))
    wall = layer is Layer.WALL
    band = PathPatch(
        path,
        facecolor=PAPER if wall else C_OBSTACLE_GREY,
        edgecolor=INK,
        linewidth=0.0,
        hatch="//////" if wall else None,
        zorder=1.5,
    )
    panel.add(band, layer, "band")
    lines = np.array([box[:2] for box in boxes])
    draw_lines(panel, layer, lines, "", INK, 1.1, order=3.2)


def _draw_start(panel: Panel, scene: Scene, start: Start) -> None:
    style = REGIONS[Layer.START]
    if start.point is None:
        if not scene.starts_anywhere:
            draw_region(panel, Layer.START, start.region)
        return
    x, y = start.point
    draw_markers(panel, Layer.START, np.array([[x, y]]), style, "point")
    panel.lattice.take(x, y, 8.0 * panel.unit, 8.0 * panel.unit)
    rho = 0.0 if scene.task is None else scene.task.uncertainty.position
    if 0.0 < rho < math.inf and panel.points(rho) > 0.5 * style.size:
        disc = Circle(
            (x, y), rho, facecolor="none", edgecolor=INK, linewidth=0.8,
            linestyle=(0.0, (1.0, 1.6)), zorder=style.order,
        )  # fmt: skip
        panel.add(disc, Layer.POSITION_ERROR)
        clip_to_window(panel, disc)


def clip_to_window(panel: Panel, patch: Patch) -> None:
    """Let nothing of a patch be seen outside the window."""
    xmin, ymin, xmax, ymax = panel.space.window
    window = Rectangle((xmin, ymin), xmax - xmin, ymax - ymin, transform=panel.axes.transData)
    patch.set_clip_path(window)


def _draw_robot(panel: Panel, scene: Scene) -> None:
    if scene.robot is None:
        return
    ring = scene.robot
    outline = PathPatch(
        Path(np.concatenate((ring, ring[:1])), closed=True),
        facecolor=(1.0, 1.0, 1.0, 0.75),
        edgecolor=INK,
        linewidth=1.2,
        zorder=5.3,
    )
    panel.add(outline, Layer.ROBOT)
    (left, bottom), (right, top) = ring.min(axis=0), ring.max(axis=0)
    inside = Area.box(float(left), float(bottom), float(right), float(top))
    panel.lattice.cost += 4.0 * panel.lattice.inside(inside)
