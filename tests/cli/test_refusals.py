import os
from pathlib import Path

import pytest

from preimage.cli.main import run
from preimage.task.examples import named_task
from preimage.task.files import save_task

Capture = pytest.CaptureFixture[str]

BAD = """version: 1
window: [0, 0, 4, 4]
obstacles: [{polygon: [[0, 0], [2, 2], [2, 0], [0, 2]]}]
uncertainty: {control: 5, position: 0.1}
initial: everywhere
goal: {points: [[0, 0]]}
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    save_task(named_task("flat-floor"), "task.yaml")
    Path("bad.yaml").write_text(BAD)
    Path("plan.json").write_text('{"regions": [], "status": "solved"}')
    Path("folder").mkdir()
    return tmp_path


DOWN = ["backproject", "task.yaml", "-d", "down"]

REFUSED: list[tuple[list[str], str]] = [
    (["plan"], "give a TASK file, or a named task by --example NAME"),
    (["plan", "task.yaml", "--example", "flat-floor"], "give a TASK file, or a named task"),
    (["plan", "none.yaml"], "none.yaml: cannot be read: No such file or directory"),
    (["plan", "folder"], "folder: must end in .yaml, .json or .toml"),
    (["plan", "flat-floor"], "flat-floor: is no file; the named task is --example flat-floor"),
    (["plan", "--example", "flat-flor"], "--example: 'flat-flor' is no named task, did you mean"),
    (["plan", "bad.yaml"], "bad.yaml: obstacles[0].polygon: edges 0 and 2 cross"),
    (["check", "bad.yaml"], "bad.yaml: obstacles[0].polygon: edges 0 and 2 cross"),
    (["draw", "bad.yaml", "-o", "a.svg"], "bad.yaml: obstacles[0].polygon: edges 0 and 2 cross"),
    (["draw", "plan.json", "-o", "a.svg"], "plan.json: version: is missing"),
    (["plan", "task.yaml", "--directions", "3"], "--directions: must be even, not 3"),
    (["plan", "task.yaml", "--directions", "0,x"], "--directions[1]: must be a number, not 'x'"),
    (["plan", "task.yaml", "--max-steps", "0"], "--max-steps: must be at least 1"),
    (["plan", "task.yaml", "--time-limit", "-1"], "--time-limit: must be above 0"),
    (["plan", "task.yaml", "--time-limit", "nan"], "--time-limit: must be a finite number"),
    (["plan", "task.yaml", "--method", "magic"], "Invalid value for '--method': 'magic' is not"),
    (["plan", "task.yaml", "--frobnicate"], "No such option '--frobnicate' (see preimage plan"),
    (["frobnicate"], "No such command 'frobnicate' (see preimage --help)"),
    (
        ["plan", "task.yaml", "--directions", "continuous", "--strategy", "conditional"],
        "task.yaml: planner.directions: continuous directions are for linear strategies with",
    ),
    (
        ["plan", "task.yaml", "--termination", "final-state", "--search", "led"],
        "task.yaml: planner.search: led searches know instantaneous conditions alone",
    ),
    (
        ["plan", "task.yaml", "--directions", "continuous", "--or-fail"],
        "task.yaml: planner.or_fail: a plan that may know its failure needs a list of directions",
    ),
    (["plan", "task.yaml", "-o", "no/plan.json"], "no/plan.json: cannot be written: No such file"),
    (["plan", "task.yaml", "-o", "folder"], "folder: is a directory, not a file"),
    (["plan", "task.yaml", "-o", ""], "'': is a directory, not a file"),
    (["plan", "task.yaml", "-o", "task.yaml"], "task.yaml: is the input itself"),
    (["plan", "task.yaml", "-o", "x" * 300], "x" * 300 + ": cannot be written: File name too long"),
    (["plan", "task.yaml", "-o", "task.yaml/a"], "task.yaml/a: cannot be written: Not a directory"),
    (["plan", "task.yaml", "--figure", "a.gif"], "a.gif: must end in .svg, .png or .pdf"),
    (["plan", "task.yaml", "--figure", "-"], "-: must end in .svg, .png or .pdf"),
    (
        ["plan", "task.yaml", "-o", "a.svg", "--figure", "./a.svg"],
        "./a.svg: is the file of --output too",
    ),
    (["draw", "task.yaml", "-o", "no/a.svg"], "no/a.svg: cannot be written: No such file"),
    (["draw", "task.yaml"], "Missing option '-o'"),
    (["draw", "task.yaml", "-o", "a.svg", "--columns", "0"], "a.svg: picture.columns: must be at"),
    (["kernel", "task.yaml"], "Missing option '--direction' / '-d'"),
    (["kernel", "task.yaml", "-d", "sideways"], "Invalid value for '--direction' / '-d': 'sideway"),
    (["kernel", "task.yaml", "-d", "nan"], "Invalid value for '--direction' / '-d': 'nan'"),
    (["kernel", "task.yaml", "-d", "1e9"], "Invalid value for '--direction' / '-d': '1e9'"),
    ([*DOWN, "--target", "magic"], "--target: 'magic' is none of goal, sticking, kernel, combined"),
    ([*DOWN, "--target", "edge:1,2"], "--target: edge must have 4 numbers, not 2"),
    ([*DOWN, "--target", "polygon:1,2"], "--target: polygon must have 6 numbers or more"),
    ([*DOWN, "--target", "point:1,2,3"], "--target: point must have 2 numbers, not 3"),
    ([*DOWN, "--target", "edge:1,2,3,z"], "--target: '1,2,3,z' are not numbers"),
    ([*DOWN, "--target", "edge:1,2,3,4"], "--target: goal.edges[0]: does not lie in contact space"),
    ([*DOWN, "--target", "point:1,2; blob:3"], "--target: 'blob:3' is no edge:, polygon: or point"),
    ([*DOWN, "--target", "none.geojson"], "none.geojson: cannot be read: No such file"),
    ([*DOWN, "--target", '{"type": "Blob"}'], "--target: geometry.type: must be one of Polygon"),
    ([*DOWN, "--target", "{"], "--target: is not JSON"),
    (
        [*DOWN, "--target", '{"type": "FeatureCollection", "features": []}'],
        "--target: features: must be one",
    ),
    (
        [*DOWN, "--target", '{"type": "GeometryCollection", "geometries": []}'],
        "--target: is empty",
    ),
    (["examples", "nothing"], "NAME: 'nothing' is no named task"),
    (["examples", "flat-floor", "-o", "task.txt"], "task.txt: must end in .yaml, .json or .toml"),
    (["schema", "blob"], "Invalid value for"),
    (["completion", "cmd"], "Invalid value for"),
]


@pytest.mark.parametrize(("arguments", "line"), REFUSED, ids=[" ".join(a) for a, _ in REFUSED])
def test_one_line_status_2_and_nothing_written(
    arguments: list[str], line: str, folder: Path, capsys: Capture
) -> None:
    before = sorted(os.walk(folder))
    assert run(arguments) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"preimage: {line}")
    assert printed.err.count("\n") == 1
    assert sorted(os.walk(folder)) == before


def test_a_folder_that_may_not_be_written_to(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    def refuse(**_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("tempfile.TemporaryFile", refuse)
    assert run(["plan", "task.yaml", "-o", "folder/plan.json"]) == 2
    line = "preimage: folder/plan.json: cannot be written: Permission denied\n"
    assert capsys.readouterr().err == line


def test_without_matplotlib_figures_are_refused_at_once(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _name: None)
    assert run(["plan", "task.yaml", "--figure", "a.svg"]) == 2
    assert "needs matplotlib: pip install 'preimage[draw]'" in capsys.readouterr().err


def test_an_output_that_fails_late_leaves_nothing(
    monkeypatch: pytest.MonkeyPatch, folder: Path, capsys: Capture
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    before = sorted(os.listdir(folder))
    assert run(["plan", "task.yaml", "-o", "new.json"]) == 2
    assert capsys.readouterr().err == "preimage: new.json: cannot be written: " + (
        "No space left on device\n"
    )
    assert sorted(os.listdir(folder)) == before
