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
from preimage.recognition.segments import Box, Segments

Domain = Region | None
"""What certainly holds the robot whenever a condition is looked at; all of valid space if None."""

NODING = 16.0
"""Areas are subtracted on a grid this much coarser than that of contact space: whatever rounding
did to a target's border, it then runs along the border of free space without slivers between."""

FEW_EDGES = 200
"""In scenes with no more edges, cutting out a part of free space costs more than it saves."""


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


def area_outside(
    space: ConfigurationSpace, target: Region, domain: Domain = None, box: Box | None = None
) -> Area:
    """The part of free space in the domain that lies outside the target; regular, closed.

    Parameters
    ----------
    box : the area is wanted only here; everywhere by default.
    """
    area = space.free if domain is None else domain.area
    if box is not None and len(space.contact) > FEW_EDGES and not area.is_empty:
        area = areas.within_box(area, *box)
    if target.area.is_empty or area.is_empty:
        return area
    rest = areas.difference_on_grid(area, target.area, NODING * space.tolerance.grid)
    return inflate.without_slivers(rest, space.tolerance.length)


def contact_outside(space: ConfigurationSpace, target: Region, domain: Domain = None) -> ContactSet:
    """The part of contact space in the domain that lies outside the target, closed on each edge.

    Without the vertices at the open border: who is there has escaped, and no motion may lead there.
    """
    whole = ContactSet.whole(space.contact) if domain is None else domain.contact
    rest = contact_set.difference(whole, target.contact, space.tolerance.length)
    return contact_set.without_outermost(rest, space.contact)


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
