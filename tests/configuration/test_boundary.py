"""Contact space: loops with free space on the left, pinches, open sides."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry.base import BaseGeometry

from preimage.configuration.contact import ContactSpace
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import TaskError
from preimage.geometry.border import border
from preimage.task.workspace import Side
from tests.configuration import spaces

FULL = frozenset(Side)
NEAR = 1e-7


def some_space(
    scene: list[BaseGeometry], sides: frozenset[Side] = frozenset()
) -> ConfigurationSpace | None:
    """The space of a scene, or nothing where it fills the window."""
    try:
        return spaces.space_in(scene, sides)
    except TaskError:
        return None


turns = st.one_of(st.just(0.0), st.floats(0.0, math.tau))


@given(spaces.scenes, spaces.walls, turns)
def test_loops_with_free_space_on_the_left(
    scene: list[BaseGeometry], sides: frozenset[Side], angle: float
) -> None:
    space = some_space(spaces.turned(scene, angle), sides)
    if space is None:
        return
    contact = space.contact
    count = len(contact)
    assert sorted(contact.next.tolist()) == list(range(count))
    assert np.array_equal(contact.next[contact.previous], np.arange(count))
    assert contact.length.min() > space.tolerance.length
    assert contact.length.sum() == pytest.approx(space.free.geometry.length, rel=1e-12)
    normal = np.column_stack((np.cos(contact.normal), np.sin(contact.normal)))
    assert np.allclose(np.sum(normal * contact.tangent, axis=1), 0.0, atol=1e-12)
    middle = 0.5 * (contact.points + contact.ends)
    step = 0.3 * space.tolerance.length * normal
    assert space.free.contains_all(middle + step).all()
    assert not space.free.contains_all(middle - step).any()


@given(spaces.scenes, spaces.walls, turns)
def test_free_space_and_contact_space_share_their_vertices(
    scene: list[BaseGeometry], sides: frozenset[Side], angle: float
) -> None:
    space = some_space(spaces.turned(scene, angle), sides)
    if space is None:
        return
    points, following = border(space.free)
    free = Counter(map(tuple, np.hstack((points, points[following])).tolist()))
    edges = np.hstack((space.contact.points, space.contact.ends))
    contact = Counter(map(tuple, edges.tolist()))
    if space.contact.open.any():  # where an open side ends, contact space may have a vertex more
        assert {edge[:2] for edge in free} <= {edge[:2] for edge in contact}
    else:
        assert free == contact
    rest = shapely.difference(shapely.box(*spaces.WINDOW), space.obstacles.geometry)
    assert shapely.symmetric_difference(rest, space.free.geometry).area < NEAR
    assert shapely.is_valid(space.free.geometry)


@given(spaces.scenes, turns)
def test_no_vertex_near_an_edge_that_does_not_end_there(
    scene: list[BaseGeometry], angle: float
) -> None:
    space = some_space(spaces.turned(scene, angle))
    if space is None:
        return
    contact = space.contact
    gap = shapely.distance(
        shapely.linestrings(np.stack((contact.points, contact.ends), axis=1))[:, None],
        shapely.points(contact.points)[None, :],
    )
    at_start = (contact.points[:, None] == contact.points[None]).all(axis=2)
    at_end = (contact.ends[:, None] == contact.points[None]).all(axis=2)
    assert np.all(gap[~(at_start | at_end)] > 0.5 * space.tolerance.length)


@given(spaces.scenes, turns)
def test_wedges_around_a_point_make_up_the_free_space_there(
    scene: list[BaseGeometry], angle: float
) -> None:
    space = some_space(spaces.turned(scene, angle))
    if space is None:
        return
    contact = space.contact
    for point in np.unique(contact.points, axis=0):
        here = np.flatnonzero((contact.points == point).all(axis=1))
        arms = np.concatenate((contact.ends[here], contact.points[contact.previous[here]])) - point
        angles = np.sort(np.arctan2(arms[:, 1], arms[:, 0]))
        widths = np.diff(np.append(angles, angles[0] + math.tau))
        middles = angles + 0.5 * widths
        reach = 0.3 * space.tolerance.length
        around = point + reach * np.column_stack((np.cos(middles), np.sin(middles)))
        free = space.free.contains_all(around)
        assert contact.span[here].sum() == pytest.approx(widths[free].sum(), abs=1e-9)
        assert sorted(contact.span[here]) == pytest.approx(sorted(widths[free]), abs=1e-9)


@given(spaces.lattice_scenes, spaces.walls)
def test_open_edges_are_where_nothing_lies_behind_an_open_side(
    scene: list[BaseGeometry], sides: frozenset[Side]
) -> None:
    space = some_space(scene, sides)
    if space is None:
        return
    contact = space.contact
    middle = 0.5 * (contact.points + contact.ends)
    beyond = middle - 1e-3 * np.column_stack((np.cos(contact.normal), np.sin(contact.normal)))
    solid = space.obstacles.contains_all(beyond)
    xmin, ymin, xmax, ymax = space.window
    where = {
        Side.LEFT: beyond[:, 0] < xmin,
        Side.RIGHT: beyond[:, 0] > xmax,
        Side.BOTTOM: beyond[:, 1] < ymin,
        Side.TOP: beyond[:, 1] > ymax,
    }
    outside = np.any([where[side] for side in set(Side) - sides], axis=0)
    wall = np.any([where[side] for side in sides], axis=0)
    assert np.array_equal(contact.open, outside & ~solid)
    assert np.array_equal(~contact.open, solid | wall)


@given(spaces.lattice_scenes, st.floats(0.0, math.tau), st.floats(0.3, 3.0))
def test_a_turned_scene_has_the_same_features(
    scene: list[BaseGeometry], angle: float, scale: float
) -> None:
    """Rounding takes apart what touched in the scene; welding brings it together again."""
    window = (-40.0, -40.0, 50.0, 50.0)
    still = spaces.space_in(scene, FULL, window).contact
    moved = spaces.space_in(spaces.turned(scene, angle, scale), FULL, window).contact
    assert len(still) == len(moved)
    inner = features(still, window), features(moved, window)
    assert inner[0][:, 0] * scale == pytest.approx(inner[1][:, 0], abs=1e-6)
    assert inner[0][:, 1] == pytest.approx(inner[1][:, 1], abs=1e-6)


def features(contact: ContactSpace, window: tuple[float, ...]) -> np.ndarray:
    """Lengths and spans of all features but those of the window, in order."""
    inner = (contact.points != window[:1]).all(axis=1) & (contact.points != window[3:]).all(axis=1)
    return np.column_stack((np.sort(contact.length[inner]), np.sort(contact.span[inner])))


# --- single cases -------------------------------------------------------------------------------


def test_squares_that_touch_in_a_corner_are_pinched() -> None:
    contact = spaces.space_in([shapely.box(2, 2, 4, 4), shapely.box(4, 4, 6, 6)]).contact
    here = np.flatnonzero((contact.points == 4.0).all(axis=1))
    assert len(here) == 2
    assert contact.span[here] == pytest.approx([math.pi / 2, math.pi / 2])
    # one loop goes around both squares: it passes the pinch twice
    assert len(contact) == 4 + 8
    loop = [int(here[0])]
    while contact.next[loop[-1]] != here[0]:
        loop.append(int(contact.next[loop[-1]]))
    assert here[1] in loop
    assert len(loop) == 8


def test_a_corner_on_a_straight_wall_has_a_vertex_on_either_side() -> None:
    wall = shapely.box(0, 0, 8, 2)
    tip = shapely.Polygon([(4, 2), (5, 4), (3, 4)])
    contact = spaces.space_in([wall, tip]).contact
    here = np.flatnonzero((contact.points == (4.0, 2.0)).all(axis=1))
    assert len(here) == 2
    assert contact.span[here] == pytest.approx([math.atan2(2, 1)] * 2)


def test_a_room_has_its_own_loop_and_component() -> None:
    space = spaces.space_in([shapely.box(1, 1, 7, 7) - shapely.box(2, 2, 6, 6)])
    assert len(space.free.parts) == 2
    inside = (np.abs(space.contact.points - 4.0) <= 2.0).all(axis=1)
    assert inside.sum() == 4
    assert space.contact.concave[inside].all()


def test_squares_with_a_common_edge_are_one() -> None:
    contact = spaces.space_in([shapely.box(2, 2, 4, 4), shapely.box(4, 2, 6, 4)]).contact
    assert len(contact) == 8


@pytest.mark.parametrize("gap", [0.0, 1e-12, 3e-10])
def test_slits_and_necks_within_the_tolerance_are_closed(gap: float) -> None:
    """The tolerance is 8e-10 in this window."""
    scene = [shapely.box(2, 2, 4, 4), shapely.box(4 + gap, 2, 6, 4), shapely.box(1, 4 + gap, 2, 5)]
    contact = spaces.space_in(scene).contact
    assert len(contact) == 4 + 4 + 4
    corners = contact.points[np.isin(contact.points[:, 0], (1.0, 2.0))]
    assert {(2.0, 4.0)} <= set(map(tuple, np.round(corners, 6)))
    assert Counter(map(tuple, np.round(contact.points, 6)))[(2.0, 4.0)] == 2


def test_a_slit_wider_than_the_tolerance_stays() -> None:
    contact = spaces.space_in([shapely.box(2, 2, 4, 4), shapely.box(4 + 2e-9, 2, 6, 4)]).contact
    assert len(contact) == 4 + 8


def test_an_obstacle_beside_the_window_closes_its_open_side_there() -> None:
    contact = spaces.space_in([shapely.box(8, 2, 9, 5), shapely.box(-1, -1, 3, 0)]).contact
    closed = contact.edges
    ends = np.sort(np.stack((contact.points[closed], contact.ends[closed]), axis=1), axis=1)
    expected = {((0.0, 0.0), (3.0, 0.0)), ((8.0, 2.0), (8.0, 5.0))}
    assert {tuple(map(tuple, pair)) for pair in ends.tolist()} == expected


def test_an_obstacle_across_the_window_side_leaves_open_parts_beside_it() -> None:
    space = spaces.space_in([shapely.box(7, 3, 10, 4)], frozenset({Side.LEFT}))
    contact = space.contact
    assert contact.length[contact.open].sum() == pytest.approx(8 + 8 + 7)
    assert contact.length[~contact.open].sum() == pytest.approx(8 + 1 + 1 + 1)
    assert set(contact.vertices) < set(range(len(contact)))


def test_a_window_full_of_obstacles_is_refused() -> None:
    with pytest.raises(TaskError, match="no free space is left"):
        spaces.space_in([shapely.box(-1, -1, 9, 9)])


def test_straight_vertices_are_left_out_and_fine_curves_are_kept() -> None:
    ring = shapely.Point(4, 4).buffer(2, quad_segs=20_000)
    contact = spaces.space_in([ring, shapely.box(3, 6.5, 4, 7), shapely.box(4, 6.5, 5, 7)]).contact
    around = np.hypot(*(contact.points - 4.0).T) < 2.1
    assert abs(math.pi * 4 - contact.length[around].sum()) < 1e-6
    assert len(contact) - around.sum() == 4 + 4


def test_an_empty_window_has_no_contact() -> None:
    contact = spaces.space_in([]).contact
    assert contact.open.all()
    assert not len(contact.vertices)


@pytest.mark.slow
def test_a_large_hall_takes_seconds() -> None:
    side = 100
    x, y = np.meshgrid(np.arange(side) * 3.0, np.arange(side) * 3.0)
    scene = shapely.box(x, y, x + 1, y + 1).ravel().tolist()
    scene += shapely.box(x + 1, y + 1, x + 2, y + 2).ravel().tolist()
    space = spaces.space_in(scene, FULL, (-1.0, -1.0, 300.0, 300.0))
    assert len(space.contact) == 4 + 8 * side * side
