"""Strategies as graphs."""

from dataclasses import replace
from pathlib import Path

import pytest

import preimage
from preimage.errors import InputError
from preimage.rendering.graph import MOST_NODES, nodes
from preimage.rendering.picture import draw, figure
from preimage.search.planner import plan
from preimage.strategy.strategy import Strategy, StrategyRegion
from preimage.task.examples import named_task
from preimage.task.options import StrategyKind


def conditional() -> Strategy:
    task = named_task("peg-in-hole-point")
    return plan(replace(task, options=replace(task.options, strategy=StrategyKind.CONDITIONAL)))


def test_every_region_is_a_node_and_every_goal_an_arrow() -> None:
    strategy = conditional()
    made = figure(strategy, graph=True)
    ids = {artist.get_gid() for artist in made.findobj()}
    for region in strategy.regions:
        assert f"node-{region.id}" in ids
        for goal in region.motion.goals if region.motion else ():
            assert f"arrow-{region.id}-{goal}" in ids
    assert all(f"start-{number}" in ids for number in strategy.start)


def test_a_linear_plan_has_a_graph_too(tmp_path: Path) -> None:
    draw(preimage.plan(named_task("flat-floor")), tmp_path / "graph.svg", graph=True)
    assert "node-0" in (tmp_path / "graph.svg").read_text()


def test_of_many_regions_the_part_next_to_the_start_is_shown() -> None:
    strategy = conditional()
    first = strategy.region(strategy.start[0])
    more = tuple(
        StrategyRegion(10 + extra, 2, first.region, first.motion) for extra in range(MOST_NODES)
    )
    large = replace(strategy, regions=strategy.regions + more)
    assert {one.id for one in nodes(large)} == {one.id for one in strategy.regions}
    assert "regions shown" in str(figure(large, graph=True).get_label())


def test_a_flag_is_true_or_false() -> None:
    with pytest.raises(InputError):
        figure(named_task("flat-floor"), graph=1)
