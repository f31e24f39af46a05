"""`preimage backproject`, `preimage kernel` and `preimage preimage`: the stages on their own."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, TypeVar

import click

from preimage.cli.arguments import Source, direction_option, load, method_option, task_argument
from preimage.cli.command import Command
from preimage.cli.output import STANDARD, about, check_outputs, note, picture, say, write
from preimage.cli.targets import goal_of, target_of
from preimage.configuration.region import Region
from preimage.preimages.setting import Setting
from preimage.strategy.plan_file import condition_to_dict
from preimage.strategy.region_geojson import region_to_geojson
from preimage.strategy.words import contact_lines, direction_words, region_words
from preimage.task.degrees import to_degrees
from preimage.task.options import Method

Function = TypeVar("Function", bound=Callable[..., Any])
Feature = dict[str, Any]


def _outputs(function: Function) -> Function:
    geojson = click.option(
        "-o", "--output", metavar="FILE", help="The region as GeoJSON; - for standard output."
    )
    figure = click.option("--figure", metavar="FILE", help="A picture: .svg, .png or .pdf.")
    return geojson(figure(function))


def _target_option(default: str) -> Callable[[Function], Function]:
    return click.option(
        "--target",
        default=default,
        show_default=True,
        metavar="WHAT",
        help="goal; sticking, kernel or combined, what of the goal such a method aims at; a GeoJSON"
        " file; or places: 'edge:x,y,x,y', 'polygon:x,y,x,y,…', 'point:x,y', several with ';'.",
    )


@click.command(
    "backproject",
    cls=Command,
    short_help="From where does a motion surely reach a target?",
    examples=[
        "preimage backproject task.yaml --direction 270 -o starts.geojson --figure starts.svg",
        "preimage backproject --example peg-in-hole-point -d down --target kernel",
        "preimage backproject --example peg-in-hole-point -d down --target 'edge:-1,-3,0,-3'",
    ],
)
@task_argument
@direction_option
@_target_option("goal")
@_outputs
def backproject_command(
    path: str | None,
    example: str | None,
    direction: float,
    target: str,
    output: str | None,
    figure: str | None,
) -> int:
    """The maximal backprojection of a target: whatever the errors, the motion meets the target."""
    check_outputs([path], output=output, figure=figure)
    source, setting = _prepared(path, example)
    aim = target_of(target, source, setting, direction)
    from preimage.reachability.backprojection import backproject

    made = backproject(setting.space, aim, setting.command(direction).sources)
    lines = [
        f"backprojection for {direction_words(direction)}",
        *_listed("target", aim, setting),
        *_listed("starts", made.region, setting),
    ]
    feature = _feature(source, setting, made.region, "backprojection", direction)
    _deliver(lines, feature, output)
    _draw(made, source, setting, direction, figure, output)
    return 0


@click.command(
    "kernel",
    cls=Command,
    short_help="What of a goal do the readings tell?",
    examples=[
        "preimage kernel task.yaml --direction 270 -o kernel.geojson",
        "preimage kernel --example l-room -d right --figure kernel.svg",
    ],
)
@task_argument
@direction_option
@_target_option("goal")
@_outputs
def kernel_command(
    path: str | None,
    example: str | None,
    direction: float,
    target: str,
    output: str | None,
    figure: str | None,
) -> int:
    """The kernel of the goal: what no reading confuses with a place outside the goal."""
    check_outputs([path], output=output, figure=figure)
    source, setting = _prepared(path, example)
    aim = target_of(target, source, setting, direction)
    from preimage.recognition.kernel import kernel

    core = kernel(
        setting.space,
        setting.command(direction).readings,
        aim,
        setting.uncertainty,
        arc_tolerance=setting.arc_tolerance,
    )
    lines = [
        f"kernel for {direction_words(direction)}",
        *_listed("of", aim, setting),
        *_listed("kernel", core, setting),
    ]
    feature = _feature(source, setting, core, "kernel", direction)
    _deliver(lines, feature, output)
    _draw(core, source, setting, direction, figure, output)
    return 0


@click.command(
    "preimage",
    cls=Command,
    short_help="From where does a motion surely end in the goal, and know it?",
    examples=[
        "preimage preimage task.yaml --direction 270 --method sticking",
        "preimage preimage --example peg-in-hole -d down --figure preimage.svg -o -",
    ],
)
@task_argument
@direction_option
@method_option
@_outputs
def preimage_command(
    path: str | None,
    example: str | None,
    direction: float,
    method: str | None,
    output: str | None,
    figure: str | None,
) -> int:
    """The preimage of the goal for one motion, by one of the methods; by default the task's."""
    check_outputs([path], output=output, figure=figure)
    source, setting = _prepared(path, example)
    goal = goal_of(source, setting)
    chosen = source.task.options.method if method is None else Method(method)
    from preimage.preimages.methods import preimage
    from preimage.strategy.describe import describe_condition

    made = preimage(setting, goal, direction, chosen)
    words = (describe_condition(one, (0,)) for one in made.termination)
    stops = [f"  {'or' if index else 'stops'} as soon as {one}" for index, one in enumerate(words)]
    lines = [
        f"preimage for {direction_words(direction)}, {chosen.value} method",
        *_listed("goal", goal, setting),
        *_listed("target", made.target.region, setting),
        *_listed("starts", made.region, setting),
        *stops,
    ]
    conditions = [condition_to_dict(one, setting.space) for one in made.termination]
    extra = {"method": chosen.value, "termination": conditions}
    features = [
        _feature(source, setting, made.region, "preimage", direction, **extra),
        _feature(source, setting, made.target.region, "target", direction, **extra),
    ]
    _deliver(lines, features, output)
    _draw(made, source, setting, direction, figure, output)
    return 0


# --- parts ----------------------------------------------------------------------------------


def _prepared(path: str | None, example: str | None) -> tuple[Source, Setting]:
    source = load(path, example)
    with about(source.name):
        return source, Setting.of(source.task)


def _listed(name: str, region: Region, setting: Setting) -> list[str]:
    """A region's size, and its contact."""
    lines = [f"  {name:<8}{region_words(region)}"]
    return lines + [f"{'':10}{line}" for line in contact_lines(region, setting.space)]


def _feature(
    source: Source, setting: Setting, region: Region, stage: str, direction: float, **more: object
) -> Feature:
    """A region as a GeoJSON feature."""
    return {
        "type": "Feature",
        "properties": {
            "task": source.task.name,
            "stage": stage,
            "direction": float(to_degrees(direction)),
            **more,
        },
        "geometry": region_to_geojson(region, setting.space),
    }


def _deliver(
    lines: list[str],
    made: Feature | list[Feature],
    output: str | None,
) -> None:
    """Write the GeoJSON and say what it is."""
    if output is not None:
        if isinstance(made, list):
            features = ",\n".join(json.dumps(one, ensure_ascii=False) for one in made)
            text = f'{{"type": "FeatureCollection", "features": [\n{features}\n]}}\n'
        else:
            text = json.dumps(made, ensure_ascii=False) + "\n"
        write(output, text)
    (note if output == STANDARD else say)("\n".join(lines))


def _draw(
    subject: object,
    source: Source,
    setting: Setting,
    direction: float,
    figure: str | None,
    output: str | None,
) -> None:
    if figure is not None:
        picture(subject, figure, task=source.task, space=setting.space, direction=direction)
    written = [name for name in (output, figure) if name not in (None, STANDARD)]
    if written:
        (note if output == STANDARD else say)(f"written: {', '.join(map(str, written))}")
