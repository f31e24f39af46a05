"""Margins: each motion's other directions keep the plan's promise too."""

import math
from dataclasses import replace
from functools import cache
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import preimage
from preimage.configuration.goals import goal_region
from preimage.configuration.region import is_subset
from preimage.configuration.start import covered, start_region
from preimage.errors import TaskError
from preimage.execution.runs import RunOptions
from preimage.geometry.angles import TAU
from preimage.preimages.methods import preimage as preimage_of
from preimage.preimages.setting import Setting
from preimage.search.continuous import first_directions, refined, search_continuous
from preimage.search.limits import Limits
from preimage.search.linear import Outcome, search
from preimage.search.tolerance import tolerant
from preimage.strategy.describe import describe
from preimage.strategy.plan_file import plan_to_dict, read_plan
from preimage.strategy.strategy import (
    Motion,
    Statistics,
    Status,
    Strategy,
    StrategyRegion,
)
from preimage.task.examples import named_task
from preimage.task.options import SearchOrder, StrategyKind
from preimage.task.task import InitialPoint, Task
from preimage.verification.verdict import Verdict
from tests.laws.tasks import random_task

SEEDS = st.integers(0, 10_000)
FEW = RunOptions(runs=24, seed=3, workers=1)


def found(task: Task) -> Outcome:
    """With the task's directions, and then the most tolerant ones."""
    setting = Setting.of(task)
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    options = task.options
    assert isinstance(options.directions, tuple)
    outcome = search(
        setting, goal, start, options.directions, options.method, SearchOrder.BREADTH_FIRST,
        options.max_steps, Limits(None, 60),
    )  # fmt: skip
    if outcome.solution is not None:
        chain = outcome.solution.chain
        chain = tolerant(setting, chain, start, options.method, options.resolution)
        outcome = Outcome(list(reversed(chain)), chain[0])
    return outcome


def anywhere(task: Task, limits: Limits | None = None) -> Outcome:
    """With any directions."""
    setting = Setting.of(task)
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    limits = limits or Limits(None, 400)
    return search_continuous(setting, goal, start, task.options, limits)


def strategy_of(task: Task, outcome: Outcome) -> Strategy:
    assert outcome.solution is not None
    chain = outcome.solution.chain
    regions = []
    for node in chain:
        motion = None
        if node.preimage is not None and node.parent is not None:
            made = node.preimage
            motion = Motion(
                made.direction % TAU, (node.parent.id,), made.target.region, made.termination,
                node.margin,
            )  # fmt: skip
        regions.append(StrategyRegion(node.id, node.rank, node.region, motion))
    return Strategy(
        task=task,
        space=Setting.of(task).space,
        status=Status.SOLVED,
        kind=StrategyKind.LINEAR,
        regions=tuple(sorted(regions, key=lambda region: region.id)),
        start=(chain[0].id,),
        steps=tuple(node.id for node in chain[:-1]),
        statistics=Statistics(),
    )


def turned(strategy: Strategy, shares: list[float]) -> Strategy:
    """The same plan, its motions off by shares of their margins."""
    regions = []
    for region, share in zip(strategy.regions, shares, strict=True):
        motion = region.motion
        if motion is not None:
            off = motion.direction + share * (motion.margin or 0.0)
            region = replace(region, motion=replace(motion, direction=off % TAU))
        regions.append(region)
    return replace(strategy, regions=tuple(regions))


@cache
def plan_of(name: str) -> Strategy:
    task = named_task(name)
    return strategy_of(task, found(task))


def check_margins(strategy: Strategy, rng: Random, runs: int = 0) -> None:
    """At the ends of all margins, in any mix, the plan is proven and runs succeed."""
    count = len(strategy.regions)
    mixes = [[-1.0] * count, [1.0] * count, [rng.uniform(-1.0, 1.0) for _ in range(count)]]
    for shares in mixes:
        other = turned(strategy, shares)
        verdict = preimage.verify(other, runs=runs)
        assert verdict.verdict is not Verdict.REFUTED, (shares, verdict.findings)
        assert preimage.run(other, options=FEW).failure is None


@pytest.mark.parametrize("name", ["flat-floor", "peg-in-hole-point"])
def test_named_plans_keep_their_promise_with_every_direction(name: str) -> None:
    strategy = plan_of(name)
    check_margins(strategy, Random(name))
    assert preimage.verify(strategy, runs=0).verdict is Verdict.PROVEN
    for region in strategy.regions:
        assert region.motion is None or (region.motion.margin or 0.0) > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["l-room", "example-1", "example-4", "rails", "cradle"])
def test_more_named_plans_keep_their_promise(name: str) -> None:
    check_margins(plan_of(name), Random(name), runs=1)


def test_flat_floor_has_all_the_margin_there_is() -> None:
    (region,) = (one for one in plan_of("flat-floor").regions if one.motion)
    assert region.motion is not None
    assert region.motion.margin is not None
    half = math.atan2(2.0, 5.0) - math.radians(10.0)
    assert half - math.radians(0.7) <= region.motion.margin <= half
    assert region.motion.direction == pytest.approx(1.5 * math.pi)


def test_regions_hold_the_start_and_lead_on() -> None:
    """What the plan keeps of each region lies in the preimage of each of its directions."""
    task = named_task("peg-in-hole-point")
    setting = Setting.of(task)
    start = start_region(task, setting.space)
    outcome = found(task)
    assert outcome.solution is not None
    assert covered(start, outcome.solution.region, setting.space)
    for node in outcome.solution.chain[:-1]:
        assert node.preimage is not None
        assert node.parent is not None
        assert node.margin
        for share in (-1.0, -0.3, 0.0, 0.8, 1.0):
            direction = node.preimage.direction + share * node.margin
            made = preimage_of(setting, node.parent.region, direction, task.options.method)
            tolerance = setting.space.tolerance
            assert is_subset(node.region, made.region, tolerance)


def test_margins_go_into_plans_and_words() -> None:
    strategy = plan_of("l-room")
    again = read_plan(plan_to_dict(strategy))
    for one, other in zip(strategy.regions, again.regions, strict=True):
        if one.motion is None:
            continue
        assert other.motion is not None
        assert other.motion.margin == pytest.approx(one.motion.margin, rel=1e-12)
    assert "any direction from" in describe(strategy)


def test_what_does_not_hold_the_start_stays() -> None:
    task = named_task("flat-floor")
    setting = Setting.of(task)
    start = start_region(task, setting.space)
    outcome = found(task)
    assert outcome.solution is not None
    chain = outcome.solution.chain
    elsewhere = replace(start, point=(15.0, 5.0))
    same = tolerant(setting, chain, elsewhere, task.options.method, task.options.resolution)
    assert same == chain
    goal_alone = chain[-1:]
    assert tolerant(setting, goal_alone, start, task.options.method, 0.01) == goal_alone


def test_limits_leave_a_plan_that_holds() -> None:
    task = named_task("peg-in-hole-point")
    setting = Setting.of(task)
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    options = task.options
    assert isinstance(options.directions, tuple)
    outcome = search(
        setting, goal, start, options.directions, options.method, SearchOrder.BREADTH_FIRST, 8,
        Limits(None, 500),
    )  # fmt: skip
    assert outcome.solution is not None
    asked = iter(range(12))
    limits = Limits(None, 500, cancelled=lambda: next(asked, None) is None)
    chain = tolerant(
        setting, outcome.solution.chain, start, options.method, options.resolution, limits
    )
    assert covered(start, chain[0].region, setting.space)
    check_margins(strategy_of(task, Outcome(list(chain), chain[0])), Random(1))


@pytest.mark.slow
@settings(max_examples=30, deadline=None)
@given(SEEDS)
def test_random_plans_keep_their_promise(seed: int) -> None:
    rng = Random(seed)
    task = random_task(rng)
    try:
        outcome = found(task)
    except TaskError:
        return
    if outcome.solution is not None and outcome.solution.rank:
        check_margins(strategy_of(task, outcome), rng)


@pytest.mark.slow
@settings(max_examples=12, deadline=None)
@given(SEEDS)
def test_many_random_plans_keep_their_promise(seed: int) -> None:
    rng = Random(seed)
    task = random_task(rng)
    try:
        outcome = anywhere(task, Limits(None, 25))
    except TaskError:
        return
    if outcome.solution is not None and outcome.solution.rank:
        check_margins(strategy_of(task, outcome), rng)


# --- searching with any direction -------------------------------------------------------------


def test_one_motion_where_eight_directions_need_two() -> None:
    outcome = anywhere(named_task("peg-in-hole-point"))
    assert outcome.solution is not None
    assert outcome.solution.rank == 1
    assert outcome.solution.margin is not None
    assert outcome.solution.margin > math.radians(15.0)


@pytest.mark.parametrize("name", ["example-2"])
def test_plans_are_proven(name: str) -> None:
    task = named_task(name)
    outcome = anywhere(task)
    strategy = strategy_of(task, outcome)
    assert preimage.verify(strategy, runs=0).verdict is Verdict.PROVEN


def test_a_start_in_the_goal_needs_no_motion() -> None:
    task = named_task("flat-floor")
    outcome = anywhere(replace(task, initial=InitialPoint((0.5, 0.0))))
    assert outcome.solution is not None
    assert outcome.solution.rank == 0


def test_limits_are_named() -> None:
    task = named_task("example-4")
    outcome = anywhere(task, Limits(None, 2))
    assert outcome.solution is None
    assert outcome.stopped == "the limit of 2 regions came first"
    outcome = anywhere(task, Limits(None, 500, cancelled=lambda: True))
    assert outcome.solution is None
    assert outcome.stopped == "interrupted"


def test_what_cannot_be_is_given_up() -> None:
    """Too much noise for any region at all: the search ends by itself."""
    task = named_task("flat-floor")
    task = replace(task, uncertainty=replace(task.uncertainty, control=math.radians(85.0)))
    options = replace(task.options, resolution=math.radians(1.0))
    outcome = anywhere(replace(task, options=options))
    assert outcome.solution is None
    assert outcome.stopped is not None
    assert "directions" in outcome.stopped


def test_first_directions_are_there_once() -> None:
    for name in ("l-room", "peg-in-hole", "example-1"):
        task = named_task(name)
        space = Setting.of(task).space
        found = first_directions(space, goal_region(task, space), start_region(task, space))
        assert len(set(found)) == len(found) >= 16
        assert all(0.0 <= direction < TAU for direction in found)
        assert list(found) == sorted(found)


def test_refining_halves_gaps_until_they_are_small() -> None:
    task = named_task("flat-floor")
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    outcome = Outcome([])
    directions = first_directions(setting.space, goal, start_region(task, setting.space))
    finer = refined(directions, outcome, 0.1)
    assert len(finer) == 2 * len(directions)
    while len(finer) > len(directions):
        directions, finer = finer, refined(finer, outcome, 0.1)
    gaps = [b - a for a, b in zip(finer, (*finer[1:], finer[0] + TAU), strict=True)]
    assert max(gaps) <= 0.1
