"""What lies around a target, outside it, within twice the position error: for all commands."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Floats, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.geometry.border import border
from preimage.geometry.inflate import Wedges
from preimage.recognition.outside import (
    Domain,
    area_beside,
    border_segments,
    contact_beside,
    contact_segments,
)
from preimage.recognition.segments import (
    Box,
    Segments,
    distances,
    stretches,
    together,
    where_between,
)


@dataclass(frozen=True, slots=True, eq=False)
class Meetings:
    """What of a target's contact is nearer than a radius to which features outside the target.

    Parameters
    ----------
    edge, edge_other, near, far : (p,) on edge `edge`, between the distances `near` and `far` from
        its start, feature `edge_other` is nearer.
    vertex, vertex_other : (q,) pairs of a vertex of the target and a feature that is nearer.
    """

    edge: Ints
    edge_other: Ints
    near: Floats
    far: Floats
    vertex: Ints
    vertex_other: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What would be taken from a target if all features were alike, piece by piece (theory 5).

    Which features are alike is up to the command; all else is the same for every command.

    Parameters
    ----------
    meetings : what is taken from the target's contact.
    straight : the target's area without what is near the sides of free space outside it.
    wedges : the corners of free space outside it, which take sectors of discs from that.
    hidden : the parts of contact space outside the target, as segments, that have no free space
        outside it at their side; those that read 0 are to be taken from the area besides.
    """

    meetings: Meetings
    straight: Area
    wedges: Wedges
    hidden: Segments


@lru_cache(maxsize=16)
def surroundings(
    space: ConfigurationSpace, target: Region, radius: float, domain: Domain = None
) -> Surroundings:
    """What of the domain outside the target comes nearer to it than `radius`; positive, finite.

    One target is looked at with many commands: the answer is kept for the same objects.
    """
    contact, margin = space.contact, space.tolerance.length
    reach = 2.0 * radius
    rest = contact_segments(contact, contact_beside(space, target, domain, reach))
    box = _box(space, target, domain, reach)
    free = Area.empty() if box is None else area_beside(space, target, domain, box, reach)
    points, following = border(free)
    rim = border_segments(contact, points, following)
    near = meetings(space, target.contact, together(rest, rim), radius)
    if domain is None:
        near = _joined(near, _beside(space, target))

    straight, wedges, hidden = target.area, Wedges.none(), rest.part(slice(0, 0))
    if not target.area.is_empty:
        bounds = target.area.bounds
        chosen = rim.is_near(bounds, radius)
        sides, wedges = inflate.rectangle_pieces(points, following, radius, chosen, margin)
        straight = inflate.without_slivers(inflate.shrunk_by(target.area, sides), margin)
        wedges = wedges.near(straight, radius)
        hidden = rest.near(bounds, radius)
        if domain is None:
            hidden = hidden.within(bounds, margin)  # beside the rest lies `free`
        if len(hidden):
            hidden = _off_border(space, hidden, rim)
    return Surroundings(near, straight, wedges, hidden)


def _box(space: ConfigurationSpace, target: Region, domain: Domain, margin: float) -> Box | None:
    """Where free space outside the target matters: around it, with room to spare.

    Without a domain around its area alone; as for contact, see `_beside`.
    """
    points = [np.reshape(target.area.bounds, (2, 2))] if not target.area.is_empty else []
    if domain is not None:
        segments = contact_segments(space.contact, target.contact)
        points += [segments.starts, segments.ends]
    every = np.concatenate(points) if points else np.empty((0, 2))
    if not len(every):
        return None
    xmin, ymin = np.min(every, axis=0) - margin
    xmax, ymax = np.max(every, axis=0) + margin
    return float(xmin), float(ymin), float(xmax), float(ymax)


def meetings(
    space: ConfigurationSpace, part: ContactSet, sources: Segments, radius: float
) -> Meetings:
    """Which stretches of edges, and which vertices, have which features nearer than `radius`.

    Parameters
    ----------
    radius : positive, finite.
    """
    contact = space.contact
    low = np.minimum(sources.starts, sources.ends) - radius
    high = np.maximum(sources.starts, sources.ends) + radius

    begin, end = contact.at(part.edge, part.low), contact.at(part.edge, part.high)
    first, second = inflate.box_pairs(np.minimum(begin, end), np.maximum(begin, end), low, high)
    edge, source = part.edge[first], sources.part(second)
    near, far = stretches(contact, edge, source, radius)
    near, far = np.maximum(near, part.low[first]), np.minimum(far, part.high[first])
    met = near < far

    corners = contact.points[part.vertices]
    first, second = inflate.box_pairs(corners, corners, low, high)
    close = distances(corners[first], sources.part(second)) < radius
    return Meetings(
        edge=edge[met],
        edge_other=source.feature[met],
        near=near[met],
        far=far[met],
        vertex=part.vertices[first[close]],
        vertex_other=sources.feature[second[close]],
    )


def _beside(space: ConfigurationSpace, target: Region) -> Meetings:
    """What of the target's contact lies outside the box of its area.

    It has free space outside the target at its side, at no distance.
    """
    contact, own, margin = space.contact, target.contact, space.tolerance.length
    free = 2 * len(contact)
    low, high = own.low.copy(), own.low.copy()
    inside = np.zeros(len(own.vertices), dtype=np.bool_)
    if not target.area.is_empty:
        xmin, ymin, xmax, ymax = target.area.bounds
        start, tangent = contact.points[own.edge], contact.tangent[own.edge]
        high = own.high.copy()
        for axis, least, most in ((0, xmin, xmax), (1, ymin, ymax)):
            span = where_between(tangent[:, axis], start[:, axis], least - margin, most + margin)
            low, high = np.maximum(low, span[0]), np.minimum(high, span[1])
        outer = low >= high
        low[outer] = high[outer] = own.low[outer]
        x, y = contact.points[own.vertices].T
        inside = (xmin - margin <= x) & (x <= xmax + margin)
        inside &= (ymin - margin <= y) & (y <= ymax + margin)
    edge = np.concatenate((own.edge, own.edge))
    near, far = np.concatenate((own.low, high)), np.concatenate((low, own.high))
    met = near < far
    vertex = own.vertices[~inside]
    return Meetings(
        edge=edge[met],
        edge_other=np.full(np.count_nonzero(met), free, np.int32),
        near=near[met],
        far=far[met],
        vertex=vertex,
        vertex_other=np.full(len(vertex), free, np.int32),
    )


def _off_border(space: ConfigurationSpace, part: Segments, rim: Segments) -> Segments:
    """The parts of contact features that do not lie on a border: nothing grows twice."""
    contact, margin = space.contact, space.tolerance.length
    on_edge = part.feature < len(contact)
    edge = part.feature[on_edge]
    ends = [np.hypot(*(end[on_edge] - contact.points[edge]).T) for end in (part.starts, part.ends)]
    corners = part.feature[~on_edge] - len(contact)
    own = ContactSet.of(edge, np.minimum(*ends), np.maximum(*ends), corners, margin)
    # nearer than what the radius is larger by, so that nothing is lost beside what is cut out
    on = meetings(space, own, rim, 0.5 * margin)
    cut = ContactSet(on.edge, on.near, on.far, np.unique(on.vertex))
    return contact_segments(contact, contact_set.difference(own, cut, margin))


def _joined(first: Meetings, second: Meetings) -> Meetings:
    return Meetings(
        edge=np.concatenate((first.edge, second.edge)),
        edge_other=np.concatenate((first.edge_other, second.edge_other)),
        near=np.concatenate((first.near, second.near)),
        far=np.concatenate((first.far, second.far)),
        vertex=np.concatenate((first.vertex, second.vertex)),
        vertex_other=np.concatenate((first.vertex_other, second.vertex_other)),
    )
