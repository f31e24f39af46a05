"""Free flight within one cell: what flies from one convex set of starts, and where it gets.

Turn the plane so that `v` points down, and let `t = tan(theta)`. Within a cell, which is convex, a
motion at `(x, h)` flies to `(x', h')` iff `|x' - x| <= t (h - h')`. So what flies from a convex set
of starts has one interval of places at every height, and the ends of these are linear between the
heights of the set's corners. It is cut off where the cell ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from preimage.verification.levels import where_positive
from preimage.verification.slabs import Cell, Span

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class FromEdge:
    """Who is on an edge, at one of the places touched before a time."""

    edge: int
    time: int


@dataclass(frozen=True, slots=True)
class FromVertex:
    """Who is at a vertex."""

    vertex: int


@dataclass(frozen=True, slots=True)
class FromAbove:
    """Who comes through the ceiling of a cell: where, and what flew there."""

    parents: tuple[tuple[float, float, Flight], ...]


Origin = FromEdge | FromVertex | FromAbove | None
"""Where a motion comes from; None at its start."""


@dataclass(frozen=True, slots=True)
class Strip:
    """A part of a flight between two heights, with straight sides.

    Parameters
    ----------
    top, bottom : heights.
    left, right : where it begins and ends, at the top and at the bottom.
    """

    top: float
    bottom: float
    left: Span
    right: Span


@dataclass(frozen=True, slots=True, eq=False)
class Flight:
    """What flies within one cell from one convex set of starts.

    Parameters
    ----------
    strips : where it gets, from the top; what is beyond the cell's sides is not part of it.
    starts : segments of the starts: who gets anywhere can do so from one of them.
    """

    cell: Cell
    strips: tuple[Strip, ...]
    starts: tuple[tuple[Point, Point], ...]
    origin: Origin


Entry = tuple[float, float, Flight]
"""An interval of places on a level, and what flies through it."""


def from_ceiling(cell: Cell, span: Span, spread: float, origin: Origin) -> Flight:
    """What flies from an interval of a cell's ceiling."""
    reach = spread * (cell.top - cell.bottom)
    strip = Strip(cell.top, cell.bottom, (span[0], span[0] - reach), (span[1], span[1] + reach))
    return Flight(cell, (strip,), (((span[0], cell.top), (span[1], cell.top)),), origin)


def from_segment(cell: Cell, high: Point, low: Point, spread: float, origin: Origin) -> Flight:
    """What flies from a segment in a cell, given by its upper and its lower end."""
    drop = spread * (high[1] - low[1])
    left, right = min(low[0], high[0] - drop), max(low[0], high[0] + drop)
    strips = []
    if high[1] > low[1]:
        strips.append(Strip(high[1], low[1], (high[0], left), (high[0], right)))
    if low[1] > cell.bottom:
        reach = spread * (low[1] - cell.bottom)
        strips.append(Strip(low[1], cell.bottom, (left, left - reach), (right, right + reach)))
    return Flight(cell, tuple(strips), ((high, low),), origin)


def from_start(cell: Cell, part: Cell, spread: float, tolerance: float) -> Flight | None:
    """What flies from the common part of a cell and a trapezoid of its slab, if there is one."""
    top = (max(cell.ceiling[0], part.ceiling[0]), min(cell.ceiling[1], part.ceiling[1]))
    floor = (max(cell.floor[0], part.floor[0]), min(cell.floor[1], part.floor[1]))
    wide = [span[1] - span[0] for span in (top, floor)]
    if min(wide) < -tolerance or max(wide) <= tolerance:
        return None
    top, floor = ((span[0], max(span)) for span in (top, floor))
    reach = spread * (cell.top - cell.bottom)
    strip = Strip(
        cell.top,
        cell.bottom,
        (top[0], min(floor[0], top[0] - reach)),
        (top[1], max(floor[1], top[1] + reach)),
    )
    upper = ((top[0], cell.top), (top[1], cell.top))
    lower = ((floor[0], cell.bottom), (floor[1], cell.bottom))
    return Flight(cell, (strip,), (upper, lower, *zip(upper, lower, strict=True)), None)


def touched(flight: Flight, side: int, tolerance: float) -> Iterator[Span]:
    """The heights at which a flight touches the left (0) or the right side (1) of its cell."""
    for strip in flight.strips:
        height = strip.top - strip.bottom
        ends = [flight.cell.width_at(h)[side] for h in (strip.top, strip.bottom)]
        after = where_positive(ends[0] - strip.left[0], ends[1] - strip.left[1], tolerance)
        before = where_positive(strip.right[0] - ends[0], strip.right[1] - ends[1], tolerance)
        begin, stop = max(after[0], before[0]), min(after[1], before[1])
        if begin <= stop:
            yield strip.top - stop * height, strip.top - begin * height


def leaving(flight: Flight, tolerance: float) -> Iterator[Entry]:
    """Where a flight leaves its cell through the floor."""
    cell = flight.cell
    if flight.strips and flight.strips[-1].bottom <= cell.bottom:
        last = flight.strips[-1]
        low, high = max(last.left[1], cell.floor[0]), min(last.right[1], cell.floor[1])
        if low <= high + tolerance:
            yield min(low, high), max(low, high), flight


def within(entries: list[Entry], view: Span, tolerance: float) -> Iterator[Entry]:
    """What passes a view, which must have some width."""
    if view[1] - view[0] <= tolerance:
        return
    for low, high, flight in entries:
        first, last = max(low, view[0]), min(high, view[1])
        if first <= last + tolerance:
            yield min(first, last), max(first, last), flight


def together(
    entries: list[Entry],
) -> Iterator[list[Entry]]:
    """Entries that overlap, in groups; those that lie in others are left out."""
    group: list[Entry] = []
    end = -math.inf
    for low, high, flight in sorted(entries, key=lambda entry: (entry[0], -entry[1])):
        if group and low > end:
            yield group
            group, end = [], -math.inf
        if high > end or not group:
            group.append((low, high, flight))
            end = max(end, high)
    if group:
        yield group
