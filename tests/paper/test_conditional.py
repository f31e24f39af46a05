"""Figure 20 of the paper, and tasks that conditional strategies alone solve (paper 8)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import degrees

import pytest

from preimage.configuration.start import covered, start_region
from preimage.execution.runs import RunOptions, run
from preimage.search.branching import Branching
from preimage.search.conditional import Known
from preimage.search.planner import plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task
from preimage.task.options import Method, StrategyKind, uniform_directions
from preimage.task.task import Task
from preimage.verification.verify import verify


def _linear(task: Task, method: Method, directions: int = 8) -> Strategy:
    kind, chosen = StrategyKind.LINEAR, uniform_directions(directions)
    options = replace(task.options, strategy=kind, method=method, directions=chosen, max_steps=8)
    return plan(replace(task, options=options))


def _most(strategy: Strategy) -> int:
    return max(strategy.region(number).rank for number in strategy.start)


def test_figure_20_down_then_as_the_normal_tells() -> None:
    """Down from anywhere, then up the flank that was hit, or nothing more (paper 8)."""
    strategy = plan(named_task("point-onto-hill"))
    assert strategy.status is Status.SOLVED
    (first,) = (strategy.region(number) for number in strategy.start)
    assert first.rank == 2
    assert first.motion is not None
    assert degrees(first.motion.direction) == pytest.approx(270.0)
    assert first.region.area.measure == pytest.approx(strategy.space.free.measure, rel=1e-9)
    after = [strategy.region(number) for number in first.motion.goals]
    assert sorted(region.rank for region in after) == [0, 1, 1]
    toward = sorted(degrees(one.motion.direction) for one in after if one.motion is not None)
    assert toward == pytest.approx([225.0, 315.0])
    assert len(strategy.regions) == 4


def test_a_linear_plan_onto_the_hill_takes_one_motion_more() -> None:
    strategy = _linear(named_task("point-onto-hill"), Method.KERNEL)
    assert len(strategy.steps) == 3


@pytest.mark.parametrize("directions", [8, 16])
@pytest.mark.parametrize("name", ["two-bays", "between-posts"])
@pytest.mark.parametrize("method", Method)
def test_no_linear_plan(name: str, method: Method, directions: int) -> None:
    assert _linear(named_task(name), method, directions).status is Status.UNSOLVABLE


def test_two_bays_need_the_first_reading(monkeypatch: pytest.MonkeyPatch) -> None:
    task = named_task("two-bays")
    strategy = plan(task)
    assert len(strategy.start) == 2
    assert _most(strategy) == 1
    start = start_region(task, strategy.space)
    assert not any(covered(start, one.region, strategy.space) for one in strategy.regions)

    def whole(self: Branching[Known], regions: Sequence[Known]) -> tuple[Known, ...]:
        found = [one for one in regions if covered(start, one.region, self.setting.space)]
        return tuple(found[:1])

    monkeypatch.setattr(Branching, "further", whole)
    assert plan(task).status is Status.UNSOLVABLE


def test_between_posts_the_first_motion_tells() -> None:
    strategy = plan(named_task("between-posts"))
    assert len(strategy.start) == 1
    assert _most(strategy) == 2
    first = strategy.region(strategy.start[0])
    assert first.motion is not None
    assert len(first.motion.goals) == 2


@pytest.mark.parametrize(("method", "linear"), [(Method.KERNEL, 3), (Method.COMBINED, 2)])
def test_anywhere_in_the_l_room(method: Method, linear: int) -> None:
    task = named_task("l-room-anywhere")
    task = replace(task, options=replace(task.options, method=method))
    assert _most(plan(task)) == 2
    assert len(_linear(task, method, 4).steps) == linear


def test_in_the_hall_three_motions_are_too_few_without_choosing() -> None:
    task = named_task("conditional-hall")
    assert _most(plan(task)) == 3
    linear = replace(task, options=replace(task.options, strategy=StrategyKind.LINEAR))
    assert plan(linear).status is not Status.SOLVED


@pytest.mark.parametrize(
    "name", ["point-onto-hill", "two-bays", "between-posts", "l-room-anywhere", "blind-cradle"]
)
def test_proven_and_never_failing(name: str) -> None:
    strategy = plan(named_task(name))
    assert strategy.status is Status.SOLVED
    assert not verify(strategy, runs=0).findings
    assert run(strategy, options=RunOptions(runs=2)).failure is None


def test_in_the_slot_or_known_to_be_in_a_pit() -> None:
    task = named_task("one-way-pit")
    for method in Method:
        options = replace(task.options, method=method, or_fail=False)
        assert plan(replace(task, options=options)).status is Status.UNSOLVABLE
    strategy = plan(task)
    assert strategy.status is Status.SOLVED
    assert len(strategy.failures) == 1
    assert not verify(strategy, runs=0).findings
