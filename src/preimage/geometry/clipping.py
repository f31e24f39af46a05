"""Edges against areas: which parts of straight edges an area holds."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area
from preimage.geometry.border import border
from preimage.geometry.edge_index import EdgeIndex, Floats, Ints

Bools = NDArray[np.bool_]


def parts_inside(edges: EdgeIndex, area: Area, near: float) -> tuple[Ints, Floats, Floats]:
    """The parts of edges that lie in a closed area or along its border.

    Each edge is cut where it meets the area's border, and a piece belongs if its middle is in the
    area. Lengths up to `near` are ties: an edge that runs that close to the border lies on it,
    and pieces that short are left out.

    Returns
    -------
    edge : (k,) in ascending order.
    low, high : (k,) the parts, as distances from the edge's start; ascending on each edge.

    >>> edges = EdgeIndex(np.array([[-1.0, 0.0]]), np.array([[5.0, 0.0]]))
    >>> [answer.tolist() for answer in parts_inside(edges, Area.box(0, 0, 2, 1), 1e-9)]
    [[0], [1.0], [3.0]]
    """
    candidates = edges.near_area(area, near)
    if not len(candidates):
        return candidates, np.empty(0), np.empty(0)
    starts, ends = edges.starts[candidates], edges.ends[candidates]
    length = np.hypot(*(ends - starts).T)
    local = EdgeIndex(starts, ends)
    edge, cut = _cuts(local, length, area, near)
    edge = np.concatenate((edge, np.arange(len(starts)), np.arange(len(starts))))
    cut = np.concatenate((cut, np.zeros(len(starts)), length))
    order = np.lexsort((cut, edge))
    edge, cut = edge[order], cut[order]
    piece = np.flatnonzero((edge[1:] == edge[:-1]) & (cut[1:] - cut[:-1] > 0.0))
    owner, low, high = edge[piece], cut[piece], cut[piece + 1]
    unit = (ends - starts) / length[:, None]
    middle = starts[owner] + (0.5 * (low + high))[:, None] * unit[owner]
    kept = reaches(area, middle, near)
    owner, low, high = owner[kept], low[kept], high[kept]
    return _joined(candidates[owner], low, high, near)


def reaches(area: Area, points: Floats, distance: float) -> Bools:
    """(n,) which of (n, 2) points are in the closed area or at most `distance` from it."""
    if area.is_empty:
        return np.zeros(len(points), dtype=np.bool_)
    shapely.prepare(area.geometry)
    within: Bools = shapely.dwithin(area.geometry, shapely.points(points), distance)
    return within


def distances(points: Floats, area: Area, starts: Floats, ends: Floats) -> Floats:
    """(n,) how far (n, 2) points are from an area and segments together; infinite from nothing.

    Parameters
    ----------
    starts, ends : (k, 2) the segments, which may be points.
    """
    apart = np.full(len(points), np.inf)
    places = shapely.points(points)
    if not area.is_empty:
        apart = np.minimum(apart, shapely.distance(area.geometry, places))
    if len(starts):
        lines = shapely.multilinestrings(shapely.linestrings(np.stack((starts, ends), axis=1)))
        apart = np.minimum(apart, shapely.distance(lines, places))
    return apart


def _cuts(edges: EdgeIndex, length: Floats, area: Area, near: float) -> tuple[Ints, Floats]:
    """Where edges meet the border of an area, and where its corners lie on them."""
    points, following = border(area)
    ends = points[following]
    _, on, along = edges.near_points(points, near)
    segment, edge = edges.near_segments(points, ends, near)
    p, r = edges.starts[edge], edges.ends[edge] - edges.starts[edge]
    q, s = points[segment], ends[segment] - points[segment]
    across = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    gap = q - p
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (gap[:, 0] * s[:, 1] - gap[:, 1] * s[:, 0]) / across
        u = (gap[:, 0] * r[:, 1] - gap[:, 1] * r[:, 0]) / across
    meets = (t > 0.0) & (t < 1.0) & (u >= 0.0) & (u <= 1.0)
    return (
        np.concatenate((on, edge[meets])),
        np.concatenate((along, t[meets] * length[edge[meets]])),
    )


def _joined(edge: Ints, low: Floats, high: Floats, near: float) -> tuple[Ints, Floats, Floats]:
    """Sorted pieces, those that meet joined, without those too short."""
    if not len(edge):
        return edge.astype(np.int32), low, high
    begins = np.concatenate(([True], (edge[1:] != edge[:-1]) | (low[1:] > high[:-1] + near)))
    ends = np.concatenate((begins[1:], [True]))
    edge, low, high = edge[begins], low[begins], high[ends]
    long = high - low > near
    return edge[long].astype(np.int32), low[long], high[long]
