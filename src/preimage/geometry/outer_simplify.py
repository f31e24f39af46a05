"""Simpler borders around an area: nothing of it is lost, nothing far from it is added.

A run of the border is replaced by the edge between its ends where the run lies on the inner side
of that edge, nowhere further from it than the tolerance. What the edge adds, the pocket between it
and the run, then lies within the tolerance of the run: whoever leaves the edge at a right angle,
inward, meets it in time. Edges are chosen greedily, each as far ahead as the directions that are
left allow (the cone of Imai and Iri 1988, one side of it on the safe side).
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from preimage.geometry.area import Area, Floats

WIDEST = 0.5 * math.pi
"""How far a run may turn from its first edge, either way, seen from its beginning."""


def simplified_outward(area: Area, tolerance: float, grid: float) -> tuple[Area, ...]:
    """Areas with fewer vertices that contain `area` together and stay within `tolerance` of it.

    One for each polygon, in their order; they may overlap.

    Parameters
    ----------
    area : with valid polygons; holes may touch their shells.
    tolerance : a length, 0 or more; at 0 the polygons themselves.
    grid : a spacing of rounding, far below the tolerance: where borders of the simplified polygons
        cross, the polygons are united, and crossings are put on that grid.

    >>> stairs = Area.polygon(np.array([[0, 0], [3, 0], [3, 1], [2, 1], [2, 2], [1, 2], [1, 3]]))
    >>> simplified_outward(stairs, 1.0, 2.0**-30)[0].rings[0].tolist()
    [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 3.0]]
    """
    if area.is_empty or tolerance <= 0.0:
        return () if area.is_empty else area.parts
    parts = shapely.get_parts(area.geometry)
    return tuple(Area(_polygon(part, tolerance, grid)) for part in parts)


def _polygon(polygon: BaseGeometry, tolerance: float, grid: float) -> BaseGeometry:
    rings = [polygon.exterior, *polygon.interiors]
    kept = []
    for place, ring in enumerate(rings):
        points = shapely.get_coordinates(ring)[:-1]
        if ring.is_ccw != (place == 0):
            points = points[::-1]
        points = np.roll(points, -int(np.lexsort((points[:, 1], points[:, 0]))[0]), axis=0)
        kept.append((points, _kept(points.tolist(), tolerance)))
    simple = _assembled(kept)
    if simple is not None:
        return simple
    pockets = [pocket for points, numbers in kept for pocket in _pockets(points, numbers)]
    united = shapely.union_all([polygon, *pockets], grid_size=grid)
    return Area.of(united).geometry


def _assembled(kept: list[tuple[Floats, list[int]]]) -> BaseGeometry | None:
    """The polygon of the simplified rings, without closed holes; nothing if they cross."""
    rings = [points[numbers] for points, numbers in kept]
    if len(rings[0]) < 3:
        return None
    holes = [ring for ring in rings[1:] if len(ring) >= 3]
    if any(shapely.is_ccw(shapely.LinearRing(hole)) for hole in holes):
        return None
    polygon = shapely.Polygon(rings[0], holes)
    return polygon if shapely.is_valid(polygon) else None


def _pockets(points: Floats, numbers: list[int]) -> list[BaseGeometry]:
    """What the edges between the vertices that are kept add, run by run."""
    count = len(points)
    pockets = []
    for i, j in zip(numbers, [*numbers[1:], numbers[0] + count], strict=True):
        if j - i > 1:
            pockets.append(shapely.Polygon(points[np.arange(i, j + 1) % count]))
    return [pocket for pocket in pockets if pocket.area > 0.0]


def _kept(points: list[list[float]], tolerance: float) -> list[int]:
    """The numbers of the vertices of a ring, with the area on its left, that are kept."""
    count = len(points)
    kept = [0]
    i = 0
    while True:
        i = _farthest(points, i, count, tolerance)
        if i >= count:
            return kept
        kept.append(i)


def _farthest(points: list[list[float]], i: int, count: int, tolerance: float) -> int:
    """The last vertex to which the border may go straight from vertex `i`; `count` is vertex 0.

    A direction to vertex `j` is good if no vertex between lies to the right of it, and none further
    to the left than the tolerance.
    """
    x, y = points[i]
    first = points[(i + 1) % count]
    ahead = math.atan2(first[1] - y, first[0] - x)
    best = i + 1
    low, high = -WIDEST, WIDEST  # directions that are left, from the first edge
    for j in range(i + 1, count + 1):
        px, py = points[j % count]
        dx, dy = px - x, py - y
        apart = math.hypot(dx, dy)
        if apart == 0.0:
            break
        turn = math.remainder(math.atan2(dy, dx) - ahead, math.tau)
        if abs(turn) > WIDEST:
            break
        if low <= turn <= high:
            best = j
        high = min(high, turn)
        if apart > tolerance:
            low = max(low, turn - math.asin(tolerance / apart))
        if low > high:
            break
    return best
