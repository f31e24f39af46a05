"""Closed forms of theory 4 and 2 for the reference backprojection, on scenes made by hand."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
import shapely
from shapely.geometry.base import BaseGeometry

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.verification.reference import ReferenceBackprojection, reference_backprojection
from tests.strategies import (
    space_of,
)

Point = tuple[float, float]

WINDOW = (-10.0, -6.0, 10.0, 20.0)
DOWN = -0.5 * math.pi
GROUND = shapely.box(-30.0, -30.0, 30.0, 0.0)
THETA = math.radians(20.0)
PHI = math.radians(30.0)


class Bench:
    """A scene made by hand, its target named by places."""

    def __init__(
        self,
        obstacles: Sequence[BaseGeometry],
        turn: float = 0.0,
        window: tuple[float, float, float, float] = WINDOW,
    ) -> None:
        turned = [
            shapely.affinity.rotate(o, turn, origin=(0, 0), use_radians=True) for o in obstacles
        ]
        self.turn = turn
        self.space = space_of(turned, (), window)
        self.edges: list[tuple[int, float, float]] = []
        self.vertices: list[int] = []
        self.area = Area.empty()

    def at(self, x: float, y: float) -> Point:
        c, s = math.cos(self.turn), math.sin(self.turn)
        return c * x - s * y, s * x + c * y

    def vertex(self, x: float, y: float) -> int:
        found = np.hypot(*(self.space.contact.points - self.at(x, y)).T)
        assert found.min() < 1e-6
        return int(found.argmin())

    def on(self, x: float, y: float) -> tuple[int, float]:
        """The contact edge through a point that is no vertex, and how far along it is."""
        contact = self.space.contact
        offset = np.array(self.at(x, y)) - contact.points
        along = np.sum(offset * contact.tangent, axis=1)
        off = np.abs(offset[:, 0] * contact.tangent[:, 1] - offset[:, 1] * contact.tangent[:, 0])
        off[contact.open | (along < 1e-9) | (along > contact.length - 1e-9)] = math.inf
        assert off.min() < 1e-6
        return int(off.argmin()), float(along[off.argmin()])

    def goal_edge(self, a: Point, b: Point) -> Bench:
        """From `a` to `b` on one edge; vertices only if asked for as well."""
        edge, _ = self.on(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
        start = self.space.contact.points[edge]
        ends = sorted(math.dist(start, self.at(*place)) for place in (a, b))
        self.edges.append((edge, ends[0], ends[1]))
        return self

    def goal_vertex(self, *places: Point) -> Bench:
        self.vertices += [self.vertex(*place) for place in places]
        return self

    def goal_area(self, shape: BaseGeometry) -> Bench:
        turned = shapely.affinity.rotate(shape, self.turn, origin=(0, 0), use_radians=True)
        self.area = areas.union(self.area, areas.intersection(Area.of(turned), self.space.free))
        return self

    @property
    def target(self) -> Region:
        contact = ContactSet.of(
            [edge for edge, _, _ in self.edges],
            [low for _, low, _ in self.edges],
            [high for _, _, high in self.edges],
            self.vertices,
            self.space.tolerance.length,
        )
        return Region(self.area, contact)

    def back(
        self, theta: float = THETA, phi: float = PHI, direction: float = DOWN
    ) -> ReferenceBackprojection:
        return reference_backprojection(self.space, self.target, direction + self.turn, theta, phi)

    def free(self, found: ReferenceBackprojection, *places: Point) -> list[bool]:
        return [found.holds_free(*self.at(*place)) for place in places]

    def edge(self, found: ReferenceBackprojection, *places: Point) -> list[bool]:
        return [found.holds_edge(*self.on(*place)) for place in places]

    def corner(self, found: ReferenceBackprojection, *places: Point) -> list[bool]:
        return [found.holds_vertex(self.vertex(*place)) for place in places]


# --- closed forms -----------------------------------------------------------------------------


@pytest.mark.parametrize("turn", [0.0, math.radians(90), math.radians(45), math.radians(37)])
@pytest.mark.parametrize("theta", [math.radians(15), THETA, math.radians(45), math.radians(80)])
def test_goal_segment_on_a_floor_that_sticks_is_a_triangle(turn: float, theta: float) -> None:
    """Height L/(2 tan theta), area L^2/(4 tan theta)."""
    bench = Bench([GROUND], turn, (-20.0, -20.0, 20.0, 20.0)).goal_edge((-2.0, 0.0), (2.0, 0.0))
    found = bench.back(theta, math.radians(85))
    assert found.area.measure == pytest.approx(16.0 / (4.0 * math.tan(theta)), rel=1e-9)
    top = 2.0 / math.tan(theta)
    assert bench.free(found, (0.0, top - 1e-6), (0.0, top + 1e-6)) == [True, False]
    assert bench.edge(found, (0.0, 0.0), (2.0, 0.0), (2.0 + 1e-6, 0.0)) == [True, True, False]


def test_goal_segment_without_control_error_is_a_strip() -> None:
    bench = Bench([GROUND]).goal_edge((-2.0, 0.0), (2.0, 0.0))
    found = bench.back(0.0, 0.0)
    assert found.area.measure == pytest.approx(80.0, rel=1e-8)
    assert bench.free(found, (1.9, 19.0), (2.1, 0.1), (2.0, 5.0)) == [True, False, False]


@pytest.mark.parametrize("turn", [0.0, math.radians(45), math.radians(200)])
def test_point_goal_in_a_frictionless_notch(turn: float) -> None:
    """The two walls, and all above that cannot escape past their upper ends."""
    notch = shapely.Polygon([(-40, 0), (-3, 0), (0, -4), (3, 0), (40, 0), (40, -40), (-40, -40)])
    window = (-16.0, -16.0, 16.0, 16.0)
    bench = Bench([notch], turn, window).goal_vertex((0.0, -4.0))
    found = bench.back(THETA, 0.0)
    assert found.area.measure == pytest.approx(12.0 + 9.0 / math.tan(THETA), rel=1e-9)
    assert bench.edge(found, (-1.5, -2.0), (2.7, -0.4), (-1e-3, -4.0 + 4e-3 / 3)) == [True] * 3
    assert bench.corner(found, (0.0, -4.0), (-3.0, 0.0), (3.0, 0.0)) == [True, False, False]
    assert bench.edge(found, (-4.0, 0.0)) == [False]
    # with friction the walls may hold the robot
    stuck = bench.back(THETA, math.radians(40))
    assert stuck.area.is_empty
    assert stuck.contact.total_length == 0.0


@pytest.mark.parametrize("turn", [0.0, math.radians(45), math.radians(-70)])
def test_figure_6_a_tip_whose_two_slides_end_in_the_target(turn: float) -> None:
    """Around the diamond B is not simply connected; where the diamond holds, a shadow is cast."""
    diamond = shapely.Polygon([(0, 1.5), (0.5, 2.0), (0, 2.5), (-0.5, 2.0)])
    window = (-20.0, -20.0, 20.0, 20.0)
    bench = Bench([GROUND, diamond], turn, window).goal_edge((-4.0, 0.0), (4.0, 0.0))
    whole = 64.0 / (4.0 * math.tan(THETA))
    found = bench.back(THETA, math.radians(10))
    assert found.area.measure == pytest.approx(whole - 0.5, rel=1e-9)
    assert len(found.area.rings) == 2
    assert bench.corner(found, (0, 2.5), (0.5, 2), (-0.5, 2), (0, 1.5)) == [True] * 4
    assert bench.edge(found, (0.25, 2.25), (-0.25, 2.25), (0.25, 1.75)) == [True] * 3
    # what flies to the upper sides sticks: gone is all that sees them, within the cone
    held = bench.back(THETA, math.radians(30))
    assert bench.corner(held, (0, 2.5), (0.5, 2), (-0.5, 2), (0, 1.5)) == [False] * 3 + [True]
    assert bench.edge(held, (0.25, 2.25), (-0.25, 2.25), (0.25, 1.75)) == [False, False, True]
    assert bench.free(held, (0.0, 2.6), (0.0, 1.0), (1.0, 2.0)) == [False, True, True]
    # the shadow's side x = 0.5 + (h - 2) tan meets the triangle's side x = 4 - h tan
    tan = math.tan(THETA)
    x, top = 2.25 - tan, 1.75 / tan + 1.0
    assert bench.free(held, (x, top - 1e-6), (x, top + 1e-6), (0.0, 10.0)) == [True, False, False]


@pytest.mark.parametrize("turn", [0.0, math.radians(135), math.radians(11)])
def test_area_in_the_air_casts_a_cone_above(turn: float) -> None:
    box = shapely.box(-1.0, 3.0, 1.0, 4.0)
    bench = Bench([GROUND], turn, (-20.0, -20.0, 20.0, 20.0)).goal_area(box)
    found = bench.back()
    assert found.area.measure == pytest.approx(2.0 + 1.0 / math.tan(THETA), rel=1e-9)
    assert found.contact.is_empty
    top = 4.0 + 1.0 / math.tan(THETA)
    assert bench.free(found, (0, 3.5), (0, top - 1e-6), (0, top + 1e-6), (0, 2)) == [
        True,
        True,
        False,
        False,
    ]


def test_union_of_targets_can_exceed_the_union_of_backprojections() -> None:
    left = Bench([GROUND]).goal_edge((-2.0, 0.0), (0.0, 0.0))
    right = Bench([GROUND]).goal_edge((0.0, 0.0), (2.0, 0.0))
    both = Bench([GROUND]).goal_edge((-2.0, 0.0), (0.0, 0.0)).goal_edge((0.0, 0.0), (2.0, 0.0))
    parts = left.back().area.measure + right.back().area.measure
    assert both.back().area.measure == pytest.approx(2.0 * parts, rel=1e-9)


# --- features keep to themselves --------------------------------------------------------------


def test_floor_without_its_corner_loses_what_can_be_steered_into_the_corner() -> None:
    step = shapely.box(2.0, -1.0, 30.0, 6.0)
    bench = Bench([GROUND, step]).goal_edge((-2.0, 0.0), (2.0, 0.0))
    without = bench.back()
    assert bench.corner(without, (2.0, 0.0)) == [False]
    assert bench.edge(without, (2.0, 1.0)) == [False]
    assert bench.free(without, (1.99, 0.1), (0.0, 0.1)) == [False, True]
    found = bench.goal_vertex((2.0, 0.0)).back(phi=0.0)
    assert bench.edge(found, (2.0, 1.0), (2.0, 5.9)) == [True, True]
    assert bench.free(found, (1.99, 0.1), (1.99, 5.9)) == [True, True]
    half = 4.0 / math.tan(THETA) * 4.0 / 2.0  # a ray from the goal's left end, up to the wall
    above = (4.0 / math.tan(THETA) - 6.0) * math.tan(THETA)  # free to both sides over the step
    assert found.area.measure == pytest.approx(
        half - above * above / math.tan(THETA) / 2.0 + above * above / math.tan(THETA) / 4.0,
        rel=1e-9,
    )


def test_wall_may_belong_while_the_corner_below_it_does_not() -> None:
    step = shapely.box(2.0, -1.0, 30.0, 6.0)
    bench = Bench([GROUND, step]).goal_edge((2.0, 0.0), (2.0, 6.0))
    found = bench.back(phi=0.0)
    assert bench.edge(found, (2.0, 1e-3), (2.0, 3.0)) == [True, True]
    assert bench.corner(found, (2.0, 0.0), (2.0, 6.0)) == [False, False]
    assert bench.free(found, (1.99, 3.0)) == [False]


def test_corner_alone_out_of_the_target_casts_a_cone() -> None:
    """Floor and wall are in T, the corner between them is not: nature can steer into it."""
    step = shapely.box(2.0, -1.0, 30.0, 6.0)
    bench = Bench([GROUND, step]).goal_edge((-3.0, 0.0), (2.0, 0.0))
    bench.goal_edge((2.0, 0.0), (2.0, 6.0))
    found = bench.back()
    tan = math.tan(THETA)
    assert bench.edge(found, (1.0, 0.0), (2.0, 5.0)) == [True, True]
    at = 2.0 - 3.0 * tan
    assert bench.free(found, (at - 1e-6, 3.0), (at + 1e-6, 3.0)) == [True, False]
    assert found.area.measure == pytest.approx(25.0 / (4.0 * tan), rel=1e-9)


@pytest.mark.parametrize("turn", [0.0, math.radians(45)])
def test_tip_that_may_stick_out_of_the_target_casts_a_cone(turn: float) -> None:
    roof = shapely.Polygon([(-40, -20), (0, 0), (40, -20), (40, -40), (-40, -40)])
    bench = Bench([roof], turn, (-16.0, -16.0, 16.0, 16.0))
    bench.goal_edge((-4.0, -2.0), (0.0, 0.0)).goal_edge((0.0, 0.0), (4.0, -2.0))
    found = bench.back()
    at = 2.0 * math.tan(THETA)
    assert bench.free(found, (at - 1e-6, 2.0), (at + 1e-6, 2.0), (at + 0.5, 1.5)) == [
        False,
        True,
        True,
    ]
    assert bench.edge(found, (-1e-3, -0.5e-3)) == [True]
    whole = bench.goal_vertex((0.0, 0.0)).back()
    assert bench.free(whole, (0.0, 2.0), (0.0, 4.0 / math.tan(THETA) - 2.1)) == [True, True]


def test_interval_within_a_longer_edge_that_slides() -> None:
    """Above the interval all slides into it, below it all slides away."""
    slope = shapely.Polygon([(-8, 8), (8, -8), (30, -30), (-30, -30), (-30, 8)])
    bench = Bench([slope]).goal_edge((-1.0, 1.0), (1.0, -1.0))
    found = bench.back(math.radians(5), math.radians(10))
    assert bench.edge(found, (-7.0, 7.0), (0.0, 0.0), (1.1, -1.1)) == [True, True, False]
    assert bench.corner(found, (-8.0, 8.0)) == [False]
    assert bench.free(found, (-6.0, 6.1), (0.5, -0.4), (1.5, -1.4)) == [True, True, False]


def test_area_beside_an_edge_that_is_not_in_the_target_is_slid_under() -> None:
    slope = shapely.Polygon([(-8, 8), (8, -8), (30, -30), (-30, -30), (-30, 8)])
    patch = shapely.Polygon([(-2, 2), (2, -2), (2, 4), (-2, 6)])
    bench = Bench([slope]).goal_area(patch)
    found = bench.back(math.radians(5), math.radians(10))
    assert bench.edge(found, (-3.0, 3.0), (0.0, 0.0), (3.0, -3.0)) == [False, False, False]
    assert bench.free(found, (0.0, 1.0), (0.0, 5.1), (-3.0, 3.5)) == [True, True, False]
    with_edge = bench.goal_edge((-2.0, 2.0), (2.0, -2.0)).back(math.radians(5), math.radians(10))
    assert bench.edge(with_edge, (-3.0, 3.0), (0.0, 0.0), (3.0, -3.0)) == [True, True, False]
    assert bench.free(with_edge, (-3.0, 3.5)) == [True]


def test_tip_alone_catches_nothing() -> None:
    spike = shapely.Polygon([(-1, 0), (1, 0), (0, 3)])
    bench = Bench([GROUND, spike]).goal_vertex((0.0, 3.0))
    for theta in (0.0, THETA):
        found = bench.back(theta, 0.0)
        assert bench.corner(found, (0.0, 3.0)) == [True]
        assert bench.free(found, (0.0, 4.0), (0.1, 4.0)) == [False, False]
        assert found.area.is_empty


def test_who_may_leave_through_an_open_side_is_lost() -> None:
    slope = shapely.Polygon([(-10, 4), (10, -4), (30, -12), (30, -30), (-30, -30), (-30, 12)])
    bench = Bench([slope]).goal_edge((5.0, -2.0), (9.0, -3.6))
    found = bench.back(math.radians(5), 0.0)
    assert bench.edge(found, (-9.0, 3.6), (7.0, -2.8), (9.5, -3.8)) == [True, True, False]
    assert bench.corner(found, (10.0, -4.0)) == [False]
    assert bench.free(found, (9.9, 19.0), (-9.9, 19.0), (0.0, 10.0)) == [False, False, True]


def test_vertex_of_the_target_beside_an_open_side_has_met_the_target() -> None:
    slope = shapely.Polygon([(-10, 4), (10, -4), (30, -12), (30, -30), (-30, -30), (-30, 12)])
    bench = Bench([slope]).goal_vertex((10.0, -4.0))
    found = bench.back(math.radians(5), 0.0)
    assert bench.corner(found, (10.0, -4.0)) == [True]
    assert bench.edge(found, (0.0, 0.0)) == [True]
    assert bench.free(found, (9.95, -3.0), (0.0, 0.1)) == [False, True]


def test_ceiling_that_may_stick() -> None:
    """With phi + theta > pi/2 an overhang holds who is pushed up against it."""
    overhang = shapely.Polygon([(2, 0), (3, -1), (3, 5), (1.5, 5)])
    bench = Bench([GROUND, overhang]).goal_edge((-9.0, 0.0), (2.0, 0.0)).goal_vertex((2.0, 0.0))
    tilt = math.degrees(math.atan(0.1))  # the left side leans over by so much
    loose = bench.back(math.radians(20), math.radians(60))
    assert bench.edge(loose, (1.75, 2.5)) == [True]
    assert bench.free(loose, (1.6, 2.5)) == [True]
    tight = bench.back(math.radians(20), math.radians(70 + tilt + 1.0))
    assert bench.edge(tight, (1.75, 2.5)) == [False]
    assert bench.free(tight, (1.6, 2.5), (1.0, 0.1)) == [False, True]


@pytest.mark.parametrize("wall", [THETA, -THETA])
def test_wall_parallel_to_a_side_of_the_cone(wall: float) -> None:
    """A slide along the cone's side; past the wall nature flies, along it she need not."""
    run = 4.0 * math.tan(wall)
    # the wall rises from (3, 0), leaning by the cone's half-angle to either side
    block = shapely.Polygon([(3, 0), (3 + run, 4), (8, 4), (8, 0)])
    bench = Bench([GROUND, block]).goal_edge((-3.0, 0.0), (3.0, 0.0)).goal_vertex((3.0, 0.0))
    found = bench.back(THETA, 0.0)
    assert bench.free(found, (0.0, 1.0), (2.9, 0.05)) == [True, True]
    assert bench.edge(found, (3 + 0.5 * run, 2.0)) == [True]
    bench.vertices.clear()
    found = bench.back(THETA, 0.0)
    assert bench.edge(found, (3 + 0.5 * run, 2.0)) == [False]


def test_rooms_and_pinches() -> None:
    """Two blocks that touch in a point close the way between them: it is a notch, from above."""
    blocks = [
        shapely.Polygon([(-3, 3), (0, 0), (-3, -3), (-6, 0)]),
        shapely.Polygon([(3, 3), (0, 0), (3, -3), (6, 0)]),
    ]
    bench = Bench(blocks)
    above, below = sorted(
        (i for i, p in enumerate(bench.space.contact.points.tolist()) if math.hypot(*p) < 1e-9),
        key=lambda i: -bench.space.contact.tangent[i][1],
    )
    bench.vertices.append(above)
    found = bench.back(math.radians(10), 0.0)
    assert bench.free(found, (0.0, 1.0), (0.0, -1.0)) == [True, False]
    assert found.holds_vertex(above)
    assert not found.holds_vertex(below)
    bench.vertices[:] = [below]
    assert bench.free(bench.back(math.radians(10), 0.0), (0.0, 1.0)) == [False]
