"""Preimages of random scenes, degenerate on purpose: each is proven, and none of them may grow."""

from __future__ import annotations

import math
from dataclasses import replace
from random import Random

import numpy as np
import pytest

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.strategy.strategy import Motion, Statistics, Status, Strategy, StrategyRegion
from preimage.task.examples import named_task
from preimage.task.options import Method, StrategyKind
from preimage.task.task import SlidingLaw
from preimage.task.uncertainty import Uncertainty
from preimage.verification.faults import faults
from preimage.verification.proof import case_of
from tests.strategies import random_scene


def plan_of(seed: int, method: Method) -> Strategy | None:
    """One motion in a random scene; None if there is no preimage."""
    rng = Random(seed)
    scene = random_scene(rng)
    low = rng.choice((0.0, 0.05, math.inf))
    errors = Uncertainty(
        scene.control,
        rng.choice((0.0, 0.05, 0.2, 0.5, math.inf)),
        math.radians(rng.choice((0, 5, 10))),
        (low, max(low, rng.choice((0.05, 0.3)))),
    )
    law = rng.choice(list(SlidingLaw))
    task = replace(
        named_task("flat-floor"), uncertainty=errors, friction=scene.friction, sliding=law
    )
    made = preimage(Setting.of(task, scene.space), scene.target, scene.direction, method)
    if made.region.is_empty or not made.termination:
        return None
    motion = Motion(scene.direction, (0,), made.target.region, made.termination)
    goal = StrategyRegion(0, 0, scene.target, None)
    start = StrategyRegion(1, 1, made.region, motion)
    return Strategy(
        task=task,
        space=scene.space,
        status=Status.SOLVED,
        kind=StrategyKind.LINEAR,
        regions=(goal, start),
        start=(1,),
        steps=(1,),
        statistics=Statistics(),
    )


THIN = 1e-6


def check(seed: int) -> None:
    for method in Method:
        strategy = plan_of(seed, method)
        if strategy is None:
            continue
        made = strategy.region(1).region
        if made.area.measure < THIN and made.contact.total_length < THIN:
            continue  # as thin as rounding: nothing can be proven of it
        case = case_of(strategy, strategy.region(1))
        assert [one.words for one in faults(case)] == []
        assert case.uncertain == ()
        more = enlarged(strategy)
        if more is not None:
            assert list(faults(case_of(more, more.region(1))))


def enlarged(strategy: Strategy) -> Strategy | None:
    """The plan with a stretch of an edge in its region that is not in the backprojection."""
    space, one = strategy.space, strategy.region(1)
    rest = contact_set.complement(one.region.contact, space.contact, space.tolerance.length)
    if not len(rest.edge) or np.max(rest.high - rest.low) < 1e-3:
        return None
    longest = int(np.argmax(rest.high - rest.low))
    middle = 0.5 * (rest.low[longest] + rest.high[longest])
    stretch = ContactSet.of(
        [int(rest.edge[longest])], [middle - 1e-4], [middle + 1e-4], [], space.tolerance.length
    )
    contact = contact_set.union(one.region.contact, stretch, space.tolerance.length)
    wrong = replace(one, region=Region(one.region.area, contact))
    return replace(strategy, regions=(strategy.region(0), wrong))


@pytest.mark.parametrize("seed", range(50))
def test_is_proven_and_may_not_grow(seed: int) -> None:
    check(seed)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(50, 1000))
def test_is_proven_and_may_not_grow_in_many_scenes(seed: int) -> None:
    check(seed)
