"""Soundness: from a preimage every execution ends, recognised, in the goal (theory 8).

The one property that may never fail.
"""

import math
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.examples import named_task, named_tasks
from preimage.task.options import Method, SearchOrder, StrategyKind, Termination
from preimage.task.task import SlidingLaw
from preimage.task.uncertainty import Uncertainty
from tests.laws.adversaries import CONTROLS
from tests.laws.passage import resolved, starts
from tests.laws.simulation import Execution, carry_out
from tests.laws.tasks import random_setting, random_task
from tests.strategies import Scene, random_scene

STARTS = 5


def carry_out_from_everywhere(
    setting: Setting, scene: Scene, rng: Random, methods: tuple[Method, ...] = tuple(Method)
) -> int:
    """Every method's preimage of a scene's target, from some starts, under every control."""
    count = 0
    for method in methods:
        made = preimage(setting, scene.target, scene.direction, method)
        if made.region.is_empty:
            continue
        execution = Execution.of(setting, made)
        if not resolved(execution.world, made.target.region):
            continue
        for start in starts(execution.world, made.region, rng, STARTS):
            for control in CONTROLS:
                execution.run(start, control, rng, rng.choice((0.0, 0.5)))
                count += 1
    return count


def blocks(first: int, count: int, size: int) -> list[range]:
    return [range(begin, begin + size) for begin in range(first, first + count * size, size)]


def check(seeds: range) -> None:
    total = 0
    for seed in seeds:
        rng = Random(seed)
        setting, scene = random_setting(rng)
        try:
            total += carry_out_from_everywhere(setting, scene, rng)
        except Exception as error:
            error.add_note(f"seed {seed}")
            raise
    assert total > 20 * len(seeds)  # few scenes have no preimage at all


@pytest.mark.parametrize("seeds", blocks(0, 6, 15), ids=str)
def test_random_scenes(seeds: range) -> None:
    check(seeds)


@pytest.mark.slow
@pytest.mark.parametrize("seeds", blocks(10_000, 40, 25), ids=str)
def test_random_scenes_at_length(seeds: range) -> None:
    check(seeds)


@given(st.randoms(use_true_random=False))
@settings(max_examples=20)
def test_drawn_scenes(rng: Random) -> None:
    setting, scene = random_setting(rng)
    carry_out_from_everywhere(setting, scene, Random(0))


EXACT = (0.0, 0.0)
NUMB = (math.inf, math.inf)
DEGENERATE = {
    "all exact, no friction": (0.0, 0.0, Uncertainty(0.0, 0.0, 0.0, EXACT)),
    "all exact, friction": (0.0, math.radians(45), Uncertainty(0.0, 0.0, 0.0, EXACT)),
    "exact control and force": (0.0, math.radians(45), Uncertainty(0.0, 0.5, 0.0, EXACT)),
    "exact sensors": (math.radians(45), 0.0, Uncertainty(0.0, 0.0, 0.0, EXACT)),
    "theta is phi": (math.radians(45), math.radians(45), Uncertainty(0.0, 0.25, 0.0, (0.5, 0.5))),
    "everything sticks": (math.radians(20), 0.5 * math.pi, Uncertainty(0.0, 0.5, 0.1, (0.1, 0.1))),
    "no position": (math.radians(5), math.radians(20), Uncertainty(0.0, math.inf, 0.1, EXACT)),
    "no force": (math.radians(5), math.radians(20), Uncertainty(0.0, 0.5, 0.0, NUMB)),
    "blind": (math.radians(5), math.radians(60), Uncertainty(0.0, math.inf, 0.0, NUMB)),
    "any direction is read": (0.1, 0.1, Uncertainty(0.0, 0.5, math.radians(179.9), (0.1, 0.1))),
    "all reads 0": (0.1, 0.5, Uncertainty(0.0, 0.5, 0.0, (1.0, 1.0))),
    "0 or not": (0.1, 0.5, Uncertainty(0.0, 0.5, 0.1, (0.0, 1.0))),
    "nearly backwards": (math.radians(89.9), math.radians(89), Uncertainty(0.0, 1.0, 0.1, EXACT)),
}


@pytest.mark.parametrize("name", DEGENERATE)
def test_degenerate_bounds_on_lattices(name: str) -> None:
    """Axis-aligned directions, lattice scenes, and bounds at their ends, met with ties."""
    control, friction, senses = DEGENERATE[name]
    total = 0
    for seed in range(8):
        rng = Random(seed)
        scene = random_scene(rng)
        direction = math.radians(90 * (seed % 4))
        law = rng.choice(list(SlidingLaw))
        setting = Setting(scene.space, replace(senses, control=control), friction, law, 0.005)
        total += carry_out_from_everywhere(setting, scene._replace(direction=direction), rng)
    assert total


# --- whole plans --------------------------------------------------------------------------


def check_plans(seeds: range) -> int:
    solved = 0
    for seed in seeds:
        found = plan(random_task(Random(seed)))
        if found.status is not Status.SOLVED or not found.steps:
            continue
        solved += 1
        for count, control in enumerate(CONTROLS):
            try:
                carry_out(found, control, Random(100 * seed + count))
            except Exception as error:
                error.add_note(f"seed {seed}, {control}")
                raise
    return solved


@pytest.mark.parametrize("seeds", blocks(0, 3, 20), ids=str)
def test_plans_of_random_tasks(seeds: range) -> None:
    assert check_plans(seeds) > 2


@pytest.mark.slow
@pytest.mark.parametrize("seeds", blocks(20_000, 20, 40), ids=str)
def test_plans_of_random_tasks_at_length(seeds: range) -> None:
    assert check_plans(seeds) > 5


OPTIONS = {name: named_task(name).options for name in named_tasks()}
LINEAR = [
    name
    for name, options in OPTIONS.items()
    if options.strategy is StrategyKind.LINEAR
    and options.termination is Termination.INSTANTANEOUS
    and not options.or_fail
]
NAMED = [*LINEAR, "comb-2", "comb-5", "saw-tooth-4", "hall-6"]


def check_named(name: str, methods: tuple[Method, ...], runs: int) -> None:
    task = named_task(name)
    rng = Random(name)
    for method in methods:
        options = replace(task.options, method=method, search=SearchOrder.BREADTH_FIRST)
        found = plan(replace(task, options=options))
        if found.status is not Status.SOLVED:
            continue
        for count in range(runs):
            for control in CONTROLS:
                carry_out(found, control, Random(count))
        setting = Setting.of(task, found.space)
        for step in found.steps:
            motion = found.region(step).motion
            assert motion is not None
            goal = found.region(motion.goals[0]).region
            made = preimage(setting, goal, motion.direction, method)
            execution = Execution.of(setting, made)
            for start in starts(execution.world, made.region, rng, 3 * runs):
                for control in CONTROLS:
                    execution.run(start, control, rng)


@pytest.mark.parametrize("name", NAMED)
def test_named_tasks(name: str) -> None:
    check_named(name, (named_task(name).options.method,), 1)


@pytest.mark.slow
@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("name", NAMED)
def test_named_tasks_at_length(name: str, method: Method) -> None:
    check_named(name, (method,), 6)
