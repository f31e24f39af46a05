"""Kernels where the position error is nothing or infinite, and within domains."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, is_subset
from preimage.geometry.area import Area
from tests.recognition.scenes import (
    BLOCK,
    CORNERS,
    EXACT,
    ROOM,
    SENSES,
    assert_same_area,
    contact,
    edge_at,
    goal,
    kernel_of,
    space_of,
    stretch,
    vertex_at,
)

# --- rho at its ends --------------------------------------------------------------------------


def test_an_exact_position_is_as_good_as_the_tolerance() -> None:
    """What a sensor cannot tell that errs by less than anything, it cannot tell either."""
    space = space_of([BLOCK])
    target = goal(space, Area.box(-3, 0, 6, 4))
    exact, fine = (
        kernel_of(space, target, replace(SENSES, position=error))
        for error in (0.0, space.tolerance.length)
    )
    assert is_subset(exact, fine, space.tolerance)
    assert is_subset(fine, exact, space.tolerance)
    nearly = kernel_of(space, target, replace(SENSES, position=1e-6))
    assert exact.contact.vertices.tolist() == nearly.contact.vertices.tolist()
    assert exact.area.measure == pytest.approx(nearly.area.measure, abs=1e-4)
    assert exact.area.measure == pytest.approx(target.area.measure, abs=1e-6)


def test_exact_position_confuses_vertices_in_one_place() -> None:
    pinch = [shapely.box(-4, 0, 0, 4), shapely.box(0, -4, 4, 0)]
    space = space_of(pinch)
    there = np.flatnonzero(np.hypot(*space.contact.points.T) < 1e-9).astype(np.int32)
    assert len(there) == 2
    senses = replace(SENSES, position=0.0)
    one = Region(Area.empty(), contact(space, [], [int(there[0])]))
    assert kernel_of(space, one, senses).is_empty


def test_without_a_position_sensor_a_feature_is_kept_or_lost() -> None:
    space = space_of([ROOM])
    blind = replace(SENSES, position=math.inf)
    floor = edge_at(space, 0, 0)
    corners = [vertex_at(space, *corner) for corner in CORNERS]
    whole = Region(Area.empty(), contact(space, [(floor, 0, 8)], corners))
    got = kernel_of(space, whole, blind)
    assert stretch(space, got.contact, floor) == [pytest.approx([-4, 0, 4, 0])]
    assert not len(got.contact.vertices)
    for part in (contact(space, [(floor, 0, 7.9)], corners), contact(space, [(floor, 0, 8)])):
        assert kernel_of(space, Region(Area.empty(), part), blind).is_empty
    everything = kernel_of(space, space.valid, blind)
    assert is_subset(space.valid, everything, space.tolerance)


def test_two_rooms_are_confused_without_a_position_sensor() -> None:
    rooms = shapely.difference(
        shapely.box(-10, -10, 10, 10),
        shapely.union_all([shapely.box(-8, 0, -2, 4), shapely.box(2, 0, 8, 4)]),
    )
    space = space_of([rooms])
    left = goal(space, Area.box(-8, 0, -2, 4))
    assert kernel_of(space, left, replace(SENSES, position=math.inf)).is_empty
    near = kernel_of(space, left)
    assert_same_area(near.area, shapely.box(-8, 0, -2, 4))


# --- domains ----------------------------------------------------------------------------------


def test_sticking_features_as_domain() -> None:
    """Known to stick: the floor is only told from other floors, free space does not matter."""
    steps = shapely.union_all([shapely.box(-8, -8, 0, 0), shapely.box(0, -8, 8, -3)])
    space = space_of([steps])
    high, low = edge_at(space, -4, 0), edge_at(space, 4, -3)
    sticking = Region(Area.empty(), contact(space, [(high, 0, 8), (low, 0, 8)]))
    target = Region(Area.empty(), contact(space, [(high, 0, 4)]))
    numb = replace(SENSES, force_thresholds=(math.inf, math.inf))
    assert kernel_of(space, target, numb).is_empty
    got = kernel_of(space, target, numb, domain=sticking)
    assert got.contact.low.tolist() == [0.0]
    assert got.contact.high.tolist() == pytest.approx([3.0], abs=EXACT)
    assert is_subset(sticking, kernel_of(space, sticking, numb, domain=sticking), space.tolerance)


def test_what_cannot_be_reached_does_not_confuse() -> None:
    space = space_of([])
    target = goal(space, Area.box(-4, -3, 4, 3))
    above = Region(Area.box(-4, -3, 4, 9), ContactSet.empty())
    got = kernel_of(space, target, domain=above)
    assert_same_area(got.area, shapely.box(-4, -3, 4, 2))
    got = kernel_of(space, target, domain=Region(Area.box(1, -2, 3, 2), ContactSet.empty()))
    assert_same_area(got.area, shapely.box(-4, -3, 4, 3))
    got = kernel_of(space, target, domain=Region.empty())
    assert is_subset(target, got, space.tolerance)


def test_a_domain_of_contact_confuses_free_space_where_it_reads_0() -> None:
    space = space_of([ROOM])
    wall = edge_at(space, 4, 3)
    domain = Region(Area.empty(), contact(space, [(wall, 0, 6)]))
    got = kernel_of(space, Region(Area.box(-4, 0, 4, 6), ContactSet.empty()), domain=domain)
    assert_same_area(got.area, shapely.box(-4, 0, 3, 6))


def test_the_empty_target() -> None:
    space = space_of([BLOCK])
    for rho in (0.0, 0.5, math.inf):
        assert kernel_of(space, Region.empty(), replace(SENSES, position=rho)).is_empty


def test_all_of_valid_space_is_its_own_kernel() -> None:
    space = space_of([BLOCK])
    assert is_subset(space.valid, kernel_of(space, space.valid), space.tolerance)
