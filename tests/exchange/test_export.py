"""Exported plans do what the executor does, reading by reading."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from random import Random
from types import ModuleType
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import preimage
from preimage.errors import InputError
from preimage.exchange.behaviour_tree import behaviour_tree
from preimage.exchange.export import ExportFormat, export
from preimage.exchange.python_module import module_text
from preimage.execution.cells import ReadingCells
from preimage.execution.executor import Doing, Executor
from preimage.execution.runs import trace_of
from preimage.execution.trace import Outcome
from preimage.strategy.strategy import Strategy
from preimage.task.options import Method, StrategyKind, Termination
from tests.exchange.exported import Tree, loaded, rows

PAIRS = [("hunting", "towards"), ("random", "noise"), ("fleeing", "away"), ("sticking", "zero")]


def planned(name: str, **options: Any) -> Strategy:
    task = preimage.named_task(name)
    return preimage.plan(replace(task, options=replace(task.options, **options)))


PLANS: dict[str, dict[str, Any]] = {
    "peg-in-hole": {},
    "cradle": {},
    "l-room": {"method": Method.KERNEL},
    "rails": {},
    "blind-corner": {},
    "flat-floor": {"termination": Termination.FINAL_STATE},
    "two-bays": {"strategy": StrategyKind.CONDITIONAL},
    "point-onto-hill": {"strategy": StrategyKind.CONDITIONAL},
    "one-way-pit": {"or_fail": True, "strategy": StrategyKind.CONDITIONAL},
}


@pytest.fixture(params=PLANS, scope="module")
def strategy(request: pytest.FixtureRequest) -> Strategy:
    found = planned(request.param, **PLANS[request.param])
    assert found.status is preimage.Status.SOLVED
    return found


def test_a_module_answers_as_the_executor_does(strategy: Strategy, tmp_path: Path) -> None:
    module = loaded(strategy, tmp_path, "exported")
    for pair in PAIRS:
        for number in range(3):
            trace = trace_of(strategy, pair, number)
            ours, theirs = Executor(strategy), module.Executor()
            for place, (time, x, y, force) in enumerate(rows(trace)):
                if place == 0:
                    answers = ours.start(time, x, y), theirs.start(time, x, y)
                else:
                    answers = ours.read(time, x, y, force), theirs.read(time, x, y, force)
                assert answers[0].doing.name.lower() == answers[1].doing
                assert answers[0].command == answers[1].command
                assert answers[0].region == answers[1].region


def test_its_conditions_are_the_compiled_ones(strategy: Strategy, tmp_path: Path) -> None:
    module, rng = loaded(strategy, tmp_path, "exported"), Random(7)
    x0, y0, x1, y1 = strategy.space.window
    mine, theirs = Executor(strategy).program.motions, module.Executor()._motions
    assert set(mine) == set(theirs)
    for number, motion in mine.items():
        other = theirs[number]
        pairs: list[tuple[ReadingCells | None, Any]] = [(motion.possible, other.possible)]
        for told, known in ((motion.by_reading, other.by_reading), (motion.by_rest, other.by_rest)):
            assert [one.goal for one in told] == [goal for goal, _ in known]
            pairs += [(one.cells, cells) for one, (_, cells) in zip(told, known, strict=True)]
        for cells, table in pairs:
            assert (cells is None) == (table is None)
            if cells is None:
                continue
            for _ in range(400):
                x, y = rng.uniform(x0, x1), rng.uniform(y0, y1)
                force = rng.choice((None, rng.uniform(-4.0, 4.0)))
                assert cells.misses(x, y, force) == table.misses(x, y, force), (x, y, force)


def test_a_tree_moves_as_the_runs_do(strategy: Strategy, tmp_path: Path) -> None:
    module = loaded(strategy, tmp_path, "exported")
    text, ended = behaviour_tree(strategy), 0
    for pair in PAIRS:
        trace = trace_of(strategy, pair, 1)
        tree, ours = Tree(text, module), Executor(strategy)
        for place, (time, x, y, force) in enumerate(rows(trace)):
            told = tree.tick((time, x, y, force))
            answer = ours.read(time, x, y, force) if place else ours.start(time, x, y)
            assert (told is None) == (answer.command is None)
            if answer.command is None:
                assert tree.succeeded == (answer.doing is Doing.DONE)
                ended += tree.succeeded is (trace.outcome is Outcome.SUCCESS)
                break
            assert told == pytest.approx(math.degrees(answer.command), abs=1e-9)
    assert ended > 0


def test_an_altered_tree_is_found_out(tmp_path: Path) -> None:
    strategy = planned("peg-in-hole")
    text = behaviour_tree(strategy).replace('direction="0"', 'direction="90"')
    tree = Tree(text, loaded(strategy, tmp_path, "exported"))
    readings = list(rows(trace_of(strategy, PAIRS[0])))
    with pytest.raises(AssertionError):
        [tree.tick(reading) for reading in readings]


def test_a_tree_declares_its_nodes() -> None:
    from xml.etree import ElementTree

    root = ElementTree.fromstring(behaviour_tree(planned("two-bays", **PLANS["two-bays"])))
    declared = {node.get("ID") for node in root.find("TreeNodesModel") or ()}
    known = {"Sequence", "Fallback", "SubTree", "ScriptCondition", "AlwaysSuccess", "AlwaysFailure"}
    used = {node.tag for tree in root.iter("BehaviorTree") for node in tree.iter()}
    assert used - known - {"BehaviorTree"} == declared
    trees = {tree.get("ID") for tree in root.iter("BehaviorTree")}
    assert {node.get("ID") for node in root.iter("SubTree")} | {"plan"} == trees


def test_the_module_needs_nothing_and_checks_itself(tmp_path: Path) -> None:
    path = tmp_path / "plan.py"
    strategy = planned("peg-in-hole")
    export(strategy, path)
    command = [sys.executable, "-I", "-S", str(path)]
    checked = subprocess.run([*command, "--check"], capture_output=True, text=True, check=True)
    assert "answered as recorded" in checked.stdout
    readings = list(rows(trace_of(strategy, PAIRS[0])))
    lines = "".join(
        f"{time!r} {x!r} {y!r} {math.cos(f) if f is not None else 0} "
        f"{math.sin(f) if f is not None else 0}\n"
        for time, x, y, f in readings
    )
    done = subprocess.run(command, input=lines, capture_output=True, text=True, check=False)
    said = done.stdout.splitlines()
    assert said[0] == "go 0"
    assert "go 270" in said
    broken = subprocess.run(command, input="0 x\n", capture_output=True, text=True, check=False)
    assert broken.stdout.startswith("stop broken")
    assert broken.returncode == 1


def test_a_tampered_module_fails_its_check(tmp_path: Path) -> None:
    text = module_text(planned("peg-in-hole"))
    path = tmp_path / "plan.py"
    path.write_text(text.replace("'region': 2", "'region': 1"), "utf-8")
    done = subprocess.run(
        [sys.executable, "-I", "-S", str(path), "--check"], capture_output=True, check=False
    )
    assert done.returncode != 0


@given(
    st.lists(
        st.tuples(
            st.floats(-1, 20) | st.just(math.nan),
            st.floats(-12, 12) | st.sampled_from([math.nan, math.inf]),
            st.floats(-8, 12) | st.just(math.nan),
            st.none() | st.floats(-7, 7) | st.just(math.nan),
        ),
        max_size=6,
    )
)
def test_nonsense_is_refused_as_the_executor_refuses_it(
    nonsense: list[tuple[float, float, float, float | None]],
) -> None:
    ours, theirs = Executor(PEG), MODULE.Executor()
    for place, (time, x, y, force) in enumerate([(0.0, -4.0, 2.5, None), *nonsense]):
        if place == 0:
            mine, other = ours.start(time, x, y), theirs.start(time, x, y)
        else:
            mine, other = ours.read(time, x, y, force), theirs.read(time, x, y, force)
        assert (mine.doing.name.lower(), mine.command, mine.region) == (
            other.doing,
            other.command,
            other.region,
        )


@pytest.mark.parametrize("kind", list(ExportFormat))
def test_every_format_is_written(kind: ExportFormat, tmp_path: Path) -> None:
    path = tmp_path / f"plan.{kind.value}"
    export(planned("flat-floor"), path)
    assert path.stat().st_size > 100


def test_refusals(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"must end in one of \.xml, \.txt"):
        export(PEG, tmp_path / "plan.doc")
    unsolved = planned("peg-in-hole", max_steps=1)
    with pytest.raises(InputError, match="only a solved one"):
        export(unsolved, tmp_path / "plan.py")
    assert list(tmp_path.iterdir()) == []


PEG = planned("peg-in-hole")


def _module() -> ModuleType:
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as folder:
        return loaded(PEG, Path(folder), "nonsense")


MODULE = _module()
