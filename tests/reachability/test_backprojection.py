"""The sweep against closed forms, against the slab reference, and against degenerate input."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
from shapely import Polygon, box

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.reachability.assembly import attach
from preimage.reachability.backprojection import _sweep, backproject
from preimage.reachability.sources import sources
from preimage.task.workspace import Side
from preimage.verification.reference import reference_backprojection
from tests.strategies import Scene, random_scene, space_of

DOWN = math.radians(270)


def edge_between(space: ConfigurationSpace, a: tuple[float, float], b: tuple[float, float]) -> int:
    """The contact edge with these ends, in either order."""
    ends = np.stack((space.contact.points, space.contact.ends), axis=1)
    for pair in ((a, b), (b, a)):
        found = np.flatnonzero(np.abs(ends - np.array(pair)).max(axis=(1, 2)) < 1e-6)
        if len(found):
            return int(found[0])
    raise AssertionError(f"no edge from {a} to {b}")


def vertex_at(space: ConfigurationSpace, x: float, y: float) -> int:
    """The vertex at a place."""
    return int(np.argmin(np.hypot(*(space.contact.points - (x, y)).T)))


def backprojected(space: ConfigurationSpace, target: Region, *degrees: float) -> Region:
    """The backprojection, given direction, control and friction in degrees."""
    direction, control, friction = (math.radians(angle) for angle in degrees)
    command = sources(space.contact, direction, control, friction, space.tolerance)
    return backproject(space, target, command).region


def on_edge(space: ConfigurationSpace, edge: int, low: float, high: float) -> Region:
    """A stretch of one edge."""
    return Region(Area.empty(), ContactSet.of([edge], [low], [high], [], space.tolerance.length))


@pytest.mark.parametrize("control", [5.0, 10.0, 30.0, 60.0])
def test_goal_on_a_floor_that_sticks_has_a_triangle(control: float) -> None:
    """Height L / (2 tan theta), area L^2 / (4 tan theta) (theory 4)."""
    length = 4.0
    space = space_of([box(-60, -9, 60, 0)], window=(-50, -2, 50, 50))
    floor = edge_between(space, (-50, 0), (50, 0))
    goal = on_edge(space, floor, 50 - length / 2, 50 + length / 2)
    region = backprojected(space, goal, 270, control, 80)
    slope = math.tan(math.radians(control))
    assert region.area.measure == pytest.approx(length**2 / (4 * slope), abs=1e-9)
    apex = max(y for _, y in region.area.rings[0])
    assert apex == pytest.approx(length / (2 * slope), abs=1e-9)
    assert contact_set.is_subset(region.contact, goal.contact, 1e-9)


def test_perfect_control_gives_the_column_above_the_goal() -> None:
    space = space_of([box(-9, -9, 9, 0)])
    floor = edge_between(space, (-6, 0), (6, 0))
    region = backprojected(space, on_edge(space, floor, 4, 7), 270, 0, 30)
    assert region.area.measure == pytest.approx(3 * 6, abs=1e-7)
    assert not region.area.contains(-2.0 - 1e-8, 3.0)
    assert region.area.contains(-0.5, 3.0)


@pytest.mark.parametrize("mouth", [2.0, 4.0])
def test_notch_without_friction_draws_in_what_cannot_escape(mouth: float) -> None:
    """A point goal in a V: the walls, and what cannot get past their upper ends (theory 4)."""
    notch = Polygon([(-9, 0), (-mouth, 0), (0, -4), (mouth, 0), (9, 0), (9, -6), (-9, -6)])
    space = space_of([notch])
    bottom = vertex_at(space, 0, -4)
    goal = Region(Area.empty(), ContactSet.of([], [], [], [bottom], 1e-9))
    control = 10.0
    region = backprojected(space, goal, 270, control, 0)
    left = edge_between(space, (-mouth, 0), (0, -4))
    right = edge_between(space, (0, -4), (mouth, 0))
    length = math.hypot(mouth, 4)
    assert sorted(region.contact.edge.tolist()) == sorted([left, right])
    assert region.contact.high - region.contact.low == pytest.approx([length, length])
    assert region.contact.vertices.tolist() == [bottom]
    slope = math.tan(math.radians(control))
    height = 6.0  # of the window above the mouth
    top = mouth - height * slope
    above = height * (mouth + top) if top > 0 else mouth**2 / slope
    assert region.area.measure == pytest.approx(mouth * 4 + above, abs=1e-9)


def test_ridge_that_sheds_to_both_sides_leaves_no_hole() -> None:
    """A convex vertex whose two slides both end in the target is not avoidable (Figure 6)."""
    ridge = Polygon([(0, 2), (-1, 0.5), (0, 0), (1, 0.5)])
    space = space_of([box(-9, -9, 9, -2), ridge])
    floor = edge_between(space, (-6, -2), (6, -2))
    goal = on_edge(space, floor, 1, 11)
    region = backprojected(space, goal, 270, 5, 10)
    top = vertex_at(space, 0, 2)
    assert region.contact.has_vertex(top)
    assert region.area.contains(0, 3)
    assert len(region.area.rings) == 2  # the ridge is a hole

    sticky = backprojected(space, goal, 270, 5, 60)
    assert not sticky.contact.has_vertex(top)
    assert not sticky.area.contains(0, 3)


def test_union_of_targets_has_more_than_the_union_of_backprojections() -> None:
    """Paper 5.2: which of two goals is met may not be known beforehand."""
    ridge = Polygon([(0, 2), (-1, 0), (1, 0)])
    space = space_of([box(-9, -9, 9, 0), ridge])
    left = on_edge(space, edge_between(space, (-6, 0), (-1, 0)), 0, 5)
    right = on_edge(space, edge_between(space, (1, 0), (6, 0)), 0, 5)
    command = (270, 5, 10)
    corners = ContactSet.of([], [], [], [vertex_at(space, -1, 0), vertex_at(space, 1, 0)], 1e-9)
    both = Region(
        Area.empty(),
        contact_set.union(contact_set.union(left.contact, right.contact, 1e-9), corners, 1e-9),
    )
    together = backprojected(space, both, *command).area
    apart = areas.union(
        backprojected(space, left, *command).area, backprojected(space, right, *command).area
    )
    assert areas.is_subset(apart, together, 1e-9)
    assert together.contains(0, 4)
    assert not apart.contains(0, 4)


def test_walls_hold_but_open_sides_do_not() -> None:
    goal_floor = box(-9, -9, 9, -5)
    for walls, measure in (((), None), ((Side.LEFT, Side.RIGHT), 12 * 11)):
        space = space_of([goal_floor], walls=walls)
        floor = edge_between(space, (-6, -5), (6, -5))
        corners = space.contact.vertices[space.contact.points[space.contact.vertices][:, 1] == -5]
        goal = Region(
            Area.empty(), ContactSet.of([floor], [0], [12], corners, space.tolerance.length)
        )
        region = backprojected(space, goal, 270, 10, 0)
        if measure is None:
            lost = 11 * math.tan(math.radians(10)) * 11
            assert region.area.measure == pytest.approx(12 * 11 - lost, abs=1e-9)
        else:
            assert region.area.measure == pytest.approx(measure, abs=1e-9)


def test_wall_belongs_without_the_corner_below_it() -> None:
    """A wall above a target on it is in B; the floor's corner below the target is not."""
    space = space_of([box(-9, -9, 9, -2), box(2, -3, 9, 4)])
    wall = edge_between(space, (2, -2), (2, 4))
    length = space.contact.length[wall]
    rising = bool(space.contact.points[wall][1] < 0)
    low, high = (2.0, 3.0) if rising else (length - 3.0, length - 2.0)
    region = backprojected(space, on_edge(space, wall, low, high), 290, 5, 0)
    above = (high, length) if rising else (0.0, low)
    below = (0.0, low) if rising else (high, length)
    assert region.contact.contains(wall, sum(above) / 2, 0.0)
    assert not region.contact.contains(wall, sum(below) / 2, 0.0)
    assert not region.contact.has_vertex(vertex_at(space, 2, -2))


def test_area_beside_an_edge_is_met_but_the_edge_is_not() -> None:
    """Free space beside a floor may be the target while the floor, which sticks, is not."""
    space = space_of([box(-9, -9, 9, 0)])
    floor = edge_between(space, (-6, 0), (6, 0))
    region = backprojected(space, Region(Area.box(-2, 0, 2, 1), ContactSet.empty()), 270, 10, 30)
    assert region.contact.is_empty
    assert region.area.contains(0, 0.5)
    assert region.area.contains(0, 2)
    assert not region.contact.contains(floor, 6.0, 0.0)


def test_empty_target_has_no_starts() -> None:
    space = space_of([box(-1, -1, 1, 1)])
    assert backprojected(space, Region.empty(), 270, 5, 20).is_empty


def check_against_reference(scene: Scene, seed: int) -> None:
    space, target, direction, control, friction = scene
    command = sources(space.contact, direction, control, friction, space.tolerance)
    assert _sweep(space, target, attach(target.area, space), command) is not None
    region = backproject(space, target, command).region
    reference = reference_backprojection(space, target, direction, control, friction)
    slack = 1e-6
    for one, other in (
        (region.contact, reference.contact),
        (reference.contact, region.contact),
    ):
        assert contact_set.is_subset(one, other, slack), seed
    assert areas.is_subset(region.area, reference.area, slack), seed
    assert areas.is_subset(reference.area, region.area, slack), seed


@pytest.mark.parametrize("block", range(8))
def test_sweep_agrees_with_the_slab_reference(block: int) -> None:
    """Random scenes, half of them on a lattice, with axis-aligned directions among them."""
    for seed in range(block * 100, block * 100 + 100):
        check_against_reference(random_scene(Random(seed)), seed)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(20))
def test_sweep_agrees_with_the_slab_reference_at_length(block: int) -> None:
    for seed in range(10_000 + block * 500, 10_000 + block * 500 + 500):
        check_against_reference(random_scene(Random(seed)), seed)
