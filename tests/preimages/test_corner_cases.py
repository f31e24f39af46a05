"""The corner cases of theory 5 and 6, each with what the preimage must not claim, or must."""

import math
from random import Random

import numpy as np
import pytest
from shapely import Polygon, box

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area
from preimage.preimages.methods import preimage
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.recognition.kernel import kernel
from preimage.recognition.readings import alike
from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.task.options import Method
from preimage.task.task import SlidingLaw
from preimage.task.workspace import Side
from tests.laws.adversaries import CONTROLS
from tests.laws.passage import starts
from tests.laws.simulation import Execution
from tests.preimages.scenes import DOWN, contact, edge_between, setting, vertex_at
from tests.strategies import space_of


def carry_out(bounds: Setting, made: Preimage, count: int = 12) -> None:
    """From all over a preimage, under every control."""
    assert not made.region.is_empty
    execution = Execution.of(bounds, made)
    rng = Random(0)
    for start in starts(execution.world, made.region, rng, count):
        for control in CONTROLS:
            execution.run(start, control, rng, 0.3)


def on(made: Region, space: ConfigurationSpace, edge: int, share: float) -> bool:
    return made.contact.contains(edge, share * float(space.contact.length[edge]), 0.0)


# --- a floor told from its walls, but not from its corners ----------------------------------

ROOM = box(-9, -9, 9, 9).difference(box(-4, 0, 4, 6))
FLOOR, LEFT, RIGHT = (-4.0, 0.0), (-4.0, 6.0), (4.0, 0.0)


def test_a_floor_without_its_corners_is_no_target_for_what_may_reach_them() -> None:
    """The kernel is not closed across features (theory 5)."""
    space = space_of([ROOM])
    floor = (FLOOR, RIGHT)
    goal = contact(space, [floor], [FLOOR, RIGHT])
    bounds = setting(space, 10, 20, 0.5)
    made = preimage(bounds, goal, DOWN, Method.KERNEL)
    edge = edge_between(space, *floor)
    assert made.target.region.contact.edge.tolist() == [edge]
    assert made.target.region.contact.total_length == pytest.approx(8.0)
    assert not len(made.target.region.contact.vertices)
    # a wall sheds into its corner, and the cone from above reaches it
    wall = edge_between(space, FLOOR, LEFT)
    assert not on(made.region, space, wall, 0.5)
    slope = math.tan(math.radians(10))
    for height in (1.0, 5.0):
        rim = 4.0 - height * slope
        assert made.region.area.contains(rim - 1e-6, height)
        assert not made.region.area.contains(rim + 1e-6, height)
        assert not made.region.area.contains(-rim - 1e-6, height)
    for corner in (FLOOR, RIGHT):
        assert not made.region.contact.has_vertex(vertex_at(space, corner))
    carry_out(bounds, made)


def test_sticking_tells_the_corners_that_the_kernel_loses() -> None:
    """In the room the corners hold for sure: method 1 claims all of it."""
    space = space_of([ROOM])
    goal = contact(space, [(FLOOR, RIGHT)], [FLOOR, RIGHT])
    bounds = setting(space, 10, 20, 0.5)
    for method in (Method.STICKING, Method.COMBINED):
        made = preimage(bounds, goal, DOWN, method)
        assert made.region.area.measure == pytest.approx(48.0)
        assert set(goal.contact.vertices.tolist()) <= set(made.region.contact.vertices.tolist())
        carry_out(bounds, made)


# --- a notch that reads like a floor ----------------------------------------------------------

SIDES = ((-3.0, 0.0), (-2.0, -2.0), (-1.0, 0.0))
NOTCHED = Polygon([(-9, -9), (9, -9), (9, 0), *reversed(SIDES), (-9, 0)])


def test_a_notch_reads_like_the_floor_beside_it() -> None:
    """Vertices are features (theory 3): the bottom takes from a floor that edges alone leave it."""
    space = space_of([NOTCHED])
    left, right = ((-6.0, 0.0), SIDES[0]), (SIDES[2], (6.0, 0.0))
    goal = contact(space, [left, right], [left[0], left[1], *right])
    bounds = setting(space, 5, 0, 1.25, (0.0, 0.05, 0.05))
    sets = bounds.command(DOWN).readings
    floor, bottom = edge_between(space, *right), vertex_at(space, SIDES[1])
    assert alike(sets, floor, np.array([sets.size + bottom])).all()
    sides = np.array([edge_between(space, SIDES[i], SIDES[i + 1]) for i in (0, 1)])
    assert not alike(sets, floor, sides).any()
    core = kernel(space, sets, goal, bounds.uncertainty)
    # the bottom is 2 below: within 2 rho = 2.5 up to 1.5 to each side of x = -2
    place = space.contact.at(core.contact.edge, core.contact.low)[:, 0]
    stop = space.contact.at(core.contact.edge, core.contact.high)[:, 0]
    spans = sorted(sorted(pair) for pair in zip(place.tolist(), stop.tolist(), strict=True))
    assert spans[0][1] == pytest.approx(-3.5, abs=1e-7)
    assert spans[1][0] == pytest.approx(-0.5, abs=1e-7)
    assert not len(core.contact.vertices)  # those of the floor are at the open border


def test_a_floor_that_is_told_from_a_far_notch() -> None:
    space = space_of([NOTCHED], walls=[Side.LEFT, Side.RIGHT])
    goal = contact(space, [(SIDES[2], (6.0, 0.0))], [SIDES[2], (6.0, 0.0)])
    bounds = setting(space, 5, 20, 0.1)
    made = preimage(bounds, goal, DOWN, Method.COMBINED)
    assert made.region.area.contains(2.0, 4.0)
    assert not made.region.area.contains(-2.0, 1.0)
    carry_out(bounds, made)


# --- sticking without friction ----------------------------------------------------------------


@pytest.mark.parametrize("law", SlidingLaw)
@pytest.mark.parametrize("control", [0.0, 5.0, 25.0])
def test_a_notch_holds_without_friction(control: float, law: SlidingLaw) -> None:
    """Method 1 with a concave vertex that sticks for sure (theory 2, 6): both walls and above."""
    space = space_of([NOTCHED])
    goal = contact(space, [], [SIDES[1]])
    bounds = setting(space, control, 0, 0.1, None, law)
    made = preimage(bounds, goal, DOWN, Method.STICKING)
    assert made.target.region.contact.vertices.tolist() == [vertex_at(space, SIDES[1])]
    [condition] = made.termination
    assert isinstance(condition, StickingCondition)
    assert condition.distance >= 0.2
    for i in (0, 1):
        edge = edge_between(space, SIDES[i], SIDES[i + 1])
        assert on(made.region, space, edge, 0.5)
        assert on(made.region, space, edge, 0.999)
    assert made.region.area.contains(-2.0, 1.0)
    assert not made.region.area.contains(-0.5, 1.0)
    carry_out(bounds, made)


def test_a_notch_does_not_hold_a_motion_past_its_walls() -> None:
    """The hull of the normals spans 127 degrees here: -v* must stay in it for all of the cone."""
    space = space_of([NOTCHED])
    goal = contact(space, [], [SIDES[1]])
    steep = math.degrees(math.atan2(2, 1))
    for control, held in ((steep - 0.1, True), (steep + 0.1, False)):
        made = preimage(setting(space, control, 0, 0.1), goal, DOWN, Method.STICKING)
        assert made.target.region.is_empty is not held


# --- the combined method ------------------------------------------------------------------------

RIDGE = Polygon([(0, 3), (-1, 0), (1, 0)])


def test_combined_exceeds_the_union_of_both() -> None:
    """One side is told by sticking alone, the other by reading alone; a ridge sheds to both.

    On the left a pit whose floor sticks, so near to a plateau that reads alike; on the right a
    slope that slides, unlike all around it.
    """
    slope = Polygon([(1, 0), (6, -5), (6, -9), (1, -9)])
    ground = box(-9, -9, 1, 0).union(box(-9, -9, -3, 1))
    space = space_of([ground, slope, RIDGE], walls=[Side.LEFT, Side.RIGHT])
    pit, right = ((-3.0, 0.0), (-1.0, 0.0)), ((1.0, 0.0), (6.0, -5.0))
    goal = contact(space, [pit, right], [*pit, right[0]])
    bounds = setting(space, 3, 10, 1.3, (2.0, 0.05, 0.05))
    by = {method: preimage(bounds, goal, DOWN, method) for method in Method}
    assert by[Method.STICKING].target.region.contact.edge.tolist() == [edge_between(space, *pit)]
    assert by[Method.KERNEL].target.region.contact.edge.tolist() == [edge_between(space, *right)]
    above, top = (0.0, 5.0), vertex_at(space, (0.0, 3.0))
    for method, made in by.items():
        assert made.region.area.contains(*above) is (method is Method.COMBINED)
        assert made.region.contact.has_vertex(top) is (method is Method.COMBINED)
        carry_out(bounds, made)
    kinds = [type(condition) for condition in by[Method.COMBINED].termination]
    assert kinds == [StickingCondition, ReadingCondition]


# --- without a position sensor ------------------------------------------------------------------


def test_force_alone_tells_a_floor_in_a_room() -> None:
    """rho is infinite: a feature is kept whole or lost (theory 5)."""
    space = space_of([ROOM])
    goal = contact(space, [(FLOOR, RIGHT)], [FLOOR, RIGHT])
    bounds = setting(space, 10, 20, math.inf)
    made = preimage(bounds, goal, DOWN, Method.KERNEL)
    edge = edge_between(space, FLOOR, RIGHT)
    assert made.target.region.contact.edge.tolist() == [edge]
    assert made.target.region.contact.total_length == pytest.approx(8.0)
    assert isinstance(made.termination[0], ReadingCondition)
    carry_out(bounds, made)
    shelf = space_of([ROOM, box(1, 2, 4, 3)])
    goal = contact(shelf, [(FLOOR, RIGHT)], [FLOOR, RIGHT])
    assert preimage(setting(shelf, 10, 20, math.inf), goal, DOWN, Method.KERNEL).region.is_empty


def test_blind_sticking_by_the_clock() -> None:
    """Neither position nor force: the longest way over the guaranteed progress (theory 6)."""
    space = space_of([NOTCHED])
    goal = contact(space, [], [SIDES[1]])
    for law in SlidingLaw:
        bounds = setting(space, 5, 0, math.inf, None, law)
        made = preimage(bounds, goal, DOWN, Method.COMBINED)
        assert made.target.kernel.is_empty
        [condition] = made.termination
        assert isinstance(condition, ElapsedCondition)
        top = max(y for ring in made.region.area.rings for _, y in ring)
        # down a wall 63 degrees steep, at the least of what nature allows
        progress = math.sin(math.atan2(2, 1)) * math.sin(math.atan2(2, 1) - math.radians(5))
        assert condition.period == pytest.approx((top + 2.0) / progress)
        carry_out(bounds, made)


def test_blind_corner_in_two_motions() -> None:
    """A frictionless room: down, then to the left, by the clock alone."""
    space = space_of([ROOM])
    bounds = setting(space, 5, 0, math.inf, None)
    corner = contact(space, [], [FLOOR])
    aslant = math.radians(225)
    made = preimage(bounds, corner, aslant, Method.STICKING)
    assert isinstance(made.termination[0], ElapsedCondition)
    assert made.region.area.measure == pytest.approx(48.0)
    carry_out(bounds, made)


# --- convex ends ----------------------------------------------------------------------------------


def test_the_convex_end_of_a_sticking_edge_is_not_in_the_target() -> None:
    """There the robot may behave as on the side, and leave (theory 2)."""
    space = space_of([box(-3, -9, 3, 0)])
    top = ((-3.0, 0.0), (3.0, 0.0))
    goal = contact(space, [top], top)
    bounds = setting(space, 5, 20, 0.1)
    made = preimage(bounds, goal, DOWN, Method.STICKING)
    assert made.target.region.contact.total_length == pytest.approx(6.0)
    assert not len(made.target.region.contact.vertices)
    for end in top:
        assert not made.region.contact.has_vertex(vertex_at(space, end))
    slope = math.tan(math.radians(5))
    assert made.region.area.contains(3.0 - 2 * slope - 1e-6, 2.0)
    assert not made.region.area.contains(3.0 - 2 * slope + 1e-6, 2.0)
    carry_out(bounds, made)


def test_a_convex_end_between_two_sticking_edges_is_in_the_target() -> None:
    space = space_of([Polygon([(-3, 0), (0, 1), (3, 0), (3, -6), (-3, -6)])])
    ridge = [((-3.0, 0.0), (0.0, 1.0)), ((0.0, 1.0), (3.0, 0.0))]
    goal = contact(space, ridge, [(0.0, 1.0)])
    bounds = setting(space, 5, 40, 0.1)
    made = preimage(bounds, goal, DOWN, Method.STICKING)
    assert made.target.region.contact.vertices.tolist() == [vertex_at(space, (0.0, 1.0))]
    assert made.region.area.contains(0.0, 3.0)
    carry_out(bounds, made)


# --- ties -------------------------------------------------------------------------------------


def test_perfect_control_does_not_start_above_a_tip() -> None:
    """Ties are nature's (theory 8): a robot that falls on a box's corner may stay there."""
    shelf = box(0, 2, 1, 3)
    space = space_of([box(-9, -9, 9, 0), shelf])
    goal = contact(space, [((-6.0, 0.0), (6.0, 0.0))])
    for method in Method:
        made = preimage(setting(space, 0, 20, 0.01), goal, DOWN, method)
        for x in (-1e-6, 1.0 + 1e-6):
            assert made.region.area.contains(x, 5.0), method
        for x in (0.0, 1e-9, 0.5, 1.0):
            assert not made.region.area.contains(x, 5.0), method


def test_friction_as_wide_as_the_cone_is_not_sure_to_hold() -> None:
    space = space_of([box(-9, -9, 9, 0)], walls=list(Side))
    goal = contact(space, [((-6.0, 0.0), (6.0, 0.0))])
    for friction, held in ((5.0, False), (5.001, True)):
        made = preimage(setting(space, 5, friction, 0.1), goal, DOWN, Method.STICKING)
        assert made.target.region.is_empty is not held


def test_a_goal_that_is_empty_has_no_preimage() -> None:
    space = space_of([ROOM])
    for method in Method:
        made = preimage(setting(space, 5, 20, 0.1), Region.empty(), DOWN, method)
        assert made.region.is_empty
        assert not made.termination


def test_all_of_valid_space_is_recognised_at_once() -> None:
    space = space_of([ROOM])
    made = preimage(setting(space, 5, 20, 0.5), space.valid, DOWN, Method.KERNEL)
    assert made.region.area.measure == pytest.approx(space.free.measure)
    assert isinstance(made.region.area, Area)
