"""`preimage export`."""

from __future__ import annotations

import click

from preimage.cli.arguments import document
from preimage.cli.command import Command
from preimage.cli.output import RefusalError, about, check_outputs, reason, say


@click.command(
    "export",
    cls=Command,
    short_help="Write a plan for another program, or for people.",
    examples=[
        "preimage export plan.json -o plan.py",
        "preimage export plan.json -o plan.xml",
        "preimage export plan.json -o card.txt",
    ],
)
@click.argument("path", metavar="PLAN", type=click.Path())
@click.option(
    "-o",
    "--output",
    required=True,
    metavar="FILE",
    help="By its ending: .py, a module that carries the plan out and needs nothing else; .xml, a "
    "tree for BehaviorTree.CPP 4; .txt, a card of decisions; .svg, .png, .pdf, a picture; .gif, "
    ".html, a film of a run.",
)
def export_command(path: str, output: str) -> int:
    """Write PLAN as another program's file.

    Exit status: 0 written, 2 bad input.
    """
    check_outputs([path], output=output)
    data, name = document(path)
    from preimage.exchange.export import ExportFormat, export
    from preimage.strategy.plan_parse import parse_plan

    with about(output):
        kind = ExportFormat.of(output)
    with about(name):
        strategy = parse_plan(data)
        try:
            export(strategy, output, kind)
        except OSError as error:
            raise RefusalError(f"{output}: cannot be written: {reason(error)}") from None
    say(f"written: {output}")
    return 0
