"""A drawing as its reader has understood it: figures with roles, not yet a task."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from types import MappingProxyType

import numpy as np

from preimage.errors import InputError, one_line
from preimage.geometry.area import Area
from preimage.geometry.curves import Arc, Curve, Floats
from preimage.geometry.outlines import Fill
from preimage.task.workspace import SolidSide

MAX_FIGURES = 100_000
"""Figures of a drawing; more are no drawing of a task."""

MAX_COORDINATE = 1e9
"""Coordinates are at most this, either way, as in task files."""


FLAT = 1e5
"""An arc whose radius is so many times its size has a place to 10⁻¹¹ of it at best."""


class Role(Enum):
    """What a figure is in the task."""

    OBSTACLES = "obstacles"
    ROOM = "room"
    GOAL = "goal"
    START = "start"
    ROBOT = "robot"
    REFERENCE = "reference"
    WINDOW = "window"


NAMES: Mapping[str, Role] = MappingProxyType(
    {
        **{role.value: role for role in Role},
        "obstacle": Role.OBSTACLES,
        "wall": Role.OBSTACLES,
        "walls": Role.OBSTACLES,
        "rooms": Role.ROOM,
        "free": Role.ROOM,
        "goals": Role.GOAL,
        "target": Role.GOAL,
        "initial": Role.START,
        "origin": Role.REFERENCE,
    }
)
"""The names of layers, ids and properties that are understood, in small letters."""

_NUMBER = re.compile(r"[\s_.:-]*\d*$")


def role_named(name: str, names: Mapping[str, Role]) -> Role | None:
    """The role that a name says: as in the table, whatever its case, a number after it or not.

    >>> role_named("Obstacle-12", NAMES), role_named("dimensions", NAMES)
    (<Role.OBSTACLES: 'obstacles'>, None)
    """
    word = name.strip().casefold()
    return names.get(word) or names.get(_NUMBER.sub("", word))


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Closed curves that belong together: what they enclose.

    Parameters
    ----------
    role : what it is.
    place : names it in refusals: its layer, its kind, its id.
    outlines : each closed; see `geometry.outlines`.
    fill : which points nested outlines enclose.
    """

    role: Role
    place: str
    outlines: tuple[tuple[Curve, ...], ...]
    fill: Fill = Fill.EVEN_ODD


@dataclass(frozen=True, slots=True, eq=False)
class Patch:
    """An area that is exact already, as of cells, or of a file of polygons."""

    role: Role
    place: str
    area: Area


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Open curves that follow each other; as an obstacle, `solid` may say which side is."""

    role: Role
    place: str
    curves: tuple[Curve, ...]
    solid: SolidSide | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Spot:
    """A point, or with a radius above 0 a disc."""

    role: Role
    place: str
    point: tuple[float, float]
    radius: float = 0.0


Figure = Shape | Patch | Line | Spot


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """What a reader hands on.

    Parameters
    ----------
    kind : the format, for people.
    figures : in the order of the file.
    window : `xmin, ymin, xmax, ymax` if the file says where it ends, as maps do.
    unit : what 1 is, for people; empty if the file does not say.
    approximated : what was moved, by how much and to which side; for people.
    ignored : what was left out, with how often.
    """

    kind: str
    figures: tuple[Figure, ...]
    window: tuple[float, float, float, float] | None = None
    unit: str = ""
    approximated: tuple[str, ...] = ()
    ignored: Mapping[str, int] = field(default_factory=Counter)


def hull_of(figures: Sequence[Figure]) -> Floats:
    """`(n, 2)` points whose box holds the figures."""
    found: list[Floats] = [np.empty((0, 2))]
    for figure in figures:
        if isinstance(figure, Shape):
            found += [curve.hull for outline in figure.outlines for curve in outline]
        elif isinstance(figure, Line):
            found += [curve.hull for curve in figure.curves]
        elif isinstance(figure, Spot):
            found.append(np.array(figure.point) + figure.radius * np.array([[-1, -1], [1, 1]]))
        elif not figure.area.is_empty:
            found.append(np.array(figure.area.bounds).reshape(2, 2))
    return np.concatenate(found)


def scaled(figures: Sequence[Figure], by: float) -> tuple[Figure, ...]:
    """Figures of outlines, lines and points, all lengths multiplied."""
    if by == 1.0:
        return tuple(figures)
    matrix = np.array([[by, 0.0, 0.0], [0.0, by, 0.0]])
    return tuple(_moved(figure, matrix, by) for figure in figures)


def _moved(figure: Figure, matrix: Floats, by: float) -> Figure:
    if isinstance(figure, Shape):
        outlines = tuple(
            tuple(curve.moved(matrix) for curve in outline) for outline in figure.outlines
        )
        return replace(figure, outlines=outlines)
    if isinstance(figure, Line):
        return replace(figure, curves=tuple(curve.moved(matrix) for curve in figure.curves))
    assert isinstance(figure, Spot)  # areas come from files without units
    x, y = figure.point
    return replace(figure, point=(by * x, by * y), radius=by * figure.radius)


def _curves(figure: Figure) -> list[Curve]:
    if isinstance(figure, Shape):
        return [curve for outline in figure.outlines for curve in outline]
    return list(figure.curves) if isinstance(figure, Line) else []


def _is_flat(curve: Curve) -> bool:
    """Whether the middle of an arc is so far away that its course is lost in rounding."""
    if not isinstance(curve, Arc):
        return False
    return curve.reach > FLAT * float(np.ptp(curve.hull, axis=0).max())


def check_figures(figures: Sequence[Figure]) -> None:
    """Refuse too many, coordinates that are not finite or too large, and arcs as good as lines."""
    if len(figures) > MAX_FIGURES:
        raise InputError("", f"must have {MAX_FIGURES} figures or fewer, not {len(figures)}")
    for figure in figures:
        points = hull_of([figure])
        if not np.all(np.abs(points) <= MAX_COORDINATE):  # NaN is not
            raise InputError(
                one_line(figure.place),
                f"coordinates must be finite, and at most {MAX_COORDINATE:g}",
            )
        if any(_is_flat(curve) for curve in _curves(figure)):
            raise InputError(one_line(figure.place), "has an arc that is all but straight")
