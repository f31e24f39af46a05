"""Edges near points, segments and areas, against looking at all pairs."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from preimage.geometry.area import Area
from preimage.geometry.clipping import distances, parts_inside, reaches
from preimage.geometry.edge_index import EdgeIndex


@pytest.fixture
def edges() -> EdgeIndex:
    rng = np.random.default_rng(0)
    return EdgeIndex(rng.uniform(0, 8, (60, 2)), rng.uniform(0, 8, (60, 2)))


def lines(edges: EdgeIndex) -> np.ndarray:
    found: np.ndarray = shapely.linestrings(np.stack((edges.starts, edges.ends), axis=1))
    return found


def test_points(edges: EdgeIndex) -> None:
    points = np.random.default_rng(1).uniform(0, 8, (40, 2))
    point, edge, along = edges.near_points(points, 0.4)
    expected = np.argwhere(shapely.dwithin(shapely.points(points)[:, None], lines(edges), 0.4))
    assert np.array_equal(np.column_stack((point, edge)), expected)
    unit = edges.ends[edge] - edges.starts[edge]
    unit /= np.hypot(*unit.T)[:, None]
    foot = edges.starts[edge] + along[:, None] * unit
    apart = shapely.distance(shapely.points(points[point]), lines(edges)[edge])
    assert np.hypot(*(points[point] - foot).T) == pytest.approx(apart)


def test_segments_and_areas(edges: EdgeIndex) -> None:
    rng = np.random.default_rng(2)
    other = EdgeIndex(rng.uniform(0, 8, (9, 2)), rng.uniform(0, 8, (9, 2)))
    segment, edge = edges.near_segments(other.starts, other.ends, 0.2)
    expected = np.argwhere(shapely.dwithin(lines(other)[:, None], lines(edges), 0.2))
    assert np.array_equal(np.column_stack((segment, edge)), expected)
    area = Area.box(2, 3, 4, 5)
    near = shapely.dwithin(area.geometry, lines(edges), 0.3)
    assert np.array_equal(edges.near_area(area, 0.3), np.flatnonzero(near))


def test_the_nearest_edge(edges: EdgeIndex) -> None:
    edge, apart = edges.nearest(4.0, 4.0)
    every = shapely.distance(lines(edges), shapely.Point(4, 4))
    assert edge == every.argmin()
    assert apart == pytest.approx(every.min())


def test_no_edges() -> None:
    none = EdgeIndex(np.empty((0, 2)), np.empty((0, 2)))
    assert not len(none.near_points(np.zeros((1, 2)), 1.0)[0])
    assert not len(none.near_area(Area.box(0, 0, 1, 1), 1.0))
    assert none.nearest(0.0, 0.0) == (-1, float("inf"))


@pytest.mark.parametrize("seed", range(20))
def test_parts_inside_an_area(edges: EdgeIndex, seed: int) -> None:
    rng = np.random.default_rng(seed)
    triangles = [shapely.Polygon(corners) for corners in rng.uniform(0, 8, (3, 3, 2))]
    area = Area.of(shapely.union_all(triangles))
    edge, low, high = parts_inside(edges, area, 1e-9)
    expected = shapely.length(shapely.intersection(lines(edges), area.geometry))
    found = np.bincount(edge, weights=high - low, minlength=len(expected))
    assert found == pytest.approx(expected, abs=1e-6)
    assert np.all(np.diff(edge) >= 0)
    same = np.diff(edge) == 0
    assert np.all(low[1:][same] > high[:-1][same])


def test_parts_along_the_border() -> None:
    """An edge along the border lies in it, one that touches it in a point does not."""
    starts = np.array([[1.0, 2.0], [-1.0, 1.0], [3.0, 3.0], [4.0, -1.0], [2.0, 2.0 + 5e-10]])
    ends = np.array([[3.0, 2.0], [1.0, -1.0], [3.0, 2.0], [4.0, 3.0], [9.0, 2.0]])
    edge, low, high = parts_inside(EdgeIndex(starts, ends), Area.box(0, 0, 4, 2), 1e-9)
    assert edge.tolist() == [0, 3, 4]
    assert low == pytest.approx([0, 1, 0])
    assert high == pytest.approx([2, 3, 2])


def test_distances_from_areas_and_segments() -> None:
    area = Area.box(0, 0, 1, 1)
    points = np.array([[0.5, 0.5], [2.0, 0.0], [5.0, 4.0]])
    start, end = np.array([[5.0, 0.0]]), np.array([[5.0, 1.0]])
    assert distances(points, area, start, end).tolist() == [0.0, 1.0, 3.0]
    none = np.empty((0, 2))
    assert distances(points, Area.empty(), none, none).tolist() == [np.inf] * 3
    assert reaches(area, points, 1.0).tolist() == [True, True, False]
    assert not reaches(Area.empty(), points, 1.0).any()
