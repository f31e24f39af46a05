"""Regions as GeoJSON: areas as polygons, contact edges as lines, contact vertices as points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import Bools, ContactSpace, Floats, Ints
from preimage.configuration.contact_set import ContactSet, union
from preimage.configuration.location import along_segment
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import InputError
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.geojson import Shapes, from_geojson, to_geojson

NUDGE = 0.5
"""How far into its wedge one vertex of a pinch is written, as a part of the tolerance."""

_STEPS = 16
"""How many neighbouring numbers are tried to find the one that a coordinate came from."""

Numbers = NDArray[np.int64]


# --- writing --------------------------------------------------------------------------------


def region_to_geojson(region: Region, space: ConfigurationSpace) -> dict[str, Any]:
    """The geometry of a region.

    An interval of a contact edge is a line in the edge's direction, without the edge's end
    vertices, also where it reaches them; a vertex belongs by its own point only. Where obstacles
    touch, a point means all the vertices there; one of them alone is written a hair inside its
    wedge of free space, nearer than the tolerance.
    """
    contact, inside = space.contact, region.contact
    starts, ends = contact.at(inside.edge, inside.low), contact.at(inside.edge, inside.high)
    lines = tuple(np.stack((starts, ends), axis=1))
    return to_geojson(Shapes(region.area, lines, _vertex_points(inside.vertices, space)))


def _vertex_points(vertices: Ints, space: ConfigurationSpace) -> Floats:
    """(k, 2) what stands for vertices: each place once, if all of its vertices are among them."""
    if not len(vertices):
        return np.empty((0, 2))
    place = space.contact.place
    places, counts = np.unique(place[vertices], return_counts=True)
    wedges = _wedges_at(space.contact, places)
    whole = counts == np.count_nonzero(wedges >= 0, axis=1)
    single = vertices[np.isin(place[vertices], places[~whole])]
    return np.concatenate((space.contact.points[places[whole]], _nudged(single, space)))


def _wedges_at(contact: ContactSpace, places: Ints) -> Ints:
    """(k, r) the contact vertices at places, each after the other, filled up with -1."""
    wedges = contact.wedges[places]
    return np.where(np.isin(wedges, contact.vertices), wedges, -1)


def _nudged(vertices: Ints, space: ConfigurationSpace) -> Floats:
    """(k, 2) points a hair inside the wedges of free space at vertices."""
    contact = space.contact
    middle = contact.normal[vertices] - 0.5 * np.pi + 0.5 * contact.span[vertices]
    hair = NUDGE * space.tolerance.length
    return contact.points[vertices] + hair * np.stack((np.cos(middle), np.sin(middle)), axis=1)


# --- reading --------------------------------------------------------------------------------


def region_from_geojson(data: object, space: ConfigurationSpace, key: str = "") -> Region:
    """The region of a geometry: polygons are clipped to free space, the rest lies in contact space.

    Raises
    ------
    InputError : if it is no geometry, or a line or a point lies elsewhere; `key` names it.

    >>> from preimage.configuration.obstacles import configuration_space
    >>> from preimage.task import parse_task
    >>> space = configuration_space(parse_task({
    ...     "version": 1, "window": [0, 0, 4, 4], "walls": ["bottom"], "initial": "everywhere",
    ...     "uncertainty": {"control": 5, "position": 0.1}, "goal": {"edges": [[[1, 0], [2, 0]]]},
    ... }))
    >>> line = {"type": "LineString", "coordinates": [[1, 0], [2, 0]]}
    >>> region_from_geojson(line, space).contact.total_length
    1.0
    """
    shapes = from_geojson(data, key)
    edges = _edges_of(shapes.lines, space, key)
    vertices = _vertices_of(shapes.points, space, key)
    near = space.tolerance.length
    contact = union(edges, ContactSet.of([], [], [], vertices, near), near)
    return Region(_in_free_space(shapes.area, space, key), contact)


def _in_free_space(area: Area, space: ConfigurationSpace, key: str) -> Area:
    if area.is_empty or areas.is_subset(area, space.free, space.tolerance.length):
        return area
    inside = areas.regularised(areas.intersection(area, space.free), space.tolerance.length)
    if inside.is_empty:
        raise InputError(key, "nothing of its polygons lies in free space")
    return inside


def _edges_of(lines: tuple[Floats, ...], space: ConfigurationSpace, key: str) -> ContactSet:
    """The part of contact space on lines, without vertices."""
    if not lines:
        return ContactSet.empty()
    near, contact = space.tolerance.length, space.contact
    begin = np.concatenate([line[:-1] for line in lines])
    end = np.concatenate([line[1:] for line in lines])
    edge, low, high = _on_one_edge(contact, begin, end, near)
    found = edge >= 0
    result = ContactSet.of(edge[found], low[found], high[found], [], near)
    for place in np.flatnonzero(~found):
        # several edges in a line, or not in contact space
        start, stop = begin[place].tolist(), end[place].tolist()
        name = f"line from ({start[0]:.6g}, {start[1]:.6g}) to ({stop[0]:.6g}, {stop[1]:.6g})"
        try:
            more = along_segment(contact, tuple(start), tuple(stop), near, name)
        except InputError as error:
            raise InputError(key, f"the {error.key} {error.rule}") from None
        inner = ContactSet(more.edge, more.low, more.high, np.empty(0, dtype=np.int32))
        result = union(result, inner, near)
    return result


def _on_one_edge(
    contact: ContactSpace, begin: Floats, end: Floats, near: float
) -> tuple[Ints, Floats, Floats]:
    """The contact edge on which each segment lies, and where on it; -1 if there is none.

    Of two edges, the two sides of a thin wall, the one in the segment's direction is taken.
    """
    segment, edge = contact.index.near_segments(begin, end, near)
    keep = ~contact.open[edge]
    segment, edge = segment[keep], edge[keep]
    first, off_first = _projected(contact, edge, begin[segment])
    last, off_last = _projected(contact, edge, end[segment])
    on = (np.maximum(off_first, off_last) <= near) & (np.abs(last - first) > near)
    segment, edge, first, last = segment[on], edge[on], first[on], last[on]
    off = np.maximum(off_first, off_last)[on]
    order = np.lexsort((edge, off, last < first, segment))
    segment, position = np.unique(segment[order], return_index=True)
    best = order[position]
    edge, first, last = edge[best], first[best], last[best]
    first = _settled(contact, edge, first, begin[segment])
    last = _settled(contact, edge, last, end[segment])
    found = np.full(len(begin), -1, dtype=np.int32)
    low, high = np.zeros(len(begin)), np.zeros(len(begin))
    found[segment] = edge
    low[segment], high[segment] = np.minimum(first, last), np.maximum(first, last)
    return found, low, high


def _projected(contact: ContactSpace, edge: Ints, points: Floats) -> tuple[Floats, Floats]:
    """Where on edges points lie, as distances from their starts, and how far off they are."""
    offset = points - contact.points[edge]
    along = np.clip(np.sum(offset * contact.tangent[edge], axis=1), 0.0, contact.length[edge])
    gap = points - contact.at(edge, along)
    return along, np.hypot(gap[:, 0], gap[:, 1])


def _settled(contact: ContactSpace, edge: Ints, along: Floats, points: Floats) -> Floats:
    """Distances like these along edges, but such that `contact.at` gives the very same points.

    Where there are none, as for a point that was not made by `contact.at`, they stay as they are.
    """
    start, tangent, length = contact.points[edge], contact.tangent[edge], contact.length[edge]
    # A coordinate was rounded, so that what gave it lies in an interval; both coordinates' meet.
    half = 0.5 * np.spacing(np.abs(points))
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = (points - start)[None] + np.stack((-half, half))
        ends = np.where(tangent == 0.0, np.array([-np.inf, np.inf])[:, None, None], ends / tangent)
    least = np.max(np.min(ends, axis=0), axis=1)
    most = np.min(np.max(ends, axis=0), axis=1)
    middle = np.clip(0.5 * (least + most), 0.0, length)
    result = along
    settled: Bools = np.zeros(len(edge), dtype=np.bool_)
    for candidate in _candidates(along, middle, least, most, length):
        inside = np.clip(candidate, 0.0, length)
        same = np.all(contact.at(edge, inside) == points, axis=1) & ~settled
        result = np.where(same, inside, result)
        settled |= same
        if np.all(settled):
            break
    return result


def _candidates(
    along: Floats, middle: Floats, least: Floats, most: Floats, length: Floats
) -> Iterator[Floats]:
    """Distances worth a try: what was measured, the ends of the edge, and the neighbours."""
    yield from (along, middle, np.zeros_like(length), length)
    for base in (middle, least, most):
        step = np.spacing(base)
        for count in range(1, _STEPS + 1):
            yield base + count * step
            yield base - count * step


def _vertices_of(points: Floats, space: ConfigurationSpace, key: str) -> Ints:
    """The contact vertices at points: at a pinch all of them, or the one that is meant."""
    if not len(points):
        return np.empty(0, dtype=np.int32)
    near, contact = space.tolerance.length, space.contact
    point, vertex, apart = _near_vertices(points, contact, near)
    for missing in np.setdiff1d(np.arange(len(points)), point):
        x, y = points[missing]
        raise InputError(key, f"the point ({x:.6g}, {y:.6g}) is no contact vertex")
    closest = _least(point, apart)
    exact = (apart[closest] <= 0.5 * NUDGE * near)[point]
    together = contact.place[vertex] == contact.place[vertex[closest]][point]
    gap = _nudged(vertex, space) - points[point]
    meant = np.zeros(len(point), dtype=np.bool_)
    meant[_least(point, np.hypot(gap[:, 0], gap[:, 1]))] = True
    return vertex[np.where(exact, together, meant)]


def _near_vertices(points: Floats, contact: ContactSpace, near: float) -> tuple[Ints, Ints, Floats]:
    """Pairs of a point and a contact vertex near it, sorted by point; how far they are apart."""
    point, edge = contact.index.near_points(points, near)[:2]
    both = np.concatenate((edge, contact.next[edge])).astype(np.int64)
    pairs = np.unique(np.concatenate((point, point)).astype(np.int64) * len(contact) + both)
    point, vertex = (part.astype(np.int32) for part in np.divmod(pairs, len(contact)))
    gap = contact.points[vertex] - points[point]
    apart = np.hypot(gap[:, 0], gap[:, 1])
    on = (apart <= near) & np.isin(vertex, contact.vertices)
    return point[on], vertex[on], apart[on]


def _least(group: Ints, value: Floats) -> Numbers:
    """Of each group, in ascending order, the place of its least value; the first of several."""
    order = np.lexsort((value, group))
    _, first = np.unique(group[order], return_index=True)
    places: Numbers = order[first]
    return places
