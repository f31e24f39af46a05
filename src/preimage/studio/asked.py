"""Why there is no plan, and how large errors may be: as a page shows them."""

from __future__ import annotations

from typing import Any

from preimage.analysis.axis import Axis
from preimage.analysis.budget import AxisBudget, budget
from preimage.analysis.cell import Answer
from preimage.analysis.describe import cause_words, describe_budget, slack_words, with_unit
from preimage.analysis.explanation import Change, explain
from preimage.analysis.explanation_words import describe_explanation
from preimage.analysis.survey import Survey
from preimage.configuration.contact import ContactSpace
from preimage.errors import InputError, shown
from preimage.strategy.reason import Reason
from preimage.strategy.strategy import Strategy
from preimage.studio.plain import degrees_of, finite, points_of, region_of
from preimage.studio.planned import finding_of, plan_view
from preimage.studio.questions import Body, Tell
from preimage.studio.requests import flag, task_of
from preimage.task.task import Task

Plain = dict[str, Any]

MOST_BOUNDS = 16


def explained(body: Body, tell: Tell) -> Body:
    """Why there is no plan, or no shorter one; and which single bound would have to be better."""
    survey = _survey(task_of(body), tell)
    found = explain(survey, _bounds(body), budgeted=flag(body, "budgeted", False))
    asked = found.asked
    contact = found.plan.space.contact
    return {
        "words": describe_explanation(found).splitlines(),
        "plan": plan_view(found.plan),
        "reasons": [] if asked is None else [_reason(why, asked) for why in asked.why],
        "remaining": region_of(found.remaining, contact),
        "counter": None if found.counter is None else finding_of(found.counter),
        "changes": [_change(one) for one in found.changes],
    }


def _survey(task: Task, tell: Tell) -> Survey:
    return Survey.of(task, progress=lambda done, total: tell({"done": done, "total": total}))


def _bounds(body: Body) -> list[str] | None:
    """Which bounds are asked about; None for all of them.

    Raises
    ------
    InputError : it is no list of names.
    """
    names = body.get("bounds")
    if names is None:
        return None
    if not isinstance(names, list) or not 0 < len(names) <= MOST_BOUNDS:
        raise InputError("bounds", f"must be a list of names, not {shown(names)}")
    for place, name in enumerate(names):
        if not isinstance(name, str):
            raise InputError(f"bounds[{place}]", f"must be a name, not {shown(name)}")
    return names


def _reason(why: Reason, strategy: Strategy) -> Plain:
    """One thing that stands in the way, with the places it speaks of."""
    contact = strategy.space.contact
    return {
        "kind": why.kind.value,
        "words": why.words,
        "direction": degrees_of(why.direction),
        "origin": None if why.origin is None else points_of([why.origin])[0],
        "place": None if why.place is None else points_of([why.place])[0],
        "features": [
            shape
            for feature in (why.feature, why.other)
            if (shape := _feature(feature, contact)) is not None
        ],
    }


def _feature(feature: int | None, contact: ContactSpace) -> list[list[float]] | None:
    """An edge as its ends, a vertex as its place; None for free space."""
    count = len(contact)
    if feature is None or feature >= 2 * count:
        return None
    if feature >= count:
        return points_of(contact.points[feature - count][None])
    return [points_of(ends[feature][None])[0] for ends in (contact.points, contact.ends)]


def _change(one: Change) -> Plain:
    motions = None if one.outcome is None else one.outcome.motions
    return {
        **_axis(one.axis),
        "needed": finite(one.value),
        "motions": motions,
        "words": "no value of it alone"
        if one.value is None
        else f"{with_unit(one.axis, one.value)} instead of {with_unit(one.axis, one.axis.given)}",
    }


def _axis(axis: Axis) -> Plain:
    return {
        "bound": axis.name,
        "key": axis.key,
        "unit": axis.unit,
        "given": finite(axis.given),
        "low": axis.low,
        "high": axis.high,
        "monotone": axis.monotone,
    }


def budgeted(body: Body, tell: Tell) -> Body:
    """For each bound, the others as given, how large it may be."""
    found = budget(_survey(task_of(body), tell), _bounds(body))
    return {
        "words": describe_budget(found).splitlines(),
        "axes": [_axis_budget(one) for one in found.axes],
    }


def _axis_budget(one: AxisBudget) -> Plain:
    return {
        **_axis(one.axis),
        "slack": slack_words(one),
        "solved": [list(interval) for interval in one.solved],
        "steps": [
            {
                "from": stretch.low,
                "to": stretch.high,
                "motions": stretch.outcome.motions
                if stretch.outcome.answer is Answer.SOLVED
                else None,
                "answer": stretch.outcome.answer.value,
            }
            for stretch in one.stretches
        ],
        "limits": [
            {
                "inside": limit.inside,
                "outside": limit.outside,
                "words": cause_words(limit),
            }
            for limit in one.limits
        ],
        "spacing": one.spacing,
    }
