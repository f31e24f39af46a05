"""Asking the planner many questions, of which each answer says what to ask next."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Protocol, Self

from preimage.analysis.cell import Cell, Outcome, look
from preimage.analysis.store import Store, digest_of
from preimage.jobs import Here, Workforce
from preimage.task.options import PlannerOptions
from preimage.task.task import Task
from preimage.task.template import Template

Progress = Callable[[int, int], None]
"""Told how many cells are known, and how many are wanted so far."""


class Inquiry(Protocol):
    """Something that wants to know cells."""

    def wanted(self) -> Sequence[Cell]:
        """The cells to be looked at next, by what is known; none once it knows enough."""
        ...

    def learn(self, cell: Cell, outcome: Outcome) -> None:
        """Take in the outcome of a cell."""
        ...


@dataclass(slots=True, eq=False)
class Survey:
    """A task, and where its cells are looked at and kept.

    Parameters
    ----------
    template, options : the task, and what the planner may do.
    cancelled : asked after every cell; once it says True, `Cancelled` is raised: what is in the
        store stays.
    used : all cells that were asked for, the same whether they were in the store or not.
    """

    template: Template
    options: PlannerOptions
    workforce: Workforce
    store: Store
    progress: Progress | None = None
    cancelled: Callable[[], bool] | None = None
    used: dict[Cell, Outcome] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        task: Task | Template,
        *,
        workforce: Workforce | None = None,
        store: str | os.PathLike[str] | None = None,
        options: PlannerOptions | None = None,
        progress: Progress | None = None,
        cancelled: Callable[[], bool] | None = None,
    ) -> Self:
        """A survey of a task, by this process and in memory if nothing else is said.

        Parameters
        ----------
        store : a file that keeps the cells; it is made if it is not there.
        options : instead of the task's own.

        Raises
        ------
        InputError : the store is of another task, or cannot be used.

        >>> import preimage
        >>> survey = Survey.of(preimage.named_task("flat-floor"))
        >>> cell = Cell.at(survey.options.method, **{"uncertainty.control": 5.0})
        >>> survey.ask([cell])[cell].motions
        1
        """
        template = task if isinstance(task, Template) else Template.of(task)
        options = options or template.task().options
        kept = Store(store, digest_of(template, options))
        return cls(template, options, workforce or Here(), kept, progress, cancelled)

    def close(self) -> None:
        """Close the store."""
        self.store.close()

    def ask(self, cells: Iterable[Cell]) -> dict[Cell, Outcome]:
        """The outcomes of cells; what is not known is looked at, and kept at once.

        Raises
        ------
        CancelledError : somebody wants no more.
        InputError : the store cannot be written.
        """
        wanted = list(dict.fromkeys(cells))
        found = {cell: known for cell in wanted if (known := self.store.get(cell)) is not None}
        self.used |= found
        unknown = [cell for cell in wanted if cell not in found]
        self._tell(len(unknown))
        work = partial(look, self.template, self.options)
        results = self.workforce.carry_out(work, unknown)
        for left, (place, outcome) in enumerate(results, start=1):
            cell = unknown[place]
            self.store.put(cell, outcome)
            found[cell] = self.used[cell] = outcome
            self._tell(len(unknown) - left)
            if self.cancelled is not None and self.cancelled():
                raise CancelledError(len(self.store))
        return {cell: found[cell] for cell in wanted}

    def settle(self, inquiries: Sequence[Inquiry]) -> None:
        """Ask until all inquiries know enough. Their questions go together, to keep all busy."""
        while any(asked := [list(one.wanted()) for one in inquiries]):
            answers = self.ask(cell for cells in asked for cell in cells)
            for one, cells in zip(inquiries, asked, strict=True):
                for cell in cells:
                    one.learn(cell, answers[cell])

    def _tell(self, left: int) -> None:
        if self.progress is not None:
            self.progress(len(self.used), len(self.used) + left)


class CancelledError(Exception):
    """Somebody wanted no more; so many cells are in the store."""

    def __init__(self, cells: int) -> None:
        super().__init__(cells)
        self.cells = cells
