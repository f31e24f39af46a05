import contextlib
import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.errors import InputError
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.geojson import Shapes, from_geojson, to_geojson

coordinates = st.floats(-1e9, 1e9).filter(lambda x: abs(x) > 1e-100 or x == 0.0)
points = st.tuples(coordinates, coordinates)
SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]


@st.composite
def boxes(draw: st.DrawFn) -> Area:
    x, y = draw(st.integers(-9, 9)), draw(st.integers(-9, 9))
    width, height = draw(st.integers(1, 6)), draw(st.integers(1, 6))
    return Area.box(x, y, x + width, y + height)


@st.composite
def shapes(draw: st.DrawFn) -> Shapes:
    solid = draw(st.lists(boxes(), max_size=4))
    hollow = draw(st.lists(boxes(), max_size=2))
    area = areas.union(*solid) if solid else Area.empty()
    if hollow:
        area = areas.difference(area, areas.union(*hollow))
    lines = draw(st.lists(st.lists(points, min_size=2, max_size=4), max_size=3))
    return Shapes(
        area,
        tuple(np.array(line) for line in lines),
        np.array(draw(st.lists(points, max_size=4)), dtype=np.float64).reshape(-1, 2),
    )


@given(shapes())
def test_what_is_read_is_written_the_same(given_: Shapes) -> None:
    text = json.dumps(to_geojson(given_), allow_nan=False)
    again = from_geojson(json.loads(text))
    assert json.dumps(to_geojson(again)) == text
    assert again.area.measure == pytest.approx(given_.area.measure)
    assert len(again.points) == len(given_.points)
    assert len(again.lines) == len(given_.lines)


@given(shapes(), st.randoms(use_true_random=False))
def test_the_order_of_parts_does_not_matter(given_: Shapes, random: Any) -> None:
    lines = list(given_.lines)
    random.shuffle(lines)
    other = Shapes(given_.area, tuple(lines), given_.points[::-1])
    assert to_geojson(other) == to_geojson(given_)


def test_kinds() -> None:
    box, far = Area.box(0, 0, 1, 1), Area.box(2, 0, 3, 1)
    line, point = np.array([[0.0, 0.0], [1.0, -0.0]]), np.array([[5.0, 5.0]])
    assert to_geojson(Shapes()) == {"type": "GeometryCollection", "geometries": []}
    assert to_geojson(Shapes(box))["type"] == "Polygon"
    assert to_geojson(Shapes(areas.union(box, far)))["type"] == "MultiPolygon"
    assert to_geojson(Shapes(lines=(line,))) == {
        "type": "LineString",
        "coordinates": [[0.0, 0.0], [1.0, 0.0]],
    }
    assert "-0.0" not in json.dumps(to_geojson(Shapes(lines=(line,))))
    mixed = to_geojson(Shapes(box, (line, line + 1), point))
    assert [part["type"] for part in mixed["geometries"]] == ["Polygon", "MultiLineString", "Point"]


def test_rings_are_closed_and_turn_the_right_way() -> None:
    area = areas.difference(Area.box(0, 0, 4, 4), Area.box(1, 1, 2, 2))
    exterior, hole = to_geojson(Shapes(area))["coordinates"]
    for ring, sign in ((exterior, 1.0), (hole, -1.0)):
        assert ring[0] == ring[-1] == min(ring)
        x, y = np.array(ring).T
        assert math.copysign(1.0, np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) == sign


def test_nested_collections_and_overlapping_polygons() -> None:
    data: dict[str, Any] = {"type": "Polygon", "coordinates": [SQUARE]}
    moved = {"type": "MultiPolygon", "coordinates": [[[[x + 2, y] for x, y in SQUARE]]]}
    for _ in range(50):
        data = {"type": "GeometryCollection", "geometries": [data]}
    both = {"type": "GeometryCollection", "geometries": [data, moved]}
    assert from_geojson(both).area.measure == 24.0


REFUSED: list[tuple[object, str]] = [
    (3, "g: must be a GeoJSON geometry, not 3"),
    ({"coordinates": []}, "g.type: is missing"),
    ({"type": "Feature"}, "g.type: must be one of Polygon, "),
    ({"type": ["Point"], "coordinates": [0, 0]}, "g.type: must be one of Polygon, "),
    ({"type": "Point"}, "g.coordinates: is missing"),
    ({"type": "Point", "coordinates": [0, 0], "bbox": []}, "g.bbox: unknown key"),
    ({"type": "Point", "coordinates": 7}, "g.coordinates: must be a position [x, y], not 7"),
    (
        {"type": "Point", "coordinates": [1, 2, 3]},
        "g.coordinates: must be a position [x, y], not 3",
    ),
    ({"type": "Point", "coordinates": [True, 2]}, "g.coordinates[0]: must be a number, not true"),
    ({"type": "Point", "coordinates": ["1", 2]}, "g.coordinates[0]: must be a number, not '1'"),
    ({"type": "Point", "coordinates": [0, math.nan]}, "g.coordinates[1]: must be a finite number"),
    ({"type": "Point", "coordinates": [0, math.inf]}, "g.coordinates[1]: must be a finite number"),
    ({"type": "Point", "coordinates": [0, 1e300]}, "g.coordinates[1]: must be at least -1e+09"),
    ({"type": "Point", "coordinates": [0, 10**400]}, "g.coordinates[1]: must be at least -1e+09"),
    ({"type": "LineString", "coordinates": [[0, 0]]}, "g.coordinates: must have 2 positions"),
    ({"type": "LineString", "coordinates": [[0, 0], 1]}, "g.coordinates[1]: must be a position"),
    ({"type": "Polygon", "coordinates": []}, "g.coordinates: must have a ring"),
    ({"type": "Polygon", "coordinates": [[[0, 0]] * 3]}, "g.coordinates[0]: must have 4"),
    (
        {"type": "Polygon", "coordinates": [SQUARE[:4]]},
        "g.coordinates[0]: must end where",
    ),
    (
        {"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [1, 0], [0, 1], [0, 0]]]},
        "g.coordinates: is no simple polygon: self-intersection at (0.5, 0.5)",
    ),
    (
        {"type": "MultiPoint", "coordinates": [[0, 0], [1]]},
        "g.coordinates[1]: must be a position [x, y], not 1 numbers",
    ),
    (
        {"type": "GeometryCollection", "geometries": [{"type": "Point", "coordinates": None}]},
        "g.geometries[0].coordinates: must be a position [x, y], not nothing",
    ),
    ({"type": "GeometryCollection", "geometries": 5}, "g.geometries: must be a list, not 5"),
]


@pytest.mark.parametrize(("data", "line"), REFUSED)
def test_refusals_name_the_place(data: object, line: str) -> None:
    with pytest.raises(InputError) as refusal:
        from_geojson(data, "g")
    assert str(refusal.value).startswith(line)


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["type", "coordinates", "geometries", "x"]),
            inner | st.sampled_from(["Point", "Polygon", "LineString", "GeometryCollection"]),
            max_size=3,
        )
    ),
    max_leaves=20,
)


@given(anything)
def test_garbage_is_read_or_refused(data: object) -> None:
    with contextlib.suppress(InputError):
        from_geojson(data, "g")
