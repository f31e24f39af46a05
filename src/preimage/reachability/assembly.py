"""How a target's area lies against contact space: the arrangement that the sweep runs over."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace, Floats, Ints
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area

Indices = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Attachment:
    """The border of an area of free space, taken apart.

    Parameters
    ----------
    beside_edge, beside_low, beside_high : (k,) stretches of contact edges along which the area
        lies.
    nodes : (m, 2) the vertices of the border inside free space.
    node_vertex, node_edge, node_distance : (m,) the contact vertex at a node, or -1; the contact
        edge on which it lies, or -1, and how far along it.
    segment_from, segment_to : (s,) the border inside free space, from node to node, the area on
        the left.
    """

    beside_edge: Ints
    beside_low: Floats
    beside_high: Floats
    nodes: Floats
    node_vertex: Ints
    node_edge: Ints
    node_distance: Floats
    segment_from: Ints
    segment_to: Ints


def _no_ints() -> Ints:
    return np.empty(0, dtype=np.int32)


NOTHING = Attachment(
    beside_edge=_no_ints(),
    beside_low=np.empty(0),
    beside_high=np.empty(0),
    nodes=np.empty((0, 2)),
    node_vertex=_no_ints(),
    node_edge=_no_ints(),
    node_distance=np.empty(0),
    segment_from=_no_ints(),
    segment_to=_no_ints(),
)
"""The attachment of the empty area."""


def attach(area: Area, space: ConfigurationSpace) -> Attachment:
    """Take an area's border apart into what runs along contact space and what crosses free space.

    What lies within the tolerance of a contact vertex or edge is on it; where contact vertices
    lie on the border, the border gets a node (paper 5.4: "inserted as a new vertex").
    """
    if area.is_empty:
        return NOTHING
    contact, tolerance = space.contact, space.tolerance.length
    starts, ends = area.segments
    segment, edge = contact.index.near_segments(starts, ends, tolerance)
    nodes = _place_on_contact(starts, segment, edge, contact, tolerance)
    cut, vertex = _vertices_inside(starts, ends, segment, edge, contact, tolerance)
    nodes = nodes.with_vertices(contact.points[vertex], vertex)
    origin, target = _cut_rings(_following(area), cut)
    return _sort_out(contact, nodes, origin, target)


@dataclass(frozen=True, slots=True, eq=False)
class _Nodes:
    """Points of an area's border, and what of contact space they lie on; see `Attachment`."""

    at: Floats
    vertex: Ints
    edge: Ints
    distance: Floats

    def with_vertices(self, at: Floats, vertex: Ints) -> _Nodes:
        """These nodes, and more of them, at contact vertices."""
        if not len(vertex):
            return self
        return _Nodes(
            np.concatenate((self.at, at)),
            np.concatenate((self.vertex, vertex)),
            np.concatenate((self.edge, np.full(len(vertex), -1, dtype=np.int32))),
            np.concatenate((self.distance, np.zeros(len(vertex)))),
        )

    def distance_on(self, edge: Ints, node: Indices, contact: ContactSpace) -> Floats:
        """How far along edges nodes lie; -1 where they do not, or where the edge is -1."""
        vertex = self.vertex[node]
        place = np.where(vertex >= 0, contact.place[vertex], -1)
        distance = np.where((vertex < 0) & (self.edge[node] == edge), self.distance[node], -1.0)
        at_end = place == contact.place[contact.next[edge]]
        distance = np.where(at_end, contact.length[edge], distance)
        distance = np.where(place == contact.place[edge], 0.0, distance)
        return np.where(edge >= 0, distance, -1.0)


def _place_on_contact(
    points: Floats, segment: Ints, edge: Ints, contact: ContactSpace, tolerance: float
) -> _Nodes:
    """The nodes at which segments start, given the contact edges near each segment."""
    tangent, offset = contact.tangent[edge], points[segment] - contact.points[edge]
    along = np.clip(np.einsum("ij,ij->i", offset, tangent), 0.0, contact.length[edge])
    away = offset - along[:, None] * tangent
    on = np.hypot(away[:, 0], away[:, 1]) <= tolerance
    segment, edge, along = segment[on], edge[on], along[on]

    nodes = _Nodes(
        points,
        np.full(len(points), -1, dtype=np.int32),
        np.full(len(points), -1, dtype=np.int32),
        np.zeros(len(points)),
    )
    nodes.edge[segment], nodes.distance[segment] = edge, along
    at_end = along >= contact.length[edge] - tolerance
    nodes.vertex[segment[at_end]] = contact.next[edge[at_end]]
    at_start = along <= tolerance
    nodes.vertex[segment[at_start]] = edge[at_start]
    nodes.edge[nodes.vertex >= 0] = -1
    return nodes


def _vertices_inside(
    starts: Floats,
    ends: Floats,
    segment: Ints,
    edge: Ints,
    contact: ContactSpace,
    tolerance: float,
) -> tuple[Ints, Ints]:
    """Contact vertices inside segments: pairs, in order along each segment."""
    direction = ends[segment] - starts[segment]
    length = np.hypot(direction[:, 0], direction[:, 1])
    offset = contact.points[edge] - starts[segment]
    reach = np.einsum("ij,ij->i", offset, direction) / length
    beside = np.abs(offset[:, 0] * direction[:, 1] - offset[:, 1] * direction[:, 0]) / length
    inside = (beside <= tolerance) & (reach > tolerance) & (reach < length - tolerance)
    if not np.any(inside):
        return _no_ints(), _no_ints()
    segment, reach, place = segment[inside], reach[inside], contact.place[edge[inside]]
    _, first = np.unique(np.stack((segment, place)), axis=1, return_index=True)
    order = first[np.lexsort((reach[first], segment[first]))]
    return segment[order], place[order]


def _following(area: Area) -> Indices:
    """The segment that follows each one around its ring."""
    sizes = np.array([len(ring) for ring in area.rings])
    following = np.arange(1, sizes.sum() + 1)
    following[np.cumsum(sizes) - 1] -= sizes
    return following


def _cut_rings(following: Indices, cut: Ints) -> tuple[Indices, Indices]:
    """The pieces of cut segments, as pairs of nodes; cuts count on behind the segments."""
    count, pieces = len(following), len(following) + len(cut)
    if not len(cut):
        return np.arange(count), following
    owner = np.concatenate((np.arange(count), cut))
    order = np.argsort(owner, kind="stable")
    last = np.append(owner[order][1:] != owner[order][:-1], True)
    target = np.empty(pieces, dtype=np.int64)
    target[order[:-1]] = order[1:]
    target[order[last]] = following[owner[order[last]]]
    return np.arange(pieces), target


def _sort_out(contact: ContactSpace, nodes: _Nodes, origin: Indices, target: Indices) -> Attachment:
    """Tell the pieces along contact edges from those across free space."""
    edge, start, stop = _common_edge(contact, nodes, origin, target)
    along = edge >= 0
    beside_edge, beside_low, beside_high = _net(edge[along], start[along], stop[along])
    used, renumbered = np.unique(
        np.concatenate((origin[~along], target[~along])), return_inverse=True
    )
    half = len(renumbered) // 2
    return Attachment(
        beside_edge=beside_edge,
        beside_low=beside_low,
        beside_high=beside_high,
        nodes=nodes.at[used],
        node_vertex=nodes.vertex[used],
        node_edge=nodes.edge[used],
        node_distance=nodes.distance[used],
        segment_from=renumbered[:half].astype(np.int32),
        segment_to=renumbered[half:].astype(np.int32),
    )


def _common_edge(
    contact: ContactSpace, nodes: _Nodes, origin: Indices, target: Indices
) -> tuple[Ints, Floats, Floats]:
    """The contact edge on which both nodes of a piece lie, or -1, and where they lie on it."""
    edge = np.full(len(origin), -1, dtype=np.int32)
    start, stop = np.zeros(len(origin)), np.zeros(len(origin))
    for candidate in _candidates(contact, nodes, origin, target):
        first = nodes.distance_on(candidate, origin, contact)
        second = nodes.distance_on(candidate, target, contact)
        found = (edge < 0) & (first >= 0) & (second >= 0) & (first != second)
        edge = np.where(found, candidate, edge)
        start = np.where(found, first, start)
        stop = np.where(found, second, stop)
    return edge, start, stop


def _candidates(
    contact: ContactSpace, nodes: _Nodes, origin: Indices, target: Indices
) -> Iterator[Ints]:
    """Edges on which a piece may lie: through a node inside an edge, or through a vertex."""
    yield nodes.edge[origin]
    yield nodes.edge[target]
    vertex = nodes.vertex[origin]
    if np.any((vertex >= 0) & (nodes.vertex[target] >= 0)):
        for wedge in contact.wedges.T:
            here = np.where(vertex >= 0, wedge[contact.place[vertex]], -1)
            yield here
            yield np.where(here >= 0, contact.previous[here], -1)


def _net(edge: Ints, start: Floats, stop: Floats) -> tuple[Ints, Floats, Floats]:
    """Where pieces along edges outnumber those against them.

    Those have the obstacle on their left: folds of the border, no thicker than the tolerance.
    """
    if not np.any(start > stop):
        return edge, start, stop
    place = np.concatenate((start, stop))
    both = np.concatenate((edge, edge))
    step = np.repeat((1, -1), len(edge))
    order = np.lexsort((place, both))
    cover = np.cumsum(step[order])[:-1]
    both, place = both[order], place[order]
    kept = (cover > 0) & (both[1:] == both[:-1]) & (place[1:] > place[:-1])
    return both[:-1][kept], place[:-1][kept], place[1:][kept]
