"""Contact space as features: edges with outgoing normals, and vertices."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from preimage.geometry.angles import TAU
from preimage.geometry.edge_index import EdgeIndex

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class ContactSpace:
    """The boundary of free space in the window, as closed loops with free space on the left.

    Index `i` names two things: the vertex at `points[i]`, which is the corner of one wedge of free
    space, and the edge that starts there and ends at vertex `next[i]`. Where obstacles touch in a
    point the pinch is solid, and each wedge of free space around it has a vertex of its own
    (theory 1).

    Parameters
    ----------
    points : (n, 2) positions of the vertices.
    next : (n,) the vertex at which edge `i` ends.
    open : (n,) edge `i` is an open side of the window: no contact, who touches it has escaped.
    """

    points: Floats
    next: Ints
    open: Bools

    def __len__(self) -> int:
        return len(self.points)

    @cached_property
    def previous(self) -> Ints:
        """(n,) the edge that ends at vertex `i`."""
        previous = np.empty_like(self.next)
        previous[self.next] = np.arange(len(self), dtype=np.int32)
        return previous

    @cached_property
    def place(self) -> Ints:
        """(n,) the first vertex at the position of vertex `i`: itself, except at pinches."""
        order = np.lexsort((np.arange(len(self)), self.points[:, 1], self.points[:, 0]))
        sorted_points = self.points[order]
        fresh = np.ones(len(self), dtype=np.bool_)
        fresh[1:] = np.any(sorted_points[1:] != sorted_points[:-1], axis=1)
        place = np.empty(len(self), dtype=np.int32)
        place[order] = order[np.flatnonzero(fresh)[np.cumsum(fresh) - 1]]
        return place

    @cached_property
    def wedges(self) -> Ints:
        """(n, r) all vertices at a place, by its first vertex, filled up with -1."""
        order = np.argsort(self.place, kind="stable")
        count = np.bincount(self.place, minlength=len(self))
        first = np.cumsum(count) - count
        wedges = np.full((len(self), int(count.max(initial=1))), -1, dtype=np.int32)
        wedges[self.place[order], np.arange(len(self)) - first[self.place[order]]] = order
        return wedges

    @cached_property
    def ends(self) -> Floats:
        """(n, 2) where edge `i` ends."""
        return self.points[self.next]

    @cached_property
    def length(self) -> Floats:
        """(n,) lengths of the edges."""
        along = self.ends - self.points
        return np.hypot(along[:, 0], along[:, 1])

    @cached_property
    def tangent(self) -> Floats:
        """(n, 2) unit vectors along the edges."""
        along: Floats = (self.ends - self.points) / self.length[:, None]
        return along

    @cached_property
    def normal(self) -> Floats:
        """(n,) angles of the outgoing normals, which point into free space."""
        along = self.ends - self.points
        # adding 0.0 turns -0.0 into 0.0, for which arctan2 would answer -pi
        return np.arctan2(along[:, 0] + 0.0, -along[:, 1] + 0.0)

    @cached_property
    def span(self) -> Floats:
        """(n,) angles of the free wedges at the vertices, in (0, 2 pi)."""
        turn = np.mod(self.normal - self.normal[self.previous], TAU)
        return np.where(turn < np.pi, np.pi - turn, 3.0 * np.pi - turn)

    @cached_property
    def concave(self) -> Bools:
        """(n,) the free space around vertex `i` spans less than pi."""
        return self.span < np.pi

    @cached_property
    def edges(self) -> Ints:
        """Indices of the contact edges."""
        return np.flatnonzero(~self.open).astype(np.int32)

    @cached_property
    def vertices(self) -> Ints:
        """Indices of the contact vertices: those beside at least one contact edge."""
        return np.flatnonzero(~(self.open & self.open[self.previous])).astype(np.int32)

    @cached_property
    def outermost(self) -> Ints:
        """Indices of the contact vertices beside an open side: who is there has escaped."""
        return np.flatnonzero(self.open != self.open[self.previous]).astype(np.int32)

    @cached_property
    def index(self) -> EdgeIndex:
        """All edges, the open ones too, in a search tree."""
        return EdgeIndex(self.points, self.ends)

    def at(self, edge: Ints, distance: Floats) -> Floats:
        """(k, 2) points at `distance` from the start of each `edge`."""
        distance = np.asarray(distance, dtype=np.float64)
        length = self.length[edge]
        inner = self.points[edge] + distance[:, None] * self.tangent[edge]
        return np.where((distance >= length)[:, None], self.ends[edge], inner)
