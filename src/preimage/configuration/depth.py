"""How far one set lies inside another, feature by feature."""

from __future__ import annotations

import math

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind
from preimage.geometry.area import Area, Floats
from preimage.geometry.nearness import gap

SHARED = 16.0
"""A border so many tolerances from that of free space is free space's own."""


def depth_within(part: Region, whole: Region, space: ConfigurationSpace) -> float:
    """How far a region is from the border of another one that holds it, within its features.

    Where a feature itself ends, nothing can fail: the ends of edges and the border of free space
    do not count, and vertices belong or do not. In the unit of length; infinite if nothing else
    counts, and 0 where an interval of an edge lies in none of the other region's.
    """
    best = math.inf
    own = part.contact
    for edge, low, high in zip(own.edge.tolist(), own.low.tolist(), own.high.tolist(), strict=True):
        best = min(best, _along(edge, low, high, whole, space))
    if not part.area.is_empty:
        best = min(best, gap(part.area.segments, inner_border(whole.area, space)))
    return best


def depth_of_start(start: Start, region: Region, space: ConfigurationSpace) -> float:
    """The same for the start of a plan, which the region must hold.

    A start in free space, moved within free space by less, is in the region still; one on an edge,
    moved along it by less.
    """
    if start.kind is StartKind.REGION:
        return depth_within(start.region, region, space)
    if start.kind is StartKind.EDGE_POINT:
        return _along(start.edge, start.distance, start.distance, region, space)
    if start.kind is StartKind.VERTEX or start.point is None:
        return math.inf
    point = np.array([start.point])
    return gap((point, point), inner_border(region.area, space))


def inner_border(area: Area, space: ConfigurationSpace) -> tuple[Floats, Floats]:
    """The segments of an area's border that do not run along the border of free space."""
    starts, ends = area.segments
    if not len(starts):
        return starts, ends
    reach = SHARED * space.tolerance.length
    middles = 0.5 * (starts + ends)
    on, _ = space.contact.index.near_points(middles, reach)[:2]
    keep = np.ones(len(starts), dtype=np.bool_)
    keep[on] = False
    return starts[keep], ends[keep]


def _along(edge: int, low: float, high: float, whole: Region, space: ConfigurationSpace) -> float:
    """How far a part of an edge is from the ends of the interval that holds it."""
    slack = SHARED * space.tolerance.length
    length = float(space.contact.length[edge])
    on = np.flatnonzero(whole.contact.edge == edge)
    for begin, end in zip(
        whole.contact.low[on].tolist(), whole.contact.high[on].tolist(), strict=True
    ):
        if begin - slack <= low and high <= end + slack:
            before = low - begin if begin > slack else math.inf
            after = end - high if end < length - slack else math.inf
            return max(0.0, min(before, after))
    return 0.0
