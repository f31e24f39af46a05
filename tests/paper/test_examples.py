"""Examples 1 to 5 of the paper (6, Figures 11 to 15), and all other named tasks."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import product

import pytest

from preimage.search.planner import plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task, named_task_text, named_tasks, task_families
from preimage.task.options import Method, SearchOrder, StrategyKind
from preimage.task.task import InitialPoint, Task

Motions = dict[Method, int | None]

# What the paper says, and where it says less, what these scenes have. None: there is no strategy.
TABLE: dict[str, tuple[int | None, int | None, int | None]] = {
    "example-1": (5, 1, 1),
    "example-2": (2, 3, 2),
    "example-3": (3, 4, 3),
    "example-4": (None, 2, 2),
    "example-5": (5, 3, 2),
}

BOUNDS = ("control", "position", "force_angle", "force_thresholds", "friction")

# Each bound alone by 5 %, and all of them together, for the worse and for the better.
CHANGES: dict[str, dict[str, float]] = {
    **{f"{bound}-{sign:+.0%}": {bound: 1.0 + sign} for bound in BOUNDS for sign in (-0.05, 0.05)},
    "all-worse": {**dict.fromkeys(BOUNDS, 1.05), "friction": 0.95},
    "all-better": {**dict.fromkeys(BOUNDS, 0.95), "friction": 1.05},
    "all-larger": dict.fromkeys(BOUNDS, 1.05),
    "all-smaller": dict.fromkeys(BOUNDS, 0.95),
}


def changed(task: Task, factors: dict[str, float]) -> Task:
    """The task with some of its bounds multiplied."""
    scale = dict.fromkeys(BOUNDS, 1.0) | factors
    given = task.uncertainty
    lower, upper = given.force_thresholds
    uncertainty = replace(
        given,
        control=scale["control"] * given.control,
        position=scale["position"] * given.position,
        force_angle=scale["force_angle"] * given.force_angle,
        force_thresholds=(scale["force_thresholds"] * lower, scale["force_thresholds"] * upper),
    )
    return replace(task, uncertainty=uncertainty, friction=scale["friction"] * task.friction)


def planned(task: Task, method: Method) -> Strategy:
    return plan(replace(task, options=replace(task.options, method=method)))


def motions(task: Task) -> Motions:
    """The number of motions by each method; None if the search was exhausted without a strategy."""
    found: Motions = {}
    for method in Method:
        strategy = planned(task, method)
        assert strategy.status is not Status.STOPPED, strategy.reason
        found[method] = len(strategy.steps) if strategy.status is Status.SOLVED else None
    return found


def claimed(name: str) -> Motions:
    """The number of motions by each method that the head of a task's file claims."""
    head = named_task_text(name).splitlines()[1]
    match = re.fullmatch(r"# Motions: sticking (\w+), kernel (\w+), combined (\w+)\.", head)
    assert match is not None, head
    return {
        method: None if length == "none" else int(length)
        for method, length in zip(Method, match.groups(), strict=True)
    }


# --- examples 1 to 5 --------------------------------------------------------------------------


@pytest.mark.parametrize("name", TABLE)
def test_lengths_of_the_examples(name: str) -> None:
    assert motions(named_task(name)) == dict(zip(Method, TABLE[name], strict=True))


def test_the_table_is_what_the_paper_says() -> None:
    assert TABLE["example-1"] == (5, 1, 1)
    sticking, kernel, _ = TABLE["example-2"]
    assert sticking is not None
    assert kernel == 3 > sticking
    sticking, kernel, _ = TABLE["example-3"]
    assert sticking is not None
    assert kernel is not None
    assert 3 <= sticking <= kernel
    assert TABLE["example-4"][0] is None
    assert TABLE["example-5"] == (5, 3, 2)
    for *single, combined in TABLE.values():
        assert combined is not None
        assert all(length is None or combined <= length for length in single)


@pytest.mark.parametrize(("name", "change"), list(product(TABLE, CHANGES)))
def test_the_examples_are_on_no_knifes_edge(name: str, change: str) -> None:
    task = changed(named_task(name), CHANGES[change])
    assert motions(task) == dict(zip(Method, TABLE[name], strict=True))


@pytest.mark.parametrize("name", TABLE)
def test_the_examples_are_posed_as_in_the_paper(name: str) -> None:
    task = named_task(name)
    assert isinstance(task.initial, InitialPoint)
    assert isinstance(task.options.directions, tuple)
    assert len(task.options.directions) in (4, 8)
    assert task.options.search is SearchOrder.BREADTH_FIRST
    assert task.options.strategy is StrategyKind.LINEAR
    assert (len(task.workspace.obstacles) == 1) == (name == "example-4")


# --- all named tasks --------------------------------------------------------------------------


def test_there_are_at_least_twenty() -> None:
    assert len(named_tasks()) >= 20


OPTIONS = {name: named_task(name).options for name in named_tasks()}
LINEAR = [
    name
    for name, options in OPTIONS.items()
    if options.strategy is StrategyKind.LINEAR and not options.or_fail
]


@pytest.mark.parametrize("name", LINEAR)
def test_a_named_task_is_planned_as_its_head_claims(name: str) -> None:
    task = named_task(name)
    claim = claimed(name)
    assert motions(task) == claim
    assert claim[task.options.method] is not None


@pytest.mark.parametrize("name", named_tasks())
def test_a_named_task_says_what_it_is(name: str) -> None:
    assert named_task(name).name == name
    assert re.fullmatch(r"[A-Z].{20,90}[.]", named_tasks()[name])


@pytest.mark.parametrize("name", named_tasks())
@pytest.mark.parametrize("change", ["all-worse", "all-better"])
def test_a_named_task_is_on_no_knifes_edge(name: str, change: str) -> None:
    assert plan(changed(named_task(name), CHANGES[change])).status is Status.SOLVED


@pytest.mark.parametrize("family", task_families())
@pytest.mark.parametrize("size", [1, 2, 3, 7, 40, 150])
def test_a_family_is_planned_at_any_size(family: str, size: int) -> None:
    assert plan(named_task(f"{family}-{size}")).status is Status.SOLVED


@pytest.mark.parametrize(("family", "expected"), [("comb", 2), ("saw-tooth", 1)])
def test_a_familys_plan_does_not_grow_with_its_size(family: str, expected: int) -> None:
    for size in (1, 5, 25, 125):
        assert len(plan(named_task(f"{family}-{size}")).steps) == expected
