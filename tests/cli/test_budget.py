from __future__ import annotations

import json
from pathlib import Path

import pytest

from preimage.cli.main import run
from preimage.strategy.plan_parse import parse_plan
from preimage.strategy.strategy import Status
from preimage.task.degrees import to_degrees

FLOOR = ["--example", "flat-floor", "--max-steps", "1", "--workers", "1"]


def test_a_table_is_printed_and_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output, figure = tmp_path / "b.json", tmp_path / "b.svg"
    arguments = ["budget", *FLOOR, "--bounds", "control,position"]
    assert run([*arguments, "-o", str(output), "--figure", str(figure)]) == 0
    out = capsys.readouterr().out
    assert "uncertainty.control" in out
    assert "+11.8" in out
    content = json.loads(output.read_text())
    assert content["bounds"][0]["slack"] == pytest.approx(11.8)
    assert figure.read_text().startswith("<?xml")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["b.json", "b.svg"]


def test_a_map_and_the_plan_of_one_of_its_cells(tmp_path: Path) -> None:
    output, plan = tmp_path / "m.json", tmp_path / "p.json"
    arguments = ["budget", *FLOOR, "--map", "control,position", "--resolution", "4x3"]
    arguments += ["--at", "control=7.5,position=0.25", "--plan", str(plan), "-o", str(output)]
    assert run(arguments) == 0
    content = json.loads(output.read_text())
    assert len(content["x"]["values"]) == 4
    assert len(content["y"]["values"]) == 3
    strategy = parse_plan(json.loads(plan.read_text()))
    assert strategy.status is Status.SOLVED
    assert to_degrees(strategy.task.uncertainty.control) == 7.5
    assert strategy.task.uncertainty.position == 0.25


def test_a_store_of_another_task_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kept = ["--store", str(tmp_path / "cells")]
    assert run(["budget", *FLOOR, "--bounds", "control", *kept]) == 0
    other = ["budget", "--example", "peg-in-hole-point", "--bounds", "control", *kept]
    assert run([*other, "--workers", "1"]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "holds another task" in error


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--bounds", "contrl"], "did you mean control"),
        (["--bounds", ","], "--bounds: names none"),
        (["--map", "control"], "--map: must be two bounds"),
        (["--map", "control,control"], "differ"),
        (["--map", "control,position", "--resolution", "4"], "--resolution: must be as in 40x40"),
        (["--map", "control,position", "--resolution", "1x9"], "2 to 1000"),
        (["--resolution", "4x4"], "--resolution: is that of a map"),
        (["--bounds", "control", "--map", "control,position"], "one of the two"),
        (["--range", "control"], "--range: must be as in"),
        (["--range", "control=a:b"], "is no number"),
        (["--bounds", "control", "--range", "control=9:3"], "rise"),
        (["--bounds", "control", "--range", "position=0:1"], "is not asked for"),
        (["--bounds", "control", "--step", "control=-1"], "above 0"),
        (["--at", "control=3"], "--at and --plan go together"),
        (["--at", "nothing=3", "--plan", "/tmp/never.json", "--bounds", "control"], "nothing"),
        (["--figure", "budget.txt"], "must end in"),
        (["--workers", "0"], "--workers"),
        (["--scheduler", "nonsense"], "no Dask scheduler"),
    ],
)
def test_what_is_no_question_is_refused_in_a_line(
    arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["budget", "--example", "flat-floor", "--max-steps", "1", *arguments]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert words in error


def test_why_there_is_no_plan(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    figure, film = tmp_path / "why.png", tmp_path / "nature.html"
    arguments = ["explain", "--example", "peg-in-hole", "--bounds", "control", "--workers", "1"]
    assert run([*arguments, "--figure", str(figure), "--animate", str(film)]) == 0
    out = capsys.readouterr().out
    assert "why a plan takes 2 motions" in out
    assert "nature" in out
    assert "uncertainty.control: no value of it alone" in out
    assert figure.read_bytes().startswith(b"\x89PNG")
    assert film.stat().st_size > 1_000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--bounds", "contrl"], "did you mean control"),
        (["--bounds", "control", "--no-budget"], "--no-budget"),
        (["--animate", "nature.txt"], "must end in"),
    ],
)
def test_what_cannot_be_explained_is_refused(
    arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["explain", "--example", "peg-in-hole", "--workers", "1", *arguments]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert words in error
