"""Maximality: from outside a backprojection some admissible control avoids the target (theory 8).

Nature's cone and friction are wider by a hair than the sweep's, since ties are hers.
"""

import math
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.reachability.backprojection import backproject
from preimage.reachability.sources import sources
from tests.laws.avoidance import around, avoiding_motion
from tests.laws.passage import starts
from tests.laws.world import AtVertex, Free, World
from tests.strategies import Scene, random_scene

MARGIN = 1e-3
HAIR = 1e-6
STARTS = 6


def touches(world: World, vertex: AtVertex, target: Region) -> bool:
    """Whether a target's area meets a vertex: what leaves it may be in the area, by rounding."""
    return world.is_in(Region(target.area, ContactSet.empty()), Free(*world.place(vertex)), HAIR)


def check(scene: Scene, rng: Random) -> int:
    space, target, direction, control, friction = scene
    command = sources(space.contact, direction, control, friction, space.tolerance)
    claimed = backproject(space, target, command).region
    world = World(space, friction + HAIR)
    outside = [
        start
        for start in starts(world, space.valid, rng, 4 * STARTS)
        if not world.escaped(start)
        and not world.is_in(target, start)
        and not any(world.is_in(claimed, other) for other in around(world, start, MARGIN))
        and not (isinstance(start, AtVertex) and touches(world, start, target))
    ]
    for start in outside[:STARTS]:
        found = avoiding_motion(world, start, target, claimed, direction, control + HAIR, rng)
        degrees = [round(math.degrees(angle), 3) for angle in scene[2:]]
        assert found is not None, (start, degrees)
    return min(len(outside), STARTS)


@pytest.mark.parametrize("first", range(0, 150, 50))
def test_random_scenes(first: int) -> None:
    count = 0
    for seed in range(first, first + 50):
        rng = Random(seed)
        scene = random_scene(rng)
        try:
            count += check(scene, rng)
        except AssertionError as error:
            error.add_note(f"seed {seed}")
            raise
    assert count > 200


@pytest.mark.slow
@pytest.mark.parametrize("first", range(30_000, 32_000, 100))
def test_random_scenes_at_length(first: int) -> None:
    for seed in range(first, first + 100):
        rng = Random(seed)
        check(random_scene(rng), rng)


@given(st.randoms(use_true_random=False))
@settings(max_examples=30)
def test_drawn_scenes(rng: Random) -> None:
    check(random_scene(rng), Random(0))
