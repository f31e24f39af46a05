"""WKT and GeoJSON."""

import json
from pathlib import Path
from typing import Any

import pytest

from preimage.errors import InputError
from preimage.exchange.drawing import Role
from preimage.exchange.importing import import_task
from preimage.geometry.wkt import from_wkt
from preimage.task.goal import Goal
from preimage.task.initial import InitialDisc, InitialPoint
from preimage.task.workspace import ChainObstacle, SolidSide

WKT = """\
# a floor with a pit
floor (left): POLYGON ((0 0, 4 0, 4 1, 0 1, 0 0))
walls: MULTIPOLYGON (((0 0, 4 0, 4 1, 0 1, 0 0)),
                     ((6 0, 10 0, 10 1, 6 1, 6 0)))
POLYGON ((4 0, 6 0, 6 0.5, 4 0.5, 4 0));   # no name: solid

goal: LINESTRING (4 0.5, 6 0.5)
Start: POINT (5 3)
note: POINT (0 0)
"""


def test_lines_of_wkt_have_names(tmp_path: Path) -> None:
    path = tmp_path / "pit.wkt"
    path.write_text(WKT.replace("floor (left)", "decor"))
    found = import_task(path)
    task = found.task
    assert len(task.workspace.obstacles) == 3
    assert (task.initial, task.goal) == (
        InitialPoint((5.0, 3.0)),
        Goal(edges=(((4.0, 0.5), (6.0, 0.5)),)),
    )
    assert found.notes[-1] == "left out: 1 lines named decor, 1 lines named note"


def test_other_names_may_be_given(tmp_path: Path) -> None:
    path = tmp_path / "pit.wkt"
    path.write_text(WKT.replace("floor (left)", "decor"))
    found = import_task(path, layers={"Decor": Role.OBSTACLES})
    assert len(found.task.workspace.obstacles) == 4


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("wall: POLYGON ((0 0, 1 0))", r"line 1 \(wall\): is no WKT"),
        ("\nwall: POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))", r"line 2 \(wall\).*: is no simple polygon"),
        ("wall: POINT Z (0 0 1)", r"line 1 \(wall\).*: must be a position"),
        ("wall: POLYGON ((0 0, nan 0, 1 1, 0 0))", r"line 1 \(wall\).*"),
        ("wall: " + "GEOMETRYCOLLECTION (" * 50 + ")" * 50, "must be nested 20 deep or less"),
        ("wall: POLYGON ((0 0, 1 0, 1 1, 0 0)", r"line 1 \(wall\): is no WKT"),
        ("nothing", "line 1: is no WKT"),
        ("note: POINT (0 0)", "nothing in it has a role"),
        ("", "nothing in it has a role"),
        ("wall: POLYGON EMPTY", "nothing in it has a role"),
        ("goal: POINT (0 0)\nstart: POINT (1 1)", "window: is missing"),
    ],
)
def test_wkt_is_refused_by_line(tmp_path: Path, text: str, rule: str) -> None:
    path = tmp_path / "drawing.wkt"
    path.write_text(text)
    with pytest.raises(InputError, match=rule):
        import_task(path)


def test_wkt_has_polygons_lines_and_points() -> None:
    shapes = from_wkt("GEOMETRYCOLLECTION (POINT (1 2), LINESTRING (0 0, 1 1), POLYGON EMPTY)")
    assert (shapes.area.is_empty, len(shapes.lines), shapes.points.tolist()) == (True, 1, [[1, 2]])
    assert from_wkt("POINT EMPTY").is_empty


def feature(role: str, kind: str, coordinates: Any, **more: Any) -> dict[str, Any]:
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "properties": {"role": role, **more}, "geometry": geometry}


FLOOR = feature("obstacle", "LineString", [[0, 0], [9, 0]], solid="right")
GOAL = feature("goal", "LineString", [[2, 0], [4, 0]])
START = feature("start", "Point", [3, 5], radius=0.5)
WINDOW = feature("window", "Polygon", [[[0, -2], [9, -2], [9, 9], [0, 9], [0, -2]]])


def write(folder: Path, *features: object) -> Path:
    path = folder / "drawing.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


def test_features_have_roles_radii_and_solid_sides(tmp_path: Path) -> None:
    task = import_task(write(tmp_path, FLOOR, GOAL, START, WINDOW)).task
    assert task.workspace.obstacles == (ChainObstacle(((0.0, 0.0), (9.0, 0.0)), SolidSide.RIGHT),)
    assert task.workspace.window.bounds == (0.0, -2.0, 9.0, 9.0)
    assert task.initial == InitialDisc((3.0, 5.0), 0.5)


@pytest.mark.parametrize(
    ("changed", "rule"),
    [
        (7, r"features\[3\]: must be a mapping, not 7"),
        ({"type": "Polygon"}, r"features\[3\].type: must be Feature, not 'Polygon'"),
        (feature("wall", "Point", [1, 2, 3]), r"features\[3\] \(wall\).*: must be a position"),
        (feature("wall", "Point", [1, 2]), r"features\[3\] \(wall\): is a point"),
        (feature("start", "Point", [1, 2]), r"features\[3\] \(start\): is another start"),
        (
            feature("goal", "Point", [1, 2], radius=-1),
            r"features\[3\] \(goal\).radius: must be a length",
        ),
        (
            feature("wall", "LineString", [[1, 1], [2, 2]], solid="up"),
            "solid: must be left or right",
        ),
        (feature("wall", "LineString", [[1, 1], [2, 2]]), r"features\[3\] \(wall\): is open"),
        (feature("room", "LineString", [[1, 1], [2, 2]]), r"features\[3\] \(room\): is open"),
        (
            feature("goal", "Point", [1, 2]),
            r"features\[3\] \(goal\) \(goal.points\[0\]\): is no contact",
        ),
        (feature("window", "Polygon", [[[0, 0], [1, 0], [0, 1], [0, 0]]]), "is another window"),
        ({**GOAL, "properties": 3}, r"features\[3\].properties: must be a mapping"),
    ],
)
def test_features_are_refused_by_number(tmp_path: Path, changed: object, rule: str) -> None:
    with pytest.raises(InputError, match=rule):
        import_task(write(tmp_path, FLOOR, GOAL, START, changed, WINDOW))


def test_a_window_is_an_upright_rectangle(tmp_path: Path) -> None:
    triangle = feature("window", "Polygon", [[[0, 0], [9, 0], [0, 9], [0, 0]]])
    with pytest.raises(InputError, match="is no upright rectangle"):
        import_task(write(tmp_path, FLOOR, GOAL, START, triangle))


@pytest.mark.parametrize(
    ("options", "rule"),
    [
        ({"units": "m"}, "units: GeoJSON has none"),
        ({"curves": 0}, "curves: must be a length above 0, not 0"),
        ({"unknown": "perhaps"}, "unknown: must be occupied or free, not 'perhaps'"),
        ({"nested": None}, "nested: must be solid or hole, not nothing"),
        ({"chains": "up"}, "chains: must be left or right, not 'up'"),
        ({"format": "dwg"}, "format: must be map, dxf, svg, wkt or geojson, not 'dwg'"),
        ({"layers": {"MASONRY": "solid"}}, "layers.*: must be obstacles, room, goal, start"),
        ({"window": (0, 0, 1)}, "window: must be 4 numbers, not 3"),
        ({"snap": float("nan")}, "snap: must be a length 0 or more, not nan"),
        ({"robot_radius": -1}, "robot_radius: must be a length 0 or more, not -1"),
        ({"window": (0, 0, 0, 1)}, "window: xmin must be below xmax"),
        ({"friction": 7.0}, "friction: must be at least 0 and at most 90 degrees"),
        (
            {"initial": InitialPoint((0, 1))},
            r"initial: there is a start in the drawing: features\[2\]",
        ),
    ],
)
def test_options_are_refused_by_name(tmp_path: Path, options: dict[str, Any], rule: str) -> None:
    with pytest.raises(InputError, match=rule):
        import_task(write(tmp_path, FLOOR, GOAL, START), **options)


@pytest.mark.parametrize(
    ("name", "rule"),
    [
        ("drawing.png", "is the image of a map: give the .yaml file"),
        ("drawing.dwg", "must end in one of .yaml, .yml, .dxf, .svg, .wkt"),
        ("none.wkt", "cannot be read: No such file"),
        (".wkt", "must end in one of"),
    ],
)
def test_files_are_refused_by_their_endings(tmp_path: Path, name: str, rule: str) -> None:
    with pytest.raises(InputError, match=rule):
        import_task(tmp_path / name)


def test_a_file_must_be_text(tmp_path: Path) -> None:
    path = tmp_path / "drawing.wkt"
    path.write_bytes(b"wall: \xff")
    with pytest.raises(InputError, match="is not UTF-8 at byte 6"):
        import_task(path)
