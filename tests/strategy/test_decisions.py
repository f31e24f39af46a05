"""Lists of decisions: short, and true of every reading that they speak of."""

import math
import random
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from preimage.preimages.setting import Setting
from preimage.recognition.outside import contact_segments, outside
from preimage.search.planner import plan
from preimage.strategy.decisions import cases, decision_list
from preimage.strategy.describe import describe
from preimage.strategy.strategy import Status, Strategy, StrategyRegion
from preimage.task.examples import named_task
from preimage.task.options import StrategyKind
from preimage.task.parse import parse_task


@cache
def conditional(name: str) -> Strategy:
    """The conditional plan of a named task."""
    task = named_task(name)
    return plan(replace(task, options=replace(task.options, strategy=StrategyKind.CONDITIONAL)))


@cache
def onto_hill(position: float) -> Strategy:
    """A point above a hill (paper 8, Figure 20), with errors."""
    return plan(
        parse_task(
            {
                "version": 1,
                "window": [-8, -6, 8, 6],
                "obstacles": [{"chain": [[-7, -6], [-1, 0], [1, 0], [7, -6]], "solid": "right"}],
                "uncertainty": {
                    "control": 5,
                    "position": position,
                    "force": {"angle": 5, "threshold": 0},
                },
                "friction": 5,
                "initial": {"polygon": [[-3, 2], [3, 2], [3, 4], [-3, 4]]},
                "goal": {"edges": [[[-1, 0], [1, 0]]]},
                "planner": {"directions": 8, "method": "combined", "strategy": "conditional"},
            },
            name="hill",
        )
    )


def test_a_plan_of_two_motions_begins_goes_on_and_ends() -> None:
    strategy = conditional("peg-in-hole-point")
    assert strategy.status is Status.SOLVED
    lines = decision_list(strategy).splitlines()
    assert lines[0] == f"begin with {strategy.start[0]}"
    assert lines[-1] == "   then in the goal, done"
    moves = [line for line in lines if re.match(r"\d+: move ", line)]
    assert len(moves) == len(strategy.regions) - 1
    assert decision_list(strategy) in describe(strategy)


def test_every_region_of_the_start_is_named_in_the_order_of_the_executor() -> None:
    strategy = onto_hill(0.3)
    assert strategy.status is Status.SOLVED
    lines = decision_list(strategy).splitlines()[: len(strategy.start)]
    order = sorted(strategy.start, key=lambda number: (strategy.region(number).rank, number))
    assert [int(line.split("begin with ")[1]) for line in lines] == order


def test_failure_is_known() -> None:
    strategy = conditional("peg-in-hole-point")
    failing = tuple(
        StrategyRegion(9, 0, one.region, None, failure=True) if one.id == 1 else one
        for one in strategy.regions
    )
    moved = tuple(
        one
        if one.motion is None
        else replace(
            one,
            motion=replace(
                one.motion, goals=tuple(9 if goal == 1 else goal for goal in one.motion.goals)
            ),
        )
        for one in failing
    )
    words = decision_list(replace(strategy, regions=moved))
    assert "it has failed, and knows it" in words


@pytest.mark.parametrize("name", ["peg-in-hole-point", "hill"])
def test_what_a_clause_says_of_the_position_tells_the_goal(name: str) -> None:
    """Readings drawn at random: one that a clause admits fits no place outside the goal."""
    strategy = onto_hill(0.3) if name == "hill" else conditional(name)
    rng = random.Random(1)
    space, rho = strategy.space, strategy.task.uncertainty.position
    setting = Setting.of(strategy.task)
    xmin, ymin, xmax, ymax = space.window
    looked = 0
    for region in strategy.regions:
        if region.motion is None:
            continue
        sets = setting.command(region.motion.direction).readings
        for case in cases(strategy, region.motion):
            rest = outside(space, strategy.region(case.goal).region)
            for clause in case.clauses:
                if clause.rest or "part" in clause.position:
                    continue
                for _ in range(300):
                    q = rng.uniform(xmin, xmax), rng.uniform(ymin, ymax)
                    if not _admits(clause.position, q):
                        continue
                    for force in _some_forces(clause.forces, rng):
                        can = sets.can_read(force)
                        n = sets.size
                        on = can[rest.contact.edge]
                        segments = contact_segments(space.contact, rest.contact)
                        ends = np.concatenate((on, can[n + rest.contact.vertices]))
                        far = _distances(segments.starts[ends], segments.ends[ends], q)
                        assert np.all(far >= rho - space.tolerance.length)
                        if can[sets.free] and not rest.area.is_empty:
                            assert rest.area.depth(*q) <= -rho + space.tolerance.length
                        looked += 1
    assert looked > 100


def _admits(position: str, q: tuple[float, float]) -> bool:
    if not position:
        return True
    if match := re.match(r"([xy]) (over|under) (.+)", position):
        value = q["xy".index(match[1])]
        return value > float(match[3]) if match[2] == "over" else value < float(match[3])
    match = re.match(r"within x (.+) to (.+), y (.+) to (.+)", position)
    if match is None:
        return False
    a, b, c, d = map(float, match.groups())
    return a <= q[0] <= b and c <= q[1] <= d


def _some_forces(words: tuple[str, ...], rng: random.Random) -> list[float | None]:
    found: list[float | None] = []
    for word in words:
        if word == "none":
            found.append(None)
            continue
        numbers = [float(one) for one in re.findall(r"-?[\d.]+(?=°)", word)]
        low, high = numbers[0], numbers[-1]
        high += 360.0 if high < low else 0.0
        share = 0.5 if low == high else rng.uniform(0.001, 0.999)
        found.append(math.radians(low + share * (high - low)))
    return found


def _distances(starts: np.ndarray, ends: np.ndarray, q: tuple[float, float]) -> np.ndarray:
    along = ends - starts
    length = np.maximum(np.sum(along**2, axis=1), 1e-300)
    share = np.clip(np.sum((np.array(q) - starts) * along, axis=1) / length, 0.0, 1.0)
    off = starts + share[:, None] * along - np.array(q)
    found: np.ndarray = np.sqrt(np.sum(off**2, axis=1))
    return found
