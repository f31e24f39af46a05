"""Taking many small pieces from a large area: what they do not touch stays as it is.

A polygon is a shell with holes. A piece that touches none of them becomes one more hole, and a
crowd of pieces around holes becomes a new hole; the shell is looked at only where pieces reach it.
So each overlay is as small as its crowd, and where one fails, it fails alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area, grid_of
from preimage.geometry.overlay import ALONE, groups

Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Shapes = NDArray[np.object_]


FEW = 8
"""Up to so many pieces are taken from a polygon at once."""


def subtracted(area: Area, pieces: Shapes) -> Area | None:
    """The area without the interiors of the pieces, crowd by crowd.

    Parameters
    ----------
    pieces : (k,) polygons of shapely's that meet the area.

    Returns
    -------
    None where the answer is no valid area, which rounding may cause: then all is to be done at
    once, with more care.

    Raises
    ------
    shapely.GEOSException : GEOS refuses an overlay.

    >>> holed = Area.polygon(
    ...     np.array([(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]),
    ...     [np.array([(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)])],
    ... )
    >>> boxes = shapely.box([1.5, 5.0, 8.0], [1.0, 5.0, 8.0], [3.0, 6.0, 10.0], [2.0, 6.0, 10.0])
    >>> left = subtracted(holed, boxes)
    >>> left.measure, len(left.rings)
    (77.0, 3)
    """
    polygons = shapely.get_parts(area.geometry)
    owner, piece = shapely.STRtree(pieces).query(polygons, predicate="intersects")
    apart = ALONE * grid_of(area)
    first = np.searchsorted(owner, np.arange(len(polygons) + 1))
    order = np.lexsort((piece, owner))
    left: list[Shapes] = []
    for place, polygon in enumerate(polygons):
        taken = pieces[piece[order[first[place] : first[place + 1]]]]
        rest = _without(polygon, taken, apart) if len(taken) else polygons[place : place + 1]
        if rest is None:
            return None
        left.append(rest)
    whole = np.concatenate(left)
    if not len(whole):
        return Area.empty()
    geometry = whole[0] if len(whole) == 1 else shapely.multipolygons(whole)
    return Area(geometry) if shapely.is_valid(geometry) else None


def _without(polygon: shapely.Polygon, pieces: Shapes, apart: float) -> Shapes | None:
    """What is left of one polygon; `apart` is how far crowds are from each other and the shell."""
    if len(pieces) <= FEW:
        return _polygons(shapely.difference(polygon, shapely.union_all(pieces)))
    exterior, holes = shapely.get_exterior_ring(polygon), _holes(polygon)
    members = np.concatenate((pieces, holes))
    crowd = groups(members, apart)
    busy = np.zeros(len(members), dtype=np.bool_)
    busy[crowd[: len(pieces)]] = True
    busy = busy[crowd]
    shapely.prepare(exterior)
    outer = np.zeros(len(members), dtype=np.bool_)
    outer[crowd[busy & shapely.dwithin(exterior, members, apart)]] = True
    outer = outer[crowd]

    body = shapely.polygons(exterior)
    if np.any(outer):
        body = shapely.difference(body, shapely.union_all(members[outer]))
    crowds = _unions(members[busy & ~outer], crowd[busy & ~outer])
    if crowds is None:
        return None
    bodies, still = _polygons(body), members[~busy]
    return _punched(
        np.concatenate((bodies, crowds.pockets)),
        np.concatenate((np.full(len(bodies), -1), crowds.pocket_of)),
        np.concatenate((crowds.outlines, still)),
        np.concatenate((crowds.outline_of, np.full(len(still), -2))),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Crowds:
    """Unions of pieces and holes that hang together.

    Parameters
    ----------
    outlines, outline_of : (k,) what a crowd covers together with its pockets, and which crowd.
    pockets, pocket_of : (j,) what a crowd encloses, and which crowd.
    """

    outlines: Shapes
    outline_of: Indices
    pockets: Shapes
    pocket_of: Indices


def _unions(members: Shapes, crowd: Indices) -> _Crowds | None:
    """The union of each crowd; None if one misses what it unites."""
    if not len(members):
        return _Crowds(members, crowd, members, crowd)
    order = np.argsort(crowd, kind="stable")
    begins = np.flatnonzero(np.diff(crowd[order], prepend=-1))
    parts = np.split(members[order], begins[1:])
    united = [shapely.union_all(some) if len(some) > 1 else some[0] for some in parts]
    number = np.arange(len(united))
    whose = np.repeat(number, [len(some) for some in parts])
    middle = shapely.point_on_surface(members[order])
    if not np.all(shapely.intersects(np.array(united, dtype=np.object_)[whose], middle)):
        return None
    outlines, pockets = zip(*map(_outline, united), strict=True)
    return _Crowds(
        np.concatenate(outlines),
        np.repeat(number, [len(some) for some in outlines]),
        np.concatenate(pockets),
        np.repeat(number, [len(some) for some in pockets]),
    )


def _outline(shape: shapely.Geometry) -> tuple[Shapes, Shapes]:
    """What a shape covers together with its pockets; the pockets, which it encloses."""
    if shape.geom_type == "Polygon":
        return np.array([shapely.polygons(shapely.get_exterior_ring(shape))]), _holes(shape)
    # polygons that touch one another may enclose a pocket together
    xmin, ymin, xmax, ymax = shape.bounds
    wide, high = xmax - xmin, ymax - ymin
    box = shapely.box(xmin - wide, ymin - high, xmax + wide, ymax + high)
    rest = _polygons(shapely.difference(box, shape))
    around = int(np.argmax(shapely.area(shapely.envelope(rest))))
    return _holes(rest[around]), np.delete(rest, around)


def _punched(bodies: Shapes, body_of: Indices, gone: Shapes, gone_of: Indices) -> Shapes | None:
    """Bodies without the polygons that lie inside them, each in the smallest that holds it.

    Parameters
    ----------
    body_of, gone_of : the crowds that these belong to: a crowd is in none of its own pockets.
    """
    if not len(gone):
        return bodies
    if not len(bodies):
        return None
    inside = shapely.point_on_surface(gone)
    hole, body = shapely.STRtree(bodies).query(inside, predicate="intersects")
    other = body_of[body] != gone_of[hole]
    hole, body = hole[other], body[other]
    order = np.lexsort((shapely.area(bodies[body]), hole))
    hole, body = hole[order], body[order]
    nearest = np.flatnonzero(np.diff(hole, prepend=-1))
    if len(nearest) < len(gone):
        return None
    owner = body[nearest]
    rings = shapely.get_exterior_ring(gone)[np.argsort(owner, kind="stable")]
    first = np.searchsorted(np.sort(owner), np.arange(len(bodies) + 1))
    punched = [
        shapely.polygons(
            shapely.get_exterior_ring(polygon),
            holes=np.concatenate((shapely.get_rings(polygon)[1:], rings[begin:end])),
        )
        if begin < end
        else polygon
        for polygon, begin, end in zip(bodies, first[:-1], first[1:], strict=True)
    ]
    return np.array(punched, dtype=np.object_)


def _holes(polygon: shapely.Polygon) -> Shapes:
    """The holes of a polygon, as polygons."""
    holes: Shapes = shapely.polygons(shapely.get_rings(polygon)[1:])
    return holes


def _polygons(geometry: shapely.Geometry) -> Shapes:
    """The polygons of what an overlay returned."""
    parts: Shapes = shapely.get_parts(geometry)
    sound: Bools = (shapely.get_type_id(parts) == POLYGON) & ~shapely.is_empty(parts)
    return parts[sound]


POLYGON = 3
"""What GEOS calls a polygon."""
