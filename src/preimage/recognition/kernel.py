"""Kernels: the part of a target that no reading confuses with the rest of a domain (theory 5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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
from preimage.recognition.segments import Segments
from preimage.recognition.surroundings import Meetings, Surroundings, surroundings
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
    rays = (readings.direction - uncertainty.control, readings.direction + uncertainty.control)
    core = core_of(space, target, uncertainty, rays, domain, arc_tolerance=arc_tolerance)
    return core.kernel(readings)


@dataclass(frozen=True, slots=True, eq=False)
class Core:
    """What the kernels of one target have in common, whatever is commanded.

    Parameters
    ----------
    target, domain : T and Delta.
    area : the target's area without what is near to free space outside it.
    around : what is near to the target outside it; None without a position sensor.
    radius : how near; larger than 2 rho by the tolerance.
    normals : of the tangents that replace arcs.
    """

    space: ConfigurationSpace
    target: Region
    domain: Domain
    area: Area
    around: Surroundings | None
    radius: float
    normals: inflate.Floats

    def kernel(self, readings: Readings) -> Region:
        """The kernel for one command."""
        if self.around is None:
            return _without_position(self.space, readings, self.target, self.domain)
        contact = self.contact(readings)
        hidden = self.hidden(readings)
        if not len(hidden):
            return Region(self.area, contact)
        return Region(self.without(self.area, hidden), contact)

    def contact(self, readings: Readings) -> ContactSet:
        """The part of contact space in the kernel; there must be a position sensor."""
        assert self.around is not None
        near = self.around.meetings
        return _contact_kernel(self.space, readings, self.target.contact, near)

    def hidden(self, readings: Readings) -> Segments:
        """Contact outside the target that reads 0, beside free space in it: to be kept away from.

        There must be a position sensor.
        """
        assert self.around is not None
        hidden = self.around.hidden
        return hidden.part(readings.zero[hidden.feature])

    def around_all(self, parts: Sequence[Segments]) -> Area:
        """All that is near to some segments."""
        starts = np.concatenate([part.starts for part in parts])
        ends = np.concatenate([part.ends for part in parts])
        both = np.unique(np.concatenate((starts, ends), axis=1), axis=0)
        return inflate.united_pieces(
            inflate.stadium_pieces(both[:, :2], both[:, 2:], self.radius, self.normals)
        )

    def without(self, area: Area, hidden: Segments) -> Area:
        """An area without what is near to some segments."""
        pieces = inflate.stadium_pieces(hidden.starts, hidden.ends, self.radius, self.normals)
        rest = inflate.shrunk_by(area, pieces)
        return inflate.without_slivers(rest, self.space.tolerance.length)


def core_of(
    space: ConfigurationSpace,
    target: Region,
    uncertainty: Uncertainty,
    rays: Sequence[float],
    domain: Domain = None,
    *,
    arc_tolerance: float = inflate.ARC_TOLERANCE,
) -> Core:
    """What the kernels of a target for several commands have in common; see `kernel`.

    Parameters
    ----------
    rays : the sides of the control cones of all these commands, which touch what replaces arcs.
    """
    radius = confusion_radius(space, uncertainty)
    normals = inflate.tangent_normals(arc_tolerance, tuple(rays))
    if np.isinf(radius):
        return Core(space, target, domain, target.area, None, radius, normals)
    around = surroundings(space, target, radius, domain)
    area = around.straight
    if not area.is_empty:
        area = inflate.shrunk_by(area, inflate.sector_pieces(around.wedges, radius, normals))
        area = inflate.without_slivers(area, space.tolerance.length)
    return Core(space, target, domain, area, around, radius, normals)


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
