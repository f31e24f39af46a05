import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from preimage.geometry.area import Area
from preimage.geometry.cells import cells_area
from preimage.geometry.outer_simplify import simplified_outward

GRID = 2.0**-30
ROUNDING = 1e-8

Bools = NDArray[np.bool_]


@st.composite
def rasters(draw: st.DrawFn) -> Bools:
    rows, columns = draw(st.integers(1, 9)), draw(st.integers(1, 9))
    cells = draw(st.lists(st.booleans(), min_size=rows * columns, max_size=rows * columns))
    return np.array(cells).reshape(rows, columns)


@st.composite
def shapes(draw: st.DrawFn) -> Bools:
    """Discs and slanted walls, as a scanner would see them."""
    size = draw(st.integers(10, 40))
    y, x = np.mgrid[:size, :size]
    solid = np.zeros((size, size), dtype=bool)
    for _ in range(draw(st.integers(1, 3))):
        cx, cy, r = (draw(st.floats(0, size)) for _ in range(3))
        turn = draw(st.floats(0, 3.2))
        across = (x - cx) * np.cos(turn) + (y - cy) * np.sin(turn)
        wall = np.abs(across) < 1.5
        solid |= wall if draw(st.booleans()) else np.hypot(x - cx, y - cy) < r / 3
    return solid


def squares(solid: Bools) -> shapely.Geometry:
    """The union of the cells, one by one: the oracle."""
    rows, columns = np.nonzero(solid)
    return shapely.union_all(shapely.box(columns, rows, columns + 1, rows + 1))


@given(rasters() | shapes())
def test_cells_are_the_union_of_their_squares(solid: Bools) -> None:
    area = cells_area(solid)
    assert area.measure == solid.sum()
    assert area.geometry.is_valid
    assert shapely.symmetric_difference(area.geometry, squares(solid)).area == 0.0


@given(rasters())
def test_cells_have_vertices_where_they_turn_only(solid: Bools) -> None:
    rings = cells_area(solid).rings if solid.any() else ()
    for ring in rings:
        before = ring - np.roll(ring, 1, axis=0)
        after = np.roll(before, -1, axis=0)
        crossed = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        touching = np.array([(ring == point).all(axis=1).sum() for point in ring])
        # straight on is allowed where another ring or polygon touches
        others = np.concatenate(rings)
        shared = np.array([(others == point).all(axis=1).sum() > 1 for point in ring])
        assert np.all((crossed != 0) | shared)
        assert np.all(touching == 1)


@given(rasters() | shapes(), st.sampled_from([0.0, 0.3, 0.5, 0.8, 1.0, 2.0, 5.0]))
def test_simplified_cells_hold_all_cells_and_nothing_far(solid: Bools, tolerance: float) -> None:
    area = cells_area(solid)
    parts = simplified_outward(area, tolerance, GRID)
    assert all(part.geometry.is_valid for part in parts)
    simple = shapely.union_all([part.geometry for part in parts])
    rows, columns = np.nonzero(solid)
    for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
        corners = shapely.points(columns + i, rows + j)
        assert np.all(shapely.distance(simple, corners) <= ROUNDING)
    missing = shapely.difference(area.geometry, shapely.buffer(simple, ROUNDING))
    assert missing.is_empty
    for part in parts:
        added = shapely.difference(part.geometry, area.geometry)
        spots = shapely.get_coordinates(shapely.segmentize(added, 0.1))
        if len(spots):
            apart = shapely.distance(area.geometry, shapely.points(spots))
            assert apart.max() <= tolerance + ROUNDING
    assert sum(part.corners for part in parts) <= area.corners + 4 * len(parts)


def test_nothing_is_simplified_at_no_tolerance() -> None:
    solid = np.tri(8, dtype=bool)
    (part,) = simplified_outward(cells_area(solid), 0.0, GRID)
    assert part.measure == solid.sum()


@pytest.mark.parametrize("step", [1, 2, 5])
def test_stairs_become_a_slope_within_a_cell(step: int) -> None:
    size = 20
    y, x = np.mgrid[: size * step, : size * step]
    solid = y <= x // step
    (part,) = simplified_outward(cells_area(solid), 1.0, GRID)
    assert part.corners == 5
    assert simplified_outward(cells_area(solid), 0.1, GRID)[0].corners == cells_area(solid).corners


def test_a_hole_thinner_than_the_tolerance_closes() -> None:
    solid = np.ones((5, 5), dtype=bool)
    solid[2, 2] = False
    (part,) = simplified_outward(cells_area(solid), 1.0, GRID)
    assert part.measure == 25.0
    (kept,) = simplified_outward(cells_area(solid), 0.5, GRID)
    assert kept.measure == 24.0


def test_no_cells_are_no_area() -> None:
    assert cells_area(np.zeros((3, 4), dtype=bool)).is_empty
    for tolerance in (0.0, 1.0):
        assert simplified_outward(Area.empty(), tolerance, GRID) == ()
