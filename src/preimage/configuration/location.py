"""Places in contact space: what of it lies at a point, on a segment, in an area."""

from __future__ import annotations

import numpy as np

from preimage.configuration.contact import ContactSpace, Floats, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.errors import TaskError
from preimage.geometry.area import Area
from preimage.geometry.clipping import parts_inside, reaches

Point = tuple[float, float]


def vertices_at(contact: ContactSpace, point: Point, near: float) -> Ints:
    """The contact vertices at a point: several at a pinch, one for each wedge of free space."""
    gap = contact.points[contact.vertices] - np.asarray(point, dtype=np.float64)
    return contact.vertices[np.hypot(gap[:, 0], gap[:, 1]) <= near]


def edges_at(contact: ContactSpace, point: Point, near: float) -> tuple[Ints, Floats]:
    """The edges through a point, open ones too, and how far along them it is."""
    _, edge, along = contact.index.near_points(np.array([point], dtype=np.float64), near)
    return edge, along


def along_segment(
    contact: ContactSpace, start: Point, end: Point, near: float, key: str
) -> ContactSet:
    """The part of contact space on a segment, which must lie in it: edges, and all vertices.

    The segment may cover a part of an edge, or several that continue one another, in either
    direction.

    Raises
    ------
    TaskError : some point of the segment is not in contact space; `key` names the segment.
    """
    p, q = np.array(start, dtype=np.float64), np.array(end, dtype=np.float64)
    length = float(np.hypot(*(q - p)))
    if length <= near:
        raise TaskError(key, "has no length")
    unit = (q - p) / length
    _, edge = contact.index.near_segments(p[None], q[None], near)
    edge = edge[~contact.open[edge]]
    tail, head = contact.points[edge], contact.ends[edge]
    # the part of each edge beside the segment, and how far it is from it there
    begin, stop = (tail - p) @ unit, (head - p) @ unit
    low = np.maximum(np.minimum(begin, stop), 0.0)
    high = np.minimum(np.maximum(begin, stop), length)
    beside = high - low > near
    edge = edge[beside]
    begin, stop, low, high = (place[beside] for place in (begin, stop, low, high))
    first, last = ((place - begin) / (stop - begin) * contact.length[edge] for place in (low, high))
    apart = [_distance_from_line(contact.at(edge, at), p, unit) for at in (first, last)]
    on = np.maximum(*apart) <= near
    _check_covered(contact, p, unit, length, np.stack((low[on], high[on]), axis=1), near, key)
    vertices = contact.vertices
    offset = contact.points[vertices] - p
    place = np.clip(offset @ unit, 0.0, length)
    gap = offset - place[:, None] * unit
    return ContactSet.of(
        edge[on],
        np.minimum(first, last)[on],
        np.maximum(first, last)[on],
        vertices[np.hypot(gap[:, 0], gap[:, 1]) <= near],
        near,
    )


def _distance_from_line(points: Floats, start: Floats, unit: Floats) -> Floats:
    offset = points - start
    apart: Floats = np.abs(offset[:, 0] * unit[1] - offset[:, 1] * unit[0])
    return apart


def _check_covered(
    contact: ContactSpace,
    start: Floats,
    unit: Floats,
    length: float,
    covered: Floats,
    near: float,
    key: str,
) -> None:
    """Refuse a segment that intervals do not cover, naming its point that is furthest off."""
    covered = covered[np.argsort(covered[:, 0], kind="stable")]
    reach = np.concatenate(([0.0], np.maximum.accumulate(covered[:, 1])))
    begins = np.concatenate((covered[:, 0], [length]))
    gaps = np.flatnonzero(begins - reach > 2.0 * near)
    if not len(gaps):
        return
    edges = contact.edges
    if not len(edges):
        raise TaskError(key, "does not lie in contact space, of which there is none")
    worst, where = -1.0, start
    for gap in gaps.tolist():
        for part in (0.0, 0.5, 1.0):
            point = start + (reach[gap] + part * (begins[gap] - reach[gap])) * unit
            apart = _distance_from_edges(contact, edges, point)
            if apart > worst:
                worst, where = apart, point
    raise TaskError(
        key,
        f"does not lie in contact space: ({where[0]:.6g}, {where[1]:.6g}) is {worst:.3g} from it",
    )


def _distance_from_edges(contact: ContactSpace, edges: Ints, point: Floats) -> float:
    """How far a point is from the nearest of some edges."""
    if not len(edges):
        return float("inf")
    offset = point - contact.points[edges]
    along = np.clip(np.sum(offset * contact.tangent[edges], axis=1), 0.0, contact.length[edges])
    gap = offset - along[:, None] * contact.tangent[edges]
    return float(np.min(np.hypot(gap[:, 0], gap[:, 1])))


def inside_area(contact: ContactSpace, area: Area, near: float) -> ContactSet:
    """The part of contact space inside an area and on its border, vertices included."""
    edge, low, high = parts_inside(contact.index, area, near)
    keep = ~contact.open[edge]
    vertices = contact.vertices
    return ContactSet.of(
        edge[keep],
        low[keep],
        high[keep],
        vertices[reaches(area, contact.points[vertices], near)],
        near,
    )
