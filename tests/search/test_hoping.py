from __future__ import annotations

from dataclasses import replace

import pytest

from preimage.execution.runs import RunOptions, run
from preimage.execution.trace import Outcome
from preimage.search.planner import plan
from preimage.strategy.describe import describe
from preimage.task.examples import named_task
from preimage.task.initial import InitialDisc


@pytest.mark.parametrize(("place", "hope"), [((5.0, 6.0), True), ((0.0, 6.0), False)])
def test_a_plan_says_whether_it_can_succeed_at_all(place: tuple[float, float], hope: bool) -> None:
    task = replace(named_task("one-way-pit"), initial=InitialDisc(place, 0.5))
    strategy = plan(task)
    assert strategy.failures
    assert strategy.can_succeed is hope
    assert ("can only fail" in describe(strategy)) is not hope
    assert strategy.certain is not None
    report = run(strategy, options=RunOptions(runs=20, seed=1))
    assert not report.failures
    assert (report.outcomes.get(Outcome.SUCCESS, 0) > 0) is hope
