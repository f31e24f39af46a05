"""What a request holds, looked at before it is used: every value may be anything."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import Any

from preimage.configuration.space import ConfigurationSpace
from preimage.errors import InputError, shown
from preimage.strategy.plan_file import read_plan
from preimage.strategy.strategy import Status, Strategy
from preimage.studio.questions import Body
from preimage.task.parse import parse_task
from preimage.task.task import Task

Point = tuple[float, float]

MOST_FEATURES = 20_000
"""A page that draws more contact edges than this is no longer one that is drawn in."""


def task_of(body: Body) -> Task:
    """The task that is asked about.

    Raises
    ------
    TaskError : it is refused.
    """
    return parse_task(needed(body, "task"))


def strategy_of(body: Body, *, solved: bool = False) -> Strategy:
    """The plan that is asked about.

    Raises
    ------
    InputError : it is refused, or not solved though it has to be.
    """
    data = needed(body, "plan")
    if not isinstance(data, dict):
        raise InputError("plan", f"must be a mapping, not {shown(data)}")
    strategy = read_plan(data)
    if solved and strategy.status is not Status.SOLVED:
        raise InputError("plan.status", "the plan is not solved")
    return strategy


def drawable(space: ConfigurationSpace) -> ConfigurationSpace:
    """The space, if a page can show it.

    Raises
    ------
    InputError : it has too many features.
    """
    count = len(space.contact)
    if count > MOST_FEATURES:
        rule = f"{count} contact edges are more than the {MOST_FEATURES} that the studio draws"
        raise InputError("obstacles", rule)
    return space


def needed(body: Body, key: str) -> Any:
    """A value that must be there.

    Raises
    ------
    InputError : it is not.
    """
    if body.get(key) is None:
        raise InputError(key, "is missing")
    return body[key]


def number(value: object, key: str, low: float = -math.inf, high: float = math.inf) -> float:
    """A finite number within bounds.

    Raises
    ------
    InputError : it is none.
    """
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(key, f"must be a number, not {shown(value)}")
    try:
        found = float(value)
    except OverflowError:
        found = math.inf
    if not math.isfinite(found) or not low <= found <= high:
        rule = f"must be at least {low:g} and at most {high:g}, not {shown(value)}"
        raise InputError(key, rule if math.isfinite(low) else f"must be finite, not {shown(value)}")
    return found


def whole(body: Body, key: str, default: int, low: int, high: int) -> int:
    """A whole number within bounds; the default where there is none.

    Raises
    ------
    InputError : it is something else.
    """
    value = body.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        rule = f"must be a whole number of at least {low} and at most {high}, not {shown(value)}"
        raise InputError(key, rule)
    return value


def angle(value: object, key: str) -> float:
    """An angle in degrees, as radians.

    Raises
    ------
    InputError : it is none.
    """
    return math.radians(math.fmod(number(value, key, -1e6, 1e6), 360.0))


def point(value: object, key: str) -> Point:
    """A pair of finite numbers.

    Raises
    ------
    InputError : it is none.
    """
    if not isinstance(value, list) or len(value) != 2:
        raise InputError(key, f"must be two numbers, not {shown(value)}")
    return number(value[0], f"{key}[0]"), number(value[1], f"{key}[1]")


def word(body: Body, key: str, choices: Collection[str], default: str | None = None) -> str:
    """One of some words.

    Raises
    ------
    InputError : it is none of them.
    """
    value = body.get(key, default)
    if not isinstance(value, str) or value not in choices:
        raise InputError(key, f"must be one of {', '.join(choices)}, not {shown(value)}")
    return value


def flag(body: Body, key: str, default: bool) -> bool:
    """Yes or no.

    Raises
    ------
    InputError : it is neither.
    """
    value = body.get(key, default)
    if not isinstance(value, bool):
        raise InputError(key, f"must be true or false, not {shown(value)}")
    return value
