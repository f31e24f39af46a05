"""Tasks with named numbers that are still open."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from preimage.errors import TaskError, shown
from preimage.task import checks, parameters
from preimage.task.documents import read_document
from preimage.task.examples import named_data
from preimage.task.files import dump_task, name_of
from preimage.task.parse import parse_with
from preimage.task.task import Task


@dataclass(frozen=True, slots=True)
class Template:
    """A task with named numbers that are still open.

    Parameters
    ----------
    document : plain data as a file has it, without `parameters`; formulas are words. It must not
        be changed.
    name : of its tasks, if the document has none.
    parameters : the given values by name, in the file's units and order.

    >>> template = named_template("tight-hole")
    >>> template.task() == template.task(depth=2.5)
    True
    >>> template.task(depth=4).workspace.obstacles[0].points[3]
    (-1.0, -4.0)
    """

    document: Mapping[str, Any] = field(repr=False)
    name: str
    parameters: Mapping[str, float]

    @classmethod
    def of(cls, task: Task) -> Template:
        """The template of a whole task: it has no parameters."""
        return cls(dump_task(task), task.name, {})

    def given(self, /, **values: float) -> Template:
        """The template with other given values.

        Raises
        ------
        TaskError : for an unknown name, and for what is no finite number.
        """
        for name in values:
            if name not in self.parameters:
                hint = checks.suggestion(name, self.parameters)
                rule = f"the task has no such parameter{hint}"
                raise TaskError(f"{parameters.KEY}.{name}", rule)
        changed = {name: parameters.value_of(name, value) for name, value in values.items()}
        return replace(self, parameters={**self.parameters, **changed})

    def task(self, /, **values: float) -> Task:
        """The task with the given values, some replaced by others.

        Raises
        ------
        TaskError : as `given`; and if there is no such task, with the key, and the formula that
            gave its value.
        """
        now = self.given(**values)
        return parse_with(now.document, now.parameters, name=self.name)

    @property
    def digest(self) -> str:
        """Which task this is: the SHA-256 of document and parameters, in hexadecimal digits.

        It does not depend on the order of keys, nor on whether 2 is written as 2.0.

        Raises
        ------
        TaskError : if the document is no plain data.
        """
        whole = {"document": self.document, "parameters": self.parameters}
        try:
            text = json.dumps(_canonical(whole), sort_keys=True, separators=(",", ":"))
        except (TypeError, ValueError, OverflowError, RecursionError):
            raise TaskError("task", "must be mappings, lists, numbers and words") from None
        return hashlib.sha256(text.encode()).hexdigest()


def parse_template(data: object, *, name: str = "task") -> Template:
    """The template that the data describes; without `parameters` it has none.

    Whether the values give a task is not looked at before `Template.task`.

    Raises
    ------
    TaskError : if the data is no mapping, or its parameters are refused.

    >>> parse_template({"version": 1, "friction": "2 * a", "parameters": {"a": 5}}).parameters
    {'a': 5.0}
    """
    if not isinstance(data, Mapping):
        raise TaskError("task", f"must be a mapping, not {shown(data)}")
    document, values = parameters.split(data)
    own = document.get("name")
    return Template(document, own if isinstance(own, str) else name, values)


def load_template(path: str | os.PathLike[str]) -> Template:
    """The template of a file; it is named after the file if it has no name.

    Raises
    ------
    TaskError : if the file cannot be read, or its parameters are refused.
    """
    return parse_template(read_document(path), name=name_of(path))


def named_template(name: str) -> Template:
    """The template of a named task, or of a member of a family.

    Raises
    ------
    TaskError : if there is no such task.
    """
    return parse_template(named_data(name), name=name)


def _canonical(value: Any) -> Any:
    """The value as JSON has it, with one way to write each number."""
    if isinstance(value, Mapping):
        return {word: _canonical(item) for word, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_canonical(item) for item in value]
    if isinstance(value, int) and not isinstance(value, bool):
        return float(value) if float(value) == value else value
    return value
