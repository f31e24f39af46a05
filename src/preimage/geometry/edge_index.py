"""Which of many edges are near a point or a segment."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class EdgeIndex:
    """Straight edges in a search tree, which is built when it is first asked.

    Parameters
    ----------
    starts, ends : (n, 2) the edges; answers name them by their place here.

    >>> edges = EdgeIndex(np.array([[0.0, 0.0], [0.0, 2.0]]), np.array([[4.0, 0.0], [4.0, 2.0]]))
    >>> [answer.tolist() for answer in edges.near_points(np.array([[3.0, 0.5]]), 1.0)]
    [[0], [0], [3.0]]
    """

    starts: Floats
    ends: Floats

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree(_lines(self.starts, self.ends))

    def near_points(self, points: Floats, distance: float) -> tuple[Ints, Ints, Floats]:
        """All pairs of a point and an edge that are at most `distance` apart.

        Parameters
        ----------
        points : (k, 2)

        Returns
        -------
        point, edge : (m,) the pairs, sorted by point, then by edge.
        along : (m,) where on the edge it is nearest, as a distance from the edge's start.
        """
        point, edge = self._pairs(shapely.points(points), distance)
        start, along = self.starts[edge], self.ends[edge] - self.starts[edge]
        length = np.hypot(along[:, 0], along[:, 1])
        with np.errstate(invalid="ignore", divide="ignore"):
            unit = np.where(length[:, None] > 0.0, along / length[:, None], 0.0)
        offset = points[point] - start
        place = np.clip(np.sum(offset * unit, axis=1), 0.0, length)
        return point, edge, place

    def near_segments(self, starts: Floats, ends: Floats, distance: float) -> tuple[Ints, Ints]:
        """All pairs of a segment and an edge that are at most `distance` apart.

        Parameters
        ----------
        starts, ends : (k, 2) the segments; they may be points.

        Returns
        -------
        segment, edge : (m,) the pairs, sorted by segment, then by edge.
        """
        return self._pairs(_lines(starts, ends), distance)

    def near_area(self, area: Area, distance: float) -> Ints:
        """The edges that are at most `distance` from a closed area, in ascending order."""
        if not len(self.starts) or area.is_empty:
            return np.empty(0, dtype=np.int32)
        edge = self._tree.query(area.geometry, predicate="dwithin", distance=distance)
        return np.sort(edge).astype(np.int32)

    def nearest(self, x: float, y: float) -> tuple[int, float]:
        """The edge nearest to a point, and how far it is; -1 and infinity if there is none."""
        if not len(self.starts):
            return -1, float("inf")
        edge, apart = self._tree.query_nearest(
            shapely.Point(x, y), return_distance=True, all_matches=True
        )
        return int(edge.min()), float(apart[0])

    def _pairs(self, shapes: NDArray[np.object_], distance: float) -> tuple[Ints, Ints]:
        if not len(self.starts) or not len(shapes):
            return np.empty(0, dtype=np.int32), np.empty(0, dtype=np.int32)
        asked, edge = self._tree.query(shapes, predicate="dwithin", distance=distance)
        order = np.lexsort((edge, asked))
        return asked[order].astype(np.int32), edge[order].astype(np.int32)


def _lines(starts: Floats, ends: Floats) -> NDArray[np.object_]:
    lines: NDArray[np.object_] = shapely.linestrings(np.stack((starts, ends), axis=1))
    return lines
