"""Kernels: the part of a target that no reading confuses with the rest of a domain (theory 5)."""

from __future__ import annotations

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.recognition.confusion import confusion_radius
from preimage.recognition.outside import Domain, outside
from preimage.recognition.readings import Readings, alike, alike_pairs
from preimage.recognition.surroundings import Meetings, surroundings
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
    uncertainty : rho is its position; `inf` leaves of each feature all or nothing, and 0 counts
        as the tolerance: what touches is then told apart by force alone.
    domain : Delta; all of valid space by default.
    arc_tolerance : how far arcs may be off, as a fraction of their radius 2 rho.

    Returns
    -------
    The kernel, without slivers: no area is thinner, no interval shorter than the tolerance. Radii
    are taken larger by the tolerance, so that what touches within rounding stays on the safe side.
    """
    if np.isinf(uncertainty.position):
        return _without_position(space, readings, target, domain)
    radius = confusion_radius(space, uncertainty)
    around = surroundings(space, target, radius, domain)
    contact = _contact_kernel(space, readings, target.contact, around.meetings)
    if around.straight.is_empty:
        return Region(Area.empty(), contact)
    rays = (readings.direction - uncertainty.control, readings.direction + uncertainty.control)
    normals = inflate.tangent_normals(arc_tolerance, rays)
    hidden = around.hidden.part(readings.zero[around.hidden.feature])
    area = inflate.shrunk_by(
        around.straight,
        inflate.sector_pieces(around.wedges, radius, normals),
        inflate.stadium_pieces(hidden.starts, hidden.ends, radius, normals),
    )
    return Region(inflate.without_slivers(area, space.tolerance.length), contact)


def _contact_kernel(
    space: ConfigurationSpace, readings: Readings, target: ContactSet, near: Meetings
) -> ContactSet:
    """What of contact space in the target is not near to anything that is alike.

    Without what is at the open border: who is there has escaped.
    """
    met = alike_pairs(readings, near.edge, near.edge_other)
    confused = alike_pairs(readings, readings.size + near.vertex, near.vertex_other)
    cut = ContactSet(
        near.edge[met], near.near[met], near.far[met], np.unique(near.vertex[confused])
    )
    left = contact_set.difference(target, cut, space.tolerance.length)
    return contact_set.without_outermost(left, space.contact)


def _without_position(
    space: ConfigurationSpace, readings: Readings, target: Region, domain: Domain
) -> Region:
    """The kernel at rho = inf: every Y alike X that is not inside T empties X."""
    rest = outside(space, target, domain)
    own, n = target.contact, readings.size
    others = [rest.contact.edge, n + rest.contact.vertices]
    if not rest.area.is_empty:
        others.append(np.array([readings.free], dtype=np.int32))
    features = np.concatenate((own.edge, n + own.vertices, [readings.free])).astype(np.int32)
    told = np.ones(len(features), dtype=np.bool_)
    for other in _distinct(readings, np.concatenate(others)):
        told &= ~alike(readings, int(other), features)
    keep, corner = told[: len(own.edge)], told[len(own.edge) : -1]
    contact = ContactSet(own.edge[keep], own.low[keep], own.high[keep], own.vertices[corner])
    contact = contact_set.without_outermost(contact, space.contact)
    return Region(target.area if told[-1] else Area.empty(), contact)


def _distinct(readings: Readings, features: Ints) -> Ints:
    """One feature of each kind of reading set."""
    kinds = np.stack(
        (readings.zero[features], readings.center[features], readings.half[features]), axis=1
    )
    _, first = np.unique(kinds, axis=0, return_index=True)
    return features[first]
