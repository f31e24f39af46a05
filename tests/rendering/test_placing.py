"""Where there is room."""

from __future__ import annotations

import numpy as np

from preimage.geometry.area import Area
from preimage.rendering.placing import Lattice, depth, distance


def lattice(wide: float = 40.0, high: float = 40.0) -> Lattice:
    return Lattice((0.0, 0.0, wide, high), 0.25)


def test_a_box_goes_where_nothing_is() -> None:
    room = lattice()
    room.cost += room.inside(Area.box(0, 0, 40, 25))
    place = room.clearest(8, 8, 0.01 * room.from_corners())
    assert place is not None
    assert place[1] > 28
    room.take(*place, 8, 8)
    other = room.clearest(8, 8, 0.01 * room.from_corners())
    assert other is not None
    assert np.hypot(other[0] - place[0], other[1] - place[1]) >= 8


def test_of_equal_places_the_upper_left_one_is_taken() -> None:
    place = lattice().clearest(6, 6, np.zeros(lattice().cost.shape))
    assert place is not None
    assert place[0] < 6 < 34 < place[1]


def test_what_is_larger_than_the_picture_has_no_place() -> None:
    assert lattice(40, 4).clearest(8, 8, np.zeros(lattice(40, 4).cost.shape)) is None


def test_lines_mark_the_cells_they_cross() -> None:
    room = lattice()
    hit = room.along(np.array([[0.0, 20.0]]), np.array([[40.0, 20.0]]))
    assert hit.any(axis=0).all()
    assert hit.any(axis=1).sum() <= 2
    outside = room.along(np.array([[-9.0, -9.0]]), np.array([[-1.0, -1.0]]))
    assert not outside.any()


def test_depth_and_distance_count_cells() -> None:
    mask = np.zeros((7, 9), dtype=np.bool_)
    mask[1:6, 2:7] = True
    assert depth(mask).max() == 3
    assert depth(mask)[3, 4] == 3
    assert distance(mask)[0, 0] == 3
    assert not distance(mask)[mask].any()
    assert not distance(np.zeros((3, 3), dtype=np.bool_)).any()
