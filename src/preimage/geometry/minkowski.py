"""Minkowski sums of polygons, convex or not, with or without holes."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area, Floats
from preimage.geometry.border import border
from preimage.geometry.overlay import united_shapes

Shapes = NDArray[np.object_]


def minkowski_sum(a: Area, b: Area, grid: float) -> Area:
    """`a (+) b = {p + q : p in a, q in b}`, regularised: slits without width are closed.

    With `b` cut into convex parts `P`, and any `p` of `P`,

        a (+) P = (a + p)  union  hull(e (+) P), over the edges e of the border of a,

    since a path from `p` to another point of `P` carries a point of `a` to one outside `a + p`
    only across the border. Holes need no treatment of their own. A convex polygon of `a` gives
    the hull of all its corners' sums at once. (theory 1, paper 3.1)

    Parameters
    ----------
    grid : where the sum is noded. With both areas on it, all corners' sums are exact, and edges
        of the two that are parallel fall together in the sum.

    >>> minkowski_sum(Area.box(0, 0, 2, 1), Area.box(-1, 0, 0, 3), 2.0**-20).bounds
    (-1.0, 0.0, 2.0, 4.0)
    """
    if a.is_empty or b.is_empty:
        return Area.empty()
    polygons = shapely.get_parts(a.geometry)
    convex = _convex(polygons)
    corners, owner = shapely.get_coordinates(polygons[convex], return_index=True)
    bent = Area(shapely.multipolygons(polygons[~convex]))
    points, following = border(bent)
    ends = np.concatenate((points, points[following]))
    edge = np.tile(np.arange(len(points)), 2)
    pieces: list[Shapes] = []
    for part in convex_parts(b):
        pieces.append(_hulls(corners, owner, part))
        pieces.append(_hulls(ends, edge, part))
        pieces.append(np.array([_moved(bent, part[0])]))
    return Area.of(united_shapes(np.concatenate(pieces), grid))


def convex_parts(area: Area) -> list[Floats]:
    """Convex polygons, `(n, 2)` counter-clockwise, whose union is the area."""
    polygons = shapely.get_parts(area.geometry)
    convex = _convex(polygons)
    triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(polygons[~convex]))
    parts = shapely.orient_polygons(
        np.concatenate((shapely.convex_hull(polygons[convex]), shapely.get_parts(triangles))),
        exterior_cw=False,
    )
    return [shapely.get_coordinates(part)[:-1] for part in parts]


def _convex(polygons: Shapes) -> NDArray[np.bool_]:
    convex: NDArray[np.bool_] = shapely.area(shapely.convex_hull(polygons)) == shapely.area(
        polygons
    )
    return convex


def _hulls(points: Floats, owner: NDArray[np.intp], part: Floats) -> Shapes:
    """For each owner, the hull of its points (+) a convex part; owners are numbered from 0."""
    order = np.argsort(owner, kind="stable")
    sums = (points[order, None, :] + part[None, :, :]).reshape(-1, 2)
    hulls: Shapes = shapely.convex_hull(
        shapely.multipoints(sums, indices=np.repeat(owner[order], len(part)))
    )
    return hulls


def _moved(area: Area, by: Floats) -> shapely.Geometry:
    return shapely.transform(area.geometry, lambda points: points + by)
