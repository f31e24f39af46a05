"""Conditional plans keep their promise: proven, and never caught by an adversary (theory 8)."""

from dataclasses import replace
from random import Random

import pytest

import preimage
from preimage.execution.runs import RunOptions
from preimage.search.planner import plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task
from preimage.task.options import Method, SearchOrder, StrategyKind
from preimage.task.task import Task
from preimage.verification.verdict import Verdict
from tests.laws.tasks import random_task

RUNS = 20


def conditional(task: Task, method: Method | None = None) -> Strategy:
    options = replace(
        task.options,
        strategy=StrategyKind.CONDITIONAL,
        search=SearchOrder.BREADTH_FIRST,
        method=method or task.options.method,
    )
    return plan(replace(task, options=options))


def check(strategy: Strategy, seed: int) -> None:
    found = preimage.verify(strategy)
    assert found.verdict is not Verdict.REFUTED, (seed, str(found))
    report = preimage.run(strategy, options=RunOptions(runs=RUNS, seed=seed, workers=1))
    assert not report.failures, (seed, report.failure)


def check_block(seeds: range) -> tuple[int, int]:
    """How many plans there were, and how many have a motion with several goals."""
    plans = several = 0
    for seed in seeds:
        made = conditional(random_task(Random(seed)))
        if made.status is not Status.SOLVED:
            continue
        check(made, seed)
        plans += 1
        several += any(one.motion and len(one.motion.goals) > 1 for one in made.regions)
    return plans, several


def test_conditional_plans_hold() -> None:
    plans, _ = check_block(range(1000, 1006))
    assert plans


@pytest.mark.slow
@pytest.mark.parametrize("first", range(2000, 2120, 30))
def test_many_conditional_plans_hold(first: int) -> None:
    plans, _ = check_block(range(first, first + 30))
    assert plans


@pytest.mark.slow
@pytest.mark.parametrize("method", list(Method))
def test_peg_in_hole_holds(method: Method) -> None:
    made = conditional(named_task("peg-in-hole"), method)
    if made.status is Status.SOLVED:
        check(made, 0)
