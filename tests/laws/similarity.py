"""Scenes and regions turned, moved, scaled and mirrored; and how far regions differ."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from preimage.configuration.contact import ContactSpace
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area
from preimage.geometry.tolerance import Tolerance

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Similarity:
    """`p -> scale * turn(mirror(p)) + shift`; the mirror sends x to -x.

    Parameters
    ----------
    turn : radians; quarter turns are exact.
    """

    turn: float = 0.0
    scale: float = 1.0
    shift: tuple[float, float] = (0.0, 0.0)
    mirrored: bool = False

    @property
    def matrix(self) -> Floats:
        """(2, 2)."""
        cosine, sine = math.cos(self.turn), math.sin(self.turn)
        quarters = self.turn / (0.5 * math.pi)
        if abs(quarters - round(quarters)) < 1e-12:
            cosine, sine = float(round(cosine)), float(round(sine))
        flip = -1.0 if self.mirrored else 1.0
        return self.scale * np.array([[flip * cosine, -sine], [flip * sine, cosine]])

    def points(self, points: Floats) -> Floats:
        """(n, 2) points moved."""
        return np.asarray(points @ self.matrix.T + self.shift)

    def angle(self, angle: float) -> float:
        """A direction moved."""
        return (math.pi - angle if self.mirrored else angle) + self.turn

    def shape(self, shape: BaseGeometry) -> BaseGeometry:
        """A shapely geometry moved."""
        moved: BaseGeometry = shapely.transform(shape, self.points)
        return moved

    def space(self, space: ConfigurationSpace) -> ConfigurationSpace:
        """A configuration space moved; its window is the box around the moved window."""
        free = Area(shapely.orient_polygons(self.shape(space.free.geometry), exterior_cw=False))
        window = shapely.transform(shapely.box(*space.window), self.points).bounds
        old = space.contact
        points, following, is_open = self.points(old.points), old.next, old.open
        if self.mirrored:
            following = old.previous
            is_open = old.open[old.previous]
        return ConfigurationSpace(
            window,
            Tolerance.for_window(*window),
            free,
            Area(self.shape(space.obstacles.geometry)),
            ContactSpace(points, following, is_open),
        )

    def region(self, region: Region, contact: ContactSpace) -> Region:
        """A region of a space moved with it; `contact` is that of the space before."""
        old = region.contact
        edge, low, high = old.edge, self.scale * old.low, self.scale * old.high
        if self.mirrored:
            length = self.scale * contact.length[old.edge]
            edge, low, high = contact.next[old.edge], length - high, length - low
        moved = ContactSet.of(edge, low, high, old.vertices, 0.0)
        return Region(Area(self.shape(region.area.geometry)), moved)


def gap(a: Area, b: Area) -> float:
    """How thick the symmetric difference of two areas is at most, roughly."""
    rest = shapely.symmetric_difference(a.geometry, b.geometry)
    if rest.is_empty or rest.area == 0.0:
        return 0.0
    thickness = [2.0 * part.area / part.length for part in shapely.get_parts(rest) if part.length]
    return max(thickness, default=0.0)


def contact_gap(a: ContactSet, b: ContactSet) -> float:
    """The longest interval that is in one of two sets alone; infinite if their vertices differ."""
    if a.vertices.tolist() != b.vertices.tolist():
        return math.inf
    longest = 0.0
    for one, other in ((a, b), (b, a)):
        for edge, low, high in zip(
            one.edge.tolist(), one.low.tolist(), one.high.tolist(), strict=True
        ):
            on = other.edge == edge
            place = low
            for begin, end in zip(other.low[on].tolist(), other.high[on].tolist(), strict=True):
                longest = max(longest, min(begin, high) - place)
                place = max(place, end)
            longest = max(longest, high - place)
    return longest


def same(a: Region, b: Region, slack: float) -> bool:
    """Whether two regions of one space are equal, up to pieces no thicker than the slack."""
    return gap(a.area, b.area) <= slack and contact_gap(a.contact, b.contact) <= slack


def within(a: Region, b: Region, slack: float) -> bool:
    """Whether a region lies in another, up to pieces no thicker than the slack."""
    rest = shapely.difference(a.area.geometry, b.area.geometry)
    thick = [2.0 * part.area / part.length for part in shapely.get_parts(rest) if part.length]
    if max(thick, default=0.0) > slack:
        return False
    if not set(a.contact.vertices.tolist()) <= set(b.contact.vertices.tolist()):
        return False
    both = ContactSet.of(
        np.concatenate((a.contact.edge, b.contact.edge)),
        np.concatenate((a.contact.low, b.contact.low)),
        np.concatenate((a.contact.high, b.contact.high)),
        b.contact.vertices,
        0.0,
    )
    return contact_gap(both, b.contact) <= slack
