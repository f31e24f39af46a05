"""The parts of a task, each made of the figures of its role on the safe side.

Obstacles and the robot are never smaller than they are drawn, and a start never holds less; a goal
area never holds more.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from preimage.errors import InputError, TaskError, one_line
from preimage.exchange.drawing import Figure, Line, Patch, Role, Shape, Spot
from preimage.exchange.options import ImportOptions, Nested
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.curves import Arc, Bezier, Border, Curve, Floats, Hand, beside
from preimage.geometry.inflate import outer_stadiums
from preimage.geometry.outlines import (
    Errs,
    Fill,
    cut_open,
    filled,
    hull_box,
    polygons_of,
    without_holes,
)
from preimage.task.goal import Goal
from preimage.task.initial import Initial, InitialDisc, InitialEdges, InitialPoint, InitialPolygon
from preimage.task.robot import Robot
from preimage.task.workspace import ChainObstacle, Obstacle, PolygonObstacle, SolidSide

Point = tuple[float, float]
Ring = tuple[Point, ...]
Box = tuple[float, float, float, float]
Enclosing = Shape | Patch | Spot

ROBOT = 0.02
"""The polygon around a robot that is a disc goes beyond it by this part of its radius, at most."""

AROUND = 0.25
"""A room is cut out of a box that goes beyond it and the window by this part of its side."""


@dataclass(slots=True)
class Making:
    """A task in the making.

    Parameters
    ----------
    options : how the drawing is read.
    tolerance : how far borders may be from curves, a length above 0.
    grid : the spacing to which unions are rounded; by as much they are made larger.
    places : of keys of the task, where in the drawing they come from.
    off : of roles, how far borders were moved from curves at most.
    notes : what else was approximated, for people.
    """

    options: ImportOptions
    tolerance: float
    grid: float
    places: dict[str, str] = field(default_factory=dict)
    off: dict[Role, float] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def enclosed(self, figure: Enclosing, errs: Errs) -> Area:
        """The area that a figure encloses, on one side."""
        if isinstance(figure, Patch):
            return figure.area
        fill = figure.fill if isinstance(figure, Shape) else Fill.EVEN_ODD
        outlines = _outlines(figure)
        with at(figure.place):
            area, off = filled(outlines, fill, errs, self.tolerance)
        self.off[figure.role] = max(off, self.off.get(figure.role, 0.0))
        return area

    def polyline(self, figure: Line, hand: Hand) -> Border:
        """A polyline beside open curves, on one side."""
        with at(figure.place):
            border = beside(figure.curves, hand, self.tolerance)
            if len(border.points) < 2:
                raise InputError("", "is a point, not a line")
        self.off[figure.role] = max(border.off, self.off.get(figure.role, 0.0))
        return border


@contextlib.contextmanager
def at(place: str) -> Iterator[None]:
    """Refusals inside are of this place of the drawing."""
    try:
        yield
    except InputError as error:
        words = f"{error.key}: {error.rule}" if error.key else error.rule
        raise InputError(one_line(place), words) from None


def ring(points: Floats) -> Ring:
    """Points as task records hold them."""
    return tuple((float(x), float(y)) for x, y in points + 0.0)


# --- obstacles --------------------------------------------------------------------------------


def obstacles_of(figures: Sequence[Figure], making: Making) -> list[Obstacle]:
    """The obstacles, in the order of the drawing; rooms are not among them.

    Raises
    ------
    InputError : a point; a line, where it is not said what a line is.
    """
    found: list[Obstacle] = []
    for figure in _nested(figures, making.options.nested):
        if isinstance(figure, Line):
            made = _of_line(figure, making)
        else:
            made = _solid(making.enclosed(figure, Errs.OUTER))
        for obstacle in made:
            making.places[f"obstacles[{len(found)}]"] = figure.place
            found.append(obstacle)
    return found


def _nested(figures: Sequence[Figure], nested: Nested) -> list[Figure]:
    """The figures; if outlines inside others are holes, all outlines in one."""
    fill = nested.fill
    if fill is None:
        return list(figures)
    outlines = [
        outline
        for figure in figures
        if isinstance(figure, Shape | Spot)
        for outline in _outlines(figure)
    ]
    if len(outlines) < 2:
        return list(figures)
    whole = Shape(Role.OBSTACLES, f"{len(outlines)} outlines", tuple(outlines), fill)
    return [whole, *(figure for figure in figures if not isinstance(figure, Shape | Spot))]


def _outlines(figure: Shape | Spot) -> tuple[tuple[Curve, ...], ...]:
    if isinstance(figure, Shape):
        return figure.outlines
    if figure.radius == 0.0:
        raise InputError(one_line(figure.place), f"is a point, which is no {figure.role.value}")
    return ((Arc.circle(figure.point, figure.radius),),)


def _solid(area: Area) -> list[Obstacle]:
    return [
        PolygonObstacle(ring(exterior), tuple(ring(hole) for hole in holes))
        for exterior, holes in polygons_of(area)
    ]


def _of_line(figure: Line, making: Making) -> list[Obstacle]:
    solid, thickness = figure.solid or making.options.chains, making.options.thickness
    if figure.solid is None and thickness is not None:
        points, off = making.polyline(figure, Hand.LEFT)
        # on a grid, so that where walls meet no edges are left that are as short as rounding
        radius = 0.5 * thickness + off + making.grid
        return _solid(areas.snapped(outer_stadiums(points[:-1], points[1:], radius), making.grid))
    if solid is None:
        (ax, ay), (bx, by) = figure.curves[0].start, figure.curves[-1].end
        raise InputError(
            one_line(figure.place),
            f"is open, from ({ax:.6g}, {ay:.6g}) to ({bx:.6g}, {by:.6g}): close it, or say "
            "which side is solid (chains), or how thick it is (thickness)",
        )
    free = Hand.RIGHT if solid is SolidSide.LEFT else Hand.LEFT
    return [ChainObstacle(ring(making.polyline(figure, free).points), solid)]


def around_rooms(figures: Sequence[Figure], window: Box, making: Making) -> list[Obstacle]:
    """What is solid around rooms: a box, beyond the window, without what they surely hold."""
    rooms = [making.enclosed(_closed(figure), Errs.INNER) for figure in figures]
    whole = rooms[0] if len(rooms) == 1 else areas.united_on_grid(rooms, making.grid)
    xmin, ymin, xmax, ymax = whole.bounds
    corners = np.array([[xmin, ymin], [xmax, ymax], window[:2], window[2:]])
    xmin, ymin, xmax, ymax = hull_box(corners)
    by = AROUND * max(xmax - xmin, ymax - ymin)
    low, left, high, right = ymin - by, xmin - by, ymax + by, xmax + by
    parts = polygons_of(whole)
    shell = ((left, low), (right, low), (right, high), (left, high))
    found: list[Obstacle] = [PolygonObstacle(shell, tuple(ring(part) for part, _ in parts))]
    found += [PolygonObstacle(ring(hole)) for _, holes in parts for hole in holes]
    return found


def _closed(figure: Figure) -> Enclosing:
    if isinstance(figure, Line):
        raise InputError(one_line(figure.place), f"is open, so it is no {figure.role.value}")
    return figure


# --- robot, start, goal, window ---------------------------------------------------------------


def robot_of(figures: Sequence[Figure], references: Sequence[Figure], making: Making) -> Robot:
    """The robot: what encloses its figure, about a point that is drawn or the middle of its box."""
    outlines = [
        figure for figure in figures if not (isinstance(figure, Spot) and not figure.radius)
    ]
    spots = [figure for figure in figures if isinstance(figure, Spot) and not figure.radius]
    radius = making.options.robot_radius
    if not outlines:
        if radius == 0.0:
            return Robot()
        off = ROBOT * radius
        area = filled([[Arc.circle((0.0, 0.0), radius)]], Fill.EVEN_ODD, Errs.OUTER, off).area
        making.notes.append(f"the robot's disc of radius {radius:g} outward by up to {off:.3g}")
        return Robot(ring(area.rings[0]))
    if radius:
        raise InputError("robot_radius", f"there is a robot in the drawing: {outlines[0].place}")
    _one(outlines, "robot")
    area = making.enclosed(_closed(outlines[0]), Errs.OUTER)
    making.places["robot"] = outlines[0].place
    whole = _one_polygon(area, outlines[0])
    points = [*references, *spots]
    _one(points, "reference")
    if points:
        if not isinstance(points[0], Spot):
            raise InputError(one_line(points[0].place), "is no point, so it is no reference")
        return Robot(ring(whole), points[0].point)
    if isinstance(outlines[0], Spot):
        return Robot(ring(whole), outlines[0].point)
    xmin, ymin, xmax, ymax = hull_box(whole)
    return Robot(ring(whole), (0.5 * (xmin + xmax), 0.5 * (ymin + ymax)))


def initial_of(figures: Sequence[Figure], robot: Robot, making: Making) -> Initial:
    """The start: a point, a disc, what encloses an outline, or edges; else where the robot is."""
    given = making.options.initial
    if given is not None:
        if figures:
            raise InputError("initial", f"there is a start in the drawing: {figures[0].place}")
        return given
    if not figures:
        if robot.polygon is not None and "robot" in making.places:
            making.places["initial"] = f"{making.places['robot']}, where it is drawn"
            return InitialPoint(robot.reference)
        raise InputError("initial", "is missing: draw it on a layer named start, or say where")
    making.places["initial"] = figures[0].place
    lines = [figure for figure in figures if isinstance(figure, Line)]
    if len(lines) == len(figures):
        return InitialEdges(tuple(edge for line in lines for edge in _edges(line)))
    _one(figures, "start")
    figure = _closed(figures[0])
    if isinstance(figure, Spot):
        if figure.radius:
            return InitialDisc(figure.point, figure.radius)
        return InitialPoint(figure.point)
    area = making.enclosed(figure, Errs.OUTER)
    return InitialPolygon(ring(_one_polygon(area, figure)))


def goal_of(figures: Sequence[Figure], making: Making) -> Goal:
    """The goal: edges of lines, points, and what outlines surely enclose; and what is given."""
    given = making.options.goal
    edges = list(given.edges) if given else []
    polygons = list(given.polygons) if given else []
    points = list(given.points) if given else []
    for figure in figures:
        if isinstance(figure, Line):
            made = _edges(figure)
            making.places |= {
                f"goal.edges[{len(edges) + k}]": figure.place for k in range(len(made))
            }
            edges += made
        elif isinstance(figure, Spot) and not figure.radius:
            making.places[f"goal.points[{len(points)}]"] = figure.place
            points.append(figure.point)
        else:
            for piece in cut_open(making.enclosed(figure, Errs.INNER)):
                making.places[f"goal.polygons[{len(polygons)}]"] = figure.place
                polygons.append(ring(piece))
    if not edges and not polygons and not points:
        raise InputError("goal", "is missing: draw it on a layer named goal, or say where")
    return Goal(tuple(edges), tuple(polygons), tuple(points))


def window_of(figures: Sequence[Figure], making: Making) -> Box | None:
    """The box around what is drawn as the window."""
    if not figures:
        return None
    _one(figures, "window")
    area = making.enclosed(_closed(figures[0]), Errs.INNER)
    making.places["window"] = figures[0].place
    if area.measure < (1.0 - 1e-9) * Area.box(*area.bounds).measure:
        raise InputError(one_line(figures[0].place), "is no upright rectangle, so it is no window")
    return area.bounds


def _edges(figure: Line) -> list[tuple[Point, Point]]:
    """The segments of a line."""
    if any(not isinstance(curve, Bezier) or len(curve.points) > 2 for curve in figure.curves):
        raise InputError(one_line(figure.place), "is curved: contact space has straight edges")
    points = ring(np.stack([figure.curves[0].start, *(curve.end for curve in figure.curves)]))
    return [(a, b) for a, b in pairwise(points) if a != b]


def _one_polygon(area: Area, figure: Figure) -> Floats:
    whole = without_holes(area)
    if len(whole.parts) != 1:
        raise InputError(one_line(figure.place), f"must be in one piece, not {len(whole.parts)}")
    return polygons_of(whole)[0][0]


def _one(figures: Sequence[Figure], word: str) -> None:
    if len(figures) > 1:
        raise InputError(
            one_line(figures[1].place), f"is another {word}, beside {figures[0].place}"
        )


def placed(error: TaskError, places: dict[str, str]) -> InputError:
    """A refusal of a task, with the place in the drawing."""
    keys = [
        key for key in places if error.key == key or error.key.startswith((f"{key}.", f"{key}["))
    ]
    if not keys:
        return error
    place = places[max(keys, key=len)]
    return InputError(f"{one_line(place)} ({error.key})", error.rule)
