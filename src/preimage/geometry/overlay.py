"""Unions, intersections and differences on a grid, fast where most polygons stand alone.

On a grid because they must not fail: where borders nearly coincide, overlays in floating
arithmetic now and then lose whole polygons without a word (GEOS 3.14), snap rounding does not.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area, Floats

Bools = NDArray[np.bool_]
Shapes = NDArray[np.object_]
Box = tuple[float, float, float, float]

ALONE = 4.0
"""Polygons that are so many spacings of the grid apart do not meet on it."""


def on_grid(values: Floats, grid: float) -> Floats:
    """Coordinates moved to the nearest multiple of `grid`."""
    moved: Floats = np.rint(values / grid) * grid + 0.0
    return moved


def united(areas: Sequence[Area], grid: float) -> Area:
    """The union of areas, noded on a grid, so that what touches shares its vertices.

    >>> united([Area.box(0, 0, 1, 1), Area.box(1, 0, 2, 1)], 2.0**-20).measure
    2.0
    """
    return Area(united_shapes(np.array([area.geometry for area in areas], dtype=object), grid))


def united_shapes(shapes: Shapes, grid: float) -> shapely.Geometry:
    """The same for polygons of shapely's."""
    polygons = _parts(shapes)
    if not len(polygons):
        return shapely.Polygon()
    group = groups(polygons, ALONE * grid)
    order = np.argsort(group, kind="stable")
    first = np.flatnonzero(np.diff(group[order], prepend=-1))
    crowds = np.split(polygons[order], first[1:])
    single = np.array([len(crowd) == 1 for crowd in crowds])
    alone = shapely.set_precision(polygons[order][first[single]], grid)
    united_crowds = [
        Area.of(shapely.union_all(crowd, grid_size=grid)).geometry
        for crowd in crowds
        if len(crowd) > 1
    ]
    whole = _parts(np.array([*alone, *united_crowds], dtype=object))
    return whole[0] if len(whole) == 1 else shapely.multipolygons(whole)


def common(a: Area, b: Area, grid: float) -> Area:
    """The points of both, regularised and noded on a grid.

    >>> common(Area.box(0, 0, 2, 2), Area.box(1, 1, 3, 3), 2.0**-20).measure
    1.0
    """
    return Area.of(shapely.intersection(a.geometry, b.geometry, grid_size=grid))


def box_without(box: Box, area: Area, grid: float) -> Area:
    """The part of a box outside an area, noded on a grid.

    Parameters
    ----------
    box : `xmin, ymin, xmax, ymax`, on the grid.

    >>> box_without((0, 0, 4, 4), Area.box(1, 1, 2, 2), 2.0**-20).measure
    15.0
    """
    polygons = _parts(area.geometry)
    islands = _alone(polygons, ALONE * grid) & _strictly_inside(polygons, box)
    islands &= shapely.get_num_interior_rings(polygons) == 0
    rest = shapely.multipolygons(polygons[~islands])
    left = Area.of(shapely.difference(shapely.box(*box), rest, grid_size=grid))
    if not islands.any():
        return left
    rings = shapely.transform(
        shapely.get_exterior_ring(polygons[islands]), lambda xy: on_grid(xy, grid)
    )
    return Area(_punched(_parts(left.geometry), rings))


def _punched(polygons: Shapes, rings: Shapes) -> shapely.Geometry:
    """Polygons with rings, each inside one of them, as more holes."""
    inner, outer = shapely.STRtree(polygons).query(
        shapely.get_point(rings, 0), predicate="intersects"
    )
    rings = rings[inner[np.argsort(outer, kind="stable")]]
    first = np.searchsorted(np.sort(outer), np.arange(len(polygons) + 1))
    punched = [
        shapely.polygons(
            shapely.get_exterior_ring(polygon),
            holes=np.concatenate((shapely.get_rings(polygon)[1:], rings[begin:end])),
        )
        for polygon, begin, end in zip(polygons, first[:-1], first[1:], strict=True)
    ]
    return shapely.multipolygons(punched) if len(punched) > 1 else punched[0]


def _parts(geometry: shapely.Geometry | Shapes) -> Shapes:
    """The polygons of a geometry, without empty ones."""
    polygons: Shapes = shapely.get_parts(geometry)
    return polygons[~np.asarray(shapely.is_empty(polygons), dtype=np.bool_)]


def _alone(polygons: Shapes, apart: float) -> Bools:
    """Which polygons are further than `apart` from all others."""
    one, _ = shapely.STRtree(polygons).query(polygons, predicate="dwithin", distance=apart)
    alone: Bools = np.bincount(one, minlength=len(polygons)) == 1
    return alone


def groups(polygons: Shapes, apart: float) -> NDArray[np.intp]:
    """(n,) the first of the polygons that hang together with each, over gaps up to `apart`."""
    one, other = shapely.STRtree(polygons).query(polygons, predicate="dwithin", distance=apart)
    group = np.arange(len(polygons))
    while True:
        least = group.copy()
        np.minimum.at(least, one, group[other])
        np.minimum.at(least, group[one], group[other])
        least = least[least]
        if np.array_equal(least, group):
            return group
        group = least


def _strictly_inside(polygons: Shapes, box: Box) -> Bools:
    bounds = shapely.bounds(polygons)
    inside: Bools = np.all(bounds[:, :2] > box[:2], axis=1) & np.all(
        bounds[:, 2:] < box[2:], axis=1
    )
    return inside
