"""What of a domain lies outside a target: the configurations that must not be mistaken for it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import ContactSpace, Floats, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.geometry.border import border
from preimage.recognition.segments import Box, Segments

Domain = Region | None
"""What certainly holds the robot whenever a condition is looked at; all of valid space if None."""

NODING = 16.0
"""Areas are subtracted on a grid this much coarser than that of contact space: whatever rounding
did to a target's border, it then runs along the border of free space without slivers between."""

FEW_EDGES = 500
"""In scenes with no more edges, looking for what is near costs more than it saves."""


@dataclass(frozen=True, slots=True, eq=False)
class Outside:
    """`Delta - T`, feature by feature (theory 5).

    Parameters
    ----------
    area : what free space has of it.
    contact : what contact space has of it.
    """

    area: Area
    contact: ContactSet

    @property
    def is_empty(self) -> bool:
        """The whole domain lies in the target."""
        return self.area.is_empty and self.contact.is_empty


@lru_cache(maxsize=16)
def outside(space: ConfigurationSpace, target: Region, domain: Domain = None) -> Outside:
    """`Delta - T`: what of the domain lies outside the target.

    One target is looked at with many commands: the answer is kept for the same objects.
    """
    return Outside(area_outside(space, target, domain), contact_outside(space, target, domain))


def area_outside(space: ConfigurationSpace, target: Region, domain: Domain = None) -> Area:
    """The part of free space in the domain that lies outside the target; regular, closed."""
    area = space.free if domain is None else domain.area
    return _without(space, area, target.area)


def area_beside(
    space: ConfigurationSpace, target: Region, domain: Domain, box: Box, distance: float
) -> Area:
    """The same as far as it is no further than `distance` from the target; else anything.

    Of free space only the holes near the target are looked at: what a target costs depends on its
    own border, not on the scene.

    Parameters
    ----------
    box : no part of the target is nearer to what is outside it than `distance`.
    """
    area, inner = space.free if domain is None else domain.area, target.area
    if len(space.contact) > FEW_EDGES and not area.is_empty:
        if domain is None:
            part = contact_segments(space.contact, target.contact)
            area, inner = space.porous.beside(inner, part.starts, part.ends, distance)
        area = areas.within_box(area, *box)
    return _without(space, area, inner)


def _without(space: ConfigurationSpace, area: Area, inner: Area) -> Area:
    if inner.is_empty or area.is_empty:
        return area
    rest = areas.difference_on_grid(area, inner, NODING * space.tolerance.grid)
    return inflate.without_slivers(rest, space.tolerance.length)


def contact_outside(space: ConfigurationSpace, target: Region, domain: Domain = None) -> ContactSet:
    """The part of contact space in the domain that lies outside the target, closed on each edge.

    Without the vertices at the open border: who is there has escaped, and no motion may lead there.
    """
    whole = ContactSet.whole(space.contact) if domain is None else domain.contact
    rest = contact_set.difference(whole, target.contact, space.tolerance.length)
    return contact_set.without_outermost(rest, space.contact)


def contact_beside(
    space: ConfigurationSpace, target: Region, domain: Domain, distance: float
) -> ContactSet:
    """The same as far as it is no further than `distance` from the target, and maybe more."""
    contact = space.contact
    if domain is not None or len(contact) <= FEW_EDGES:
        return contact_outside(space, target, domain)
    points, following = border(target.area)
    part = contact_segments(contact, target.contact)
    _, near = contact.index.near_segments(
        np.concatenate((points, part.starts)),
        np.concatenate((points[following], part.ends)),
        distance,
    )
    edge = np.unique(near)
    corner = np.union1d(edge, contact.next[edge])
    corner = corner[~(contact.open[corner] & contact.open[contact.previous[corner]])]
    edge = edge[~contact.open[edge]]
    here = ContactSet(edge, np.zeros(len(edge)), contact.length[edge], corner)
    rest = contact_set.difference(here, target.contact, space.tolerance.length)
    return contact_set.without_outermost(rest, contact)


def contact_segments(contact: ContactSpace, part: ContactSet) -> Segments:
    """The intervals, as segments, and the vertices, as points."""
    corners = contact.points[part.vertices]
    return Segments(
        np.concatenate((contact.at(part.edge, part.low), corners)),
        np.concatenate((contact.at(part.edge, part.high), corners)),
        np.concatenate((part.edge, len(contact) + part.vertices)),
    )


def border_segments(contact: ContactSpace, points: Floats, following: Ints) -> Segments:
    """The border of a part of free space, which stands for it as long as nothing is inside it."""
    feature = np.full(len(points), 2 * len(contact), dtype=np.int32)
    return Segments(points, points[following], feature)
