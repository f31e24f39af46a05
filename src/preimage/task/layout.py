"""From plain data to text, the same bytes each time: what is short stays on one line."""

from __future__ import annotations

import json
import re
from collections.abc import Callable

from preimage.task.documents import Format

_WIDTH = 90
_SHORT = 16
"""Values that may share a line."""

_PLAIN = re.compile(r"[a-z][a-z-]*")
_RESERVED = {"true", "false", "null", "yes", "no", "on", "off", "y", "n"}


def format_document(data: dict[str, object], kind: Format) -> str:
    """The text of plain data: mappings, lists, numbers and words."""
    return "\n".join(_LAYOUTS[kind](data)) + "\n"


def _yaml(value: object) -> list[str]:
    """The block style, flow style where it fits on a line."""
    lines: list[str] = []
    if isinstance(value, dict):
        for word, inner in value.items():
            short = _flow(inner, Format.YAML)
            if short is not None:
                lines.append(f"{word}: {short}")
            else:
                lines += [f"{word}:", *(f"  {line}" for line in _yaml(inner))]
    else:
        assert isinstance(value, list)
        for inner in value:
            short = _flow(inner, Format.YAML)
            block = [short] if short is not None else _yaml(inner)
            lines += [f"{'  ' if index else '- '}{line}" for index, line in enumerate(block)]
    return lines


def _json(value: object) -> list[str]:
    short = _flow(value, Format.JSON)
    if short is not None:
        return [short]
    if isinstance(value, dict):
        blocks = [
            [f"{json.dumps(word)}: {first}", *rest]
            for word, (first, *rest) in ((word, _json(inner)) for word, inner in value.items())
        ]
        opening, closing = "{", "}"
    else:
        assert isinstance(value, list)
        blocks = [_json(inner) for inner in value]
        opening, closing = "[", "]"
    for block in blocks[:-1]:
        block[-1] += ","
    return [opening, *(f"  {line}" for block in blocks for line in block), closing]


def _toml(data: object) -> list[str]:
    """Plain keys first, then the tables."""
    assert isinstance(data, dict)
    tables = {word: inner for word, inner in data.items() if _is_table(inner)}
    lines = _toml_entries({word: data[word] for word in data if word not in tables})
    for word, inner in tables.items():
        header = f"[{word}]" if isinstance(inner, dict) else f"[[{word}]]"
        for table in [inner] if isinstance(inner, dict) else inner:
            lines += ["", header, *_toml_entries(table)]
    return lines


def _is_table(value: object) -> bool:
    return isinstance(value, dict) or (
        isinstance(value, list) and bool(value) and isinstance(value[0], dict)
    )


def _toml_entries(data: dict[str, object]) -> list[str]:
    lines: list[str] = []
    for word, value in data.items():
        # Lists are written as in JSON, tables in tables on one line.
        block = [_table_line(value)] if isinstance(value, dict) else _json(value)
        lines += [f"{word} = {block[0]}", *block[1:]]
    return lines


def _table_line(value: dict[str, object]) -> str:
    entries = (f"{word} = {' '.join(_json(inner))}" for word, inner in value.items())
    return f"{{ {', '.join(entries)} }}"


def _flow(value: object, kind: Format) -> str | None:
    """The value on one line, if it fits."""
    if isinstance(value, dict | list) and not _is_small(value):
        return None
    line = _line(value, kind)
    return line if len(line) <= _WIDTH or not isinstance(value, dict | list) else None


def _is_small(value: dict[str, object] | list[object]) -> bool:
    if len(value) > _SHORT:
        return False
    inner = value.values() if isinstance(value, dict) else value
    nested = [item for item in inner if isinstance(item, dict | list)]
    return len(nested) <= _SHORT // 2 and all(_is_small(item) for item in nested)


def _line(value: object, kind: Format) -> str:
    if isinstance(value, dict):
        entries = (f"{_word(word, kind)}: {_line(inner, kind)}" for word, inner in value.items())
        return f"{{{', '.join(entries)}}}"
    if isinstance(value, list):
        return f"[{', '.join(_line(inner, kind) for inner in value)}]"
    if isinstance(value, str):
        return _word(value, kind)
    return json.dumps(value)


def _word(value: str, kind: Format) -> str:
    if kind is Format.YAML and _PLAIN.fullmatch(value) and value not in _RESERVED:
        return value
    return json.dumps(value, ensure_ascii=False)


_LAYOUTS: dict[Format, Callable[[object], list[str]]] = {
    Format.YAML: _yaml,
    Format.JSON: _json,
    Format.TOML: _toml,
}
