import json
from pathlib import Path

import pytest

from preimage.cli.main import run
from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict, write_plan
from preimage.task.examples import named_task

Capture = pytest.CaptureFixture[str]


@pytest.fixture(scope="module")
def plan_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("plans") / "peg.json"
    write_plan(plan(named_task("peg-in-hole")), path)
    return path


def with_task(plan_file: Path, path: Path, **uncertainty: float) -> Path:
    data = json.loads(plan_file.read_text())
    data["task"]["uncertainty"].update(uncertainty)
    path.write_text(json.dumps(data))
    return path


def test_a_true_plan_is_proven(plan_file: Path, capsys: Capture) -> None:
    assert run(["verify", str(plan_file), "--maximality"]) == 0
    printed = capsys.readouterr()
    lines = printed.out.splitlines()
    assert lines[0].startswith("peg-in-hole: proven in 2 motions")
    assert sum(line.startswith("region ") and line.endswith(": proven") for line in lines) == 2
    assert sum(line.startswith("  maximal ") for line in lines) == 2
    assert any(line.startswith("  begins ") for line in lines)
    assert printed.err == ""


def test_a_wrong_plan_is_refuted_and_drawn(
    plan_file: Path, tmp_path: Path, capsys: Capture
) -> None:
    wrong = with_task(plan_file, tmp_path / "wrong.json", control=7.0)
    picture = tmp_path / "wrong.svg"
    assert run(["verify", str(wrong), "--figure", str(picture)]) == 1
    out = capsys.readouterr().out
    assert out.startswith("peg-in-hole: refuted\n")
    assert "may rest on" in out
    assert "    from " in out
    assert f"written: {picture}" in out
    assert picture.read_text().lstrip().startswith("<?xml")


def test_runs(plan_file: Path, capsys: Capture) -> None:
    assert run(["verify", str(plan_file), "--runs", "1", "--seed", "3"]) == 0
    assert "under" in capsys.readouterr().out.splitlines()[-1]


def test_an_unsolved_plan_promises_nothing(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "cradle.json"
    data = plan_to_dict(plan(named_task("cradle")))
    data.update(status="stopped", start=[], steps=[])
    path.write_text(json.dumps(data))
    assert run(["verify", str(path)]) == 1
    out = capsys.readouterr().out
    assert out == "cradle: not proven: the plan's status is stopped: it promises nothing\n"


@pytest.mark.parametrize(
    "arguments",
    [["missing.json"], ["{plan}", "--figure", "verdict.txt"], ["{plan}", "--runs", "-1"], []],
)
def test_bad_input_is_refused(arguments: list[str], plan_file: Path, capsys: Capture) -> None:
    given = [str(plan_file) if word == "{plan}" else word for word in arguments]
    assert run(["verify", *given]) == 2
    assert capsys.readouterr().err.startswith("preimage: ")
