"""Conditional strategies: layers that aim at all regions known (theory 7, paper 8)."""

from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration import region as regions
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, covered, start_region
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.search.conditional import Layers, layers
from preimage.search.limits import Limits
from preimage.search.planner import plan
from preimage.search.policy import policy
from preimage.strategy.strategy import Status
from preimage.task.options import Method, SearchOrder, StrategyKind
from preimage.task.task import Task
from tests.laws.tasks import random_task

seeds = st.integers(0, 2**32 - 1)
LIMIT = 40


def search(task: Task, start: Start | None = None) -> tuple[Setting, Layers]:
    setting = Setting.of(task)
    options = task.options
    assert isinstance(options.directions, tuple)
    found = layers(
        setting,
        [goal_region(task, setting.space)],
        start or start_region(task, setting.space),
        options.directions,
        options.method,
        options.max_steps,
        Limits(None, LIMIT),
    )
    return setting, found


def small_task(seed: int) -> Task:
    task = random_task(Random(seed))
    options = replace(task.options, max_steps=3, max_regions=LIMIT)
    return replace(task, options=options)


@given(seeds)
@settings(max_examples=20, deadline=None)
def test_ranks_fall_and_goals_are_known_before(seed: int) -> None:
    _, found = search(small_task(seed))
    assert [one.id for one in found.regions] == list(range(len(found.regions)))
    for one in found.regions:
        assert (one.rank == 0) == (one.preimage is None)
        assert all(goal.rank < one.rank for goal in one.goals)


@given(seeds)
@settings(max_examples=20, deadline=None)
def test_a_direction_loses_nothing_in_a_later_layer(seed: int) -> None:
    setting, found = search(small_task(seed))
    tolerance = setting.space.tolerance
    best: dict[float, Region] = {}
    for one in found.regions:
        if one.preimage is None or len(one.goals) == 1:
            continue
        before = best.get(one.preimage.direction)
        if before is not None:
            assert regions.is_subset(before, one.region, tolerance)
        best[one.preimage.direction] = one.region


@given(seeds)
@settings(max_examples=15, deadline=None)
def test_the_first_layer_holds_every_preimage_of_the_goal(seed: int) -> None:
    task = small_task(seed)
    setting, found = search(task)
    if found.stopped is not None and "motions" not in found.stopped:
        return
    goal = found.regions[0].region
    if found.regions[-1].rank == 0:
        return
    for direction in setting_directions(task):
        alone = preimage(setting, goal, direction, task.options.method).region
        if alone.is_empty:
            continue
        assert any(
            regions.is_subset(alone, one.region, setting.space.tolerance) for one in found.regions
        )


def setting_directions(task: Task) -> tuple[float, ...]:
    assert isinstance(task.options.directions, tuple)
    return task.options.directions


@given(seeds)
@settings(max_examples=15, deadline=None)
def test_the_policy_is_closed_and_its_motions_go_to_lower_ranks(seed: int) -> None:
    task = small_task(seed)
    setting, found = search(task)
    if not found.start:
        return
    used = policy(found.aimed, found.start, (found.regions[0],))
    ids = {one.id: one for one in used}
    by_id = {one.id: one for one in found.regions}
    assert all(one.id in ids for one in found.start)
    for one in used:
        known = by_id[one.id]
        assert one.region is known.region
        assert one.rank <= known.rank
        if one.motion is not None:
            assert one.motion.goals
            assert all(ids[goal].rank < one.rank for goal in one.motion.goals)
            assert set(one.motion.goals) <= {goal.id for goal in known.goals}
    if len(found.start) == 1:
        start = start_region(task, setting.space)
        assert covered(start, found.start[0].region, setting.space)


def lengths(task: Task) -> tuple[int | None, int | None]:
    """The most motions of the linear plan and of the conditional one; None where there is none."""
    found = []
    for kind in (StrategyKind.LINEAR, StrategyKind.CONDITIONAL):
        options = replace(task.options, strategy=kind, search=SearchOrder.BREADTH_FIRST)
        made = plan(replace(task, options=options))
        solved = made.status is Status.SOLVED
        found.append(max(made.region(one).rank for one in made.start) if solved else None)
    return found[0], found[1]


@given(seeds, st.sampled_from(list(Method)))
@settings(max_examples=12, deadline=None)
def test_conditional_strategies_solve_all_that_linear_ones_do_and_are_no_longer(
    seed: int, method: Method
) -> None:
    task = small_task(seed)
    linear, conditional = lengths(replace(task, options=replace(task.options, method=method)))
    if linear is not None:
        assert conditional is not None
        assert conditional <= linear


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 120, 40))
def test_conditional_strategies_are_no_longer_on_many_tasks(first: int) -> None:
    solved = 0
    for seed in range(first, first + 40):
        linear, conditional = lengths(small_task(seed))
        if linear is not None:
            assert conditional is not None, seed
            assert conditional <= linear, seed
            solved += 1
    assert solved
