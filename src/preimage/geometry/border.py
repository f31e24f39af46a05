"""Borders of areas as flat arrays: directed edges with the area on their left."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


def border(area: Area) -> tuple[Floats, Ints]:
    """All rings of an area at once, ring after ring.

    Returns
    -------
    points : (n, 2) the vertices; one that belongs to several rings is there once for each.
    next : (n,) the vertex at which the edge that starts at vertex `i` ends; the area is on the
        left of every edge.

    >>> points, following = border(Area.box(0, 0, 2, 1))
    >>> len(points), following.tolist()
    (4, [1, 2, 3, 0])
    """
    if area.is_empty:
        return np.empty((0, 2)), np.empty(0, dtype=np.int32)
    # shapely's own choice of the side is "exteriors counter-clockwise", which is ours
    geometry = shapely.orient_polygons(area.geometry, exterior_cw=False)
    _, closed, offsets = shapely.to_ragged_array(shapely.get_parts(geometry))
    starts = np.asarray(offsets[0], dtype=np.int64)
    keep = np.ones(len(closed), dtype=np.bool_)
    keep[starts[1:] - 1] = False  # the closing vertex of each ring
    points = np.asarray(closed[keep], dtype=np.float64) + 0.0
    first = starts[:-1] - np.arange(len(starts) - 1)
    last = starts[1:] - np.arange(1, len(starts)) - 1
    following = np.arange(1, len(points) + 1, dtype=np.int32)
    following[last] = first
    return points, following


def stored_segments(area: Area) -> tuple[Floats, Floats]:
    """(m, 2) starts and ends of all segments of the border, in the directions that GEOS has them.

    So distances from them can be computed as GEOS does, to the last bit.

    >>> starts, ends = stored_segments(Area.box(0, 0, 2, 1))
    >>> (starts[0] == ends[-1]).all()
    np.True_
    """
    if area.is_empty:
        return np.empty((0, 2)), np.empty((0, 2))
    _, closed, offsets = shapely.to_ragged_array(shapely.get_parts(area.geometry))
    points = np.asarray(closed, dtype=np.float64)
    inner = np.ones(len(points) - 1, dtype=np.bool_)
    inner[np.asarray(offsets[0], dtype=np.int64)[1:-1] - 1] = False  # from ring to ring
    return points[:-1][inner], points[1:][inner]


def identified(points: Floats) -> tuple[Floats, Ints]:
    """The different ones among points, and the place of each point among them.

    >>> different, index = identified(np.array([[1.0, 0.0], [0.0, 2.0], [1.0, 0.0]]))
    >>> different.tolist(), index.tolist()
    ([[0.0, 2.0], [1.0, 0.0]], [1, 0, 1])
    """
    different, index = np.unique(_numbers(points), return_inverse=True)
    return different.view(np.float64).reshape(-1, 2), index.reshape(-1).astype(np.int32)


def present(points: Floats, among: Floats) -> NDArray[np.bool_]:
    """(n,) which of (n, 2) points are among others, exactly."""
    return np.isin(_numbers(points), _numbers(among))


def _numbers(points: Floats) -> NDArray[np.complex128]:
    """Points as complex numbers, which are sorted much faster than rows."""
    return np.ascontiguousarray(points + 0.0).view(np.complex128).reshape(-1)


def without_vertices(area: Area, gone: NDArray[np.bool_]) -> Area:
    """The area whose rings leave out vertices, at least three of each ring staying.

    Parameters
    ----------
    gone : (n,) for the vertices in the order of `border`.

    >>> bent = Area.polygon(np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]))
    >>> points, _ = border(bent)
    >>> without_vertices(bent, (points == (1.0, 0.0)).all(axis=1)).corners
    4
    """
    geometry = shapely.orient_polygons(area.geometry, exterior_cw=False)
    _, closed, (rings, parts) = shapely.to_ragged_array(shapely.get_parts(geometry))
    first = np.asarray(rings[:-1]) - np.arange(len(rings) - 1)
    points = np.delete(closed, np.asarray(rings[1:]) - 1, axis=0)
    ring = np.repeat(np.arange(len(first)), np.diff(np.append(first, len(points))))
    left = shapely.linearrings(points[~gone], indices=ring[~gone])
    owner = np.repeat(np.arange(len(parts) - 1), np.diff(parts))
    polygons = shapely.polygons(left, indices=owner)
    return Area(polygons[0] if len(polygons) == 1 else shapely.multipolygons(polygons))


def split(points: Floats, following: Ints, edge: Ints, places: Floats) -> tuple[Floats, Ints]:
    """Loops with a new vertex at each of `places`, (k, 2), inside the edges `edge`, (k,).

    The new vertices come after the others.
    """
    if not len(edge):
        return points, following
    distance = np.hypot(*(places - points[edge]).T)
    order = np.lexsort((distance, edge))
    edge, places = edge[order], places[order]
    new = np.arange(len(points), len(points) + len(edge), dtype=np.int32)
    last = np.concatenate((edge[1:] != edge[:-1], [True]))
    first = np.concatenate(([True], last[:-1]))
    linked = np.concatenate((following, np.where(last, following[edge], new + 1)))
    linked[edge[first]] = new[first]
    return np.concatenate((points, places)), linked.astype(np.int32)
