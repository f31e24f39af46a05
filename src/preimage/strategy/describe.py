"""A strategy in plain words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from preimage.configuration.contact_set import intersection
from preimage.configuration.location import inside_area
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import start_region
from preimage.recognition.termination import (
    Condition,
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.strategy.decisions import decision_list
from preimage.strategy.reason import shown_reasons
from preimage.strategy.strategy import Motion, Status, Strategy, StrategyRegion
from preimage.strategy.words import (
    arrow,
    contact_lines,
    count,
    degrees,
    direction_words,
    joined,
    number,
    place,
    region_words,
    shortened,
)
from preimage.task.options import Continuous, StrategyKind
from preimage.task.task import (
    Everywhere,
    Initial,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
)

MOST = 6
"""So many of the preimages that were found, the largest ones, are listed without a strategy."""


def describe(strategy: Strategy) -> str:
    """An account of a strategy: every motion with its direction, its aim and what ends it.

    >>> from preimage.search.planner import plan
    >>> from preimage.task import named_task
    >>> print(describe(plan(named_task("flat-floor"))).splitlines()[0])
    flat-floor: solved in 1 motion
    """
    return "\n".join([*_headline(strategy), *_body(strategy), *_totals(strategy)])


def describe_condition(condition: Condition, goals: tuple[int, ...]) -> str:
    """When a condition ends a motion.

    >>> describe_condition(StickingCondition(2.5, 0.25), (0,))
    'the measured position has moved by at most 0.25 within the last 2.5 of time'
    """
    match condition:
        case StickingCondition(period=period, distance=distance):
            return (
                f"the measured position has moved by at most {number(distance)}"
                f" within the last {number(period)} of time"
            )
        case ElapsedCondition(period=period):
            return f"a time of {number(period)} has passed"
        case ReadingCondition(domain=domain):
            within = "" if domain is None else f", of all in {region_words(domain)},"
            return f"every place that fits the readings{within} is in {_regions(goals)}"


def contact_share(region: Region, space: ConfigurationSpace) -> str:
    """How much of a region is contact: of the outline of its free space and of its edges."""
    if region.contact.is_empty:
        return "none of it" if not region.is_empty else "nothing to touch"
    if region.area.is_empty:
        return "all of it"
    near = space.tolerance.length
    starts, ends = region.area.segments
    outline = float(np.sum(np.hypot(*(ends - starts).T)))
    beside = inside_area(space.contact, region.area, near)
    along = intersection(region.contact, beside, near).total_length
    edges = region.contact.total_length
    return f"{edges / (outline + edges - along):.0%} of its outline"


def start_words(initial: Initial) -> str:
    """Where the robot may be at the start."""
    match initial:
        case InitialPoint(point=(x, y)):
            return f"the point ({number(x)}, {number(y)})"
        case InitialDisc(center=(x, y), radius=radius):
            return f"a disc of radius {number(radius)} around ({number(x)}, {number(y)})"
        case InitialPolygon(vertices=vertices):
            return f"a polygon of {len(vertices)} vertices"
        case InitialEdges(edges=edges):
            return count(len(edges), "edge")
        case Everywhere():
            return "anywhere"


# --- parts ----------------------------------------------------------------------------------


def _headline(strategy: Strategy) -> Iterator[str]:
    task, options = strategy.task, strategy.task.options
    if strategy.status is Status.SOLVED:
        most = max(strategy.region(number).rank for number in strategy.start)
        if strategy.failures and not strategy.can_succeed:
            result = f"can only fail, and knows it, in {count(most, 'motion')} at most"
        elif strategy.failures:
            result = (
                f"ends in the goal, or knows that it has failed, in {count(most, 'motion')} at most"
            )
        elif strategy.kind is StrategyKind.LINEAR:
            result = f"solved in {count(len(strategy.steps), 'motion')}"
        else:
            result = f"solved in {count(most, 'motion')} at most"
    elif strategy.status is Status.UNSOLVABLE:
        result = "not solvable with these directions and this method"
    else:
        result = f"stopped: {strategy.reason}" if strategy.reason else "stopped"
    yield f"{task.name}: {result}"
    directions = options.directions
    if isinstance(directions, Continuous):
        many = "all directions"
    else:
        many = count(len(directions), "direction")
    yield (
        f"  {options.method.value} method, {strategy.kind.value} strategy, {many},"
        f" at most {count(options.max_steps, 'motion')}"
    )
    yield f"  start: {start_words(task.initial)}"
    yield f"  goal: {region_words(strategy.region(0).region)}"
    if strategy.certain is not None and start_region(task, strategy.space).point is None:
        nowhere = strategy.certain.is_empty
        surely = "nowhere in the start" if nowhere else region_words(strategy.certain)
        yield f"  surely reaches it from: {surely}"
    for region in strategy.failures:
        yield f"  out of reach of it: region {region.id}, {region_words(region.region)}"


def _body(strategy: Strategy) -> Iterator[str]:
    if strategy.status is not Status.SOLVED:
        yield from _what_was_found(strategy)
    elif strategy.kind is StrategyKind.LINEAR:
        total = len(strategy.steps)
        if not total:
            yield "the start lies in the goal: there is nothing to do"
        for index, step in enumerate(strategy.steps, 1):
            region = strategy.region(step)
            yield from _motion(strategy, region, f"motion {index} of {total}")
    else:
        yield f"begins in {_regions(strategy.start, 'or')}"
        yield ""
        yield from decision_list(strategy).splitlines()
        for region in sorted(strategy.regions, key=lambda one: (one.rank, one.id)):
            if region.motion is not None:
                name = f"in region {region.id}, with {count(region.rank, 'motion')} left at most"
                yield from _motion(strategy, region, name)


def _motion(strategy: Strategy, region: StrategyRegion, name: str) -> Iterator[str]:
    motion = region.motion
    assert motion is not None
    yield ""
    yield f"{name}: {arrow(motion.direction)} {direction_words(motion.direction)}"
    if motion.margin is not None:
        low, high = motion.direction - motion.margin, motion.direction + motion.margin
        yield f"  tolerates   any direction from {degrees(low)} to {degrees(high)} will do"
    yield f"  from        {_region_name(region.id)}: {region_words(region.region)}"
    yield f"  aims at     {region_words(motion.target)}"
    for line in contact_lines(motion.target, strategy.space):
        yield f"              {line}"
    yield f"  contact     {contact_share(motion.target, strategy.space)}"
    yield from _conditions(motion)
    yield f"  then it is  in {_regions(motion.goals, 'or')}"


def _conditions(motion: Motion) -> Iterator[str]:
    for index, condition in enumerate(motion.termination):
        lead = "or as soon as" if index else "stops as soon as"
        yield f"  {lead} {describe_condition(condition, motion.goals)}"


def _what_was_found(strategy: Strategy) -> Iterator[str]:
    preimages = [region for region in strategy.regions if region.motion is not None]
    if not preimages:
        yield "no motion is known to end in the goal"
        yield from _what_stands_in_the_way(strategy)
        return
    yield f"{count(len(preimages), 'preimage')} found, and the start is in none of them"
    for region in sorted(preimages, key=_size)[:MOST]:
        assert region.motion is not None
        yield (
            f"  region {region.id}: {count(region.rank, 'motion')} from the goal, first"
            f" {direction_words(region.motion.direction)}; {region_words(region.region)}"
        )
    if len(preimages) > MOST:
        yield f"  and {len(preimages) - MOST} smaller ones"
    yield from _what_stands_in_the_way(strategy)


def _what_stands_in_the_way(strategy: Strategy) -> Iterator[str]:
    if not strategy.why:
        return
    origin = next((reason.origin for reason in strategy.why if reason.origin), None)
    yield f"what stands in the way{f' from {place(origin)}' if origin else ''}:"
    for line in shown_reasons(strategy.why):
        yield f"  {line}"


def _size(region: StrategyRegion) -> tuple[float, float, int]:
    """Sorts by area, then by contact, the largest first."""
    inside = region.region
    return -inside.area.measure, -inside.contact.total_length, region.id


def _totals(strategy: Strategy) -> Iterator[str]:
    statistics = strategy.statistics
    yield ""
    if strategy.margins is not None:
        yield f"margins: {strategy.margins.words}"
    if strategy.status is Status.SOLVED and strategy.reason:
        yield f"of the plans that are as short, {strategy.reason}"
    yield f"{count(statistics.regions, 'region')} made in {statistics.seconds:.3g} s"


def _region_name(number: int) -> str:
    return "the goal" if number == 0 else f"region {number}"


def _regions(numbers: tuple[int, ...], last: str = "and") -> str:
    """Regions by name: the goal, or their numbers."""
    names = shortened([_region_name(number) for number in numbers], 6)
    if last == "and" and len(numbers) > 1:
        return f"one of {joined(names)}"
    return joined(names, last)
