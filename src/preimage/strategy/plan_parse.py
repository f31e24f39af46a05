"""From the data of a plan file to a strategy; what is not one is refused by its key."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from preimage.configuration.obstacles import configuration_space
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import InputError, PlanFileError, TaskError, shown
from preimage.recognition.termination import (
    Condition,
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.strategy.margins import Margins
from preimage.strategy.region_geojson import region_from_geojson
from preimage.strategy.strategy import Motion, Statistics, Status, Strategy, StrategyRegion
from preimage.task import checks, limits
from preimage.task.degrees import to_radians
from preimage.task.limits import Range
from preimage.task.options import StrategyKind
from preimage.task.parameters import INFINITY
from preimage.task.parse import fields, parse_task

VERSION = 1
"""Of the plan file."""

REQUIRED = ("version", "task", "status", "strategy", "regions", "start")
OPTIONAL = ("steps", "statistics", "margins")
MOTION = ("direction", "goals", "target", "termination")
OPTIONAL_OF_MOTION = ("margin",)
STATISTICS = ("regions", "seconds")
LENGTHS = ("start", "reading")
ANGLES = ("force", "direction")
CONDITIONS: dict[str, tuple[str, ...]] = {
    "sticking": ("period", "distance"),
    "reading": ("domain",),
    "elapsed": ("period",),
}

NUMBER = Range(0, limits.REGIONS.high)
PERIOD = Range(0.0, 1e18, low_open=True)
DISTANCE = Range(0.0, 1e18)
MARGIN = Range(0.0, 180.0, unit="degrees")
SECONDS = Range(0.0, 1e18)


def parse_plan(data: object) -> Strategy:
    """The strategy that the data of a plan file describes.

    Raises
    ------
    PlanFileError : with the key, the value and the rule.
    """
    if not isinstance(data, Mapping):
        raise PlanFileError("plan", f"must be a mapping, not {shown(data)}")
    try:
        return _strategy(fields(data, "", REQUIRED, OPTIONAL))
    except InputError as error:
        raise PlanFileError(error.key, error.rule) from None


def _strategy(top: Mapping[str, Any]) -> Strategy:
    if checks.number(top["version"], "version") != VERSION:
        raise InputError("version", f"must be {VERSION}, not {shown(top['version'])}")
    try:
        task = parse_task(top["task"])
        space = configuration_space(task)
    except TaskError as error:
        raise error.under("task") from None
    regions = tuple(
        _region(item, f"regions[{index}]", space)
        for index, item in enumerate(checks.items(top["regions"], "regions", least=1))
    )
    strategy = Strategy(
        task=task,
        space=space,
        status=checks.choice(top["status"], "status", Status),
        kind=checks.choice(top["strategy"], "strategy", StrategyKind),
        regions=regions,
        start=_numbers(top["start"], "start"),
        steps=_numbers(top.get("steps", ()), "steps"),
        statistics=_statistics(top.get("statistics", {}), len(regions)),
        margins=_margins(top["margins"]) if "margins" in top else None,
    )
    _check_graph(strategy)
    _check_route(strategy)
    if strategy.margins is not None and strategy.status is not Status.SOLVED:
        raise InputError("margins", "must not be given, since the status is not solved")
    return strategy


# --- values ---------------------------------------------------------------------------------


def _region(value: object, key: str, space: ConfigurationSpace) -> StrategyRegion:
    common = ("id", "rank", "geometry")
    data = fields(value, key, common, ("failure", *MOTION, *OPTIONAL_OF_MOTION))
    number = checks.integer(data["id"], f"{key}.id", NUMBER)
    rank = checks.integer(data["rank"], f"{key}.rank", NUMBER)
    failure = number != 0 and "failure" in data
    if number == 0:
        fields(value, key, common)
        if rank != 0:
            raise InputError(f"{key}.rank", f"must be 0 for the goal, not {rank}")
    elif failure:
        fields(value, key, (*common, "failure"))
        if not checks.truth(data["failure"], f"{key}.failure"):
            raise InputError(f"{key}.failure", "must be true where it is given")
        if rank != 0:
            raise InputError(f"{key}.rank", f"must be 0 for a region of failure, not {rank}")
    else:
        fields(value, key, (*common, *MOTION), OPTIONAL_OF_MOTION)
        if rank == 0:
            raise InputError(f"{key}.rank", "must be 1 or more for a preimage, not 0")
    return StrategyRegion(
        id=number,
        rank=rank,
        region=region_from_geojson(data["geometry"], space, f"{key}.geometry"),
        motion=None if number == 0 or failure else _motion(data, key, space),
        failure=failure,
    )


def _motion(data: Mapping[str, Any], key: str, space: ConfigurationSpace) -> Motion:
    degrees = checks.number(data["direction"], f"{key}.direction", limits.DIRECTION) % 360.0
    goals = _numbers(data["goals"], f"{key}.goals")
    if not goals:
        raise InputError(f"{key}.goals", "must have a region")
    conditions = checks.items(data["termination"], f"{key}.termination", least=1)
    return Motion(
        # a tiny negative angle is rounded to 360
        direction=to_radians(degrees) if degrees < 360.0 else 0.0,
        goals=goals,
        target=region_from_geojson(data["target"], space, f"{key}.target"),
        termination=tuple(
            _condition(item, f"{key}.termination[{index}]", space)
            for index, item in enumerate(conditions)
        ),
        margin=_margin(data, key),
    )


def _margin(data: Mapping[str, Any], key: str) -> float | None:
    if "margin" not in data:
        return None
    return to_radians(checks.number(data["margin"], f"{key}.margin", MARGIN))


def _condition(value: object, key: str, space: ConfigurationSpace) -> Condition:
    if not isinstance(value, Mapping):
        raise InputError(key, f"must be a mapping, not {shown(value)}")
    if "kind" not in value:
        raise InputError(f"{key}.kind", "is missing")
    kind = value["kind"]
    if not isinstance(kind, str) or kind not in CONDITIONS:
        rule = f"must be {checks.one_of(list(CONDITIONS))}, not {shown(kind)}"
        raise InputError(f"{key}.kind", rule)
    data = fields(value, key, ("kind", *CONDITIONS[kind]))
    if kind == "reading":
        domain = data["domain"]
        if domain == "valid":
            return ReadingCondition()
        if not isinstance(domain, Mapping):
            rule = f"must be valid or a GeoJSON geometry, not {shown(domain)}"
            raise InputError(f"{key}.domain", rule)
        return ReadingCondition(region_from_geojson(domain, space, f"{key}.domain"))
    period = checks.number(data["period"], f"{key}.period", PERIOD)
    if kind == "elapsed":
        return ElapsedCondition(period)
    return StickingCondition(period, checks.number(data["distance"], f"{key}.distance", DISTANCE))


def _numbers(value: object, key: str) -> tuple[int, ...]:
    """Ids of regions, each once."""
    numbers: dict[int, None] = {}
    for index, item in enumerate(checks.items(value, key)):
        number = checks.integer(item, f"{key}[{index}]", NUMBER)
        if number in numbers:
            raise InputError(f"{key}[{index}]", f"names region {number} again")
        numbers[number] = None
    return tuple(numbers)


def _statistics(value: object, regions: int) -> Statistics:
    data = fields(value, "statistics", (), STATISTICS)
    return Statistics(
        regions=checks.integer(data.get("regions", regions), "statistics.regions", NUMBER),
        seconds=checks.number(data.get("seconds", 0.0), "statistics.seconds", SECONDS),
    )


def _margins(value: object) -> Margins:
    data = fields(value, "margins", (), (*LENGTHS, *ANGLES))
    known: dict[str, float | None] = dict.fromkeys((*LENGTHS, *ANGLES))
    for word, margin in data.items():
        if isinstance(margin, str) and margin in INFINITY:
            known[word] = math.inf
        elif word in LENGTHS:
            known[word] = checks.extended(margin, f"margins.{word}", DISTANCE)
        else:
            degrees = checks.extended(margin, f"margins.{word}", MARGIN)
            known[word] = to_radians(degrees) if math.isfinite(degrees) else degrees
    return Margins(**known)


# --- what must go together ------------------------------------------------------------------


def _check_graph(strategy: Strategy) -> None:
    """Refuse ids that are repeated or name nothing, and motions that lead no nearer to the goal."""
    ranks: dict[int, int] = {}
    for index, region in enumerate(strategy.regions):
        if region.id in ranks:
            raise InputError(f"regions[{index}].id", f"{region.id} is there already")
        ranks[region.id] = region.rank
    if 0 not in ranks:
        raise InputError("regions", "must have region 0, the goal")
    for index, region in enumerate(strategy.regions):
        for place, goal in enumerate(region.motion.goals if region.motion else ()):
            key = f"regions[{index}].goals[{place}]"
            _check_known(goal, key, ranks)
            if ranks[goal] >= region.rank:
                rule = (
                    f"must be of lower rank than {region.rank}, but region {goal} has {ranks[goal]}"
                )
                raise InputError(key, rule)
    for word, numbers in (("start", strategy.start), ("steps", strategy.steps)):
        for place, number in enumerate(numbers):
            _check_known(number, f"{word}[{place}]", ranks)


def _check_known(number: int, key: str, known: Mapping[int, int]) -> None:
    if number not in known:
        raise InputError(key, f"there is no region {number}")


def _check_route(strategy: Strategy) -> None:
    """Refuse a start and steps that do not lead to the goal."""
    start, steps = strategy.start, strategy.steps
    if strategy.status is Status.SOLVED and not start:
        raise InputError("start", "must name a region, since the status is solved")
    if strategy.kind is not StrategyKind.LINEAR:
        if steps:
            raise InputError("steps", "must be empty, since the strategy is not linear")
        return
    if strategy.status is not Status.SOLVED and not steps:
        return
    if not steps:
        if 0 not in start:
            raise InputError("steps", "must lead from the start to region 0")
        return
    if steps[0] not in start:
        raise InputError("steps[0]", f"must be in start, and region {steps[0]} is not")
    regions = {region.id: region for region in strategy.regions}
    for place, (number, following) in enumerate(pairwise((*steps, 0))):
        motion = regions[number].motion
        if motion is None:
            name = "a region of failure" if regions[number].failure else "the goal"
            raise InputError(f"steps[{place}]", f"must be a preimage, not {name}")
        if following not in motion.goals:
            rule = f"must have region {following} among its goals, and region {number} has not"
            raise InputError(f"steps[{place}]", rule)
