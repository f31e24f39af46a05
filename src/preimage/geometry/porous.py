"""Areas with many holes: what lies near to something is found without looking at all of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area, Floats
from preimage.geometry.border import border

Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Shapes = NDArray[np.object_]
Box = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False)
class Porous:
    """An area whose holes are in a search tree, which is built when it is first asked.

    Parameters
    ----------
    area : any.
    """

    area: Area

    @cached_property
    def _polygons(self) -> Shapes:
        polygons: Shapes = shapely.get_parts(self.area.geometry)
        return polygons

    @cached_property
    def _holes(self) -> tuple[Shapes, Indices]:
        """All holes, as polygons, and to which polygon each belongs."""
        return holes_of(self._polygons)

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree(self._holes[0])

    @cached_property
    def _by_shape(self) -> dict[bytes, int]:
        return {shape: place for place, shape in enumerate(shapes_of(self._holes[0]))}

    @cached_property
    def _nested(self) -> Bools:
        """Which holes have another polygon of the area inside, or may have: they are kept."""
        holes, owner = self._holes
        nested = np.zeros(len(holes), dtype=np.bool_)
        if len(self._polygons) > 1 and len(holes):
            polygon, hole = self._tree.query(self._polygons)
            nested[hole[polygon != owner[hole]]] = True
        return nested

    def beside(
        self, other: Area, starts: Floats, ends: Floats, distance: float
    ) -> tuple[Area, Area]:
        """The area and another one within it, both without holes that do not matter.

        What lies in the one and outside the other is the same as before wherever it is no further
        than `distance` from the other or from the segments; elsewhere there may be more of it. Left
        out are holes that both have, vertex by vertex, and holes further off than that.

        Parameters
        ----------
        starts, ends : (k, 2) segments.

        >>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
        >>> far = Porous(Area.polygon(20 * square, [square + 1, square + 5, square + 15]))
        >>> goal = Area.polygon(4 * square, [square + 1])
        >>> [len(left.rings) for left in far.beside(goal, np.empty((0, 2)), np.empty((0, 2)), 2.0)]
        [2, 1]
        """
        holes, owner = self._holes
        if not len(holes):
            return self.area, other
        others = shapely.get_parts(other.geometry)
        own, own_owner = holes_of(others)
        same = np.array([self._by_shape.get(shape, -1) for shape in shapes_of(own)], dtype=np.intp)
        common = (same >= 0) & ~self._nested[same]
        left = other
        if np.any(common):
            left = Area(_punched(others, own[~common], own_owner[~common]))
        points, following = border(left)
        lines = shapely.linestrings(
            np.stack(
                (np.concatenate((points, starts)), np.concatenate((points[following], ends))),
                axis=1,
            )
        )
        _, near = self._tree.query(lines, predicate="dwithin", distance=distance)
        kept = np.setdiff1d(
            np.concatenate((near, np.flatnonzero(self._nested))), same[common]
        ).astype(np.intp)
        return Area(_punched(self._polygons, holes[kept], owner[kept])), left


def holes_of(polygons: Shapes) -> tuple[Shapes, Indices]:
    """The holes of polygons, as polygons, and to which polygon each belongs."""
    rings, owner = shapely.get_rings(polygons, return_index=True)
    inner = np.diff(owner, prepend=-1) == 0
    return shapely.polygons(rings[inner]), owner[inner]


def shapes_of(polygons: Shapes) -> list[bytes]:
    """What is equal for polygons with the same vertices, wherever their rings begin."""
    shapes: list[bytes] = shapely.to_wkb(shapely.normalize(polygons)).tolist()
    return shapes


def _punched(polygons: Shapes, holes: Shapes, owner: Indices) -> shapely.Geometry:
    """The shells of polygons with these holes, which are theirs already."""
    rings = np.concatenate((shapely.get_exterior_ring(polygons), shapely.get_exterior_ring(holes)))
    whose = np.concatenate((np.arange(len(polygons)), owner))
    order = np.argsort(whose, kind="stable")
    punched: Shapes = shapely.polygons(rings[order], indices=whose[order])
    return punched[0] if len(punched) == 1 else shapely.multipolygons(punched)
