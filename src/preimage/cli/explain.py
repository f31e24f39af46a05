"""`preimage explain`."""

from __future__ import annotations

import contextlib
from typing import Any

import click

from preimage.cli.arguments import load, overridden, planner_options, task_argument
from preimage.cli.command import Command
from preimage.cli.output import RefusalError, about, check_outputs, note, picture, reason, say
from preimage.cli.progress import Interruption, ProgressLine
from preimage.cli.workforce import workforce, workforce_options


@click.command(
    "explain",
    cls=Command,
    short_help="Why there is no plan, or no shorter one.",
    examples=[
        "preimage explain task.yaml",
        "preimage explain --example connector --figure why.png --animate nature.gif",
        "preimage explain task.yaml --bounds position,force",
    ],
)
@task_argument
@planner_options
@click.option(
    "--bounds",
    metavar="NAMES",
    help="The bounds that might be better: control, position, …; all by default.",
)
@click.option("--no-budget", is_flag=True, help="Do not look for what would have to be better.")
@workforce_options
@click.option("--figure", metavar="FILE", help="A picture: .svg, .png or .pdf.")
@click.option("--animate", metavar="FILE", help="A film of what nature does: .gif, .mp4 or .html.")
def explain_command(
    path: str | None,
    example: str | None,
    bounds: str | None,
    no_budget: bool,
    workers: int | None,
    scheduler: str | None,
    figure: str | None,
    animate: str | None,
    **options: Any,
) -> int:
    """Say why there is no plan for TASK, or why the one found takes that many motions.

    What of the start remains, which feature traps or is confused with which, by which side the
    robot may escape, what nature does to the most promising motion, and which single bound would
    have to be better.

    Exit status: 0 explained, 1 interrupted, 2 bad input.
    """
    names = tuple(name.strip() for name in (bounds or "").split(",") if name.strip())
    if bounds is not None and (not names or no_budget):
        raise RefusalError("--bounds: names none" if not names else "--bounds: but --no-budget")
    check_outputs([path], figure=figure, animate=animate)
    source = overridden(load(path, example), options)
    from preimage.analysis.explanation import explain
    from preimage.analysis.explanation_words import describe_explanation
    from preimage.analysis.survey import CancelledError, Survey

    with ProgressLine() as line:
        with Interruption() as interrupted, about(source.name), contextlib.ExitStack() as stack:
            crew = stack.enter_context(workforce(workers, scheduler))
            survey = Survey.of(
                source.template,
                workforce=crew,
                options=source.task.options,
                progress=line.cells,
                cancelled=interrupted,
            )
            stack.callback(survey.close)
            try:
                found = explain(survey, names or None, budgeted=not no_budget)
            except CancelledError:
                note("preimage: interrupted")
                return 1
        line.clear()
        say(describe_explanation(found))
        if figure is not None:
            line.say("drawing")
            picture(found, figure)
        trace = found.counter.trace if found.counter is not None else None
        if animate is not None and trace is not None:
            from preimage.rendering import animate as film

            line.say("filming")
            with about(animate):
                try:
                    film(trace, animate)
                except OSError as error:
                    raise RefusalError(f"{animate}: cannot be written: {reason(error)}") from None
    if animate is not None and trace is None:
        say(f"not written: {animate}: no motion of nature's is known here")
    written = [name for name in (figure, animate if trace is not None else None) if name]
    if written:
        say(f"written: {', '.join(written)}")
    return 0
