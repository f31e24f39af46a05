"""One question to the planner: whether there is a plan with these numbers, by this method."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from preimage.analysis.axis import task_at
from preimage.errors import InputError
from preimage.search.limits import too_long
from preimage.search.planner import plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.options import Method, PlannerOptions
from preimage.task.template import Template


class Answer(Enum):
    """How it came out."""

    SOLVED = "solved"
    UNSOLVABLE = "unsolvable"
    TOO_LONG = "too long"  # unsolvable in as many motions as are allowed
    STOPPED = "stopped"  # a limit of regions or of time came first
    REFUSED = "refused"  # there is no such task


@dataclass(frozen=True, slots=True)
class Cell:
    """A question.

    Parameters
    ----------
    values : by key of the task file, sorted, in the file's units.
    """

    method: Method
    values: tuple[tuple[str, float], ...]

    @classmethod
    def at(cls, method: Method, **values: float) -> Cell:
        """The cell with these values."""
        return cls(method, tuple(sorted(values.items())))

    def task_options(self, options: PlannerOptions) -> PlannerOptions:
        """What the planner may do here: guaranteed plans alone count."""
        return replace(options, method=self.method, or_fail=False)


@dataclass(frozen=True, slots=True)
class Outcome:
    """The answer.

    Parameters
    ----------
    motions : of the plan, at most; None without one.
    words : which limit came first, or why the task is refused.
    """

    answer: Answer
    motions: int | None = None
    words: str = ""


def planned(template: Template, options: PlannerOptions, cell: Cell) -> Strategy:
    """What the planner finds in a cell.

    Raises
    ------
    TaskError : the task is refused with these numbers.
    """
    return plan(task_at(template, cell.task_options(options), dict(cell.values)), reasoned=False)


def look(template: Template, options: PlannerOptions, cell: Cell) -> Outcome:
    """The answer for a cell, whatever it is."""
    try:
        strategy = planned(template, options, cell)
    except InputError as error:
        return Outcome(Answer.REFUSED, None, str(error))
    answer = _ANSWERS[strategy.status]
    if strategy.reason == too_long(options.max_steps) and answer is Answer.STOPPED:
        answer = Answer.TOO_LONG
    return Outcome(answer, length(strategy), strategy.reason)


def length(strategy: Strategy) -> int | None:
    """The most motions that a plan may take; None without a plan.

    >>> import preimage
    >>> length(preimage.plan(preimage.named_task("peg-in-hole")))
    2
    """
    if strategy.status is not Status.SOLVED:
        return None
    return max(strategy.region(number).rank for number in strategy.start)


_ANSWERS = {
    Status.SOLVED: Answer.SOLVED,
    Status.UNSOLVABLE: Answer.UNSOLVABLE,
    Status.STOPPED: Answer.STOPPED,
}
