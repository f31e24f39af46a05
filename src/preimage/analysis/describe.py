"""Budgets and maps in plain words."""

from __future__ import annotations

import math
import textwrap
from collections import Counter
from collections.abc import Iterator

from preimage.analysis.axis import Axis
from preimage.analysis.budget import AxisBudget, Budget, Limit
from preimage.analysis.cell import Answer, Outcome
from preimage.analysis.grid import NONE, UNKNOWN
from preimage.analysis.map import ErrorMap
from preimage.strategy.words import count, number

WIDTH = 98
"""Characters of a line."""

INDENT = 4


def describe_budget(budget: Budget) -> str:
    """A table, one line a bound, and what binds each limit below it."""
    lines = [f"{budget.name}, {budget.method.value}: {outcome_words(budget.given)}", ""]
    rows = [("bound", "given", "plans for", "slack", "motions")]
    rows += [_row(axis) for axis in budget.axes]
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    for row, axis in zip(rows, (None, *budget.axes), strict=True):
        cells = [f"{cell:<{width}}" for cell, width in zip(row[:-1], widths, strict=True)]
        lines += _wrapped(f"{'  '.join(cells)}  ", row[-1])
        for limit in axis.limits if axis is not None else ():
            lines += _wrapped(f"{'':{INDENT}}{_limit_lead(limit)}: ", _cause(limit))
    lines += [
        "",
        *(f"{axis.axis.key} {words}" for axis in budget.axes for words in _found_to(axis)),
    ]
    if budget.given.answer is not Answer.SOLVED:
        lines += ["", _cheapest(budget)]
    lines.append(f"The planner was asked {count(budget.cells, 'time')}.")
    return "\n".join(lines)


def describe_map(found: ErrorMap) -> str:
    """What is on a map: the axes, how many cells have which answer, what that took."""
    motions = Counter(int(value) for value in found.motions.flat)
    lines = [f"{found.name}: {outcome_words(found.given)}", ""]
    for name, axis in (("x", found.x), ("y", found.y)):
        values = count(axis.steps + 1, "value")
        given = with_unit(axis, axis.given)
        lines.append(
            f"{name}  {axis.key}  {number(axis.low)} to {with_unit(axis, axis.high)}, {values};"
            f" given {given}"
        )
    lines.append("")
    plainest = found.plainest
    for needed, cells in sorted(motions.items()):
        if needed in (NONE, UNKNOWN):
            continue
        by = [
            f"{layer.method.value} {int(((plainest == place) & (found.motions == needed)).sum())}"
            for place, layer in enumerate(found.layers)
            if ((plainest == place) & (found.motions == needed)).any()
        ]
        lines.append(f"{count(needed, 'motion')}: {count(cells, 'cell')} ({', '.join(by)})")
    for code, words in ((NONE, "no plan"), (UNKNOWN, "no answer")):
        if motions[int(code)]:
            lines.append(f"{words}: {count(motions[int(code)], 'cell')}")
    lines.append("")
    lines.append(
        f"The planner was asked {count(found.looked_at, 'time')};"
        f" cell by cell it would have been {found.size:,}."
    )
    return "\n".join(lines)


def outcome_words(outcome: Outcome) -> str:
    """The answer for one cell."""
    match outcome.answer:
        case Answer.SOLVED:
            assert outcome.motions is not None
            return f"solved in {count(outcome.motions, 'motion')}"
        case Answer.UNSOLVABLE:
            return "no plan"
        case Answer.TOO_LONG:
            return "no plan of so few motions"
        case Answer.STOPPED:
            return f"no answer: {outcome.words}"
        case Answer.REFUSED:
            return f"no such task: {outcome.words}"


def with_unit(axis: Axis, value: float) -> str:
    """A value of an axis."""
    if math.isinf(value):
        return "no sensor"
    return f"{number(value)}{'°' if axis.unit else ''}"


def slack_words(axis: AxisBudget) -> str:
    """How much larger a bound may be."""
    slack = axis.slack
    if slack is None:
        change = axis.change
        return "-" if change is None else f"needs {with_unit(axis.axis, change)}"
    if math.isinf(slack):
        return "no limit found"
    return f"+{with_unit(axis.axis, slack)}"


def cause_words(limit: Limit) -> str:
    """What binds a limit, in a line."""
    cause = limit.cause
    if not cause.motions:
        return cause.words
    numbers = ", ".join(str(place) for place in cause.motions)
    plural = "s" if len(cause.motions) > 1 else ""
    return f"motion{plural} {numbers} of {cause.of}: {cause.words}"


def _row(axis: AxisBudget) -> tuple[str, str, str, str, str]:
    intervals = [
        f"{number(low)} to {with_unit(axis.axis, high)}" if low < high else number(low)
        for low, high in axis.solved
    ]
    along = "; ".join(_stretches(axis))
    return (
        axis.axis.key,
        with_unit(axis.axis, axis.axis.given),
        ", ".join(intervals) or "no value",
        slack_words(axis),
        along,
    )


def _stretches(axis: AxisBudget) -> Iterator[str]:
    """The number of motions along an axis."""
    for stretch in axis.stretches:
        outcome = stretch.outcome
        short = {
            Answer.SOLVED: str(outcome.motions),
            Answer.UNSOLVABLE: "none",
            Answer.TOO_LONG: "too long",
            Answer.STOPPED: "no answer",
            Answer.REFUSED: "no such task",
        }[outcome.answer]
        yield f"{short} to {with_unit(axis.axis, stretch.high)}"


def _limit_lead(limit: Limit) -> str:
    return f"{number(limit.inside)} | {number(limit.outside)}"


def _cause(limit: Limit) -> str:
    return cause_words(limit)


def _found_to(axis: AxisBudget) -> Iterator[str]:
    step = with_unit(axis.axis, axis.axis.step)
    words = f"to {step}"
    if axis.spacing is not None:
        spacing = with_unit(axis.axis, axis.spacing)
        words += f"; not monotone: sampled every {spacing}, what is narrower may be missed"
    elif axis.unbounded:
        words += "; there is a plan without a position sensor too"
    yield f"{words}."


def _cheapest(budget: Budget) -> str:
    best = budget.cheapest
    if best is None:
        return "No bound by itself can be changed so that there is a plan."
    assert best.change is not None
    value = with_unit(best.axis, best.change)
    given = with_unit(best.axis, best.axis.given)
    return f"The cheapest change that makes a plan: {best.axis.key} {value} instead of {given}."


def _wrapped(lead: str, words: str) -> list[str]:
    room = max(30, WIDTH - len(lead))
    first, *rest = textwrap.wrap(words, room) or [""]
    return [f"{lead}{first}".rstrip(), *(f"{'':{len(lead)}}{line}" for line in rest)]
