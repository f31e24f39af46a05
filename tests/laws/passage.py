"""What a move passes, and where motions start."""

from __future__ import annotations

import math
from collections.abc import Sequence
from random import Random

import shapely

from preimage.configuration.region import Region
from tests.laws.world import AtVertex, Doing, Free, Move, OnEdge, State, World

SLACK = 1e-6
"""Starts are this far within a region, as a fraction of the window."""


def between(move: Move, share: float) -> State:
    """The state some way along a move."""
    x, y = (a + share * (b - a) for a, b in zip(move.start, move.stop, strict=True))
    if move.doing is Doing.SLIDES:
        begin, end = along_edge(move)
        return OnEdge(move.edge, begin + share * (end - begin))
    if move.doing is Doing.STICKS:
        return move.begin
    return Free(x, y)


def along_edge(move: Move) -> tuple[float, float]:
    """The places between which a slide leads, as distances from the start of its edge."""
    length = math.hypot(*(a - b for a, b in zip(move.start, move.stop, strict=True)))
    begin, end = move.begin, move.end
    if isinstance(begin, OnEdge):
        forward = isinstance(end, OnEdge) and end.along > begin.along
        forward |= isinstance(end, AtVertex) and end.vertex != move.edge
        return begin.along, begin.along + (length if forward else -length)
    assert isinstance(begin, AtVertex)
    if begin.vertex == move.edge:
        return 0.0, length
    if isinstance(end, OnEdge):
        return end.along + length, end.along
    return length, 0.0


def on_the_way(move: Move, region: Region, near: float) -> Sequence[State]:
    """States of a move, in its inside, that belong to a region: one for each piece."""
    if move.doing is Doing.SLIDES:
        begin, end = sorted(along_edge(move))
        on = region.contact.edge == move.edge
        found = []
        spans = zip(region.contact.low[on].tolist(), region.contact.high[on].tolist(), strict=True)
        for low, high in spans:
            low, high = max(low, begin), min(high, end)
            if high - low > near:
                found.append(OnEdge(move.edge, 0.5 * (low + high)))
        return found
    if move.doing is Doing.FLIES and not region.area.is_empty:
        path = shapely.LineString([move.start, move.stop])
        if path.length <= near:
            return []
        pieces = shapely.get_parts(shapely.intersection(path, region.area.geometry))
        return [
            Free(*shapely.get_coordinates(piece.interpolate(0.5, normalized=True))[0].tolist())
            for piece in pieces
            if piece.length > near
        ]
    return []


def resolved(world: World, region: Region) -> bool:
    """Whether a region has no interval that is too short to be seen here: a tie's remainder."""
    return bool((region.contact.high - region.contact.low > 4.0 * SLACK * world.size).all())


def starts(world: World, region: Region, rng: Random, count: int) -> list[State]:
    """States of a region: anywhere in it, near its border and near its corners."""
    found: list[State] = []
    area = region.area.geometry
    if not region.area.is_empty:
        xmin, ymin, xmax, ymax = area.bounds
        inner = shapely.buffer(area, -SLACK * world.size, join_style="mitre")
        for _ in range(4 * count):
            x, y = rng.uniform(xmin, xmax), rng.uniform(ymin, ymax)
            if shapely.intersects_xy(inner, x, y):
                found.append(Free(x, y))
        corners = shapely.get_coordinates(inner).tolist()
        found += [Free(x, y) for x, y in rng.sample(corners, min(count, len(corners)))]
        if not inner.is_empty:
            border = inner.boundary
            for _ in range(count):
                place = shapely.get_coordinates(border.interpolate(rng.random(), normalized=True))
                found.append(Free(*place[0].tolist()))
    contact = region.contact
    for edge, low, high in zip(
        contact.edge.tolist(), contact.low.tolist(), contact.high.tolist(), strict=True
    ):
        rim = SLACK * world.size
        if high - low < 4.0 * rim:  # a remainder of rounding
            continue
        for along in (rng.uniform(low, high), low + rim, high - rim):
            found.append(OnEdge(edge, along))
    found += [AtVertex(vertex) for vertex in contact.vertices.tolist()]
    return rng.sample(found, min(count, len(found)))
