"""Near misses: brought together, and nothing else moved."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from preimage.geometry.area import Area
from preimage.geometry.border import border, identified, split
from preimage.geometry.welding import area_left_of, welded

BOX = (0.0, 0.0, 8.0, 8.0)
GRID = 2.0**-37
NEAR = 8e-10


def weld(geometry: shapely.Geometry, near: float = NEAR) -> Area:
    return welded(Area(geometry), BOX, near, GRID)


def test_what_is_apart_stays_as_it_is() -> None:
    shape = shapely.box(1, 1, 7, 7) - shapely.box(2, 2, 3, 3)
    assert weld(shape).geometry.equals_exact(shape)


def test_narrow_slits_and_thin_walls_are_not_there() -> None:
    slit = shapely.box(0, 0, 8, 8) - shapely.box(3, 1, 3 + 0.5 * NEAR, 7)
    assert weld(slit).corners == 4
    thread = shapely.union(shapely.box(0, 0, 2, 2), shapely.box(2, 1, 6, 1 + 0.5 * NEAR))
    assert weld(thread).measure == pytest.approx(4.0, abs=1e-12)


def test_near_corners_become_one_and_near_edges_pass_through_them() -> None:
    two = shapely.union(shapely.box(1, 1, 3, 3), shapely.box(3 + 0.3 * NEAR, 3, 5, 5))
    points, _ = border(weld(two))
    assert len(identified(points)[0]) == 7
    touching = shapely.union(
        shapely.box(1, 1, 5, 3), shapely.Polygon([(3, 3 + 0.5 * NEAR), (4, 4), (2, 4)])
    )
    points, _ = border(weld(touching))
    assert len(points) == 4 + 1 + 3
    assert len(identified(points)[0]) == 7


def test_what_is_near_a_side_of_the_window_lies_on_it() -> None:
    points, _ = border(weld(shapely.box(0.5 * NEAR, 1, 8 - 0.5 * NEAR, 8 - 0.9 * NEAR)))
    assert sorted(map(tuple, points.tolist())) == [(0, 1), (0, 8), (8, 1), (8, 8)]


def test_a_fine_curve_does_not_collapse() -> None:
    """Edges shorter than what counts as near are thinned out, not drawn into one point."""
    ring = shapely.Point(4, 4).buffer(2, quad_segs=500)
    coarse = weld(ring, near=0.02)
    assert coarse.measure == pytest.approx(4 * math.pi, rel=2e-2)
    points, following = border(coarse)
    assert np.hypot(*(points[following] - points).T).min() > 0.02


@given(st.lists(st.tuples(st.floats(0, 8), st.floats(0, 8)), min_size=3, max_size=30))
def test_welding_with_a_large_distance_keeps_areas_valid(points: list[tuple[float, float]]) -> None:
    """Whatever the shape, the outcome is valid and has no near misses."""
    near = 0.05
    triangles = [
        shapely.Polygon(points[k : k + 3])
        for k in range(0, len(points) - 2, 3)
        if shapely.Polygon(points[k : k + 3]).area > 1e-3
    ]
    found = weld(shapely.union_all(triangles, grid_size=GRID), near)
    assert found.geometry.is_valid
    points_, following = border(found)
    if not len(points_):
        return
    ends = points_[following]
    gap = shapely.distance(
        shapely.linestrings(np.stack((points_, ends), axis=1))[:, None],
        shapely.points(points_)[None, :],
    )
    at = (points_[:, None] == points_[None]).all(axis=2) | (ends[:, None] == points_[None]).all(
        axis=2
    )
    assert np.all(gap[~at] > near)


def test_areas_from_their_edges() -> None:
    shape = shapely.union(
        shapely.box(0, 0, 4, 4) - shapely.box(1, 1, 2, 2), shapely.box(5, 5, 6, 6)
    )
    points, following = border(Area(shape))
    assert area_left_of(points, points[following]).geometry.equals(shape)
    assert area_left_of(np.empty((0, 2)), np.empty((0, 2))).is_empty


def test_splitting_edges() -> None:
    points, following = border(Area.box(0, 0, 4, 4))
    edge = int(np.flatnonzero((points == (0, 0)).all(axis=1))[0])
    places = np.array([[3.0, 0.0], [1.0, 0.0], [2.0, 0.0]])
    more, linked = split(points, following, np.array([edge] * 3, dtype=np.int32), places)
    walk = [edge]
    while linked[walk[-1]] != edge:
        walk.append(int(linked[walk[-1]]))
    assert more[walk].tolist() == [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [4, 4], [0, 4]]
