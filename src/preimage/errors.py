"""What this package refuses, and in which words: one line with the key, the value and the rule."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Self

import numpy as np

_SHOWN = 40
_LINE = 400


class PreimageError(Exception):
    """Anything this package raises on purpose."""


class InputError(PreimageError):
    """Input that is refused: `key: rule`, on one line.

    Parameters
    ----------
    key : the place of the value, such as `obstacles[2].polygon`, or the path of a file.
    rule : what the value should be and is not, with the value where it helps.

    >>> print(TaskError("obstacles[2].polygon", "edges 3 and 7 cross"))
    obstacles[2].polygon: edges 3 and 7 cross
    """

    def __init__(self, key: str, rule: str) -> None:
        super().__init__(key, rule)
        self.key = key
        self.rule = rule

    def __str__(self) -> str:
        """The refusal, on one line."""
        return one_line(f"{self.key}: {self.rule}" if self.key else self.rule)

    def under(self, prefix: str) -> Self:
        """The same refusal, of a value that lies deeper: `obstacles[2]` before `polygon`."""
        dot = "." if self.key and not self.key.startswith("[") else ""
        return type(self)(f"{prefix}{dot}{self.key}", self.rule)


class TaskError(InputError):
    """A task, or the file of one, that is refused."""


class PlanFileError(InputError):
    """A plan file that is refused."""


class UnsupportedError(InputError):
    """A legal request that this version cannot serve."""


def one_line(text: str) -> str:
    """The text without line breaks and control characters, and not endlessly long.

    >>> one_line("a" + chr(10) + "b")
    'a b'
    """
    line = "".join(character if character.isprintable() else " " for character in text[: _LINE + 1])
    return line if len(text) <= _LINE else line[: _LINE - 1] + "…"


def shown(value: object) -> str:
    """A value, shortened for a refusal.

    >>> shown("poligon"), shown(1.5), shown([1, 2])
    ("'poligon'", '1.5', 'a list of 2')
    """
    if value is None:
        return "nothing"
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, str):
        return repr(value if len(value) <= _SHOWN else value[: _SHOWN - 1] + "…")
    if isinstance(value, int) and value.bit_length() > 64:
        return "a number of too many digits"
    if isinstance(value, int | float | np.integer | np.floating):
        return repr(value.item() if isinstance(value, np.generic) else value)
    if isinstance(value, Mapping):
        return "a mapping"
    if isinstance(value, Sequence | np.ndarray):
        return f"a list of {len(value)}"
    return f"a value of type {type(value).__name__}"
