"""Subsets of contact space: closed intervals on edges, and vertices. Exact, one-dimensional."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from preimage.configuration.contact import Bools, ContactSpace, Floats, Ints


@dataclass(frozen=True, slots=True, eq=False)
class ContactSet:
    """Closed intervals of contact edges, without the edges' end vertices, and contact vertices.

    The two are kept apart (theory 1): an interval may run up to the end of its edge while the
    vertex there does not belong.

    Parameters
    ----------
    edge : (k,) the edges, in ascending order.
    low, high : (k,) the ends of the intervals, as distances from the start of the edge;
        disjoint and ascending on each edge.
    vertices : (m,) the vertices, in ascending order.
    """

    edge: Ints
    low: Floats
    high: Floats
    vertices: Ints

    @classmethod
    def empty(cls) -> ContactSet:
        """No contact at all."""
        none = np.empty(0)
        return cls(np.empty(0, np.int32), none, none, np.empty(0, np.int32))

    @classmethod
    def whole(cls, contact: ContactSpace) -> ContactSet:
        """All of contact space."""
        edges = contact.edges
        return cls(edges, np.zeros(len(edges)), contact.length[edges], contact.vertices)

    @classmethod
    def of(
        cls,
        edge: Ints | list[int],
        low: Floats | list[float],
        high: Floats | list[float],
        vertices: Ints | list[int],
        tolerance: float,
    ) -> ContactSet:
        """The union of intervals given in any order, which may overlap, and of vertices."""
        intervals = _combine(_intervals(edge, low, high), _NOTHING, tolerance, _in_either)
        return cls(*intervals, np.unique(np.asarray(vertices, dtype=np.int32)))

    @property
    def is_empty(self) -> bool:
        """Neither an interval nor a vertex."""
        return not len(self.edge) and not len(self.vertices)

    @property
    def total_length(self) -> float:
        """The summed length of the intervals."""
        return float(np.sum(self.high - self.low))

    def contains(self, edge: int, distance: float, tolerance: float) -> bool:
        """Whether the point at `distance` from the start of `edge` belongs (theory 1)."""
        on = self.edge == edge
        near = (self.low - tolerance <= distance) & (distance <= self.high + tolerance)
        return bool(np.any(on & near))

    def has_vertex(self, vertex: int) -> bool:
        """Whether the vertex itself belongs."""
        place = int(np.searchsorted(self.vertices, vertex))
        return place < len(self.vertices) and int(self.vertices[place]) == vertex


Intervals = tuple[Ints, Floats, Floats]
_NOTHING: Intervals = (np.empty(0, np.int32), np.empty(0), np.empty(0))


def union(a: ContactSet, b: ContactSet, tolerance: float) -> ContactSet:
    """`a | b`."""
    intervals = _combine(_parts(a), _parts(b), tolerance, _in_either)
    return ContactSet(*intervals, np.union1d(a.vertices, b.vertices))


def intersection(a: ContactSet, b: ContactSet, tolerance: float) -> ContactSet:
    """`a & b`, without isolated points of edges."""
    intervals = _combine(_parts(a), _parts(b), tolerance, np.logical_and)
    return ContactSet(*intervals, np.intersect1d(a.vertices, b.vertices, assume_unique=True))


def difference(a: ContactSet, b: ContactSet, tolerance: float) -> ContactSet:
    """`a - b`, closed within each edge."""
    intervals = _combine(_parts(a), _parts(b), tolerance, _in_first_only)
    return ContactSet(*intervals, np.setdiff1d(a.vertices, b.vertices, assume_unique=True))


def is_subset(a: ContactSet, b: ContactSet, tolerance: float) -> bool:
    """Whether `a` lies in `b`, up to intervals no longer than the tolerance."""
    return difference(a, b, tolerance).is_empty


def complement(a: ContactSet, contact: ContactSpace, tolerance: float) -> ContactSet:
    """All of contact space that is not in `a`, closed within each edge."""
    return difference(ContactSet.whole(contact), a, tolerance)


def inner(contact: ContactSpace) -> ContactSet:
    """All of contact space but the vertices at the open border of the window."""
    return without_outermost(ContactSet.whole(contact), contact)


def without_outermost(a: ContactSet, contact: ContactSpace) -> ContactSet:
    """`a` without the vertices at the open border: who is there has escaped."""
    vertices = np.setdiff1d(a.vertices, contact.outermost, assume_unique=True)
    return ContactSet(a.edge, a.low, a.high, vertices)


def _parts(a: ContactSet) -> Intervals:
    return a.edge, a.low, a.high


def _intervals(
    edge: Ints | list[int], low: Floats | list[float], high: Floats | list[float]
) -> Intervals:
    return (
        np.asarray(edge, dtype=np.int32),
        np.asarray(low, dtype=np.float64),
        np.asarray(high, dtype=np.float64),
    )


def _in_either(first: Bools, second: Bools) -> Bools:
    return first | second


def _in_first_only(first: Bools, second: Bools) -> Bools:
    return first & ~second


def _combine(
    a: Intervals, b: Intervals, tolerance: float, keep: Callable[[Bools, Bools], Bools]
) -> Intervals:
    """A boolean operation on intervals, by one pass over their sorted ends.

    Ends on one edge that lie within the tolerance of each other become one end; what is then
    left without length is dropped.
    """
    if not len(b[0]) and len(a[0]) <= 1 and keep is not np.logical_and:
        return a if len(a[0]) and a[2][0] - a[1][0] > tolerance else _NOTHING
    edge = np.concatenate((a[0], a[0], b[0], b[0]))
    place = np.concatenate((a[1], a[2], b[1], b[2]))
    step_a = np.zeros(len(edge), dtype=np.int32)
    step_b = np.zeros(len(edge), dtype=np.int32)
    step_a[: len(a[0])] = 1
    step_a[len(a[0]) : 2 * len(a[0])] = -1
    step_b[2 * len(a[0]) : 2 * len(a[0]) + len(b[0])] = 1
    step_b[2 * len(a[0]) + len(b[0]) :] = -1
    order = np.lexsort((place, edge))
    edge, place = edge[order], place[order]
    inside = keep(np.cumsum(step_a[order]) > 0, np.cumsum(step_b[order]) > 0)
    last = np.ones(len(edge), dtype=np.bool_)  # the last of the ends that are one
    last[:-1] = (edge[1:] != edge[:-1]) | (place[1:] - place[:-1] > tolerance)
    edge, place, inside = edge[last], place[last], inside[last]
    changes = np.ones(len(edge), dtype=np.bool_)
    changes[1:] = (inside[1:] != inside[:-1]) | (edge[1:] != edge[:-1])
    changes[:1] = inside[:1]
    changes &= inside | np.concatenate(([False], inside[:-1]))
    edge, place, inside = edge[changes], place[changes], inside[changes]
    starts, stops = np.flatnonzero(inside), np.flatnonzero(~inside)
    return edge[starts].astype(np.int32), place[starts], place[stops]
