"""`preimage verify`."""

from __future__ import annotations

import click

from preimage.cli.arguments import document
from preimage.cli.command import Command
from preimage.cli.output import about, check_outputs, picture, say
from preimage.cli.progress import ProgressLine

MOST_RUNS = 1_000_000

RUNS = 10
"""Runs from each region under each pair of adversaries, unless said otherwise."""


@click.command(
    "verify",
    cls=Command,
    short_help="Prove a plan, or show how it fails.",
    examples=[
        "preimage verify plan.json",
        "preimage verify plan.json --runs 100 --maximality --figure verdict.svg",
    ],
)
@click.argument("path", metavar="PLAN", type=click.Path())
@click.option(
    "--runs",
    type=click.IntRange(0, MOST_RUNS),
    default=RUNS,
    show_default=True,
    metavar="N",
    help="Simulated runs besides, from each region under each pair of adversaries; 0 for none.",
)
@click.option(
    "--seed", type=click.IntRange(0, 2**63 - 1), default=0, metavar="S", help="Of the runs."
)
@click.option(
    "--maximality", is_flag=True, help="Compare each region with the largest possible one."
)
@click.option(
    "--figure",
    metavar="FILE",
    help="A picture of how it fails, or of the plan: .svg, .png or .pdf.",
)
def verify_command(path: str, runs: int, seed: int, maximality: bool, figure: str | None) -> int:
    """Check that PLAN, whoever made it, ends in the goal and knows it, whatever nature does.

    Every motion is proven, by reachability and reading sets that share no code with the planner,
    or a counter-example is shown: a trajectory that nature may choose.

    Exit status: 0 proven, 1 not proven, 2 bad input.
    """
    with ProgressLine() as line:
        check_outputs([path], figure=figure)
        data, name = document(path)
        from preimage.strategy.plan_parse import parse_plan
        from preimage.verification.describe import describe_verification
        from preimage.verification.verdict import Verdict
        from preimage.verification.verify import verify

        with about(name):
            strategy = parse_plan(data)
            found = verify(strategy, runs=runs, seed=seed, maximality=maximality, progress=line.say)
        line.clear()
        say(describe_verification(found))
        if figure is not None:
            line.say("drawing")
            picture(found.counterexample or strategy, figure)
    if figure is not None:
        say(f"written: {figure}")
    return 0 if found.verdict is Verdict.PROVEN else 1
