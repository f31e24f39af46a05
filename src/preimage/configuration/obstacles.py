"""Obstacles of configuration space: the workspace's obstacles, grown by the robot."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from preimage.configuration.boundary import contact_space
from preimage.configuration.contact import Floats
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import TaskError
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.border import border, present, without_vertices
from preimage.geometry.minkowski import minkowski_sum
from preimage.geometry.overlay import box_without, on_grid, united
from preimage.geometry.tolerance import Tolerance
from preimage.geometry.welding import welded
from preimage.task.robot import Robot
from preimage.task.task import Task
from preimage.task.workspace import ChainObstacle, PolygonObstacle, Side, SolidSide, Workspace

Box = tuple[float, float, float, float]

MARGIN = 0.25
"""How far C-obstacles are kept beyond the window, as a part of its larger extent."""


def configuration_space(task: Task) -> ConfigurationSpace:
    """Where the robot's reference point may be (theory 1, paper 3.1).

    Raises
    ------
    TaskError : if no free space is left in the window.
    """
    workspace = task.workspace
    window, tolerance = _on_its_grid(workspace.window.bounds)
    obstacles = c_obstacles(workspace, task.robot, window, tolerance)
    return space_among(obstacles, window, workspace.walls)


def space_among(obstacles: Area, window: Box, walls: Iterable[Side]) -> ConfigurationSpace:
    """Free space among C-obstacles, and its border.

    What is nearer than the tolerance touches: narrower slits are closed, thinner walls are not
    there. `free`, `contact` and the window agree exactly; `obstacles` is what was given.

    Parameters
    ----------
    obstacles : in the window, and some way beyond it.
    window : `xmin, ymin, xmax, ymax`.
    walls : the sides of the window that are walls; the others are open.

    Raises
    ------
    TaskError : if no free space is left in the window.
    """
    window, tolerance = _on_its_grid(window)
    free = box_without(window, obstacles, tolerance.grid)
    free = welded(free, window, tolerance.length, tolerance.grid)
    if free.is_empty:
        raise TaskError("obstacles", "no free space is left in the window")
    contact = contact_space(free, obstacles, window, walls, tolerance)
    straight = ~present(border(free)[0], contact.points)
    if straight.any():
        free = without_vertices(free, straight)
    return ConfigurationSpace(window, tolerance, free, obstacles, contact)


def _on_its_grid(window: Box) -> tuple[Box, Tolerance]:
    """A window moved to the grid that goes with it."""
    tolerance = Tolerance.for_window(*window)
    return _box_on_grid(window, tolerance), tolerance


def _box_on_grid(box: Box, tolerance: Tolerance) -> Box:
    xmin, ymin, xmax, ymax = on_grid(np.asarray(box), tolerance.grid).tolist()
    return xmin, ymin, xmax, ymax


def c_obstacles(workspace: Workspace, robot: Robot, window: Box, tolerance: Tolerance) -> Area:
    """The union of the C-obstacles `B (+) (-A)`, in a box somewhat larger than the window."""
    outer = grown(window, MARGIN * max(window[2] - window[0], window[3] - window[1]))
    outer = _box_on_grid(outer, tolerance)
    box, shape = outer, None
    if not robot.is_point:
        shape = -np.asarray(robot.shape, dtype=np.float64)
        reach = float(np.max(np.hypot(shape[:, 0], shape[:, 1])))
        box = _box_on_grid(grown(outer, 2.0 * reach), tolerance)
    solid = [
        polygon_of_chain(obstacle, box)
        if isinstance(obstacle, ChainObstacle)
        else _polygon(obstacle)
        for obstacle in workspace.obstacles
    ]
    near = [areas.within_box(part, *box) for part in solid if _meet(part.bounds, box)]
    whole = united(near, tolerance.grid)
    if shape is not None:
        shape = on_grid(shape, tolerance.grid)
        whole = minkowski_sum(whole, Area.polygon(shape), tolerance.grid)
    return areas.within_box(whole, *outer)


def grown(box: Box, margin: float) -> Box:
    """A box with a margin all around."""
    return box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin


def polygon_of_chain(chain: ChainObstacle, box: Box) -> Area:
    """The solid side of an unbounded chain, in a box that holds `box` and the chain's vertices."""
    points = np.asarray(chain.points, dtype=np.float64)
    low, high = points.min(axis=0), points.max(axis=0)
    outer = (
        min(box[0], float(low[0])),
        min(box[1], float(low[1])),
        max(box[2], float(high[0])),
        max(box[3], float(high[1])),
    )
    outer = grown(outer, 0.25 * max(outer[2] - outer[0], outer[3] - outer[1]))
    if chain.solid is SolidSide.RIGHT:
        points = points[::-1]
    entry = _leaves_box(points[1], points[0], outer)
    leave = _leaves_box(points[-2], points[-1], outer)
    # the end vertices lie inside the end edges, which run on
    return Area.polygon(
        np.concatenate(([entry], points[1:-1], [leave], _corners_between(leave, entry, outer)))
    )


def _leaves_box(start: Floats, through: Floats, box: Box) -> Floats:
    """Where the ray from `start` through another point inside the box meets its border."""
    along = through - start
    times = []
    for axis in (0, 1):
        if along[axis] > 0.0:
            times.append(((box[axis + 2] - start[axis]) / along[axis], axis, box[axis + 2]))
        elif along[axis] < 0.0:
            times.append(((box[axis] - start[axis]) / along[axis], axis, box[axis]))
    time, axis, value = min(times)
    place: Floats = start + time * along
    place[axis] = value
    return place


def _corners_between(start: Floats, stop: Floats, box: Box) -> Floats:
    """The corners of the box met on the way along its border, counter-clockwise."""
    corners = np.array(
        [[box[0], box[1]], [box[2], box[1]], [box[2], box[3]], [box[0], box[3]]], dtype=np.float64
    )
    begin = _around(start, box)
    way = math.fmod(_around(stop, box) - begin + 4.0, 4.0)
    turns = sorted((math.fmod(corner - begin + 4.0, 4.0), corner) for corner in range(4))
    return corners[[corner for turn, corner in turns if 0.0 < turn < way]].reshape(-1, 2)


def _around(place: Floats, box: Box) -> float:
    """Where a point lies on the border of a box: 0 to 4, counter-clockwise from its low corner."""
    across = (place[0] - box[0]) / (box[2] - box[0])
    up = (place[1] - box[1]) / (box[3] - box[1])
    if place[1] == box[1]:
        return float(across)
    if place[0] == box[2]:
        return float(1.0 + up)
    if place[1] == box[3]:
        return float(3.0 - across)
    return float(math.fmod(4.0 - up, 4.0))


def _polygon(obstacle: PolygonObstacle) -> Area:
    return Area.polygon(
        np.asarray(obstacle.exterior, dtype=np.float64),
        [np.asarray(hole, dtype=np.float64) for hole in obstacle.holes],
    )


def _meet(a: Box, b: Box) -> bool:
    """Whether two boxes meet."""
    return a[0] <= b[2] and b[0] <= a[2] and a[1] <= b[3] and b[1] <= a[3]
