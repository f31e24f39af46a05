"""The led search against brute force and against breadth-first."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage import verify
from preimage.configuration.goals import goal_region
from preimage.configuration.start import covered, start_region
from preimage.preimages.setting import Setting
from preimage.search import led
from preimage.search.bounds import Bounds, Sensing
from preimage.search.limits import Limits, Progress
from preimage.search.linear import Outcome, search
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.examples import named_task, named_tasks
from preimage.task.options import Continuous, Method, SearchOrder, uniform_directions
from preimage.task.task import Everywhere, InitialPoint, Task
from preimage.verification.verdict import Verdict
from tests.laws.tasks import random_task
from tests.search.brute_force import shortest

STEPS = 3
FOUR = uniform_directions(4)


def found_by(
    task: Task,
    *,
    sensing: Sensing | None,
    directions: tuple[float, ...] | None = None,
    most: int | None = None,
    limits: Limits | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> Outcome:
    """What the led search finds, or breadth-first where no sensing is given."""
    options, setting = task.options, Setting.of(task)
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    assert not isinstance(options.directions, Continuous)
    ways = options.directions if directions is None else directions
    bound = limits or Limits(None, 10_000)
    most = options.max_steps if most is None else most
    if sensing is None:
        order = SearchOrder.BREADTH_FIRST
        return search(setting, goal, start, ways, options.method, order, most, bound, progress)
    return led.search(
        setting, goal, start, ways, options.method, most, bound, progress, sensing
    )  # fmt: skip


def length(outcome: Outcome) -> int | None:
    return outcome.solution.rank if outcome.solution else None


def by_method(task: Task, method: Method) -> Task:
    return replace(task, options=replace(task.options, method=method))


def small(seed: int, method: Method) -> Task:
    return by_method(random_task(Random(seed)), method)


def check_brute(seed: int, method: Method, sensing: Sensing) -> int | None:
    """As short as the shortest of all sequences."""
    task = small(seed, method)
    setting = Setting.of(task)
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    brute = shortest(setting, goal, start, FOUR, method, STEPS)
    found = found_by(task, sensing=sensing, directions=FOUR, most=STEPS)
    assert length(found) == brute, (seed, method, sensing)
    if brute is None and found.stopped:
        assert "motions" in found.stopped
    return brute


def test_as_short_as_brute_force() -> None:
    lengths = [
        check_brute(seed, list(Method)[seed % 3], list(Sensing)[seed // 3 % 2])
        for seed in range(400, 418)
    ]
    assert sum(number is not None for number in lengths) > 3


@pytest.mark.slow
@pytest.mark.parametrize("sensing", Sensing)
@pytest.mark.parametrize("first", range(82_000, 82_300, 50))
def test_as_short_as_brute_force_at_length(first: int, sensing: Sensing) -> None:
    for seed in range(first, first + 50):
        check_brute(seed, list(Method)[seed % 3], sensing)


def check_breadth_first(task: Task) -> None:
    """The same length, or the same reason why there is none; and a plan that holds together."""
    blind, found = found_by(task, sensing=None), found_by(task, sensing=Sensing.PERFECT)
    assert length(found) == length(blind)
    if found.solution is None:
        # what breadth-first exhausts, bounds that hold the start too late leave at the limit
        late = f"the limit of {task.options.max_steps} motions came first"
        assert found.stopped in (None, late)
        if blind.stopped is None and found.stopped:
            assert fewest(task) is None
        return
    space = Setting.of(task).space
    assert covered(start_region(task, space), found.solution.region, space)
    check_nodes(found)


def fewest(task: Task) -> int | None:
    setting, options = Setting.of(task), task.options
    assert not isinstance(options.directions, Continuous)
    bounds = Bounds(setting, goal_region(task, setting.space), options.directions, options.method)
    return bounds.fewest(start_region(task, setting.space), options.max_steps)


def check_nodes(outcome: Outcome) -> None:
    """Numbered in order, each node's goal its parent's region."""
    assert [node.id for node in outcome.nodes] == list(range(len(outcome.nodes)))
    for node in outcome.nodes[1:]:
        assert node.parent is not None
        assert node.preimage is not None
        assert node.rank == node.parent.rank + 1
        assert node.preimage.goal is node.parent.region
        assert node.chain[-1].id == 0


@given(st.integers(500, 10_000), st.sampled_from(Method))
@settings(max_examples=12, deadline=None)
def test_as_short_as_breadth_first(seed: int, method: Method) -> None:
    check_breadth_first(small(seed, method))


QUICK = (
    "blind-corner", "connector", "cradle", "example-1", "example-2", "example-3", "example-4",
    "flat-floor", "l-room", "landmark-edge", "peg-in-hole", "rails", "comb-4", "saw-tooth-4",
)  # fmt: skip


@pytest.mark.parametrize("method", Method)
def test_named_tasks_as_short_as_breadth_first(method: Method) -> None:
    for name in QUICK:
        check_breadth_first(by_method(named_task(name), method))


@pytest.mark.slow
@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("name", [*named_tasks(), "comb-12", "hall-12", "hall-40"])
def test_named_tasks_in_sixteen_directions(name: str, method: Method) -> None:
    task = by_method(named_task(name), method)
    many = replace(task, options=replace(task.options, directions=uniform_directions(16)))
    found = found_by(many, sensing=Sensing.PERFECT)
    blind = found_by(many, sensing=None, limits=Limits(20.0, 10_000))
    if blind.stopped is None or "time" not in blind.stopped:
        assert length(found) == length(blind)


@pytest.mark.parametrize("name", ["peg-in-hole", "landmark-edge", "example-3"])
def test_plans_are_verified(name: str) -> None:
    task = named_task(name)
    found = plan(replace(task, options=replace(task.options, search=SearchOrder.LED)))
    assert found.status is Status.SOLVED
    assert len(found.steps) == len(plan(task).steps)
    assert verify(found, runs=1).verdict is Verdict.PROVEN


def test_unsolvable_at_once() -> None:
    """Where perfect sensors would not help either, no preimage is made."""
    task = by_method(named_task("cluttered-hall"), Method.STICKING)
    found = found_by(task, sensing=Sensing.PERFECT)
    assert found.solution is None
    assert found.stopped is None
    assert len(found.nodes) == 1
    blind = found_by(task, sensing=None)
    assert blind.solution is None
    assert found.computed < blind.computed


@pytest.mark.parametrize("name", ["blind-corner", "cradle", "rails"])
def test_exhausted_where_only_sensing_fails(name: str) -> None:
    """Perfect sensors would do, those of the task do not: the graph is searched, to its end."""
    task = by_method(named_task(name), Method.KERNEL)
    found = found_by(task, sensing=Sensing.PERFECT)
    assert found.solution is None
    assert found.stopped is None
    tight = found_by(task, sensing=Sensing.GIVEN)
    assert tight.solution is None
    assert tight.stopped is None
    assert len(tight.nodes) == 1


def test_a_start_in_the_goal_needs_no_motion() -> None:
    task = replace(named_task("flat-floor"), initial=InitialPoint((0.0, 0.0)))
    found = found_by(task, sensing=Sensing.PERFECT)
    assert length(found) == 0
    assert found.computed == 0


def test_a_start_that_is_everywhere() -> None:
    task = named_task("flat-floor")
    for method in Method:
        options = replace(task.options, max_steps=3, method=method)
        check_breadth_first(replace(task, initial=Everywhere(), options=options))


def test_the_limit_of_motions() -> None:
    """Neither called unsolvable where longer plans may be, nor stopped where there are none."""
    task = by_method(named_task("peg-in-hole-point"), Method.KERNEL)
    whole = length(found_by(task, sensing=Sensing.PERFECT))
    assert whole == 3
    for most in range(1, whole):
        found = found_by(task, sensing=Sensing.PERFECT, most=most)
        assert found.solution is None
        assert found.stopped == f"the limit of {most} motions came first"
        check_nodes(found)
    assert length(found_by(task, sensing=Sensing.PERFECT, most=whole)) == whole


def after(count: int) -> Callable[[], bool]:
    asked = 0

    def cancelled() -> bool:
        nonlocal asked
        asked += 1
        return asked > count

    return cancelled


def test_it_can_be_cancelled_anywhere() -> None:
    task = named_task("example-3")
    count = 0
    while True:
        limits = Limits(None, 10_000, after(count))
        found = found_by(task, sensing=Sensing.PERFECT, limits=limits)
        check_nodes(found)
        if found.solution is not None:
            break
        assert found.stopped == "interrupted"
        count += 1
    assert count > 10


def test_limits_of_regions_and_time() -> None:
    task = by_method(named_task("example-3"), Method.KERNEL)
    for most in (1, 2, 3):
        found = found_by(task, sensing=Sensing.PERFECT, limits=Limits(None, most))
        assert found.solution is None
        assert "regions" in (found.stopped or "")
        assert len(found.nodes) == most
        check_nodes(found)
    found = found_by(task, sensing=Sensing.PERFECT, limits=Limits(0.0, 10))
    assert "time" in (found.stopped or "")


def test_progress_is_told() -> None:
    heard: list[Progress] = []
    found = found_by(
        by_method(named_task("example-3"), Method.KERNEL),
        sensing=Sensing.PERFECT,
        progress=heard.append,
    )
    assert found.solution is not None
    assert heard
    layers = [one.layer for one in heard]
    assert layers == sorted(layers)
    assert layers[-1] == found.solution.rank
    assert all(one.best for one in heard)


def test_the_same_task_gives_the_same_plan() -> None:
    task = by_method(named_task("example-3"), Method.KERNEL)
    first, second = (found_by(task, sensing=Sensing.PERFECT) for _ in range(2))
    assert len(first.nodes) == len(second.nodes)
    for a, b in zip(first.nodes, second.nodes, strict=True):
        assert a.region.area.geometry.wkb == b.region.area.geometry.wkb
        assert a.region.contact.low.tobytes() == b.region.contact.low.tobytes()
