"""Lines of several regions beside one contact edge."""

from __future__ import annotations

import numpy as np
import shapely

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.space import ConfigurationSpace
from preimage.rendering.lanes import GAP, Lanes
from preimage.task import Side
from tests.strategies import space_of

UNIT = 0.01


def room() -> ConfigurationSpace:
    return space_of([], list(Side))


def lanes(space: ConfigurationSpace) -> Lanes:
    return Lanes(space.contact, space.tolerance.length)


def interval(edge: int, low: float, high: float) -> ContactSet:
    return ContactSet.of([edge], [low], [high], [], 1e-9)


def test_a_second_line_lies_outside_the_first() -> None:
    space = room()
    beside = lanes(space)
    first = beside.place(interval(0, 2, 5), 3.0)
    second = beside.place(interval(0, 2, 5), 2.0)
    assert first.offset.tolist() == [1.5]
    assert second.offset.tolist() == [3.0 + GAP + 1.0]


def test_a_line_is_cut_where_another_ends() -> None:
    space = room()
    beside = lanes(space)
    beside.place(interval(0, 2, 5), 3.0)
    pieces = beside.place(interval(0, 0, 12), 1.0)
    assert pieces.low.tolist() == [0, 2, 5]
    assert pieces.high.tolist() == [2, 5, 12]
    assert pieces.offset.tolist() == [0.5, 3.0 + GAP + 0.5, 0.5]


def test_lines_lie_in_free_space_and_meet_in_corners() -> None:
    space = room()
    contact = space.contact
    lines = lanes(space).lines(ContactSet.whole(contact), 4.0, UNIT)
    window = shapely.box(*space.window)
    for start, end in lines:
        assert window.contains(shapely.LineString((start, end)))
    ends = {tuple(np.round(end, 9)) for end in lines[:, 1]}
    assert ends == {tuple(np.round(start, 9)) for start in lines[:, 0]}


def test_a_line_stops_before_lines_of_another_edge() -> None:
    space = room()
    contact = space.contact
    beside = lanes(space)
    length = float(contact.length[0])
    beside.lines(interval(0, 0, length), 4.0, UNIT)
    line = beside.lines(interval(int(contact.next[0]), 0, 5), 2.0, UNIT)[0]
    apart = np.abs((line[0] - contact.points[0]) @ _normal(space, 0))
    assert np.isclose(apart, (4.0 + GAP) * UNIT)


def test_round_a_convex_corner_lines_keep_their_length() -> None:
    space = space_of([shapely.box(-1, -1, 1, 1)])
    lines = lanes(space).lines(ContactSet.whole(space.contact), 4.0, UNIT)
    lengths = np.hypot(*(lines[:, 1] - lines[:, 0]).T)
    assert np.allclose(lengths, 2.0)


def _normal(space: ConfigurationSpace, edge: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    angle = float(space.contact.normal[edge])
    return np.array((np.cos(angle), np.sin(angle)))
