"""The compiled damper against the test suite's own world, and against its own laws."""

import math
from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.execution.simulator import Choices, Manner, Robots, Simulator, Wish, advance
from preimage.geometry.area import Area
from preimage.task.task import SlidingLaw
from tests.execution.scenes import agree, chosen, somewhere, state_of
from tests.laws.world import AtVertex, Doing, Lost, OnEdge, World
from tests.strategies import random_space, space_of

TIME = 4.0

MANNERS = {Doing.FLIES: Manner.FLIES, Doing.SLIDES: Manner.SLIDES, Doing.STICKS: Manner.RESTS}


def compare(seed: int) -> int:
    """Every move is one of those that the rules allow, and with every wish one that it asks for."""
    rng = Random(seed)
    space = random_space(rng, lattice=rng.random() < 0.5)
    friction = rng.choice((0.0, 0.2, 0.6, math.pi / 2))
    law = rng.choice(list(SlidingLaw))
    simulator, world = Simulator.of(space, friction, law), World(space, friction, law)
    robots = somewhere(space, rng, 12)
    choices = chosen(rng, len(robots))
    moves = advance(simulator, robots, choices)
    count = 0
    for i in range(len(robots)):
        state = state_of(space, robots, i)
        angle, duration = float(choices.angle[i]), float(choices.duration[i])
        if is_tie(world, state, angle):
            continue
        allowed = world.moves(state, angle, duration)
        end = (
            Lost.ESCAPED if moves.manner[i] == Manner.ESCAPES else state_of(space, moves.robots, i)
        )
        fitting = [
            move
            for move in allowed
            if agree(space, end, move.end, 1e-6)
            and (moves.manner[i] in (MANNERS[move.doing], Manner.ESCAPES))
        ]
        assert fitting, (seed, i, state, angle, end, allowed)
        wanted = {Wish.REST: Doing.STICKS, Wish.SLIDE: Doing.SLIDES, Wish.LEAVE: Doing.FLIES}
        wish = wanted.get(Wish(int(choices.wish[i])))
        if wish in {move.doing for move in allowed}:
            assert any(move.doing is wish for move in fitting)
        if math.isfinite(fitting[0].time) or moves.manner[i] != Manner.RESTS:
            assert moves.time[i] == pytest.approx(fitting[0].time, rel=1e-6, abs=1e-6)
        count += 1
    return count


def is_tie(world: World, state: object, angle: float) -> bool:
    """Whether a direction is at the rim of a friction cone, or along an edge that it leaves."""
    match state:
        case OnEdge(edge, _):
            edges: tuple[int, ...] = (edge,)
        case AtVertex(vertex):
            edges = (vertex, world.previous[vertex])
        case _:
            return False
    rims = (world.friction, math.pi / 2)
    return any(abs(abs(world.pressing(edge, angle)) - rim) < 1e-7 for edge in edges for rim in rims)


@given(st.integers(0, 10**9))
@settings(max_examples=150, deadline=None)
def test_moves_are_those_of_the_rules(seed: int) -> None:
    compare(seed)


def test_most_states_are_compared() -> None:
    assert sum(compare(seed) for seed in range(20)) > 300


@given(st.integers(0, 10**9))
@settings(max_examples=100, deadline=None)
def test_no_step_size_leads_through_a_wall(seed: int) -> None:
    rng = Random(seed)
    space = random_space(rng, lattice=rng.random() < 0.5)
    simulator = Simulator.of(space, rng.choice((0.0, 0.3)))
    robots = somewhere(space, rng, 8)
    longest = rng.choice((1e-9, 1e-3, 1.0, math.inf))
    solid = shapely.buffer(space.obstacles.geometry, -1e-7)
    for _ in range(10):
        moves = advance(simulator, robots, chosen(rng, len(robots), longest))
        paths = shapely.linestrings(np.stack((robots.places, moves.robots.places), axis=1))
        assert not np.any(shapely.intersects(paths, solid))
        robots = moves.robots.part(moves.manner != Manner.ESCAPES)
        if not len(robots):
            return


@given(st.integers(0, 10**9))
@settings(max_examples=50, deadline=None)
def test_many_small_moves_are_one_large_one(seed: int) -> None:
    """With one direction and one wish, interruptions change nothing."""
    rng = Random(seed)
    space = random_space(rng, lattice=False)
    simulator = Simulator.of(space, 0.3)
    robots = somewhere(space, rng, 4)
    count = len(robots)
    angle = np.array([rng.uniform(-math.pi, math.pi) for _ in range(count)])
    chance, wish = np.zeros(count), np.full(count, Wish.SLIDE, dtype=np.uint8)

    def go(step: float) -> tuple[Robots, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
        now, left, gone = robots, np.full(count, 6.0), np.zeros(count, dtype=np.bool_)
        while np.any(left > 1e-9):
            moves = advance(simulator, now, Choices(angle, np.minimum(step, left), wish, chance))
            live = (left > 1e-9) & ~gone
            merged = now.part(np.ones(count, dtype=np.bool_))
            merged.put(np.flatnonzero(live), moves.robots.part(live))
            gone |= live & (moves.manner == Manner.ESCAPES)
            left = np.where(live, left - np.maximum(moves.time, 1e-7), 0.0)
            now = merged
        return now, gone

    (large, escaped), (small, lost) = go(math.inf), go(0.37)
    assert escaped.tolist() == lost.tolist()
    gap = np.hypot(*(large.places - small.places).T)
    assert np.all((gap < 1e-5) | escaped)


def naive_end(
    space: ConfigurationSpace,
    start: tuple[float, float],
    angle: float,
    friction: float,
    step: float,
) -> tuple[float, float]:
    """A small-step integrator that knows obstacles as an area alone."""
    solid = shapely.difference(shapely.box(*space.window).buffer(1.0), space.free.geometry)
    border = space.free.geometry.boundary
    x, y = start
    ux, uy = math.cos(angle), math.sin(angle)
    for _ in range(round(TIME / step)):
        nx, ny = x + step * ux, y + step * uy
        if not shapely.intersects_xy(solid, nx, ny):
            x, y = nx, ny
            continue
        # push back out along the shortest way, and take friction off what is left of the step
        out = shapely.get_coordinates(shapely.shortest_line(shapely.Point(nx, ny), border))[1]
        px, py = out[0] - nx, out[1] - ny
        depth = math.hypot(px, py)
        if depth == 0.0:
            continue
        px, py = px / depth, py / depth
        tangent = (-py, px)
        along = ux * tangent[0] + uy * tangent[1]
        press = -(ux * px + uy * py)
        if math.atan2(abs(along), press) <= friction:
            continue
        x = out[0] + 1e-9 * px
        y = out[1] + 1e-9 * py
    return x, y


def exact_end(
    space: ConfigurationSpace, start: tuple[float, float], angle: float, friction: float
) -> tuple[float, float] | None:
    """Where the same motion ends by events; None if it leaves the window."""
    simulator = Simulator.of(space, friction)
    robots, left = Robots.free(space.contact, np.array([start])), TIME
    wish, chance = np.full(1, Wish.SLIDE, dtype=np.uint8), np.zeros(1)
    while left > 1e-9:
        moves = advance(
            simulator, robots, Choices(np.array([angle]), np.array([left]), wish, chance)
        )
        if moves.manner[0] == Manner.ESCAPES:
            return None
        robots, left = moves.robots, left - float(moves.time[0])
    return float(robots.x[0]), float(robots.y[0])


@pytest.mark.parametrize("block", range(4))
def test_a_naive_integrator_converges_to_it(block: int) -> None:
    """On random scenes, as the step goes to zero."""
    compared = 0
    for seed in range(100 * block, 100 * block + 12):
        rng = Random(seed)
        space = random_space(rng, lattice=False)
        robots = somewhere(space, rng, 6)
        free = robots.part(robots.feature == 2 * len(space.contact))
        angle, friction = rng.uniform(-math.pi, math.pi), rng.choice((0.0, 0.15))
        for start in [(float(x), float(y)) for x, y in free.places[:2]]:
            exact = exact_end(space, start, angle, friction)
            if exact is None:
                continue
            gaps = [
                math.dist(exact, naive_end(space, start, angle, friction, step))
                for step in (0.02, 0.001)
            ]
            assert gaps[1] < 0.01, (seed, start, gaps)
            assert gaps[1] <= gaps[0] + 1e-6, (seed, start, gaps)
            compared += 1
    assert compared >= 5


def test_closed_forms() -> None:
    """Heights and speeds on a slope of 45 degrees."""
    space = space_of([shapely.Polygon([(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0)])])
    down = np.array([-math.pi / 2])
    robots = Robots.free(space.contact, np.array([[0.0, 3.0]]))
    any_ = (np.zeros(1, dtype=np.uint8), np.zeros(1))
    landed = advance(Simulator.of(space, 0.2), robots, Choices(down, np.array([np.inf]), *any_))
    assert landed.robots.places[0].tolist() == pytest.approx([0.0, 0.0], abs=1e-9)
    assert landed.time[0] == pytest.approx(3.0)
    speeds = {
        SlidingLaw.PROJECTION: math.sin(math.pi / 4),
        SlidingLaw.DAMPER: math.sin(math.pi / 4 - 0.2) / math.cos(0.2),
    }
    for law, speed in speeds.items():
        slid = advance(
            Simulator.of(space, 0.2, law), landed.robots, Choices(down, np.ones(1), *any_)
        )
        assert slid.manner[0] == Manner.SLIDES
        gone = math.dist(slid.robots.places[0], landed.robots.places[0])
        assert gone == pytest.approx(speed)
    held = advance(Simulator.of(space, 0.8), landed.robots, Choices(down, np.ones(1), *any_))
    assert held.manner[0] == Manner.RESTS
    assert held.time[0] == 1.0


def test_moves_are_interrupted_at_the_borders_of_what_is_watched() -> None:
    space = space_of([shapely.box(-5.0, -5.0, 5.0, -4.0)])
    top = int(
        np.argmax(
            np.isclose(space.contact.points[:, 1], -4.0)
            & np.isclose(space.contact.ends[:, 1], -4.0)
        )
    )
    watched = Region(Area.box(-1.0, 0.0, 1.0, 1.0), ContactSet.of([top], [2.0], [3.0], [], 1e-9))
    simulator = Simulator.of(space, 0.0, watched=watched)
    robots = Robots.free(space.contact, np.array([[0.0, 4.0]]))
    heights = []
    for _ in range(3):
        moves = advance(
            simulator,
            robots,
            Choices(
                np.array([-math.pi / 2]), np.array([np.inf]), np.zeros(1, np.uint8), np.zeros(1)
            ),
        )
        robots = moves.robots
        heights.append(float(robots.y[0]))
    assert heights == pytest.approx([1.0, 0.0, -4.0], abs=1e-6)
    sliding = Robots.on_edges(space.contact, np.array([top], np.int32), np.array([1.0]))
    places = []
    slant = np.array([float(space.contact.normal[top]) - 0.5 * math.pi - 0.3])
    for _ in range(2):
        moves = advance(
            simulator,
            sliding,
            Choices(slant, np.array([np.inf]), np.zeros(1, np.uint8), np.zeros(1)),
        )
        sliding = moves.robots
        places.append(float(sliding.along[0]))
    assert places == pytest.approx([2.0, 3.0], abs=1e-6)


def test_a_move_that_begins_on_a_border_is_interrupted_just_inside() -> None:
    """An edge may be watched without the vertex at its end, an area without the edge below it."""
    space = space_of([shapely.box(-6.0, -6.0, 2.0, -4.0), shapely.box(2.0, -6.0, 6.0, 6.0)])
    contact = space.contact
    floor = int(
        np.argmax(np.isclose(contact.points[:, 1], -4.0) & np.isclose(contact.ends[:, 1], -4.0))
    )
    length = float(contact.length[floor])
    watched = Region(
        Area.box(-3.0, -4.0, 1.0, 0.0), ContactSet.of([floor], [0.0], [length], [], 1e-9)
    )
    simulator = Simulator.of(space, 0.0, watched=watched)
    near = space.tolerance.length

    def step(robots: Robots, angle: float) -> Robots:
        choices = Choices(np.array([angle]), np.array([np.inf]), np.zeros(1, np.uint8), np.zeros(1))
        return advance(simulator, robots, choices).robots

    ends_of = (floor, int(contact.next[floor]))
    corner = next(v for v in ends_of if contact.points[v, 0] > 0.0)
    slid = step(Robots.at_vertices(contact, np.array([corner], np.int32)), math.radians(225.0))
    assert slid.feature[0] == floor
    ends = 0.0 if corner == floor else length
    assert near < abs(float(slid.along[0]) - ends) < 10.0 * near
    again = step(slid, math.radians(225.0))
    assert abs(float(again.along[0]) - ends) > 1.0
    middle = Robots.on_edges(contact, np.array([floor], np.int32), np.array([0.5 * length]))
    flown = step(middle, math.radians(90.0))
    assert near < float(flown.y[0]) + 4.0 < 10.0 * near
    assert float(step(flown, math.radians(90.0)).y[0]) == pytest.approx(0.0, abs=1e-6)
