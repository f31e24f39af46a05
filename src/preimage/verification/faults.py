"""What is wrong with one motion, each fault with a trajectory that shows it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations, pairwise

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.region import Region
from preimage.execution.trace import Outcome, Trace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.verification.distances import Point, apart
from preimage.verification.flights import Strip
from preimage.verification.paths import Stop
from preimage.verification.proof import MARGIN, Case, depth, least_progress
from preimage.verification.recognised import Elsewhere, blurred, elsewhere
from preimage.verification.slabs import Cell
from preimage.verification.trajectory import SHORT, admissible, feature_words, place_of, trace_of
from preimage.verification.verdict import Fault, Finding, Verdict

ANGLE = 1e-6
"""A trajectory that is off by no more than this, in radians, is one up to rounding."""


MOST = 64
"""So many ways are looked at for a long one."""

CORNERS = 12
"""From about so many corners of an area, three at a time, a place well inside is found."""


def faults(case: Case) -> Iterator[Finding]:
    """All faults of a motion; none if it is proven."""
    if case.projection.start.is_empty and not case.region.region.is_empty:
        words = "the region is as thin as rounding: nothing of it is left to be looked at"
        yield Finding(Fault.THIN, Verdict.UNPROVEN, words)
    lost = [*_escapes(case), *_rests(case)]
    if lost:
        yield min(lost, key=_plainness)
    for condition in case.motion.termination:
        if isinstance(condition, StickingCondition):
            yield from _period(case, condition)
        elif isinstance(condition, ElapsedCondition):
            yield from _elapsed(case, condition)
        elif condition.domain is not None:
            yield from _domain(case, condition.domain)


def _plainness(finding: Finding) -> tuple[bool, bool, int, float]:
    """Of several trajectories that show the same, a short one is shown."""
    assert finding.trace is not None
    leg = finding.trace.legs[0]
    known = finding.fault is Fault.UNKNOWN
    return finding.verdict is not Verdict.REFUTED, known, len(leg.times), float(leg.times[-1])


def _escapes(case: Case) -> Iterator[Finding]:
    projection, count = case.projection, len(case.strategy.space.contact)
    for feature in projection.escapes[:1]:
        if feature < count:
            stops = projection.ways.to_side(feature)
        else:
            stops = projection.ways.to_vertex(feature - count)
        words = f"leaves through the open side at {at(_end(case, stops))}"
        yield _shown(case, Fault.ESCAPE, stops, Outcome.ESCAPED, words)


def _rests(case: Case) -> Iterator[Finding]:
    """The worst place outside the target at which the motion may rest: outside the goals first."""
    projection, count = case.projection, len(case.strategy.space.contact)
    goals = [case.strategy.region(goal).region.contact for goal in case.motion.goals]
    slack = case.strategy.space.tolerance.length
    known: Finding | None = None
    for feature, low, high in projection.rests:
        middle = 0.5 * (low + high)
        if feature < count:
            inside = any(goal.contains(feature, middle, slack) for goal in goals)
        else:
            inside = any(goal.has_vertex(feature - count) for goal in goals)
        if inside and known is not None:
            continue
        if feature < count:
            stops = projection.ways.to_edge(feature, middle)
        else:
            stops = projection.ways.to_vertex(feature - count)
        place = at(_end(case, stops))
        name = feature_words(feature, case.strategy.space)
        if inside:
            words = f"may rest on {name} at {place}, in the goal, and never know it"
            known = _shown(case, Fault.UNKNOWN, stops, Outcome.UNKNOWN, words)
            continue
        words = f"may rest on {name} at {place}, outside the goal"
        yield _shown(case, Fault.REST, stops, Outcome.ENDLESS, words)
        return
    if known is not None:
        yield known


def _period(case: Case, condition: StickingCondition) -> Iterator[Finding]:
    """`2 rho <= distance < s * period - 2 rho` (theory 6)."""
    position = _position(case)
    if 2.0 * position > condition.distance:
        words = (
            f"a motion that sticks may be measured to move by {2.0 * position:.6g}, which is more "
            f"than {condition.distance:.6g}"
        )
        yield Finding(Fault.PERIOD, Verdict.UNPROVEN, words)
        return
    speed, edge = least_progress(case)
    certain = speed * condition.period - 2.0 * position
    if condition.distance < certain:
        return
    where = f"on edge {edge}" if edge >= 0 else "in free space"
    words = (
        f"{where} it may advance by only {speed * condition.period:.6g} in {condition.period:.6g}, "
        f"be measured to have moved by {max(certain, 0.0):.6g}, and be taken to stick"
    )
    stops = _slow_way(case, edge)
    if stops is None:
        yield Finding(Fault.PERIOD, Verdict.UNPROVEN, words)
        return
    trace = _trace(case, stops, Outcome.WRONG, words)
    moved = _moved(trace, condition.period)
    real = (
        _possible(case, trace)
        and moved is not None
        and moved - 2.0 * position <= condition.distance
    )
    verdict = Verdict.REFUTED if real else Verdict.UNPROVEN
    yield Finding(Fault.PERIOD, verdict, words, trace if real else None)


def _position(case: Case) -> float:
    return blurred(case.strategy.task.uncertainty.position, case.strategy.space.tolerance.length)


def _slow_way(case: Case, edge: int) -> tuple[Stop, ...] | None:
    """The way to the lower end of what is reached of the edge, or a long one in free space."""
    if edge < 0:
        return _long_way(case)
    spans, slope = case.projection.reached.spans[edge], float(case.features.slope[edge])
    low, high = max(spans, key=lambda span: span[1] - span[0])
    return case.projection.ways.to_edge(edge, high if slope > 0.0 else low)


def _long_way(case: Case) -> tuple[Stop, ...] | None:
    """The longest of some ways in free space."""
    best: tuple[float, tuple[Stop, ...]] | None = None
    flights = case.projection.reached.flights
    for flight in flights[:: max(1, len(flights) // MOST)]:
        strip = flight.strips[-1]
        sides = flight.cell.width_at(strip.bottom)
        low, high = max(strip.left[1], sides[0]), min(strip.right[1], sides[1])
        if low < high:
            stops = case.projection.ways.to_free(flight, (0.5 * (low + high), strip.bottom))
            length = sum(math.dist(a.place, b.place) for a, b in pairwise(stops))
            if best is None or length > best[0]:
                best = length, stops
    return best[1] if best is not None else None


def _moved(trace: Trace, period: float) -> float | None:
    """How far the robot has moved in the last of its time; None if that is shorter."""
    leg = trace.legs[0]
    then = leg.times[-1] - period
    if then < 0.0:
        return None
    x, y = (np.interp(then, leg.times, leg.places[:, axis]) for axis in (0, 1))
    return math.dist((float(x), float(y)), tuple(leg.places[-1].tolist()))


def _elapsed(case: Case, condition: ElapsedCondition) -> Iterator[Finding]:
    """Every motion has arrived when the time is up, and does not move any more."""
    speed, _ = least_progress(case)
    way = depth(case)
    if condition.period * speed >= way - MARGIN * case.strategy.space.tolerance.length:
        return
    words = (
        f"in {condition.period:.6g} it may advance by only {condition.period * speed:.6g} of "
        f"{way:.6g} along the command"
    )
    yield Finding(Fault.ELAPSED, Verdict.UNPROVEN, words)


# --- domains --------------------------------------------------------------------------------


def _domain(case: Case, domain: Region) -> Iterator[Finding]:
    """`D` lies in the domain; else a place outside it is shown, at best one that is misread."""
    found: Finding | None = None
    for feature, place, stops in _outside(case, domain):
        where = f"at {at(place)} it is outside the domain of its reading condition"
        if found is None:
            found = Finding(Fault.DOMAIN, Verdict.UNPROVEN, where)
        reading = _misread(case, feature, place) if stops else None
        if reading is None:
            continue
        q, force, goal = reading
        said = "no force" if force is None else f"a force of {math.degrees(force) % 360.0:.4g}°"
        name = "the goal" if goal == 0 else f"region {goal}"
        words = f"{where}: reading {at(q)} and {said}, it is taken to be in {name}"
        trace = _trace(case, stops, Outcome.WRONG, words)
        if _possible(case, trace):
            found = Finding(Fault.DOMAIN, Verdict.REFUTED, words, trace)
            break
    if found is not None:
        yield found


Somewhere = tuple[int, Point, tuple[Stop, ...]]
"""A feature, a place on it, and a way there if one is found."""


def _outside(case: Case, domain: Region) -> Iterator[Somewhere]:
    """Places of `D` outside a domain and outside a goal that might be told there."""
    space, projection = case.strategy.space, case.projection
    count, slack = len(space.contact), MARGIN * space.tolerance.length
    beyond = contact_set.difference(projection.contact, domain.contact, slack)
    rest = Area.empty()
    if not areas.is_subset(projection.area, domain.area, slack):
        rest = areas.regularised(areas.difference(projection.area, domain.area), slack)
    lines = [line for line in _lines(case) if not areas.is_subset(line, domain.area, slack)]
    for number in case.motion.goals:
        goal = case.strategy.region(number).region
        left = contact_set.difference(beyond, goal.contact, slack)
        for edge, low, high in zip(
            left.edge.tolist(), left.low.tolist(), left.high.tolist(), strict=True
        ):
            stops = projection.ways.to_edge(edge, 0.5 * (low + high))
            yield edge, _end(case, stops), stops
        for vertex in left.vertices.tolist():
            stops = projection.ways.to_vertex(vertex)
            yield count + vertex, _end(case, stops), stops
        for area in (rest, *lines):
            if areas.is_subset(area, goal.area, slack):
                continue
            for part in areas.regularised(areas.difference(area, goal.area), slack).parts:
                place = _inside(part, slack)
                yield 2 * count, place, projection.way_to(*place) or ()


def _lines(case: Case) -> Iterator[Area]:
    """What of `D` is a line in free space, up to rounding, as wide as can be told from nothing."""
    projection, slack = case.projection, MARGIN * case.strategy.space.tolerance.length
    for flight in projection.reached.flights:
        for strip in flight.strips:
            widest = max(high - low for low, high in zip(strip.left, strip.right, strict=True))
            if widest > 2.0 * slack or strip.top - strip.bottom < SHORT * slack:
                continue
            corners = [
                (x + side * 1.5 * slack, height)
                for side, heights in (
                    (-1.0, (strip.top, strip.bottom)),
                    (1.0, (strip.bottom, strip.top)),
                )
                for height in heights
                for x in [_middle(strip, flight.cell, height)]
            ]
            restored = projection.slabs.frame.restored(np.array(corners))
            yield areas.intersection(Area.polygon(restored), case.strategy.space.free)


def _middle(strip: Strip, cell: Cell, height: float) -> float:
    """Where the middle of a strip's end is, within the cell."""
    end = 0 if height == strip.top else 1
    low, high = cell.width_at(height)
    return 0.5 * (min(max(strip.left[end], low), high) + max(min(strip.right[end], high), low))


def _inside(part: Area, margin: float) -> Point:
    """A point of an area, not on its border."""
    core = areas.shrunk(part, margin)
    points = core.rings[0] if core.rings else part.rings[0]
    some = points[:: max(1, len(points) // CORNERS)]
    places = np.array([np.mean(three, axis=0) for three in combinations(some, 3)])
    places = places[part.contains_all(places)]
    best = max(places.tolist(), key=lambda place: part.depth(*place), default=points[0].tolist())
    return float(best[0]), float(best[1])


def _misread(case: Case, feature: int, place: Point) -> tuple[Point, float | None, int] | None:
    """A reading at a place with which a goal is told that does not hold it, and that goal."""
    strategy, position, sets = case.strategy, _position(case), case.sets
    forces: list[float | None] = [None] if sets.zero[feature] else []
    low, high = float(sets.low[feature]), float(sets.high[feature])
    if low < high:
        forces += [low + part * (high - low) for part in (0.02, 0.25, 0.5, 0.75, 0.98)]
    elif low == high:
        forces.append(low)
    reach = position if math.isfinite(position) else 0.0
    around = [(0.0, 0.0)] + [
        (part * reach * math.cos(turn), part * reach * math.sin(turn))
        for part in (0.5, 0.98)
        for turn in np.linspace(0.0, math.tau, 24, endpoint=False)
    ]
    # goals are asked for in this order, and the first one that is told is believed
    goals = sorted(map(strategy.region, case.motion.goals), key=lambda one: (one.rank, one.id))
    rests = [
        (goal, elsewhere(strategy.space, goal.region, condition.domain))
        for condition in case.motion.termination
        if isinstance(condition, ReadingCondition)
        for goal in goals
    ]
    for force in forces:
        can = sets.zero if force is None else (sets.low < force) & (force < sets.high)
        alike = [(goal, rest.chosen(np.asarray(can, dtype=np.bool_))) for goal, rest in rests]
        for x, y in around:
            q = (place[0] + x, place[1] + y)
            told = (goal for goal, rest in alike if _misses(rest, q, position, bool(can[-1])))
            goal = next(told, None)
            if goal is not None and not _holds(case, goal.region, feature, place):
                said = None if force is None else case.motion.direction + math.pi + force
                return q, said, goal.id
    return None


def _holds(case: Case, goal: Region, feature: int, place: Point) -> bool:
    contact = case.strategy.space.contact
    count = len(contact)
    if feature < count:
        distance = math.dist(place, tuple(contact.points[feature].tolist()))
        return goal.contact.contains(feature, distance, 0.0)
    if feature < 2 * count:
        return goal.contact.has_vertex(feature - count)
    return goal.area.contains(*place)


def _misses(rest: Elsewhere, q: Point, position: float, free: bool) -> bool:
    """Whether nothing of the rest of a domain is consistent with a position reading."""
    if not len(rest.feature):
        return not (free and not rest.area.is_empty)
    if math.isinf(position):
        return False
    if free and rest.area.contains(*q):
        return False
    point = np.array([q])
    return float(np.min(apart((point, point), (rest.starts, rest.ends)))) > position


# --- trajectories ---------------------------------------------------------------------------


def _shown(
    case: Case, fault: Fault, stops: tuple[Stop, ...], outcome: Outcome, words: str
) -> Finding:
    """A fault with its trajectory, refuted if nature may drive the motion so."""
    trace = _trace(case, stops, outcome, words)
    verdict = Verdict.REFUTED if _possible(case, trace) else Verdict.UNPROVEN
    return Finding(fault, verdict, words, trace)


def _possible(case: Case, trace: Trace) -> bool:
    """Whether a trajectory begins in the region, and nature may drive the motion so."""
    leg = trace.legs[0]
    x, y = leg.places[0].tolist()
    return _holds(case, case.region.region, int(leg.features[0]), (x, y)) and admissible(
        trace, ANGLE
    )


def _trace(case: Case, stops: tuple[Stop, ...], outcome: Outcome, words: str) -> Trace:
    return trace_of(case.strategy, case.region.id, case.projection, stops, outcome, words)


def _end(case: Case, stops: tuple[Stop, ...]) -> Point:
    return place_of(case.projection, stops[-1])


def at(place: Point) -> str:
    """A place, for people."""
    return f"({place[0] + 0.0:.4g}, {place[1] + 0.0:.4g})"
