"""Holes near something, found without looking at all of them."""

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from preimage.geometry.area import Area
from preimage.geometry.porous import Porous

NONE = np.empty((0, 2))


def lattice(rng: np.random.Generator, side: int) -> Area:
    cell = np.stack(np.divmod(np.arange(side * side), side), axis=1)
    low = 2.0 * cell + rng.uniform(0.2, 0.6, cell.shape)
    high = low + rng.uniform(0.3, 1.2, cell.shape)
    gone = shapely.multipolygons(shapely.box(*low.T, *high.T))
    return Area.of(shapely.difference(shapely.box(0, 0, 2 * side, 2 * side), gone))


@given(st.integers(0, 2**32 - 1), st.integers(2, 8), st.floats(0.0, 3.0))
def test_beside_is_right_where_it_is_near(seed: int, side: int, distance: float) -> None:
    rng = np.random.default_rng(seed)
    area = lattice(rng, side)
    corners = rng.uniform(0, 2 * side, (2, 2))
    view = shapely.box(*corners.min(axis=0), *(corners.max(axis=0) + 0.1))
    other = Area.of(shapely.intersection(area.geometry, view))
    starts = rng.uniform(0, 2 * side, (2, 2))
    ends = starts + rng.uniform(-2, 2, (2, 2))
    whole, part = Porous(area).beside(other, starts, ends, distance)
    rest = shapely.difference(area.geometry, other.geometry)
    got = shapely.difference(whole.geometry, part.geometry)
    lines = shapely.linestrings(np.stack((starts, ends), axis=1))
    near = shapely.union_all([other.geometry, *lines]).buffer(0.99 * distance)
    off = shapely.intersection(shapely.symmetric_difference(rest, got), near)
    assert off.area < 1e-9
    assert shapely.difference(rest, got).area < 1e-9


def test_holes_in_common_are_left_out_of_both() -> None:
    area = lattice(np.random.default_rng(3), 6)
    whole, part = Porous(area).beside(area, NONE, NONE, 0.01)
    assert (len(whole.rings), len(part.rings)) == (1, 1)


def test_rooms_inside_obstacles_stay_apart() -> None:
    outer, room = Area.box(0, 0, 20, 20), shapely.box(4, 4, 8, 8)
    wall = shapely.box(3, 3, 9, 9)
    area = Area.of(shapely.union(shapely.difference(outer.geometry, wall), room))
    whole, part = Porous(area).beside(area, NONE, NONE, 0.01)
    assert whole.geometry.is_valid
    assert whole.measure == area.measure
    whole, part = Porous(area).beside(Area.box(18, 18, 19, 19), NONE, NONE, 0.01)
    assert whole.measure == area.measure
    assert part.measure == 1.0


def test_without_holes_nothing_changes() -> None:
    area, other = Area.box(0, 0, 4, 4), Area.box(1, 1, 2, 2)
    assert Porous(area).beside(other, NONE, NONE, 1.0) == (area, other)
    assert Porous(area).beside(Area.empty(), NONE, NONE, 1.0)[1].is_empty
