"""Named numbers of a task file, and the formulas that use them.

With `parameters`, a word where a number is meant is a formula. Without, it is refused as ever.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from preimage.errors import InputError, TaskError, shown
from preimage.task import checks, formula
from preimage.task.documents import MAX_DEPTH

KEY = "parameters"

MAX_PARAMETERS = 64
MAX_NAME = 40
"""Characters of a parameter's name."""

INFINITY = ("inf", ".inf")
NONE = "none"
CONTINUOUS = "continuous"

# Keys of words, never of formulas: what is wrong there is said by who reads the key.
_OPTIONS = ("method", "strategy", "termination", "search", "prefer", "or_fail")
_WORDED = frozenset(
    ("version", "name", "walls", "robot", "solid", "force", "sliding", "initial", *_OPTIONS)
)
# Where some words are not: no parameter may bear their names.
_ALSO = {"position": INFINITY, "directions": (CONTINUOUS,), "time_limit": (NONE,)}

WORDS = tuple(word for words in _ALSO.values() for word in words)
"""Words that stand for themselves where else a number is."""

RESERVED = frozenset(WORDS) | formula.FUNCTIONS.keys()
"""Names that no parameter may have."""

_NAME = re.compile(formula.NAME)


def split(data: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, float]]:
    """A file's data without its parameters, and these, in their order.

    A parameter that no formula uses is refused: a question about it would have an answer that
    means nothing, and most likely its name is misspelt somewhere.

    Raises
    ------
    TaskError : for bad names and values, and for a parameter that is not used.

    >>> split({"window": [0, 0, "width", 1], "parameters": {"width": 3}})
    ({'window': [0, 0, 'width', 1]}, {'width': 3.0})
    """
    document = {word: value for word, value in data.items() if word != KEY}
    values = _values(data[KEY]) if KEY in data else {}
    if values:
        texts = set(_formulas(document).values())
        used = frozenset[str]().union(*map(formula.names_of, texts))
        for name in values:
            if name not in used:
                raise TaskError(f"{KEY}.{name}", "is used by no formula")
    return document, values


def value_of(name: str, value: object) -> float:
    """A parameter's value: a finite number."""
    return checks.number(value, f"{KEY}.{name}")


def evaluated(document: Mapping[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    """The document with a number for each formula.

    >>> evaluated({"window": [0, 0, "2 * width", 1]}, {"width": 3.0})
    {'window': [0, 0, 6.0, 1]}
    """
    known: dict[str, float] = {}

    def number(text: str, key: str) -> float:
        if text not in known:
            known[text] = formula.evaluate(text, values, key)
        return known[text]

    result: dict[str, Any] = _replaced(document, number)
    return result


def explained(
    error: InputError, document: Mapping[str, Any], values: Mapping[str, float]
) -> TaskError:
    """A refusal of an evaluated document, with the formula or the values that led to it."""
    key = error.key
    places = _formulas(document)
    if key in places:
        return TaskError(key, f"{error.rule} (by the formula {shown(places[key])})")
    if any(place.startswith((f"{key}.", f"{key}[")) for place in places):
        return TaskError(key, f"{error.rule} (with {listed(values)})")
    return TaskError(key, error.rule)


def listed(values: Mapping[str, float]) -> str:
    """The values, for people.

    >>> listed({"width": 3.0, "depth": 0.1})
    'width = 3, depth = 0.1'
    """
    return ", ".join(f"{name} = {repr(value).removesuffix('.0')}" for name, value in values.items())


def _values(value: object) -> dict[str, float]:
    if not isinstance(value, Mapping):
        raise TaskError(KEY, f"must be a mapping, not {shown(value)}")
    if len(value) > MAX_PARAMETERS:
        raise TaskError(KEY, f"must be {MAX_PARAMETERS} or fewer, not {len(value)}")
    return {_name(name): value_of(name, number) for name, number in value.items()}


def _name(name: object) -> str:
    if not isinstance(name, str) or len(name) > MAX_NAME or not _NAME.fullmatch(name):
        rule = f"names must be 1 to {MAX_NAME} letters, digits and _, a letter first"
        raise TaskError(KEY, f"{rule}, not {shown(name)}")
    if name in RESERVED:
        raise TaskError(KEY, f"names must not be words that mean something, as {name} does")
    return name


# --- the walk -------------------------------------------------------------------------------

_Visit = Callable[[str, str], Any]
"""What stands for a formula, from its text and its place."""


def _formulas(document: Mapping[str, Any]) -> dict[str, str]:
    """All formulas by their places."""
    found: dict[str, str] = {}

    def note(text: str, key: str) -> str:
        found[key] = text
        return text

    _replaced(document, note)
    return found


def _replaced(value: Any, visit: _Visit, key: str = "", word: str = "", depth: int = 0) -> Any:
    """The value with something else for each formula; `word` is the key that it belongs to."""
    if isinstance(value, str):
        plain = word in _WORDED or value in _ALSO.get(word, ())
        return value if plain else visit(value, key)
    if isinstance(value, Mapping):
        _bound(depth)
        dot = f"{key}." if key else ""
        return {
            inner: _replaced(item, visit, f"{dot}{inner}", str(inner), depth + 1)
            for inner, item in value.items()
        }
    if isinstance(value, list | tuple):
        _bound(depth)
        return [
            _replaced(item, visit, f"{key}[{index}]", word, depth + 1)
            for index, item in enumerate(value)
        ]
    return value


def _bound(depth: int) -> None:
    if depth == MAX_DEPTH:
        raise TaskError("task", f"must be nested {MAX_DEPTH} deep or less")
