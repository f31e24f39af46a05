"""From text to plain data: YAML, JSON and TOML without what hides or repeats values.

Plain data: mappings with words as keys, lists, numbers, words, truth values, nothing. Refused are
aliases, anchors, tags, merge keys, repeated keys, deep nesting, and more than can be looked at.
"""

from __future__ import annotations

import json
import math
import os
import re
import stat
import tomllib
from collections.abc import Callable, Iterator
from enum import Enum
from pathlib import Path
from typing import Any, NoReturn

import yaml

from preimage.errors import TaskError, one_line, shown

MAX_BYTES = 64 * 2**20
"""Size of a file."""

MAX_DEPTH = 20
"""Levels of mappings and lists; a task needs six."""

MAX_MARKS = 10_000_000
"""Brackets, commas and line ends: data takes up to 100 bytes of memory for each."""


class Format(Enum):
    """A way to write a task, by the endings of its files."""

    YAML = (".yaml", ".yml")
    JSON = (".json",)
    TOML = (".toml",)

    @classmethod
    def of(cls, path: str | os.PathLike[str]) -> Format:
        """The format that a path's ending says."""
        ending = Path(path).suffix.lower()
        for member in cls:
            if ending in member.value:
                return member
        raise TaskError(str(path), f"must end in .yaml, .json or .toml, not {shown(ending)}")


def read_document(path: str | os.PathLike[str]) -> object:
    """The plain data of a file.

    Raises
    ------
    TaskError : if it cannot be read; the key is the path.
    """
    kind = Format.of(path)
    try:
        with open(path, "rb", opener=_open_regular) as file:
            content = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise TaskError(str(path), f"cannot be read: {reason}") from None
    if len(content) > MAX_BYTES:
        raise TaskError(str(path), f"must be {MAX_BYTES // 2**20} MiB or less")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise TaskError(str(path), f"is not UTF-8 at byte {error.start}") from None
    del content
    return parse_document(text, kind, str(path))


def parse_document(text: str, kind: Format, key: str = "task") -> object:
    """The plain data of a text; `key` names the text in refusals."""
    if not text.strip():
        raise TaskError(key, "is empty")
    if sum(text.count(mark) for mark in "[{,\n") > MAX_MARKS:
        raise TaskError(key, f"must have {MAX_MARKS} values or fewer")
    return _PARSERS[kind](text, key)


def _open_regular(path: str, flags: int) -> int:
    """Open a regular file, and wait for no other."""
    file = os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
    mode = os.fstat(file).st_mode
    if not stat.S_ISREG(mode):
        os.close(file)
        raise OSError(None, "Is a directory" if stat.S_ISDIR(mode) else "Is no regular file")
    return file


# --- JSON and TOML --------------------------------------------------------------------------


def _parse_json(text: str, key: str) -> object:
    def pairs(entries: list[tuple[str, object]]) -> dict[str, object]:
        mapping = dict(entries)
        if len(mapping) < len(entries):
            seen: set[str] = set()
            for word, _ in entries:
                if word in seen:
                    raise TaskError(key, f"key {shown(word)} is repeated")
                seen.add(word)
        return mapping

    def constant(word: str) -> NoReturn:
        raise TaskError(key, f'{word} is not JSON; "inf" is infinity')

    try:
        data = json.loads(text, object_pairs_hook=pairs, parse_constant=constant)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise TaskError(key, f"is not JSON at {where}: {error.msg}") from None
    except RecursionError:
        raise _too_deep(key) from None
    except ValueError:
        raise TaskError(key, "has a number of too many digits") from None
    return _checked_depth(data, key)


_DOTTED = re.compile(
    rf"""(?<![\w-])(?:(?:[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*\.[ \t]*){{{MAX_DEPTH}}}"""
)


def _parse_toml(text: str, key: str) -> object:
    if _DOTTED.search(text):
        # The parser's time and memory are quadratic in the dots.
        raise _too_deep(key)
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise _too_deep(key) from None
    except tomllib.TOMLDecodeError as error:
        raise TaskError(key, f"is not TOML: {one_line(str(error))}") from None
    except ValueError:
        raise TaskError(key, "has a number of too many digits") from None
    return _checked_depth(data, key)


def _too_deep(key: str) -> TaskError:
    return TaskError(key, f"must be nested {MAX_DEPTH} deep or less")


def _checked_depth(data: object, key: str) -> object:
    level = [data]
    for _ in range(MAX_DEPTH):
        level = [
            inner
            for outer in level
            if isinstance(outer, dict | list)
            for inner in (outer.values() if isinstance(outer, dict) else outer)
            if isinstance(inner, dict | list)
        ]
        if not level:
            return data
    raise _too_deep(key)


# --- YAML -----------------------------------------------------------------------------------

_WHOLE = re.compile(r"[-+]?[0-9]+")
_DECIMAL = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_WORDS: dict[str, object] = {
    "true": True,
    "false": False,
    "null": None,
    "~": None,
    "": None,
    ".inf": math.inf,
    "+.inf": math.inf,
    "-.inf": -math.inf,
    ".nan": math.nan,
}
_MAX_DIGITS = 400
_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def _parse_yaml(text: str, key: str) -> object:
    try:
        return _built(yaml.parse(text, Loader=_LOADER), key)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        where = f" at {_line(mark)}, column {mark.column + 1}" if mark else ""
        raise TaskError(key, f"is not YAML{where}: {error.problem or error.context}") from None
    except (yaml.YAMLError, UnicodeEncodeError) as error:
        raise TaskError(key, f"is not YAML: {one_line(str(error))}") from None


def _built(events: Iterator[Any], key: str) -> object:
    """The one document of a stream of events, built without recursion."""
    document: object = None
    documents = 0
    open_: list[list[object] | dict[str, object]] = []
    words: list[str | None] = []  # of each open mapping, the key that waits for its value
    for event in events:
        kind = type(event)
        if kind is yaml.ScalarEvent:
            value: Any = _scalar(event, key)
        elif kind is yaml.SequenceStartEvent:
            value = []
        elif kind is yaml.MappingStartEvent:
            value = {}
        elif kind is yaml.SequenceEndEvent or kind is yaml.MappingEndEvent:
            open_.pop()
            words.pop()
            continue
        else:
            documents += kind is yaml.DocumentStartEvent
            _refuse_event(event, documents, key)
            continue
        if event.anchor is not None or event.tag is not None:
            raise _marked(event, key)
        if not open_:
            document = value
        elif isinstance(outer := open_[-1], list):
            outer.append(value)
        elif (word := words[-1]) is not None:
            outer[word] = value
            words[-1] = None
        else:
            words[-1] = _new_word(event, outer, key)
        if kind is not yaml.ScalarEvent:
            if len(open_) == MAX_DEPTH:
                raise _too_deep(key)
            open_.append(value)
            words.append(None)
    return document


def _new_word(event: Any, mapping: dict[str, object], key: str) -> str:
    """The key that an event is, new in its mapping."""
    if type(event) is not yaml.ScalarEvent:
        raise TaskError(key, f"has a key that is no word at {_line(event.start_mark)}")
    word: str = event.value
    if word == "<<" and event.implicit[0]:
        raise TaskError(key, f"has a merge key at {_line(event.start_mark)}: write the keys out")
    if word in mapping:
        raise TaskError(key, f"key {shown(word)} is repeated at {_line(event.start_mark)}")
    return word


def _refuse_event(event: Any, documents: int, key: str) -> None:
    if type(event) is yaml.AliasEvent:
        raise TaskError(key, f"has an alias at {_line(event.start_mark)}: write the value out")
    if documents > 1:
        raise TaskError(key, f"has a second document at {_line(event.start_mark)}")


def _marked(event: Any, key: str) -> TaskError:
    if event.anchor is not None:
        return TaskError(key, f"has an anchor at {_line(event.start_mark)}: write the value out")
    return TaskError(key, f"has a tag at {_line(event.start_mark)}: values are plain")


def _line(mark: Any) -> str:
    return f"line {mark.line + 1}"


def _scalar(event: Any, key: str) -> object:
    """What a scalar means: numbers are decimal, with or without an exponent."""
    text: str = event.value
    if not event.implicit[0]:
        return text
    if text in _WORDS:
        return _WORDS[text]
    if text[0] in "+-.0123456789" and _DECIMAL.fullmatch(text):
        if len(text) > _MAX_DIGITS:
            raise TaskError(key, f"has too many digits at {_line(event.start_mark)}")
        return int(text) if _WHOLE.fullmatch(text) else float(text)
    return text


_PARSERS: dict[Format, Callable[[str, str], object]] = {
    Format.YAML: _parse_yaml,
    Format.JSON: _parse_json,
    Format.TOML: _parse_toml,
}
