import json
from pathlib import Path

import click
import pytest

from preimage.cli.command import Command
from preimage.cli.main import COMMANDS, commands, run
from preimage.strategy.plan_schema import plan_schema
from preimage.task.examples import named_task, named_task_text, named_tasks, task_families
from preimage.task.files import load_task
from preimage.task.schema import task_schema

Capture = pytest.CaptureFixture[str]


@pytest.mark.parametrize("name", COMMANDS)
def test_help_on_every_command_has_an_example(name: str, capsys: Capture) -> None:
    assert run([name, "--help"]) == 0
    text = capsys.readouterr().out
    assert f"Usage: preimage {name}" in text
    command = commands.get_command(click.Context(commands), name)
    assert isinstance(command, Command)
    assert command.examples
    for line in command.examples:
        assert f"preimage {name}" in line
        assert line in text


def test_help_lists_the_commands(capsys: Capture) -> None:
    assert run(["--help"]) == 0
    text = capsys.readouterr().out
    assert all(f"\n  {name} " in text for name in COMMANDS)
    assert "preimage plan --example peg-in-hole" in text


def test_without_arguments_there_is_help(capsys: Capture) -> None:
    assert run([]) == 2
    assert "\n  preimage plan --example" in capsys.readouterr().err


@pytest.mark.parametrize("name", named_tasks())
def test_every_named_task_is_checked(name: str, capsys: Capture) -> None:
    assert run(["check", "--example", name]) == 0
    assert capsys.readouterr().out.startswith(f"{name}\n")


def test_named_tasks_are_listed(capsys: Capture) -> None:
    assert run(["examples"]) == 0
    text = capsys.readouterr().out
    assert all(name in text and words in text for name, words in named_tasks().items())
    assert all(f"{name}-N" in text for name in task_families())


@pytest.mark.parametrize("ending", ["yaml", "json", "toml"])
@pytest.mark.parametrize("name", ["flat-floor", "comb-3"])
def test_named_tasks_are_written_out(name: str, ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"task.{ending}"
    assert run(["examples", name, "-o", str(path)]) == 0
    assert load_task(path) == named_task(name)


def test_named_tasks_are_printed_as_they_were_written(capsys: Capture) -> None:
    assert run(["examples", "flat-floor"]) == 0
    assert capsys.readouterr().out == named_task_text("flat-floor")


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_tasks_and_plans_are_drawn(ending: str, tmp_path: Path, capsys: Capture) -> None:
    plan, picture = tmp_path / "plan.json", tmp_path / f"picture.{ending}"
    run(["plan", "--example", "flat-floor", "-o", str(plan)])
    for subject in ([str(plan)], ["--example", "flat-floor"]):
        assert run(["draw", *subject, "-o", str(picture), "--edge-numbers"]) == 0
        assert picture.stat().st_size > 1000
        picture.unlink()


def test_schemas_are_printed(capsys: Capture) -> None:
    for kind, schema in (("task", task_schema()), ("plan", plan_schema())):
        assert run(["schema", kind]) == 0
        assert json.loads(capsys.readouterr().out) == schema


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_scripts(shell: str, capsys: Capture) -> None:
    assert run(["completion", shell]) == 0
    assert f"_PREIMAGE_COMPLETE={shell}_complete" in capsys.readouterr().out
