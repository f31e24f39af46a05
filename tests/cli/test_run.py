import json
from dataclasses import replace
from pathlib import Path

import pytest

from preimage.cli.main import run
from preimage.execution.control import CONTROLS
from preimage.execution.sensing import SENSINGS
from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict, write_plan
from preimage.task.examples import named_task
from preimage.task.options import Method

Capture = pytest.CaptureFixture[str]


@pytest.fixture(scope="module")
def plan_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("plans") / "peg.json"
    write_plan(plan(named_task("peg-in-hole")), path)
    return path


@pytest.fixture
def broken(plan_file: Path, tmp_path: Path) -> Path:
    """A plan whose task has more control error than it was made for."""
    data = json.loads(plan_file.read_text())
    data["task"]["uncertainty"]["control"] = 25.0
    path = tmp_path / "broken.json"
    path.write_text(json.dumps(data))
    return path


def test_runs_and_tells(plan_file: Path, capsys: Capture) -> None:
    assert run(["run", str(plan_file), "--runs", "2"]) == 0
    printed = capsys.readouterr()
    pairs = len(CONTROLS) * len(SENSINGS)
    assert printed.out.startswith(f"peg-in-hole: {2 * pairs} runs under {pairs} pairs")
    assert f"succeeded    {2 * pairs} (100 %)" in printed.out
    assert "time" in printed.out
    assert printed.err == ""


def test_one_adversary_alone_or_a_pair(plan_file: Path, capsys: Capture) -> None:
    for name, pairs in (
        ("hunting", len(SENSINGS)),
        ("towards", len(CONTROLS)),
        ("hunting+towards", 1),
        ("all", len(SENSINGS) * len(CONTROLS)),
    ):
        assert run(["run", str(plan_file), "--runs", "1", "--adversary", name]) == 0
        assert f"under {pairs} pair" in capsys.readouterr().out


def test_an_adversary_of_ones_own(plan_file: Path, tmp_path: Path, capsys: Capture) -> None:
    own = tmp_path / "mine.py"
    own.write_text("def drift(now):\n    return now.choices(now.cone, duration=0.1)\n")
    arguments = ["run", str(plan_file), "--runs", "3", "--adversary", f"{own}:drift"]
    assert run([*arguments, "--adversary", "noise"]) == 0
    assert "3 runs under 1 pair" in capsys.readouterr().out
    for words, refusal in (
        (f"{own}:other", "has no function 'other'"),
        (f"{tmp_path / 'none.py'}:f", "there is no such file"),
    ):
        assert run(["run", str(plan_file), "--adversary", words]) == 2
        printed = capsys.readouterr()
        assert refusal in printed.err
        assert len(printed.err.splitlines()) == 1


def test_what_an_adversary_of_ones_own_does_wrong_is_said(
    plan_file: Path, tmp_path: Path, capsys: Capture
) -> None:
    own = tmp_path / "mine.py"
    own.write_text(
        "def crash(now):\n    return 1 / 0\n"
        "def nowhere(now):\n    return now.choices(float('nan'))\n"
        "def nothing(now):\n    return now.part(now.touching).choices(0.0)\n"
        "def fine(now):\n    return now.choices(0.1)\n"
    )
    arguments = ["run", str(plan_file), "--runs", "2", "--adversary"]
    for name, words in (
        ("crash", "ZeroDivisionError"),
        ("nowhere", "directions that are numbers"),
        ("nothing", "for each of 2 robots"),
    ):
        assert run([*arguments, f"{own}:{name}"]) == 2, name
        printed = capsys.readouterr()
        assert words in printed.err
        assert len(printed.err.splitlines()) == 1
    assert run([*arguments, f"{own}:fine", "--parallel"]) == 0


def test_runs_that_were_not_made_are_no_success(
    plan_file: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("preimage.cli.execution.Interruption.__call__", lambda _: True)
    assert run(["run", str(plan_file), "--runs", "2"]) == 1
    assert "interrupted: 1 of 88 pairs" in capsys.readouterr().out


def test_adversaries_are_listed(capsys: Capture) -> None:
    assert run(["run", "--adversaries"]) == 0
    printed = capsys.readouterr().out
    for name in (*CONTROLS, *SENSINGS):
        assert name in printed


def test_writes_counts_and_traces(plan_file: Path, tmp_path: Path, capsys: Capture) -> None:
    out = tmp_path / "trace.json"
    arguments = ["run", str(plan_file), "--adversary", "random+noise", "--runs", "4"]
    assert run([*arguments, "-o", str(out)]) == 0
    data = json.loads(out.read_text())
    assert data["outcomes"] == {"success": 4}
    assert data["failure"] is None
    assert data["adversaries"][0]["control"] == "random"
    for sample in (*data["samples"], data["slowest"]):
        motions = sample["motions"]
        assert [motion["direction"] for motion in motions] == [0.0, 270.0]
        for motion in motions:
            lengths = {len(motion[key]) for key in ("time", "position", "feature", "measured")}
            assert lengths == {len(motion["force"])}
    assert run([*arguments, "-o", "-"]) == 0
    assert json.loads(capsys.readouterr().out.split("written", 1)[-1].split("\n", 1)[-1]) == data


def test_the_first_failure_is_told_and_kept(broken: Path, tmp_path: Path, capsys: Capture) -> None:
    out, figure = tmp_path / "trace.json", tmp_path / "runs.png"
    assert run(["run", str(broken), "--runs", "50", "-o", str(out), "--figure", str(figure)]) == 1
    printed = capsys.readouterr().out
    assert "first failure: run" in printed
    assert "failed" in printed
    assert json.loads(out.read_text())["failure"]["outcome"] != "success"
    assert figure.stat().st_size > 10_000


def test_runs_from_a_place(plan_file: Path, capsys: Capture) -> None:
    arguments = ["run", str(plan_file), "--runs", "2", "--adversary", "random+noise"]
    assert run([*arguments, "--from", "-6,3"]) == 0
    assert capsys.readouterr().err == ""
    assert run([*arguments, "--from", "9,9"]) == 1
    assert "from there nothing is guaranteed" in capsys.readouterr().err
    for place, words in (
        ("here", "must be two numbers"),
        ("1", "must be two numbers"),
        ("nan,0", "--from"),
        ("1e9,0", "--from"),
    ):
        assert run([*arguments, "--from", place]) == 2, place
        printed = capsys.readouterr()
        assert words in printed.err
        assert len(printed.err.splitlines()) == 1


def test_the_same_seed_gives_the_same_file(plan_file: Path, tmp_path: Path) -> None:
    texts = []
    for name, more in (("a", []), ("b", ["--parallel"]), ("c", ["--seed", "1"])):
        out = tmp_path / name
        arguments = ["run", str(plan_file), "--runs", "3", "--adversary", "bias", "-o", str(out)]
        assert run([*arguments, *more]) == 0
        texts.append(out.read_text())
    assert texts[0] == texts[1]
    assert texts[0] != texts[2]


def test_refusals(plan_file: Path, tmp_path: Path, capsys: Capture) -> None:
    task = named_task("cradle")
    unsolved = tmp_path / "unsolved.json"
    options = replace(task.options, method=Method.KERNEL)
    write_plan(plan(replace(task, options=options)), unsolved)
    data = plan_to_dict(plan(named_task("flat-floor")))
    del data["regions"]
    torn = tmp_path / "torn.json"
    torn.write_text(json.dumps(data))
    for arguments, words in (
        ([str(unsolved)], "nothing to run"),
        ([str(torn)], "regions"),
        ([str(tmp_path / "none.json")], "none.json"),
        ([str(plan_file), "--adversary", "nobody"], "must be one of"),
        ([str(plan_file), "--runs", "0"], "--runs"),
        ([str(plan_file), "--figure", "runs.txt"], "runs.txt"),
        ([str(plan_file), "--animate", "runs.txt"], "runs.txt"),
        ([str(plan_file), "-o", str(plan_file)], "the input itself"),
        ([str(plan_file), "-o", str(tmp_path / "no" / "where.json")], "cannot be written"),
    ):
        assert run(["run", *arguments]) == 2, arguments
        printed = capsys.readouterr()
        assert words in printed.err, printed.err
        assert len(printed.err.splitlines()) == 1
        assert printed.out == ""
