"""Borders without near misses: what is as good as touching shares its vertices exactly."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area
from preimage.geometry.border import border, identified
from preimage.geometry.edge_index import EdgeIndex
from preimage.geometry.overlay import on_grid

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bools = NDArray[np.bool_]
Box = tuple[float, float, float, float]

ROUNDS = 16
"""Bending edges to meet a vertex may bring them near another; this often is looked again."""


def welded(area: Area, window: Box, near: float, grid: float) -> Area:
    """An area in a window, with what is nearer than `near` brought together.

    Afterwards all vertices lie on the grid, those near a side of the window on that side; no
    edge is as short as `near`; and no vertex is within `near` of an edge that does not end there.
    Slits that narrow are closed, necks that narrow become pinches, walls that thin vanish.
    Nothing moves by more than a few times `near`.

    Parameters
    ----------
    window : `xmin, ymin, xmax, ymax`, on the grid.
    """

    def moved(points: Floats) -> Floats:
        return _on_sides(on_grid(points, grid), window, near)

    points, following = border(area)
    place, vertex = identified(moved(points))
    tail, head = vertex, vertex[following]
    before = len(tail)
    tail, head = _without_opposites(tail, head)
    changed = len(tail) < before
    for _ in range(ROUNDS):
        point, edge, along = _near_misses(place, tail, head, near)
        if not len(point):
            break
        changed = True
        pairs = _to_merge(place, tail, head, point, edge, near)
        if len(pairs):
            stays = _merged(len(place), pairs)
            tail, head = stays[tail], stays[head]
        else:
            tail, head = _through(tail, head, point, edge, along)
        tail, head = _without_opposites(tail, head)
    if changed:
        return area_left_of(place[tail], place[head])
    same = shapely.transform(area.geometry, moved)
    return Area.of(same if same.is_valid else shapely.make_valid(same))


def _on_sides(points: Floats, window: Box, near: float) -> Floats:
    """Points near a side of the window moved onto it."""
    moved = points.copy()
    for axis, at in ((0, window[0]), (0, window[2]), (1, window[1]), (1, window[3])):
        moved[np.abs(points[:, axis] - at) <= near, axis] = at
    return moved


def _near_misses(place: Floats, tail: Ints, head: Ints, near: float) -> tuple[Ints, Ints, Floats]:
    """Vertices near an edge that does not end there, and the ends of edges that are too short."""
    used = np.unique(np.concatenate((tail, head)))
    index = EdgeIndex(place[tail], place[head])
    asked, edge, along = index.near_points(place[used], near)
    point = used[asked]
    short = np.hypot(*(place[head] - place[tail]).T) <= near
    miss = ((point != tail[edge]) & (point != head[edge])) | short[edge]
    return point[miss], edge[miss], along[miss]


def _to_merge(place: Floats, tail: Ints, head: Ints, point: Ints, edge: Ints, near: float) -> Ints:
    """(k, 2) vertices that are near one another."""
    pairs = np.concatenate(
        (np.stack((point, tail[edge]), axis=1), np.stack((point, head[edge]), axis=1))
    )
    gap = place[pairs[:, 0]] - place[pairs[:, 1]]
    close = (np.hypot(gap[:, 0], gap[:, 1]) <= near) & (pairs[:, 0] != pairs[:, 1])
    return np.unique(np.sort(pairs[close], axis=1), axis=0).astype(np.int32)


def _merged(count: int, pairs: Ints) -> Ints:
    """(count,) the vertex that each one becomes: itself, or a near one that stays.

    First come, first served: each vertex goes to one that stays, so that a long row of near
    vertices is thinned out and does not collapse.
    """
    stays = np.arange(count, dtype=np.int32)
    for low, high in pairs.tolist():
        if stays[low] == low and stays[high] == high:
            stays[high] = low
    return stays


def _through(tail: Ints, head: Ints, point: Ints, edge: Ints, along: Floats) -> tuple[Ints, Ints]:
    """The edges led through the points in their interior."""
    order = np.lexsort((point, along, edge))
    point, edge = point[order], edge[order]
    more = np.bincount(edge, minlength=len(tail))
    first = np.concatenate(([0], np.cumsum(1 + more)))
    tails = np.empty(first[-1], dtype=np.int32)
    rank = np.arange(len(edge)) - np.searchsorted(edge, edge)
    tails[first[:-1]] = tail
    tails[first[edge] + 1 + rank] = point
    heads = np.empty_like(tails)
    heads[:-1] = tails[1:]
    heads[first[1:] - 1] = head
    return tails, heads


def _without_opposites(tail: Ints, head: Ints) -> tuple[Ints, Ints]:
    """The edges less those without length, and less pairs that run against each other."""
    keys = _pair(np.minimum(tail, head), np.maximum(tail, head))
    key, index = np.unique(keys, return_inverse=True)
    net = np.bincount(index.reshape(-1), weights=np.sign(head - tail), minlength=len(key))
    net[key >> 32 == key & 0xFFFFFFFF] = 0
    low, high = (key >> 32).astype(np.int32), (key & 0xFFFFFFFF).astype(np.int32)
    up, down = net > 0, net < 0
    return np.concatenate((low[up], high[down])), np.concatenate((high[up], low[down]))


def area_left_of(starts: Floats, ends: Floats) -> Area:
    """The area with the given border: `(n, 2)` edges, the area on the left of each.

    >>> corners = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])
    >>> area_left_of(corners, np.roll(corners, -1, axis=0)).measure
    2.0
    """
    lines = shapely.linestrings(np.stack((starts, ends), axis=1))
    faces = shapely.get_parts(shapely.polygonize(lines))
    if not len(faces):
        return Area.empty()
    faces = shapely.orient_polygons(faces, exterior_cw=False)
    points, face = shapely.get_coordinates(faces, return_index=True)
    first = np.searchsorted(face, np.arange(len(faces)))
    _, place = identified(np.concatenate((starts, ends, points)))
    count = len(starts)
    edges = _pair(place[:count], place[count : 2 * count])
    sides = _pair(place[2 * count + first], place[2 * count + first + 1])
    return Area.of(shapely.multipolygons(faces[np.isin(sides, edges)]))


def _pair(first: Ints, second: Ints) -> NDArray[np.int64]:
    """Two numbers as one."""
    both: NDArray[np.int64] = first.astype(np.int64) << 32 | second
    return both
