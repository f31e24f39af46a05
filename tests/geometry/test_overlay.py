"""Unions and differences on a grid against plain ones."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import shapely

from preimage.geometry.area import Area
from preimage.geometry.overlay import box_without, united

GRID = 2.0**-36
BOX = (0.0, 0.0, 8.0, 8.0)


def shapes(rng: Random) -> list[shapely.Geometry]:
    found: list[shapely.Geometry] = []
    for _ in range(rng.randint(0, 7)):
        x, y = rng.randint(0, 8), rng.randint(0, 8)
        box = shapely.box(x, y, x + rng.randint(1, 3), y + rng.randint(1, 3))
        if rng.random() < 0.3:
            box = shapely.box(x, y, x + 3, y + 4) - shapely.box(x + 1, y + 1, x + 2, y + 3)
        if rng.random() < 0.4:
            box = shapely.Point(rng.uniform(0, 8), rng.uniform(0, 8)).buffer(0.3, quad_segs=2)
        found.append(box)
    return found


@pytest.mark.parametrize("seed", range(100))
def test_unions_and_what_they_leave_of_a_box(seed: int) -> None:
    scene = shapes(Random(seed))
    union = united([Area(shape) for shape in scene], GRID)
    expected = shapely.union_all(scene)
    assert union.geometry.is_valid
    assert shapely.symmetric_difference(union.geometry, expected).area < 1e-8
    free = box_without(BOX, union, GRID)
    assert free.geometry.is_valid
    left = shapely.difference(shapely.box(*BOX), expected)
    assert shapely.symmetric_difference(free.geometry, left).area < 1e-8


def test_islands_in_rooms_become_holes_of_the_room() -> None:
    room = shapely.box(1, 1, 7, 7) - shapely.box(2, 2, 6, 6)
    cut = shapely.box(-1, 4, 2, 5)
    islands = [
        shapely.box(3, 3, 4, 4),
        shapely.box(5, 5, 5.5, 5.5),
        shapely.box(0.2, 0.2, 0.4, 0.4),
    ]
    union = united([Area(shape) for shape in [room, cut, *islands]], GRID)
    free = box_without(BOX, union, GRID)
    holes = sorted(shapely.get_num_interior_rings(part.geometry) for part in free.parts)
    assert holes == [1, 2]
    assert free.measure == pytest.approx(64 - 36 - 1 - 0.04 + 16 - 1 - 0.25)


def test_unions_of_nearly_coincident_borders_lose_nothing() -> None:
    """In floating arithmetic GEOS 3.14 loses a box in one of some thousand such scenes."""
    rng = Random(5)
    for _ in range(300):
        scene = shapes(rng)
        angle, scale = rng.uniform(0, math.tau), rng.uniform(0.3, 3)
        turned = [
            shapely.affinity.scale(
                shapely.affinity.rotate(shape, angle, (4, 4), use_radians=True),
                scale,
                scale,
                origin=(4, 4),
            )
            for shape in scene
        ]
        expected = shapely.union_all(scene, grid_size=GRID).area * scale**2
        found = united([Area(shape) for shape in turned], GRID)
        assert found.measure == pytest.approx(expected, abs=1e-7)


def test_nothing() -> None:
    assert united([], GRID).is_empty
    assert united([Area.empty(), Area.empty()], GRID).is_empty
    assert box_without(BOX, Area.empty(), GRID).measure == 64.0
    assert box_without(BOX, Area.box(-1, -1, 9, 9), GRID).is_empty


def test_a_large_hall_is_united_fast() -> None:
    x, y = np.meshgrid(np.arange(100.0), np.arange(100.0))
    boxes = [Area(shape) for shape in shapely.box(x, y, x + 0.5, y + 0.5).ravel()]
    hall = united(boxes, GRID)
    assert len(hall.parts) == 10_000
    assert box_without((-1.0, -1.0, 101.0, 101.0), hall, GRID).corners == 40_004
