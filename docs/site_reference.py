"""The reference's pages, one a room, and docstrings as the site shows them."""

from __future__ import annotations

import importlib
import pkgutil
import re
from collections.abc import Iterator
from pathlib import Path

import click

import preimage
from preimage.cli.main import commands

SECTIONS = ("Parameters", "Returns", "Raises", "Notes", "Yields", "Attributes")

_ENTRY = re.compile(r"^(?P<names>[\w*][\w*, .]*?) : (?P<words>.*)$")


_ARRAY = re.compile(
    r"~?(?:numpy\.)?ndarray\[tuple\[[~\w.]*Any, \.\.\.\], [~\w.]*dtype\[~?(?:numpy\.)?(\w+)\]\]"
)
_CODE = re.compile(r"(?<![`:\w\\])`([^`]+)`(?![`_])|\|")


def write_rooms(folder: Path) -> None:
    """Write a page for each room, with all its modules; what is written already stays."""
    folder.mkdir(parents=True, exist_ok=True)
    pages = {f"{room}.rst": _page(room) for room in rooms()}
    for name, text in pages.items():
        _write(folder / name, text)
    for path in folder.glob("*.rst"):
        if path.name not in pages:
            path.unlink()


def rooms() -> list[str]:
    """The rooms of the house, and the modules beside them."""
    found = [module.name for module in pkgutil.iter_modules(preimage.__path__)]
    return [name for name in found if not name.startswith("_") and name != "cli"]


def write_commands(path: Path) -> None:
    """Write what every command says of itself."""
    lines = ["Commands", "========", ""]
    top = click.Context(commands, info_name="preimage")
    lines += _help(commands.get_help(top), "preimage")
    for name in commands.list_commands(top):
        command = commands.get_command(top, name)
        assert command is not None
        text = command.get_help(click.Context(command, info_name=name, parent=top))
        lines += _help(text, f"preimage {name}")
    _write(path, "\n".join(lines))


def _help(text: str, title: str) -> list[str]:
    body = ["    " + line if line else "" for line in click.unstyle(text).splitlines()]
    return [title, "-" * len(title), "", ".. code-block:: text", "", *body, ""]


def _write(path: Path, text: str) -> None:
    """Write what has changed: what has not, the site need not be made of again."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def _page(room: str) -> str:
    names = [f"preimage.{room}"]
    package = importlib.import_module(names[0])
    if hasattr(package, "__path__"):
        inside = pkgutil.iter_modules(package.__path__)
        names += [f"preimage.{room}.{module.name}" for module in inside if not module.ispkg]
    lines = [room, "=" * len(room), ""]
    for name in names:
        if name != names[0]:
            lines += [name.rpartition(".")[2], "-" * len(name.rpartition(".")[2]), ""]
        lines += [f".. automodule:: {name}", ""]
    return "\n".join(lines)


def described(
    app: object, what: str, name: str, thing: object, options: object, lines: list[str]
) -> None:
    """Turn a docstring's sections into rubrics and definitions (a hook of autodoc's)."""
    lines[:] = _described(_code(lines))


def signed(
    app: object,
    what: str,
    name: str,
    thing: object,
    options: object,
    signature: str | None,
    returned: str | None,
) -> tuple[str | None, str | None]:
    """Name arrays by what they hold (a hook of autodoc's)."""

    def shorter(text: str | None) -> str | None:
        return text and _ARRAY.sub(r"array[\1]", text)

    return shorter(signature), shorter(returned)


def _code(lines: list[str]) -> list[str]:
    """The lines with `words` as code, but for sessions; such words may be broken between lines."""
    paragraphs = re.split(r"(\n[ ]*\n)", "\n".join(lines))
    told = [one if ">>>" in one else _CODE.sub(_as_code, one) for one in paragraphs]
    return "".join(told).split("\n")


def _as_code(found: re.Match[str]) -> str:
    return "\\|" if found[0] == "|" else "``" + found[1] + "``"


def _described(lines: list[str]) -> Iterator[str]:
    inside = False
    for place, line in enumerate(lines):
        under = lines[place + 1] if place + 1 < len(lines) else ""
        if line in SECTIONS and set(under) == {"-"}:
            inside = True
            yield from ("", f".. rubric:: {line}", "")
        elif set(line) == {"-"} and lines[place - 1] in SECTIONS:
            continue
        elif inside and (entry := _ENTRY.match(line)):
            names = ", ".join(f"``{name.strip()}``" for name in entry["names"].split(","))
            yield from ("", names, f"    {entry['words']}")
        else:
            inside = inside and (not line or line.startswith(" ") or lines[place - 1] != "")
            yield line
