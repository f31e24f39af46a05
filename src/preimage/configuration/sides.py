"""The open sides of the window: which part of the border of free space is no contact."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from preimage.configuration.contact import Bools, Floats, Ints
from preimage.geometry.area import Area
from preimage.geometry.border import border, split
from preimage.geometry.tolerance import Tolerance
from preimage.task.workspace import Side

Box = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class OpenSide:
    """An open side of the window, and where it is closed.

    Parameters
    ----------
    axis, at : the points of the side have the coordinate `at` on this axis.
    closed : (k, 2) intervals of the other coordinate in which an obstacle lies right behind the
        side; disjoint and ascending.
    """

    axis: int
    at: float
    closed: Floats

    @property
    def along(self) -> int:
        """The axis along the side."""
        return 1 - self.axis

    def edges(self, points: Floats, following: Ints) -> Ints:
        """The edges that lie on the side."""
        on = points[:, self.axis] == self.at
        return np.flatnonzero(on & on[following]).astype(np.int32)


def open_sides(
    window: Box, walls: Iterable[Side], obstacles: Area, tolerance: Tolerance
) -> tuple[OpenSide, ...]:
    """The sides that are no walls.

    Parameters
    ----------
    obstacles : the C-obstacles, also some way beyond the window.
    """
    closed_off = set(walls)
    points, following = border(obstacles)
    starts, ends = points, points[following]
    found = []
    # an obstacle beyond a side is on the left of its own border there: upwards along the left
    # side of the window, downwards along the right one, …
    for side, axis, at, sense in (
        (Side.LEFT, 0, window[0], 1.0),
        (Side.RIGHT, 0, window[2], -1.0),
        (Side.BOTTOM, 1, window[1], -1.0),
        (Side.TOP, 1, window[3], 1.0),
    ):
        if side in closed_off:
            continue
        on = np.abs(starts[:, axis] - at) <= tolerance.length
        on &= np.abs(ends[:, axis] - at) <= tolerance.length
        low, high = starts[on, 1 - axis], ends[on, 1 - axis]
        behind = (high - low) * sense > tolerance.length
        spans = np.sort(np.stack((low, high), axis=1)[behind], axis=1)
        found.append(OpenSide(axis, at, _joined(spans, tolerance)))
    return tuple(found)


def _joined(spans: Floats, tolerance: Tolerance) -> Floats:
    """Intervals in any order as disjoint ones on the grid, ascending."""
    spans = np.rint(spans[np.argsort(spans[:, 0], kind="stable")] / tolerance.grid)
    if not len(spans):
        return spans
    spans *= tolerance.grid
    reach = np.maximum.accumulate(spans[:, 1])
    first = np.concatenate(([True], spans[1:, 0] > reach[:-1] + tolerance.length))
    last = np.concatenate((first[1:], [True]))
    return np.stack((spans[first, 0], reach[last]), axis=1)


def split_where_closed(
    points: Floats, following: Ints, sides: Iterable[OpenSide], tolerance: Tolerance
) -> tuple[Floats, Ints]:
    """The border with vertices where an open side becomes closed; they come after the others."""
    edges = [np.empty(0, dtype=np.int32)]
    places = [np.empty((0, 2))]
    for side in sides:
        ends = side.closed.reshape(-1)
        on = side.edges(points, following)
        if not len(ends) or not len(on):
            continue
        low = np.minimum(points[on, side.along], points[following[on], side.along])
        high = np.maximum(points[on, side.along], points[following[on], side.along])
        order = np.argsort(low)
        slot = np.searchsorted(low[order], ends, side="right") - 1
        edge = order[np.maximum(slot, 0)]
        inside = (slot >= 0) & (ends > low[edge] + tolerance.length)
        inside &= ends < high[edge] - tolerance.length
        place = np.empty((int(np.count_nonzero(inside)), 2))
        place[:, side.axis] = side.at
        place[:, side.along] = ends[inside]
        edges.append(on[edge[inside]])
        places.append(place)
    return split(points, following, np.concatenate(edges), np.concatenate(places))


def open_edges(points: Floats, following: Ints, sides: Iterable[OpenSide]) -> Bools:
    """(n,) which edges are open: on an open side, with no obstacle right behind it there."""
    is_open = np.zeros(len(points), dtype=np.bool_)
    for side in sides:
        on = side.edges(points, following)
        is_open[on] = True
        if not len(side.closed):
            continue
        middle = 0.5 * (points[on, side.along] + points[following[on], side.along])
        slot = np.searchsorted(side.closed[:, 0], middle, side="right") - 1
        behind = (slot >= 0) & (middle < side.closed[slot, 1])
        is_open[on[behind]] = False
    return is_open
