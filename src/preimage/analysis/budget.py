"""Error budgets: for each bound, how large it may be while a guaranteed strategy exists."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from preimage.analysis.axis import Axis, Range, axis_of, default_bounds
from preimage.analysis.cause import Cause, cause_of
from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.analysis.ladder import Ladder
from preimage.analysis.survey import Survey
from preimage.display import Shown
from preimage.errors import InputError
from preimage.task.options import Method

DIGITS = 12
"""Of a difference of decimal numbers."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """Values between which the answer is the same.

    Parameters
    ----------
    low, high : the first and the last value looked at that has it.
    """

    low: float
    high: float
    outcome: Outcome


@dataclass(frozen=True, slots=True)
class Limit:
    """Where plans end: the last value that has one, and the first that has none.

    Parameters
    ----------
    inside, outside : neighbours, one step of the axis apart; `outside` is the larger or the
        smaller one.
    cause : which motion and which feature bind.
    """

    inside: float
    outside: float
    cause: Cause


@dataclass(frozen=True, slots=True)
class AxisBudget:
    """What may become of one bound, the others being as given.

    Parameters
    ----------
    given : the answer for the task as it is.
    stretches : from the axis' low end to its high end, ascending.
    limits : where plans begin or end, ascending.
    spacing : for an axis that is not monotone, how far the samples are apart: what is narrower may
        have been missed. None where nothing can be missed.
    unbounded : there is still a plan without any position sensor.
    """

    axis: Axis
    given: Outcome
    stretches: tuple[Stretch, ...]
    limits: tuple[Limit, ...]
    spacing: float | None = None
    unbounded: bool = False

    @property
    def solved(self) -> tuple[tuple[float, float], ...]:
        """The intervals in which there is a plan, ascending, and disjoint."""
        found: list[tuple[float, float]] = []
        last = None
        for stretch in self.stretches:
            if stretch.outcome.answer is Answer.SOLVED:
                if last is not None and last.outcome.answer is Answer.SOLVED:
                    found[-1] = (found[-1][0], stretch.high)
                else:
                    found.append((stretch.low, stretch.high))
            last = stretch
        return tuple(found)

    @property
    def slack(self) -> float | None:
        """How much larger the bound may be than given; None if there is no plan as given.

        Infinite if nothing limits it.
        """
        if self.given.answer is not Answer.SOLVED:
            return None
        if self.unbounded:
            return math.inf
        for low, high in self.solved:
            if low <= self.axis.given <= high:
                return math.inf if high == self.axis.high else round(high - self.axis.given, DIGITS)
        return 0.0

    @property
    def change(self) -> float | None:
        """The nearest value with a plan, where there is none as given; None if none is known."""
        if self.given.answer is Answer.SOLVED:
            return None
        ends = [end for interval in self.solved for end in interval]
        return min(ends, key=lambda end: (abs(end - self.axis.given), end), default=None)


@dataclass(frozen=True, slots=True, eq=False)
class Budget(Shown):
    """How much error a task bears, bound by bound.

    Parameters
    ----------
    name : of the task.
    axes : what is known of each bound, in the order in which they were asked for.
    cells : how often the planner was asked.
    """

    name: str
    method: Method
    given: Outcome
    axes: tuple[AxisBudget, ...]
    cells: int

    @property
    def cheapest(self) -> AxisBudget | None:
        """The bound that has to change least for a plan, as a part of what it is."""
        found = [one for one in self.axes if one.change is not None]
        return min(found, key=_effort, default=None)


def budget(
    survey: Survey,
    bounds: Sequence[str] | None = None,
    *,
    ranges: Mapping[str, Range] | None = None,
    resolutions: Mapping[str, float] | None = None,
) -> Budget:
    """For each bound, with the others as given, the values for which a strategy exists.

    A monotone bound is bisected, for every number of motions, to one step of its axis. One that is
    not monotone is sampled, and bisected between samples that differ.

    Parameters
    ----------
    bounds : words of `Bound` and names of parameters; all that the task has by default.
    ranges, resolutions : by bound, in the file's units; see `axis_of`.

    Raises
    ------
    InputError : a bound that the task has not, or a range that makes no sense.
    CancelledError : somebody wants no more.
    """
    ranges, resolutions = ranges or {}, resolutions or {}
    names = list(dict.fromkeys(bounds or default_bounds(survey.template)))
    if stray := [name for name in (*ranges, *resolutions) if name not in names]:
        raise InputError(stray[0], "has a range or a resolution, but is not asked for")
    template, method = survey.template, survey.options.method
    axes = [axis_of(template, name, ranges.get(name), resolutions.get(name)) for name in names]
    as_given = Cell.at(method)
    given = survey.ask([as_given])[as_given]
    ladders = [Ladder(axis, method) for axis in axes]
    survey.settle(ladders)
    found = tuple(_of_axis(survey, ladder, given) for ladder in ladders)
    return Budget(template.task().name, method, given, found, len(survey.used))


def _of_axis(survey: Survey, ladder: Ladder, given: Outcome) -> AxisBudget:
    axis = ladder.axis
    stretches = tuple(
        Stretch(axis.value(low), axis.value(high), outcome)
        for low, high, outcome in ladder.stretches
    )
    limits = []
    for before, after in pairwise(stretches):
        ends = [stretch.outcome.answer is Answer.SOLVED for stretch in (before, after)]
        if ends[0] == ends[1]:
            continue
        inside, outside = (before.high, after.low) if ends[0] else (after.low, before.high)
        cause = cause_of(
            survey.template,
            survey.options,
            ladder.cell_of(inside),
            ladder.cell_of(outside),
        )
        limits.append(Limit(inside, outside, cause))
    spacing = None if axis.monotone else axis.step * ladder.spacing
    return AxisBudget(axis, given, stretches, tuple(limits), spacing, ladder.unbounded)


def _effort(axis: AxisBudget) -> tuple[float, str]:
    """How large a change is, beside what is given."""
    assert axis.change is not None
    away = abs(axis.change - axis.axis.given)
    size = abs(axis.axis.given)
    if not math.isfinite(away):  # any sensor instead of none is as much as can be asked for
        return math.inf, axis.axis.name
    return (away / size if size > 0.0 else math.inf), axis.axis.name
