"""Why there is no strategy, or none of fewer motions; and which bound would have to be better."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce

from preimage.analysis.axis import Axis
from preimage.analysis.budget import AxisBudget, budget
from preimage.analysis.cell import Answer, Outcome, length
from preimage.analysis.counter import counter_strategy
from preimage.analysis.survey import Survey
from preimage.configuration import contact_set
from preimage.configuration.region import Region
from preimage.configuration.start import StartKind, start_region
from preimage.display import Shown
from preimage.geometry import area as areas
from preimage.geometry.overlay import united
from preimage.preimages.setting import Setting
from preimage.preimages.starts import start_as_region
from preimage.search.limits import too_long
from preimage.search.planner import plan
from preimage.search.reasons import reasons
from preimage.strategy.strategy import Strategy
from preimage.task.options import Continuous, Termination
from preimage.task.task import Task
from preimage.verification.verdict import Finding

MOST_TRIED = 4
"""For so many directions, the most promising ones, it is asked what nature does."""


@dataclass(frozen=True, slots=True)
class Change:
    """What one bound would have to be.

    Parameters
    ----------
    value : the nearest one that makes a plan, or a shorter one; None if no value of this bound
        alone is known to.
    outcome : the answer there.
    """

    axis: Axis
    value: float | None
    outcome: Outcome | None = None

    @property
    def effort(self) -> float:
        """How large the change is, as a part of what is given."""
        if self.value is None:
            return math.inf
        away, given = abs(self.value - self.axis.given), abs(self.axis.given)
        return away / given if given > 0.0 and math.isfinite(away) else math.inf


@dataclass(frozen=True, slots=True, eq=False)
class Explanation(Shown):
    """Why a task has no plan, or no shorter one.

    Parameters
    ----------
    plan : what the planner finds for the task as it is.
    asked : what it finds with one motion less than the plan has, if there is a plan of two or more;
        else the same. None if the plan has at most one motion: then there is nothing to explain.
    remaining : the part of the start that no region of `asked` holds.
    counter : what nature may do to the most promising motion from there; None if it is not known.
    changes : what each bound would have to be, the least change first; empty if it was not asked.
    """

    plan: Strategy
    asked: Strategy | None
    remaining: Region
    counter: Finding | None
    changes: tuple[Change, ...]


def explain(
    survey: Survey, bounds: Sequence[str] | None = None, *, budgeted: bool = True
) -> Explanation:
    """Why there is no strategy, or why the one found needs that many motions.

    Parameters
    ----------
    survey : of the task; its workforce makes the budget.
    bounds : which are asked for their cheapest change; all by default.
    budgeted : whether to look for changes at all: that takes a hundred plans.

    Raises
    ------
    InputError : a bound that the task has not; what the planner refuses.
    CancelledError : somebody wants no more.

    >>> import preimage
    >>> survey = Survey.of(preimage.named_task("peg-in-hole"))
    >>> found = explain(survey, budgeted=False)
    >>> found.asked.why[0].kind.value
    'trap'
    """
    task = replace(survey.template.task(), options=survey.options)
    made = plan(task)
    motions = length(made)
    asked = made
    if motions is not None:
        if motions <= 1:
            return Explanation(made, None, Region.empty(), None, ())
        fewer = replace(task.options, max_steps=motions - 1)
        asked = plan(replace(task, options=fewer), reasoned=False)
    if asked.reason == too_long(asked.task.options.max_steps):
        asked = _within(asked)
    counter = _counter(asked)
    changes: tuple[Change, ...] = ()
    if budgeted:
        table = budget(survey, bounds)
        needed = [_change(axis, motions) for axis in table.axes]
        changes = tuple(sorted(needed, key=lambda one: one.effort))
    return Explanation(made, asked, remaining(asked), counter, changes)


def _within(strategy: Strategy) -> Strategy:
    """The same, with what stands in the way of as many motions as are allowed, and of no more.

    The last motion of all that is allowed leads to what takes one motion less.
    """
    options = strategy.task.options
    if options.termination is not Termination.INSTANTANEOUS or isinstance(
        options.directions, Continuous
    ):
        return strategy
    nearer = [one for one in strategy.regions if one.rank < options.max_steps]
    start = start_region(strategy.task, strategy.space)
    why = reasons(
        Setting.of(strategy.task, strategy.space), start, nearer, options.directions,
        options.method, options.strategy,
    )  # fmt: skip
    return replace(strategy, why=why)


def _counter(strategy: Strategy) -> Finding | None:
    """What nature does to the most promising motion to which it does anything."""
    tried: list[float | None] = []
    for why in strategy.why:
        if why.direction not in tried[:MOST_TRIED] and len(tried) < MOST_TRIED:
            tried.append(why.direction)
            found = counter_strategy(strategy, why)
            if found is not None:
                return found
    return None


def remaining(strategy: Strategy) -> Region:
    """The part of the start that no region of a strategy holds.

    A start that is one point is a square of some tolerances around it.
    """
    space, task = strategy.space, strategy.task
    start = start_region(task, space)
    regions = [one.region for one in strategy.regions]
    if start.kind is not StartKind.REGION:
        return start_as_region(start, space)
    near = space.tolerance.length
    contact = reduce(
        lambda rest, one: contact_set.difference(rest, one.contact, near),
        regions,
        start.region.contact,
    )
    area = start.region.area
    held = united([one.area for one in regions], space.tolerance.grid)
    if not (area.is_empty or held.is_empty):
        area = areas.regularised(areas.difference(area, held), near)
    return Region(area, contact)


def _change(axis: AxisBudget, motions: int | None) -> Change:
    """The nearest value that makes a plan, or one of fewer motions than there are."""
    best = Change(axis.axis, None)
    for stretch in axis.stretches:
        outcome = stretch.outcome
        if outcome.answer is not Answer.SOLVED or outcome.motions is None:
            continue
        if motions is not None and outcome.motions >= motions:
            continue
        for value in (stretch.low, stretch.high):
            one = Change(axis.axis, value, outcome)
            if best.value is None or one.effort < best.effort:
                best = one
    return best


def explained(task: Task, found: Explanation) -> str:
    """The question that was answered, in words."""
    motions = length(found.plan)
    if motions is None:
        return f"{task.name}: why there is no plan"
    if found.asked is None:
        return f"{task.name}: there is nothing to explain"
    return f"{task.name}: why a plan takes {motions} motions"
