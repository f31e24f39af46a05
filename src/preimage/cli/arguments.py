"""What the commands have in common: the task, directions, and the planner's options."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import click
from click.shell_completion import CompletionItem

from preimage.cli.output import STANDARD, RefusalError, about, reason
from preimage.errors import shown
from preimage.task.degrees import to_radians
from preimage.task.documents import MAX_BYTES, Format, parse_document, read_document
from preimage.task.examples import named_tasks
from preimage.task.limits import DIRECTION, MAX_NAME
from preimage.task.options import Method, Preference, SearchOrder, StrategyKind, Termination
from preimage.task.parse import parse_task
from preimage.task.task import Task
from preimage.task.template import Template, named_template, parse_template

Function = TypeVar("Function", bound=Callable[..., Any])

WORDS = {"right": 0.0, "up": 90.0, "left": 180.0, "down": 270.0}
"""Directions that have a name, in degrees."""


@dataclass(frozen=True, slots=True)
class Source:
    """A task, and what refusals of it begin with: its file, or its name.

    The template gives the task, for its given values.
    """

    task: Task
    name: str
    template: Template


# --- the task -------------------------------------------------------------------------------


def complete_examples(
    _context: click.Context, _parameter: click.Parameter, incomplete: str
) -> list[CompletionItem]:
    """The named tasks that begin so, for a shell."""
    return [
        CompletionItem(name, help=words)
        for name, words in named_tasks().items()
        if name.startswith(incomplete)
    ]


def task_argument(function: Function) -> Function:
    """The argument TASK, the option that stands for it, and the values of its parameters.

    The values reach `load` by the context, so that commands need not hand them on.
    """
    argument = click.argument("path", metavar="[TASK]", required=False, type=click.Path())
    option = click.option(
        "--example",
        metavar="NAME",
        shell_complete=complete_examples,
        help="A named task instead of a file; `preimage examples` lists them.",
    )
    values = click.option(
        "--set",
        metavar="NAME=VALUE",
        multiple=True,
        expose_value=False,
        callback=_keep_settings,
        help="Another value for a parameter of the task; may be repeated.",
    )
    return argument(option(values(function)))


_SETTINGS = f"{__name__}.settings"


def _keep_settings(
    context: click.Context, _parameter: click.Parameter, given: tuple[str, ...]
) -> None:
    """Note the values of parameters where `load` finds them."""
    values: dict[str, float] = {}
    for text in given:
        name, equals, words = text.partition("=")
        name = name.strip()
        value = _number(words)
        if not name or not equals or not isinstance(value, int | float):
            raise RefusalError(f"--set: must be NAME=VALUE with a number, not {shown(text)}")
        if name in values:
            raise RefusalError(f"--set: {shown(name)} is given twice")
        values[name] = value
    context.meta[_SETTINGS] = values


def load(path: str | None, example: str | None) -> Source:
    """The task of a file, of standard input, or the named one, with the values of `--set`."""
    if (path is None) == (example is None):
        raise RefusalError("give a TASK file, or a named task by --example NAME")
    if example is not None:
        with about(example, {"example": "--example"}):
            template = named_template(example)
        return _given(template, example)
    assert path is not None
    return posed(*document(path), named=stem(path))


def posed(data: object, name: str, *, named: str) -> Source:
    """The task of a file's data; `named` is what it is called if the file does not say."""
    with about(name):
        template = parse_template(data, name=named)
    return _given(template, name)


def settings() -> dict[str, float]:
    """What `--set` says, by the names of parameters."""
    context = click.get_current_context(silent=True)
    found: dict[str, float] = context.meta.get(_SETTINGS, {}) if context else {}
    return found


def _given(template: Template, name: str) -> Source:
    values = settings()
    with about(name, {f"parameters.{word}": f"--set {word}" for word in values}):
        template = template.given(**values)
        return Source(template.task(), name, template)


def document(path: str) -> tuple[object, str]:
    """The data of a file or of standard input, and its name in refusals."""
    if path == STANDARD:
        name = "standard input"
        with about(name):
            return parse_document(_standard_input(), Format.YAML, name), name
    if not Path(path).suffix and path in named_tasks() and not Path(path).exists():
        raise RefusalError(f"{path}: is no file; the named task is --example {path}")
    with about(path):
        return read_document(path), path


def _standard_input() -> str:
    if sys.stdin is None:
        raise RefusalError("standard input: is closed")
    content = sys.stdin.buffer.read(MAX_BYTES + 1)
    if len(content) > MAX_BYTES:
        raise RefusalError(f"standard input: must be {MAX_BYTES // 2**20} MiB or less")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise RefusalError(f"standard input: is not UTF-8 at byte {error.start}") from None


def stem(path: str) -> str:
    """A task's name, if it has none: that of its file."""
    stem = Path(path).stem[:MAX_NAME]
    return stem if path != STANDARD and stem.strip() and stem.isprintable() else "task"


def text_of(path: str) -> str:
    """The text of a file that is no task."""
    try:
        with open(path, "rb") as file:
            content = file.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise RefusalError(f"{path}: must be {MAX_BYTES // 2**20} MiB or less")
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise RefusalError(f"{path}: is not UTF-8 at byte {error.start}") from None
    except (OSError, ValueError) as error:
        raise RefusalError(f"{path}: cannot be read: {reason(error)}") from None


# --- a direction ----------------------------------------------------------------------------


class Direction(click.ParamType[float]):
    """A direction of motion: degrees, or a word; radians for the program."""

    name = "degrees"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """The direction, in radians from 0 to below a full turn."""
        if isinstance(value, float):
            return value
        text = str(value).strip().lower().removesuffix("°")
        try:
            angle = WORDS[text] if text in WORDS else float(text)
        except ValueError:
            angle = float("nan")
        if angle not in DIRECTION:
            self.fail(f"{value!r} is no angle in degrees, nor {', '.join(WORDS)}", param, ctx)
        turned = angle % 360.0
        return to_radians(turned) if turned < 360.0 else 0.0


def direction_option(function: Function) -> Function:
    """The option `--direction`."""
    return click.option(
        "--direction",
        "-d",
        required=True,
        type=Direction(),
        help="The commanded direction: degrees, counter-clockwise from +x; or right, up, left, "
        "down.",
    )(function)


# --- options of the planner -----------------------------------------------------------------


def method_option(function: Function) -> Function:
    """The option `--method`."""
    return click.option(
        "--method",
        type=click.Choice([member.value for member in Method]),
        help="How a motion is known to have ended: it sticks, the readings tell, or either.",
    )(function)


def planner_options(function: Function) -> Function:
    """The options that stand for keys of `planner` in a task."""
    options = (
        method_option,
        click.option(
            "--directions",
            metavar="2K|LIST",
            help="An even number of directions, evenly spread; degrees: 0,90,225; or continuous.",
        ),
        click.option(
            "--search",
            type=click.Choice([member.value for member in SearchOrder]),
            help="Which region is looked at next; breadth-first finds the fewest motions.",
        ),
        click.option("--max-steps", type=int, metavar="N", help="The most motions of a plan."),
        click.option(
            "--time-limit", metavar="SECONDS", help="When to stop with what was found; or none."
        ),
        click.option("--max-regions", type=int, metavar="N", help="The most regions made."),
        click.option(
            "--strategy",
            type=click.Choice([member.value for member in StrategyKind]),
            help="A fixed sequence of motions, or a policy that chooses by what is read.",
        ),
        click.option(
            "--termination",
            type=click.Choice([member.value for member in Termination]),
            help="What tells the end of a motion: the readings; also where it began; also where "
            "it would have been stopped.",
        ),
        click.option(
            "--resolution",
            metavar="DEGREES",
            help="To which continuous directions are told apart.",
        ),
        click.option(
            "--or-fail/--guaranteed",
            default=None,
            help="Where no plan surely ends in the goal: one that ends there or knows that it has "
            "failed.",
        ),
        click.option(
            "--prefer",
            type=click.Choice([member.value for member in Preference]),
            help="Of the shortest plans: the first one, or that with the largest smallest margin.",
        ),
    )
    for option in reversed(options):
        function = option(function)
    return function


def planner_options_without(*names: str) -> Callable[[Function], Function]:
    """The same, but for some that mean something else, or nothing, to a command."""

    def decorate(function: Function) -> Function:
        own = list(vars(function).get("__click_params__", ()))
        function = planner_options(function)
        parameters: list[click.Parameter] = vars(function)["__click_params__"]
        parameters[:] = [one for one in parameters if one in own or one.name not in names]
        return function

    return decorate


PLANNER = {
    f"planner.{word}": f"--{word.replace('_', '-')}"
    for word in (
        "method",
        "directions",
        "search",
        "max_steps",
        "time_limit",
        "max_regions",
        "strategy",
        "termination",
        "resolution",
        "prefer",
    )
}
"""Keys of a task that have an option of their own."""


def overridden(source: Source, given: dict[str, Any]) -> Source:
    """The task with the planner's options that the command line gives."""
    chosen = {word: value for word, value in given.items() if value is not None}
    if not chosen:
        return source
    if "directions" in chosen:
        chosen["directions"] = _directions(chosen["directions"])
    for word in ("time_limit", "resolution"):
        if word in chosen:
            chosen[word] = _number(chosen[word])
    with about("", PLANNER):
        # the rules are the file's own
        parsed = parse_task({**_SMALLEST, "planner": chosen}).options
    options = replace(source.task.options, **{word: getattr(parsed, word) for word in chosen})
    document = source.template.document
    planner = {**document.get("planner", {}), **chosen}
    template = replace(source.template, document={**document, "planner": planner})
    return Source(replace(source.task, options=options), source.name, template)


_SMALLEST: dict[str, object] = {
    "version": 1,
    "window": [0, 0, 1, 1],
    "uncertainty": {"control": 0, "position": 0},
    "initial": "everywhere",
    "goal": {"polygons": [[[0, 0], [1, 0], [0, 1]]]},
}


def _directions(text: str) -> object:
    """As a task file has them: a number of directions, a list, or a word."""
    parts = [part.strip() for part in re.split(r"[,\s]+", text.strip().strip("[]").strip())]
    if len(parts) == 1 and not text.strip().startswith("["):
        return _number(parts[0])
    return [_number(WORDS.get(part, part)) for part in parts if part != ""]


def _number(text: object) -> object:
    """The number that a text is, or the text."""
    try:
        value = float(str(text))
    except ValueError:
        return text
    return int(value) if value.is_integer() and abs(value) < 2**53 else value
