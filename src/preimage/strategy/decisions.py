"""A conditional strategy as a list of decisions: what is commanded, and what is read then."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from preimage.configuration import region as regions
from preimage.configuration.contact import Bools, Floats
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.start import Start, StartKind, covered, start_region
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.mechanics.behaviour import Behaviour
from preimage.reachability.sources import sources
from preimage.recognition.outside import Domain, Outside, contact_segments, outside
from preimage.recognition.readings import Readings, readings
from preimage.recognition.termination import ElapsedCondition, ReadingCondition, StickingCondition
from preimage.strategy.forces import Force, force_samples, force_words
from preimage.strategy.strategy import Motion, Strategy, StrategyRegion
from preimage.strategy.words import direction_words, joined, number

MOST_FORCES = 400
"""With more kinds of forces than this a card says nothing of them."""

MOST_CLAUSES = 3
"""What is read is put into so many clauses at most; beyond that they are drawn together."""

ALONE = "as in this goal alone"
"""What the position reads where no few words say it."""

PART = "in a part of "
"""Begins a position for which no half-plane or box will do."""

DIGITS = 1000.0
"""Places on a card are rounded to the window over this."""


@dataclass(frozen=True, slots=True)
class Clause:
    """Readings that tell a goal.

    Parameters
    ----------
    forces : in words, none for any force at all.
    position : in words, empty if the position plays no part.
    rest : whether the motion must have come to rest.
    """

    forces: tuple[str, ...]
    position: str
    rest: bool = False

    @property
    def words(self) -> str:
        """The clause as a condition.

        >>> Clause(("of 90°",), "", rest=True).words
        'it rests and the force is of 90°'
        """
        parts = ["it rests"] if self.rest else []
        if self.forces:
            parts.append(f"the force is {joined(self.forces, 'or')}")
        if self.position:
            parts.append(f"the position reads {self.position}")
        return joined(parts) or "anything is read"


@dataclass(frozen=True, slots=True)
class Case:
    """What tells one goal of a motion; by no clause where only its condition says."""

    goal: int
    clauses: tuple[Clause, ...]

    @property
    def words(self) -> str:
        """All its clauses."""
        if any(clause.position == ALONE or PART in clause.position for clause in self.clauses):
            name = "the goal" if self.goal == 0 else f"region {self.goal}"
            return f"what is read fits only {name}"
        words = [clause.words for clause in self.clauses]
        return "\n      or ".join(words) or "no place elsewhere fits the readings"


def decision_list(strategy: Strategy) -> str:
    """A strategy as one would write it on a card: what to command, and how to go on from there.

    What tells a goal is said in terms of readings (theory 5, 7): that a force may be felt at
    nothing outside the goal, or at nothing so near to the measured position. Every clause is
    sufficient; where none is short, the goal is only named. A motion of one goal needs none. The
    goals of a motion are asked in the order of the executor, the nearest to the end first.

    >>> from preimage.search.planner import plan
    >>> from preimage.task import named_task
    >>> print(decision_list(plan(named_task("flat-floor"))).splitlines()[0])
    begin with 1
    """
    lines = list(_beginning(strategy))
    moving = [region for region in strategy.regions if region.motion is not None]
    for region in sorted(moving, key=lambda one: (-one.rank, one.id)):
        lines += _motion(strategy, region)
    return "\n".join(lines)


def cases(strategy: Strategy, motion: Motion) -> tuple[Case, ...]:
    """What tells the goals of a motion, in the order in which they are asked.

    Parameters
    ----------
    strategy : the plan of the motion.
    """
    goals = sorted((strategy.region(goal) for goal in motion.goals), key=_order)
    task, space = strategy.task, strategy.space
    sets = readings(
        space.contact, motion.direction, task.uncertainty, task.friction, space.tolerance
    )
    domains: list[tuple[Domain, bool]] = []
    for condition in motion.termination:
        match condition:
            case ReadingCondition(domain=domain):
                domains.append((domain, False))
            case StickingCondition() | ElapsedCondition():
                domains.append((_held(strategy, motion), True))
    found = []
    for goal in goals:
        clauses: list[Clause] = []
        for domain, rest in domains:
            if rest and len(goals) == 1:
                clauses.append(Clause((), "", rest=True))
                continue
            aim = motion.target if domain is None else _both(strategy, motion.target, domain)
            share = _both(strategy, aim, goal.region)
            for clause in _clauses(strategy, sets, share, goal.region, domain, rest):
                plain = Clause(clause.forces, clause.position)
                if plain not in clauses:
                    clauses.append(clause)
        found.append(Case(goal.id, tuple(clauses)))
    return tuple(found)


def beginnings(strategy: Strategy) -> tuple[Case, ...]:
    """What tells the regions of the start, by the first reading of the position (theory 7)."""
    space = strategy.space
    chosen = sorted((strategy.region(start) for start in strategy.start), key=_order)
    start = start_region(strategy.task, space)
    if len(chosen) < 2 or start.kind is not StartKind.REGION:
        sure = [one for one in chosen if len(chosen) == 1 or covered(start, one.region, space)]
        return tuple(Case(one.id, (Clause((), ""),)) for one in sure[:1])
    return tuple(Case(one.id, _first_clauses(strategy, start, one)) for one in chosen)


# --- lines ----------------------------------------------------------------------------------


def _order(region: StrategyRegion) -> tuple[int, int]:
    return region.rank, region.id


def _beginning(strategy: Strategy) -> Iterator[str]:
    choices = beginnings(strategy)
    for place, case in enumerate(choices):
        begin = "in the goal already, done" if case.goal == 0 else f"begin with {case.goal}"
        if len(choices) == 1:
            yield begin
        elif place + 1 == len(choices):
            yield f"else {begin}"
        else:
            yield f"{'else ' if place else 'at the start: '}if {case.words}: {begin}"


def _motion(strategy: Strategy, region: StrategyRegion) -> Iterator[str]:
    motion = region.motion
    assert motion is not None
    yield f"{region.id}: move {direction_words(motion.direction)} until {_until(strategy, motion)}"
    asked = cases(strategy, motion)
    if len(asked) == 1:
        yield f"   then {_go_on(strategy, asked[0].goal)}"
        return
    for place, case in enumerate(asked):
        yield f"   {'else ' if place else ''}if {case.words}: {_go_on(strategy, case.goal)}"


def _until(strategy: Strategy, motion: Motion) -> str:
    goals = sorted((strategy.region(goal) for goal in motion.goals), key=_order)
    names = joined([goal_name(strategy, goal.id) for goal in goals], "or")
    parts = []
    for condition in motion.termination:
        match condition:
            case ReadingCondition(domain=domain):
                inside = "" if domain is None else ", of those where it can be,"
                parts.append(f"every place that fits the readings{inside} lies in {names}")
            case StickingCondition(period=period, distance=distance):
                parts.append(
                    f"it rests (no more than {number(distance)} moved in {number(period)} of time)"
                )
            case ElapsedCondition(period=period):
                parts.append(f"a time of {number(period)} has passed, and it rests")
    return " or ".join(parts)


def goal_name(strategy: Strategy, goal: int) -> str:
    """A region as the goal of a motion."""
    if strategy.region(goal).failure:
        return f"region {goal} of failure"
    return "the goal" if goal == 0 else f"region {goal}"


def _go_on(strategy: Strategy, goal: int) -> str:
    region = strategy.region(goal)
    if region.failure:
        return "it has failed, and knows it"
    return "in the goal, done" if region.motion is None else f"go on with {goal}"


# --- what is read ---------------------------------------------------------------------------


def _both(strategy: Strategy, one: Region, other: Region) -> Region:
    return regions.intersection(one, other, strategy.space.tolerance)


def _held(strategy: Strategy, motion: Motion) -> Region:
    """What of a target holds motions for sure (theory 6)."""
    task, space = strategy.task, strategy.space
    control = task.uncertainty.control
    found = sources(space.contact, motion.direction, control, task.friction, space.tolerance)
    edges, vertices = found.where(Behaviour.STICKS_SURELY)
    contact = motion.target.contact
    on = edges[contact.edge]
    held = contact.vertices[vertices[contact.vertices]]
    return Region(
        Area.empty(), ContactSet(contact.edge[on], contact.low[on], contact.high[on], held)
    )


def _clauses(
    strategy: Strategy, sets: Readings, share: Region, goal: Region, domain: Domain, rest: bool
) -> tuple[Clause, ...]:
    """Which readings tell a goal, of those that can be taken in its share of the target."""
    if share.is_empty:
        return ()
    beyond = outside(strategy.space, goal, domain)
    places: dict[str, list[tuple[Force, int]]] = {}
    samples = force_samples(sets, share)
    if len(samples) > MOST_FORCES:
        return ()
    known: dict[bytes, str | None] = {}
    for index, sample in enumerate(samples):
        features = sets.can_read(sample.angle)
        key = np.packbits(features).tobytes()
        if key not in known:
            known[key] = _position(strategy, _part(share, features), _part(beyond, features))
        words = known[key]
        if words is not None:
            places.setdefault(words, []).append((sample, index))
    feels = bool(np.any(sets.half >= 0.0))
    if len(places) > MOST_CLAUSES:
        every = sorted((pair for pairs in places.values() for pair in pairs), key=lambda p: p[1])
        forces = tuple(force_words(every)) if feels else ()
        return (Clause(forces, ALONE, rest),)
    return tuple(
        Clause(tuple(force_words(pairs)) if feels else (), words, rest)
        for words, pairs in places.items()
    )


def _part(part: Region | Outside, features: Bools) -> Region:
    """What lies on these features."""
    contact = part.contact
    n = (len(features) - 1) // 2
    on, at = features[contact.edge], features[n + contact.vertices]
    return Region(
        part.area if features[-1] else Area.empty(),
        ContactSet(contact.edge[on], contact.low[on], contact.high[on], contact.vertices[at]),
    )


def _position(strategy: Strategy, share: Region, beyond: Region) -> str | None:
    """What the position must read so that nothing beyond a goal fits; None if it cannot."""
    if share.is_empty:
        return None
    if beyond.is_empty:
        return ""
    space = strategy.space
    rho = strategy.task.uncertainty.position
    if math.isinf(rho):
        return None
    near = space.tolerance.length
    radius = max(rho, near)
    doubtful = _around(strategy, beyond, radius + near)
    told = areas.difference(_around(strategy, share, radius), doubtful)
    told = inflate.without_slivers(told, near)
    if told.is_empty:
        return None
    return _place_words(strategy, told, doubtful)


def _around(strategy: Strategy, region: Region, radius: float) -> Area:
    """Where a reading may lie, and a little more."""
    arc = strategy.task.options.arc_tolerance
    segments = contact_segments(strategy.space.contact, region.contact)
    around = inflate.outer_stadiums(segments.starts, segments.ends, radius, arc)
    if region.area.is_empty:
        return around
    return areas.union(inflate.grow(region.area, radius, arc), around)


def _place_words(strategy: Strategy, told: Area, doubtful: Area) -> str:
    """A half-plane or a box of readings, with none that is doubtful; or a part of a box."""
    space = strategy.space
    xmin, ymin, xmax, ymax = space.window
    step = 10.0 ** math.floor(math.log10(max(xmax - xmin, ymax - ymin) / DIGITS))
    here, there = _bounds(told), _bounds(doubtful)
    for axis, name in enumerate("xy"):
        least = math.ceil(there[1][axis] / step + 1e-9) * step
        most = math.floor(there[0][axis] / step - 1e-9) * step
        if here[0][axis] >= there[1][axis]:
            return f"{name} over {number(least)}"
        if here[1][axis] <= there[0][axis]:
            return f"{name} under {number(most)}"
    low, high = np.ceil(here[0] / step) * step, np.floor(here[1] / step) * step
    if bool(np.all(low < high)):
        box = Area.box(float(low[0]), float(low[1]), float(high[0]), float(high[1]))
        if areas.intersection(box, doubtful).is_empty:
            return f"within {_box(low, high)}"
    return f"{PART}{_box(np.floor(here[0] / step) * step, np.ceil(here[1] / step) * step)}"


def _bounds(area: Area) -> tuple[Floats, Floats]:
    points = np.concatenate(area.rings)
    return points.min(axis=0), points.max(axis=0)


def _box(low: Floats, high: Floats) -> str:
    x, y = (f"{number(float(a))} to {number(float(b))}" for a, b in zip(low, high, strict=True))
    return f"x {x}, y {y}"


def _first_clauses(strategy: Strategy, start: Start, region: StrategyRegion) -> tuple[Clause, ...]:
    rest = outside(strategy.space, region.region, start.region)
    share = _both(strategy, start.region, region.region)
    words = _position(strategy, share, Region(rest.area, rest.contact))
    return () if words is None else (Clause((), words),)
