"""Plans as a page shows them: made, read, proven, and with their slack."""

from __future__ import annotations

import math
import time
from typing import Any

from preimage.search.limits import Progress
from preimage.search.margins import margins
from preimage.search.planner import plan
from preimage.strategy.describe import describe, describe_condition
from preimage.strategy.margins import Margins
from preimage.strategy.plan_file import plan_to_dict
from preimage.strategy.reason import shown_reasons
from preimage.strategy.strategy import Strategy, StrategyRegion
from preimage.studio.plain import degrees_of, finite, points_of, region_of
from preimage.studio.questions import Body, Tell
from preimage.studio.requests import drawable, strategy_of, task_of
from preimage.verification.describe import describe_verification
from preimage.verification.verdict import Finding, Verdict
from preimage.verification.verify import verify

Plain = dict[str, Any]

EVERY = 0.1
"""Seconds between two reports of how far a search has come."""


def new_plan(body: Body, tell: Tell) -> Body:
    """A strategy for a task, or why there is none."""
    told = [-math.inf]

    def progress(now: Progress) -> None:
        if time.monotonic() - told[0] >= EVERY:
            told[0] = time.monotonic()
            tell({"regions": now.regions, "seconds": round(now.seconds, 3)})

    return plan_view(plan(task_of(body), progress=progress))


def plan_file(body: Body, tell: Tell) -> Body:
    """A plan that somebody kept in a file."""
    return plan_view(strategy_of(body))


def plan_view(strategy: Strategy) -> Plain:
    """All that a page shows of a plan."""
    drawable(strategy.space)
    return {
        "plan": plan_to_dict(strategy),
        "status": strategy.status.value,
        "reason": strategy.reason,
        "words": describe(strategy).splitlines(),
        "regions": [_region(region, strategy) for region in strategy.regions],
        "start": list(strategy.start),
        "steps": list(strategy.steps),
        "linear": strategy.kind.value == "linear",
        "why": list(shown_reasons(strategy.why)),
        "statistics": {
            "regions": strategy.statistics.regions,
            "seconds": round(strategy.statistics.seconds, 3),
        },
    }


def _region(region: StrategyRegion, strategy: Strategy) -> Plain:
    contact, motion = strategy.space.contact, region.motion
    shown = {
        "id": region.id,
        "rank": region.rank,
        "failure": region.failure,
        "region": region_of(region.region, contact),
    }
    if motion is None:
        nothing: Plain = {
            "direction": None,
            "goals": [],
            "target": None,
            "conditions": [],
            "margin": None,
        }
        return {**shown, **nothing}
    return {
        **shown,
        "direction": degrees_of(motion.direction),
        "goals": list(motion.goals),
        "target": region_of(motion.target, contact),
        "conditions": [
            describe_condition(condition, motion.goals) for condition in motion.termination
        ],
        "margin": degrees_of(motion.margin),
    }


def slack(body: Body, tell: Tell) -> Body:
    """How far each assumption of a plan may be off, one at a time, while it holds."""
    strategy = margins(strategy_of(body, solved=True))
    found = strategy.margins
    assert found is not None
    return {
        "least": finite(found.smallest(strategy.task)),
        "words": found.words,
        "entries": _entries(found),
    }


def _entries(found: Margins) -> list[Plain]:
    lengths = (
        ("start", found.start, "how far inside its first region the start lies"),
        ("reading", found.reading, "by how much the position error may be larger"),
    )
    angles = (
        ("force", found.force, "by how much the force's direction may be further off, degrees"),
        ("direction", found.direction, "by how much every command may be off, degrees"),
    )
    every = [*lengths, *((name, _in_degrees(value), words) for name, value, words in angles)]
    return [{"name": name, "words": words, **_amount(value)} for name, value, words in every]


def _in_degrees(radians: float | None) -> float | None:
    return None if radians is None else math.degrees(radians)


def _amount(value: float | None) -> Plain:
    """A margin: a number, without bound, or not known."""
    return {
        "value": finite(value),
        "known": value is not None,
        "unbounded": value is not None and math.isinf(value),
    }


def verified(body: Body, tell: Tell) -> Body:
    """Whether a plan is proven, or on which way it fails."""
    found = verify(strategy_of(body))
    return {
        "proven": found.verdict is Verdict.PROVEN,
        "words": describe_verification(found).splitlines(),
        "findings": [finding_of(one) for one in found.every],
    }


def finding_of(finding: Finding) -> Plain:
    """A fault, with the way that shows it."""
    trace = finding.trace
    return {
        "fault": finding.fault.value,
        "words": finding.words,
        "region": trace.legs[0].region if trace is not None and trace.legs else None,
        "places": []
        if trace is None
        else [place for leg in trace.legs for place in points_of(leg.places)],
    }
