"""A page that plays a run by itself: a canvas, a few lines of script, and the run as data."""

from __future__ import annotations

import html
import json
from importlib.resources import files
from typing import Any

from preimage.configuration.region import Region
from preimage.execution.trace import Trace
from preimage.geometry.area import Area
from preimage.rendering.film import FilmOptions, Frame
from preimage.rendering.style import (
    BLUE,
    C_OBSTACLE_GREY,
    GREEN,
    INK,
    ORANGE,
    VERMILLION,
)
from preimage.task.degrees import to_degrees

Data = dict[str, Any]


def page(trace: Trace, frames: list[Frame], options: FilmOptions) -> str:
    """The text of the page; it needs no other file and no network."""
    strategy = trace.strategy
    task = strategy.task
    xmin, ymin, xmax, ymax = strategy.space.window
    data: Data = {
        "window": [xmin, ymin, xmax, ymax],
        "colors": {
            "obstacle": C_OBSTACLE_GREY, "goal": GREEN, "region": BLUE, "target": VERMILLION,
            "ink": INK, "disc": ORANGE, "force": VERMILLION,
        },
        "obstacles": _rings(strategy.space.obstacles),
        "goal": _region(trace, strategy.region(0).region),
        "robot": None if task.robot.is_point else [list(p) for p in task.robot.shape],
        "error": task.uncertainty.position if task.uncertainty.has_position_sensor else None,
        "control": task.uncertainty.control,
        "rate": options.rate,
        "rest": options.rest,
        "failed": not trace.outcome.as_planned,
        "motions": [
            {
                "title": f"motion {place + 1} of {len(trace.legs)}:"
                f" {to_degrees(leg.direction) % 360.0:.4g}°",
                "direction": leg.direction,
                "region": _region(trace, strategy.region(leg.region).region),
                "target": _region(trace, _target(trace, leg.region)),
            }
            for place, leg in enumerate(trace.legs)
        ],
        "frames": [
            [
                frame.leg, _number(frame.time), *map(_number, frame.place),
                None if frame.measured is None else [_number(v) for v in frame.measured],
                None if frame.force is None else _number(frame.force), frame.ended,
            ]
            for frame in frames
        ],
    }  # fmt: skip
    title = f"{task.name}: run {trace.number} under {trace.control}+{trace.sensing}"
    text = files("preimage.rendering").joinpath("player.html").read_text(encoding="utf-8")
    # no text of the task's may end the script
    run = json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    # the title last: braces in a task's name are no place for the run
    return text.replace("{{run}}", run).replace("{{title}}", html.escape(title))


def _target(trace: Trace, number: int) -> Region:
    motion = trace.strategy.region(number).motion
    return Region.empty() if motion is None else motion.target


def _region(trace: Trace, region: Region) -> Data:
    """A region's rings, intervals and vertices."""
    contact, part = trace.strategy.space.contact, region.contact
    starts, ends = contact.at(part.edge, part.low), contact.at(part.edge, part.high)
    return {
        "rings": _rings(region.area),
        "lines": [
            [[_number(a), _number(b)], [_number(c), _number(d)]]
            for (a, b), (c, d) in zip(starts.tolist(), ends.tolist(), strict=True)
        ],
        "points": [[_number(x), _number(y)] for x, y in contact.points[part.vertices].tolist()],
    }


def _rings(area: Area) -> list[list[list[float]]]:
    return [[[_number(x), _number(y)] for x, y in ring.tolist()] for ring in area.rings]


def _number(value: float) -> float:
    return float(f"{value:.9g}")
