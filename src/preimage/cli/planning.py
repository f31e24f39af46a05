"""`preimage plan`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from preimage.cli.arguments import load, overridden, planner_options, task_argument
from preimage.cli.command import Command
from preimage.cli.output import STANDARD, about, check_outputs, note, picture, say, write
from preimage.cli.progress import Interruption, ProgressLine

if TYPE_CHECKING:
    from preimage.strategy.strategy import Strategy

MOST = 20_000
"""Edges of contact space times motions: with more, margins are left out."""


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
@click.option(
    "--no-margins", is_flag=True, help="Leave out how far starts, sensors and drives may be off."
)
@click.option("-o", "--output", metavar="FILE", help="The plan file (JSON); - for standard output.")
@click.option("--figure", metavar="FILE", help="A picture: .svg, .png or .pdf.")
def plan_command(
    path: str | None,
    example: str | None,
    no_margins: bool,
    output: str | None,
    figure: str | None,
    **options: object,
) -> int:
    """Find a plan for TASK that surely ends in the goal, and knows that it did.

    TASK is a file in YAML, JSON or TOML, or - for YAML on standard input. Options override the
    keys of `planner` in it. Interrupted (Ctrl-C) or out of time, what was found so far is written
    as `stopped`.

    Of a plan that is found its margins are told: how much further off the start, the sensors and
    all directions may be.

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
            if not no_margins:
                line.say("margins")
                strategy = _measured(strategy, interrupted)
            if output is not None:
                write(output, format_plan(strategy))
        line.clear()
        tell(describe(strategy))
        if not no_margins and _takes_long(strategy):
            tell("margins: left out, since in a scene as large as this they take long")
        if figure is not None:
            line.say("drawing")
            picture(strategy, figure)
    written = [name for name in (output, figure) if name not in (None, STANDARD)]
    if written:
        tell(f"written: {', '.join(map(str, written))}")
    return 0 if strategy.status is Status.SOLVED else 1


def _measured(strategy: Strategy, interrupted: Interruption) -> Strategy:
    """The strategy with its margins, unless it has them or they would take long."""
    from preimage.search.limits import Limits
    from preimage.search.margins import margins

    if strategy.margins is not None or _takes_long(strategy):
        return strategy
    options = strategy.task.options
    return margins(strategy, Limits(options.time_limit, options.max_regions, interrupted))


def _takes_long(strategy: Strategy) -> bool:
    """Whether the margins of a plan would take long: some forty times its preimages."""
    motions = sum(region.motion is not None for region in strategy.regions)
    large = len(strategy.space.contact.edges) * motions > MOST
    return bool(strategy.start) and strategy.margins is None and large
