"""Weak backprojections: closed forms, forward projections point by point, and trajectories."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon, box

from preimage.configuration import contact_set
from preimage.configuration import region as regions
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.reachability.backprojection import backproject
from preimage.reachability.forward_projection import forward_project
from preimage.reachability.sources import sources
from preimage.reachability.weak import weak_closure, weakly_backproject
from tests.laws.adversaries import CONTROLS as ADVERSARIES
from tests.laws.adversaries import Motion, pick
from tests.laws.passage import between, on_the_way, starts
from tests.laws.similarity import within
from tests.laws.world import Doing, Free, Lost, State, World
from tests.reachability.test_forward_projection import at_vertex, edge_from, free, on_edge
from tests.strategies import CONTROLS, Scene, random_scene, random_target, scenes, space_of

DOWN = 270.0
FLOOR = box(-9, -9, 9, 0)
NEAR = 1e-6
PINHEAD = 1e-4
MARGIN = 1e-3


def weak(
    space: ConfigurationSpace, target: Region, *degrees: float, stop: Region | None = None
) -> Region:
    """The weak backprojection, given direction, control and friction in degrees."""
    direction, control, friction = (math.radians(angle) for angle in degrees)
    return weakly_backproject(space, target, direction, control, friction, stop).region


def spans(found: Region) -> dict[int, list[tuple[float, float]]]:
    """The intervals of edges, rounded."""
    contact = found.contact
    result: dict[int, list[tuple[float, float]]] = {}
    for edge, low, high in zip(
        contact.edge.tolist(), contact.low.tolist(), contact.high.tolist(), strict=True
    ):
        result.setdefault(edge, []).append((round(low, 6), round(high, 6)))
    return result


def of(scene: Scene, target: Region, stop: Region | None = None) -> Region:
    """The weak backprojection in a scene."""
    return weakly_backproject(scene.space, target, *scene[2:], stop).region


def generic(scene: Scene) -> Scene:
    """The same scene with bounds at which no edge lies along a side of a cone."""
    return scene._replace(
        direction=scene.direction + 3e-4,
        control=min(scene.control + 1.23e-3, 1.4),
        friction=scene.friction + 7.7e-4,
    )


# --- closed forms -----------------------------------------------------------------------------


@pytest.mark.parametrize("control", [0.001, 5.0, 20.0, 40.0])
def test_what_may_fall_on_a_part_of_the_floor_widens_upwards(control: float) -> None:
    space = space_of([FLOOR])
    floor = edge_from(space, -6, 0)
    found = weak(space, on_edge(space, floor, 5.5, 6.5), DOWN, control, control + 1)
    slope = math.tan(math.radians(control))
    sides = 0.5 * slope * 6.0 * 6.0 - (0.5 * max(6.0 * slope - 5.5, 0.0) ** 2 / slope)
    assert found.area.measure == pytest.approx(6.0 + 2.0 * sides, abs=1e-8)
    # what lies on the floor stays where it is
    assert spans(found) == {floor: [(5.5, 6.5)]}


def test_a_floor_that_is_slid_on_leads_from_end_to_end() -> None:
    mesa = box(-2, -9, 2, 0)
    space = space_of([mesa])
    top = edge_from(space, -2, 0)
    target = on_edge(space, top, 2, 2.5)
    held = weak(space, target, DOWN, 20.0, 20.1)
    assert spans(held) == {top: [(2.0, 2.5)]}
    loose = weak(space, target, DOWN, 20.0, 19.9)
    # down the walls and away leads nothing back
    assert spans(loose) == {top: [(0.0, 4.0)]}
    assert loose.contact.has_vertex(top)


def test_a_slope_is_slid_down_only() -> None:
    ramp = Polygon([(-3, 0), (3, 3), (3, -9), (-3, -9)])
    space = space_of([ramp])
    face = edge_from(space, -3, 0)
    found = weak(space, on_edge(space, face, 2, 3), DOWN, 1.0, 10.0)
    assert spans(found) == {face: [(2.0, round(math.hypot(6, 3), 6))]}
    assert found.contact.has_vertex(edge_from(space, 3, 3))
    assert not found.contact.has_vertex(face)


def test_a_notch_draws_from_its_walls_and_from_all_that_flies_to_them() -> None:
    notch = Polygon([(-9, 0), (-1, 0), (0, -1), (1, 0), (9, 0), (9, -9), (-9, -9)])
    space = space_of([notch])
    found = weak(space, at_vertex(edge_from(space, 0, -1)), DOWN, 5.0, 10.0)
    left, right = edge_from(space, -1, 0), edge_from(space, 0, -1)
    assert set(found.contact.edge.tolist()) == {left, right}
    assert found.contact.total_length == pytest.approx(2 * math.sqrt(2))
    slope = math.tan(math.radians(5.0))
    assert found.area.measure == pytest.approx(1.0 + 12.0 + slope * 36.0, abs=1e-8)


def test_an_edge_that_is_left_for_sure_leads_away_from_it() -> None:
    ceiling = box(-9, 0, 9, 9)
    space = space_of([ceiling])
    found = weak(space, free(-1, -3, 1, -2), DOWN, 10.0, 5.0)
    slope = 3.0 * math.tan(math.radians(10.0))
    assert found.contact.total_length == pytest.approx(2.0 + 2.0 * slope)
    assert found.contact.vertices.tolist() == []


def test_what_would_have_met_the_stop_set_before_does_not_belong() -> None:
    space = space_of([FLOOR])
    floor = edge_from(space, -6, 0)
    target = on_edge(space, floor, 0.0, 12.0)
    found = weak(space, target, DOWN, 10.0, 15.0, stop=free(-6, 2, 6, 3))
    assert found.area.measure == pytest.approx(24.0, abs=1e-6)
    found = weak(space, target, DOWN, 10.0, 15.0, stop=free(-1, 2, 1, 3))
    gap = weak(space, target, DOWN, 10.0, 15.0).area.measure - found.area.measure
    shadow = 1.0 / math.tan(math.radians(10.0))
    assert gap == pytest.approx(2.0 + _above(shadow), abs=1e-5)


def _above(shadow: float) -> float:
    """What of the shadow above a stop set two wide lies within the window, three high."""
    left = max(0.0, 1.0 - 3.0 / shadow)
    return 0.5 * (2.0 + 2.0 * left) * 3.0 if left > 0.0 else shadow


def test_of_a_stop_set_that_is_the_target_nothing_is_lost() -> None:
    space = space_of([FLOOR])
    target = regions.union(
        free(-2, 1, 2, 2), on_edge(space, edge_from(space, -6, 0), 1, 3), space.tolerance
    )
    plain = weak(space, target, DOWN, 10.0, 15.0)
    assert within(plain, weak(space, target, DOWN, 10.0, 15.0, stop=target), NEAR)


def test_nothing_leads_to_nothing() -> None:
    assert weak(space_of([FLOOR]), Region.empty(), DOWN, 10.0, 5.0).is_empty


# --- laws -------------------------------------------------------------------------------------


@given(scenes, st.sampled_from(CONTROLS))
@settings(max_examples=25)
def test_it_holds_the_target_and_grows_with_it_and_with_control(
    scene: Scene, control: float
) -> None:
    rng = Random(0)
    more = random_target(rng, scene.space, scene.direction, lattice=False)
    both = regions.union(scene.target, more, scene.space.tolerance)
    small = of(scene, scene.target)
    assert within(scene.target, small, NEAR)
    assert within(small, of(scene, both), NEAR)
    loose = scene._replace(control=max(control, scene.control))
    assert within(small, of(loose, scene.target), NEAR)
    assert within(of(scene, scene.target, more), small, NEAR)


@given(scenes)
@settings(max_examples=25)
def test_it_holds_the_backprojection(scene: Scene) -> None:
    command = sources(scene.space.contact, *scene[2:], scene.space.tolerance)
    strong = backproject(scene.space, scene.target, command).region
    assert within(strong, of(scene, scene.target), NEAR)


def test_a_target_at_the_end_of_an_open_side_is_slid_to() -> None:
    """Up to the right, under a ceiling as wide as the window, into its open corner."""
    space = space_of([box(-9, 6, 9, 9)])
    ceiling = edge_from(space, 6, 6)
    corner = at_vertex(ceiling)
    command = sources(space.contact, math.radians(45), math.radians(5), 0.0, space.tolerance)
    strong = backproject(space, corner, command).region
    found = weak(space, corner, 45.0, 5.0, 0.0)
    assert spans(strong) == spans(found) == {ceiling: [(0.0, 12.0)]}
    assert strong.area.measure > 50.0
    assert within(strong, found, NEAR)


def test_two_commands_together_reach_what_zigzags_do() -> None:
    """Down to the left and down to the right by 30 degrees: all within 30 degrees of down."""
    space = space_of([FLOOR])
    floor = edge_from(space, -6, 0)
    target = on_edge(space, floor, 5.5, 6.5)
    pair = (math.radians(240), math.radians(300))
    found = weak_closure(space, target, pair, 0.0, math.radians(80))
    assert found is not None
    slope = math.tan(math.radians(30))
    assert found.area.measure == pytest.approx(6.0 + 36.0 * slope, abs=1e-7)
    assert weak_closure(space, target, (0.0, math.pi), 0.1, 0.1) is None


def check_closure(seed: int) -> None:
    """One flood is as large as what sweep after sweep adds, and no larger but by slides."""
    rng = Random(seed)
    scene = random_scene(rng)
    scene = scene._replace(control=min(max(scene.control, 1e-3), 0.5))
    second = scene.direction + rng.uniform(-1.0, 1.0)
    pair, bounds = (scene.direction, second), (scene.control, scene.friction)
    target = inner(scene)
    found = weak_closure(scene.space, target, pair, *bounds)
    if found is None:
        return
    reached = target
    for direction in pair * 8:
        assert within(
            weakly_backproject(scene.space, found, direction, *bounds).region, found, NEAR
        ), seed
        more = weakly_backproject(scene.space, reached, direction, *bounds).region
        reached = regions.union(reached, more, scene.space.tolerance)
    assert within(reached, found, NEAR), seed


def test_one_flood_follows_all_commands() -> None:
    for seed in range(10):
        check_closure(seed)


# --- forward projections ----------------------------------------------------------------------


def pinheads(scene: Scene, rng: Random) -> list[tuple[Region, Region]]:
    """Small starts, each with one around it."""
    space = scene.space
    contact, near = space.contact, space.tolerance.length
    found: list[tuple[Region, Region]] = []
    for _ in range(6):
        x, y = rng.uniform(-6, 6), rng.uniform(-6, 6)
        if shapely.contains(space.free.geometry, shapely.Point(x, y).buffer(2 * MARGIN)):
            small, wide = (
                free(x - reach, y - reach, x + reach, y + reach) for reach in (PINHEAD, MARGIN)
            )
            found.append((small, wide))
    for edge in rng.choices(contact.edges.tolist(), k=4):
        length = float(contact.length[edge])
        if length < 4 * MARGIN:
            continue
        place = rng.uniform(2 * MARGIN, length - 2 * MARGIN)
        low, high = (
            Region(Area.empty(), ContactSet.of([edge], [place - reach], [place + reach], [], near))
            for reach in (PINHEAD, MARGIN)
        )
        found.append((low, high))
    inner = np.setdiff1d(contact.vertices, contact.outermost).tolist()
    for vertex in rng.sample(inner, min(2, len(inner))):
        found.append((at_vertex(vertex), at_vertex(vertex)))
    return found


def meets(a: Region, b: Region, reach: float) -> bool:
    """Whether two regions share more than a touch, or with a negative reach come that near."""
    shared = contact_set.intersection(a.contact, b.contact, max(reach, 0.0))
    if len(shared.vertices) or np.any(shared.high - shared.low > max(reach, 0.0)):
        return True
    if a.area.is_empty or b.area.is_empty:
        return False
    if reach < 0.0:
        return bool(shapely.distance(a.area.geometry, b.area.geometry) <= -reach)
    both = shapely.intersection(a.area.geometry, b.area.geometry, grid_size=2.0**-36)
    return bool(shapely.area(both) > reach)


def check_duality(seed: int) -> None:
    """p in weak(T) iff FP({p}) meets T."""
    rng = Random(seed)
    scene = generic(random_scene(rng))
    stop = random_target(rng, scene.space, scene.direction, rng.random() < 0.5)
    stop = stop if rng.random() < 0.5 else Region.empty()
    space, target = scene.space, inner(scene)
    found = of(scene, target, stop)
    for small, wide in pinheads(scene, rng):
        ahead = forward_project(space, small, *scene[2:], stop).region
        if meets(ahead, without(target, stop, space), NEAR):
            assert meets(small, found, 0.0), (seed, small.contact.edge, small.area)
        if meets(small, stop, 0.0):  # where it is met, it belongs
            continue
        around = forward_project(space, wide, *scene[2:], pulled_in(stop)).region
        if not meets(around, target, -NEAR):
            assert not meets(small, found, NEAR * PINHEAD), (seed, small.contact.edge, small.area)


def inner(scene: Scene) -> Region:
    """The target but for what only those touch who have escaped."""
    contact = contact_set.without_outermost(scene.target.contact, scene.space.contact)
    return Region(scene.target.area, contact)


def without(region: Region, taken: Region, space: ConfigurationSpace) -> Region:
    """A region without another one, and a little more."""
    contact = contact_set.difference(region.contact, taken.contact, space.tolerance.length)
    area = region.area
    if not area.is_empty and not taken.area.is_empty:
        area = areas.difference(area, areas.shrunk(taken.area, -MARGIN))
    return Region(area, contact)


def pulled_in(region: Region) -> Region:
    """A region without what is near its border, within each feature."""
    contact = region.contact
    long = contact.high - contact.low > 4.0 * MARGIN
    low, high = contact.low[long] + MARGIN, contact.high[long] - MARGIN
    area = region.area if region.area.is_empty else areas.shrunk(region.area, MARGIN)
    return Region(area, ContactSet(contact.edge[long], low, high, contact.vertices))


@pytest.mark.parametrize("block", range(3))
def test_a_start_belongs_iff_its_forward_projection_meets_the_target(block: int) -> None:
    for seed in range(block * 30, block * 30 + 30):
        check_duality(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_duality_at_length(block: int) -> None:
    for seed in range(1000 + block * 400, 1400 + block * 400):
        check_duality(seed)


# --- trajectories -----------------------------------------------------------------------------


def check_trajectories(seed: int) -> None:
    """All that is visited on the way to the target belongs."""
    rng = Random(seed)
    scene = random_scene(rng)
    stop = random_target(rng, scene.space, scene.direction, rng.random() < 0.5)
    stop = stop if rng.random() < 0.5 else Region.empty()
    target, world = inner(scene), World(scene.space, scene.friction)
    found = of(scene, target, stop)
    motion = Motion(world, scene.direction, scene.control, target)
    for first in starts(world, scene.space.valid, rng, 6):
        for name, choose in ADVERSARIES.items():
            state, passed = first, []
            for count in range(10):
                passed.append(state)
                if world.is_in(target, state):
                    assert_belongs(world, passed, found, (seed, name))
                    break
                if world.is_in(stop, state) or world.escaped(state):
                    break
                angle, time = choose(motion, state, count, rng)
                moves = world.moves(state, angle, time)
                if not moves:
                    break
                move = pick(name, moves, rng)
                if on_the_way(move, stop, 0.0):
                    break
                if on_the_way(move, target, NEAR):
                    assert_belongs(world, passed, found, (seed, name))
                if move.doing is Doing.STICKS or isinstance(move.end, Lost):
                    break
                passed.append(between(move, rng.random()))
                state = move.end


def assert_belongs(world: World, passed: list[State], found: Region, what: object) -> None:
    contact, on = world.space.contact, found.contact
    low, high = contact.at(on.edge, on.low), contact.at(on.edge, on.high)
    edges = shapely.linestrings(np.stack((low, high), axis=1))
    for state in passed:
        gap = world.off(found, state)
        if isinstance(state, Free) and len(edges):  # what flies along a wall is beside it
            gap = min(gap, float(shapely.distance(edges, shapely.Point(state.x, state.y)).min()))
        assert gap <= NEAR, (what, state)


@pytest.mark.parametrize("block", range(2))
def test_what_comes_to_the_target_was_in_it_all_the_way(block: int) -> None:
    for seed in range(block * 30, block * 30 + 30):
        check_trajectories(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_trajectories_at_length(block: int) -> None:
    for seed in range(1000 + block * 400, 1400 + block * 400):
        check_trajectories(seed)
