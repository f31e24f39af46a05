"""Drawings and maps made into tasks."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from preimage.errors import InputError, TaskError, one_line, shown
from preimage.exchange import parts
from preimage.exchange.drawing import Drawing, Figure, Role, check_figures, hull_of
from preimage.exchange.options import (
    CURVES,
    ENDINGS,
    POSITION,
    DrawingFormat,
    ImportOptions,
    one_digit,
)
from preimage.exchange.parts import Box, Making, placed
from preimage.exchange.snapping import snapped
from preimage.geometry.outlines import hull_box
from preimage.task.degrees import to_degrees
from preimage.task.documents import Format, parse_document
from preimage.task.files import format_task, name_of
from preimage.task.parse import default_window, parse_task
from preimage.task.task import Task
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import Window, Workspace

Reader = Callable[[Path, ImportOptions], Drawing]

READERS: dict[DrawingFormat, tuple[str, str]] = {
    DrawingFormat.MAP: ("preimage.exchange.occupancy", "read_map"),
    DrawingFormat.DXF: ("preimage.exchange.dxf", "read_dxf"),
    DrawingFormat.SVG: ("preimage.exchange.svg", "read_svg"),
    DrawingFormat.WKT: ("preimage.exchange.wkt_file", "read_wkt"),
    DrawingFormat.GEOJSON: ("preimage.exchange.geojson_file", "read_geojson"),
}
"""Where the readers are, which are loaded when they are needed."""

GRID = 1e-9
"""The part of the drawing to which unions of walls and rooms are rounded."""

ROOM = 0.05
"""The window around rooms goes beyond them by this part of its larger side, if none is drawn."""


@dataclass(frozen=True, slots=True)
class Imported:
    """A task, and how it came to be.

    Parameters
    ----------
    task : the task, whose goal and start lie in its valid space.
    notes : lines for people: what was understood, what was moved by how much, what was left out.
    """

    task: Task
    notes: tuple[str, ...]


def import_task(path: str | os.PathLike[str], **options: Any) -> Imported:
    """The task of a drawing or a map, never more hopeful than what is drawn.

    Obstacles and the robot hold all that is drawn of them, a start too; a goal area nothing else.

    Parameters
    ----------
    path : a map of ROS (`.yaml`), DXF, SVG, WKT or GeoJSON.
    options : the fields of `ImportOptions`; angles in radians.

    Raises
    ------
    InputError : with the place in the drawing and the cause.
    """
    return imported(path, ImportOptions(**options))


def imported(path: str | os.PathLike[str], options: ImportOptions) -> Imported:
    """The same, with options as a record."""
    kind = options.format or format_of(path)
    module, function = READERS[kind]
    read: Reader = getattr(import_module(module), function)
    with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused
        drawing = read(Path(path), options)
        check_figures(drawing.figures)
    return _assembled(drawing, options, name_of(path), Path(path).name)


def format_imported(imported: Imported, kind: Format) -> str:
    """The text of a task file, with the notes as comments where the format has such.

    It is read again, so that what is written is what was made.
    """
    text = format_task(imported.task, kind)
    if parse_task(parse_document(text, kind)) != imported.task:
        raise AssertionError("a task that is written is not the same when it is read")
    if kind is Format.JSON:
        return text
    return "".join(f"# {one_line(line)}\n" for line in imported.notes) + text


def format_of(path: str | os.PathLike[str]) -> DrawingFormat:
    """The format that a path's ending says."""
    ending = Path(path).suffix.lower()
    for kind in DrawingFormat:
        if ending in ENDINGS[kind]:
            return kind
    if ending in (".pgm", ".png"):
        raise InputError(str(path), "is the image of a map: give the .yaml file that names it")
    known = ", ".join(ending for kind in DrawingFormat for ending in ENDINGS[kind])
    raise InputError(str(path), f"must end in one of {known}, not {shown(ending)}")


def _assembled(drawing: Drawing, options: ImportOptions, name: str, source: str) -> Imported:
    """The task of a drawing."""
    extent = _extent(drawing, options.window)
    making = Making(options, options.curves or one_digit(extent / CURVES), _grid(extent))
    roles = {role: [one for one in drawing.figures if one.role is role] for role in Role}
    try:
        obstacles = parts.obstacles_of(roles[Role.OBSTACLES], making)
        robot = parts.robot_of(roles[Role.ROBOT], roles[Role.REFERENCE], making)
        initial = parts.initial_of(roles[Role.START], robot, making)
        goal = parts.goal_of(roles[Role.GOAL], making)
        window = options.window or parts.window_of(roles[Role.WINDOW], making) or drawing.window
        if window is None:
            window = _room_window(roles[Role.ROOM])
        if window is None:
            if not obstacles:
                raise InputError("window", "is missing, and there are no obstacles")
            window = default_window(tuple(obstacles), robot, initial, goal).bounds
        if roles[Role.ROOM]:
            obstacles += parts.around_rooms(roles[Role.ROOM], window, making)
        task = Task(
            name=name,
            workspace=Workspace(Window(*window), options.walls, tuple(obstacles)),
            robot=robot,
            uncertainty=_uncertainty(options, window),
            friction=options.friction,
            initial=initial,
            goal=goal,
        )
        task, moved = snapped(task, options.snap)
    except TaskError as error:
        raise placed(error, making.places) from None
    notes = (
        _head(drawing, source),
        *_understood(task),
        *_moved(drawing, making, moved),
        *_left(drawing),
    )
    return Imported(task, notes)


def _extent(drawing: Drawing, window: Box | None) -> float:
    """The larger side of the box around everything."""
    points = hull_of(drawing.figures)
    if not len(points) and drawing.window is None:
        raise InputError("", "nothing in it has a role: name layers, ids or properties")
    extent = 0.0
    for box in (drawing.window, window):  # the other one for a drawing of one point
        if extent == 0.0:
            more = np.empty((0, 2)) if box is None else np.array(box, dtype=np.float64)
            points = np.concatenate((points, more.reshape(-1, 2)))
            extent = float(np.ptp(points, axis=0).max())
    if not 0.0 < extent < math.inf:
        raise InputError("", "everything in it is one point")
    return extent


def _grid(extent: float) -> float:
    """A billionth of it, as a power of two: longer than what the window does not resolve."""
    return 2.0 ** math.ceil(math.log2(GRID * extent))


def _room_window(figures: list[Figure]) -> Box | None:
    """The box around rooms, and somewhat more."""
    if not figures:
        return None
    xmin, ymin, xmax, ymax = hull_box(hull_of(figures))
    by = ROOM * max(xmax - xmin, ymax - ymin)
    return xmin - by, ymin - by, xmax + by, ymax + by


def _uncertainty(options: ImportOptions, window: Box) -> Uncertainty:
    position = options.position
    if position is None:
        sides = Window(*window)
        position = one_digit(max(sides.xmax - sides.xmin, sides.ymax - sides.ymin) / POSITION)
    threshold = (options.threshold, options.threshold)
    return Uncertainty(options.control, position, options.force_angle, threshold)


# --- for people -------------------------------------------------------------------------------


def _head(drawing: Drawing, source: str) -> str:
    unit = f", in {drawing.unit}" if drawing.unit else ""
    return f"{source}: {drawing.kind}{unit}"


def _understood(task: Task) -> tuple[str, ...]:
    corners = sum(len(ring) for one in task.workspace.obstacles for _, ring in one.rings)
    goal = task.goal
    robot = "a point" if task.robot.is_point else f"{len(task.robot.shape)} vertices"
    parts = [
        f"{_count(len(task.workspace.obstacles), 'obstacle')} of {_count(corners, 'vertex')}",
        f"robot: {robot}",
        f"start: {_START[type(task.initial).__name__]}",
        "goal: "
        + ", ".join(
            _count(len(found), word)
            for found, word in (
                (goal.edges, "edge"),
                (goal.polygons, "area"),
                (goal.points, "point"),
            )
            if found
        ),
    ]
    box = ", ".join(f"{bound:.6g}" for bound in task.workspace.window.bounds)
    return f"understood: {'; '.join(parts)}; window: {box}", f"bounds: {_bounds(task)}"


_START = {
    "InitialPoint": "a point",
    "InitialDisc": "a disc",
    "InitialPolygon": "an area",
    "InitialEdges": "edges",
    "Everywhere": "everywhere",
}


def _bounds(task: Task) -> str:
    errors = task.uncertainty
    position = f"{errors.position:g}" if errors.has_position_sensor else "no sensor"
    force = "no sensor"
    if errors.has_force_sensor:
        force = f"{to_degrees(errors.force_angle):g}° above {errors.force_thresholds[1]:g}"
    return (
        f"control {to_degrees(errors.control):g}°, position {position}, force {force}, "
        f"friction {to_degrees(task.friction):g}°"
    )


_SIDES = {
    Role.OBSTACLES: "obstacles outward",
    Role.ROOM: "rooms inward",
    Role.ROBOT: "the robot outward",
    Role.START: "the start outward",
    Role.GOAL: "the goal inward",
}


def _moved(drawing: Drawing, making: Making, moved: float) -> tuple[str, ...]:
    """What is not as it was drawn."""
    curved = [
        f"{_SIDES[role]} by up to {off:.3g}, at curves"
        for role, off in making.off.items()
        if off > 0.0 and role in _SIDES
    ]
    found = [*drawing.approximated, *curved, *making.notes]
    if moved:
        found.append(f"goal edges and points moved onto contact space by up to {moved:.3g}")
    return tuple(f"approximated: {line}" for line in found) or ("approximated: nothing",)


def _left(drawing: Drawing) -> tuple[str, ...]:
    if not drawing.ignored:
        return ()
    left = ", ".join(f"{count} {word}" for word, count in sorted(drawing.ignored.items()))
    return (f"left out: {left}",)


def _count(number: int, word: str) -> str:
    if number == 1:
        return f"1 {word}"
    return f"{number} {'vertices' if word == 'vertex' else f'{word}s'}"
