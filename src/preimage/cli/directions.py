"""`preimage directions`."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from typing import Any

import click

from preimage.cli.arguments import Source, load, method_option, overridden, task_argument
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
from preimage.cli.progress import ProgressLine
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, start_region
from preimage.errors import shown
from preimage.geometry.angles import TAU
from preimage.preimages.setting import Setting
from preimage.search.compass import Compass, Rose, free_point, grid_points, rose
from preimage.search.directions import Arc, Verdict
from preimage.strategy.words import degrees, number, place
from preimage.task.degrees import to_degrees
from preimage.task.options import Termination
from preimage.task.task import InitialPoint

MOST_ROSES = 10_000
"""Roses of a grid."""


@click.command(
    "directions",
    cls=Command,
    short_help="In which directions does one motion solve the task?",
    examples=[
        "preimage directions task.yaml --figure rose.svg",
        "preimage directions --example peg-in-hole --from -4,2.5 --from 0,-2 --resolution 0.01",
        "preimage directions --example peg-in-hole --roses 12x10 --figure roses.svg -o roses.json",
    ],
)
@task_argument
@click.option(
    "--resolution", metavar="DEGREES", help="To which directions are told apart; else the task's."
)
@method_option
@click.option(
    "--from", "places", multiple=True, metavar="X,Y", help="A start instead of the task's; several."
)
@click.option("--roses", metavar="NxM", help="Besides, starts on a grid in the window.")
@click.option("-o", "--output", metavar="FILE", help="The arcs as JSON; - for standard output.")
@click.option("--figure", metavar="FILE", help="A picture: .svg, .png or .pdf.")
def directions_command(
    path: str | None,
    example: str | None,
    resolution: str | None,
    method: str | None,
    places: tuple[str, ...],
    roses: str | None,
    output: str | None,
    figure: str | None,
) -> int:
    """All directions in which a single motion surely ends in the goal, and knows it.

    The full turn is cut into arcs: all of its directions solve, or none does, or it is too narrow
    to be proven at this resolution. The margin is how far a direction may be off.

    Exit status: 0 if some direction solves, 1 if none is known to, 2 bad input.
    """
    check_outputs([path], output=output, figure=figure)
    source = overridden(load(path, example), {"method": method, "resolution": resolution})
    grid = _grid(roses)
    with ProgressLine() as line:
        with about(source.name):
            setting = Setting.of(source.task)
            goal = goal_region(source.task, setting.space)
        starts = _starts(source, setting, places)
        line.say("looking at directions")
        found = [_rose(source, setting, goal, start) for start in starts]
        points = grid_points(setting.space, *grid) if grid is not None else ()
        scattered = []
        for index, point in enumerate(points):
            scattered.append(_rose(source, setting, goal, free_point(point)))
            line.say(f"{index + 1} of {len(points)} roses")
        line.clear()
        compass = Compass(source.task, setting.space, tuple(found), tuple(scattered))
        talk = note if output == STANDARD else say
        if output is not None:
            write(output, _json(source, compass))
        talk("\n".join(_table(source, compass, bool(places))))
        if figure is not None:
            line.say("drawing")
            picture(compass, figure)
    written = [name for name in (output, figure) if name not in (None, STANDARD)]
    if written:
        talk(f"written: {', '.join(map(str, written))}")
    return 0 if any(one.solving for one in found) else 1


def _rose(source: Source, setting: Setting, goal: Region, start: Start) -> Rose:
    options = source.task.options
    return rose(setting, [goal], start, options.method, options.resolution)


def _starts(source: Source, setting: Setting, places: tuple[str, ...]) -> list[Start]:
    """The task's start, or the points given instead."""
    if not places:
        with about(source.name):
            return [start_region(source.task, setting.space)]
    starts = []
    for text in places:
        point = _numbers(text, r"[,\s]+", "--from", "two numbers, as in 1,2.5")
        with about("--from", {"initial.point": "--from"}):
            task = replace(source.task, initial=InitialPoint(point))
            starts.append(start_region(task, setting.space))
    return starts


def _grid(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    columns, rows = _numbers(text, "[x×]", "--roses", "two whole numbers, as in 12x8")
    whole = columns.is_integer() and rows.is_integer()
    if not whole or min(columns, rows) < 1 or columns * rows > MOST_ROSES:
        rule = f"must be two whole numbers above 0, {MOST_ROSES} roses at most"
        raise RefusalError(f"--roses: {rule}, not {shown(text)}")
    return int(columns), int(rows)


def _numbers(text: str, between: str, option: str, rule: str) -> tuple[float, float]:
    try:
        first, second = (float(part) for part in re.split(between, text.strip()))
    except ValueError:
        raise RefusalError(f"{option}: must be {rule}, not {shown(text)}") from None
    return first, second


# --- what is said ---------------------------------------------------------------------------


def _table(source: Source, compass: Compass, named: bool) -> list[str]:
    options = source.task.options
    lines = [
        f"{source.task.name}: one motion, {options.method.value} method,"
        f" to {degrees(options.resolution)}"
    ]
    if options.termination is not Termination.INSTANTANEOUS:
        lines[0] += f", instantaneous conditions, not the task's {options.termination.value} ones"
    for one in compass.roses:
        lines.append(f"from {place(one.point)}" if named else "from the start")
        if not one.solving:
            lines.append("  no direction is known to solve")
        lines += [f"  {_row(arc)}" for arc in one.arcs]
    if compass.grid:
        some = sum(bool(one.solving) for one in compass.grid)
        lines.append(f"some direction solves from {some} of {len(compass.grid)} starts of the grid")
    return lines


def _row(arc: Arc) -> str:
    if arc.high - arc.low >= TAU:
        words = "every direction"
    else:
        words = f"{_angle(arc.low):>10} to {_angle(arc.high):>10}"
    line = f"{words}  {arc.verdict.value}"
    if arc.verdict is Verdict.SOLVES:
        line += f", {_angle(arc.widest)} by a margin of {number(to_degrees(arc.margin))}°"
    return line


def _angle(radians: float) -> str:
    return f"{to_degrees(radians) % 360.0:.3f}°"


def _json(source: Source, compass: Compass) -> str:
    options = source.task.options
    data: dict[str, Any] = {
        "task": source.task.name,
        "method": options.method.value,
        "resolution": to_degrees(options.resolution),
        "roses": [_data(one) for one in compass.roses],
        "grid": [_data(one) for one in compass.grid],
    }
    return json.dumps(data, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def _data(one: Rose) -> dict[str, Any]:
    return {
        "from": list(one.point),
        "arcs": [
            {
                "low": to_degrees(arc.low),
                "high": to_degrees(arc.high),
                "verdict": arc.verdict.value,
                "widest": to_degrees(arc.widest),
                "margin": to_degrees(arc.margin),
            }
            for arc in one.arcs
        ],
    }
