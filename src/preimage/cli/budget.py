"""`preimage budget`."""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from preimage.cli.arguments import (
    Source,
    load,
    overridden,
    planner_options_without,
    task_argument,
)
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
from preimage.cli.workforce import workforce, workforce_options

CELLS = ".cells"
"""After the name of the output: where the cells are kept until it is written."""


@dataclass(frozen=True, slots=True)
class Questions:
    """What is asked, as parsed from the command line."""

    bounds: tuple[str, ...]
    axes: tuple[str, str] | None
    places: tuple[int, int]
    ranges: dict[str, tuple[float, float]]
    steps: dict[str, float]
    point: dict[str, float]


@click.command(
    "budget",
    cls=Command,
    short_help="How large the errors may be.",
    examples=[
        "preimage budget --example peg-in-hole",
        "preimage budget task.yaml --bounds control,position --figure budget.png",
        "preimage budget task.yaml --map control,position --resolution 40x40 -o map.json",
        "preimage budget task.yaml --at control=6,position=0.2 --plan plan.json",
    ],
)
@task_argument
@planner_options_without("resolution", "or_fail")
@click.option(
    "--bounds",
    metavar="NAMES",
    help="Of control, position, force, threshold, friction, and the task's parameters; all by "
    "default.",
)
@click.option("--map", "axes", metavar="X,Y", help="Two of them: a map instead of a table.")
@click.option(
    "--resolution", metavar="NxM", help="Of a map: how many values of X and of Y; 40x40 by default."
)
@click.option(
    "--range",
    "ranges",
    multiple=True,
    metavar="NAME=LOW:HIGH",
    help="The values of a bound that are looked at, as the task file has them.",
)
@click.option(
    "--step",
    "steps",
    multiple=True,
    metavar="NAME=VALUE",
    help="To what a bound is found; a hundredth of what is given by default.",
)
@click.option("--at", "point", metavar="NAME=VALUE,…", help="The values that --plan is for.")
@click.option("--plan", "plan_file", metavar="FILE", help="Write the plan with the values of --at.")
@click.option(
    "--store",
    metavar="FILE",
    help="Keep every finished cell here, and go on from there; FILE.cells of the output by "
    "default, until it is written.",
)
@workforce_options
@click.option("-o", "--output", metavar="FILE", help="The result (JSON); - for standard output.")
@click.option("--figure", metavar="FILE", help="A picture: .svg, .png or .pdf.")
def budget_command(
    path: str | None,
    example: str | None,
    bounds: str | None,
    axes: str | None,
    resolution: str | None,
    ranges: tuple[str, ...],
    steps: tuple[str, ...],
    point: str | None,
    plan_file: str | None,
    store: str | None,
    workers: int | None,
    scheduler: str | None,
    output: str | None,
    figure: str | None,
    **options: Any,
) -> int:
    """Say for each error bound of TASK how large it may be, the others being as given.

    Each bound is varied alone, and the limit found by bisection, with the motion and the feature
    that bind it. With --map two bounds are varied together. What is finished is kept in a store at
    once: the same command goes on after it was stopped, however it was.

    Exit status: 0 done, 1 interrupted, 2 bad input.
    """
    tell = note if output == STANDARD else say
    questions = _questions(bounds, axes, resolution, ranges, steps, point)
    if (point is None) != (plan_file is None):
        raise RefusalError("--at and --plan go together: the values, and the file of their plan")
    check_outputs([path], output=output, figure=figure, plan=plan_file, store=store)
    source = overridden(load(path, example), options)
    kept = store or (f"{output}{CELLS}" if _is_file(output) else None)
    with ProgressLine() as line, Interruption() as interrupted:
        found = _surveyed(source, questions, kept, workers, scheduler, line, interrupted, options)
        line.clear()
        if found is None:
            where = f": what is finished is in {kept}" if kept else ""
            note(f"preimage: interrupted{where}")
            return 1
        result, words, text = found
        if output is not None:
            write(output, text)
        tell(words)
        if plan_file is not None:
            _write_plan(source, questions, plan_file, tell)
        if figure is not None:
            line.say("drawing")
            picture(result, figure)
            line.clear()
    if kept and not store:
        Path(kept).unlink(missing_ok=True)
    written = [name for name in (output, figure) if name not in (None, STANDARD)]
    if written:
        tell(f"written: {', '.join(map(str, written))}")
    return 0


def _surveyed(
    source: Source,
    questions: Questions,
    kept: str | None,
    workers: int | None,
    scheduler: str | None,
    line: ProgressLine,
    interrupted: Interruption,
    options: dict[str, Any],
) -> tuple[object, str, str] | None:
    """The budget or the map, in words, and as a file; None if somebody wanted no more."""
    from preimage.analysis.budget import budget
    from preimage.analysis.budget_file import format_budget, format_map
    from preimage.analysis.describe import describe_budget, describe_map
    from preimage.analysis.map import error_map
    from preimage.analysis.survey import CancelledError, Survey
    from preimage.task.options import Method

    with about(source.name), contextlib.ExitStack() as stack:
        crew = stack.enter_context(workforce(workers, scheduler))
        survey = Survey.of(
            source.template,
            workforce=crew,
            store=kept,
            options=source.task.options,
            progress=line.cells,
            cancelled=interrupted,
        )
        stack.callback(survey.close)
        try:
            if questions.axes is None:
                table = budget(
                    survey,
                    questions.bounds or None,
                    ranges=questions.ranges,
                    resolutions=questions.steps,
                )
                return table, describe_budget(table), format_budget(table)
            chosen = (source.task.options.method,) if options.get("method") else tuple(Method)
            charted = error_map(
                survey,
                *questions.axes,
                places=questions.places,
                ranges=questions.ranges,
                methods=chosen,
            )
            return charted, describe_map(charted), format_map(charted)
        except CancelledError:
            return None


def _write_plan(source: Source, questions: Questions, path: str, tell: Any) -> None:
    """The plan of one cell, whatever came of it."""
    from preimage.analysis.axis import axis_of
    from preimage.analysis.cell import Cell, planned
    from preimage.strategy.describe import describe
    from preimage.strategy.plan_file import format_plan

    with about(source.name):
        keys = {
            axis_of(source.template, name).key: value for name, value in questions.point.items()
        }
        options = source.task.options
        strategy = planned(source.template, options, Cell.at(options.method, **keys))
    write(path, format_plan(strategy))
    tell(describe(strategy))
    tell(f"written: {path}")


def _is_file(output: str | None) -> bool:
    return output not in (None, STANDARD) and not Path(str(output)).is_fifo()


# --- what is asked --------------------------------------------------------------------------


def _questions(
    bounds: str | None,
    axes: str | None,
    resolution: str | None,
    ranges: tuple[str, ...],
    steps: tuple[str, ...],
    point: str | None,
) -> Questions:
    if bounds is not None and axes is not None:
        raise RefusalError("--bounds and --map: a table or a map, one of the two")
    if resolution is not None and axes is None:
        raise RefusalError("--resolution: is that of a map; a table's is --step NAME=VALUE")
    if steps and axes is not None:
        raise RefusalError("--step: is that of a table; a map's is --resolution NxM")
    names = _names(bounds)
    if bounds is not None and not names:
        raise RefusalError("--bounds: names none")
    pair = _names(axes)
    if axes is not None and len(pair) != 2:
        raise RefusalError(f"--map: must be two bounds, as in control,position, not {axes!r}")
    return Questions(
        bounds=names,
        axes=(pair[0], pair[1]) if axes is not None else None,
        places=_places(resolution),
        ranges=dict(_range(text) for text in ranges),
        steps=dict(_value(text, "--step") for text in steps),
        point=dict(_value(text, "--at") for text in _names(point)),
    )


def _names(text: str | None) -> tuple[str, ...]:
    return tuple(part.strip() for part in (text or "").split(",") if part.strip())


def _places(text: str | None) -> tuple[int, int]:
    from preimage.analysis.map import PLACES

    if text is None:
        return PLACES
    found = re.fullmatch(r"\s*(\d{1,6})\s*[x×,]\s*(\d{1,6})\s*", text)
    if found is None:
        raise RefusalError(f"--resolution: must be as in 40x40, not {text!r}")
    return int(found[1]), int(found[2])


def _range(text: str) -> tuple[str, tuple[float, float]]:
    name, _, ends = text.partition("=")
    low, colon, high = ends.partition(":")
    if not name.strip() or not colon:
        raise RefusalError(f"--range: must be as in control=0:30, not {text!r}")
    return name.strip(), (_float(low, "--range", text), _float(high, "--range", text))


def _value(text: str, option: str) -> tuple[str, float]:
    name, equals, value = text.partition("=")
    if not name.strip() or not equals:
        raise RefusalError(f"{option}: must be as in control=0.5, not {text!r}")
    return name.strip(), _float(value, option, text)


def _float(value: str, option: str, text: str) -> float:
    try:
        return float(value)
    except ValueError:
        raise RefusalError(f"{option}: {value!r} is no number in {text!r}") from None
