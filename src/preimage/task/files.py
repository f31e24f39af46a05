"""Task files: YAML, JSON or TOML, by their ending."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

from preimage.errors import TaskError
from preimage.task.checks import Point
from preimage.task.degrees import to_degrees
from preimage.task.documents import Format, read_document
from preimage.task.initial import (
    Everywhere,
    Initial,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
)
from preimage.task.layout import format_document
from preimage.task.limits import MAX_NAME
from preimage.task.options import Continuous, PlannerOptions, uniform_directions
from preimage.task.parameters import NONE
from preimage.task.parse import VERSION, parse_task
from preimage.task.robot import Robot
from preimage.task.task import Task
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import ChainObstacle, Obstacle, Side
from preimage.whole_file import write_whole

_WHOLE = 2.0**53
"""Doubles below this that are whole are written as whole numbers."""


def load_task(path: str | os.PathLike[str]) -> Task:
    """The task of a file; it is named after the file if it has no name.

    Raises
    ------
    TaskError : if the file cannot be read or the task is refused.
    """
    return parse_task(read_document(path), name=name_of(path))


def name_of(path: str | os.PathLike[str]) -> str:
    """The name of a file's task, if it has none of its own."""
    stem = Path(path).stem[:MAX_NAME]
    return stem if stem.strip() and stem.isprintable() else "task"


def save_task(task: Task, path: str | os.PathLike[str]) -> None:
    """Write a task to a file, with all defaults filled in.

    Raises
    ------
    TaskError : if the file cannot be written.
    """
    text = format_task(task, Format.of(path))
    try:
        write_whole(path, text)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise TaskError(str(path), f"cannot be written: {reason}") from None


def format_task(task: Task, kind: Format) -> str:
    """The text of a task's file: the same bytes each time."""
    return format_document(dump_task(task), kind)


def dump_task(task: Task) -> dict[str, Any]:
    """Plain data from which `parse_task` makes the same task: all defaults filled in, degrees.

    Infinity is the word `inf`, so that JSON can hold it.
    """
    workspace = task.workspace
    return {
        "version": VERSION,
        "name": task.name,
        "window": [_number(bound) for bound in workspace.window.bounds],
        "walls": [side.value for side in Side if side in workspace.walls],
        "robot": _robot(task.robot),
        "obstacles": [_obstacle(obstacle) for obstacle in workspace.obstacles],
        "uncertainty": _uncertainty(task.uncertainty),
        "friction": _degrees(task.friction),
        "sliding": task.sliding.value,
        "initial": _initial(task.initial),
        "goal": {
            "edges": [_points(edge) for edge in task.goal.edges],
            "polygons": [_points(polygon) for polygon in task.goal.polygons],
            "points": _points(task.goal.points),
        },
        "planner": _options(task.options),
    }


def _number(value: float) -> int | float:
    return int(value) if value.is_integer() and abs(value) < _WHOLE else value


def _degrees(radians: float) -> int | float:
    return _number(to_degrees(radians))


def _point(point: Point) -> list[int | float]:
    return [_number(point[0]), _number(point[1])]


def _points(points: tuple[Point, ...]) -> list[list[int | float]]:
    return [_point(point) for point in points]


def _robot(robot: Robot) -> object:
    if robot.polygon is None:
        return "point"
    return {"polygon": _points(robot.polygon), "reference": _point(robot.reference)}


def _obstacle(obstacle: Obstacle) -> dict[str, object]:
    if isinstance(obstacle, ChainObstacle):
        return {"chain": _points(obstacle.points), "solid": obstacle.solid.value}
    data: dict[str, object] = {"polygon": _points(obstacle.exterior)}
    if obstacle.holes:
        data["holes"] = [_points(hole) for hole in obstacle.holes]
    return data


def _uncertainty(uncertainty: Uncertainty) -> dict[str, object]:
    position = uncertainty.position
    low, high = uncertainty.force_thresholds
    force: object = NONE
    if uncertainty.has_force_sensor:
        force = {
            "angle": _degrees(uncertainty.force_angle),
            "threshold": _number(low) if low == high else [_number(low), _number(high)],
        }
    return {
        "control": _degrees(uncertainty.control),
        "position": "inf" if math.isinf(position) else _number(position),
        "force": force,
    }


def _initial(initial: Initial) -> object:
    match initial:
        case InitialPoint():
            return {"point": _point(initial.point)}
        case InitialDisc():
            disc = {"center": _point(initial.center), "radius": _number(initial.radius)}
            return {"disc": disc}
        case InitialPolygon():
            return {"polygon": _points(initial.vertices)}
        case InitialEdges():
            return {"edges": [_points(edge) for edge in initial.edges]}
        case Everywhere():
            return "everywhere"


def _options(options: PlannerOptions) -> dict[str, object]:
    """The options; of those that only this planner has, what differs from the default.

    Other programs that read version 1 may refuse keys that they do not know.
    """
    limit = options.time_limit
    ours: dict[str, object] = {
        "search": options.search.value,
        "time_limit": NONE if limit is None else _number(limit),
        "max_regions": options.max_regions,
        "arc_tolerance": _number(options.arc_tolerance),
        "resolution": _degrees(options.resolution),
        "or_fail": options.or_fail,
        "prefer": options.prefer.value,
    }
    default = PlannerOptions()
    changed = {key for key in ours if getattr(options, key) != getattr(default, key)}
    return {
        "directions": _directions(options),
        "method": options.method.value,
        "strategy": options.strategy.value,
        "termination": options.termination.value,
        "max_steps": options.max_steps,
    } | {key: value for key, value in ours.items() if key in changed}


def _directions(options: PlannerOptions) -> object:
    directions = options.directions
    if isinstance(directions, Continuous):
        return "continuous"
    count = len(directions)
    if count % 2 == 0 and directions == uniform_directions(count):
        return count
    return [_degrees(direction) for direction in directions]
