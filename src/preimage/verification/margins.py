"""How far one set lies inside another, feature by feature."""

from __future__ import annotations

import math

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind
from preimage.geometry.area import Area
from preimage.verification.distances import Floats, apart

SHARED = 16.0
"""A border so many tolerances from that of free space is free space's own."""


def margin_within(part: Region, whole: Region, space: ConfigurationSpace) -> float:
    """How far a region is from the border of another one that holds it, within its features.

    Where a feature itself ends, nothing can fail: the ends of edges and the border of free space
    do not count, and vertices belong or do not. Infinite if nothing else counts.
    """
    best = math.inf
    own = part.contact
    for edge, low, high in zip(own.edge.tolist(), own.low.tolist(), own.high.tolist(), strict=True):
        best = min(best, _along(edge, low, high, whole, space))
    if not part.area.is_empty:
        rim = inner_border(whole.area, space)
        if len(rim[0]):
            best = min(best, float(np.min(apart(part.area.segments, rim))))
    return best


def of_start(start: Start, region: Region, space: ConfigurationSpace) -> float:
    """The same for the start of a plan."""
    if start.kind is StartKind.REGION:
        return margin_within(start.region, region, space)
    if start.kind is StartKind.EDGE_POINT:
        return _along(start.edge, start.distance, start.distance, region, space)
    if start.kind is StartKind.VERTEX or start.point is None:
        return math.inf
    rim = inner_border(region.area, space)
    point = np.array([start.point])
    return float(np.min(apart((point, point), rim))) if len(rim[0]) else math.inf


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
