"""Strategies: a panel for each motion."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from preimage.rendering import figure
from preimage.rendering.strategy import in_order
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task import named_task
from tests.rendering.drawn import artists, measure, panels, strategy, task, words


@pytest.mark.parametrize("count", range(1, 9))
def test_there_is_a_panel_for_each_motion_in_order(count: int) -> None:
    made = figure(strategy(task(), count))
    assert panels(made) == [f"motion-{place + 1}" for place in range(count)]
    told = words(made)
    places = [told.index(f"Motion {place + 1} of {count}:") for place in range(count)]
    assert places == sorted(places)


def test_a_panel_shows_preimage_target_and_what_comes_next() -> None:
    solved = strategy(task(), 3)
    made = figure(solved)
    for place, region in enumerate(in_order(solved)):
        panel = artists(made, f"motion-{place + 1}")
        assert region.motion is not None
        area = region.region.area.measure
        assert measure(panel[f"preimage-{region.id}"]) == pytest.approx(area)
        assert measure(panel["target"]) == pytest.approx(region.motion.target.area.measure)
        assert {"goal", "goal-contact", "direction", "control-cone"} <= set(panel)
        assert (f"subgoal-{region.id - 1}" in panel) == (region.id > 1)
        assert ("start-point" in panel) == (place == 0)
    assert "stops when stuck" in words(made)
    assert "only $\\mathcal{G}$ fits what is read" in words(made)


def test_plans_of_the_planner_are_drawn() -> None:
    for name in ("peg-in-hole", "peg-in-hole-point"):
        solved = plan(named_task(name))
        made = figure(solved)
        assert len(made.axes) == len(solved.steps)
        assert f"{name}: solved in {len(solved.steps)} motions" in words(made)


@pytest.mark.parametrize(("status", "text"), [
    (Status.UNSOLVABLE, "no strategy for these directions and this method"),
    (Status.STOPPED, "stopped, the time limit of 1 s came first"),
])  # fmt: skip
def test_what_was_found_is_drawn_where_there_is_no_strategy(status: Status, text: str) -> None:
    made = figure(strategy(task(), 5, status))
    assert panels(made) == ["found"]
    panel = artists(made, "found")
    assert {f"found-{number}" for number in range(1, 6)} <= set(panel)
    assert {"found-contact", "goal", "start-point"} <= set(panel)
    assert "direction" not in panel
    assert text in words(made)
    assert "5 regions found" in words(made)


def test_of_very_many_regions_the_largest_are_drawn() -> None:
    made = figure(strategy(task(), 60, Status.STOPPED))
    areas = [name for name in artists(made, "found") if re.fullmatch(r"found-\d+", name)]
    assert len(areas) == 40
    assert "the 40 largest are shown" in words(made)


def test_nothing_found_and_nothing_to_do() -> None:
    assert "no motion is known" in words(figure(strategy(task(), 0, Status.UNSOLVABLE)))
    assert "the start lies in the goal" in words(figure(strategy(task(), 0)))


def test_conditional_strategies_show_their_regions_by_rank() -> None:
    policy = strategy(task(), 3, linear=False)
    made = figure(policy)
    assert panels(made) == ["region-3", "region-2", "region-1"]
    assert "Region 3, rank 3" in words(made)
    assert "solved in 3 motions at most, with 3 regions" in words(made)


def test_long_strategies_are_cut() -> None:
    made = figure(strategy(task(), 5), max_panels=2)
    assert panels(made) == ["motion-1", "motion-2"]
    assert "2 of them shown" in words(made)


def test_motions_may_aim_at_several_regions() -> None:
    policy = strategy(task(), 6, linear=False)
    last = policy.regions[-1]
    assert last.motion is not None
    motion = replace(last.motion, goals=(0, 1, 2, 3, 4, 5))
    regions = (*policy.regions[:-1], replace(last, motion=motion))
    made = figure(replace(policy, regions=regions))
    assert {f"subgoal-{number}" for number in range(1, 6)} <= set(artists(made, "region-6"))
    assert "in one of 6 regions" in words(made)
