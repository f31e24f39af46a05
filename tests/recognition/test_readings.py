"""Reading sets against their definition, sampled, and by known cases."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.configuration.contact import ContactSpace
from preimage.geometry.angles import wrap
from preimage.geometry.tolerance import Tolerance
from preimage.recognition.readings import Readings, alike, readings
from preimage.task.uncertainty import Uncertainty

DOWN = -math.pi / 2
TOLERANCE = Tolerance.for_window(-10, -10, 10, 10)
SENSES = Uncertainty(math.radians(10), 0.3, math.radians(5), (0.05, 0.05))


def loop(*points: tuple[float, float], open_edges: tuple[int, ...] = ()) -> ContactSpace:
    """A single loop with free space on its left."""
    n = len(points)
    following = np.roll(np.arange(n, dtype=np.int32), -1)
    return ContactSpace(np.array(points, dtype=float), following, np.isin(np.arange(n), open_edges))


def read(
    space: ContactSpace,
    senses: Uncertainty = SENSES,
    friction: float = math.radians(20),
    direction: float = DOWN,
) -> Readings:
    return readings(space, direction, senses, friction, TOLERANCE)


ROOM = loop((0, 0), (4, 0), (4, 3), (0, 3))
FLOOR, RIGHT, CEILING, LEFT = range(4)


def interval(got: Readings, feature: int) -> list[float]:
    """In degrees, as an angle and a half width."""
    return [math.degrees(got.center[feature]), math.degrees(got.half[feature])]


def test_room() -> None:
    got = read(ROOM)
    assert interval(got, FLOOR) == pytest.approx([90, 15])
    assert interval(got, RIGHT) == pytest.approx([160, 5])  # pushed back on the friction cone
    assert interval(got, LEFT) == pytest.approx([20, 5])
    assert got.half[CEILING] == -np.inf
    assert got.zero[:4].tolist() == [False, True, True, True]
    assert got.zero[got.free]
    assert got.half[got.free] == -np.inf


def test_corner_reads_what_its_edges_read_and_what_lies_between() -> None:
    got = read(ROOM)
    corner = got.size + 1
    assert interval(got, corner) == pytest.approx([(75 + 165) / 2, (165 - 75) / 2])
    assert got.zero[corner]


def test_floor_is_told_from_its_wall_but_not_from_its_corner() -> None:
    senses = replace(SENSES, force_angle=math.radians(20))
    got = read(ROOM, senses)
    told = ~alike(got, FLOOR, np.arange(2 * got.size + 1))
    assert told[[RIGHT, LEFT, CEILING, got.free]].all()
    assert not told[[FLOOR, got.size, got.size + 1]].any()


def test_notch_reads_like_a_floor() -> None:
    """Two walls that meet in a V push back like a floor between them (theory 3)."""
    notch = loop((-2, 2), (0, 0), (2, 2), (5, 2), (5, 5), (-5, 5), (-5, 2))
    got = read(notch, replace(SENSES, force_angle=0.0), 0.0)
    walls, floor, bottom = [0, 1], 3 - 1, got.size + 1
    assert not alike(got, floor, np.array(walls)).any()
    assert alike(got, floor, np.array([bottom]))[0]


def test_without_a_force_sensor_only_0_is_read() -> None:
    got = read(ROOM, Uncertainty(math.radians(10), 0.3))
    assert got.zero.all()
    assert np.all(got.half == -np.inf)
    assert alike(got, FLOOR, np.arange(9)).all()


def test_above_both_thresholds_nothing_can_be_missed() -> None:
    steep = loop((-2, 2), (0, 0), (2, 2), (0, 5))
    low = read(steep, replace(SENSES, force_thresholds=(0.05, 0.3)), 0.0)
    high = read(steep, replace(SENSES, force_thresholds=(0.05, 0.9)), 0.0)
    assert not low.zero[[0, 1]].any()
    assert high.zero[[0, 1]].all()
    assert (high.half[:2] == low.half[:2]).all()


def test_beside_an_open_side_a_vertex_reads_as_its_edge() -> None:
    half_open = loop((0, 0), (4, 0), (4, 3), (0, 3), open_edges=(RIGHT, CEILING))
    got = read(half_open)
    n = got.size
    assert interval(got, n + 1) == interval(got, FLOOR)
    assert interval(got, n + 3) == interval(got, LEFT)
    for nothing in (RIGHT, CEILING, n + 2):
        assert not got.zero[nothing]
        assert not alike(got, nothing, np.arange(2 * n + 1)).any()


def test_ties_count_as_alike() -> None:
    slopes = loop((0, 0), (4, 0), (6, 4), (-2, 4))
    turn = abs(wrap(slopes.normal[0] - slopes.normal[1]))
    exact = replace(SENSES, control=0.0, force_angle=0.0)
    direction = float(slopes.normal[0]) + math.pi
    for error, expected in ((turn / 2, True), (turn / 2 - 1e-6, False)):
        got = read(slopes, replace(exact, force_angle=error), 0.0, direction)
        assert alike(got, 0, np.array([1]))[0] == expected


def test_exact_sensing_tells_normals_that_differ() -> None:
    exact = Uncertainty(0.0, 0.0, 0.0, (0.0, 0.0))
    slopes = loop((0, 0), (4, 0), (6, 4), (2, 4), (2, 5), (-2, 4))
    got = read(slopes, exact, 0.0)
    assert alike(got, 0, np.array([0, 2]))[0]
    assert not alike(got, 0, np.array([1, 5])).any()
    flat = loop((0, 0), (4, 0), (4, -1), (8, -1), (8, 3), (0, 3))
    assert alike(read(flat, exact, 0.0), 0, np.array([2]))[0]


def test_wide_errors_read_every_direction() -> None:
    got = read(ROOM, replace(SENSES, force_angle=math.radians(179)))
    assert got.half[FLOOR] == math.pi
    assert alike(got, LEFT, np.array([RIGHT, FLOOR])).all()


def test_opposite_walls_may_cancel() -> None:
    """At the bottom of a narrow notch the sum of both forces may be too weak to be read."""
    narrow = loop((-0.1, 4), (0, 0), (0.1, 4), (0.1, 5), (-0.1, 5))
    senses = replace(SENSES, control=0.0, force_thresholds=(0.0, 0.01))
    got = read(narrow, senses, 0.0)
    assert not got.zero[[0, 1]].any()
    sideways = read(narrow, replace(senses, force_thresholds=(0.0, 1e-4)), 0.0)
    assert not sideways.zero[got.size + 1]
    # each pushes back by 0.025, both together by twice that times 0.025
    assert got.zero[got.size + 1]


polygons = st.lists(st.floats(0.5, 4.0), min_size=3, max_size=9)


@given(
    polygons,
    st.floats(-math.pi, math.pi),
    st.floats(0.0, 1.4),
    st.floats(0.0, 1.4),
    st.floats(0.0, 1.0),
    st.tuples(st.floats(0, 1.5), st.floats(0, 1.5)).map(lambda w: (min(w), max(w))),
)
def test_every_reading_is_in_the_set(
    radii: list[float],
    direction: float,
    control: float,
    friction: float,
    error: float,
    limits: tuple[float, float],
) -> None:
    """Straight from theory 3, feature by feature, with random choices of nature."""
    turns = np.linspace(0, math.tau, len(radii), endpoint=False)
    space = loop(*[(r * math.cos(t), r * math.sin(t)) for r, t in zip(radii, turns, strict=True)])
    got = read(space, Uncertainty(control, 0.1, error, limits), friction, direction)
    rng = np.random.default_rng(len(radii))
    for offset in rng.uniform(-control, control, 20) if control else [0.0]:
        push = direction + math.pi + offset
        forces = [_force(float(normal), push, friction) for normal in space.normal]
        for i, force in enumerate(forces):
            _assert_readable(got, i, force, error, limits)
            before = forces[int(space.previous[i])]
            corner = got.size + i
            for at_corner in (force, before, force + before):
                _assert_readable(got, corner, at_corner, error, limits)
            if space.concave[i] and _holds(space, i, push, friction):
                _assert_readable(
                    got, corner, np.array([math.cos(push), math.sin(push)]), error, limits
                )


def _force(normal: float, push: float, friction: float) -> np.ndarray:
    a = wrap(push - normal)
    if abs(a) > math.pi / 2:
        return np.zeros(2)
    if abs(a) <= friction:
        return np.array([math.cos(push), math.sin(push)])
    turned = normal + math.copysign(friction, a)
    return math.cos(a) / math.cos(friction) * np.array([math.cos(turned), math.sin(turned)])


def _holds(space: ContactSpace, vertex: int, push: float, friction: float) -> bool:
    first, second = space.normal[space.previous[vertex]], space.normal[vertex]
    turn = (second - first) % math.tau
    return bool(abs(wrap(push - first - turn / 2)) <= turn / 2 + friction)


def _assert_readable(
    got: Readings, feature: int, force: np.ndarray, error: float, limits: tuple[float, float]
) -> None:
    size = math.hypot(*force)
    if size <= limits[1]:
        assert got.can_read(None)[feature]
    if size > limits[0] + 1e-12:
        direction = math.atan2(force[1], force[0])
        for read_as in (direction - 0.999 * error, direction, direction + 0.999 * error):
            assert got.can_read(read_as)[feature]


@given(
    polygons,
    st.floats(0.0, 1.4),
    st.floats(0.0, 1.4),
    st.floats(0.0, 1.0),
    st.lists(st.floats(0, 1.5), min_size=4, max_size=4).map(sorted),
)
def test_sets_grow_with_the_errors(
    radii: list[float], control: float, friction: float, error: float, levels: list[float]
) -> None:
    turns = np.linspace(0.1, 0.1 + math.tau, len(radii), endpoint=False)
    space = loop(*[(r * math.cos(t), r * math.sin(t)) for r, t in zip(radii, turns, strict=True)])
    sharp = Uncertainty(control, 0.1, error, (levels[1], levels[2]))
    blunt = Uncertainty(min(control + 0.1, 1.5), 0.1, min(error + 0.1, 3.0), (levels[0], levels[3]))
    small, large = read(space, sharp, friction), read(space, blunt, friction)
    assert np.all(large.zero | ~small.zero)
    shift = np.abs(wrap(small.center - large.center))
    inside = shift + small.half <= large.half + 1e-9
    assert np.all(inside | (small.half == -np.inf) | (large.half >= math.pi - 1e-12))
