"""`preimage import`."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

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
from preimage.errors import shown
from preimage.exchange.drawing import Role
from preimage.exchange.options import DrawingFormat, ImportOptions, Nested, Unknown
from preimage.exchange.units import METRES
from preimage.task.documents import Format
from preimage.task.workspace import Side, SolidSide

if TYPE_CHECKING:
    from preimage.task.goal import Goal
    from preimage.task.initial import Initial

Function = TypeVar("Function", bound=Callable[..., Any])
Point = tuple[float, float]

KEYS = {
    "initial": "--start",
    "goal": "--goal",
    "window": "--window",
    "workspace.walls": "--walls",
    "walls": "--walls",
    "uncertainty.control": "--control",
    "uncertainty.position": "--position",
    "uncertainty.force.angle": "--force",
    "uncertainty.force.threshold": "--threshold",
    "friction": "--friction",
    **{
        word: f"--{word.replace('_', '-')}"
        for word in ("units", "curves", "join", "thickness", "snap", "simplify", "robot_radius")
    },
}
"""Keys of a task and of its import that have an option."""

_PLACE = re.compile(r"(edge|polygon|point|box|disc)\s*:\s*(.*)")


def _words(kind: type[Any]) -> click.Choice[str]:
    return click.Choice([member.value for member in kind])


OPTIONS = (
    click.option("--format", type=_words(DrawingFormat), help="[default: by the ending of FILE]"),
    click.option(
        "--layer", "layers", multiple=True, metavar="ROLE=NAME",
        help="Another name of a layer, an id or a property, and what it is: "
        f"{', '.join(role.value for role in Role)}; may be repeated.",
    ),
    click.option("--units", type=click.Choice(list(METRES)), help="Scale the drawing to it."),
    click.option(
        "--curves", metavar="LENGTH",
        help="How far borders may be from curves. [default: a 1000th of the drawing]",
    ),
    click.option(
        "--join", metavar="LENGTH",
        help="Ends of lines so near to each other meet. [default: a millionth of the drawing]",
    ),
    click.option("--chains", type=_words(SolidSide), help="The solid side of open obstacles."),
    click.option("--thickness", metavar="LENGTH", help="Open obstacles are walls so thick."),
    click.option(
        "--nested", type=_words(Nested), default="solid", show_default=True,
        help="What an outline inside another one is, of obstacles.",
    ),
    click.option(
        "--snap", metavar="LENGTH", help="Move goal edges onto contact, so far. [default: 0]"
    ),
    click.option(
        "--unknown", type=_words(Unknown), default="occupied", show_default=True,
        help="What cells of a map are that nobody has seen.",
    ),
    click.option(
        "--simplify", metavar="METRES",
        help="How far borders of a map may be moved, outward. [default: a cell]",
    ),
    click.option("--robot-radius", metavar="LENGTH", help="Of a disc. [default: a point]"),
    click.option(
        "--start", metavar="PLACE",
        help="x,y; disc:x,y,r; box:x0,y0,x1,y1; polygon:x,y,…; edge:x0,y0,x1,y1; or everywhere.",
    ),
    click.option(
        "--goal", metavar="PLACES",
        help="edge:x0,y0,x1,y1; box:…; polygon:x,y,…; point:x,y; several with ; between.",
    ),
    click.option("--window", metavar="X0,Y0,X1,Y1", help="[default: as drawn, or around all]"),
    click.option("--walls", metavar="SIDES", help="Sides of the window: left,right,…"),
    click.option("--control", metavar="DEGREES", default="5", show_default=True),
    click.option(
        "--position", metavar="LENGTH", help="Or inf. [default: a 200th of the window]"
    ),
    click.option(
        "--force", metavar="DEGREES", default="10", show_default=True, help="Or none: no sensor."
    ),
    click.option("--threshold", metavar="FORCE", default="0.05", show_default=True),
    click.option("--friction", metavar="DEGREES", default="20", show_default=True),
)  # fmt: skip
"""How the drawing is read, and what is not drawn."""


def import_options(function: Function) -> Function:
    """The options of `OPTIONS`."""
    for option in reversed(OPTIONS):
        function = option(function)
    return function


@click.command(
    "import",
    cls=Command,
    short_help="Make a task of a drawing or a map.",
    examples=[
        "preimage import map.yaml --start 1,2 --goal box:4,4,5,5 --robot-radius 0.2 -o task.yaml",
        "preimage import room.dxf --layer obstacles=WALLS --units m -o task.yaml --figure task.png",
        "preimage import room.svg | preimage plan -",
    ],
)
@click.argument("path", metavar="FILE", type=click.Path())
@click.option(
    "-o", "--output", metavar="FILE", default=STANDARD,
    help="A task file: .yaml, .json or .toml. [default: print it]",
)  # fmt: skip
@click.option("--figure", metavar="FILE", help="A picture of the task: .svg, .png or .pdf.")
@import_options
def import_command(path: str, output: str, figure: str | None, **given: Any) -> int:
    """Make a task of FILE: a map of ROS (YAML), DXF, SVG, WKT or GeoJSON.

    Layers, ids or properties named obstacles, room, goal, start, robot, reference and window say
    what is what. Curves are replaced on the safe side: obstacles, the robot and the start are never
    smaller than they are drawn, goal areas and rooms never larger.

    Exit status: 0 if there is a task, 2 if not.
    """
    check_outputs([path], output=output, figure=figure)
    kind = Format.YAML
    if output != STANDARD:
        with about(output):
            kind = Format.of(output)
    options = _options(given)
    from preimage.exchange.importing import format_imported, imported

    with about(path, KEYS):
        found = imported(path, options)
    text = format_imported(found, kind)
    tell = note if output == STANDARD else say
    if figure is not None:
        picture(found.task, figure)
    write(output, text)
    for line in found.notes:
        tell(line)
    written = [name for name in (output, figure) if name not in (None, STANDARD)]
    if written:
        tell(f"written: {', '.join(map(str, written))}")
    return 0


def _options(given: dict[str, Any]) -> ImportOptions:
    """The options of the command line."""
    lengths = ("curves", "join", "thickness", "simplify")
    position = given["position"]
    force = given["force"].strip().lower()
    start, goal, window = given["start"], given["goal"], given["window"]
    with about("", KEYS):
        return ImportOptions(
            format=DrawingFormat(given["format"]) if given["format"] else None,
            layers=_layers(given["layers"]),
            units=given["units"],
            chains=SolidSide(given["chains"]) if given["chains"] else None,
            nested=Nested(given["nested"]),
            unknown=Unknown(given["unknown"]),
            snap=_length(given["snap"], "--snap") or 0.0,
            robot_radius=_length(given["robot_radius"], "--robot-radius") or 0.0,
            initial=None if start is None else _start(start),
            goal=None if goal is None else _goal(goal),
            window=None if window is None else _window(window),
            walls=_walls(given["walls"]),
            control=_degrees(given["control"], "--control"),
            position=_length(position, "--position"),
            force_angle=0.0 if force == "none" else _degrees(force, "--force"),
            threshold=math.inf if force == "none" else _value(given["threshold"], "--threshold"),
            friction=_degrees(given["friction"], "--friction"),
            **{word: _length(given[word], f"--{word}") for word in lengths},
        )


def _layers(given: tuple[str, ...]) -> dict[str, Role]:
    roles = {role.value: role for role in Role}
    layers: dict[str, Role] = {}
    for text in given:
        word, equals, name = text.partition("=")
        if not equals or word.strip().lower() not in roles or not name.strip():
            known = ", ".join(roles)
            raise RefusalError(
                f"--layer: must be ROLE=NAME, with one of {known}, not {shown(text)}"
            )
        layers[name] = roles[word.strip().lower()]
    return layers


def _value(text: str, option: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise RefusalError(f"{option}: must be a number, not {shown(text)}") from None


def _length(text: str | None, option: str) -> float | None:
    return None if text is None else _value(text, option)


def _degrees(text: str, option: str) -> float:
    return math.radians(_value(text, option))


def _walls(text: str | None) -> frozenset[Side]:
    sides = {side.value: side for side in Side}
    words = [word.strip() for word in (text or "").split(",") if word.strip()]
    for word in words:
        if word not in sides:
            raise RefusalError(f"--walls: must be some of {', '.join(sides)}, not {shown(word)}")
    return frozenset(sides[word] for word in words)


# --- places -------------------------------------------------------------------------------------


def _window(text: str) -> tuple[float, float, float, float]:
    xmin, ymin, xmax, ymax = _numbers(text, 4, "--window")
    return xmin, ymin, xmax, ymax


def _start(text: str) -> Initial:
    from preimage.task.initial import (
        Everywhere,
        InitialDisc,
        InitialEdges,
        InitialPoint,
        InitialPolygon,
    )

    if text.strip() == "everywhere":
        return Everywhere()
    match = _PLACE.fullmatch(text.strip())
    kind, numbers = (match[1], match[2]) if match else ("point", text)
    if kind == "disc":
        x, y, radius = _numbers(numbers, 3, "--start")
        return InitialDisc((x, y), radius)
    points = _points(kind, numbers, "--start")
    if kind == "point":
        return InitialPoint(points[0])
    return InitialEdges(((points[0], points[1]),)) if kind == "edge" else InitialPolygon(points)


def _goal(text: str) -> Goal:
    from preimage.task.goal import Goal

    found: dict[str, list[tuple[Point, ...]]] = {"edge": [], "polygon": [], "point": []}
    for part in filter(None, (part.strip() for part in text.split(";"))):
        match = _PLACE.fullmatch(part)
        kind, numbers = (match[1], match[2]) if match else ("box", part)
        if kind == "disc":
            raise RefusalError("--goal: a disc is no goal; give a polygon inside it")
        points = _points(kind, numbers, "--goal")
        found["polygon" if kind == "box" else kind].append(points)
    edges = tuple((edge[0], edge[1]) for edge in found["edge"])
    points = tuple(place[0] for place in found["point"])
    return Goal(edges, tuple(found["polygon"]), points)


def _points(kind: str, text: str, option: str) -> tuple[Point, ...]:
    """The points of a place; the corners of a box."""
    if kind == "box":
        xmin, ymin, xmax, ymax = _numbers(text, 4, option)
        return (xmin, ymin), (xmax, ymin), (xmax, ymax), (xmin, ymax)
    numbers = _numbers(text, {"edge": 4, "point": 2}.get(kind), option)
    if len(numbers) % 2:
        raise RefusalError(f"{option}: must be pairs of numbers, not {len(numbers)}")
    return tuple(zip(numbers[::2], numbers[1::2], strict=True))


def _numbers(text: str, count: int | None, option: str) -> list[float]:
    numbers = [_value(part, option) for part in re.split(r"[,\s]+", text.strip())]
    if count is not None and len(numbers) != count:
        raise RefusalError(f"{option}: must have {count} numbers there, not {len(numbers)}")
    return numbers
