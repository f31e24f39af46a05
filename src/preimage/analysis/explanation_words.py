"""Explanations in plain words."""

from __future__ import annotations

import textwrap

from preimage.analysis.cell import length
from preimage.analysis.describe import WIDTH, with_unit
from preimage.analysis.explanation import Change, Explanation, explained
from preimage.configuration.start import StartKind, start_region
from preimage.strategy.reason import shown_reasons
from preimage.strategy.strategy import Status
from preimage.strategy.words import count, number


def describe_explanation(found: Explanation) -> str:
    """What remains, what stands in the way, what nature does, and what to change."""
    lines = [explained(found.plan.task, found)]
    if found.asked is None:
        motions = length(found.plan) or 0
        lines.append(f"There is a plan of {count(motions, 'motion')}; no plan is shorter.")
        return "\n".join(lines)
    lines += ["", *_paragraph("what remains", _remaining(found))]
    asked = found.asked
    if asked.why:
        for place, words in enumerate(shown_reasons(asked.why)):
            lines += _paragraph("in the way" if place == 0 else "", words)
    else:
        lines += _paragraph("in the way", asked.reason or "what it is, is not known here")
    if found.counter is not None:
        lines += _paragraph("nature", found.counter.words)
    if found.changes:
        what = "make a plan" if found.plan.status is not Status.SOLVED else "make it shorter"
        lines += ["", f"What would {what}, the others as given, the least change first:"]
        lines += [f"  {_change(one)}" for one in found.changes]
    return "\n".join(lines)


def _remaining(found: Explanation) -> str:
    asked = found.asked
    assert asked is not None
    motions = length(found.plan)
    within = f"in {count(motions - 1, 'motion')}" if motions else "by any motions looked at"
    if start_region(asked.task, asked.space).kind is not StartKind.REGION:
        return f"the start, a point, is in no region from which the goal is reached {within}"
    area, contact = found.remaining.area.measure, found.remaining.contact.total_length
    if not area and not contact:
        return f"each place of the start is in some region {within}, but not all of them in one"
    parts = [f"an area of {number(area)}"] if area else []
    parts += [f"contact of length {number(contact)}"] if contact else []
    return f"{' and '.join(parts)} of the start, from which the goal is not reached {within}"


def _change(one: Change) -> str:
    given = with_unit(one.axis, one.axis.given)
    if one.value is None:
        return f"{one.axis.key}: no value of it alone, of those looked at"
    motions = one.outcome.motions if one.outcome is not None else None
    solved = f": {count(motions, 'motion')}" if motions is not None else ""
    return f"{one.axis.key} {with_unit(one.axis, one.value)} instead of {given}{solved}"


def _paragraph(head: str, words: str) -> list[str]:
    lead = f"{head:<14}"
    first, *rest = textwrap.wrap(words, WIDTH - len(lead)) or [""]
    return [f"{lead}{first}", *(f"{'':{len(lead)}}{line}" for line in rest)]
