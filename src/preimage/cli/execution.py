"""`preimage run`."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from preimage.cli.arguments import document
from preimage.cli.command import Command
from preimage.cli.output import (
    STANDARD,
    RefusalError,
    about,
    check_outputs,
    note,
    picture,
    say,
    write,
)
from preimage.cli.progress import Interruption, ProgressLine
from preimage.errors import one_line

if TYPE_CHECKING:
    from preimage.execution.trace import Trace
    from preimage.strategy.strategy import Strategy

RUNS = 100
"""Runs under each pair of adversaries, unless said otherwise."""

MOST_RUNS = 10_000_000


@click.command(
    "run",
    cls=Command,
    short_help="Carry a plan out in simulation, against adversaries.",
    examples=[
        "preimage run plan.json",
        "preimage run plan.json --adversary hunting+towards --runs 1000 --figure runs.png",
        "preimage run plan.json --from 1.5,4 --runs 10 -o trace.json --animate run.gif",
        "preimage run plan.json --adversary mine.py:swinging",
    ],
)
@click.argument("path", metavar="PLAN", type=click.Path())
@click.option(
    "--adversary",
    "names",
    metavar="NAME",
    multiple=True,
    help="One for control, one for sensing, or both as CONTROL+SENSING; FILE.py:FUNCTION for one"
    " of your own; `all` (default). May be repeated. See --adversaries.",
)
@click.option(
    "--adversaries",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=lambda context, _, wanted: _list_adversaries(context) if wanted else None,
    help="List the adversaries.",
)
@click.option(
    "--runs",
    type=click.IntRange(1, MOST_RUNS),
    default=RUNS,
    show_default=True,
    metavar="N",
    help="Runs under each pair of adversaries.",
)
@click.option(
    "--seed", type=click.IntRange(0, 2**63 - 1), default=0, metavar="S", help="Of chance."
)
@click.option("--from", "place", metavar="X,Y", help="Where runs begin; the task's start if not.")
@click.option("--parallel", is_flag=True, help="Use all cores.")
@click.option("-o", "--output", metavar="FILE", help="Counts and traces (JSON); - for stdout.")
@click.option("--figure", metavar="FILE", help="A picture of the runs: .svg, .png or .pdf.")
@click.option("--animate", metavar="FILE", help="A film of one run: .gif, .mp4 or .html.")
def run_command(
    path: str,
    names: tuple[str, ...],
    runs: int,
    seed: int,
    place: str | None,
    parallel: bool,
    output: str | None,
    figure: str | None,
    animate: str | None,
) -> int:
    """Carry PLAN out in simulation, whatever nature may do within the bounds.

    The first run that fails is kept whole, printed and drawn; if none does, the picture shows some
    of each pair of adversaries, and the film the run that took longest.

    Exit status: 0 all runs succeeded, or ended knowing that they failed where the plan says so; 1
    some failed or were not made; 2 bad input.
    """
    tell = note if output == STANDARD else say
    with ProgressLine() as line:
        with Interruption() as interrupted:
            check_outputs([path], output=output, figure=figure, animate=animate)
            strategy = _plan(path)
            controls, sensings = _adversaries(names)
            from preimage.execution.describe import describe_report
            from preimage.execution.runs import RunOptions, run
            from preimage.execution.trace_file import format_report

            with about(path):
                report = run(
                    strategy,
                    control=controls,
                    sensing=sensings,
                    start=_start(strategy, place),
                    options=RunOptions(runs, seed, _workers(names, parallel)),
                    progress=line.runs,
                    cancelled=interrupted,
                )
        line.clear()
        tell(describe_report(report))
        pairs = len(controls) * len(sensings)
        stopped = len(report.tallies) < pairs
        if stopped:
            tell(f"interrupted: {len(report.tallies)} of {pairs} pairs of adversaries were run")
        if output is not None:
            write(output, format_report(report))
        if figure is not None:
            line.say("drawing")
            picture(report, figure)
        shown = report.failure or report.slowest
        if animate is not None and shown is not None:
            line.say("filming")
            _film(shown, animate)
    written = [name for name in (output, figure, animate) if name not in (None, STANDARD)]
    if written:
        tell(f"written: {', '.join(map(str, written))}")
    return 1 if report.failures or stopped else 0


def _plan(path: str) -> Strategy:
    """The plan of a file, which must be solved."""
    data, name = document(path)
    from preimage.strategy.plan_parse import parse_plan
    from preimage.strategy.strategy import Status

    with about(name):
        strategy = parse_plan(data)
    if strategy.status is not Status.SOLVED:
        raise RefusalError(f"{name}: status: is {strategy.status.value}: there is nothing to run")
    return strategy


def _adversaries(names: tuple[str, ...]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The adversaries for control and for sensing that were asked for; all where none was."""
    from preimage.execution.control import CONTROLS
    from preimage.execution.sensing import SENSINGS

    controls: dict[str, Any] = {}
    sensings: dict[str, Any] = {}
    for text in names:
        for name in [text] if ".py:" in text else text.split("+"):
            if ".py:" in name:
                controls[name] = _own(name)
            elif name == "all":
                controls.update(CONTROLS)
                sensings.update(SENSINGS)
            elif name in CONTROLS:
                controls[name] = CONTROLS[name]
            elif name in SENSINGS:
                sensings[name] = SENSINGS[name]
            else:
                choices = ", ".join([*CONTROLS, *SENSINGS, "all"])
                raise RefusalError(f"--adversary: is {name!r}, must be one of {choices}")
    return controls or dict(CONTROLS), sensings or dict(SENSINGS)


def _workers(names: tuple[str, ...], parallel: bool) -> int:
    """How many processes make the runs; a function from a file is known to this one alone."""
    own = any(".py:" in name for name in names)
    return (os.cpu_count() or 1) if parallel and not own else 1


def _own(name: str) -> object:
    """An adversary for control from a file of the user's."""
    path, _, function = name.rpartition(":")
    spec = importlib.util.spec_from_file_location(Path(path).stem, path)
    if spec is None or spec.loader is None or not Path(path).is_file():
        raise RefusalError(f"--adversary: {path}: there is no such file")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        words = one_line(f"{type(error).__name__}: {error}")
        raise RefusalError(f"--adversary: {path}: {words}") from None
    found = getattr(module, function, None)
    if not callable(found):
        raise RefusalError(f"--adversary: {path}: has no function {function!r}")

    def choose(now: object) -> object:
        try:
            return found(now)
        except Exception as error:
            words = one_line(f"{type(error).__name__}: {error}")
            raise RefusalError(f"--adversary: {name}: {words}") from None

    return choose


def _start(strategy: Strategy, place: str | None) -> Any:
    """Where runs begin."""
    if place is None:
        return None
    from dataclasses import replace

    from preimage.configuration.start import covered, start_region
    from preimage.strategy.words import joined
    from preimage.task.initial import InitialPoint

    parts = place.split(",")
    try:
        x, y = (float(part) for part in parts)
    except ValueError:
        raise RefusalError(f"--from: is {place!r}, must be two numbers such as 1.5,4") from None
    with about("", {"initial.point": "--from"}):
        task = replace(strategy.task, initial=InitialPoint((x, y)))
        start = start_region(task, strategy.space)
    regions = [strategy.region(number) for number in strategy.start]
    if not any(covered(start, region.region, strategy.space) for region in regions):
        names = joined([f"region {region.id}" for region in regions], "or")
        note(f"({x:.6g}, {y:.6g}) is not in {names}: from there nothing is guaranteed")
    return start


def _film(trace: Trace, path: str) -> None:
    from preimage.rendering.animation import animate

    with about(path):
        try:
            animate(trace, path)
        except OSError as error:
            raise RefusalError(f"{path}: cannot be written: {error.strerror}") from None


def _list_adversaries(context: click.Context) -> None:
    from preimage.execution.control import CONTROLS
    from preimage.execution.sensing import SENSINGS

    tables: Mapping[str, Mapping[str, object]] = {"control": CONTROLS, "sensing": SENSINGS}
    for what, table in tables.items():
        say(f"{what}: {', '.join(table)}")
    context.exit(0)
