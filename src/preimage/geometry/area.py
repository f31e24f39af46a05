"""Areas: regular closed subsets of the plane with polygonal borders."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from preimage.geometry.tolerance import GRID_BITS

Floats = NDArray[np.float64]
Ring = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Area:
    """A regular closed set of the plane: nothing thinner than an area belongs to it.

    Parameters
    ----------
    geometry : a shapely Polygon or MultiPolygon, valid, possibly empty. Only the room `geometry`
        looks at it.
    """

    geometry: BaseGeometry

    @classmethod
    def of(cls, geometry: BaseGeometry) -> Area:
        """The polygons of a shapely geometry; its lines and points are dropped."""
        kind = geometry.geom_type
        if kind in ("Polygon", "MultiPolygon"):
            return cls(geometry)
        polygons = [
            part
            for part in shapely.get_parts(geometry)
            if part.geom_type in ("Polygon", "MultiPolygon")
        ]
        if len(polygons) == 1:
            return cls(polygons[0])
        return cls(shapely.union_all(polygons) if polygons else shapely.Polygon())

    @classmethod
    def empty(cls) -> Area:
        """The empty area."""
        return cls(shapely.Polygon())

    @classmethod
    def polygon(cls, exterior: Ring, holes: Iterable[Ring] = ()) -> Area:
        """The area bounded by simple rings: `(n, 2)` arrays, not closed, in any direction."""
        return cls(shapely.Polygon(exterior, list(holes)))

    @classmethod
    def box(cls, xmin: float, ymin: float, xmax: float, ymax: float) -> Area:
        """An axis-parallel rectangle."""
        return cls(shapely.box(xmin, ymin, xmax, ymax))

    @classmethod
    def from_rings(cls, points: Floats, start: NDArray[np.int32], shell: NDArray[np.int32]) -> Area:
        """The area with these rings, which may touch each other in points.

        Parameters
        ----------
        points : (p, 2) the rings' points, ring after ring, not closed.
        start : (r + 1,) where each ring begins in `points`, and their end.
        shell : (r,) of a hole the ring around it, of a shell itself.
        """
        if len(shell) <= _FEW_RINGS:
            geometry = _few_polygons(points, start.tolist(), shell.tolist())
        else:
            geometry = _many_polygons(points, start, shell)
        if not shapely.is_valid(geometry):
            geometry = shapely.make_valid(geometry, method="structure", keep_collapsed=False)
        return cls.of(geometry)

    @property
    def is_empty(self) -> bool:
        """Nothing belongs to it."""
        return bool(self.geometry.is_empty)

    @property
    def measure(self) -> float:
        """Its size, in the square of the unit of length."""
        return float(self.geometry.area)

    @property
    def perimeter(self) -> float:
        """The length of the border, holes included."""
        return float(self.geometry.length)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """`xmin, ymin, xmax, ymax`; NaN for the empty area."""
        xmin, ymin, xmax, ymax = self.geometry.bounds
        return xmin, ymin, xmax, ymax

    @property
    def corners(self) -> int:
        """How many vertices its border has."""
        rings = len(shapely.get_rings(shapely.get_parts(self.geometry)))
        return int(shapely.get_num_coordinates(self.geometry)) - rings

    @cached_property
    def parts(self) -> tuple[Area, ...]:
        """Its polygons, as areas."""
        return tuple(Area(part) for part in shapely.get_parts(self.geometry))

    @cached_property
    def rings(self) -> tuple[Ring, ...]:
        """Its border: `(n, 2)` arrays, not closed, with the area on the left of each."""
        rings: list[Ring] = []
        for polygon in shapely.get_parts(self.geometry):
            for place, ring in enumerate((polygon.exterior, *polygon.interiors)):
                points = shapely.get_coordinates(ring)
                inner = place > 0
                rings.append((points if ring.is_ccw != inner else points[::-1])[:-1])
        return tuple(rings)

    @cached_property
    def segments(self) -> tuple[Floats, Floats]:
        """Its border cut into segments: `(m, 2)` starts and `(m, 2)` ends, the area on the left."""
        if not self.rings:
            return np.empty((0, 2)), np.empty((0, 2))
        return (
            np.concatenate(self.rings),
            np.concatenate([np.roll(ring, -1, axis=0) for ring in self.rings]),
        )

    def contains(self, x: float, y: float) -> bool:
        """Whether the point belongs to the closed area."""
        return bool(shapely.intersects_xy(self.geometry, x, y))

    def contains_all(self, points: Floats) -> NDArray[np.bool_]:
        """The same for `(n, 2)` points."""
        shapely.prepare(self.geometry)
        inside: NDArray[np.bool_] = shapely.intersects_xy(self.geometry, points[:, 0], points[:, 1])
        return inside

    @property
    def inner_point(self) -> tuple[float, float]:
        """A point well inside; NaN for the empty area."""
        if self.is_empty:
            return float("nan"), float("nan")
        point = max(self.parts, key=lambda part: part.measure).geometry.representative_point()
        return float(point.x), float(point.y)

    def depth(self, x: float, y: float) -> float:
        """Distance of a point from the area's border; infinite if there is none."""
        if self.is_empty:
            return float("inf")
        return float(shapely.distance(shapely.boundary(self.geometry), shapely.Point(x, y)))

    def distance(self, x: float, y: float) -> float:
        """Distance of a point from the area; 0 inside, infinite from the empty area."""
        if self.is_empty:
            return float("inf")
        return float(shapely.distance(self.geometry, shapely.Point(x, y)))


_FEW_RINGS = 16
"""Up to so many rings, one call a polygon is faster than sorting them all."""


def _few_polygons(points: Floats, start: list[int], shell: list[int]) -> BaseGeometry:
    rings = [points[a:b] if b - a >= 3 else None for a, b in pairwise(start)]
    holes: dict[int, list[Ring]] = {}
    strays: list[Ring] = []
    for number, (ring, owner) in enumerate(zip(rings, shell, strict=True)):
        if ring is not None and owner != number:
            (holes.setdefault(owner, []) if owner >= 0 else strays).append(ring)
    polygons = [
        shapely.Polygon(ring, holes.get(number))
        for number, ring in enumerate(rings)
        if ring is not None and shell[number] == number
    ]
    geometry = polygons[0] if len(polygons) == 1 else shapely.MultiPolygon(polygons)
    for stray in strays:
        geometry = shapely.difference(geometry, shapely.Polygon(stray))
    return geometry


def _many_polygons(
    points: Floats, start: NDArray[np.int32], shell: NDArray[np.int32]
) -> BaseGeometry:
    size = np.diff(start)
    ring = np.repeat(np.arange(len(size)), size)
    sound = size >= 3
    number = np.cumsum(sound) - 1
    rings = shapely.linearrings(points[sound[ring]], indices=number[ring[sound[ring]]])
    owner = np.where(shell >= 0, shell, len(size))[sound]
    placed = owner < len(size)
    own = owner == np.flatnonzero(sound)
    order = np.lexsort((~own[placed], owner[placed]))
    owners, indices = np.unique(owner[placed][order], return_inverse=True)
    polygons = shapely.polygons(rings[placed][order], indices=indices)
    geometry = polygons[0] if len(owners) == 1 else shapely.MultiPolygon(list(polygons))
    for stray in rings[~placed]:
        geometry = shapely.difference(geometry, shapely.Polygon(stray))
    return geometry


def grid_of(*areas: Area) -> float:
    """A grid far finer than the tolerance of any scene that holds these areas; a power of two.

    Overlays in floating arithmetic now and then fail, or lose whole polygons without a word, where
    borders nearly coincide (GEOS 3.14). On a grid they do not.
    """
    reach = max((abs(bound) for area in areas for bound in area.geometry.bounds), default=1.0)
    return 2.0 ** (math.ceil(math.log2(reach)) - GRID_BITS) if reach > 0.0 else 0.0


def union(*areas: Area) -> Area:
    """All points of any of the areas."""
    if len(areas) == 1:
        return areas[0]
    geometries = [area.geometry for area in areas if not area.is_empty]
    return Area.of(shapely.union_all(geometries, grid_size=grid_of(*areas)))


def intersection(a: Area, b: Area) -> Area:
    """The points of both, regularised: common borders do not count."""
    return Area.of(shapely.intersection(a.geometry, b.geometry, grid_size=grid_of(a, b)))


def difference(a: Area, b: Area) -> Area:
    """The points of `a` outside `b`, and their limits."""
    if a.is_empty or b.is_empty:
        return a
    return Area.of(shapely.difference(a.geometry, b.geometry, grid_size=grid_of(a, b)))


def within_box(a: Area, xmin: float, ymin: float, xmax: float, ymax: float) -> Area:
    """The part of `a` in an axis-parallel rectangle."""
    box = a.bounds
    if xmin <= box[0] and ymin <= box[1] and box[2] <= xmax and box[3] <= ymax:
        return a
    view = shapely.box(xmin, ymin, xmax, ymax)
    return Area.of(shapely.intersection(a.geometry, view, grid_size=grid_of(a)))


def is_subset(a: Area, b: Area, tolerance: float) -> bool:
    """Whether `a` lies in `b`, up to slivers no thicker than twice the tolerance."""
    slack = 2.0 * tolerance * a.geometry.length  # at least the measure of all slivers along `a`
    if a.measure - b.measure > slack:
        return False
    rest = difference(a, b)
    return rest.is_empty or bool(shapely.buffer(rest.geometry, -tolerance, quad_segs=1).is_empty)


def regularised(a: Area, tolerance: float) -> Area:
    """`a` without the polygons that are slivers, no thicker than twice the tolerance."""
    thick = [
        part.geometry
        for part in a.parts
        if not shapely.buffer(part.geometry, -tolerance, quad_segs=1).is_empty
    ]
    if len(thick) == len(a.parts):
        return a
    return Area.of(shapely.multipolygons(thick)) if thick else Area.empty()


def snapped(a: Area, grid: float) -> Area:
    """`a` on a grid: valid, noded, with no two vertices nearer than the grid's spacing."""
    return Area.of(shapely.set_precision(a.geometry, grid))


def united_on_grid(areas: Iterable[Area], grid: float) -> Area:
    """The union of the areas, noded on a grid, so that what touches shares its vertices."""
    return Area.of(shapely.union_all([area.geometry for area in areas], grid_size=grid))


def difference_on_grid(a: Area, b: Area, grid: float) -> Area:
    """`a` without `b`, noded on a grid."""
    return Area.of(shapely.difference(a.geometry, b.geometry, grid_size=grid))


def shrunk(a: Area, margin: float) -> Area:
    """`a` without what is nearer than the margin to its border."""
    return Area.of(shapely.buffer(a.geometry, -margin, join_style="mitre"))
