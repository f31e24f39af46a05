"""Places that tell why: a start in no region, what a place is confused with, where one escapes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Bools, Floats, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Point, Start, StartKind
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.angles import TAU, wrap
from preimage.geometry.area import Area
from preimage.geometry.overlay import united
from preimage.preimages.setting import Setting
from preimage.recognition.confusion import confusion_radius
from preimage.recognition.outside import contact_segments, outside
from preimage.recognition.readings import Readings, alike
from preimage.recognition.segments import distances
from preimage.task.workspace import Side

HALVINGS = 12
"""So exactly is the deepest place of an area looked for."""

ROOM = 0.25
"""A place is rounded by at most this part of its distance from the border."""

Confusion = tuple[int, tuple[float, float] | None, bool]
"""A feature, the forces that it has in common with another, and whether both may read none."""


@dataclass(frozen=True, slots=True, eq=False)
class Stop:
    """Where a motion may stop on one feature: a part of an edge, or a vertex; and a place of it."""

    feature: int
    low: float
    high: float
    place: Point


def lost_start(start: Start, regions: Sequence[Region], space: ConfigurationSpace) -> Start | None:
    """A place of the start that no region holds: a point, well inside of what they leave over.

    None if, up to rounding, each place is in some region. A start that is a point is its own.
    """
    if start.kind is not StartKind.REGION:
        return start
    near = space.tolerance.length
    inside = start.region
    rest = inside.area
    others = [region.area for region in regions if not region.area.is_empty]
    if others and not rest.is_empty:
        rest = areas.difference(rest, united(others, space.tolerance.grid))
        rest = inflate.without_slivers(rest, near)
    if not rest.is_empty:
        place = deepest(rest, near)
        if place is not None:
            return Start(StartKind.FREE_POINT, place, -1, 0.0, (), Region.empty())
    left = inside.contact
    for region in regions:
        left = contact_set.difference(left, region.contact, near)
    return _on_contact(left, space)


def _on_contact(left: ContactSet, space: ConfigurationSpace) -> Start | None:
    """The middle of the longest interval; without any, a vertex."""
    contact = space.contact
    if len(left.edge):
        longest = int(np.argmax(left.high - left.low))
        edge, middle = left.edge[longest], 0.5 * float(left.low[longest] + left.high[longest])
        x, y = contact.at(np.array([edge]), np.array([middle]))[0].tolist()
        return Start(StartKind.EDGE_POINT, (x, y), int(edge), middle, (), Region.empty())
    if len(left.vertices):
        vertex = int(left.vertices[0])
        x, y = contact.points[vertex].tolist()
        return Start(StartKind.VERTEX, (x, y), -1, 0.0, (vertex,), Region.empty())
    return None


def deepest(area: Area, near: float) -> Point | None:
    """A point about as far from an area's border as any, with few digits; None for slivers."""
    xmin, ymin, xmax, ymax = area.bounds
    low, high = near, 0.5 * min(xmax - xmin, ymax - ymin)
    inner = areas.shrunk(area, low)
    if inner.is_empty:
        return None
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        trial = areas.shrunk(area, middle)
        if trial.is_empty:
            high = middle
        else:
            low, inner = middle, trial
    x, y = inner.rings[0][0].tolist()
    digits = max(0, math.ceil(-math.log10(ROOM * low)))
    return round(x, digits), round(y, digits)


def all_contact(regions: Sequence[Region], space: ConfigurationSpace) -> ContactSet:
    """The contact of all regions together."""
    parts = [region.contact for region in regions]
    return ContactSet.of(
        np.concatenate([part.edge for part in parts]),
        np.concatenate([part.low for part in parts]),
        np.concatenate([part.high for part in parts]),
        np.concatenate([part.vertices for part in parts]),
        space.tolerance.length,
    )


def on_features(part: ContactSet, edges: Bools, vertices: Bools) -> ContactSet:
    """The part of a contact set on some edges, and at some vertices."""
    on = edges[part.edge]
    corners = part.vertices[vertices[part.vertices]]
    return ContactSet(part.edge[on], part.low[on], part.high[on], corners)


def stops_on(part: ContactSet, space: ConfigurationSpace) -> list[Stop]:
    """The features of a part of contact space: the longest edges first, then vertices."""
    contact, count = space.contact, len(space.contact)
    middles = contact.at(part.edge, 0.5 * (part.low + part.high)).tolist()
    found = [
        Stop(int(edge), float(low), float(high), (x, y))
        for edge, low, high, (x, y) in zip(part.edge, part.low, part.high, middles, strict=True)
    ]
    found.sort(key=lambda stop: (stop.low - stop.high, stop.feature))
    for vertex in part.vertices.tolist():
        x, y = contact.points[vertex].tolist()
        found.append(Stop(count + vertex, 0.0, 0.0, (x, y)))
    return found


def ends_at(stop: Stop, stops: Sequence[Stop], space: ConfigurationSpace, near: float) -> bool:
    """Whether a part of an edge comes near to an end of it that is among the vertices."""
    contact, count = space.contact, len(space.contact)
    if stop.feature >= count:
        return False
    far = float(contact.length[stop.feature]) - stop.high
    ends = ((stop.low, stop.feature), (far, int(contact.next[stop.feature])))
    return any(
        gap <= near and other.feature == count + vertex for gap, vertex in ends for other in stops
    )


def largest_part(region: Region, space: ConfigurationSpace) -> Stop | None:
    """The longest edge of a region, else a vertex, else free space, and a place well inside it."""
    stops = stops_on(region.contact, space)
    if stops:
        return stops[0]
    place = None if region.area.is_empty else deepest(region.area, space.tolerance.length)
    return None if place is None else Stop(2 * len(space.contact), 0.0, 0.0, place)


def confused_with(
    setting: Setting,
    readings: Readings,
    feature: int,
    place: Point,
    region: Region,
    among: Bools,
) -> Confusion | None:
    """The nearest feature outside a region that a place in it cannot be told from (theory 5).

    Parameters
    ----------
    feature, place : where the robot is, and on what.
    among : (2n+1,) the features that count.
    """
    space = setting.space
    contact = space.contact
    rest = outside(space, region)
    segments = contact_segments(contact, rest.contact)
    point = np.broadcast_to(np.array(place), (len(segments), 2))
    apart = distances(point, segments) if len(segments) else np.empty(0)
    others = segments.feature.astype(np.int64)
    if not rest.area.is_empty:
        others = np.append(others, 2 * len(contact))
        apart = np.append(apart, rest.area.distance(*place))
    radius = math.inf
    if setting.uncertainty.has_position_sensor:
        radius = confusion_radius(space, setting.uncertainty)
    fits = among[others] & (apart < radius) & alike(readings, feature, others)
    if not np.any(fits):
        return None
    candidates = np.flatnonzero(fits)
    other = int(others[candidates[np.argmin(apart[candidates])]])
    both_zero = bool(readings.zero[feature] and readings.zero[other])
    return other, shared_force(readings, feature, other), both_zero


def shared_force(readings: Readings, feature: int, other: int) -> tuple[float, float] | None:
    """The directions of a force that can be read at both features, as an interval; radians.

    Where there are two, the longer one.
    """
    half, reach = float(readings.half[feature]), float(readings.half[other])
    if half < 0.0 or reach < 0.0:
        return None
    center = float(readings.center[feature])
    off = wrap(float(readings.center[other]) - center)
    best: tuple[float, float] | None = None
    for turn in (-TAU, 0.0, TAU):
        low, high = max(-half, off + turn - reach), min(half, off + turn + reach)
        if high < low and low - high <= readings.tolerance:
            low = high = 0.5 * (low + high)
        if low <= high and (best is None or high - low > best[1] - best[0]):
            best = low, high
    return None if best is None else (center + best[0], center + best[1])


def side_of(space: ConfigurationSpace, edge: int) -> Side:
    """The side of the window on which an open edge lies."""
    xmin, ymin, xmax, ymax = space.window
    x, y = (0.5 * (space.contact.points[edge] + space.contact.ends[edge])).tolist()
    gaps = {Side.LEFT: x - xmin, Side.RIGHT: xmax - x, Side.BOTTOM: y - ymin, Side.TOP: ymax - y}
    return min(gaps, key=lambda side: abs(gaps[side]))


def where_met(space: ConfigurationSpace, visited: Region, edge: int, corners: Ints) -> Point | None:
    """A place of an open edge that is visited; None where only its line is."""
    contact = space.contact
    for vertex in corners.tolist():
        if edge in (vertex, int(contact.previous[vertex])):
            x, y = contact.points[vertex].tolist()
            return x, y
    starts, ends = visited.area.segments
    if not len(starts):
        return None
    along = [_place(space, edge, points) for points in (starts, ends)]
    near, length = 16.0 * space.tolerance.length, float(contact.length[edge])
    on = np.all([np.abs(off) <= near for _, off in along], axis=0)
    low = np.clip(np.minimum(along[0][0], along[1][0]), 0.0, length)
    high = np.clip(np.maximum(along[0][0], along[1][0]), 0.0, length)
    size = np.where(on, high - low, -1.0)
    longest = int(np.argmax(size))
    if size[longest] < 0.0:
        return None
    middle = np.array([0.5 * (low[longest] + high[longest])])
    x, y = contact.at(np.array([edge]), middle)[0].tolist()
    return x, y


def _place(space: ConfigurationSpace, edge: int, points: Floats) -> tuple[Floats, Floats]:
    """How far along an edge points are, and how far off its line."""
    off = points - space.contact.points[edge]
    tx, ty = space.contact.tangent[edge].tolist()
    return off[:, 0] * tx + off[:, 1] * ty, off[:, 1] * tx - off[:, 0] * ty
