"""Named tasks, once: for tests, benchmarks, gallery and studio.

A named task is a file in `named/`; its first line, a comment, says in a sentence what it is. A
family makes a task of any size: `comb-12`.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

from preimage.errors import TaskError, shown
from preimage.task import checks
from preimage.task.documents import Format, parse_document
from preimage.task.families import FAMILIES
from preimage.task.parse import parse_task
from preimage.task.task import Task

MAX_SIZE = 100_000
"""Of a task of a family."""

_MEMBER = re.compile(r"([a-z][a-z-]*)-([1-9][0-9]{0,8})")


def named_tasks() -> dict[str, str]:
    """The names of all single tasks, sorted, each with its description.

    >>> named_tasks()["flat-floor"]
    'A segment of a wide flat floor: its preimage is a triangle.'
    """
    return {name: text.partition("\n")[0].lstrip("# ") for name, text in _texts().items()}


def task_families() -> dict[str, str]:
    """The names of all families, sorted, each with its description; a task is `name-size`."""
    return {
        name: " ".join((build.__doc__ or "").partition("\n\n")[0].split())
        for name, build in sorted(FAMILIES.items())
    }


def named_task_text(name: str) -> str:
    """The file of a single task, as it was written."""
    texts = _texts()
    if name not in texts:
        hint = checks.suggestion(name, [*texts, *(f"{family}-12" for family in FAMILIES)])
        raise TaskError("example", f"{shown(name)} is no named task{hint}")
    return texts[name]


def named_task(name: str) -> Task:
    """A task by its name, or by its family's name and a size.

    Raises
    ------
    TaskError : if there is no such task.

    >>> named_task("comb-2").name
    'comb-2'
    """
    return parse_task(named_data(name), name=name)


def named_data(name: str) -> object:
    """The plain data of a named task, or of a member of a family.

    Raises
    ------
    TaskError : if there is no such task.
    """
    member = _MEMBER.fullmatch(name)
    if member and member[1] in FAMILIES:
        size = int(member[2])
        if size > MAX_SIZE:
            raise TaskError("example", f"the size must be at most {MAX_SIZE}, not {size}")
        return FAMILIES[member[1]](size)
    return parse_document(named_task_text(name), Format.YAML, name)


@cache
def _texts() -> dict[str, str]:
    folder = files("preimage.task") / "named"
    found = {
        entry.name.removesuffix(".yaml"): entry.read_text(encoding="utf-8")
        for entry in folder.iterdir()
        if entry.name.endswith(".yaml")
    }
    return dict(sorted(found.items()))
