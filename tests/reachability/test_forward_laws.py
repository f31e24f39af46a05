"""Forward projections on random scenes: their laws, backprojections, a simulator, the slabs."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration import contact_set
from preimage.configuration import region as regions
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.mechanics.behaviour import Behaviour
from preimage.reachability.backprojection import backproject
from preimage.reachability.forward_projection import ForwardProjection, forward_project
from preimage.reachability.sources import Sources, sources
from preimage.verification.forward import forward_projection
from tests.laws.adversaries import CONTROLS as ADVERSARIES
from tests.laws.adversaries import Motion, pick
from tests.laws.passage import between, on_the_way, starts
from tests.laws.similarity import contact_gap, within
from tests.laws.world import Doing, Lost, State, World
from tests.strategies import CONTROLS, FRICTIONS, Scene, random_scene, random_target

NEAR = 1e-6
PINHEAD = 1e-4
MARGIN = 1e-3


def random_case(rng: Random) -> tuple[Scene, Region]:
    """A scene, whose target is the stop set, and a start."""
    scene = random_scene(rng)
    return scene, random_target(rng, scene.space, scene.direction, rng.random() < 0.5)


def generic(scene: Scene) -> Scene:
    """The same scene with bounds at which no edge lies along a side of a cone."""
    return scene._replace(
        direction=scene.direction + 3e-4,
        control=min(scene.control + 1.23e-3, 1.4),
        friction=scene.friction + 7.7e-4,
    )


def projected(scene: Scene, start: Region, stop: Region | None = None) -> ForwardProjection:
    """The forward projection in a scene."""
    return forward_project(scene.space, start, *scene[2:], stop)


cases = st.randoms(use_true_random=False).map(lambda rng: (*random_case(rng), rng))


# --- laws -------------------------------------------------------------------------------------


@given(cases)
@settings(max_examples=60)
def test_it_holds_the_start_and_grows_with_it(case: tuple[Scene, Region, Random]) -> None:
    scene, start, rng = case
    more = random_target(rng, scene.space, scene.direction, rng.random() < 0.5)
    both = regions.union(start, more, scene.space.tolerance)
    stop = scene.target if rng.random() < 0.5 else None
    small, large = projected(scene, start, stop), projected(scene, both, stop)
    assert within(start, small.region, NEAR)
    assert within(small.region, large.region, NEAR)
    assert set(small.open_sides.tolist()) <= set(large.open_sides.tolist())


@given(cases, st.sampled_from(CONTROLS), st.sampled_from(FRICTIONS))
@settings(max_examples=60)
def test_it_grows_with_control_and_falls_with_friction_and_stops(
    case: tuple[Scene, Region, Random], control: float, friction: float
) -> None:
    scene, start, _ = case
    held = scene._replace(
        control=min(scene.control, control), friction=max(scene.friction, friction)
    )
    loose = projected(scene, start)
    for less in (projected(held, start), projected(scene, start, scene.target)):
        assert within(less.region, loose.region, NEAR)


@given(cases)
@settings(max_examples=60)
def test_once_more_adds_nothing(case: tuple[Scene, Region, Random]) -> None:
    scene, start, _ = case
    scene = generic(scene)
    once = projected(scene, start).region
    twice = projected(scene, once).region
    assert within(once, twice, NEAR)
    assert within(twice, once, NEAR)


# --- backprojections --------------------------------------------------------------------------


def pinheads(scene: Scene, claimed: Region, rng: Random) -> list[tuple[Region, bool]]:
    """Small starts, and whether they lie in a backprojection: by a margin, or not at all."""
    space = scene.space
    contact, tolerance = space.contact, space.tolerance.length
    found: list[tuple[Region, bool]] = []
    for _ in range(6):
        x, y = rng.uniform(-6, 6), rng.uniform(-6, 6)
        near = shapely.box(x - MARGIN, y - MARGIN, x + MARGIN, y + MARGIN)
        if not shapely.contains(space.free.geometry, near):
            continue
        square = Area.box(x - PINHEAD, y - PINHEAD, x + PINHEAD, y + PINHEAD)
        inside = bool(shapely.contains(claimed.area.geometry, near))
        if inside or not shapely.intersects(claimed.area.geometry, near):
            found.append((Region(square, ContactSet.empty()), inside))
    for edge in rng.choices(contact.edges.tolist(), k=4):
        length = float(contact.length[edge])
        if length < 4 * MARGIN:
            continue
        place = rng.uniform(2 * MARGIN, length - 2 * MARGIN)
        head, wide = (
            ContactSet.of([edge], [place - reach], [place + reach], [], tolerance)
            for reach in (PINHEAD, MARGIN)
        )
        inside = contact_set.is_subset(wide, claimed.contact, tolerance)
        if inside or contact_set.intersection(wide, claimed.contact, tolerance).is_empty:
            found.append((Region(Area.empty(), head), inside))
    for vertex in rng.choices(contact.vertices.tolist(), k=2):
        head = ContactSet.of([], [], [], [vertex], tolerance)
        found.append((Region(Area.empty(), head), claimed.contact.has_vertex(vertex)))
    return found


def goes_astray(scene: Scene, command: Sources, found: ForwardProjection) -> bool:
    """Whether a motion may escape, or rest outside the target."""
    edges, vertices = command.where(Behaviour.MAY_STICK)
    rest = contact_set.difference(found.region.contact, scene.target.contact, 0.1 * NEAR)
    return found.escapes or bool(np.any(edges[rest.edge]) or np.any(vertices[rest.vertices]))


def check_duality(seed: int) -> None:
    """p in B(T) iff FP({p}) stopped at T neither rests outside T nor escapes."""
    rng = Random(seed)
    scene = generic(random_scene(rng))
    space = scene.space
    command = sources(space.contact, *scene[2:], space.tolerance)
    claimed = backproject(space, scene.target, command).region
    for start, inside in pinheads(scene, claimed, rng):
        found = projected(scene, start, scene.target)
        assert goes_astray(scene, command, found) is not inside, (seed, start.contact)


@pytest.mark.parametrize("block", range(3))
def test_a_start_is_in_a_backprojection_iff_nothing_goes_astray(block: int) -> None:
    for seed in range(block * 60, block * 60 + 60):
        check_duality(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_duality_at_length(block: int) -> None:
    for seed in range(1000 + block * 400, 1400 + block * 400):
        check_duality(seed)


def pulled_in(region: Region, margin: float) -> Region:
    """A region without what is near its border, within each feature."""
    contact = region.contact
    long = contact.high - contact.low > 4.0 * margin
    low, high = contact.low[long] + margin, contact.high[long] - margin
    area = region.area if region.area.is_empty else areas.shrunk(region.area, margin)
    return Region(area, ContactSet(contact.edge[long], low, high, contact.vertices))


def check_promise(seed: int) -> None:
    """From all of B(T), but for ties, nothing rests outside T or escapes."""
    scene = random_scene(Random(seed))
    command = sources(scene.space.contact, *scene[2:], scene.space.tolerance)
    claimed = backproject(scene.space, scene.target, command).region
    found = projected(scene, pulled_in(claimed, NEAR), scene.target)
    assert not goes_astray(scene, command, found), seed


def test_from_a_backprojection_nothing_goes_astray() -> None:
    for seed in range(100):
        check_promise(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_from_a_backprojection_nothing_goes_astray_at_length(block: int) -> None:
    for seed in range(1000 + block * 200, 1200 + block * 200):
        check_promise(seed)


# --- the simulator ----------------------------------------------------------------------------


def assert_stays(world: World, state: State, found: ForwardProjection, what: object) -> None:
    """A state that a trajectory visits belongs."""
    assert world.off(found.region, state) <= NEAR, (what, state)


def check_trajectories(seed: int) -> None:
    """Whatever nature does, motions stay in the forward projection until they meet the stop."""
    rng = Random(seed)
    scene, start = random_case(rng)
    stop = scene.target if rng.random() < 0.6 else Region.empty()
    found = projected(scene, start, stop)
    world = World(scene.space, scene.friction)
    motion = Motion(world, scene.direction, scene.control, found.region)
    for first in starts(world, start, rng, 3):
        for name, choose in ADVERSARIES.items():
            state = first
            for count in range(10):
                if world.is_in(stop, state):
                    break
                if world.escaped(state):
                    assert found.escapes, (seed, name)
                    break
                angle, time = choose(motion, state, count, rng)
                moves = world.moves(state, angle, time)
                if not moves:
                    break
                move = pick(name, moves, rng)
                if move.doing is Doing.STICKS or on_the_way(move, stop, 0.0):
                    break
                assert_stays(world, between(move, rng.random()), found, (seed, name))
                if isinstance(move.end, Lost):
                    assert found.escapes, (seed, name)
                    break
                state = move.end
                if not world.escaped(state):
                    assert_stays(world, state, found, (seed, name))


@pytest.mark.parametrize("block", range(3))
def test_trajectories_stay(block: int) -> None:
    for seed in range(block * 60, block * 60 + 60):
        check_trajectories(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_trajectories_stay_at_length(block: int) -> None:
    for seed in range(1000 + block * 400, 1400 + block * 400):
        check_trajectories(seed)


# --- the slabs of verification ----------------------------------------------------------------


def off_the_corners(space: ConfigurationSpace, start: Region, stop: Region) -> Region:
    """A start kept a little away from what it does not hold: there both may differ, by ties."""
    contact = contact_set.difference(start.contact, stop.contact, space.tolerance.length)
    low = np.maximum(contact.low, 0.0) + MARGIN
    high = np.minimum(contact.high, space.contact.length[contact.edge]) - MARGIN
    long = high - low > MARGIN
    area = start.area
    if not area.is_empty:
        area = areas.intersection(area, areas.shrunk(space.free, MARGIN))
        area = areas.difference(area, areas.shrunk(stop.area, -MARGIN))
    return Region(area, ContactSet(contact.edge[long], low[long], high[long], contact.vertices))


def check_against_slabs(seed: int) -> None:
    """Area and contact as in the slabs."""
    rng = Random(seed)
    scene, start = random_case(rng)
    scene = generic(scene)
    stop = scene.target if rng.random() < 0.6 else Region.empty()
    start = off_the_corners(scene.space, start, stop)
    fast = projected(scene, start, stop)
    slow = forward_projection(scene.space, start, *scene[2:], stop)
    apart = shapely.symmetric_difference(
        fast.region.area.geometry, slow.region.area.geometry, grid_size=2.0**-36
    )
    assert apart.area <= NEAR, (seed, apart.bounds)
    assert contact_gap(fast.region.contact, slow.region.contact) <= NEAR, seed
    assert fast.escapes == bool(slow.escapes), seed


def test_forward_projections_agree_with_the_slabs() -> None:
    for seed in range(150):
        check_against_slabs(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_agreement_with_the_slabs_at_length(block: int) -> None:
    for seed in range(1000 + block * 500, 1500 + block * 500):
        check_against_slabs(seed)
