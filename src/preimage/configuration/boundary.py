"""Contact space from free space: the border linked into loops, pinches taken apart."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from preimage.configuration.contact import Bools, ContactSpace, Floats, Ints
from preimage.configuration.sides import Box, open_edges, open_sides, split_where_closed
from preimage.geometry.area import Area
from preimage.geometry.border import border, identified
from preimage.geometry.tolerance import Tolerance
from preimage.task.workspace import Side


def contact_space(
    free: Area, obstacles: Area, window: Box, walls: Iterable[Side], tolerance: Tolerance
) -> ContactSpace:
    """The border of free space as features (theory 1).

    Free space is on the left of every edge. Where several parts of the border touch in a point,
    each wedge of free space has its own vertex there. Vertices within the tolerance of a straight
    line through their neighbours are left out, but for pinches and where an open side ends.

    Parameters
    ----------
    free : free space in the window, welded: whatever touches shares its vertices.
    obstacles : the C-obstacles, also some way beyond the window: where they reach an open side
        from there, it is contact.
    window : `xmin, ymin, xmax, ymax`, on the grid.
    walls : the sides of the window that are walls.
    """
    points, following = border(free)
    following, pinched = _take_pinches_apart(points, following)
    sides = open_sides(window, walls, obstacles, tolerance)
    points, following = split_where_closed(points, following, sides, tolerance)
    keep = np.zeros(len(points), dtype=np.bool_)
    keep[: len(pinched)] = pinched
    is_open = open_edges(points, following, sides)
    return _without_straight(points, following, is_open, keep, tolerance.length)


def _take_pinches_apart(points: Floats, following: Ints) -> tuple[Ints, Bools]:
    """Link the edges so that every wedge of free space around a pinch has its own vertex.

    The edge after an incoming one is the first that is met when turning clockwise from where the
    incoming one came from: free space, on the left of both, lies between them.

    Returns
    -------
    following : (n,) the vertex at which edge `i` ends.
    pinched : (n,) the vertices that are not alone in their place.
    """
    _, place = identified(points)
    pinched: Bools = np.bincount(place)[place] > 1
    there = np.flatnonzero(pinched).astype(np.int32)
    if not len(there):
        return following, pinched
    before = _inverse(following)[there]
    arms = np.concatenate((points[following[there]], points[before]))
    arms -= np.concatenate((points[there], points[there]))
    edge = np.concatenate((there, before))  # the edge that each arm is
    leaves = np.arange(len(arms)) < len(there)
    around = np.concatenate((place[there], place[there]))
    order = np.lexsort((np.arctan2(arms[:, 1], arms[:, 0]), around))
    edge, leaves, around = edge[order], leaves[order], around[order]
    # counter-clockwise around a point, arms that leave it and arms that come in take turns; what
    # comes in goes on along the arm just before it, cyclically
    earlier = np.arange(len(order)) - 1
    first = np.flatnonzero(np.concatenate(([True], around[1:] != around[:-1])))
    earlier[first] = np.concatenate((first[1:], [len(order)])) - 1
    comes = np.flatnonzero(~leaves)
    if not np.all(leaves[earlier[comes]]):
        raise ValueError("the border of free space crosses itself")
    linked = following.copy()
    linked[edge[comes]] = edge[earlier[comes]]
    return linked, pinched


def _inverse(following: Ints) -> Ints:
    """The edge that ends at each vertex."""
    previous = np.empty(len(following), dtype=np.int32)
    previous[following] = np.arange(len(following), dtype=np.int32)
    return previous


def _without_straight(
    points: Floats, following: Ints, is_open: Bools, keep: Bools, near: float
) -> ContactSpace:
    """The loops without the vertices at which nothing changes.

    No vertex that is left out is further than `near` from the edge that replaces its own: `bend`
    bounds how far each edge is from what it stands for.
    """
    bend = np.zeros(len(points))
    while True:
        previous = _inverse(following)
        back = points - points[previous]
        ahead = points[following] - points
        across = back + ahead
        reach = np.hypot(across[:, 0], across[:, 1])
        area = np.abs(back[:, 0] * ahead[:, 1] - back[:, 1] * ahead[:, 0])
        onwards = np.sum(back * ahead, axis=1) > 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            off = np.where(onwards, area / reach, np.inf) + np.maximum(bend, bend[previous])
        drop = (off <= near) & (is_open == is_open[previous]) & ~keep
        drop &= _first_of_neighbours(drop, previous, following)
        if not drop.any():
            return ContactSpace(points, following, is_open)
        gone, stays = np.flatnonzero(drop), ~drop
        following[previous[gone]] = following[gone]
        bend[previous[gone]] = off[gone]
        number = np.cumsum(stays) - 1
        following = number[following[stays]].astype(np.int32)
        points, is_open, keep, bend = points[stays], is_open[stays], keep[stays], bend[stays]


def _first_of_neighbours(drop: Bools, previous: Ints, following: Ints) -> Bools:
    """Of vertices in a row that all may go: no two neighbours, but about a third of them."""
    # ranks as good as random, so that a long row is thinned out in few rounds
    rank = (np.arange(len(drop), dtype=np.uint64) * np.uint64(0x9E3779B1)) & np.uint64(0xFFFFFFFF)
    later = drop[previous] & (rank > rank[previous])
    later |= drop[following] & (rank > rank[following])
    return np.asarray(~later, dtype=np.bool_)
