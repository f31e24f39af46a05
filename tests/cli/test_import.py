import json
from pathlib import Path

import numpy as np
import pytest

from preimage.cli.main import run
from preimage.task.files import load_task
from preimage.task.initial import (
    Everywhere,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
)
from preimage.task.workspace import Side

Capture = pytest.CaptureFixture[str]

PIT = """
walls: POLYGON ((0 0, 10 0, 10 1, 6 1, 6 0.5, 4 0.5, 4 1, 0 1, 0 0))
goal: LINESTRING (4 0.5, 6 0.5)
start: POINT (5 3)
"""
FLOOR = "\n".join(line for line in PIT.splitlines() if "start" not in line and "goal" not in line)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("pit.wkt").write_text(PIT)
    Path("floor.wkt").write_text(FLOOR)
    image = np.full((20, 20), 254, dtype=np.uint8)
    image[15:] = 0
    Path("map.pgm").write_bytes(b"P5 20 20 255\n" + image.tobytes())
    Path("map.yaml").write_text(
        "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    return tmp_path


def test_writes_a_task_that_can_be_planned(capsys: Capture) -> None:
    assert run(["import", "pit.wkt", "-o", "task.yaml", "--figure", "task.svg"]) == 0
    printed = capsys.readouterr()
    lines = printed.out.splitlines()
    assert lines[0] == "pit.wkt: WKT"
    assert lines[1] == (
        "understood: 1 obstacle of 8 vertices; robot: a point; start: a point; goal: 1 edge; "
        "window: -5, -5, 15, 8"
    )
    assert lines[-1] == "written: task.yaml, task.svg"
    assert printed.err == ""
    text = Path("task.yaml").read_text(encoding="utf-8")
    assert text.startswith("# pit.wkt: WKT\n# understood: 1 obstacle")
    assert Path("task.svg").read_text(encoding="utf-8").startswith("<?xml")
    assert run(["plan", "task.yaml"]) == 0
    assert capsys.readouterr().out.startswith("pit: solved in 1 motion")


def test_prints_the_task_and_keeps_the_notes_apart(capsys: Capture) -> None:
    assert run(["import", "pit.wkt"]) == 0
    printed = capsys.readouterr()
    Path("again.yaml").write_text(printed.out)
    assert load_task("again.yaml").goal.edges == (((4.0, 0.5), (6.0, 0.5)),)
    assert printed.err.startswith("pit.wkt: WKT\nunderstood: ")


@pytest.mark.parametrize("ending", ["yaml", "json", "toml"])
def test_all_formats_hold_the_same_task(ending: str) -> None:
    assert run(["import", "pit.wkt", "-o", f"task.{ending}"]) == 0
    assert run(["import", "pit.wkt", "-o", "pit.yaml"]) == 0
    assert load_task(f"task.{ending}").workspace == load_task("pit.yaml").workspace


def test_the_same_bytes_each_time() -> None:
    for name in ("a.yaml", "b.yaml"):
        assert (
            run(["import", "map.yaml", "--start", "1,1", "--goal", "1,1,1.5,1.5", "-o", name]) == 0
        )
    assert Path("a.yaml").read_bytes() == Path("b.yaml").read_bytes()


def test_a_map_gets_goal_and_start_by_options() -> None:
    arguments = ["--start", "disc:1,1,0.2", "--goal", "edge:0,0.5,2,0.5", "--walls", "left,right"]
    bounds = ["--control", "3", "--position", "inf", "--force", "none", "--friction", "10"]
    assert run(["import", "map.yaml", *arguments, *bounds, "-o", "task.yaml"]) == 0
    task = load_task("task.yaml")
    assert task.initial == InitialDisc((1.0, 1.0), 0.2)
    assert task.goal.edges == (((0.0, 0.5), (2.0, 0.5)),)
    assert task.workspace.walls == {Side.LEFT, Side.RIGHT}
    data = json.loads(_json("map.yaml", *arguments, *bounds))
    assert data["uncertainty"] == {"control": 3, "position": "inf", "force": "none"}
    assert data["friction"] == 10


def _json(*arguments: str) -> str:
    assert run(["import", *arguments, "-o", "out.json"]) == 0
    return Path("out.json").read_text()


def test_a_robot_may_be_a_disc() -> None:
    places = ["--start", "1,1.5", "--goal", "box:0.5,0.5,1.5,1.9", "--robot-radius", "0.2"]
    assert run(["import", "map.yaml", *places, "-o", "task.yaml"]) == 0
    shape = np.array(load_task("task.yaml").robot.shape)
    middles = (shape + np.roll(shape, -1, axis=0)) / 2
    assert np.hypot(*middles.T) == pytest.approx(0.2)  # circumscribed


@pytest.mark.parametrize(
    ("text", "initial"),
    [
        ("5,3", InitialPoint((5.0, 3.0))),
        ("disc:5,3,0.5", InitialDisc((5.0, 3.0), 0.5)),
        ("box:4,3,6,4", InitialPolygon(((4.0, 3.0), (6.0, 3.0), (6.0, 4.0), (4.0, 4.0)))),
        ("polygon:4,3,6,3,5,4", InitialPolygon(((4.0, 3.0), (6.0, 3.0), (5.0, 4.0)))),
        ("edge:0,1,2,1", InitialEdges((((0.0, 1.0), (2.0, 1.0)),))),
        ("everywhere", Everywhere()),
    ],
)
def test_a_start_has_many_forms(text: str, initial: object) -> None:
    goal = "point:4,0.5; edge:4,0.5,6,0.5; polygon:1,2,3,2,3,3"
    assert run(["import", "floor.wkt", "--start", text, "--goal", goal, "-o", "task.yaml"]) == 0
    task = load_task("task.yaml")
    assert task.initial == initial
    assert (len(task.goal.points), len(task.goal.edges), len(task.goal.polygons)) == (1, 1, 1)


PLACES = ["--start", "5,3", "--goal", "edge:4,0.5,6,0.5"]
REFUSED: list[tuple[list[str], str]] = [
    (["none.wkt"], "none.wkt: cannot be read: No such file or directory"),
    (["floor.wkt"], "--start: is missing: draw it on a layer named start, or say where"),
    (["floor.wkt", "--start", "5,3"], "--goal: is missing"),
    (["pit.wkt", "--start", "5,3"], "--start: there is a start in the drawing: line 4 (start)"),
    (
        ["floor.wkt", *PLACES[:2], "--goal", "edge:0,0,1"],
        "--goal: must have 4 numbers there, not 3",
    ),
    (["floor.wkt", *PLACES[:2], "--goal", "disc:0,0,1"], "--goal: a disc is no goal"),
    (
        ["floor.wkt", *PLACES[:2], "--goal", "edge:0,2,1,2"],
        "--goal.edges[0]: does not lie in contact",
    ),
    (["floor.wkt", *PLACES[:2], "--goal", ""], "--goal: must have an edge, a polygon or a point"),
    (["floor.wkt", "--start", "a,b", *PLACES[2:]], "--start: must be a number, not 'a'"),
    (["floor.wkt", "--start", "nan,1", *PLACES[2:]], "--start.point[0]: must be a finite number"),
    (
        ["floor.wkt", "--start", "5,0.2", *PLACES[2:]],
        "--start.point: (5, 0.2) is inside an obstacle",
    ),
    (["pit.wkt", "--window", "0,0,1"], "--window: must have 4 numbers there, not 3"),
    (["pit.wkt", "--window", "0,0,0,1"], "--window: xmin must be below xmax"),
    (["pit.wkt", "--walls", "middle"], "--walls: must be some of left, right, bottom, top"),
    (["pit.wkt", "--control", "95"], "--control: must be at least 0 and below 90 degrees, not 95"),
    (["pit.wkt", "--position", "-1"], "--position: must be at least 0"),
    (["pit.wkt", "--force", "200"], "--force: must be at least 0 and below 180 degrees"),
    (["pit.wkt", "--friction", "x"], "--friction: must be a number, not 'x'"),
    (["pit.wkt", "--curves", "0"], "--curves: must be a length above 0, not 0.0"),
    (["pit.wkt", "--robot-radius", "inf"], "--robot-radius: must be a length 0 or more, not inf"),
    (["pit.wkt", "--layer", "floor"], "--layer: must be ROLE=NAME"),
    (["pit.wkt", "--units", "m"], "--units: WKT has none: leave this out"),
    (["pit.wkt", "--format", "dxf"], "pit.wkt: is no DXF that can be read"),
    (["pit.wkt", "-o", "pit.wkt"], "pit.wkt: is the input itself"),
    (["pit.wkt", "-o", "task.txt"], "task.txt: must end in .yaml, .json or .toml"),
    (["pit.wkt", "--figure", "task.bmp"], "task.bmp: must end in"),
    (["map.pgm"], "map.pgm: is the image of a map: give the .yaml file that names it"),
]


@pytest.mark.parametrize(("arguments", "line"), REFUSED)
def test_refuses_in_one_line_and_writes_nothing(
    folder: Path, capsys: Capture, arguments: list[str], line: str
) -> None:
    before = sorted(folder.iterdir())
    output = [] if "-o" in arguments else ["-o", "task.yaml"]
    assert run(["import", *arguments, *output]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"preimage: {line}"), printed.err
    assert printed.err.count("\n") == 1
    assert sorted(folder.iterdir()) == before


def test_a_layer_may_have_any_name() -> None:
    Path("other.wkt").write_text(PIT.replace("walls:", "BUILT:"))
    assert run(["import", "other.wkt", "--layer", "obstacles=built", "-o", "task.yaml"]) == 0
    assert len(load_task("task.yaml").workspace.obstacles) == 1
