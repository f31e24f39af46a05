"""`preimage plan`."""

from __future__ import annotations

import click

from preimage.cli.arguments import load, overridden, planner_options, task_argument
from preimage.cli.command import Command
from preimage.cli.output import STANDARD, about, check_outputs, note, picture, say, write
from preimage.cli.progress import Interruption, ProgressLine


@click.command(
    "plan",
    cls=Command,
    short_help="Find a guaranteed plan for a task.",
    examples=[
        "preimage plan task.yaml",
        "preimage plan task.yaml --method kernel --directions 8 -o plan.json --figure plan.svg",
        "preimage plan --example peg-in-hole --directions 0,90,225,270 --time-limit 10",
    ],
)
@task_argument
@planner_options
@click.option("-o", "--output", metavar="FILE", help="The plan file (JSON); - for standard output.")
@click.option("--figure", metavar="FILE", help="A picture: .svg, .png or .pdf.")
def plan_command(
    path: str | None,
    example: str | None,
    output: str | None,
    figure: str | None,
    **options: object,
) -> int:
    """Find a plan for TASK that surely ends in the goal, and knows that it did.

    TASK is a file in YAML, JSON or TOML, or - for YAML on standard input. Options override the
    keys of `planner` in it. Interrupted (Ctrl-C) or out of time, what was found so far is written
    as `stopped`.

    Exit status: 0 solved, 1 not solved, 2 bad input.
    """
    tell = note if output == STANDARD else say
    with ProgressLine() as line:
        with Interruption() as interrupted:
            check_outputs([path], output=output, figure=figure)
            source = overridden(load(path, example), options)
            from preimage.search.planner import plan
            from preimage.strategy.describe import describe
            from preimage.strategy.plan_file import format_plan
            from preimage.strategy.strategy import Status

            with about(source.name):
                strategy = plan(source.task, progress=line.show, cancelled=interrupted)
            if output is not None:
                write(output, format_plan(strategy))
        line.clear()
        tell(describe(strategy))
        if figure is not None:
            line.say("drawing")
            picture(strategy, figure)
    written = [name for name in (output, figure) if name not in (None, STANDARD)]
    if written:
        tell(f"written: {', '.join(map(str, written))}")
    return 0 if strategy.status is Status.SOLVED else 1
