"""The reference against motions carried out one by one (theory 8: soundness, maximality of B)."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest

from preimage.verification.reference import ReferenceBackprojection, reference_backprojection
from tests.strategies import random_scene
from tests.verification.adversary import (
    AtVertex,
    Free,
    OnEdge,
    Outcome,
    State,
    World,
    carry_out,
    escape_route,
    neighbours,
    some_states,
    tempting_angles,
)

MARGIN = 1e-5
"""How far within B or its complement a state must be for the oracle to have a say."""

SEEDS = [range(first, first + 20) for first in range(0, 200, 20)]


def holds(found: ReferenceBackprojection, state: State) -> bool:
    match state:
        case Free(x, y):
            return found.holds_free(x, y)
        case OnEdge(edge, distance):
            return found.holds_edge(edge, distance)
        case AtVertex(vertex):
            return found.holds_vertex(vertex)


def holds_around(found: ReferenceBackprojection, world: World, state: State) -> set[bool]:
    around = neighbours(world, found.space, state, MARGIN)
    return {holds(found, other) for other in around}


def wavering(angles: list[float], rng: Random) -> Callable[[State], tuple[float, float]]:
    return lambda _: (rng.choice(angles), rng.choice((0.2, 1.0, 30.0)))


def tempted(
    world: World, direction: float, control: float, rng: Random
) -> Callable[[State], list[float]]:
    return lambda state: tempting_angles(world, state, direction, control, rng)


def outside(found: ReferenceBackprojection) -> Callable[[State], bool]:
    return lambda state: not holds(found, state)


@pytest.mark.parametrize("seeds", SEEDS, ids=lambda seeds: f"{seeds.start}-")
def test_no_admissible_move_leaves_b_but_into_the_target(seeds: range) -> None:
    """B is closed under all that nature can do until T is met, and holds no place to stay in."""
    for seed in seeds:
        rng = Random(seed)
        scene = random_scene(rng)
        found = reference_backprojection(*scene)
        world = World(scene.space, scene.target, scene.friction)
        control = scene.control * (1.0 - 1e-6)  # the cone is open
        for state in some_states(world, scene.space, rng, 30):
            if world.settled(state) is Outcome.MET or holds_around(found, world, state) != {True}:
                continue
            for angle in tempting_angles(world, state, scene.direction, control, rng):
                for reach in (0.3, 2.0, 30.0):
                    for after in world.moves(state, angle, reach):
                        over = after if isinstance(after, Outcome) else world.settled(after)
                        if over is Outcome.MET:
                            continue
                        assert not isinstance(after, Outcome), (seed, state, angle, after)
                        assert over is None, (seed, state, angle, after)
                        assert True in holds_around(found, world, after), (seed, state, after)


@pytest.mark.parametrize("seeds", SEEDS, ids=lambda seeds: f"{seeds.start}-")
def test_motions_from_b_end_in_the_target(seeds: range) -> None:
    """Constant extremes, switching between them, drifting, random: all from theory 8's list."""
    for seed in seeds:
        rng = Random(seed)
        scene = random_scene(rng)
        found = reference_backprojection(*scene)
        world = World(scene.space, scene.target, scene.friction)
        control = scene.control * (1.0 - 1e-6)
        spreads = ((-1.0,), (0.0,), (1.0,), (-1.0, 1.0), (-1.0, 0.9), (-1.0, -0.3, 0.2, 0.7, 1.0))
        for state in some_states(world, scene.space, rng, 20):
            if holds_around(found, world, state) != {True}:
                continue
            for spread in spreads:
                angles = [scene.direction + part * control for part in spread]
                outcome, trace = carry_out(world, state, wavering(angles, rng), rng)
                assert outcome is Outcome.MET, (seed, outcome, trace)


@pytest.mark.parametrize("seeds", SEEDS, ids=lambda seeds: f"{seeds.start}-")
def test_outside_b_nature_can_avoid_the_target(seeds: range) -> None:
    """From outside B, by a margin, there is a motion that avoids T and stays away or escapes.

    Nature gets a cone and friction that are wider by a hair, since ties are hers in the reference;
    where `theta = 0` that hair is all she has, and passing a corner can take more.
    """
    for seed in seeds:
        rng = Random(seed)
        scene = random_scene(rng)
        if scene.control == 0.0:
            continue
        found = reference_backprojection(*scene)
        world = World(scene.space, scene.target, scene.friction + 1e-6)
        states = some_states(world, scene.space, rng, 18)
        for start in rng.sample(states, min(8, len(states))):
            over = world.settled(start)
            if over is Outcome.MET or holds_around(found, world, start) != {False}:
                continue
            route = escape_route(
                world,
                start,
                tempted(world, scene.direction, scene.control + 1e-4, rng),
                outside(found),
                rng,
            )
            assert route is not None, (seed, start)
