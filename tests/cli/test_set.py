"""`--set`: other values for the named numbers of a task."""

from pathlib import Path

import pytest

from preimage.cli.arguments import Source, load, overridden
from preimage.cli.main import run
from preimage.strategy.plan_file import read_plan
from preimage.task import Method, named_template, save_task
from preimage.task.examples import named_task_text

Capture = pytest.CaptureFixture[str]
HOLE = ["--example", "tight-hole"]


def test_a_plan_is_of_the_values_given(tmp_path: Path) -> None:
    path, plan = tmp_path / "hole.yaml", tmp_path / "plan.json"
    path.write_text(named_task_text("tight-hole"), encoding="utf-8")
    settings = ["--set", "clearance=0.4", "--set", " depth = 3"]
    for source in ([str(path)], HOLE):
        assert run(["plan", *source, *settings, "-o", str(plan)]) == 0
        task = named_template("tight-hole").task(clearance=0.4, depth=3)
        assert read_plan(plan).task == task
        assert "parameters" not in plan.read_text(encoding="utf-8")


def test_check_says_the_values(tmp_path: Path, capsys: Capture) -> None:
    assert run(["check", *HOLE, "--set", "depth=3.25"]) == 0
    line = "\nparameters: peg = 1, clearance = 0.5, chamfer = 0.5, depth = 3.25\n"
    assert capsys.readouterr().out.endswith(line)
    whole = tmp_path / "whole.yaml"
    save_task(named_template("tight-hole").task(), whole)
    assert run(["check", str(whole)]) == 0
    assert "parameters" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("settings", "line"),
    [
        (["depht=1"], "--set depht: the task has no such parameter, did you mean depth?"),
        (["depth"], "--set: must be NAME=VALUE with a number, not 'depth'"),
        (["depth="], "--set: must be NAME=VALUE with a number, not 'depth='"),
        (["=1"], "--set: must be NAME=VALUE with a number, not '=1'"),
        (["depth=1/2"], "--set: must be NAME=VALUE with a number, not 'depth=1/2'"),
        (["depth=nan"], "--set depth: must be a finite number, not nan"),
        (["depth=1e999"], "--set depth: must be a finite number, not inf"),
        (["depth=1", "depth=1"], "--set: 'depth' is given twice"),
        (["peg=1e10"], "tight-hole: robot.polygon[0][0]: must be at least -1e+09"),
        (["clearance=-1"], "tight-hole: obstacles[0].chain: edge 0 and edge 5 touch (with peg = 1"),
    ],
)
def test_refuses_in_one_line(settings: list[str], line: str, capsys: Capture) -> None:
    given = [word for setting in settings for word in ("--set", setting)]
    assert run(["check", *HOLE, *given]) == 2
    found = capsys.readouterr().err
    assert found.startswith(f"preimage: {line}")
    assert found.count("\n") == 1


def test_a_task_without_parameters_has_none_to_set(capsys: Capture) -> None:
    assert run(["plan", "--example", "flat-floor", "--set", "a=1"]) == 2
    assert capsys.readouterr().err == "preimage: --set a: the task has no such parameter\n"


def test_pictures_are_of_the_values_given(tmp_path: Path, capsys: Capture) -> None:
    path, plan = tmp_path / "hole.yaml", tmp_path / "plan.json"
    path.write_text(named_task_text("tight-hole"), encoding="utf-8")
    pictures: list[bytes] = []
    for number, depth in enumerate(("2.5", "4", "4")):
        picture = tmp_path / f"{number}.svg"
        source = HOLE if number == 1 else [str(path)]
        assert run(["draw", *source, "--set", f"depth={depth}", "-o", str(picture)]) == 0
        pictures.append(picture.read_bytes())
    assert pictures[0] != pictures[1] == pictures[2]
    assert run(["plan", *HOLE, "-o", str(plan)]) == 0
    capsys.readouterr()
    assert run(["draw", str(plan), "--set", "depth=4", "-o", str(tmp_path / "a.svg")]) == 2
    line = "is a plan, whose task has no parameters for --set\n"
    assert capsys.readouterr().err.endswith(line)


def test_options_are_those_of_the_template_too() -> None:
    source = load(None, "tight-hole")
    assert isinstance(source, Source)
    changed = overridden(source, {"method": "kernel", "directions": "0,90", "max_steps": 3})
    assert changed.task.options.method is Method.KERNEL
    assert changed.template.task() == changed.task
    assert changed.template.task(depth=3) != changed.task
    assert changed.template.digest != source.template.digest
    assert source.template.task() == source.task
