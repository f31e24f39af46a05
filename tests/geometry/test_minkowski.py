"""Minkowski sums against closed forms and against their definition."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from preimage.geometry.area import Area
from preimage.geometry.minkowski import convex_parts, minkowski_sum

Points = NDArray[np.float64]
GRID = 2.0**-36


def convex_sum(a: Points, b: Points) -> Points:
    """The sum of two convex polygons by merging their edges by angle."""

    def from_lowest(points: Points) -> Points:
        lowest = int(np.lexsort((points[:, 0], points[:, 1]))[0])
        return np.roll(points, -lowest, axis=0)

    a, b = from_lowest(a), from_lowest(b)
    edges = np.concatenate([np.roll(points, -1, axis=0) - points for points in (a, b)])
    turn = np.mod(np.arctan2(edges[:, 1], edges[:, 0]) + 1e-12, math.tau)
    steps = np.cumsum(edges[np.argsort(turn, kind="stable")], axis=0)
    corners: Points = a[0] + b[0] + np.concatenate((np.zeros((1, 2)), steps[:-1]))
    return corners


@st.composite
def convex(draw: st.DrawFn) -> Points:
    coordinate = st.integers(-5, 5)
    points = draw(st.lists(st.tuples(coordinate, coordinate), min_size=3, max_size=9, unique=True))
    hull = shapely.MultiPoint(points).convex_hull
    if hull.area == 0.0:
        hull = shapely.box(0, 0, 1, draw(st.integers(1, 3)))
    corners: Points = shapely.get_coordinates(shapely.orient_polygons(hull))[:-1]
    return corners


@st.composite
def any_polygon(draw: st.DrawFn) -> shapely.Polygon:
    """A star-shaped polygon, with a hole or without."""
    count = draw(st.integers(3, 8))
    reach = np.array(draw(st.lists(st.floats(0.5, 3.0), min_size=count, max_size=count)))
    angle = draw(st.floats(0.0, math.tau)) + math.tau * np.arange(count) / count
    ring = np.column_stack((reach * np.cos(angle), reach * np.sin(angle)))
    ring += draw(st.tuples(st.floats(-2, 2), st.floats(-2, 2)))
    middle = ring.mean(axis=0) if count > 3 else ring.sum(axis=0) / 3.0
    polygon = shapely.Polygon(ring)
    hole = shapely.Polygon(middle + 0.3 * (ring - middle))
    if draw(st.booleans()) and polygon.contains_properly(hole):
        polygon = shapely.difference(polygon, hole)
    return polygon


@given(convex(), convex())
def test_convex_sums_merge_edges(a: Points, b: Points) -> None:
    found = minkowski_sum(Area.polygon(a), Area.polygon(b), GRID).geometry
    expected = shapely.Polygon(convex_sum(a, b))
    assert found.area == pytest.approx(expected.area, rel=1e-12)
    assert shapely.symmetric_difference(found, expected).area < 1e-9


@given(any_polygon(), any_polygon(), st.randoms(use_true_random=False))
def test_a_point_is_in_the_sum_iff_the_robot_there_meets_the_obstacle(
    obstacle: shapely.Polygon, robot: shapely.Polygon, rng: np.random.Generator
) -> None:
    reflected = shapely.transform(robot, lambda xy: -xy)
    found = minkowski_sum(Area(obstacle), Area(reflected), GRID).geometry
    edge = found.boundary
    xmin, ymin, xmax, ymax = found.bounds
    for _ in range(60):
        x, y = rng.uniform(xmin - 1, xmax + 1), rng.uniform(ymin - 1, ymax + 1)
        point = shapely.Point(x, y)
        if edge.distance(point) > 1e-9:
            there = shapely.affinity.translate(robot, x, y)
            assert found.contains(point) == there.intersects(obstacle)


def test_a_hole_that_holds_the_robot_stays_and_a_smaller_one_is_closed() -> None:
    ring = Area(shapely.box(0, 0, 10, 10) - shapely.box(3, 3, 6, 6))
    assert minkowski_sum(ring, Area.box(0, 0, 2, 2), GRID).measure == pytest.approx(12 * 12 - 1)
    assert minkowski_sum(ring, Area.box(0, 0, 3, 3), GRID).measure == pytest.approx(13 * 13)


def test_sums_of_several_parts() -> None:
    a = Area(shapely.union(shapely.box(0, 0, 1, 1), shapely.box(5, 0, 6, 1)))
    b = Area(shapely.union(shapely.box(0, 0, 1, 1), shapely.box(0, 5, 1, 6)))
    assert minkowski_sum(a, b, GRID).measure == pytest.approx(16.0)
    assert minkowski_sum(a, Area.empty(), GRID).is_empty
    assert minkowski_sum(Area.empty(), a, GRID).is_empty


@given(any_polygon())
def test_convex_parts_make_up_the_whole(polygon: shapely.Polygon) -> None:
    parts = [shapely.Polygon(part) for part in convex_parts(Area(polygon))]
    assert all(part.exterior.is_ccw for part in parts)
    assert all(part.convex_hull.area == pytest.approx(part.area) for part in parts)
    whole = shapely.union_all(parts)
    assert shapely.symmetric_difference(whole, polygon).area < 1e-9
