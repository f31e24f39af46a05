"""What is told apart, and what several goals tell together, against the plain definitions."""

import math
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.recognition.confusion import told_apart, told_together
from preimage.recognition.interpretation import Interpretation, contained
from preimage.recognition.outside import outside
from preimage.recognition.readings import alike, readings
from preimage.task.uncertainty import Uncertainty
from tests.recognition.cases import Case, random_case
from tests.strategies import random_target

seeds = st.integers(0, 2**32 - 1)
POSITIONS = (0.0, 0.1, 0.5, math.inf)


def places(case: Case, part: ContactSet, count: int) -> list[tuple[int, np.ndarray]]:
    """Points of a part of contact space, with their features."""
    contact = case.space.contact
    n = len(contact)
    found = []
    for edge, low, high in zip(part.edge, part.low, part.high, strict=True):
        for distance in np.linspace(low, high, count)[1:-1]:
            found.append((int(edge), contact.at(np.array([edge]), np.array([distance]))[0]))
    return found + [(n + int(vertex), contact.points[vertex]) for vertex in part.vertices]


def senses(case: Case, position: float) -> Uncertainty:
    own = case.senses
    return Uncertainty(own.control, position, own.force_angle, own.force_thresholds)


def another(case: Case, seed: int) -> Region:
    return random_target(Random(seed + 1), case.space, case.direction, seed % 2 == 0)


@given(seeds, st.sampled_from(POSITIONS))
@settings(max_examples=40, deadline=None)
def test_what_is_told_apart_is_read_nowhere_else(seed: int, position: float) -> None:
    case = random_case(seed)
    uncertainty, near = senses(case, position), case.space.tolerance.length
    part = case.target.contact
    others = contact_set.difference(another(case, seed).contact, part, near)
    told = told_apart(case.space, case.readings, part, others, uncertainty)
    assert contact_set.is_subset(told, part, near)
    gone = contact_set.difference(part, told, near)
    rest = places(case, others, 40)
    reach = 2.0 * max(position, near)
    features = np.array([feature for feature, _ in rest], dtype=np.intp)
    points = np.array([point for _, point in rest]).reshape(-1, 2)

    def nearest(feature: int, point: np.ndarray) -> float:
        """How near something is that reads alike."""
        confused = points[alike(case.readings, feature, features)] if len(rest) else points
        return float(np.min(np.hypot(*(confused - point).T), initial=math.inf))

    for feature, point in places(case, told, 12):
        found = nearest(feature, point)
        assert found >= reach if math.isfinite(reach) else math.isinf(found)
    if math.isinf(position):
        for feature, point in places(case, gone, 3):
            assert math.isfinite(nearest(feature, point))
        return
    step = float(np.max(others.high - others.low, initial=0.0)) / 39
    for feature, point in places(case, gone, 12):  # nothing goes without a cause
        assert nearest(feature, point) <= reach + step + 4.0 * near


def some_readings(case: Case, vertex: int) -> list[float | None]:
    """What can be read at a vertex: 0, and forces, the ends of intervals among them."""
    known = case.readings
    feature = known.size + vertex
    own: list[float | None] = [None] if known.zero[feature] else []
    center, half = float(known.center[feature]), float(known.half[feature])
    if half < 0.0:
        return own
    angles = [*np.linspace(center - half, center + half, 41)]
    for other in np.flatnonzero(known.half >= 0.0).tolist():
        for sign in (-1.0, 1.0):
            end = float(known.center[other]) + sign * float(known.half[other])
            angles += [end - 1e-7, end, end + 1e-7]
    return own + [
        angle for angle in angles if abs((angle - center + math.pi) % math.tau - math.pi) <= half
    ]


def check_together(case: Case, goals: list[Region], position: float, seed: int) -> int:
    """Wherever q and whatever f is read at a vertex that is told, some goal holds K(q, f)."""
    uncertainty = senses(case, position)
    space = case.space
    candidates = np.unique(np.concatenate([goal.contact.vertices for goal in goals]))
    found = told_together(space, case.readings, goals, candidates.astype(np.int32), uncertainty)
    rests = [outside(space, goal, None) for goal in goals]
    rng = np.random.default_rng(seed)
    for vertex in found.tolist():
        point = space.contact.points[vertex]
        for force in some_readings(case, vertex):
            features = case.readings.can_read(force)
            for _ in range(2):
                off, turn = rng.choice((0.0, 0.5, 0.999)), rng.uniform(0.0, math.tau)
                far = off * position if math.isfinite(position) else 3.0
                q = (float(point[0] + far * np.cos(turn)), float(point[1] + far * np.sin(turn)))
                told = Interpretation(q, position, features)
                assert any(contained(space, case.readings, told, rest) for rest in rests)
    return len(found)


@given(seeds, st.sampled_from(POSITIONS), st.integers(1, 3))
@settings(max_examples=40, deadline=None)
def test_at_vertices_that_are_told_some_goal_holds_all(
    seed: int, position: float, many: int
) -> None:
    case = random_case(seed)
    goals = [case.target, *(another(case, seed + place) for place in range(many - 1))]
    check_together(case, goals, position, seed)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 400, 100))
def test_vertices_that_are_told_in_many_scenes(first: int) -> None:
    count = 0
    for seed in range(first, first + 100):
        case = random_case(seed)
        for position in POSITIONS:
            count += check_together(case, [case.target, another(case, seed)], position, seed)
    assert count


@given(seeds)
@settings(max_examples=25, deadline=None)
def test_nothing_is_told_apart_from_itself_and_all_from_nothing(seed: int) -> None:
    case = random_case(seed)
    part, near = case.target.contact, case.space.tolerance.length
    none = ContactSet.empty()
    assert told_apart(case.space, case.readings, part, none, case.senses) is part
    mute = Uncertainty(case.senses.control, math.inf, 0.0, (math.inf, math.inf))
    dumb = readings(case.space.contact, case.direction, mute, case.friction, case.space.tolerance)
    others = contact_set.difference(case.space.valid.contact, part, near)
    if not others.is_empty:
        assert told_apart(case.space, dumb, part, others, mute).is_empty
