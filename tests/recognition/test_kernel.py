"""Kernels in closed form: Figures 7, 9, 10 and 16, and what theory 5 adds to them."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from tests.recognition.scenes import (
    BLOCK,
    CORNERS,
    DOWN,
    EXACT,
    ROOM,
    SENSES,
    assert_same_area,
    contact,
    disc,
    edge_at,
    goal,
    kernel_of,
    space_of,
    stretch,
    vertex_at,
)

# --- Figure 16: nothing but position ----------------------------------------------------------


@pytest.mark.parametrize("rho", [0.05, 0.5, 1.2])
def test_figure_16_rectangle_in_empty_space(rho: float) -> None:
    space = space_of([])
    got = kernel_of(space, goal(space, Area.box(-4, -3, 4, 3)), replace(SENSES, position=rho))
    r = 2 * rho
    assert_same_area(got.area, shapely.box(-4 + r, -3 + r, 4 - r, 3 - r))
    assert got.area.bounds == pytest.approx((-4 + r, -3 + r, 4 - r, 3 - r), abs=EXACT)
    assert got.contact.is_empty


def test_a_goal_too_thin_has_no_kernel() -> None:
    space = space_of([])
    for high in (1.9, 2.0):
        assert kernel_of(space, goal(space, Area.box(-4, 0, 4, high))).is_empty


def test_arcs_are_on_the_safe_side_and_touch_where_the_cone_does() -> None:
    """A goal with a reflex corner: around it the kernel ends in an arc of radius 2 rho."""
    space = space_of([])
    ell = areas.difference(Area.box(-6, -6, 6, 6), Area.box(0, 0, 6, 6))
    got = kernel_of(space, goal(space, ell))
    exact = shapely.difference(
        shapely.box(-5, -5, 5, 5),
        shapely.union_all([shapely.box(-1, 0, 6, 6), shapely.box(0, -1, 6, 6), disc(0, 0, 1)]),
    )
    assert shapely.difference(got.area.geometry, exact).area < 1e-4
    missing = shapely.difference(exact, got.area.geometry)
    assert shapely.buffer(missing, -0.006).is_empty
    for turn in (DOWN - SENSES.control, DOWN + SENSES.control):
        normal = (math.cos(turn + math.pi / 2), math.sin(turn + math.pi / 2))
        side = -1.0 if normal[0] > 0 else 1.0
        x, y = side * normal[0], side * normal[1]
        if x <= 0 and y <= 0:
            assert shapely.distance(got.area.geometry, shapely.Point(x, y)) < 1e-8


# --- Figures 7, 8 and 10: a goal that lies partly on an obstacle ------------------------------


def test_figure_7() -> None:
    space = space_of([BLOCK])
    got = kernel_of(space, goal(space, Area.box(-3, 0, 6, 4)))
    # T'1: the floor from 2 rho inside to the obstacle's corner, which reads 0 and is not in it
    floor = edge_at(space, 0, 0)
    assert stretch(space, got.contact, floor) == [pytest.approx([-2, 0, 5, 0], abs=EXACT)]
    assert set(got.contact.edge.tolist()) == {floor}
    assert not len(got.contact.vertices)
    # T'2: shifted in by 2 rho from its free sides; around the corner below an arc
    exact = shapely.difference(shapely.box(-2, 0, 5, 3), disc(5, 0, 1))
    assert_same_area(got.area, exact, 0.006)
    assert shapely.difference(got.area.geometry, exact).area < 1e-4
    straight = shapely.box(-2, 0, 3.9, 3)
    clipped = areas.within_box(got.area, -10, -10, 3.9, 10)
    assert_same_area(clipped, straight)


def test_the_side_wall_of_figure_7_reads_0() -> None:
    space = space_of([BLOCK])
    got = kernel_of(space, goal(space, Area.box(3, -4, 8, 4)))
    floor = edge_at(space, 4, 0)
    assert stretch(space, got.contact, floor) == [pytest.approx([4, 0, 5, 0], abs=EXACT)]
    wall = edge_at(space, 5, -2)
    # inside, where no free space outside T is within 2 rho, 0 does no harm
    assert stretch(space, got.contact, wall) == [pytest.approx([5, -3, 5, 0], abs=EXACT)]
    assert got.contact.vertices.tolist() == [vertex_at(space, 5, 0)]
    assert_same_area(
        got.area,
        shapely.difference(shapely.box(4, -3, 7, 3), BLOCK),
    )


# --- Figure 9: what is beyond the obstacle ----------------------------------------------------


def bar(thickness: float) -> ConfigurationSpace:
    return space_of([shapely.box(-10, -thickness, 10, 0)])


def test_figure_9a_thick() -> None:
    space = bar(1.0)
    got = kernel_of(space, goal(space, Area.box(-4, 0, 4, 5)))
    assert_same_area(got.area, shapely.box(-3, 0, 3, 4))


def test_figure_9b_thin() -> None:
    space = bar(0.25)
    got = kernel_of(space, goal(space, Area.box(-4, 0, 4, 5)))
    assert_same_area(got.area, shapely.box(-3, 0.75, 3, 4))
    # contact is felt: the floor is told from what is beyond the obstacle
    floor = edge_at(space, 0, 0)
    assert stretch(space, got.contact, floor) == [pytest.approx([-3, 0, 3, 0], abs=EXACT)]


def test_figure_9c_both_sides_in_the_goal() -> None:
    space = bar(0.25)
    target = goal(space, Area.box(-4, 0, 4, 5), Area.box(-4, -5, 4, -0.25))
    got = kernel_of(space, target)
    expected = shapely.union(shapely.box(-3, 0, 3, 4), shapely.box(-3, -4, 3, -0.25))
    assert_same_area(got.area, expected)


def test_figure_9c_with_different_sides() -> None:
    space = bar(0.25)
    target = goal(space, Area.box(-4, 0, 4, 5), Area.box(-2, -5, 2, -0.25))
    got = areas.within_box(kernel_of(space, target).area, -10, 0, 10, 10)
    reach = math.sqrt(1 - 0.25**2)
    corners = [disc(side * 2, -0.25, 1) for side in (-1, 1)]
    strips = [shapely.box(-4, -1.25, -2, 0.75), shapely.box(2, -1.25, 4, 0.75)]
    exact = shapely.difference(shapely.box(-3, 0, 3, 4), shapely.union_all([*corners, *strips]))
    assert_same_area(got, exact, 0.006)
    assert shapely.difference(got.geometry, exact).area < 1e-4
    assert got.contains(0.0, 0.01)
    assert got.contains(0.98 * (2 - reach), 0.0)


# --- features are kept apart (theory 5) -------------------------------------------------------


def test_floor_told_from_its_walls_but_not_from_its_corners() -> None:
    space = space_of([ROOM])
    floor = edge_at(space, 0, 0)
    bare = Region(Area.empty(), contact(space, [(floor, 0, 8)]))
    got = kernel_of(space, bare)
    assert stretch(space, got.contact, floor) == [pytest.approx([-3, 0, 3, 0], abs=EXACT)]
    corners = [vertex_at(space, *corner) for corner in CORNERS]
    with_corners = Region(Area.empty(), contact(space, [(floor, 0, 8)], corners))
    got = kernel_of(space, with_corners)
    # the whole floor, up to its ends; the corners themselves feel like the walls
    assert stretch(space, got.contact, floor) == [pytest.approx([-4, 0, 4, 0], abs=EXACT)]
    assert not len(got.contact.vertices)


def test_wall_in_the_kernel_without_the_area_beside_it() -> None:
    """A goal edge without area: what is felt is told from free space."""
    space = space_of([BLOCK])
    floor = edge_at(space, 0, 0)
    got = kernel_of(space, Region(Area.empty(), contact(space, [(floor, 2, 8)])))
    assert got.area.is_empty
    assert stretch(space, got.contact, floor) == [pytest.approx([-2, 0, 2, 0], abs=EXACT)]


def test_area_in_the_kernel_without_the_edge_below_it() -> None:
    """Area without contact: the floor, which is felt, does not confuse; the walls read 0."""
    space = space_of([ROOM])
    got = kernel_of(space, Region(Area.box(-4, 0, 4, 6), ContactSet.empty()))
    assert_same_area(got.area, shapely.box(-3, 0, 3, 5))
    assert got.contact.is_empty


def test_corners_that_read_0_take_a_disc() -> None:
    space = space_of([ROOM])
    target = goal(space, Area.box(-4, 0, 4, 6))
    edges, low, high = target.contact.edge, target.contact.low, target.contact.high
    corner = vertex_at(space, 4, 0)
    others = target.contact.vertices[target.contact.vertices != corner]
    got = kernel_of(space, Region(target.area, ContactSet(edges, low, high, others)))
    exact = shapely.difference(shapely.box(-4, 0, 4, 6), disc(4, 0, 1))
    assert_same_area(got.area, exact, 0.006)
    assert shapely.difference(got.area.geometry, exact).area < 1e-4


def test_notch_reads_like_the_floor_beside_it() -> None:
    """The paper's kernel looks at edges alone and would keep all of the floor (theory 3)."""
    notch = shapely.Polygon([(-8, -8), (8, -8), (8, 0), (-1, 0), (-2, -2), (-3, 0), (-8, 0)])
    space = space_of([notch])
    senses = replace(SENSES, force_angle=0.0)
    floor = edge_at(space, 4, 0)
    edge = Region(Area.empty(), contact(space, [(floor, 0, space.contact.length[floor])]))
    got = kernel_of(space, edge, replace(senses, position=1.25), friction=0.0)
    # the bottom is 2 below: with 2 rho = 2.5 it reaches 1.5 to each side on the floor's level;
    # the corner at (8, 0) and the rim at (-1, 0) may be felt as the floor is, 2.5 to their side
    assert stretch(space, got.contact, floor) == [pytest.approx([1.5, 0, 5.5, 0], abs=EXACT)]
    # with both floors and their ends in the goal, only the bottom is left to confuse
    other = edge_at(space, -5, 0)
    rims = [vertex_at(space, x, 0) for x in (-8, -3, -1, 8)]
    floors = contact(space, [(floor, 0, 9), (other, 0, 5)], rims)
    got = kernel_of(
        space, Region(Area.empty(), floors), replace(senses, position=1.25), friction=0.0
    )
    assert stretch(space, got.contact, floor) == [pytest.approx([-0.5, 0, 8, 0], abs=EXACT)]
    assert stretch(space, got.contact, other) == [pytest.approx([-8, 0, -3.5, 0], abs=EXACT)]
    assert not len(got.contact.vertices)  # convex corners read 0, and free space is not in T


def test_two_floors_at_different_levels() -> None:
    """An edge takes an interval from another, by the segment's disc and strip: closed form."""
    steps = shapely.union_all([shapely.box(-8, -8, 0, 0), shapely.box(0, -8, 8, -0.6)])
    space = space_of([steps])
    low = edge_at(space, 4, -0.6)
    target = Region(Area.empty(), contact(space, [(low, 0, 8)], [vertex_at(space, 0, -0.6)]))
    got = kernel_of(space, target)
    [[x, _, x2, _]] = stretch(space, got.contact, low)
    assert x == pytest.approx(0.8, abs=EXACT)  # the upper floor ends at (0, 0)
    assert x2 == pytest.approx(7.0, abs=EXACT)  # the corner at (8, -0.6)


def test_slanted_edges() -> None:
    """A floor on a slope, its goal ending within: the same lengths along the edge."""
    slope = shapely.Polygon([(-8, -9), (9, -9), (7, 3.7), (-8, -2.3)])
    space = space_of([slope])
    edge = edge_at(space, -8 + 7.5, -2.3 + 3.0)
    length = float(space.contact.length[edge])
    target = contact(space, [(edge, 3.0, 9.0)])
    got = kernel_of(
        space, Region(Area.empty(), target), direction=float(space.contact.normal[edge]) + math.pi
    )
    assert length > 10
    assert got.contact.low.tolist() == pytest.approx([4.0], abs=EXACT)
    assert got.contact.high.tolist() == pytest.approx([8.0], abs=EXACT)


def test_polygon_on_a_slope_has_no_slivers() -> None:
    """The goal's border on a slanted edge is off by rounding; nothing grows from there."""
    slope = shapely.Polygon([(-8, -9), (9, -9), (7.3, 3.7), (-8.1, -2.3)])
    space = space_of([slope])
    edge = edge_at(space, *((space.contact.points + space.contact.ends) / 2)[_slanted(space)])
    down = float(space.contact.normal[edge]) + math.pi
    strip = Area.polygon(np.array([(-4, -9), (4, -9), (4, 9), (-4, 9)], dtype=float))
    above = goal(space, strip)
    low = areas.intersection(above.area, _band(space, edge, 3.0))
    target = Region(low, above.contact)
    got = kernel_of(space, target, direction=down)
    x = space.contact.at(got.contact.edge, got.contact.low)[:, 0]
    assert len(got.area.parts) == 1
    # it touches the slope over a width of 8 less 2 rho on either side, measured across
    on_slope = got.area.geometry.distance(shapely.Point(*_on(space, edge, 0.0)))
    assert on_slope < 1e-9
    assert len(x) == 1


def _slanted(space: ConfigurationSpace) -> int:
    tangent = np.abs(space.contact.tangent)
    slanted = (np.min(tangent, axis=1) > 0.2) & ~space.contact.open
    return int(np.argmax(slanted))


def _on(space: ConfigurationSpace, edge: int, x: float) -> tuple[float, float]:
    (x1, y1), (x2, y2) = space.contact.points[edge], space.contact.ends[edge]
    return x, y1 + (x - x1) * (y2 - y1) / (x2 - x1)


def _band(space: ConfigurationSpace, edge: int, high: float) -> Area:
    points = [_on(space, edge, x) for x in (-9.0, 9.0)]
    return Area.polygon(np.array([*points, *[(x, y + high) for x, y in reversed(points)]]))
