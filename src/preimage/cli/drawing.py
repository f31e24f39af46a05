"""`preimage draw`."""

from __future__ import annotations

from collections.abc import Mapping

import click

from preimage.cli.arguments import document, load, posed, settings, stem, task_argument
from preimage.cli.command import Command
from preimage.cli.output import RefusalError, about, check_outputs, picture, say


@click.command(
    "draw",
    cls=Command,
    short_help="Draw a task or a plan.",
    examples=[
        "preimage draw task.yaml -o scene.svg",
        "preimage draw plan.json -o plan.pdf",
        "preimage draw plan.json -o graph.svg --as graph",
        "preimage draw --example peg-in-hole -o scene.png --edge-numbers",
    ],
)
@task_argument
@click.option("-o", "--output", metavar="FILE", required=True, help="A picture: .svg, .png, .pdf.")
@click.option(
    "--as", "kind", type=click.Choice(["graph", "panels"]), default="panels",
    help="A plan as a panel for each motion, or as a graph.", show_default=True,
)  # fmt: skip
@click.option("--columns", type=int, metavar="N", help="Panels beside each other.")
@click.option("--edge-numbers", is_flag=True, help="Number the contact edges.")
@click.option("--friction-cones", is_flag=True, help="Draw friction cones.")
def draw_command(
    path: str | None, example: str | None, output: str, kind: str, **options: int | bool | None
) -> int:
    """Draw TASK, or a plan: a panel for each motion, or a graph of its regions.

    The file is a task or, as written by `preimage plan -o`, a plan.
    """
    check_outputs([path], figure=output)
    picture(_subject(path, example), output, graph=kind == "graph", **options)
    say(f"written: {output}")
    return 0


def _subject(path: str | None, example: str | None) -> object:
    """A strategy or a task."""
    if path is None or example is not None:
        return load(path, example).task
    data, name = document(path)
    if not isinstance(data, Mapping) or not ("regions" in data or "status" in data):
        return posed(data, name, named=stem(path)).task
    if settings():
        raise RefusalError(f"{name}: is a plan, whose task has no parameters for --set")
    from preimage.strategy.plan_parse import parse_plan

    with about(name):
        return parse_plan(data)
