"""Known failure: pits, components and crevices; forward closures; walks that never come back."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import shapely
from shapely import Polygon, box

from preimage.configuration import region as regions
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.preimages.setting import Setting
from preimage.reachability.forward_projection import forward_project
from preimage.search.failure import hopeless
from preimage.search.limits import Limits
from preimage.task.options import Continuous, Directions
from preimage.task.task import SlidingLaw
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import Side
from tests.laws.adversaries import CONTROLS as ADVERSARIES
from tests.laws.adversaries import Motion, pick
from tests.laws.passage import on_the_way, starts
from tests.laws.world import Lost, World
from tests.reachability.test_forward_projection import at_vertex, edge_from, free, on_edge
from tests.reachability.test_weak import meets, pinheads
from tests.strategies import Scene, random_scene, space_of

NEAR = 1e-6
ROUNDS = 6
RIGHT, UP, LEFT, DOWN = (0.5 * math.pi * k for k in range(4))
FLOOR = box(-9, -9, 9, 0)


def setting_of(space: ConfigurationSpace, control: float = 5.0, friction: float = 20.0) -> Setting:
    """A setting, given bounds in degrees."""
    errors = Uncertainty(math.radians(control), 0.1, 0.1, (0.05, 0.05))
    return Setting(space, errors, math.radians(friction), SlidingLaw.PROJECTION, 0.005)


def box_space() -> ConfigurationSpace:
    """A floor with a pit one wide and one deep, walls on both sides."""
    pit = Polygon([(-9, 0), (0, 0), (0, -1), (1, -1), (1, 0), (9, 0), (9, -9), (-9, -9)])
    return space_of([pit], [Side.LEFT, Side.RIGHT])


# --- closed forms -----------------------------------------------------------------------------


def test_without_a_way_up_a_pit_is_hopeless() -> None:
    space = box_space()
    goal = on_edge(space, edge_from(space, 1, 0), 1, 2)
    sloping = (math.radians(190), math.radians(350), DOWN)
    bottom = edge_from(space, 0, -1)
    for setting, directions in (
        (setting_of(space), sloping),
        (setting_of(space, 0.0), (RIGHT, LEFT, DOWN)),
    ):
        found = hopeless(setting, goal, directions)
        assert (found.contact.edge == bottom).any()
        assert found.contact.has_vertex(bottom)
        assert found.area.contains(0.5, -0.05)
        assert not found.area.contains(0.5, 0.05)
    # what is commanded sideways may rise, and climb from wall to wall
    assert hopeless(setting_of(space), goal, (RIGHT, LEFT, DOWN)).is_empty


def test_with_a_way_up_nothing_is() -> None:
    space = box_space()
    goal = on_edge(space, edge_from(space, 1, 0), 1, 2)
    assert hopeless(setting_of(space), goal, (RIGHT, UP, LEFT, DOWN)).is_empty


def test_rooms_without_the_goal_are_hopeless() -> None:
    room = shapely.difference(box(0, 0, 4, 4), box(1, 1, 3, 3))
    space = space_of([room])
    outside = free(-3, -3, -2, -2)
    for directions in ((RIGHT, UP, LEFT, DOWN), Continuous()):
        found = hopeless(setting_of(space), outside, directions)
        assert found.area.measure == pytest.approx(4.0)
        assert len(found.contact.edge) == len(found.contact.vertices) == 4
        found = hopeless(setting_of(space), free(1.5, 1.5, 2, 2), directions)
        assert found.area.measure == pytest.approx(144.0 - 16.0, abs=1e-6)
        corner = at_vertex(edge_from(space, 1, 1))
        found = hopeless(setting_of(space), corner, directions)
        assert found.area.measure == pytest.approx(144.0 - 16.0, abs=1e-6)


def test_a_crevice_out_of_which_no_cone_points_is_hopeless() -> None:
    """Ten degrees wide, between the diagonals, and too rough to slide in."""
    around = [math.radians(angle) for angle in (50, 40)]
    tips = [(5.0 * math.cos(angle), 5.0 * math.sin(angle)) for angle in around]
    wedge = Polygon([(0, 0), tips[1], (8, -9), (-9, -9), (-9, 8), tips[0]])
    space = space_of([wedge])
    goal = free(5, 5, 5.5, 5.5)
    sides = (RIGHT, UP, LEFT, DOWN)
    found = hopeless(setting_of(space, 5.0, 60.0), goal, sides)
    assert found.contact.vertices.tolist() == [edge_from(space, 0, 0)]
    assert found.area.is_empty
    assert hopeless(setting_of(space, 5.0, 20.0), goal, sides).is_empty
    assert hopeless(setting_of(space, 5.0, 60.0), goal, (*sides, math.radians(45))).is_empty


def test_a_thin_goal_is_reached_with_perfect_control() -> None:
    """A point is reached along a line alone, and the line from all around."""
    space = space_of([FLOOR], [Side.LEFT, Side.RIGHT])
    tip = at_vertex(edge_from(space, -6, 0))
    perfect = setting_of(space, 0.0)
    assert hopeless(perfect, tip, (DOWN, LEFT, RIGHT)).is_empty
    found = hopeless(perfect, free(0, 2, 0.5, 2.5), (DOWN, LEFT))
    assert found.area.contains(-1, 1)
    assert not found.area.contains(1, 5)


def test_nothing_is_found_when_a_limit_comes_first() -> None:
    space = box_space()
    goal = on_edge(space, edge_from(space, 1, 0), 1, 2)
    limits = Limits(None, 1000, cancelled=lambda: True)
    assert hopeless(setting_of(space), goal, (RIGHT, LEFT, DOWN), limits).is_empty


def test_without_a_goal_all_is_hopeless() -> None:
    space = box_space()
    found = hopeless(setting_of(space), Region.empty(), (DOWN,))
    assert found.area.measure == pytest.approx(space.free.measure)


# --- laws -------------------------------------------------------------------------------------


def random_problem(
    seed: int, least: float = 0.0
) -> tuple[Scene, Setting, Region, Directions, Random]:
    """A scene, its target as the goal, and one to five directions."""
    rng = Random(seed)
    scene = random_scene(rng)
    scene = scene._replace(control=max(min(scene.control, 0.8), least))
    errors = Uncertainty(scene.control, 0.1, 0.1, (0.05, 0.05))
    setting = Setting(scene.space, errors, scene.friction, SlidingLaw.PROJECTION, 0.005)
    few = {float(rng.choice((0, 45, 90, 135, 180, 225, 270, 315))) for _ in range(3)}
    few |= {rng.uniform(0, 360) for _ in range(rng.randint(0, 2))}
    goal = Region(
        scene.target.area,
        ContactSet(
            scene.target.contact.edge,
            scene.target.contact.low,
            scene.target.contact.high,
            np.setdiff1d(scene.target.contact.vertices, scene.space.contact.outermost),
        ),
    )
    return scene, setting, goal, tuple(sorted(map(math.radians, few))), rng


def check_closed(seed: int) -> None:
    """No motion along any direction leads out of H but through an open side, and none to G."""
    scene, setting, goal, directions, _ = random_problem(seed)
    assert not isinstance(directions, Continuous)
    found = hopeless(setting, goal, directions)
    assert not meets(found, goal, NEAR), seed
    for direction in directions:
        ahead = forward_project(scene.space, found, direction, scene.control, scene.friction).region
        assert not meets(ahead, goal, NEAR), (seed, direction)


def check_closures(seed: int) -> None:
    """p is hopeless iff all that can be reached from it, by any commands, misses the goal."""
    scene, setting, goal, directions, rng = random_problem(seed, least=1e-3)
    space = scene.space
    found = hopeless(setting, goal, directions)
    for small, wide in pinheads(scene, rng)[:5]:
        if not meets(small, found, 0.0):
            reached, all_of_it = closure(scene, wide, directions)
            assert not all_of_it or meets(reached, goal, -NEAR), (
                seed,
                small.contact.edge,
                small.area,
            )
        if regions.is_subset(wide, found, space.tolerance):
            reached, _ = closure(scene, small, directions)
            assert not meets(reached, goal, 0.0), (seed, small.contact.edge, small.area)


def closure(scene: Scene, start: Region, directions: Directions) -> tuple[Region, bool]:
    """What motions from a start can lead to, one after another, and whether that is all."""
    assert not isinstance(directions, Continuous)
    space, reached = scene.space, start
    for _ in range(ROUNDS):
        before = reached
        for direction in directions:
            ahead = forward_project(space, reached, direction, scene.control, scene.friction).region
            reached = regions.union(reached, ahead, space.tolerance)
        if within(reached, before):
            return reached, True
    return reached, False


def within(a: Region, b: Region) -> bool:
    return (
        a.area.measure <= b.area.measure + NEAR
        and a.contact.total_length <= b.contact.total_length + NEAR
        and len(a.contact.vertices) == len(b.contact.vertices)
    )


def check_walks(seed: int) -> None:
    """From H, whatever is commanded and whatever nature does, the goal is not met."""
    scene, setting, goal, directions, rng = random_problem(seed)
    assert not isinstance(directions, Continuous)
    found = hopeless(setting, goal, directions)
    world = World(scene.space, scene.friction)
    for first in starts(world, found, rng, 4):
        state = first
        for count in range(25):
            assert not world.is_in(goal, state), (seed, first)
            motion = Motion(world, rng.choice(directions), scene.control, goal)
            name = rng.choice(list(ADVERSARIES))
            angle, time = ADVERSARIES[name](motion, state, count, rng)
            moves = world.moves(state, angle, min(time, rng.choice((0.3, 1.0, math.inf))))
            if not moves:
                continue
            move = pick(name, moves, rng)
            assert not on_the_way(move, goal, NEAR), (seed, first)
            if isinstance(move.end, Lost) or world.escaped(move.end):
                break
            state = move.end


def test_a_place_is_hopeless_iff_its_forward_closure_misses_the_goal() -> None:
    for seed in range(8):
        check_closures(seed)


def test_walks_from_hopeless_places_never_come_to_the_goal() -> None:
    for seed in range(ROUNDS):
        check_walks(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(5))
def test_closures_at_length(block: int) -> None:
    for seed in range(1000 + block * 100, 1100 + block * 100):
        check_closures(seed)
        check_closed(seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(5))
def test_walks_at_length(block: int) -> None:
    for seed in range(1000 + block * 200, 1200 + block * 200):
        check_walks(seed)
