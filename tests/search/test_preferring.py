"""Of the shortest plans that with the largest smallest margin, against all sequences there are."""

import json
import math
from dataclasses import replace
from functools import cache
from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import preimage
from preimage.configuration.depth import depth_of_start
from preimage.configuration.goals import goal_region
from preimage.configuration.start import covered, start_region
from preimage.errors import TaskError, UnsupportedError
from preimage.preimages.methods import preimage as preimage_of
from preimage.preimages.setting import Setting
from preimage.search.cones import widened
from preimage.search.limits import Progress
from preimage.search.margins import margins
from preimage.search.planner import plan
from preimage.search.preferring import LEAST
from preimage.strategy.describe import describe
from preimage.strategy.margins import angle_unit, length_unit
from preimage.strategy.plan_file import format_plan, read_plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task
from preimage.task.options import (
    Continuous,
    Preference,
    SearchOrder,
    StrategyKind,
    Termination,
    uniform_directions,
)
from preimage.task.task import Task
from preimage.task.uncertainty import Uncertainty
from preimage.verification.verdict import Verdict
from tests.laws.tasks import random_task
from tests.search.brute_force import chains

QUICK = (
    "between-posts", "blind-corner", "blind-cradle", "cradle", "example-1", "example-2",
    "example-3", "example-4", "example-5", "figure-10", "figure-5", "flat-floor", "l-room",
    "landmark-edge", "peg-in-hole", "peg-in-hole-point", "rails", "two-bays",
)  # fmt: skip
SHORT = [("peg-in-hole-point", 8), ("cradle", 8), ("cradle", 16), ("example-4", 8), ("rails", 4)]


def asked(task: Task, **options: Any) -> Task:
    return replace(task, options=replace(task.options, **options))


def with_margin(task: Task, **options: Any) -> Strategy:
    return plan(asked(task, prefer=Preference.MARGIN, **options), reasoned=False)


def smallest(strategy: Strategy) -> float:
    assert strategy.margins is not None
    return strategy.margins.smallest(strategy.task)


def motions(strategy: Strategy) -> int:
    return max(strategy.region(number).rank for number in strategy.start)


@cache
def of_named(name: str, count: int) -> Strategy:
    """With so many directions, or the task's own."""
    return with_margin(turned(named_task(name), count))


def turned(task: Task, count: int) -> Task:
    return asked(task, directions=uniform_directions(count)) if count else task


# --- an oracle: every sequence, each asked whether it has a margin of so many units -----------


def has(task: Task, directions: tuple[float, ...], level: float) -> bool:
    """Whether the plan along these directions has every margin, each made from the definition."""
    own, length = task.uncertainty, level * length_unit(task)
    region = _first_region(task, directions, own)
    if region is None:
        return False
    setting = Setting.of(task)
    if depth_of_start(start_region(task, setting.space), region, setting.space) < length:
        return False
    worse = [replace(own, position=own.position + length)]
    if own.has_force_sensor:
        turn = own.force_angle + level * angle_unit(own.force_angle)
        worse.append(replace(own, force_angle=min(turn, math.pi * (1.0 - 1e-9))))
    if any(_first_region(task, directions, bounds) is None for bounds in worse):
        return False
    turn = level * angle_unit(own.control)
    return _first_region(task, directions, own, turn) is not None


def _first_region(
    task: Task, directions: tuple[float, ...], bounds: Uncertainty, turn: float = 0.0
) -> Any:
    setting = replace(Setting.of(task), uncertainty=bounds)
    region = goal_region(task, setting.space)
    for direction in reversed(directions):
        wide = widened(setting, turn, [region]) if turn else setting
        if wide is None:
            return None
        region = preimage_of(wide, region, direction, task.options.method).region
    return region if covered(start_region(task, setting.space), region, setting.space) else None


def sequences(task: Task, length: int) -> list[tuple[float, ...]]:
    """All directions of so many motions that lead from the start to the goal."""
    setting = Setting.of(task)
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    directions = task.options.directions
    assert isinstance(directions, tuple)
    return [
        chain.directions
        for chain in chains(setting, goal, directions, task.options.method, length)
        if len(chain.directions) == length and covered(start, chain.region, setting.space)
    ]


def check_against_all(strategy: Strategy) -> int:
    """No sequence of that length has clearly more; how many there are."""
    level, length = smallest(strategy), len(strategy.steps)
    task = strategy.task
    every = sequences(task, length)
    used = [strategy.region(step).motion for step in strategy.steps]
    own = tuple(motion.direction for motion in used if motion is not None)
    assert own in every
    assert level == 0.0 or math.isinf(level) or has(task, own, level * (1.0 - 1e-9))
    above = max(1.15 * level, 2.0 * LEAST)
    assert not any(has(task, directions, above) for directions in every)
    return len(every)


@pytest.mark.parametrize(("name", "count"), SHORT)
def test_no_sequence_has_more(name: str, count: int) -> None:
    strategy = of_named(name, count)
    assert 1 <= len(strategy.steps) <= 2
    many = check_against_all(strategy)
    if many > 1:
        assert strategy.reason == f"{many} were compared by their smallest margin"
    else:
        assert strategy.reason == ""


@given(st.integers(0, 10_000))
@settings(max_examples=12)
def test_no_sequence_has_more_in_random_tasks(seed: int) -> None:
    task = random_task(Random(seed))
    task = asked(task, max_steps=2, search=SearchOrder.BREADTH_FIRST)
    try:
        strategy = with_margin(task)
    except TaskError:
        return
    if strategy.status is Status.SOLVED and strategy.steps:
        assert len(strategy.steps) == len(plan(task, reasoned=False).steps)
        check_against_all(strategy)


# --- against the first plan that is found -----------------------------------------------------


@pytest.mark.parametrize("name", QUICK)
def test_never_longer_and_never_tighter(name: str) -> None:
    task = named_task(name)
    first, best = margins(plan(task, reasoned=False)), with_margin(task)
    assert best.status is first.status
    assert motions(best) == motions(first)
    assert smallest(best) >= smallest(first)


@pytest.mark.parametrize(("name", "count"), [("connector", 0), ("cradle", 16), ("example-4", 8)])
def test_better_plans_are_found_and_true(name: str, count: int) -> None:
    first = margins(plan(turned(named_task(name), count), reasoned=False))
    best = of_named(name, count)
    assert smallest(best) > 1.2 * smallest(first)
    assert preimage.verify(best, runs=1).verdict is not Verdict.REFUTED


def test_led_searches_choose_the_same() -> None:
    one = of_named("cradle", 8)
    led = with_margin(
        named_task("cradle"), directions=uniform_directions(8), search=SearchOrder.LED
    )
    assert smallest(led) == pytest.approx(smallest(one), rel=0.06)
    assert len(led.steps) == len(one.steps)


def test_same_bytes_twice() -> None:
    task = asked(named_task("cradle"), directions=uniform_directions(8), prefer=Preference.MARGIN)
    texts = [format_plan(plan(task)) for _ in range(2)]
    one, other = ([line for line in text.splitlines() if "seconds" not in line] for text in texts)
    assert one == other
    assert read_plan(json.loads(texts[0])).task.options.prefer is Preference.MARGIN


# --- limits and refusals ----------------------------------------------------------------------


def test_limits_end_the_comparison_and_are_told() -> None:
    task = asked(named_task("cradle"), directions=uniform_directions(16), max_regions=40)
    seen: list[Progress] = []
    strategy = plan(asked(task, prefer=Preference.MARGIN), progress=seen.append)
    assert seen[-1].best.endswith(" plans compared")
    assert strategy.status is Status.SOLVED
    assert strategy.reason.endswith("; the limit of 40 regions came first")
    assert f"of the plans that are as short, {strategy.reason}" in describe(strategy).splitlines()
    assert smallest(strategy) >= smallest(margins(plan(task)))


@pytest.mark.parametrize("most", [20, 30, 100])
def test_interrupted_comparisons_keep_a_plan(most: int) -> None:
    task = asked(named_task("cradle"), prefer=Preference.MARGIN)
    calls = 0
    first = plan(asked(task, prefer=Preference.SHORTEST))

    def cancelled() -> bool:
        nonlocal calls
        calls += 1
        return calls > most

    strategy = plan(task, cancelled=cancelled)
    assert strategy.status is Status.SOLVED
    assert len(strategy.steps) == len(first.steps)
    assert strategy.reason.endswith("; interrupted")


def test_start_in_the_goal_and_unsolvable_tasks() -> None:
    task = named_task("flat-floor")
    strategy = with_margin(task, directions=(0.5 * math.pi,))
    assert strategy.status is Status.UNSOLVABLE
    assert strategy.margins is None


@pytest.mark.parametrize(
    ("options", "rule"),
    [
        ({"directions": Continuous()}, "needs a list of directions"),
        ({"search": SearchOrder.BEST_FIRST}, "needs a search that finds the fewest motions"),
        ({"termination": Termination.FINAL_STATE}, "needs instantaneous conditions"),
    ],
)
def test_refusals(options: dict[str, Any], rule: str) -> None:
    with pytest.raises(UnsupportedError, match=f"planner.prefer: margin {rule}"):
        with_margin(named_task("flat-floor"), **options)


def test_policies_with_state_are_compared() -> None:
    options = {"termination": Termination.INITIAL_STATE, "strategy": StrategyKind.CONDITIONAL}
    strategy = with_margin(named_task("flat-floor"), **options)
    assert strategy.status is Status.SOLVED
    assert smallest(strategy) > 0.0
