"""Regions of valid space: an area of free space together with a part of contact space."""

from __future__ import annotations

from dataclasses import dataclass

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.tolerance import Tolerance


@dataclass(frozen=True, slots=True, eq=False)
class Region:
    """A goal, kernel, target or preimage: a subset of valid space (theory 1).

    The area speaks of free space alone; which contact configurations belong is said by `contact`,
    also along the area's border.
    """

    area: Area
    contact: ContactSet

    @classmethod
    def empty(cls) -> Region:
        """The empty region."""
        return cls(Area.empty(), ContactSet.empty())

    @property
    def is_empty(self) -> bool:
        """Neither free space nor contact."""
        return self.area.is_empty and self.contact.is_empty


def union(a: Region, b: Region, tolerance: Tolerance) -> Region:
    """All configurations of `a` or `b`."""
    if a.area.is_empty or b.area.is_empty:
        area = a.area if b.area.is_empty else b.area
    else:
        area = areas.union(a.area, b.area)
    return Region(area, contact_set.union(a.contact, b.contact, tolerance.length))


def intersection(a: Region, b: Region, tolerance: Tolerance) -> Region:
    """All configurations of both, regularised in free space and on each edge."""
    return Region(
        areas.intersection(a.area, b.area),
        contact_set.intersection(a.contact, b.contact, tolerance.length),
    )


def is_subset(a: Region, b: Region, tolerance: Tolerance) -> bool:
    """Whether all of `a` lies in `b`, up to the tolerance."""
    return contact_set.is_subset(a.contact, b.contact, tolerance.length) and areas.is_subset(
        a.area, b.area, tolerance.length
    )
