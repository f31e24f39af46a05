"""Convex pieces: they tile the area, and no side of it is cut."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from preimage.geometry.area import Area, Floats
from preimage.physics.pieces import convex_pieces
from tests.strategies import random_space


def turns(loop: Floats) -> Floats:
    into, out = loop - np.roll(loop, 1, axis=0), np.roll(loop, -1, axis=0) - loop
    found: Floats = into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0]
    return found


@given(st.randoms(use_true_random=False), st.booleans())
def test_pieces_tile_the_area(rng: Random, lattice: bool) -> None:
    area = random_space(rng, lattice).obstacles
    pieces = convex_pieces(area)
    assert all(np.all(turns(piece) >= 0.0) for piece in pieces)
    polygons = shapely.polygons([shapely.linearrings(piece) for piece in pieces])
    assert float(np.sum(shapely.area(polygons))) == pytest.approx(area.measure, rel=1e-9)
    whole = shapely.union_all(polygons, grid_size=2.0**-30)
    apart = shapely.symmetric_difference(whole, area.geometry, grid_size=2.0**-30)
    assert apart.area <= 1e-6 * area.geometry.length


@given(st.randoms(use_true_random=False), st.booleans())
def test_no_side_is_cut(rng: Random, lattice: bool) -> None:
    area = random_space(rng, lattice).obstacles
    pieces = convex_pieces(area)
    tails = np.concatenate(pieces)
    along = np.concatenate([np.roll(piece, -1, axis=0) - piece for piece in pieces])
    size = np.hypot(*along.T)
    for start, end in zip(*area.segments, strict=True):
        within = np.ones(len(tails), dtype=np.bool_)
        for point in (start, end):
            off = point - tails
            across = off[:, 0] * along[:, 1] - off[:, 1] * along[:, 0]
            forward = np.sum(off * along, axis=1)
            within &= np.abs(across) <= 1e-9 * size
            within &= (forward >= -1e-9 * size) & (forward <= size * (size + 1e-9))
        assert np.any(within)


@pytest.mark.parametrize(
    ("loop", "most"),
    [
        ([(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)], 2),
        ([(0, 0), (4, 0), (4, 4), (0, 4)], 1),
        ([(0, 0), (2, 0), (4, 0), (4, 4), (0, 4)], 1),
        ([(0, 0), (6, 0), (6, 3), (4, 3), (4, 1), (2, 1), (2, 3), (0, 3)], 3),
    ],
)
def test_few_are_needed(loop: list[tuple[float, float]], most: int) -> None:
    assert len(convex_pieces(Area.polygon(np.array(loop, dtype=np.float64)))) <= most


def test_a_hole_stays_a_hole() -> None:
    outer = np.array([(0, 0), (4, 0), (4, 4), (0, 4)], dtype=np.float64)
    inner = np.array([(1, 1), (1, 3), (3, 3), (3, 1)], dtype=np.float64)
    pieces = convex_pieces(Area.polygon(outer, [inner]))
    assert 4 <= len(pieces) <= 8
    assert not any(Area.polygon(piece).contains(2.0, 2.0) for piece in pieces)


def test_nothing_has_no_pieces() -> None:
    assert convex_pieces(Area.empty()) == []
