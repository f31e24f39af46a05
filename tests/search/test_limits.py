"""Limits and cancellation: what was found so far is kept, as `stopped` (theory 7, files.md)."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from preimage.search.limits import Limits, Progress
from preimage.search.planner import plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task
from preimage.task.options import SearchOrder
from preimage.task.task import InitialPoint, Task


def out_of_reach(order: SearchOrder = SearchOrder.BREADTH_FIRST) -> Task:
    """A comb whose start is far from the goal: many regions before it is covered."""
    task = named_task("comb-4")
    options = replace(task.options, search=order, max_steps=12)
    return replace(task, initial=InitialPoint((-9.5, 9.0)), options=options)


def after(count: int) -> Callable[[], bool]:
    asked = 0

    def cancelled() -> bool:
        nonlocal asked
        asked += 1
        return asked > count

    return cancelled


def assert_stopped(found: Strategy) -> None:
    assert found.status is Status.STOPPED
    assert found.reason
    assert found.steps == ()
    assert found.start == ()
    assert found.regions[0].rank == 0
    assert found.statistics.regions == len(found.regions)
    for region in found.regions[1:]:
        assert region.motion is not None
        assert found.region(region.motion.goals[0]).rank == region.rank - 1


@pytest.mark.parametrize("order", SearchOrder)
def test_a_limit_on_regions(order: SearchOrder) -> None:
    task = out_of_reach(order)
    for most in (1, 2, 3):
        found = plan(replace(task, options=replace(task.options, max_regions=most)))
        assert_stopped(found)
        assert len(found.regions) == most
        assert "regions" in found.reason


def test_a_limit_on_time() -> None:
    task = out_of_reach()
    found = plan(replace(task, options=replace(task.options, time_limit=1e-9)))
    assert_stopped(found)
    assert "time" in found.reason


@pytest.mark.parametrize("order", SearchOrder)
def test_cancellation_keeps_what_was_found(order: SearchOrder) -> None:
    task = out_of_reach(order)
    counts = []
    enough = 18 if order is SearchOrder.LED else 6  # the bounds ask, too
    for count in (0, 1, 3, enough):
        found = plan(task, cancelled=after(count))
        assert_stopped(found)
        assert "interrupted" in found.reason
        counts.append(len(found.regions))
    assert counts == sorted(counts)
    assert counts[0] == 1
    assert counts[-1] > 1


def test_a_limit_on_motions() -> None:
    """Where longer plans might exist, it is not called unsolvable."""
    task = named_task("peg-in-hole-point")
    whole = plan(task)
    assert len(whole.steps) == 2
    short = plan(replace(task, options=replace(task.options, max_steps=1)))
    assert_stopped(short)
    assert "motions" in short.reason
    enough = plan(replace(task, options=replace(task.options, max_steps=2)))
    assert enough.status is Status.SOLVED


def test_progress_is_told() -> None:
    heard: list[Progress] = []
    found = plan(out_of_reach(), progress=heard.append, cancelled=after(8))
    assert len(heard) == 8
    assert [one.regions for one in heard] == sorted(one.regions for one in heard)
    assert heard[-1].regions == len(found.regions)
    assert all(one.layer >= 1 for one in heard)
    assert heard[-1].seconds >= 0.0


def test_the_first_limit_that_is_reached_is_named() -> None:
    assert Limits(None, 5).exceeded(4) is None
    assert "5 regions" in (Limits(None, 5).exceeded(5) or "")
    assert "interrupted" in (Limits(0.0, 5, lambda: True).exceeded(5) or "")
    assert "time" in (Limits(0.0, 5).exceeded(5) or "")
