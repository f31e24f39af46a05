"""Single values at the door: each check returns the value, clean, or refuses it by its key."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from enum import Enum
from typing import TypeVar

import numpy as np

from preimage.errors import TaskError, shown
from preimage.task.degrees import to_degrees, to_radians
from preimage.task.limits import COORDINATE, MAX_COORDINATE, Range

Point = tuple[float, float]
Segment = tuple[Point, Point]
Choice = TypeVar("Choice", bound=Enum)


def is_number(value: object) -> bool:
    """Whether the value is an integer or a float; truth values are neither."""
    return isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)


def number(value: object, key: str, within: Range | None = None) -> float:
    """A finite number, in a range."""
    if not is_number(value):
        raise TaskError(key, f"must be a number, not {shown(value)}")
    try:
        # a number, as is_number has found; -0 becomes 0
        result = float(value) + 0.0  # type: ignore[arg-type]
    except OverflowError:
        result = math.inf
    if not math.isfinite(result):
        raise TaskError(key, f"must be a finite number, not {shown(value)}")
    if within is not None and result not in within:
        raise TaskError(key, f"must be {within.words}, not {shown(value)}")
    return result


def extended(value: object, key: str, within: Range) -> float:
    """A number in a range, or infinity."""
    if isinstance(value, float) and value == math.inf:
        return math.inf
    return number(value, key, within)


def angle(value: object, key: str, within: Range) -> float:
    """An angle in radians, in a range of degrees."""
    degrees = to_degrees(number(value, key))
    if degrees not in within:
        raise TaskError(key, f"must be {within.words}, not {shown(degrees)}")
    return to_radians(degrees)


def integer(value: object, key: str, within: Range) -> int:
    """A whole number, in a range; `8.0` is one."""
    result = number(value, key)
    if not result.is_integer():
        raise TaskError(key, f"must be a whole number, not {shown(value)}")
    return int(number(value, key, within))


def truth(value: object, key: str) -> bool:
    """True or false."""
    if not isinstance(value, bool):
        raise TaskError(key, f"must be true or false, not {shown(value)}")
    return value


def choice(value: object, key: str, kind: type[Choice]) -> Choice:
    """A member of an enumeration, or its word."""
    if isinstance(value, kind):
        return value
    words = [str(member.value) for member in kind]
    if isinstance(value, str) and value in words:
        return kind(value)
    hint = suggestion(value, words)
    raise TaskError(key, f"must be {one_of(words)}, not {shown(value)}{hint}")


def one_of(words: Sequence[str]) -> str:
    """The words as alternatives: `a, b or c`."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


def suggestion(value: object, words: Iterable[str]) -> str:
    """`, did you mean word?`, if one is near."""
    near = get_close_matches(value[:40], list(words), n=1) if isinstance(value, str) else []
    return f", did you mean {near[0]}?" if near else ""


def items(value: object, key: str, least: int = 0) -> Sequence[object]:
    """A list, with a least number of items."""
    if not isinstance(value, list | tuple):
        raise TaskError(key, f"must be a list, not {shown(value)}")
    if len(value) < least:
        raise TaskError(key, f"must have {least} items or more, not {len(value)}")
    return value


def points(value: object, key: str) -> tuple[Point, ...]:
    """A list of points."""
    result: list[Point] = []
    for index, place in enumerate(items(value, key)):
        # The usual case, inlined: a file may have a million points.
        if (type(place) is list or type(place) is tuple) and len(place) == 2:
            x, y = place
            if (
                type(x) is float
                and type(y) is float
                and -MAX_COORDINATE <= x <= MAX_COORDINATE
                and -MAX_COORDINATE <= y <= MAX_COORDINATE
            ):
                result.append((x + 0.0, y + 0.0))
                continue
        result.append(point(place, f"{key}[{index}]"))
    return tuple(result)


def point(value: object, key: str) -> Point:
    """A point: two coordinates."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, list | tuple):
        raise TaskError(key, f"must be a point [x, y], not {shown(value)}")
    if len(value) != 2:
        raise TaskError(key, f"must be a point [x, y], not {len(value)} numbers")
    x, y = (number(value[axis], f"{key}[{axis}]", COORDINATE) for axis in (0, 1))
    return x, y


def segments(value: object, key: str, least: int = 0) -> tuple[Segment, ...]:
    """A list of edges: pairs of points that differ."""
    result: list[Segment] = []
    for index, edge in enumerate(items(value, key, least)):
        place = f"{key}[{index}]"
        ends = points(edge, place)
        if len(ends) != 2:
            raise TaskError(place, f"must be an edge of 2 points, not {len(ends)}")
        if ends[0] == ends[1]:
            raise TaskError(place, "must have two ends that differ")
        result.append((ends[0], ends[1]))
    return tuple(result)


def text(value: object, key: str, longest: int) -> str:
    """A short text, on one line."""
    if not isinstance(value, str):
        raise TaskError(key, f"must be a text, not {shown(value)}")
    if not value.strip() or len(value) > longest or not value.isprintable():
        raise TaskError(key, f"must be 1 to {longest} printable characters, not {shown(value)}")
    return value
