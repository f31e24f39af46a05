"""Pieces taken crowd by crowd: the same as all at once."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from preimage.geometry import inflate, subtraction
from preimage.geometry.area import Area
from preimage.geometry.subtraction import subtracted


@pytest.fixture(autouse=True)
def _always_by_crowds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subtraction, "FEW", 0)


NORMALS = inflate.tangent_normals(0.02)


def porous(rng: np.random.Generator, side: int) -> Area:
    """A square with a box in some cells of a lattice, and an island inside one of them."""
    cell = np.stack(np.divmod(rng.choice(side * side, side * side // 2, replace=False), side), 1)
    low = 3.0 * cell + rng.uniform(0.4, 0.8, cell.shape)
    high = low + rng.uniform(0.5, 1.7, cell.shape)
    shape = shapely.box(0, 0, 3 * side, 3 * side)
    shape = shapely.difference(shape, shapely.multipolygons(shapely.box(*low.T, *high.T)))
    island = shapely.box(*(low[0] + 0.1), *(high[0] - 0.1))
    return Area.of(shapely.union(shape, island))


def stadiums(rng: np.random.Generator, count: int, side: float, lattice: bool) -> np.ndarray:
    starts = rng.uniform(-0.5, 3 * side + 0.5, (count, 2))
    if lattice:
        starts = np.rint(2 * starts) / 2
    reach = rng.integers(-2, 3, (count, 2)) / 2
    return inflate.stadium_pieces(starts, starts + reach, 0.25, NORMALS)


@given(st.integers(0, 2**32 - 1), st.integers(2, 6), st.integers(1, 60), st.booleans())
def test_crowd_by_crowd_is_all_at_once(seed: int, side: int, count: int, lattice: bool) -> None:
    rng = np.random.default_rng(seed)
    area, pieces = porous(rng, side), stadiums(rng, count, side, lattice)
    pieces = pieces[shapely.intersects(area.geometry, pieces)]
    if not len(pieces):
        return
    left = subtracted(area, pieces)
    assert left is not None
    assert shapely.is_valid(left.geometry)
    grid = 2.0**-40
    gone = shapely.union_all(pieces, grid_size=grid)
    plain = shapely.difference(area.geometry, gone, grid_size=grid)
    assert shapely.symmetric_difference(left.geometry, plain, grid_size=grid).area < 1e-9


def square(x: float, y: float, size: float) -> np.ndarray:
    return np.array([(x, y), (x + size, y), (x + size, y + size), (x, y + size)])


def test_what_is_not_touched_keeps_its_vertices() -> None:
    holes = [square(0.1 * i, 10.0 * i + 1 / 3, 1 / 7) for i in range(1, 5)]
    area = Area.polygon(square(-50.0, -50.0, 150.0), holes)
    left = subtracted(area, np.array([shapely.box(50, 50, 51, 51), shapely.box(0, 10, 0.3, 10.4)]))
    assert left is not None
    rings = [ring.tolist() for ring in left.rings]
    assert len(rings) == 6
    for hole in holes[1:]:
        points = {tuple(point) for point in hole.tolist()}
        assert any({tuple(point) for point in ring} == points for ring in rings)


def test_pockets_keep_what_is_inside() -> None:
    """A frame of four pieces around a hole and a piece: the pocket has both as holes."""
    frame = shapely.box([0, 0, 0, 9], [0, 9, 0, 0], [10, 10, 1, 10], [1, 10, 10, 10])
    area = Area.polygon(square(-20.0, -20.0, 60.0), [square(3.0, 3.0, 1.0), square(20, 20, 1)])
    left = subtracted(area, np.append(frame, shapely.box(6, 6, 7, 7)))
    assert left is not None
    assert sorted(len(part.rings) for part in left.parts) == [3, 3]
    assert left.measure == pytest.approx(3600 - 100 + 64 - 1 - 1 - 1)


def test_a_pocket_between_pieces_that_touch_in_points() -> None:
    boxes = shapely.box([0, 1, 2, 1], [1, 0, 1, 2], [1, 2, 3, 2], [2, 1, 2, 3])
    area = Area.box(-20, -20, 20, 20)
    left = subtracted(area, boxes)
    assert left is not None
    assert shapely.is_valid(left.geometry)
    plain = shapely.difference(area.geometry, shapely.union_all(boxes))
    assert shapely.symmetric_difference(left.geometry, plain).area < 1e-12
    assert sorted(part.measure for part in left.parts) == [1.0, 1595.0]


def test_all_may_be_taken() -> None:
    area = Area.box(0, 0, 1, 1)
    left = subtracted(area, np.array([shapely.box(-1, -1, 2, 2)]))
    assert left is not None
    assert left.is_empty
