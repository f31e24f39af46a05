"""Free space cut into slabs across a direction: rows of trapezoids, in the target or not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.angles import unit
from preimage.geometry.area import Area

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Span = tuple[float, float]

BORDER = -1
"""The side of a cell that is a border of the target's area, and no boundary of free space."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The plane turned so that the commanded direction points down.

    Parameters
    ----------
    across, up : unit vectors of the turned plane's axes.
    """

    across: tuple[float, float]
    up: tuple[float, float]

    @classmethod
    def of(cls, direction: float) -> Frame:
        """The frame in which `direction` (radians) points down."""
        x, y = unit(direction)
        return cls((-y + 0.0, x + 0.0), (-x + 0.0, -y + 0.0))

    def turned(self, points: Floats) -> Floats:
        """(k, 2) points of the plane, in the frame."""
        axes: Floats = np.array((self.across, self.up)).T
        return points @ axes

    def restored(self, points: Floats) -> Floats:
        """(k, 2) points of the frame, in the plane."""
        axes: Floats = np.array((self.across, self.up))
        return points @ axes


@dataclass(frozen=True, slots=True)
class Cell:
    """A trapezoid of free space between the floor and the ceiling of a slab.

    Parameters
    ----------
    left, right : the boundary edges beside it, or `BORDER`.
    bottom, top : heights of the slab.
    floor, ceiling : where it begins and ends at these heights; the ends of one may be one point.
    in_target : it belongs to the target's area.
    """

    left: int
    right: int
    bottom: float
    top: float
    floor: Span
    ceiling: Span
    in_target: bool

    def width_at(self, height: float) -> Span:
        """Where the cell begins and ends at a height."""
        part = (height - self.bottom) / (self.top - self.bottom)
        return (
            self.floor[0] + part * (self.ceiling[0] - self.floor[0]),
            self.floor[1] + part * (self.ceiling[1] - self.floor[1]),
        )


@dataclass(frozen=True, slots=True)
class Slabs:
    """Free space in slabs, the lowest first, and contact space's place among them.

    Parameters
    ----------
    frame : the turned plane.
    heights : the levels between the slabs, ascending; slab `k` lies between `k` and `k + 1`.
    cells : for each slab its trapezoids of free space, from left to right.
    x, level : for each vertex of contact space its place on a level, and which level.
    starts : for each slab the trapezoids of the start's area, from left to right.
    """

    frame: Frame
    heights: tuple[float, ...]
    cells: tuple[tuple[Cell, ...], ...]
    x: tuple[float, ...]
    level: tuple[int, ...]
    starts: tuple[tuple[Cell, ...], ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Lines:
    """Segments that cross levels: boundary edges of free space first, then the target's borders.

    Parameters
    ----------
    name : (k,) the boundary edge, or `BORDER`.
    step : (k,) 1 if what the segment bounds is on its right, -1 if on its left.
    """

    name: Ints
    step: Ints
    low_x: Floats
    low_level: Ints
    high_x: Floats
    high_level: Ints


def cut(
    space: ConfigurationSpace, target: Region, direction: float, start: Area | None = None
) -> Slabs:
    """Cut free space across `direction` at the heights of all vertices.

    These are the vertices of contact space, those of the target's area, the ends of the target's
    intervals on edges, and the places where the target's border meets a boundary edge. So no two
    borders cross within a slab, and each edge is in the target throughout the slab or nowhere.
    Heights within the tolerance of each other are one.

    Parameters
    ----------
    start : another area, cut into trapezoids of its own at the same heights.
    """
    contact, tolerance = space.contact, space.tolerance.length
    frame = Frame.of(direction)
    starts = frame.turned(contact.points)
    ends = starts[contact.next]
    border_starts, border_ends = (frame.turned(points) for points in target.area.segments)
    marks = frame.turned(_interval_ends(contact, target))
    crossings = _crossings(starts, ends, border_starts, border_ends)
    other_starts, other_ends = (frame.turned(points) for points in (start or Area.empty()).segments)
    both = np.concatenate((starts, border_starts)), np.concatenate((ends, border_ends))
    more = _crossings(*both, other_starts, other_ends)
    heights, levels = _levels(
        (
            starts[:, 1],
            border_starts[:, 1],
            border_ends[:, 1],
            other_starts[:, 1],
            other_ends[:, 1],
            marks[:, 1],
            crossings,
            more,
        ),
        tolerance,
    )
    level = levels[0]
    others = _lines(
        np.zeros(len(other_starts), dtype=np.int64), other_starts, other_ends, levels[3], levels[4]
    )
    lines = _joined(
        _lines(np.arange(len(contact)), starts, ends, level, level[contact.next]),
        _lines(
            np.full(len(border_starts), BORDER), border_starts, border_ends, levels[1], levels[2]
        ),
    )
    return Slabs(
        frame=frame,
        heights=tuple(heights),
        cells=tuple(_cells(lines, heights, slab, tolerance) for slab in range(len(heights) - 1)),
        x=tuple(starts[:, 0].tolist()),
        level=tuple(level.tolist()),
        starts=tuple(_cells(others, heights, slab, tolerance) for slab in range(len(heights) - 1))
        if len(other_starts)
        else ((),) * (len(heights) - 1),
    )


def _interval_ends(contact: ContactSpace, target: Region) -> Floats:
    """Where the target's intervals on edges begin and end."""
    edge = np.concatenate((target.contact.edge, target.contact.edge))
    distance = np.concatenate((target.contact.low, target.contact.high))
    start, end = contact.points[edge], contact.points[contact.next[edge]]
    along = end - start
    part = np.clip(distance / np.hypot(along[:, 0], along[:, 1]), 0.0, 1.0)
    return start + part[:, None] * along


def _crossings(p: Floats, p_end: Floats, q: Floats, q_end: Floats) -> Floats:
    """Heights at which segments of the first family meet segments of the second.

    A level too many does no harm, so segments that just miss each other are taken too.
    """
    r, s = (p_end - p)[:, None, :], (q_end - q)[None, :, :]
    gap = q[None, :, :] - p[:, None, :]
    turn = r[..., 0] * s[..., 1] - r[..., 1] * s[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        on_p = (gap[..., 0] * s[..., 1] - gap[..., 1] * s[..., 0]) / turn
        on_q = (gap[..., 0] * r[..., 1] - gap[..., 1] * r[..., 0]) / turn
        meet = (np.abs(on_p - 0.5) <= 0.5) & (np.abs(on_q - 0.5) <= 0.5)
    first, second = np.nonzero(meet)
    height: Floats = p[first, 1] + on_p[first, second] * r[first, 0, 1]
    return height


def _levels(families: Sequence[Floats], tolerance: float) -> tuple[list[float], list[Ints]]:
    """The distinct heights, ascending, and for each given height its index among them."""
    every = np.concatenate(families)
    order = np.argsort(every, kind="stable")
    sorted_heights = every[order]
    new = np.ones(len(every), dtype=np.bool_)
    new[1:] = np.diff(sorted_heights) > tolerance
    index = np.empty(len(every), dtype=np.int64)
    index[order] = np.cumsum(new) - 1
    sizes = np.cumsum([len(family) for family in families])[:-1]
    return sorted_heights[new].tolist(), np.split(index, sizes)


def _lines(name: Ints, start: Floats, end: Floats, start_level: Ints, end_level: Ints) -> _Lines:
    """The segments that are not level; what they bound lies on the left of their travel."""
    keep = start_level != end_level
    name, start, end = name[keep], start[keep], end[keep]
    start_level, end_level = start_level[keep], end_level[keep]
    falls = end_level < start_level
    return _Lines(
        name=name,
        step=np.where(falls, 1, -1),
        low_x=np.where(falls, end[:, 0], start[:, 0]),
        low_level=np.where(falls, end_level, start_level),
        high_x=np.where(falls, start[:, 0], end[:, 0]),
        high_level=np.where(falls, start_level, end_level),
    )


def _joined(a: _Lines, b: _Lines) -> _Lines:
    return _Lines(
        *(
            np.concatenate((getattr(a, field), getattr(b, field)))
            for field in ("name", "step", "low_x", "low_level", "high_x", "high_level")
        )
    )


def _cells(lines: _Lines, heights: list[float], slab: int, tolerance: float) -> tuple[Cell, ...]:
    """The trapezoids of free space in one slab."""
    here = np.flatnonzero((lines.low_level <= slab) & (lines.high_level > slab))
    bottom, top = heights[slab], heights[slab + 1]
    floor, ceiling = (_place(lines, here, heights, slab + step) for step in (0, 1))
    border = lines.name[here] == BORDER
    if border.any():
        floor = _snapped(floor, border, tolerance)
        ceiling = _snapped(ceiling, border, tolerance)
    order = np.argsort(floor + ceiling, kind="stable").tolist()
    names, steps = lines.name[here].tolist(), lines.step[here].tolist()
    at_floor, at_ceiling = floor.tolist(), ceiling.tolist()

    cells: list[Cell] = []
    free = target = 0
    left = BORDER
    begin = (0.0, 0.0)
    for place, line in enumerate(order):
        here_x = (at_floor[line], at_ceiling[line])
        name = names[line]
        # a border of the target that runs along a boundary edge bounds no cell of its own
        doubled = name == BORDER and place > 0 and here_x == begin
        if free > 0 and not doubled:
            cells.append(
                Cell(
                    left=left,
                    right=name,
                    bottom=bottom,
                    top=top,
                    floor=(begin[0], max(begin[0], here_x[0])),
                    ceiling=(begin[1], max(begin[1], here_x[1])),
                    in_target=target > 0,
                )
            )
        if name == BORDER:
            target += steps[line]
        else:
            free += steps[line]
        if not doubled:
            left, begin = name, here_x
    return tuple(cells)


def _place(lines: _Lines, here: Ints, heights: list[float], level: int) -> Floats:
    """Where the lines cross a level."""
    height = np.array(heights)
    low, high = lines.low_level[here], lines.high_level[here]
    part = (height[level] - height[low]) / (height[high] - height[low])
    inner = lines.low_x[here] + part * (lines.high_x[here] - lines.low_x[here])
    return np.where(level == high, lines.high_x[here], inner)


def _snapped(x: Floats, border: NDArray[np.bool_], tolerance: float) -> Floats:
    """Places with those of the target's borders moved onto a boundary edge that they touch."""
    edges = x[~border]
    if not len(edges):
        return x
    nearest = edges[np.argmin(np.abs(x[:, None] - edges[None, :]), axis=1)]
    near = border & (np.abs(nearest - x) <= tolerance)
    return np.where(near, nearest, x)
