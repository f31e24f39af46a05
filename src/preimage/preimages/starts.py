"""The regions in which motions begin, made larger or smaller by a few tolerances."""

from __future__ import annotations

import math

import numpy as np

from preimage.configuration.contact import Floats
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.angles import unit
from preimage.geometry.area import Area
from preimage.reachability.assembly import attach

AROUND = 64.0
"""A start is taken to reach so many tolerances around what it is."""

INSIDE = 4.0
"""A region is pulled in by so many tolerances."""

FLAT = 256.0
"""On edges that are all but parallel to a side of the cone, by so many times more at most."""


def start_as_region(start: Start, space: ConfigurationSpace) -> Region:
    """A region around a start: what a plan may count on, and `AROUND` tolerances more.

    A point in free space becomes a square, one on an edge an interval; a vertex stays what it is.
    """
    margin = AROUND * space.tolerance.length
    none = np.empty(0, dtype=np.int32)
    match start.kind:
        case StartKind.VERTEX:
            corners = np.unique(np.array(start.vertices, dtype=np.int32))
            return Region(Area.empty(), ContactSet(none, np.empty(0), np.empty(0), corners))
        case StartKind.EDGE_POINT:
            place, edge = np.array([start.distance]), np.array([start.edge], dtype=np.int32)
            return Region(Area.empty(), _longer(ContactSet(edge, place, place, none), space))
        case StartKind.FREE_POINT:
            assert start.point is not None
            x, y = start.point
            square = Area.box(x - margin, y - margin, x + margin, y + margin)
            return Region(areas.intersection(square, space.free), ContactSet.empty())
        case StartKind.REGION:
            area = start.region.area
            if not area.is_empty:
                area = areas.intersection(inflate.grow(area, margin), space.free)
            return Region(area, _longer(start.region.contact, space))


def _longer(contact: ContactSet, space: ConfigurationSpace) -> ContactSet:
    """Intervals that reach a little further on their edges."""
    margin = AROUND * space.tolerance.length
    low = np.maximum(contact.low - margin, 0.0)
    high = np.minimum(contact.high + margin, space.contact.length[contact.edge])
    return ContactSet.of(contact.edge, low, high, contact.vertices, space.tolerance.length)


def pulled_in(
    region: Region, space: ConfigurationSpace, cone: tuple[float, float], more: float = 0.0
) -> Region:
    """A region without what is nearer than `INSIDE` tolerances to its borders.

    Nature may lead a motion from the border of a backprojection along that border, past the
    target; from further inside it may not. Where the region ends with free space, or with an edge,
    it stays what it is, and vertices do. On edges the margin is measured across the sides of the
    control cone: that far, flights pass by.

    Parameters
    ----------
    cone : the angles of its sides, radians.
    more : what the margin is larger by, in the unit of length.
    """
    near = space.tolerance.length
    margin = INSIDE * near + more
    return Region(_inner_area(region.area, space, margin), _shorter(region, space, cone, margin))


def _inner_area(area: Area, space: ConfigurationSpace, margin: float) -> Area:
    if area.is_empty:
        return area
    starts, ends = _inner_border(area, space)
    if not len(starts):
        return area
    normals = inflate.tangent_normals(inflate.ARC_TOLERANCE)
    rest = inflate.shrunk_by(area, inflate.stadium_pieces(starts, ends, margin, normals))
    return inflate.without_slivers(rest, space.tolerance.length)


def _inner_border(area: Area, space: ConfigurationSpace) -> tuple[Floats, Floats]:
    """The border inside free space, and along open sides of the window."""
    found = attach(area, space)
    nodes, contact = found.nodes, space.contact
    on = contact.open[found.beside_edge]
    edge, low, high = found.beside_edge[on], found.beside_low[on], found.beside_high[on]
    return (
        np.concatenate((nodes[found.segment_from], contact.at(edge, low))),
        np.concatenate((nodes[found.segment_to], contact.at(edge, high))),
    )


def _shorter(
    region: Region, space: ConfigurationSpace, cone: tuple[float, float], margin: float
) -> ContactSet:
    contact, near = region.contact, space.tolerance.length
    tangent = space.contact.tangent[contact.edge]
    sides = np.array([unit(angle) for angle in cone])
    across = np.min(
        np.abs(tangent[:, :1] * sides[:, 1] - tangent[:, 1:] * sides[:, 0]), axis=1, initial=1.0
    )
    off = margin / np.maximum(across, 1.0 / FLAT)
    length = space.contact.length[contact.edge]
    low = np.where(contact.low > near, contact.low + off, contact.low)
    high = np.where(contact.high < length - near, contact.high - off, contact.high)
    keep = high - low > near
    return ContactSet(contact.edge[keep], low[keep], high[keep], contact.vertices)


def span(space: ConfigurationSpace) -> float:
    """The longest way that fits into the window."""
    xmin, ymin, xmax, ymax = space.window
    return math.hypot(xmax - xmin, ymax - ymin)
