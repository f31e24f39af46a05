"""`preimage check`, `preimage examples` and `preimage schema`: looking at tasks."""

from __future__ import annotations

import json

import click

from preimage.cli.arguments import complete_examples, load, task_argument
from preimage.cli.command import Command
from preimage.cli.output import STANDARD, about, check_outputs, say, write
from preimage.task.documents import Format
from preimage.task.examples import named_task, named_task_text, named_tasks, task_families
from preimage.task.files import format_task
from preimage.task.parameters import listed


@click.command(
    "check",
    cls=Command,
    short_help="Say what is understood of a task.",
    examples=["preimage check task.yaml", "preimage check --example peg-in-hole"],
)
@task_argument
def check_command(path: str | None, example: str | None) -> int:
    """Look whether TASK is valid, and say what is understood of it.

    Obstacles, bounds, contact features and components of free space, and for each direction what
    sticks, slides and leaves.

    Exit status: 0 if it is valid, 2 if not.
    """
    source = load(path, example)
    from preimage.configuration.obstacles import configuration_space
    from preimage.strategy.survey import survey

    with about(source.name):
        text = survey(source.task, configuration_space(source.task))
    say(text)
    if source.template.parameters:
        say(f"\nparameters: {listed(source.template.parameters)}")
    return 0


@click.command(
    "examples",
    cls=Command,
    short_help="List the named tasks, or write one out.",
    examples=[
        "preimage examples",
        "preimage examples peg-in-hole -o task.yaml",
        "preimage examples comb-12 | preimage plan -",
    ],
)
@click.argument("name", required=False, shell_complete=complete_examples)
@click.option(
    "-o", "--output", metavar="FILE", help="A task file: .yaml, .json or .toml. [default: print it]"
)
def examples_command(name: str | None, output: str | None) -> int:
    """List the named tasks, or write the one called NAME."""
    if name is None:
        say(_listed())
        return 0
    check_outputs([], output=output)
    kind = Format.YAML
    if output not in (None, STANDARD):
        assert output is not None
        with about(output):
            kind = Format.of(output)
    with about(name, {"example": "NAME"}):
        task = named_task(name)
        # as it was written, with its comments, where that can be
        plain = kind is Format.YAML and name in named_tasks()
        text = named_task_text(name) if plain else format_task(task, kind)
    write(STANDARD if output is None else output, text)
    return 0


def _listed() -> str:
    single = named_tasks()
    families = {f"{name}-N": words for name, words in task_families().items()}
    width = max(len(name) for name in (*single, *families)) + 2
    lines = [f"{name:<{width}}{words}" for name, words in single.items()]
    lines += ["", "of any size N:"]
    lines += [f"{name:<{width}}{words}" for name, words in families.items()]
    return "\n".join(lines)


@click.command(
    "schema",
    cls=Command,
    short_help="Print the JSON Schema of a file format.",
    examples=["preimage schema task -o task.schema.json", "preimage schema plan"],
)
@click.argument("kind", type=click.Choice(["task", "plan"]))
@click.option("-o", "--output", metavar="FILE", default=STANDARD, help="[default: print it]")
def schema_command(kind: str, output: str) -> int:
    """Write the JSON Schema of task files or of plan files."""
    check_outputs([], output=output)
    from preimage.strategy.plan_schema import plan_schema
    from preimage.task.schema import task_schema

    schema = task_schema() if kind == "task" else plan_schema()
    write(output, json.dumps(schema, indent=2, ensure_ascii=False) + "\n")
    return 0
