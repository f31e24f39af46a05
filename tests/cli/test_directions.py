import json
import math
from pathlib import Path
from typing import Any

import pytest

from preimage.cli.main import run

Capture = pytest.CaptureFixture[str]

FLOOR = ["directions", "--example", "flat-floor"]


def data(text: str) -> Any:
    return json.loads(text)


def test_arcs_with_margins(capsys: Capture) -> None:
    assert run(FLOOR) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "flat-floor: one motion, combined method, to 0.1°"
    assert lines[1] == "from the start"
    (solves,) = (line for line in lines if "solves" in line)
    assert "270.000° by a margin of 11.7" in solves
    assert sum("fails" in line for line in lines) == 1


def test_json_and_picture(tmp_path: Path, capsys: Capture) -> None:
    file, picture = tmp_path / "roses.json", tmp_path / "roses.svg"
    more = ["--roses", "4x3", "--resolution", "1", "-o", str(file), "--figure", str(picture)]
    assert run([*FLOOR, *more]) == 0
    told = capsys.readouterr().out.splitlines()
    assert told[-1] == f"written: {file}, {picture}"
    assert "starts of the grid" in told[-2]
    found = data(file.read_text(encoding="utf-8"))
    assert found["method"] == "combined"
    assert found["resolution"] == pytest.approx(1.0)
    assert [len(found["roses"]), found["roses"][0]["from"]] == [1, [0.0, 5.0]]
    arcs = found["roses"][0]["arcs"]
    assert math.fsum(arc["high"] - arc["low"] for arc in arcs) == pytest.approx(360.0)
    assert {arc["verdict"] for arc in arcs} <= {"solves", "fails", "unproven"}
    assert found["grid"]
    assert picture.stat().st_size > 1000


def test_other_starts(capsys: Capture) -> None:
    assert run([*FLOOR, "--from", "0,5", "--from", "14,1", "-o", "-"]) == 0
    told = capsys.readouterr()
    assert [one["from"] for one in data(told.out)["roses"]] == [[0.0, 5.0], [14.0, 1.0]]
    assert "from (14, 1)" in told.err


def test_none_is_known_to_solve(capsys: Capture) -> None:
    assert run([*FLOOR, "--from", "14,14"]) == 1
    assert "no direction is known to solve" in capsys.readouterr().out


def test_method_of_the_command_line(capsys: Capture) -> None:
    assert run([*FLOOR, "--method", "kernel"]) in (0, 1)
    assert "kernel method" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--from", "1"], "--from: must be two numbers, as in 1,2.5, not '1'"),
        (["--from", "a,b"], "--from: must be two numbers"),
        (["--from", "nan,1"], "--from"),
        (["--from", "0,-3"], "--from: (0, -3) is inside an obstacle"),
        (["--roses", "0x4"], "--roses: must be two whole numbers above 0"),
        (["--roses", "1.5x4"], "--roses: must be two whole numbers above 0"),
        (["--roses", "infx4"], "--roses: must be two whole numbers above 0"),
        (["--roses", "4"], "--roses: must be two whole numbers, as in 12x8, not '4'"),
        (["--resolution", "0"], "--resolution"),
        (["--resolution", "fine"], "--resolution"),
        (["--figure", "rose.txt"], "rose.txt: must end in .svg, .png or .pdf"),
    ],
)
def test_refusals(arguments: list[str], words: str, capsys: Capture) -> None:
    assert run([*FLOOR, *arguments]) == 2
    told = capsys.readouterr()
    assert words in told.err
    assert told.out == ""
