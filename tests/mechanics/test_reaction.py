"""Reaction forces against the table of theory 2, and their sets against dense sampling."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from preimage.geometry.angles import wrap
from preimage.geometry.tolerance import ANGLE
from preimage.mechanics.reaction import (
    Reactions,
    edge_reactions,
    holding_reactions,
    reaction,
    summed_reactions,
)

DOWN = -math.pi / 2
SAMPLES = 4001

normals = st.one_of(
    st.sampled_from([math.radians(d) for d in range(-165, 181, 15)]),
    st.floats(-math.pi, math.pi, exclude_min=True),
)
controls = st.one_of(st.sampled_from([0.0, math.radians(5), math.radians(45)]), st.floats(0.0, 1.5))
frictions = st.one_of(st.sampled_from([0.0, math.radians(20), math.pi / 2]), st.floats(0.0, 1.57))
levels = st.one_of(st.sampled_from([0.0, 0.05, 1.0, math.inf]), st.floats(0.0, 2.0))
thresholds = st.tuples(levels, levels).map(lambda pair: (min(pair), max(pair)))


def offsets(control: float) -> np.ndarray:
    """Offsets of -v* from -v, from end to end of nature's choices."""
    return np.linspace(-control, control, SAMPLES) if control else np.zeros(1)


def force(normal: float, offset: np.ndarray, friction: float) -> np.ndarray:
    """The reaction by the table of theory 2, one row an offset, in axes along and across -v."""
    rows = []
    for t in offset:
        a = wrap(float(t) - normal)
        if abs(a) > math.pi / 2:
            rows.append((0.0, 0.0))
        elif abs(a) <= friction:
            rows.append((math.cos(t), math.sin(t)))
        else:
            turned = normal + math.copysign(friction, a)
            size = math.cos(a) / math.cos(friction)
            rows.append((size * math.cos(turned), size * math.sin(turned)))
    return np.array(rows)


def assert_matches(got: Reactions, forces: np.ndarray, limits: tuple[float, float]) -> None:
    """The set is what samples of it say, up to the distance between samples."""
    size = np.hypot(forces[:, 0], forces[:, 1])
    near = 4e-3
    if np.min(size) <= limits[1] - near:
        assert got.weak[0]
    if np.min(size) > limits[1] + near:
        assert not got.weak[0]
    direction = np.arctan2(forces[:, 1], forces[:, 0])
    surely = direction[size > limits[0] + near]
    if len(surely):
        assert got.low[0] <= np.min(surely) + near
        assert got.high[0] >= np.max(surely) - near
    perhaps = direction[size > limits[0] - near]
    perhaps = perhaps[size[size > limits[0] - near] > 1e-9]
    if len(perhaps):
        if got.low[0] <= got.high[0]:
            assert np.min(perhaps) - 0.01 <= got.low[0]
            assert got.high[0] <= np.max(perhaps) + 0.01
    elif np.max(size) < limits[0] - near:
        assert got.low[0] > got.high[0]


def test_table_of_theory_2() -> None:
    phi = math.radians(30)
    a = np.radians([0, 30, -30, 45, -60, 90, -90, 91, 180, -135])
    turn, size = reaction(a, phi)
    assert np.degrees(turn[:5]) == pytest.approx([0, 30, -30, 30, -30])
    slope = math.cos(phi)
    expected = [1, 1, 1, math.cos(a[3]) / slope, 0.5 / slope, 0, 0, 0, 0, 0]
    assert size == pytest.approx(expected)
    assert size[5] == 0.0


def test_force_balances_the_normal_part_of_the_push() -> None:
    """Paper 3.4: the force lies on the friction cone, with nu . f = nu . -v*."""
    phi = math.radians(25)
    a = np.linspace(-math.pi / 2, math.pi / 2, 181)
    turn, size = reaction(a, phi)
    assert size * np.cos(turn) == pytest.approx(np.cos(a), abs=1e-12)
    assert np.all(np.abs(turn) <= phi)


def test_full_friction_sticks_up_to_the_edge_itself() -> None:
    _, size = reaction(np.radians([0.0, 89.0, 90.0, 90.1]), math.pi / 2)
    assert size.tolist() == [1.0, 1.0, 1.0, 0.0]


@given(normals, controls, frictions, thresholds)
def test_edges(normal: float, control: float, friction: float, limits: tuple[float, float]) -> None:
    got = edge_reactions(np.array([wrap(normal + DOWN + math.pi)]), DOWN, control, friction, limits)
    beta = abs(wrap(normal))
    assume(abs(beta - control - math.pi / 2) > 1e-6)
    assume(friction < 1.55 or friction == math.pi / 2)
    assume(friction < math.pi / 2 or abs(beta + control - math.pi / 2) > 1e-6)
    assert_matches(got, force(normal, offsets(control), friction), limits)


def test_exact_control_gives_one_direction() -> None:
    normal = np.radians([90.0, 60.0, 45.0, 0.0, 180.0, -90.0])
    got = edge_reactions(normal, DOWN, 0.0, math.radians(40), (0.0, 0.0))
    # floors stick; the steep ones slide; walls are merely touched; the ceiling is left
    assert got.weak.tolist() == [False, False, False, True, True, True]
    felt = got.low <= got.high
    assert felt[:3].all()
    assert not felt[5]
    assert np.degrees(got.low[:3]) == pytest.approx([0.0, 0.0, -5.0])
    assert got.high[:3] == pytest.approx(got.low[:3])


def test_paper_5_3_example() -> None:
    """Cones that meet, neither inside the other: magnitudes from cos(alpha + theta) / cos phi."""
    alpha, theta, phi = math.radians(30), math.radians(20), math.radians(25)
    normal = np.array([math.pi / 2 + alpha])
    least = math.cos(alpha + theta) / math.cos(phi)
    weak = [
        edge_reactions(normal, DOWN, theta, phi, (w, w)).weak[0]
        for w in (least - 1e-9, least + 1e-9)
    ]
    assert weak == [False, True]
    got = edge_reactions(normal, DOWN, theta, phi, (0.0, 0.0))
    # from the ray of the friction cone nearest to -v to the ray of the control cone inside it
    assert np.degrees([got.low[0], got.high[0]]) == pytest.approx([5.0, 20.0])


@given(normals, st.floats(0.02, 3.1), controls, frictions, thresholds)
def test_sums(
    first: float, turn: float, control: float, friction: float, limits: tuple[float, float]
) -> None:
    second = wrap(first + turn)
    assume(friction < 1.55)
    for normal in (first, second):  # samples cannot tell a jump at the end from none
        assume(abs(abs(wrap(normal)) - control - math.pi / 2) > 1e-6)
    one, other = (np.array([wrap(n + DOWN + math.pi)]) for n in (first, second))
    got = summed_reactions(one, other, DOWN, control, friction, limits, ANGLE)
    total = sum(force(n, offsets(control), friction) for n in (first, second))
    assert isinstance(total, np.ndarray)
    assert_matches(got, total, limits)


@given(normals, st.floats(0.02, 3.1), controls, frictions)
@example(math.pi, 3.0, 1.2, 1.4)
def test_holding(first: float, turn: float, control: float, friction: float) -> None:
    offset = offsets(control)
    middle = first + turn / 2
    # where the far end of the hull just touches the cone, the answer jumps
    touch = abs(wrap(middle)) + turn / 2 + friction - (2 * math.pi - control)
    assume(abs(touch) > 1e-8)
    one, other = (np.array([wrap(n + DOWN + math.pi)]) for n in (first, first + turn))
    got = holding_reactions(one, other, DOWN, control, friction, (0.0, 0.0), ANGLE)
    off = np.abs(np.array([wrap(float(t) - middle) for t in offset]))
    held = offset[off <= turn / 2 + friction - 1e-9]
    if len(held):
        assert got.low[0] <= held[0] + 1e-9
        assert held[-1] - 1e-9 <= got.high[0]
        step = 2 * control / SAMPLES + 1e-6
        if len(held) == np.count_nonzero((offset >= held[0]) & (offset <= held[-1])):
            assert got.low[0] >= held[0] - step
            assert got.high[0] <= held[-1] + step
    if not np.any(off <= turn / 2 + friction + 1e-9):
        assert got.low[0] > got.high[0]


def test_notch_holds_without_friction() -> None:
    pair = (np.radians([60.0]), np.radians([120.0]))
    got = holding_reactions(*pair, DOWN, math.radians(10), 0.0, (0.1, 0.1))
    assert np.degrees([got.low[0], got.high[0]]) == pytest.approx([-10.0, 10.0])
    assert not got.weak[0]


def test_what_is_too_weak_is_not_felt() -> None:
    pair = (np.radians([60.0]), np.radians([120.0]))
    got = holding_reactions(*pair, DOWN, 0.1, 0.0, (1.0, 1.5))
    assert got.weak[0]
    assert got.low[0] > got.high[0]
