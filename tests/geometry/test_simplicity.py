"""Against a slow oracle in exact arithmetic, on a small lattice where all is degenerate."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from preimage.geometry.simplicity import (
    Fault,
    chain_fault,
    counterclockwise,
    crowd_fault,
    hole_fault,
    ring_fault,
    thin_fault,
)

LatticePoint = tuple[int, int]


def one(points: object) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    array = np.array(points, dtype=np.float64).reshape(-1, 2)
    return array, np.array([0, len(array)])


def turn(a: LatticePoint, b: LatticePoint, c: LatticePoint) -> int:
    cross = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (cross > 0) - (cross < 0)


def between(a: LatticePoint, b: LatticePoint, c: LatticePoint) -> bool:
    return (
        turn(a, b, c) == 0
        and min(a[0], b[0]) <= c[0] <= max(a[0], b[0])
        and min(a[1], b[1]) <= c[1] <= max(a[1], b[1])
    )


def meet(a: LatticePoint, b: LatticePoint, c: LatticePoint, d: LatticePoint) -> bool:
    return (
        (turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0)
        or between(a, b, c)
        or between(a, b, d)
        or between(c, d, a)
        or between(c, d, b)
    )


def guilty_pairs(points: list[LatticePoint], closed: bool) -> set[tuple[int, int]]:
    """All pairs of edges that share more than the vertex between them."""
    count = len(points)
    edges = [(points[i], points[(i + 1) % count]) for i in range(count if closed else count - 1)]
    pairs = set()
    for i, j in itertools.combinations(range(len(edges)), 2):
        (a, b), (c, d) = edges[i], edges[j]
        if b == c and j == i + 1:
            wrong = between(a, b, d) or between(c, d, a)
        elif closed and d == a and i == 0 and j == count - 1:
            wrong = between(a, b, c) or between(c, d, b)
        else:
            wrong = meet(a, b, c, d)
        if wrong:
            pairs.add((i, j))
    return pairs


lattice = st.tuples(st.integers(0, 4), st.integers(0, 4))


def lists(least: int) -> st.SearchStrategy[list[LatticePoint]]:
    return st.lists(lattice, min_size=least, max_size=8).filter(
        lambda points: all(a != b for a, b in itertools.pairwise(points))
    )


@settings(max_examples=600)
@given(lists(3).filter(lambda points: points[0] != points[-1]))
def test_rings_agree_with_the_oracle(points: list[LatticePoint]) -> None:
    pairs = guilty_pairs(points, closed=True)
    fault = ring_fault(*one(points))
    if fault is None:
        assert not pairs
        return
    words = fault.rule.split()
    assert (int(words[1]), int(words[3])) == min(pairs)


@settings(max_examples=600)
@given(lists(2))
def test_chains_agree_with_the_oracle(points: list[LatticePoint]) -> None:
    (ax, ay), (bx, by) = points[0], points[1]
    (cx, cy), (dx, dy) = points[-2], points[-1]
    # Far beyond where two rays of such slopes can meet.
    first = (ax + 1000 * (ax - bx), ay + 1000 * (ay - by))
    last = (dx + 1000 * (dx - cx), dy + 1000 * (dy - cy))
    pairs = guilty_pairs([first, *points, last], closed=False)
    rule = chain_fault(one(points)[0])
    assert (rule is not None) == bool(pairs), rule


@given(lists(3).filter(lambda points: points[0] != points[-1]))
def test_orientation(points: list[LatticePoint]) -> None:
    if ring_fault(*one(points)) is None:
        twice = sum(
            x * v - u * y for (x, y), (u, v) in zip(points, [*points[1:], points[0]], strict=True)
        )
        assert bool(counterclockwise(*one(points))[0]) == (twice > 0)


@pytest.mark.parametrize(
    ("points", "rule"),
    [
        ([(0, 0), (1, 0)], "must have 3 vertices or more, not 2"),
        ([(0, 0), (1, 0), (1, 1), (0, 0)], "the last vertex repeats the first one: leave it out"),
        ([(0, 0), (1, 0), (1, 0), (1, 1)], "vertices 1 and 2 are the same"),
        ([(0, 0), (4, 4), (4, 0), (0, 4)], "edges 0 and 2 cross"),
        ([(0, 0), (4, 0), (2, 0), (2, 2)], "edges 0 and 1 turn back on each other"),
        ([(0, 0), (2, 0), (4, 0)], "edges 0 and 2 turn back on each other"),
        ([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], "edges 0 and 2 touch"),
        ([(0, 0), (4, 0), (4, 1), (3, 0), (1, 0), (0, 1)], "edges 0 and 2 touch"),
        ([(0, 0), (4, 0), (5, 3), (5, 0), (3, 0), (3, -4)], "edges 0 and 3 overlap"),
    ],
)
def test_says_what_is_wrong_with_a_ring(points: list[LatticePoint], rule: str) -> None:
    assert ring_fault(*one(points)) == Fault(0, rule)


def test_names_the_first_wrong_ring() -> None:
    triangle = [(0, 0), (1, 0), (0, 1)]
    bowtie = [(0, 0), (4, 4), (4, 0), (0, 4)]
    points, _ = one([*triangle, *bowtie, *bowtie])
    fault = ring_fault(points, np.array([0, 3, 7, 11]))
    assert fault == Fault(1, "edges 0 and 2 cross")


def test_no_rings_have_no_fault() -> None:
    assert ring_fault(np.empty((0, 2)), np.array([0])) is None
    assert thin_fault(np.empty((0, 2)), np.array([0]), 1.0) is None


@pytest.mark.parametrize(
    ("points", "rule"),
    [
        ([(0, 0)], "must have 2 points or more, not 1"),
        ([(0, 0), (0, 0)], "points 0 and 1 are the same"),
        ([(0, 0), (1, 1)], None),
        ([(0, 5), (0, 0), (5, 0), (5, 5)], None),
        (
            [(-1, 5), (0, 0), (5, 0), (4, -5), (2, -5), (2, 3)],
            "edge 1 and edge 4 cross",
        ),
        (
            [(1, 5), (0, 0), (5, 0), (4, 5)],
            "the ray before the first vertex and the ray after the last vertex cross",
        ),
        (
            [(1, 5000), (0, 0), (5000, 0), (4999, 5000)],
            "the ray before the first vertex and the ray after the last vertex cross",
        ),
        ([(0, 0), (2, 0), (2, 2), (2, 1)], "edge 0 and the ray after the last vertex touch"),
        (
            [(0, 0), (1, 0), (1, 1), (-3, 1), (-3, 0), (-2, 0)],
            "the ray before the first vertex and edge 3 touch",
        ),
    ],
)
def test_says_what_is_wrong_with_a_chain(points: list[LatticePoint], rule: str | None) -> None:
    assert chain_fault(one(points)[0]) == rule


def test_all_but_parallel_rays_do_not_meet() -> None:
    angle = 0.3
    turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    points = one([(0, 5), (0, 0), (5, 0), (5, 7)])[0] @ turned.T
    assert chain_fault(points) is None


SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])


@pytest.mark.parametrize(
    ("holes", "fault"),
    [
        ([0.2 * SQUARE + 1.0, 0.2 * SQUARE + 5.0], None),
        ([0.2 * SQUARE + 1.0, 0.2 * SQUARE + 3.0], None),  # a corner in common
        ([0.2 * SQUARE + 20.0], Fault(0, "is not inside the polygon")),
        ([0.5 * SQUARE + [2.5, -1.0]], Fault(0, "edge 1 crosses edge 0 of the polygon")),
        ([0.2 * SQUARE + [2.5, 0.0]], Fault(0, "edge 0 overlaps edge 0 of the polygon")),
        (
            [0.5 * SQUARE + 1.0, 0.2 * SQUARE + [5.0, 2.0]],
            Fault(1, "edge 0 crosses edge 1 of holes[0]"),
        ),
        (
            [0.2 * SQUARE + 1.0, 0.2 * SQUARE + [3.0, 2.0]],
            Fault(1, "edge 3 overlaps edge 1 of holes[0]"),
        ),
        ([0.5 * SQUARE + 1.0, 0.1 * SQUARE + 2.0], Fault(1, "overlaps holes[0]")),
        (
            [np.array([[5.0, 0.0], [6.0, 5.0], [5.0, 10.0], [4.0, 5.0]])],
            Fault(0, "the holes cut the polygon into separate parts"),
        ),
    ],
)
def test_holes(holes: list[NDArray[np.float64]], fault: Fault | None) -> None:
    assert hole_fault(SQUARE, holes) == fault


@pytest.mark.parametrize(
    ("points", "closed", "rule"),
    [
        ([(0, 0), (4, 0), (4, 3)], True, None),
        (
            [(0, 0), (4, 0), (4, 1e-10)],
            True,
            "the edge at (4, 0) is 1e-10 long, too short for the window to resolve",
        ),
        ([(0, 0), (4, 0), (8, 0), (4, 1e-10)], True, "turns back at (8, 0)"),
        ([(0, 0), (4, 0), (1, 1e-10)], False, "turns back at (4, 0)"),
        ([(0, 0), (4, 0), (8, 1e-10)], False, None),
        ([(0, 0)], False, None),
    ],
)
def test_thin_places(points: object, closed: bool, rule: str | None) -> None:
    fault = thin_fault(*one(points), 1e-9, closed)
    assert fault == (rule and Fault(0, rule))


def test_crowds_are_refused_and_long_simple_rings_are_not() -> None:
    count = 100_000
    angles = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    assert crowd_fault(*one(circle), np.array([0, 1])) is None
    assert ring_fault(*one(circle)) is None
    spikes = circle * np.where(np.arange(count) % 2, 1.0, 0.01)[:, None]
    fault = Fault(0, "too many edges lie side by side to be checked")
    assert crowd_fault(*one(spikes), np.array([0, 1])) == fault


def test_crowds_add_up() -> None:
    # Each group has some 20,000 edges whose boxes all overlap, in two rings.
    slanted = np.array([[index % 2, index % 2 + 1e-4 * index] for index in range(10_000)])
    points = np.tile(slanted, (20, 1))
    offsets = np.arange(0, len(points) + 1, len(slanted))
    fault = crowd_fault(points, offsets, np.arange(0, 21, 2))
    assert fault is not None
    assert 2 <= fault.ring <= 9
