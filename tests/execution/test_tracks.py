"""When tracks come back: the exact first instant, against sampling and closed forms."""

import math
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.execution.nearest import nearest
from preimage.execution.tracks import Tracks, first_return, where


def tracks_of(*robots: list[tuple[float, float, float]]) -> Tracks:
    """Robots that are at (x, y) at time t, given as (t, x, y)."""
    rows = np.array([row for robot in robots for row in robot])
    count = len(rows)
    return Tracks(
        np.cumsum([0, *(len(robot) for robot in robots)]).astype(np.int64),
        np.ascontiguousarray(rows[:, 0]),
        np.ascontiguousarray(rows[:, 1:]),
        np.arange(count, dtype=np.int32),
        np.arange(count, dtype=np.int32) + 100,
        np.zeros(count),
        np.zeros((count, 2)),
        np.zeros(count),
    )


def at(robot: list[tuple[float, float, float]], time: float) -> tuple[float, float]:
    times = [row[0] for row in robot]
    return (
        float(np.interp(time, times, [row[1] for row in robot])),
        float(np.interp(time, times, [row[2] for row in robot])),
    )


def random_robot(rng: Random) -> list[tuple[float, float, float]]:
    time, x, y = 0.0, rng.uniform(-1, 1), rng.uniform(-1, 1)
    found = [(time, x, y)]
    for _ in range(rng.randrange(1, 9)):
        time += rng.choice((0.0, 0.1, 0.5, rng.random()))
        if time > found[-1][0] and rng.random() < 0.7:
            x, y = x + rng.uniform(-0.5, 0.5), y + rng.uniform(-0.5, 0.5)
        found.append((time, x, y))
    return found


@given(st.integers(0, 10**9))
@settings(max_examples=200, deadline=None)
def test_the_first_return_is_that_of_sampling(seed: int) -> None:
    rng = Random(seed)
    robots = [random_robot(rng) for _ in range(3)]
    period, reach = rng.choice((0.1, 0.5, 1.0)), rng.choice((0.0, 0.05, 0.3))
    found = first_return(tracks_of(*robots), period, np.full(3, reach))
    for robot, first in zip(robots, found.tolist(), strict=True):
        instants = np.arange(period, robot[-1][0], 0.003)
        gaps = [math.dist(at(robot, t), at(robot, t - period)) for t in instants.tolist()]
        near = [t for t, gap in zip(instants.tolist(), gaps, strict=True) if gap <= reach]
        if near:
            assert first <= near[0] + 1e-9
        if math.isfinite(first):
            assert period - 1e-12 <= first <= robot[-1][0] + 1e-9
            assert math.dist(at(robot, first), at(robot, first - period)) <= reach + 1e-9
            assert all(t >= first - 0.003 - 1e-9 for t in near[:1])


def test_closed_forms() -> None:
    stopped = [(0.0, 0.0, 0.0), (4.0, 4.0, 0.0), (9.0, 4.0, 0.0)]
    steady = [(0.0, 0.0, 0.0), (9.0, 9.0, 0.0)]
    short = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    found = first_return(tracks_of(stopped, steady, short), 2.0, np.full(3, 0.5))
    assert found[0] == pytest.approx(5.5)  # then it was half a unit before its stop
    assert found[1:].tolist() == [math.inf, math.inf]
    at_once = first_return(tracks_of(short), 1.0, np.zeros(1))
    assert at_once.tolist() == [1.0]
    assert first_return(tracks_of(stopped), 2.0, np.full(1, -1.0)).tolist() == [math.inf]


def test_where_a_robot_was_between_two_instants() -> None:
    tracks = tracks_of([(0.0, 0.0, 0.0), (2.0, 2.0, 0.0), (3.0, 2.0, 1.0)], [(0.0, 5.0, 5.0)])
    places, feature, index = where(tracks, np.array([0, 0, 1]), np.array([1.0, 2.0, 7.0]))
    assert places.tolist() == [[1.0, 0.0], [2.0, 0.0], [5.0, 5.0]]
    assert feature.tolist() == [100, 1, 3]
    assert index.tolist() == [0, 1, 3]


def test_the_nearest_of_no_segments_is_nowhere() -> None:
    assert np.all(np.isnan(nearest(np.zeros((2, 2)), np.empty((0, 4)))))


@given(st.integers(0, 10**9))
@settings(max_examples=50, deadline=None)
def test_the_nearest_point_is_no_further_than_any_other(seed: int) -> None:
    rng = np.random.default_rng(seed)
    segments, points = rng.integers(-3, 4, (5, 4)).astype(float), rng.normal(size=(4, 2))
    found = nearest(points, segments)
    share = np.linspace(0.0, 1.0, 200)[:, None, None]
    along = segments[:, :2] + share * (segments[:, 2:] - segments[:, :2])
    for point, place in zip(points, found, strict=True):
        least = float(np.hypot(*(along - point).T).min())
        assert math.dist(point, place) <= least + 1e-9
        assert math.dist(point, place) >= least - 0.05
