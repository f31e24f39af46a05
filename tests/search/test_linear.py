"""Linear search against brute force on small tasks."""

import math
from dataclasses import replace
from random import Random

import pytest

from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, start_region
from preimage.preimages.setting import Setting
from preimage.search.limits import Limits
from preimage.search.linear import ORDERS, Outcome, search
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.examples import named_task
from preimage.task.options import Method, SearchOrder, uniform_directions
from preimage.task.task import InitialPoint, Task
from tests.laws.similarity import within
from tests.laws.tasks import random_task
from tests.search.brute_force import chains, shortest

SLACK = 1e-6
STEPS = 3
FOUR = uniform_directions(4)


def small(seed: int, method: Method) -> Task:
    """A random task with four directions and at most three motions."""
    task = random_task(Random(seed))
    options = replace(
        task.options,
        directions=FOUR,
        method=method,
        max_steps=STEPS,
        search=SearchOrder.BREADTH_FIRST,
        max_regions=10_000,
    )
    return replace(task, options=options)


def ordered(task: Task, order: SearchOrder) -> Task:
    return replace(task, options=replace(task.options, search=order))


def brute(task: Task, setting: Setting) -> int | None:
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    return shortest(setting, goal, start, FOUR, task.options.method, STEPS)


def compare(task: Task, seed: int) -> bool:
    """All orders find what there is to find, all but one the shortest; whether there is any."""
    setting = Setting.of(task)
    length = brute(task, setting)
    for order in SearchOrder:
        found = plan(ordered(task, order))
        if length is None:
            assert found.status is not Status.SOLVED, (seed, order)
            assert found.steps == ()
            continue
        assert found.status is Status.SOLVED, (seed, order)
        assert len(found.steps) <= STEPS
        assert len(found.steps) >= length, (seed, order)
        if order is not SearchOrder.BEST_FIRST:
            assert len(found.steps) == length, (seed, order)
    return length is not None


@pytest.mark.parametrize("method", Method)
def test_a_shortest_plan_is_really_shortest(method: Method) -> None:
    count = 60 if method is Method.STICKING else 20
    solved = [compare(small(seed, method), seed) for seed in range(count)]
    assert sum(solved) > 2


@pytest.mark.slow
@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("first", range(70_000, 70_400, 50))
def test_a_shortest_plan_is_really_shortest_at_length(first: int, method: Method) -> None:
    for seed in range(first, first + 50):
        compare(small(seed, method), seed)


@pytest.mark.parametrize("name", ["peg-in-hole-point", "peg-in-hole", "l-room", "flat-floor"])
@pytest.mark.parametrize("method", Method)
def test_shortest_plans_of_named_tasks(name: str, method: Method) -> None:
    task = named_task(name)
    options = replace(task.options, directions=FOUR, method=method, max_steps=STEPS)
    compare(replace(task, options=options), 0)


def exhaust(task: Task, setting: Setting, goal: Region, order: SearchOrder) -> Outcome:
    """A search for a start that nothing covers: the point at infinity, as it were."""
    start = Start.anywhere_in(setting.space.valid)
    limits = Limits(None, 10_000)
    return search(setting, goal, start, FOUR, task.options.method, order, STEPS, limits)


@pytest.mark.parametrize("order", ORDERS)
def test_pruning_loses_nothing(order: SearchOrder) -> None:
    """Whatever a sequence of directions leads from lies in a region known at no greater depth."""
    pruned = checked = 0
    for seed in range(30):
        task = small(seed, list(Method)[seed % 3])
        setting = Setting.of(task)
        goal = goal_region(task, setting.space)
        outcome = exhaust(task, setting, goal, order)
        if outcome.solution is not None:
            continue
        pruned += outcome.pruned
        for chain in chains(setting, goal, FOUR, task.options.method, STEPS):
            checked += 1
            assert any(
                node.rank <= len(chain.directions) and within(chain.region, node.region, SLACK)
                for node in outcome.nodes
            ), (seed, chain.directions)
    assert pruned
    assert checked > 200


def test_the_nodes_are_what_they_claim() -> None:
    """Ranks count the motions, and each node's goal is its parent's region."""
    task = small(7, Method.COMBINED)
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    outcome = exhaust(task, setting, goal, SearchOrder.BREADTH_FIRST)
    assert [node.id for node in outcome.nodes] == list(range(len(outcome.nodes)))
    ranks = [node.rank for node in outcome.nodes]
    assert ranks == sorted(ranks)
    for node in outcome.nodes[1:]:
        assert node.parent is not None
        assert node.preimage is not None
        assert node.rank == node.parent.rank + 1
        assert node.preimage.goal is node.parent.region
        assert node.chain[-1].id == 0


def test_an_unsolvable_task_is_exhausted() -> None:
    task = named_task("flat-floor")
    uphill = replace(
        task, options=replace(task.options, directions=(math.radians(90),), max_steps=8)
    )
    for order in SearchOrder:
        found = plan(ordered(uphill, order))
        assert found.status is Status.UNSOLVABLE
        assert found.reason == ""
        assert found.steps == ()
        assert found.start == ()


def test_a_start_in_the_goal_needs_no_motion() -> None:
    task = replace(named_task("flat-floor"), initial=InitialPoint((0.0, 0.0)))
    found = plan(task)
    assert found.status is Status.SOLVED
    assert found.steps == ()
    assert found.start == (0,)


def test_the_same_task_gives_the_same_plan() -> None:
    for order in SearchOrder:
        task = ordered(named_task("peg-in-hole"), order)
        first, second = plan(task), plan(task)
        assert first.steps == second.steps
        for a, b in zip(first.regions, second.regions, strict=True):
            assert a.region.area.geometry.wkb == b.region.area.geometry.wkb
            assert a.region.contact.low.tobytes() == b.region.contact.low.tobytes()
