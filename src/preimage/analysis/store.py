"""Finished cells on disk: what was found once is not lost, and not done again."""

from __future__ import annotations

import json
import os
import sqlite3
from hashlib import sha256
from importlib.metadata import version
from types import TracebackType
from typing import Self

from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.errors import InputError
from preimage.task.options import Method, PlannerOptions
from preimage.task.template import Template

FORMAT = "1"
"""Of the store."""

PATIENCE = 10.0
"""Seconds to wait for another process that writes to the same store."""

_TABLES = """
CREATE TABLE IF NOT EXISTS about (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE IF NOT EXISTS cells (
    cell TEXT PRIMARY KEY, answer TEXT NOT NULL, motions INTEGER, words TEXT NOT NULL
) STRICT;
"""


def digest_of(template: Template, options: PlannerOptions) -> str:
    """Which task it is, and how it is planned.

    The hash of everything that the answers depend on: the task with its parameters, the planner's
    options but the method, which each cell names, and the program's version.
    """
    chosen = Cell.at(Method.COMBINED).task_options(options)
    whole = json.dumps([FORMAT, version("preimage"), template.digest, repr(chosen)])
    return sha256(whole.encode()).hexdigest()


class Store:
    """Cells and their outcomes, in a file of SQLite or, without a path, in memory.

    An outcome is on the disk when `put` returns, whatever happens to this process afterwards.

    Parameters
    ----------
    path : the file, made if it is not there; None for memory.
    digest : whose cells they are, of `digest_of`.

    Raises
    ------
    InputError : the file is no store, or of another task, or cannot be read or written. The same
        from all methods.
    """

    def __init__(self, path: str | os.PathLike[str] | None, digest: str) -> None:
        self._name = ":memory:" if path is None else os.fspath(path)
        self._known: dict[Cell, Outcome] = {}
        try:
            self._base = sqlite3.connect(self._name, timeout=PATIENCE, isolation_level=None)
        except sqlite3.Error as error:
            raise self._refusal(error) from None
        try:
            self._open(digest)
        except sqlite3.Error as error:
            self._base.close()
            raise self._refusal(error) from None
        except BaseException:
            self._base.close()
            raise

    def _open(self, digest: str) -> None:
        self._base.execute("PRAGMA synchronous = FULL")
        held = self._base.execute("SELECT name FROM sqlite_master").fetchall()
        if held and ("about",) not in held:
            raise InputError(self._name, "is a database of something else")
        with self._transaction():
            for statement in _TABLES.split(";"):
                self._base.execute(statement)
            self._base.execute("INSERT OR IGNORE INTO about VALUES ('format', ?)", (FORMAT,))
            self._base.execute("INSERT OR IGNORE INTO about VALUES ('task', ?)", (digest,))
        about = dict(self._base.execute("SELECT key, value FROM about"))
        if about.get("format") != FORMAT:
            raise InputError(self._name, "is a store of another version")
        if about.get("task") != digest:
            rule = "holds another task, other options or another version's results: name another"
            raise InputError(self._name, rule)
        for text, answer, motions, words in self._base.execute("SELECT * FROM cells"):
            self._known[_cell(text)] = Outcome(Answer(answer), motions, words)

    def __len__(self) -> int:
        """How many cells are known."""
        return len(self._known)

    def get(self, cell: Cell) -> Outcome | None:
        """What was found, if it is known."""
        return self._known.get(cell)

    def put(self, cell: Cell, outcome: Outcome) -> None:
        """Keep an outcome."""
        row = (_text(cell), outcome.answer.value, outcome.motions, outcome.words)
        try:
            self._base.execute("INSERT OR REPLACE INTO cells VALUES (?, ?, ?, ?)", row)
        except sqlite3.Error as error:
            raise self._refusal(error) from None
        self._known[cell] = outcome

    def close(self) -> None:
        """Close the file."""
        self._base.close()

    def _transaction(self) -> _Transaction:
        return _Transaction(self._base)

    def _refusal(self, error: sqlite3.Error) -> InputError:
        if isinstance(error, sqlite3.DatabaseError) and "not a database" in str(error):
            return InputError(self._name, "is no store of cells")
        return InputError(self._name, f"the store cannot be used: {error}")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


class _Transaction:
    """All statements inside, or none; other processes wait."""

    def __init__(self, base: sqlite3.Connection) -> None:
        self._base = base

    def __enter__(self) -> None:
        self._base.execute("BEGIN IMMEDIATE")

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self._base.execute("COMMIT" if kind is None else "ROLLBACK")


def _text(cell: Cell) -> str:
    """A cell as the text that names it; numbers to the last digit."""
    return json.dumps([cell.method.value, *cell.values], separators=(",", ":"))


def _cell(text: str) -> Cell:
    method, *values = json.loads(text)
    return Cell(Method(method), tuple((key, float(value)) for key, value in values))
