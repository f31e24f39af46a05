"""Forward projections in slabs: closed forms, random motions, and what they are dual to."""

from __future__ import annotations

import itertools
import math
from random import Random

import numpy as np
import pytest
import shapely

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.reachability.forward_projection import forward_project
from preimage.verification.forward import ForwardProjection, forward_projection
from preimage.verification.proof import shrunk
from preimage.verification.reference import reference_backprojection
from tests.laws.world import AtVertex, Free, Lost, OnEdge, State, World
from tests.strategies import Scene, random_scene, random_target, space_of

DOWN = math.radians(270)
TEN, TWENTY = math.radians(10), math.radians(20)
NOTHING = Region.empty()


def area(*corners: tuple[float, float]) -> Region:
    return Region(Area.polygon(np.array(corners, dtype=np.float64)), ContactSet.empty())


def box(xmin: float, ymin: float, xmax: float, ymax: float) -> Region:
    return area((xmin, ymin), (xmax, ymin), (xmax, ymax), (xmin, ymax))


def contact(
    space: ConfigurationSpace,
    edges: list[tuple[int, float, float]],
    vertices: list[int],
) -> Region:
    names = [edge for edge, _, _ in edges]
    low, high = [low for _, low, _ in edges], [high for _, _, high in edges]
    near = space.tolerance.length
    return Region(Area.empty(), ContactSet.of(names, low, high, vertices, near))


def edge_at(space: ConfigurationSpace, x: float, y: float) -> int:
    lines = shapely.linestrings(np.stack((space.contact.points, space.contact.ends), axis=1))
    return int(np.argmin(shapely.distance(lines, shapely.Point(x, y))))


def vertex_at(space: ConfigurationSpace, x: float, y: float) -> int:
    off = np.hypot(*(space.contact.points - (x, y)).T)
    assert off.min() < 1e-9
    return int(np.argmin(off))


def floor(top: float = 0.0) -> ConfigurationSpace:
    return space_of([shapely.box(-6, -6, 6, top)])


# --- closed forms -----------------------------------------------------------------------------


@pytest.mark.parametrize("control", [0.1, 0.6, 1.2])
def test_a_start_in_free_space_spreads_by_the_cone(control: float) -> None:
    space = floor()
    found = forward_projection(space, box(-0.5, 1, 0.5, 2), DOWN, control, 1.3)
    spread = 2.0 * math.tan(control)
    width = min(1.0 + 2.0 * spread, 12.0)
    assert found.contact.total_length == pytest.approx(width, abs=1e-7)
    assert bool(found.escapes) == (0.5 + spread > 6.0)
    if not found.escapes:
        assert found.area.measure == pytest.approx(2.0 + 4.0 * math.tan(control), abs=1e-7)


def test_a_point_of_a_floor_that_sticks_stays_there() -> None:
    space = floor()
    edge = edge_at(space, 0, 0)
    found = forward_projection(
        space, contact(space, [(edge, 5.0, 6.0)], []), DOWN, TEN, math.radians(45)
    )
    assert found.contact.total_length == pytest.approx(1.0)
    assert found.area.is_empty
    assert found.rests == ((edge, 5.0, 6.0),)


def test_without_friction_it_may_slide_both_ways_off_the_ledge() -> None:
    space = space_of([shapely.box(-2, -2, 2, 0), shapely.box(-6, -6, 6, -4)])
    edge = edge_at(space, 0, 0)
    start = contact(space, [(edge, 1.9, 2.1)], [])
    found = forward_projection(space, start, DOWN, TEN, 0.0)
    below = edge_at(space, 0, -4)
    on = found.contact.edge
    assert found.contact.total_length > 4.0
    assert edge in on
    assert below in on
    assert vertex_at(space, -2, 0) in found.vertices
    # and on the floor below as well
    whole = found.contact.high[on == below] - found.contact.low[on == below]
    assert whole.tolist() == pytest.approx([12.0])


def test_a_slope_is_climbed_only_if_the_cone_is_wider_than_the_friction() -> None:
    """A slide back up: a further pass."""
    space = space_of([shapely.Polygon([(-6, -6), (6, -6), (6, 0), (0, 0), (-4, 1), (-6, 1)])])
    start = area((0.1, 1.0), (0.3, 1.0), (0.3, 1.2))
    slope = math.degrees(math.atan2(1.0, 4.0))
    top = vertex_at(space, -4, 1)
    for friction, climbs in ((0.0, True), (5.0, True), (10.0, False)):
        control = math.radians(friction + slope + (5.0 if climbs else -5.0))
        found = forward_projection(space, start, DOWN, control, math.radians(friction))
        assert (top in found.vertices) == climbs


def test_a_notch_holds_and_its_walls_lead_there() -> None:
    notch = shapely.Polygon([(-6, 2), (-2, 2), (0, -1), (2, 2), (6, 2), (6, -6), (-6, -6)])
    space = space_of([notch])
    bottom = vertex_at(space, 0, -1)
    found = forward_projection(space, box(-0.2, 2, 0.2, 2.5), DOWN, TEN, 0.0)
    count = len(space.contact)
    assert found.rests == ((count + bottom, 0.0, 0.0),)
    assert not found.escapes
    stopped = forward_projection(
        space, box(-0.2, 2, 0.2, 2.5), DOWN, TEN, 0.0, contact(space, [], [bottom])
    )
    assert not stopped.rests
    assert not stopped.escapes
    assert bottom in stopped.vertices


def test_a_stop_set_is_met_and_not_crossed() -> None:
    space = floor()
    shield = box(-1, 1, 1, 1.5)
    start = box(-0.5, 2, 0.5, 3)
    found = forward_projection(space, start, DOWN, TEN, TWENTY, shield)
    assert found.contact.is_empty
    assert found.area.bounds[1] == pytest.approx(1.5)
    narrow = box(-0.2, 1, 0.2, 1.5)
    found = forward_projection(space, start, DOWN, TEN, TWENTY, narrow)
    assert areas.intersection(found.area, narrow.area).measure == pytest.approx(0.0, abs=1e-9)
    assert found.contact.total_length > 1.0
    within = forward_projection(space, box(-0.1, 1.1, 0.1, 1.4), DOWN, TEN, TWENTY, narrow)
    assert within.contact.is_empty
    assert within.area.measure == pytest.approx(0.06)


def test_nothing_comes_from_nothing() -> None:
    found = forward_projection(floor(), NOTHING, DOWN, TEN, TWENTY)
    assert found.area.is_empty
    assert found.contact.is_empty
    assert not found.escapes
    assert not found.rests


# --- laws -------------------------------------------------------------------------------------


def start_of(seed: int) -> tuple[Scene, Region, Region | None]:
    rng = Random(seed)
    scene = random_scene(rng)
    start = random_target(rng, scene.space, scene.direction, rng.random() < 0.5)
    stop = scene.target if rng.random() < 0.6 else None
    return scene, start, stop


def projected(scene: Scene, start: Region, stop: Region | None) -> ForwardProjection:
    return forward_projection(
        scene.space, start, scene.direction, scene.control, scene.friction, stop
    )


def within(scene: Scene, region: Region) -> Region:
    """A region without its borders, where ties are."""
    cone = scene.direction - scene.control, scene.direction + scene.control
    return shrunk(region, scene.space, cone)


def random_state(rng: Random, start: Region, world: World) -> State | None:
    """Somewhere in a region."""
    kinds: list[State] = []
    if not start.area.is_empty:
        xmin, ymin, xmax, ymax = start.area.bounds
        for _ in range(50):
            x, y = rng.uniform(xmin, xmax), rng.uniform(ymin, ymax)
            if start.area.contains(x, y) and start.area.depth(x, y) > 1e-3:
                kinds.append(Free(x, y))
                break
    if len(start.contact.edge):
        place = rng.randrange(len(start.contact.edge))
        part = rng.uniform(0.1, 0.9)
        low, high = start.contact.low[place], start.contact.high[place]
        kinds.append(OnEdge(int(start.contact.edge[place]), float(low + part * (high - low))))
    if len(start.contact.vertices):
        kinds.append(AtVertex(int(rng.choice(start.contact.vertices.tolist()))))
    return rng.choice(kinds) if kinds else None


@pytest.mark.parametrize("seed", range(40))
def test_random_motions_stay_within(seed: int) -> None:
    scene, start, _ = start_of(seed)
    found = projected(scene, start, None)
    region, world = found.region, World(scene.space, scene.friction)
    rng = Random(seed)
    for _ in range(12):
        state = random_state(rng, start, world)
        for _ in range(12):
            if state is None or world.escaped(state):
                break
            swing = rng.choice((-1.0, 1.0, rng.uniform(-1.0, 1.0))) * 0.999999
            angle = scene.direction + swing * scene.control
            move = rng.choice(world.moves(state, angle, rng.choice((0.5, 3.0, 50.0))))
            if isinstance(move.end, Lost):
                assert found.escapes
                break
            state = move.end
            # with perfect control what is visited may be a line, which is no area
            if not world.escaped(state) and not (isinstance(state, Free) and not scene.control):
                assert world.is_in(region, state, 1e-6), (seed, state)


@pytest.mark.parametrize("seed", range(30))
def test_is_dual_to_the_backprojection(seed: int) -> None:
    """Who starts well inside `B` neither escapes nor rests outside; who starts outside may."""
    scene = random_scene(Random(seed))
    space, near = scene.space, scene.space.tolerance.length
    back = reference_backprojection(
        space, scene.target, scene.direction, scene.control, scene.friction
    )
    inside = projected(scene, within(scene, back.region), scene.target)
    assert not inside.escapes
    assert not inside.rests
    rest = contact_set.complement(back.contact, space.contact, near)
    for edge, low, high in zip(
        rest.edge.tolist(), rest.low.tolist(), rest.high.tolist(), strict=True
    ):
        if high - low > 100 * near:
            middle = 0.5 * (low + high)
            start = contact(space, [(edge, middle - 10 * near, middle + 10 * near)], [])
            outside = projected(scene, start, scene.target)
            assert outside.escapes or outside.rests
    for vertex in rest.vertices.tolist():
        outside = projected(scene, contact(space, [], [vertex]), scene.target)
        assert outside.escapes or outside.rests


@pytest.mark.parametrize("seed", range(60))
def test_agrees_with_the_planners_own(seed: int) -> None:
    """Two algorithms that share no code; where the start ends at a feature, ties may differ."""
    scene, start, stop = start_of(seed)
    start = within(scene, start)
    slow = projected(scene, start, stop)
    fast = forward_project(scene.space, start, scene.direction, scene.control, scene.friction, stop)
    near = 64.0 * scene.space.tolerance.length
    # with perfect control the sweep may turn its cone by a little
    exact = scene.control == 0.0
    off = 1e-4 if exact else 1e-6
    assert areas.difference(slow.region.area, fast.region.area).measure < off
    assert areas.difference(fast.region.area, slow.region.area).measure < off
    for one, other in (
        (slow.contact, fast.region.contact),
        (fast.region.contact, slow.contact),
    ):
        left = contact_set.difference(one, other, near)
        assert len(left.edge) == 0 or (exact and np.max(left.high - left.low) < 1e-4)
        assert len(left.vertices) == 0
    assert bool(slow.escapes) == fast.escapes


@pytest.mark.parametrize("seed", range(20))
def test_every_reached_place_has_a_way(seed: int) -> None:
    scene, start, stop = start_of(seed)
    found = projected(scene, start, stop)
    count = len(scene.space.contact)
    slope = math.tan(max(scene.control, scene.space.tolerance.angle))
    for edge, spans in enumerate(found.reached.spans):
        for low, high in spans:
            way = found.ways.to_edge(edge, 0.5 * (low + high))
            assert way[-1].feature == edge
            first = found.restored(way[0].place)
            if way[0].feature == 2 * count:
                assert start.area.distance(*first) < 1e-8
            for before, after in itertools.pairwise(way):
                if after.along < 0:
                    drop = before.place[1] - after.place[1]
                    assert abs(before.place[0] - after.place[0]) <= slope * drop + 1e-8


@pytest.mark.parametrize("seed", range(15))
def test_grows_with_start_and_uncertainty_and_shrinks_with_the_stop_set(seed: int) -> None:
    scene, start, _stop = start_of(seed)
    start = within(scene, start)
    near = 64.0 * scene.space.tolerance.length
    small = projected(scene, start, scene.target).region
    large = projected(scene, start, None).region
    wide = forward_projection(
        scene.space, start, scene.direction, min(scene.control + 0.1, 1.5), scene.friction, None
    ).region
    again = projected(scene, within(scene, large), None).region
    for inner, outer in ((small, large), (large, wide), (again, large)):
        assert areas.difference(inner.area, outer.area).measure < 1e-6
        left = contact_set.difference(inner.contact, outer.contact, near)
        assert not len(left.edge) or np.max(left.high - left.low) < 1e-6
    assert np.all(np.isin(small.contact.vertices, large.contact.vertices))
