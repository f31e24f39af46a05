"""Carrying plans out: motions a second, with and without sensors."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from benchmarks.timing import Row, best
from preimage.configuration.space import ConfigurationSpace
from preimage.execution.chunk import Scene, carry_out_plan
from preimage.execution.control import CONTROLS
from preimage.execution.sensing import SENSINGS
from preimage.execution.simulator import Choices, Manner, Robots, Simulator, Wish, advance
from preimage.execution.starts import of_region
from preimage.search.planner import plan
from preimage.task.examples import named_task
from preimage.task.options import Method, SearchOrder

MOTIONS = 10_000

DOWN = -0.5 * np.pi


def simulated(space: ConfigurationSpace, robots: Robots, theta: float, friction: float) -> int:
    """Motions downwards, nature choosing anew at every contact, until all robots rest or leave."""
    rng = np.random.default_rng(0)
    simulator = Simulator.of(space, friction)
    moves = 0
    for _ in range(1_000):
        count = len(robots)
        if not count:
            break
        made = advance(
            simulator,
            robots,
            Choices(
                DOWN + theta * (2.0 * rng.random(count) - 1.0),
                np.full(count, np.inf),
                np.full(count, Wish.ANY, dtype=np.uint8),
                rng.random(count),
            ),
        )
        moves += count
        over = (made.manner == Manner.ESCAPES) | (made.manner == Manner.RESTS)
        robots = made.robots.part(~over)
    return moves


def motions() -> list[Row]:
    """So many motions in scenes of several sizes, and whole plans with all their readings."""
    rows: list[Row] = []
    for boxes in (3, 9, 36, 144):
        task = named_task(f"hall-{boxes}")
        strategy = plan(replace(task, options=replace(task.options, search=SearchOrder.BEST_FIRST)))
        space = strategy.space
        robots = of_region(space, space.valid, MOTIONS, np.random.default_rng(0))
        moves = simulated(space, robots, 0.2, 0.3)
        spent = best(partial(simulated, space, robots, 0.2, 0.3))
        rows.append(
            (
                f"{len(space.contact)} edges: {MOTIONS:,} motions of"
                f" {moves / MOTIONS:.1f} events each",
                spent,
                f"{MOTIONS / spent:,.0f} motions a second",
            )
        )
    for name in ("peg-in-hole", "example-3", "cluttered-hall"):
        task = named_task(name)
        strategy = plan(replace(task, options=replace(task.options, method=Method.COMBINED)))
        scene = Scene.of(strategy)
        first = strategy.region(strategy.steps[0]).region
        starts = of_region(strategy.space, first, MOTIONS, np.random.default_rng(0))
        for pair in (("left", "true"), ("mixed", "towards")):
            adversaries = (CONTROLS[pair[0]], SENSINGS[pair[1]])
            rng = np.random.default_rng(0)
            whole = partial(carry_out_plan, scene, pair, adversaries, starts, rng)
            done = int(whole().motions.sum())
            spent = best(whole)
            rows.append(
                (
                    f"{name}: {MOTIONS:,} runs with sensors, {pair[0]}+{pair[1]}",
                    spent,
                    f"{done / spent:,.0f} motions a second",
                )
            )
    return rows
