import json
import math
from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, is_subset
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import InputError
from preimage.geometry.area import Area
from preimage.reachability.backprojection import backproject
from preimage.reachability.sources import sources
from preimage.strategy.region_geojson import region_from_geojson, region_to_geojson
from preimage.task.workspace import Side
from tests.strategies import Scene, random_scene, scenes, space_of

# Four walls around [-6, 6]², and a block [0, 4] x [0, 2] in it.
ROOM = space_of([shapely.box(0, 0, 4, 2)], list(Side))
# Two blocks that touch in the origin.
PINCH = space_of([shapely.box(-3, -3, 0, 0), shapely.box(0, 0, 3, 3)])


def check_round_trip(region: Region, space: ConfigurationSpace) -> None:
    text = json.dumps(region_to_geojson(region, space))
    again = region_from_geojson(json.loads(text), space)
    assert json.dumps(region_to_geojson(again, space)) == text
    assert again.contact.edge.tolist() == region.contact.edge.tolist()
    assert again.contact.vertices.tolist() == region.contact.vertices.tolist()
    assert np.allclose(again.contact.low, region.contact.low, atol=1e-12)
    assert np.allclose(again.contact.high, region.contact.high, atol=1e-12)
    assert again.area.measure == pytest.approx(region.area.measure, rel=1e-12)


@settings(max_examples=60)
@given(scenes)
def test_what_is_read_is_written_the_same(scene: Scene) -> None:
    space = scene.space
    command = sources(
        space.contact, scene.direction, scene.control, scene.friction, space.tolerance
    )
    for region in (scene.target, backproject(space, scene.target, command).region, space.valid):
        check_round_trip(region, space)


@given(st.integers(0, 10**6), st.floats(1e-3, 1.0), st.floats(0.0, 1.0))
def test_any_interval_comes_back(seed: int, share: float, offset: float) -> None:
    rng = Random(seed)
    space = random_scene(rng).space
    edges = space.contact.edges
    length = space.contact.length[edges]
    low = offset * (1.0 - share) * length
    high = low + share * length
    none = np.empty(0, dtype=np.int32)
    check_round_trip(Region(Area.empty(), ContactSet(edges, low, high, none)), space)


def test_vertices_belong_by_points_alone() -> None:
    edge = {"type": "LineString", "coordinates": [[0, 2], [4, 2]]}
    region = region_from_geojson(edge, ROOM)
    assert region.contact.total_length == 4.0
    assert not len(region.contact.vertices)
    corner = {"type": "Point", "coordinates": [4, 2]}
    both = {"type": "GeometryCollection", "geometries": [edge, corner]}
    assert len(region_from_geojson(both, ROOM).contact.vertices) == 1
    square = {"type": "Polygon", "coordinates": [[[0, 2], [4, 2], [4, 3], [0, 3], [0, 2]]]}
    assert region_from_geojson(square, ROOM).contact.is_empty


def test_lines_in_any_direction_and_around_corners() -> None:
    there = {"type": "LineString", "coordinates": [[1, 2], [4, 2], [4, 1]]}
    back = {"type": "LineString", "coordinates": [[4, 1], [4, 2], [1, 2]]}
    first, second = (region_from_geojson(line, ROOM) for line in (there, back))
    assert first.contact.total_length == pytest.approx(4.0)
    assert is_subset(first, second, ROOM.tolerance)
    assert is_subset(second, first, ROOM.tolerance)


def test_at_a_pinch_a_point_means_all_its_vertices() -> None:
    point = {"type": "Point", "coordinates": [0.0, 0.0]}
    both = region_from_geojson(point, PINCH)
    assert len(both.contact.vertices) == 2
    assert region_to_geojson(both, PINCH) == point
    none = np.empty(0)
    for vertex in both.contact.vertices:
        one = ContactSet(np.empty(0, np.int32), none, none, np.array([vertex], dtype=np.int32))
        region = Region(Area.empty(), one)
        x, y = region_to_geojson(region, PINCH)["coordinates"]
        assert 0.0 < math.hypot(x, y) < PINCH.tolerance.length
        check_round_trip(region, PINCH)


def test_polygons_are_clipped_to_free_space() -> None:
    wide = {"type": "Polygon", "coordinates": [[[0, 1], [4, 1], [4, 4], [0, 4], [0, 1]]]}
    assert region_from_geojson(wide, ROOM).area.measure == pytest.approx(8.0)


@pytest.mark.parametrize(
    ("data", "line"),
    [
        (
            {"type": "LineString", "coordinates": [[0, 2.5], [4, 2.5]]},
            "g: the line from (0, 2.5) to (4, 2.5) does not lie in contact space: (",
        ),
        (
            {"type": "LineString", "coordinates": [[0, 2], [5, 2]]},
            "g: the line from (0, 2) to (5, 2) does not lie in contact space: (",
        ),
        (
            {"type": "LineString", "coordinates": [[1, 2], [1, 2]]},
            "g: the line from (1, 2) to (1, 2) has no length",
        ),
        ({"type": "Point", "coordinates": [1, 2]}, "g: the point (1, 2) is no contact vertex"),
        ({"type": "Point", "coordinates": [9, 9]}, "g: the point (9, 9) is no contact vertex"),
        (
            {"type": "Polygon", "coordinates": [[[1, 1], [2, 1], [2, 1.5], [1, 1]]]},
            "g: nothing of its polygons lies in free space",
        ),
        ({"type": "Point"}, "g.coordinates: is missing"),
    ],
)
def test_refusals(data: object, line: str) -> None:
    with pytest.raises(InputError) as refusal:
        region_from_geojson(data, ROOM, "g")
    assert str(refusal.value).startswith(line)
