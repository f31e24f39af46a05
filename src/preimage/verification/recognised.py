"""What of a target is certainly recognised, by the definition of theory 5 and distances alone."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Bools, ContactSpace, Floats, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.verification.distances import Point, apart, closest, taken
from preimage.verification.reading_sets import ReadingSets

NODING = 16.0
"""Areas are subtracted on a grid so much coarser than contact space's: borders that coincide up to
rounding leave no slivers."""

ARC = 1e-5
"""Of what is too near to something alike, arcs are replaced so far outside, relative to 2 rho."""


@dataclass(frozen=True, slots=True)
class Confusion:
    """Two configurations that a reading may not tell apart, only one of them in the goal.

    Parameters
    ----------
    feature, place : in the target.
    other, elsewhere : outside the goal.
    """

    feature: int
    place: Point
    other: int
    elsewhere: Point

    @property
    def distance(self) -> float:
        """How far they are apart."""
        return math.dist(self.place, self.elsewhere)


@dataclass(frozen=True, slots=True, eq=False)
class Recognised:
    """The part of a target that is certain, whatever is read there.

    Parameters
    ----------
    region : that part.
    margin : by how much the nearest configuration with a reading in common is further away from
        that part than `2 rho`; infinite if there is none.
    confusions : why the rest is not certain, one for each piece of the target.
    """

    region: Region
    margin: float
    confusions: tuple[Confusion, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Elsewhere:
    """`Delta - T` as segments: contact, and the borders of what there is of free space.

    Parameters
    ----------
    starts, ends : (k, 2).
    feature : (k,) numbered as in `ReadingSets`.
    area : the part of free space.
    """

    starts: Floats
    ends: Floats
    feature: Ints
    area: Area

    def chosen(self, which: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> Elsewhere:
        """Some of the features."""
        keep = which[self.feature]
        return Elsewhere(self.starts[keep], self.ends[keep], self.feature[keep], self.area)


def elsewhere(space: ConfigurationSpace, goal: Region, domain: Region | None) -> Elsewhere:
    """What of a domain, or of all valid space, is not in the goal."""
    contact, tolerance = space.contact, space.tolerance
    whole = space.valid if domain is None else domain
    rest = contact_set.difference(whole.contact, goal.contact, tolerance.length)
    area = whole.area
    if not area.is_empty and not goal.area.is_empty:
        area = areas.difference_on_grid(area, goal.area, NODING * tolerance.grid)
        area = areas.regularised(area, tolerance.length)
    low, high = contact.at(rest.edge, rest.low), contact.at(rest.edge, rest.high)
    corners = contact.points[rest.vertices]
    border = area.segments
    count = len(contact)
    feature = np.concatenate(
        (rest.edge, count + rest.vertices, np.full(len(border[0]), 2 * count, dtype=np.int32))
    )
    return Elsewhere(
        np.concatenate((low, corners, border[0])),
        np.concatenate((high, corners, border[1])),
        feature.astype(np.int32),
        area,
    )


def recognised(
    space: ConfigurationSpace,
    sets: ReadingSets,
    goal: Region,
    target: Region,
    position: float,
    domain: Region | None = None,
) -> Recognised:
    """What of a target is in the goal and certainly known to be (theory 5).

    A configuration is certain unless one of the domain outside the goal, with a reading in common,
    is nearer than `2 rho`.

    Parameters
    ----------
    target : what is looked at of the goal; what it has outside the goal is left out.
    position : `rho`; at infinity all that is alike is confused.
    domain : `Delta`, all of valid space if None.
    """
    rest = elsewhere(space, goal, domain)
    search = _Search(space, sets, rest, position)
    tolerance = space.tolerance.length
    part = contact_set.intersection(target.contact, goal.contact, tolerance)
    part = contact_set.without_outermost(part, space.contact)  # who is there has escaped
    for edge, low, high in zip(
        part.edge.tolist(), part.low.tolist(), part.high.tolist(), strict=True
    ):
        search.interval(edge, low, high)
    for vertex in part.vertices.tolist():
        search.vertex(vertex)
    area = target.area
    if not areas.is_subset(area, goal.area, 0.0):
        area = areas.intersection(area, goal.area)
    area = search.free(area)
    contact = ContactSet.of(
        [edge for edge, _, _ in search.kept],
        [low for _, low, _ in search.kept],
        [high for _, _, high in search.kept],
        search.corners,
        tolerance,
    )
    return Recognised(Region(area, contact), search.margin, tuple(search.confusions))


def told_by_some(
    space: ConfigurationSpace,
    sets: ReadingSets,
    goals: Sequence[Region],
    vertices: Ints,
    position: float,
    domain: Region | None = None,
) -> Ints:
    """The vertices at which each reading tells some goal, though none is told by all (theory 7).

    Force by force: all ends of the intervals that others can read, and the middles between them.
    """
    rests = [elsewhere(space, goal, domain) for goal in goals]
    reach = 2.0 * blurred(position, space.tolerance.length)
    found = []
    for vertex in vertices.tolist():
        near = []
        for goal, rest in zip(goals, rests, strict=True):
            if goal.contact.has_vertex(vertex):
                place = space.contact.points[[vertex]]
                gaps = apart((place, place), (rest.starts, rest.ends))[0]
                close = gaps + 0.5 * space.tolerance.length < reach
                near.append(np.unique(rest.feature[close | math.isinf(reach)]))
        if near and all(
            any(not np.any(can[others]) for others in near)
            for can in _readings_at(sets, len(space.contact) + vertex, np.concatenate(near))
        ):
            found.append(vertex)
    return np.array(found, dtype=np.int32)


def _readings_at(sets: ReadingSets, feature: int, others: Ints) -> Iterator[Bools]:
    """Which features can read what can be read at one, reading by reading."""
    if sets.zero[feature]:
        yield sets.zero
    low, high = float(sets.low[feature]), float(sets.high[feature])
    if low > high:
        return
    ends = {low, high}
    for other in np.unique(others).tolist():
        for turn in (-math.tau, 0.0, math.tau):
            for end in (sets.low[other] - sets.tolerance, sets.high[other] + sets.tolerance):
                if low < end + turn < high:
                    ends.add(float(end) + turn)
    places = sorted(ends)
    for force in (*places, *(0.5 * (a + b) for a, b in pairwise(places))):
        can = np.zeros(len(sets.zero), dtype=np.bool_)
        for turn in (-math.tau, 0.0, math.tau):
            can |= (sets.low + turn - sets.tolerance <= force) & (
                force <= sets.high + turn + sets.tolerance
            )
        yield can


class _Search:
    """Feature by feature; see `recognised`."""

    def __init__(
        self, space: ConfigurationSpace, sets: ReadingSets, rest: Elsewhere, position: float
    ) -> None:
        self.contact: ContactSpace = space.contact
        self.tolerance = space.tolerance.length
        self.sets, self.rest, self.reach = sets, rest, 2.0 * blurred(position, self.tolerance)
        self.margin = math.inf
        self.confusions: list[Confusion] = []
        self.kept: list[tuple[int, float, float]] = []
        self.corners: list[int] = []

    def interval(self, edge: int, low: float, high: float) -> None:
        """Settle a part of an edge."""
        ends = self.contact.at(np.array([edge, edge]), np.array([low, high]))
        others, nearest = self._nearest(edge, ends[:1], ends[1:])
        if nearest >= self.reach:
            self.kept.append((edge, low, high))
            return
        cuts: list[tuple[float, float]] = []
        if math.isfinite(self.reach):
            origin, tangent = _point(self.contact.points[edge]), _point(self.contact.tangent[edge])
            for start, end in zip(others.starts, others.ends, strict=True):
                cut = taken(origin, tangent, _point(start), _point(end), self.reach)
                if cut is not None:
                    cuts.append(cut)
        else:
            cuts = [(low, high)]
        taken_away = ContactSet.of(
            [edge] * len(cuts), [a for a, _ in cuts], [b for _, b in cuts], [], self.tolerance
        )
        own = ContactSet.of([edge], [low], [high], [], self.tolerance)
        left = contact_set.difference(own, taken_away, self.tolerance)
        if len(left.edge):
            self.margin = 0.0
        self.kept += [
            (edge, a, b) for a, b in zip(left.low.tolist(), left.high.tolist(), strict=True)
        ]

    def vertex(self, vertex: int) -> None:
        """Settle a vertex."""
        place = self.contact.points[[vertex]]
        _, nearest = self._nearest(len(self.contact) + vertex, place, place)
        if nearest >= self.reach:
            self.corners.append(vertex)

    def free(self, area: Area) -> Area:
        """Settle an area of free space."""
        if area.is_empty:
            return area
        others, nearest = self._nearest(2 * len(self.contact), *area.segments)
        inside = len(others.feature) and bool(np.any(area.contains_all(others.starts)))
        if nearest >= self.reach and not inside:
            return area
        if not math.isfinite(self.reach):
            return Area.empty()
        away = inflate.outer_stadiums(others.starts, others.ends, self.reach, ARC)
        left = areas.regularised(areas.difference(area, away), self.tolerance)
        self.margin = self.margin if left.is_empty else 0.0
        return left

    def _nearest(self, feature: int, starts: Floats, ends: Floats) -> tuple[Elsewhere, float]:
        """What is alike elsewhere, and how near it is; rounding does not count."""
        others = self.rest.chosen(self.sets.alike(feature))
        if not len(others.feature):
            return others, math.inf
        gaps = apart((starts, ends), (others.starts, others.ends))
        here, there = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
        nearest = float(gaps[here, there]) + 0.5 * self.tolerance
        if nearest >= self.reach:
            self.margin = min(self.margin, nearest - self.reach)
        else:
            place, far = closest(
                (_point(starts[here]), _point(ends[here])),
                (_point(others.starts[there]), _point(others.ends[there])),
            )
            other = int(others.feature[there])
            self.confusions.append(Confusion(feature, place, other, far))
            if math.isinf(self.reach):
                return others, -math.inf
        return others, nearest


def blurred(position: float, tolerance: float) -> float:
    """The position error: an exact sensor is as good as the tolerance, no better."""
    return max(position, tolerance)


def _point(row: Floats) -> Point:
    return float(row[0]), float(row[1])
