import json
from pathlib import Path
from typing import Any

import pytest
import shapely.geometry

from preimage.cli.main import run
from preimage.preimages.methods import METHODS

Capture = pytest.CaptureFixture[str]

HOLE = ["--example", "peg-in-hole-point", "--direction"]


def written(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def test_backprojection_of_the_goal(tmp_path: Path, capsys: Capture) -> None:
    file, picture = tmp_path / "starts.geojson", tmp_path / "starts.svg"
    assert run(["backproject", *HOLE, "270", "-o", str(file), "--figure", str(picture)]) == 0
    told = capsys.readouterr().out.splitlines()
    assert told[0] == "backprojection for down (270°)"
    assert told[-1] == f"written: {file}, {picture}"
    feature = written(file)
    assert feature["type"] == "Feature"
    assert feature["properties"] == {
        "task": "peg-in-hole-point",
        "stage": "backprojection",
        "direction": 270.0,
    }
    shape = shapely.geometry.shape(feature["geometry"])
    assert shape.covers(shapely.Point(0, 0))
    assert not shape.intersects(shapely.Point(3, 3))
    assert picture.stat().st_size > 1000


@pytest.mark.parametrize("target", ["goal", "sticking", "kernel", "combined"])
def test_targets_by_name(target: str, capsys: Capture) -> None:
    assert run(["backproject", *HOLE, "down", "--target", target]) == 0
    assert "  target  1 contact edge of length 2" in capsys.readouterr().out


def test_targets_by_place_text_and_file(tmp_path: Path, capsys: Capture) -> None:
    assert run(["backproject", *HOLE, "down", "--target", "edge:-1,-3,0,-3; point:1,-3"]) == 0
    told = capsys.readouterr().out
    assert "  target  1 contact edge of length 1 and 2 contact vertices" in told
    line = json.dumps({"type": "LineString", "coordinates": [[-1, -3], [0, -3]]})
    assert run(["backproject", *HOLE, "down", "--target", line]) == 0
    assert "  target  1 contact edge of length 1\n" in capsys.readouterr().out
    file = tmp_path / "kernel.geojson"
    assert run(["kernel", *HOLE, "-90", "-o", str(file)]) == 0
    assert "kernel  1 contact edge of length 2\n" in capsys.readouterr().out
    assert run(["backproject", *HOLE, "down", "--target", str(file)]) == 0
    assert "  target  1 contact edge of length 2\n" in capsys.readouterr().out


@pytest.mark.parametrize("method", METHODS)
def test_preimages(method: Any, tmp_path: Path, capsys: Capture) -> None:
    file, picture = tmp_path / "preimage.geojson", tmp_path / "preimage.png"
    arguments = ["preimage", *HOLE, "down", "--method", method.value]
    assert run([*arguments, "-o", str(file), "--figure", str(picture)]) == 0
    assert capsys.readouterr().out.startswith(f"preimage for down (270°), {method.value} method\n")
    region, target = written(file)["features"]
    assert region["properties"]["stage"] == "preimage"
    assert target["properties"]["stage"] == "target"
    assert region["properties"]["termination"]
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_geojson_on_standard_output_is_alone_there(capsys: Capture) -> None:
    assert run(["preimage", *HOLE, "down", "-o", "-"]) == 0
    printed = capsys.readouterr()
    assert json.loads(printed.out)["type"] == "FeatureCollection"
    assert printed.err.startswith("preimage for down (270°), combined method")


def test_an_empty_answer_is_one(capsys: Capture) -> None:
    assert run(["kernel", *HOLE, "up", "-o", "-"]) == 0
    geometry = json.loads(capsys.readouterr().out)["geometry"]
    assert geometry == {"type": "GeometryCollection", "geometries": []}
