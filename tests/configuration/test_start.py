"""Starts: what they hold, what is refused, whether a region covers them."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind, covered, distance_to, start_region
from preimage.errors import TaskError
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.task.task import (
    Everywhere,
    Initial,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
)
from preimage.task.workspace import Side
from tests.configuration.spaces import Point, box, task_of

OBSTACLES = [box(2, 1, 3, 3), box(5, 1, 2, 1)]
"""An L: a concave corner at (5, 2), five convex ones."""

WALLS = frozenset({Side.LEFT})


def found(initial: Initial) -> tuple[Start, ConfigurationSpace]:
    task = task_of(list(OBSTACLES), sides=WALLS, initial=initial)
    space = configuration_space(task)
    return start_region(task, space), space


def places(space: ConfigurationSpace, contact: ContactSet) -> set[tuple[float, float]]:
    return set(map(tuple, space.contact.points[contact.vertices].tolist()))


def test_a_free_point() -> None:
    start, space = found(InitialPoint((1, 1)))
    assert (start.kind, start.point) == (StartKind.FREE_POINT, (1, 1))
    assert not covered(start, Region(Area.box(1, 0, 2, 1), ContactSet.empty()), space)
    assert not covered(start, Region(Area.box(1.1, 0, 2, 1), ContactSet.empty()), space)


def test_a_point_of_an_edge_needs_the_edge_not_the_space_beside_it() -> None:
    start, space = found(InitialPoint((3, 4)))
    assert start.kind is StartKind.EDGE_POINT
    assert space.contact.at(np.array([start.edge]), np.array([start.distance])) == pytest.approx(
        np.array([[3.0, 4.0]])
    )
    assert not covered(start, Region(space.free, ContactSet.empty()), space)
    assert covered(start, space.valid, space)


@pytest.mark.parametrize("point", [(5, 2), (2, 4)])
def test_a_vertex_needs_itself(point: Point) -> None:
    start, space = found(InitialPoint(point))
    assert start.kind is StartKind.VERTEX
    assert places(space, ContactSet.of([], [], [], list(start.vertices), 0.0)) == {point}
    edges = space.contact.edges
    whole = ContactSet.of(edges, np.zeros(len(edges)), space.contact.length[edges], [], 1e-9)
    assert not covered(start, Region(space.free, whole), space)
    assert covered(start, space.valid, space)


@pytest.mark.parametrize(
    ("point", "rule"),
    [
        ((3, 2), "inside an obstacle"),
        ((9, 2), "outside the window"),
        ((8, 2), "on an open side of the window"),
        ((8, 8), "on an open side of the window"),
    ],
)
def test_points_that_are_not_valid_are_refused(point: Point, rule: str) -> None:
    with pytest.raises(TaskError, match=rule) as refusal:
        found(InitialPoint(point))
    assert refusal.value.key == "initial.point"


def test_a_point_on_a_wall_is_contact() -> None:
    start, _ = found(InitialPoint((0, 3)))
    assert start.kind is StartKind.EDGE_POINT


def test_a_disc_is_contained_in_what_replaces_it() -> None:
    start, space = found(InitialDisc((1.0, 6.0), 1.5))
    area = start.region.area.geometry
    disc = shapely.intersection(
        shapely.Point(1, 6).buffer(1.5, quad_segs=200), shapely.box(0, 0, 8, 8)
    )
    assert shapely.difference(disc, area).area < 1e-12
    assert area.area < disc.area * 1.01
    assert start.kind is StartKind.REGION
    assert start.region.contact.total_length == pytest.approx(2 * math.sqrt(1.5**2 - 1), rel=1e-2)
    assert covered(start, space.valid, space)


def test_an_area_takes_its_edges_and_concave_vertices_but_no_tips() -> None:
    start, space = found(InitialPolygon(((1, 0.5), (7.5, 0.5), (7.5, 5), (1, 5))))
    assert places(space, start.region.contact) == {(5.0, 2.0)}
    assert start.region.contact.total_length == pytest.approx(3 + 3 + 2 + 2 + 1 + 5)
    assert start.region.area.measure == pytest.approx(6.5 * 4.5 - 11)


@pytest.mark.parametrize(
    ("initial", "key"),
    [
        (InitialDisc((3.5, 2.5), 0.5), "initial.disc"),
        (InitialDisc((20, 20), 1), "initial.disc"),
        (InitialPolygon(((3, 2), (4, 2), (4, 3))), "initial.polygon"),
        (InitialEdges((((2, 4), (5, 4)), ((0, 0), (1, 1)))), "initial.edges[1]"),
    ],
)
def test_areas_and_edges_of_which_nothing_is_valid_are_refused(initial: Initial, key: str) -> None:
    with pytest.raises(TaskError) as refusal:
        found(initial)
    assert refusal.value.key == key


def test_edges_are_open_but_for_concave_ends() -> None:
    start, space = found(InitialEdges((((5, 4), (5, 2)), ((2, 4), (2, 2)))))
    assert places(space, start.region.contact) == {(5.0, 2.0)}
    assert start.region.contact.total_length == pytest.approx(4.0)
    assert start.region.area.is_empty


def test_everywhere() -> None:
    start, space = found(Everywhere())
    assert start.region.area.measure == pytest.approx(space.free.measure)
    assert start.region.area.measure < space.free.measure  # nobody starts on an open side
    assert start.region.contact.total_length == pytest.approx(3 + 3 + 2 + 2 + 1 + 5 + 8)
    assert places(space, start.region.contact) == {(5.0, 2.0)}
    assert covered(start, space.valid, space)
    less = contact_set.difference(
        space.valid.contact, ContactSet.of([], [], [], start.region.contact.vertices[:1], 0.0), 1e-9
    )
    assert not covered(start, Region(space.free, less), space)
    smaller = areas.difference(space.free, Area.box(6, 6, 6.1, 6.1))
    assert not covered(start, Region(smaller, space.valid.contact), space)


def test_distances_of_starts_from_regions() -> None:
    start, space = found(InitialPoint((1, 1)))
    square = Region(Area.box(1, 4, 2, 5), ContactSet.empty())
    assert distance_to(start, square, space) == pytest.approx(3.0)
    assert distance_to(start, Region.empty(), space) == math.inf
    assert distance_to(start, space.valid, space) == 0.0
    everywhere, _ = found(Everywhere())
    assert distance_to(everywhere, space.valid, space) == pytest.approx(0.0, abs=1e-12)
    assert distance_to(everywhere, square, space) > 5.0
    edge = int(space.contact.edges[0])
    line = ContactSet.of([edge], [0.0], [1.0], [], 1e-9)
    near = distance_to(start, Region(Area.empty(), line), space)
    assert near > 0.0
    assert near < 10.0
