import json
import math
from pathlib import Path

import pytest

from preimage.cli.main import run
from preimage.search import planner
from preimage.search.limits import Progress
from preimage.strategy.plan_file import format_plan, read_plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task
from preimage.task.files import save_task
from preimage.task.options import Method, SearchOrder
from preimage.task.task import Task

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def task_file(tmp_path: Path) -> Path:
    path = tmp_path / "task.yaml"
    save_task(named_task("flat-floor"), path)
    return path


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Task]:
    """The tasks that the planner was asked to plan."""
    tasks: list[Task] = []
    plan = planner.plan

    def remember(task: Task, **options: object) -> Strategy:
        tasks.append(task)
        return plan(task, cancelled=lambda: True)

    monkeypatch.setattr(planner, "plan", remember)
    return tasks


def test_plans_and_tells(task_file: Path, capsys: Capture) -> None:
    assert run(["plan", str(task_file)]) == 0
    printed = capsys.readouterr()
    assert printed.out.startswith("flat-floor: solved in 1 motion\n")
    assert "motion 1 of 1: ↓ down (270°)" in printed.out
    assert printed.err == ""
    assert list(task_file.parent.iterdir()) == [task_file]


def test_writes_the_plan_and_its_picture(tmp_path: Path, capsys: Capture) -> None:
    plan, picture = tmp_path / "plan.json", tmp_path / "plan.svg"
    arguments = ["plan", "--example", "flat-floor", "-o", str(plan), "--figure", str(picture)]
    assert run(arguments) == 0
    assert capsys.readouterr().out.splitlines()[-1] == f"written: {plan}, {picture}"
    strategy = read_plan(plan)
    assert strategy.status is Status.SOLVED
    assert plan.read_text(encoding="utf-8") == format_plan(strategy)
    assert picture.read_text(encoding="utf-8").startswith("<?xml")
    assert sorted(tmp_path.iterdir()) == [plan, picture]


def test_the_plan_on_standard_output_is_alone_there(capsys: Capture) -> None:
    assert run(["plan", "--example", "flat-floor", "-o", "-"]) == 0
    printed = capsys.readouterr()
    assert json.loads(printed.out)["status"] == "solved"
    assert printed.err.startswith("flat-floor: solved")


def test_what_is_not_solved_is_written_and_told_by_the_status(
    tmp_path: Path, capsys: Capture
) -> None:
    plan = tmp_path / "plan.json"
    arguments = ["plan", "--example", "flat-floor", "--directions", "90,", "-o", str(plan)]
    assert run(arguments) == 1
    assert "not solvable" in capsys.readouterr().out
    assert json.loads(plan.read_text())["status"] == "unsolvable"
    assert run([*arguments[:-4], "--directions", "0,180", "--max-regions", "1"]) == 1
    assert "stopped: the limit of 1 regions came first" in capsys.readouterr().out


def test_options_override_the_task(asked: list[Task]) -> None:
    arguments = ["plan", "--example", "flat-floor", "--method", "kernel", "--search", "best-first"]
    arguments += ["--directions", "6", "--max-steps", "3", "--time-limit", "2.5"]
    assert run([*arguments, "--max-regions", "77"]) == 1
    options = asked[0].options
    assert options.method is Method.KERNEL
    assert options.search is SearchOrder.BEST_FIRST
    assert options.directions == tuple(math.radians(turn) for turn in range(0, 360, 60))
    assert (options.max_steps, options.time_limit, options.max_regions) == (3, 2.5, 77)
    given = named_task("flat-floor").options
    assert (options.strategy, options.arc_tolerance) == (given.strategy, given.arc_tolerance)


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("4", (0, 90, 180, 270)),
        ("270,0", (0, 270)),
        ("270,", (270,)),
        ("[90]", (90,)),
        ("down, up", (90, 270)),
        ("-90 0", (0, 270)),
    ],
)
def test_directions(text: str, degrees: tuple[float, ...], asked: list[Task]) -> None:
    run(["plan", "--example", "flat-floor", "--directions", text])
    assert asked[0].options.directions == tuple(math.radians(turn) for turn in degrees)


def test_progress_is_told_on_a_terminal_alone(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    plan = planner.plan

    def slow(task: Task, *, progress: object = None, **options: object) -> Strategy:
        assert callable(progress)
        for layer in range(3):
            progress(Progress(10 * layer, layer, "1.5 from the start", 7.0))
        return plan(task)

    monkeypatch.setattr(planner, "plan", slow)
    monkeypatch.setattr("preimage.cli.progress.QUIET", 0.0)
    monkeypatch.setattr("preimage.cli.progress.PAUSE", 0.0)
    assert run(["plan", "--example", "flat-floor"]) == 0
    assert capsys.readouterr().err == ""
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    assert run(["plan", "--example", "flat-floor"]) == 0
    told = capsys.readouterr().err
    assert "\r\x1b[K20 regions, layer 2, best 1.5 from the start, 7.0 s" in told
    assert told.endswith("\r\x1b[K")


def test_standard_input(monkeypatch: pytest.MonkeyPatch, task_file: Path, capsys: Capture) -> None:
    with task_file.open() as file:
        monkeypatch.setattr("sys.stdin", file)
        assert run(["plan", "-"]) == 0
    assert capsys.readouterr().out.startswith("flat-floor: solved")


def test_a_defect_is_neither_solved_nor_unsolved(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    def fail(*_: object, **__: object) -> Strategy:
        raise ZeroDivisionError

    monkeypatch.setattr(planner, "plan", fail)
    assert run(["plan", "--example", "flat-floor"]) == 70
    assert capsys.readouterr().err.endswith("preimage: this is a defect of the program\n")


def test_margins_are_told_and_written(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "plan.json"
    assert run(["plan", "--example", "peg-in-hole", "-o", str(file)]) == 0
    (line,) = (one for one in capsys.readouterr().out.splitlines() if one.startswith("margins"))
    margins = read_plan(file).margins
    assert margins is not None
    assert line == f"margins: {margins.words}"
    assert margins.reading is not None
    assert margins.reading > 0.0


def test_margins_may_be_left_out(
    tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "plan.json"
    arguments = ["plan", "--example", "flat-floor", "-o", str(file)]
    assert run([*arguments, "--no-margins"]) == 0
    assert "margins:" not in capsys.readouterr().out
    assert "margins" not in json.loads(file.read_text())
    monkeypatch.setattr("preimage.cli.planning.MOST", 0)
    assert run(arguments) == 0
    assert "margins: left out, since in a scene as large as this" in capsys.readouterr().out
    assert "margins" not in json.loads(file.read_text())


def test_the_plan_with_the_largest_smallest_margin(capsys: Capture) -> None:
    arguments = ["plan", "--example", "connector"]
    assert run([*arguments, "--prefer", "margin"]) == 0
    assert "8 were compared by their smallest margin" in capsys.readouterr().out
    assert run([*arguments, "--prefer", "margin", "--search", "best-first"]) == 2
    assert capsys.readouterr().err.startswith("preimage: connector: planner.prefer: margin needs")
    assert run([*arguments, "--prefer", "room"]) == 2
