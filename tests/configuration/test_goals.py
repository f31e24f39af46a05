"""Goals: edges, polygons and points of contact space."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import TaskError
from preimage.task.task import Goal
from preimage.task.workspace import Obstacle
from tests.configuration import spaces
from tests.configuration.spaces import box, obstacle, task_of


def found(obstacles: list[Obstacle], goal: Goal) -> tuple[Region, ConfigurationSpace]:
    task = task_of(obstacles, goal=goal)
    space = configuration_space(task)
    return goal_region(task, space), space


def places(space: ConfigurationSpace, region: Region) -> set[tuple[float, float]]:
    return set(map(tuple, space.contact.points[region.contact.vertices].tolist()))


@pytest.mark.parametrize("edge", [((2, 4), (5, 4)), ((5, 4), (2, 4))])
def test_an_edge_is_the_same_in_both_directions_with_its_end_vertices(
    edge: tuple[spaces.Point, spaces.Point],
) -> None:
    region, space = found([box(2, 1, 3, 3)], Goal(edges=(edge,)))
    assert region.area.is_empty
    assert region.contact.total_length == pytest.approx(3.0)
    assert places(space, region) == {(2.0, 4.0), (5.0, 4.0)}


def test_a_part_of_an_edge_has_no_vertex() -> None:
    region, space = found([box(2, 1, 3, 3)], Goal(edges=(((3, 4), (4.5, 4)),)))
    assert region.contact.total_length == pytest.approx(1.5)
    assert places(space, region) == set()


def test_an_edge_over_collinear_ones_takes_the_vertices_on_the_way() -> None:
    """The wall is pinched by a triangle that stands on it with its tip."""
    tip = obstacle(shapely.Polygon([(4, 4), (5, 6), (3, 6)]))
    region, space = found([box(2, 1, 4, 3), tip], Goal(edges=(((2.5, 4), (6, 4)),)))
    assert region.contact.total_length == pytest.approx(3.5)
    assert places(space, region) == {(4.0, 4.0), (6.0, 4.0)}
    assert len(region.contact.vertices) == 3
    assert len(region.contact.edge) == 2


@given(spaces.lattice_scenes, st.floats(0.0, math.tau), st.data())
def test_every_contact_edge_can_be_named_in_parts(
    scene: list[shapely.Geometry], angle: float, data: st.DataObject
) -> None:
    try:
        space = spaces.space_in(spaces.turned(scene, angle))
    except TaskError:
        return
    contact = space.contact
    if not len(contact.edges):
        return
    edge = data.draw(st.sampled_from(contact.edges.tolist()))
    low, high = sorted(data.draw(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0))))
    if high - low < 1e-3:
        low, high = 0.0, 1.0
    at = contact.length[edge] * np.array([low, high])
    assume(at[1] - at[0] > 2.0 * space.tolerance.length)  # what is shorter is refused
    ends = contact.at(np.array([edge, edge]), at)
    if data.draw(st.booleans()):
        ends = ends[::-1]
    goal = Goal(edges=((tuple(ends[0]), tuple(ends[1])),))
    region = goal_region(task_of([], goal=goal), space)
    on = region.contact.edge == edge
    assert on.any()
    assert region.contact.low[on][0] <= at[0] + 1e-6
    assert region.contact.high[on][-1] >= at[1] - 1e-6
    if low == 0.0:
        assert region.contact.has_vertex(edge)
    if high == 1.0:
        assert region.contact.has_vertex(int(contact.next[edge]))


@pytest.mark.parametrize(
    ("edge", "rule"),
    [
        (((2, 4.3), (5, 4.3)), r"\(2, 4\.3\) is 0\.3 from it"),
        (((2, 4), (6, 4)), r"\(6, 4\) is 1 from it"),
        (((2, 1), (5, 4)), r"\(3\.5, 2\.5\) is 1\.5 from it"),
        (((0, 0), (0, 3)), r"\(0, 0\) is 2\.24 from it"),
    ],
)
def test_an_edge_outside_contact_space_is_refused(
    edge: tuple[spaces.Point, spaces.Point], rule: str
) -> None:
    with pytest.raises(TaskError, match=rule) as refusal:
        found([box(2, 1, 3, 3)], Goal(edges=(((2, 4), (5, 4)), edge)))
    assert refusal.value.key == "goal.edges[1]"
    assert "does not lie in contact space" in refusal.value.rule


def test_a_polygon_brings_the_contact_in_it_and_on_its_border() -> None:
    goal = Goal(polygons=(((1, 4), (4, 4), (4, 6), (1, 6)), ((4.5, 0), (7, 0), (7, 2), (4.5, 2))))
    region, space = found([box(2, 1, 3, 3)], goal)
    assert region.area.measure == pytest.approx(6.0 + 5.0 - 0.5)
    assert places(space, region) == {(2.0, 4.0), (5.0, 1.0)}
    assert region.contact.total_length == pytest.approx(2.0 + 0.5 + 1.0)


def test_a_polygon_in_an_obstacle_keeps_the_edges_on_its_border() -> None:
    region, space = found([box(2, 1, 3, 3)], Goal(polygons=(((2, 1), (5, 1), (5, 4), (2, 4)),)))
    assert region.area.is_empty
    assert region.contact.total_length == pytest.approx(12.0)
    assert len(places(space, region)) == 4


def test_a_polygon_of_which_nothing_is_left_is_refused() -> None:
    with pytest.raises(TaskError) as refusal:
        found([box(2, 1, 3, 3)], Goal(polygons=(((3, 2), (4, 2), (4, 3), (3, 3)),)))
    assert refusal.value.key == "goal.polygons[0]"


@given(st.lists(spaces.shapes, min_size=1, max_size=4), spaces.shapes, st.integers(0, 99))
def test_polygons_hold_the_contact_that_lies_in_them(
    scene: list[shapely.Geometry], shape: shapely.Polygon, seed: int
) -> None:
    polygon = shapely.Polygon(shape.exterior)
    goal = Goal(polygons=(tuple(polygon.exterior.coords)[:-1],))
    try:
        space = spaces.space_in(scene)
        region = goal_region(task_of([], goal=goal), space)
    except TaskError:
        return
    expected = shapely.intersection(space.free.geometry, polygon).area
    assert region.area.measure == pytest.approx(expected, abs=1e-7)
    contact = space.contact
    rng = np.random.default_rng(seed)
    for edge in contact.edges.tolist():
        at = rng.uniform(0.0, contact.length[edge], 5)
        for place, point in zip(at, contact.at(np.full(5, edge), at), strict=True):
            apart = polygon.distance(shapely.Point(point))
            if apart > 1e-7:
                assert not region.contact.contains(edge, place, 1e-9)
            elif polygon.boundary.distance(shapely.Point(point)) > 1e-7 or apart == 0.0:
                assert region.contact.contains(edge, place, 1e-7)
    for vertex in contact.vertices.tolist():
        apart = polygon.distance(shapely.Point(contact.points[vertex]))
        assert region.contact.has_vertex(vertex) == (apart < 1e-10) or 1e-10 < apart < 1e-8


def test_a_point_is_all_vertices_at_its_place() -> None:
    region, _ = found([box(2, 2, 2, 2), box(4, 4, 2, 2)], Goal(points=((4, 4), (2, 2))))
    assert len(region.contact.vertices) == 3
    assert region.contact.total_length == 0.0


def test_a_point_that_is_no_vertex_is_refused() -> None:
    with pytest.raises(TaskError, match=r"the nearest, \(2, 4\), is 1 away") as refusal:
        found([box(2, 2, 2, 2)], Goal(points=((4, 4), (1, 4))))
    assert refusal.value.key == "goal.points[1]"
    with pytest.raises(TaskError, match="there is none"):
        found([], Goal(points=((0, 0),)))
