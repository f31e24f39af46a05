"""Kernels: the part of a target that no reading confuses with the rest of a domain (theory 5)."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Bools, ContactSpace, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.geometry.border import border
from preimage.recognition.outside import (
    Domain,
    area_outside,
    border_segments,
    contact_outside,
    contact_segments,
)
from preimage.recognition.readings import Readings, alike, alike_pairs
from preimage.recognition.segments import (
    Box,
    Indices,
    Segments,
    distances,
    stretches,
    together,
    where_between,
)
from preimage.task.uncertainty import Uncertainty


def kernel(
    space: ConfigurationSpace,
    readings: Readings,
    target: Region,
    uncertainty: Uncertainty,
    domain: Domain = None,
    *,
    arc_tolerance: float = inflate.ARC_TOLERANCE,
) -> Region:
    """The kernel of a target within a domain (theory 5, paper 5.3, 5.4, 7, 8).

    `kernel(T; v, Delta) = U_X ((X & T) - U_{Y alike X} ((Delta Y - T) (+) D(2 rho)))`, with X and Y
    over free space, the edges and the vertices.

    Each feature keeps a set that is closed within it and no more: an edge may be in the kernel
    without the area beside it or the vertex at its end, and the other way round. Parts of edges are
    exact, and so are the straight parts of the area's border; its arcs, around what is outside the
    target, are replaced on the safe side, touching the arcs where rays of the cone do.

    Parameters
    ----------
    readings : of all features for v.
    target : T, in valid space.
    uncertainty : rho is its position; `inf` leaves of each feature all or nothing, and with 0,
        where only equal positions are confused, the kernel is T but for the places at which
        several vertices lie on each other.
    domain : Delta; all of valid space by default.
    arc_tolerance : how far arcs may be off, as a fraction of their radius 2 rho.

    Returns
    -------
    The kernel, without slivers: no area is thinner, no interval shorter than the tolerance. Radii
    are taken larger by the tolerance, so that what touches within rounding stays on the safe side.
    """
    rest = contact_segments(space.contact, contact_outside(space, target, domain), readings)
    if np.isinf(uncertainty.position):
        return _without_position(space, readings, target, rest, domain)
    if uncertainty.position == 0.0:
        return _with_exact_position(space, readings, target, rest)

    radius = 2.0 * uncertainty.position + space.tolerance.length
    if domain is None:
        # what reads 0 and is away from the target's area has free space outside it at its side
        target = Region(target.area, _beside_area(space, readings, target))
    box = _surroundings(space.contact, readings, target, radius, domain)
    free = Area.empty() if box is None else area_outside(space, target, domain, box)
    points, following = border(free)
    sources = together(rest, border_segments(points, following, readings))
    contact = _apart(space, target.contact, sources, radius, partial(alike_pairs, readings))
    if target.area.is_empty:
        return Region(target.area, contact)

    rays = (readings.direction - uncertainty.control, readings.direction + uncertainty.control)
    normals = inflate.tangent_normals(arc_tolerance, rays)
    margin = space.tolerance.length
    missed = rest.part(readings.zero[rest.feature]).near(target.area.bounds, radius)
    if domain is None:
        missed = missed.within(target.area.bounds, margin)  # beside the rest lies `free`
    if len(missed):
        missed = _off_border(space, readings, missed, sources.part(slice(len(rest), None)))
    near = sources.is_near(target.area.bounds, radius)[len(rest) :]
    area = inflate.shrunk_by(
        target.area,
        inflate.outward_pieces(points, following, radius, normals, near, depth=margin),
        inflate.stadium_pieces(missed.starts, missed.ends, radius, normals),
    )
    return Region(inflate.without_slivers(area, margin), contact)


def _without_position(
    space: ConfigurationSpace,
    readings: Readings,
    target: Region,
    rest: Segments,
    domain: Domain,
) -> Region:
    """The kernel at rho = inf: every Y alike X that is not inside T empties X."""
    free = area_outside(space, target, domain)
    features = np.concatenate((rest.feature, [readings.free][: not free.is_empty]))
    features = _distinct(readings, features.astype(np.int32))
    edges, corners = target.contact.edge, target.contact.vertices
    own = np.concatenate((edges, readings.size + corners, [readings.free])).astype(np.int32)
    told = np.ones(len(own), dtype=np.bool_)
    for feature in features:
        told &= ~alike(readings, int(feature), own)
    keep, corner = told[: len(edges)], told[len(edges) : -1]
    contact = ContactSet(
        edges[keep], target.contact.low[keep], target.contact.high[keep], corners[corner]
    )
    return Region(target.area if told[-1] else Area.empty(), contact)


def _with_exact_position(
    space: ConfigurationSpace, readings: Readings, target: Region, rest: Segments
) -> Region:
    """The kernel at rho = 0: D(0) is a point, so vertices are confused that lie on each other."""
    corners = space.contact.points[target.contact.vertices]
    others = rest.part(rest.feature >= readings.size)
    margin = space.tolerance.length
    first, second = inflate.box_pairs(
        corners - margin, corners + margin, others.starts, others.starts
    )
    own = readings.size + target.contact.vertices[first]
    confused = first[alike_pairs(readings, own, others.feature[second])]
    contact = ContactSet(
        target.contact.edge,
        target.contact.low,
        target.contact.high,
        np.delete(target.contact.vertices, confused),
    )
    return Region(target.area, contact)


def _apart(
    space: ConfigurationSpace,
    part: ContactSet,
    sources: Segments,
    radius: float,
    confused: Callable[[Indices, Indices], Bools],
) -> ContactSet:
    """What of a part of contact space is at least `radius` from all that it is confused with.

    Parameters
    ----------
    confused : which of these features, pair by pair, are confused.
    """
    contact = space.contact
    low = np.minimum(sources.starts, sources.ends) - radius
    high = np.maximum(sources.starts, sources.ends) + radius

    begin, end = contact.at(part.edge, part.low), contact.at(part.edge, part.high)
    first, second = inflate.box_pairs(np.minimum(begin, end), np.maximum(begin, end), low, high)
    chosen = confused(part.edge[first], sources.feature[second])
    edge, source = part.edge[first[chosen]], sources.part(second[chosen])
    near, far = stretches(contact, edge, source, radius)
    met = near < far
    cut = ContactSet(edge[met], near[met], far[met], np.empty(0, dtype=np.int32))
    left = contact_set.difference(part, cut, space.tolerance.length)

    corners = contact.points[part.vertices]
    first, second = inflate.box_pairs(corners, corners, low, high)
    chosen = confused(len(contact) + part.vertices[first], sources.feature[second])
    first, second = first[chosen], second[chosen]
    met = distances(corners[first], sources.part(second)) < radius
    vertices = np.delete(part.vertices, first[met])
    return ContactSet(left.edge, left.low, left.high, vertices)


def _off_border(
    space: ConfigurationSpace, readings: Readings, part: Segments, rim: Segments
) -> Segments:
    """The parts of contact features that do not lie on a border: nothing grows twice."""
    contact, margin = space.contact, space.tolerance.length
    on_edge = part.feature < readings.size
    edge = part.feature[on_edge]
    ends = [np.hypot(*(end[on_edge] - contact.points[edge]).T) for end in (part.starts, part.ends)]
    corners = part.feature[~on_edge] - readings.size
    own = ContactSet.of(edge, np.minimum(*ends), np.maximum(*ends), corners, margin)
    # nearer than what the radius is larger by, so that nothing is lost beside what is cut out
    left = _apart(space, own, rim, 0.5 * margin, lambda first, second: np.full(len(first), True))
    return contact_segments(contact, left, readings)


def _beside_area(space: ConfigurationSpace, readings: Readings, target: Region) -> ContactSet:
    """The target's contact, where it reads 0 only within the box of the target's area."""
    contact, own = space.contact, target.contact
    edge_zero, corner_zero = readings.zero[own.edge], readings.zero[readings.size + own.vertices]
    if target.area.is_empty:
        keep = ~edge_zero
        return ContactSet(own.edge[keep], own.low[keep], own.high[keep], own.vertices[~corner_zero])
    margin = space.tolerance.length
    xmin, ymin, xmax, ymax = target.area.bounds
    start, tangent = contact.points[own.edge], contact.tangent[own.edge]
    low, high = own.low, own.high
    for axis, least, most in ((0, xmin, xmax), (1, ymin, ymax)):
        span = where_between(
            tangent[:, axis],
            start[:, axis],
            least - margin,
            most + margin,
        )
        low = np.where(edge_zero, np.maximum(low, span[0]), low)
        high = np.where(edge_zero, np.minimum(high, span[1]), high)
    keep = high - low > margin
    x, y = contact.points[own.vertices].T
    inside = (xmin - margin <= x) & (x <= xmax + margin)
    inside &= (ymin - margin <= y) & (y <= ymax + margin)
    return ContactSet(own.edge[keep], low[keep], high[keep], own.vertices[inside | ~corner_zero])


def _surroundings(
    contact: ContactSpace, readings: Readings, target: Region, radius: float, domain: Domain
) -> Box | None:
    """The box in which free space outside the target matters: around what of it reads 0."""
    # further than any radius on the outer side reaches, so that the box's own border is not met
    margin = 2.0 * radius
    if domain is None:
        if target.area.is_empty:
            return None
        xmin, ymin, xmax, ymax = target.area.bounds
        return xmin - margin, ymin - margin, xmax + margin, ymax + margin
    own = target.contact
    edge = readings.zero[own.edge]
    corner = readings.zero[readings.size + own.vertices]
    points = [
        contact.at(own.edge[edge], own.low[edge]),
        contact.at(own.edge[edge], own.high[edge]),
        contact.points[own.vertices[corner]],
    ]
    if not target.area.is_empty:
        points.append(np.reshape(target.area.bounds, (2, 2)))
    every = np.concatenate(points)
    if not len(every):
        return None
    xmin, ymin = np.min(every, axis=0) - margin
    xmax, ymax = np.max(every, axis=0) + margin
    return float(xmin), float(ymin), float(xmax), float(ymax)


def _distinct(readings: Readings, features: Ints) -> Ints:
    """One feature of each kind of reading set."""
    kinds = np.stack(
        (readings.zero[features], readings.center[features], readings.half[features]), axis=1
    )
    _, first = np.unique(kinds, axis=0, return_index=True)
    return features[first]
