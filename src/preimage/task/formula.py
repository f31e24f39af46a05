"""Arithmetic in task files: a small grammar, read and evaluated here and nowhere else.

    sum     = product {("+" | "-") product}
    product = factor {("*" | "/") factor}
    factor  = "-" factor | number | name | "(" sum ")" | function "(" sum {"," sum} ")"

Numbers are decimal, with or without an exponent. Each step must be finite. Angles are in degrees,
and multiples of a right angle are exact.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import NoReturn

from preimage.errors import TaskError, shown
from preimage.task import checks

MAX_LENGTH = 200
"""Characters of a formula."""

MAX_DEPTH = 20
"""Parentheses, functions and signs inside each other."""

NAME = r"[A-Za-z_][A-Za-z0-9_]*"

_TOKEN = re.compile(
    rf"[ \t]*(?:(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)"
    rf"|(?P<name>{NAME})|(?P<mark>[-+*/(),]))"
)
_Token = tuple[str, str, int]
"""Kind, text, and the column of its first character, counted from 1."""

_END = "end"


def evaluate(formula: str, values: Mapping[str, float], key: str) -> float:
    """The value of a formula.

    Parameters
    ----------
    values : by name, finite.
    key : the place of the formula, for refusals.

    Raises
    ------
    TaskError : if it is no formula, or one too long or too deep; if a name has no value; if a step
        has no finite result, such as a division by zero.

    >>> evaluate("-(width / 2 + 0.5)", {"width": 3}, "window[0]")
    -2.0
    >>> evaluate("2 * tan(45)", {}, "friction.coefficient")
    2.0
    """
    if len(formula) > MAX_LENGTH:
        raise TaskError(key, f"formulas must have {MAX_LENGTH} characters or fewer")
    return _Reader(formula, values, key).whole()


def names_of(formula: str) -> frozenset[str]:
    """The names that a formula uses; none of what is no formula.

    >>> sorted(names_of("max(a, b) - 2 * a"))
    ['a', 'b']
    """
    found = _TOKEN.finditer(formula[:MAX_LENGTH])
    return frozenset(match["name"] for match in found if match["name"]) - FUNCTIONS.keys()


# --- functions ------------------------------------------------------------------------------


def _sine(degrees: float) -> float:
    turn = math.remainder(degrees, 360.0)
    if abs(turn) > 90.0:
        turn = math.copysign(180.0, turn) - turn
    return math.sin(math.radians(turn))


def _cosine(degrees: float) -> float:
    return _sine(90.0 - abs(math.remainder(degrees, 360.0)))


def _tangent(degrees: float) -> float:
    # at 45 degrees the sine and the cosine are one double
    return _sine(degrees) / _cosine(degrees)


_OF_ONE: dict[str, Callable[[float], float]] = {
    "sqrt": math.sqrt,
    "sin": _sine,
    "cos": _cosine,
    "tan": _tangent,
}
_OF_MANY: dict[str, Callable[..., float]] = {"min": min, "max": max}
FUNCTIONS: Mapping[str, Callable[..., float]] = {**_OF_ONE, **_OF_MANY}


# --- the reader -----------------------------------------------------------------------------


class _Reader:
    """One formula, evaluated as it is read from left to right."""

    __slots__ = ("_at", "_formula", "_key", "_tokens", "_values")

    def __init__(self, formula: str, values: Mapping[str, float], key: str) -> None:
        self._formula = formula
        self._values = values
        self._key = key
        self._at = 0
        self._tokens = self._split()

    def whole(self) -> float:
        value = self._sum(0)
        if self._next[0] != _END:
            self._unexpected("an operator")
        return value

    def _split(self) -> list[_Token]:
        tokens: list[_Token] = []
        text = self._formula.rstrip(" \t")
        place = 0
        while place < len(text):
            match = _TOKEN.match(text, place)
            if match is None:
                rest = text[place:].lstrip(" \t")
                column = len(text) - len(rest) + 1
                self._refuse(f"has no place for {shown(rest[0])} at {column}")
            kind = match.lastgroup
            assert kind is not None
            tokens.append((kind, match[kind], match.start(kind) + 1))
            place = match.end()
        tokens.append((_END, "", len(text) + 1))
        return tokens

    @property
    def _next(self) -> _Token:
        return self._tokens[self._at]

    def _take(self, marks: str) -> str:
        """The next token, taken if it is one of these marks; else nothing."""
        kind, text, _ = self._next
        if kind != "mark" or text not in marks:
            return ""
        self._at += 1
        return text

    def _sum(self, depth: int) -> float:
        value = self._product(depth)
        while mark := self._take("+-"):
            other = self._product(depth)
            value = self._finite(value + other if mark == "+" else value - other)
        return value

    def _product(self, depth: int) -> float:
        value = self._factor(depth)
        while mark := self._take("*/"):
            other = self._factor(depth)
            if mark == "/" and other == 0.0:
                self._refuse("divides by zero")
            value = self._finite(value * other if mark == "*" else value / other)
        return value

    def _factor(self, depth: int) -> float:
        if depth == MAX_DEPTH:
            self._refuse(f"must be nested {MAX_DEPTH} deep or less")
        if self._take("-"):
            return -self._factor(depth + 1)
        if self._take("("):
            value = self._sum(depth + 1)
            self._close()
            return value
        kind, text, _ = self._next
        if kind == "number":
            self._at += 1
            return self._finite(float(text))
        if kind != "name":
            self._unexpected("a number or a name")
        self._at += 1
        return self._call(text, depth) if text in FUNCTIONS else self._value(text)

    def _value(self, name: str) -> float:
        if name not in self._values:
            hint = checks.suggestion(name, [*self._values, *FUNCTIONS])
            self._refuse(f"has the unknown name {shown(name)}{hint}")
        return self._finite(float(self._values[name]))

    def _call(self, name: str, depth: int) -> float:
        if not self._take("("):
            self._unexpected(f"( after {name}")
        arguments = [self._sum(depth + 1)]
        while self._take(","):
            arguments.append(self._sum(depth + 1))
        self._close()
        if name in _OF_MANY:
            return float(_OF_MANY[name](arguments))
        if len(arguments) != 1:
            self._refuse(f"gives {name} {len(arguments)} numbers, not one")
        try:
            return self._finite(_OF_ONE[name](arguments[0]))
        except (ValueError, ZeroDivisionError):
            self._refuse(f"has no {name} of {arguments[0]!r}")

    def _close(self) -> None:
        if not self._take(")"):
            self._unexpected("a closing parenthesis")

    def _finite(self, value: float) -> float:
        if not math.isfinite(value):
            self._refuse("has a step that is not finite")
        return value

    def _unexpected(self, wanted: str) -> NoReturn:
        kind, text, column = self._next
        found = "nothing" if kind == _END else shown(text)
        self._refuse(f"must have {wanted} at {column}, not {found}")

    def _refuse(self, rule: str) -> NoReturn:
        raise TaskError(self._key, f"the formula {shown(self._formula)} {rule}")
