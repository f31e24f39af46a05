"""The layers of bounds against every sequence of directions on small tasks."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, covered, start_region
from preimage.preimages.setting import Setting
from preimage.search.bounds import Bounds, Sensing
from preimage.search.limits import Limits
from preimage.task.examples import named_task
from preimage.task.options import Method, uniform_directions
from preimage.task.task import Task
from tests.laws.similarity import within
from tests.laws.tasks import random_task
from tests.search.brute_force import chains

SLACK = 1e-6
STEPS = 3
FOUR = uniform_directions(4)


def bounds_of(task: Task, sensing: Sensing, method: Method, limits: Limits | None = None) -> Bounds:
    setting = Setting.of(task)
    return Bounds(setting, goal_region(task, setting.space), FOUR, method, sensing, limits)


def at(bounds: Bounds, motions: int, direction: float) -> Region:
    region = bounds.region(motions, direction)
    assert region is not None
    return region


def check_chains(seed: int, steps: int = STEPS) -> int:
    """All sequences' preimages lie in the layers, which grow, the tighter in the wider."""
    method = list(Method)[seed % 3]
    task = random_task(Random(seed))
    wide, tight = (bounds_of(task, sensing, method) for sensing in Sensing)
    count = 0
    for chain in chains(wide.setting, wide.goal, FOUR, method, steps):
        count += 1
        motions, first = len(chain.directions), chain.directions[0]
        for bounds in (tight, wide):
            assert within(chain.region, at(bounds, motions, first), SLACK), (seed, chain.directions)
    for motions in range(1, steps + 1):
        for direction in FOUR:
            here = at(tight, motions, direction)
            assert within(here, at(wide, motions, direction), SLACK), (seed, motions)
            for bounds in (tight, wide):
                region, more = at(bounds, motions, direction), at(bounds, motions + 1, direction)
                assert within(region, more, SLACK), (seed, motions)
    return count


def test_all_sequences_stay_inside() -> None:
    assert sum(check_chains(seed, 2) for seed in range(300, 309)) > 50


@pytest.mark.slow
@pytest.mark.parametrize("first", range(81_000, 81_400, 50))
def test_all_sequences_stay_inside_at_length(first: int) -> None:
    for seed in range(first, first + 50):
        check_chains(seed)


@pytest.mark.parametrize("method", Method)
def test_layers_settle_and_stay(method: Method) -> None:
    """After the layer that adds nothing no more are made, and what it says holds for all."""
    bounds = bounds_of(named_task("l-room"), Sensing.PERFECT, method)
    late = [at(bounds, 100, direction) for direction in FOUR]
    assert bounds.settled
    assert len(bounds.layers) < 20
    made = bounds.made
    assert [at(bounds, 10**9, direction) for direction in FOUR] == late
    assert bounds.made == made
    whole = Bounds(bounds.setting, bounds.goal, FOUR, method)
    for _ in range(len(bounds.layers) + 2):
        whole._extend()  # one more, though it is settled, adds nothing either
    for direction, region in zip(FOUR, late, strict=True):
        assert within(whole.layers[-1][direction], region, SLACK)


def test_the_first_layer_of_the_sticking_method_is_exact() -> None:
    bounds = bounds_of(named_task("l-room"), Sensing.PERFECT, Method.STICKING)
    for chain in chains(bounds.setting, bounds.goal, FOUR, Method.STICKING, 1):
        region = at(bounds, 1, chain.directions[0])
        assert within(region, chain.region, 0.0)
        assert within(chain.region, region, 0.0)


def test_the_fewest_motions() -> None:
    """No sequence is shorter; and none of any length is there where the layers settle."""
    settled = found = 0
    for seed in range(340, 365):
        method = list(Method)[seed % 3]
        task = random_task(Random(seed))
        bounds = bounds_of(task, Sensing.PERFECT, method)
        space = bounds.setting.space
        start = start_region(task, space)
        if covered(start, bounds.goal, space):
            continue
        fewest = bounds.fewest(start, 2)
        settled += fewest is None and bounds.settled
        for chain in chains(bounds.setting, bounds.goal, FOUR, method, 2):
            if covered(start, chain.region, space):
                assert fewest is not None, seed
                assert len(chain.directions) >= fewest, seed
                assert chain.directions[0] in bounds.first_motions(start, len(chain.directions))
                found += 1
    assert settled > 3
    assert found > 3


def test_more_motions_than_asked_for() -> None:
    """None, yet not settled: there may be a longer one."""
    task = named_task("example-1")
    bounds = bounds_of(task, Sensing.PERFECT, Method.STICKING)
    start = start_region(task, bounds.setting.space)
    assert bounds.fewest(start, 2) is None
    assert not bounds.settled
    assert bounds.fewest(start, 8) == 5


def test_a_goal_that_no_motion_attains() -> None:
    task = named_task("flat-floor")
    bounds = bounds_of(replace(task, friction=0.0), Sensing.PERFECT, Method.STICKING)
    start = Start.anywhere_in(bounds.setting.space.valid)
    assert bounds.fewest(start, 8) is None
    assert bounds.settled
    assert all(region.is_empty for region in bounds.layers[-1].values())


def test_limits_stop_the_layers() -> None:
    task = named_task("peg-in-hole-point")
    for stop, word in ((Limits(0.0, 10), "time"), (Limits(None, 10, lambda: True), "interrupted")):
        bounds = bounds_of(task, Sensing.PERFECT, Method.KERNEL, stop)
        start = start_region(task, bounds.setting.space)
        assert bounds.fewest(start, 8) is None
        assert bounds.region(1, FOUR[0]) is None
        assert bounds.first_motions(start, 3) == ()
        assert word in (bounds.stopped or "")
        assert not bounds.settled
        assert bounds.made == 0
