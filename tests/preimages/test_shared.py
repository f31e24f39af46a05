"""Several goals at once: what is shared out is told, and no more goes than has to."""

from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration import contact_set
from preimage.configuration import region as regions
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry.area import Area
from preimage.preimages.methods import aim
from preimage.preimages.setting import Setting
from preimage.preimages.shared import Shares, resting, share_out, told_part
from preimage.preimages.sticking import sticking_features
from preimage.recognition.kernel import kernel
from preimage.task.options import Method
from tests.laws.tasks import random_setting
from tests.strategies import Scene, random_target

seeds = st.integers(0, 2**32 - 1)
methods = st.sampled_from(list(Method))
FEW = 25


def goals_of(rng: Random, scene: Scene, many: int) -> list[Region]:
    """Goals as they come: apart, overlapping, one in another, twice the same."""
    goals = [scene.target]
    tolerance = scene.space.tolerance
    for _ in range(many - 1):
        other = random_target(rng, scene.space, scene.direction, rng.random() < 0.5)
        kind = rng.choice(("any", "any", "same", "within", "around"))
        if kind == "same":
            other = rng.choice(goals)
        elif kind == "within":
            other = regions.intersection(other, rng.choice(goals), tolerance)
        elif kind == "around":
            other = regions.union(other, rng.choice(goals), tolerance)
        goals.append(other)
    return goals


def shared(
    seed: int, many: int, method: Method
) -> tuple[Setting, Scene, list[Region], list[Region], Shares]:
    rng = Random(seed)
    setting, scene = random_setting(rng)
    goals = goals_of(rng, scene, many)
    command = setting.command(scene.direction)
    told = [told_part(setting, goal, command, method) for goal in goals]
    return setting, scene, goals, told, share_out(setting, goals, told, command, method)


def told_by_kernels(
    setting: Setting, goals: list[Region], pool: ContactSet, direction: float
) -> ContactSet:
    """`U_i kernel(T_i; v, pool)` by the definition of the kernel in a domain."""
    found = ContactSet.empty()
    domain = Region(Area.empty(), pool)
    for goal in goals:
        part = kernel(
            setting.space, setting.command(direction).readings, goal, setting.uncertainty, domain,
            arc_tolerance=setting.arc_tolerance,
        )  # fmt: skip
        own = contact_set.intersection(part.contact, pool, setting.space.tolerance.length)
        found = contact_set.union(found, own, setting.space.tolerance.length)
    return found


@given(seeds, st.integers(2, 4), st.sampled_from((Method.STICKING, Method.COMBINED)))
@settings(max_examples=FEW, deadline=None)
def test_all_that_rests_tells_some_goal(seed: int, many: int, method: Method) -> None:
    setting, scene, goals, _, shares = shared(seed, many, method)
    near = setting.space.tolerance.length
    pool = shares.target.sticking.contact
    command = setting.command(scene.direction)
    sticks = ContactSet.empty()
    for goal in goals:
        sticks = contact_set.union(sticks, sticking_features(goal, command).contact, near)
    assert contact_set.is_subset(pool, sticks, near)
    assert contact_set.is_subset(
        pool, told_by_kernels(setting, goals, pool, scene.direction), 2 * near
    )


@given(seeds, st.integers(2, 4))
@settings(max_examples=FEW, deadline=None)
def test_nothing_goes_that_confuses_nothing(seed: int, many: int) -> None:
    setting, scene, goals, _, shares = shared(seed, many, Method.STICKING)
    near = setting.space.tolerance.length
    pool = shares.target.sticking.contact
    command = setting.command(scene.direction)
    for place, goal in enumerate(goals):
        own = sticking_features(goal, command).contact
        gone = contact_set.difference(own, pool, near)
        assert (place in shares.dropped) == (not contact_set.is_subset(own, pool, near))
        for edge, low, high in zip(gone.edge, gone.low, gone.high, strict=True):
            if high - low <= 20 * near:
                continue
            piece = ContactSet(
                np.array([edge]), np.array([low]), np.array([high]), np.empty(0, np.int32)
            )
            more = contact_set.union(pool, piece, near)
            told = told_by_kernels(setting, goals, more, scene.direction)
            assert not contact_set.is_subset(more, told, near)


@given(seeds, methods)
@settings(max_examples=FEW, deadline=None)
def test_one_goal_alone_is_aimed_at_as_ever(seed: int, method: Method) -> None:
    setting, scene, goals, _, shares = shared(seed, 1, method)
    alone = aim(setting, goals[0], scene.direction, method)
    tolerance = setting.space.tolerance
    for one, other in (
        (shares.target.region, alone.region),
        (shares.target.sticking, alone.sticking),
        (shares.target.kernel, alone.kernel),
    ):
        assert regions.is_subset(one, other, tolerance)
        assert regions.is_subset(other, one, tolerance)
    assert shares.dropped == ()


@given(seeds, st.integers(2, 3), methods)
@settings(max_examples=FEW, deadline=None)
def test_targets_lie_in_the_goals_and_hold_every_kernel_but_what_had_to_go(
    seed: int, many: int, method: Method
) -> None:
    setting, _, goals, told, shares = shared(seed, many, method)
    tolerance = setting.space.tolerance
    every = Region.empty()
    for goal, before, after in zip(goals, told, shares.told, strict=True):
        every = regions.union(every, goal, tolerance)
        assert regions.is_subset(after, before, tolerance)
        assert regions.is_subset(after, shares.target.region, tolerance)
        if method is Method.KERNEL:
            assert regions.is_subset(before, after, tolerance)
    assert regions.is_subset(shares.target.region, every, tolerance)


@given(seeds, st.integers(2, 4))
@settings(max_examples=FEW, deadline=None)
def test_what_was_kept_stays_when_goals_are_added(seed: int, many: int) -> None:
    rng = Random(seed)
    setting, scene = random_setting(rng)
    goals = goals_of(rng, scene, many)
    command, near = setting.command(scene.direction), setting.space.tolerance.length
    kept = sticks = ContactSet.empty()
    for count in range(1, many + 1):
        own = sticking_features(goals[count - 1], command).contact
        sticks = contact_set.union(sticks, own, near)
        pool = resting(setting, goals[:count], sticks, command, kept)
        assert contact_set.is_subset(kept, pool, near)
        told = told_by_kernels(setting, goals[:count], pool, scene.direction)
        assert contact_set.is_subset(pool, told, 2 * near)
        kept = pool


@given(seeds, methods)
@settings(max_examples=FEW, deadline=None)
def test_a_goal_twice_is_as_good_as_once(seed: int, method: Method) -> None:
    setting, scene, goals, told, once = shared(seed, 1, method)
    twice = share_out(setting, goals * 2, told * 2, setting.command(scene.direction), method)
    tolerance = setting.space.tolerance
    assert regions.is_subset(once.target.region, twice.target.region, tolerance)
    assert regions.is_subset(twice.target.region, once.target.region, tolerance)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 600, 200))
def test_all_that_rests_tells_some_goal_in_many_scenes(first: int) -> None:
    several = 0
    for seed in range(first, first + 200):
        setting, scene, goals, _, shares = shared(seed, 3, Method.STICKING)
        pool, near = shares.target.sticking.contact, setting.space.tolerance.length
        told = told_by_kernels(setting, goals, pool, scene.direction)
        assert contact_set.is_subset(pool, told, 2 * near), seed
        several += not pool.is_empty and bool(shares.dropped)
    assert several
