"""A verification in plain words, one paragraph a motion."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from preimage.configuration.space import ConfigurationSpace
from preimage.execution.trace import Trace
from preimage.strategy.strategy import Strategy
from preimage.strategy.words import count, direction_words, number, place
from preimage.verification.recognised import Confusion
from preimage.verification.trajectory import feature_words
from preimage.verification.verdict import (
    Fault,
    Finding,
    Margins,
    Maximality,
    MotionVerdict,
    Verdict,
    Verification,
)

MOST = 3
"""So many parts of a target that are not certain are named."""


def describe_verification(verification: Verification) -> str:
    """What of a plan is proven, what is refuted and how, and how near it is to failing."""
    strategy = verification.strategy
    lines = [f"{strategy.task.name}: {_headline(verification)}"]
    lines += [f"  {one.words}" for one in verification.findings if one.fault is not Fault.STATUS]
    for motion in verification.motions:
        lines += ["", *_motion(motion, strategy)]
    if verification.report is not None:
        report = verification.report
        pairs = count(len({(one.control, one.sensing) for one in report.tallies}), "pair")
        lines += [
            "",
            f"runs         {report.runs:,} from all regions under {pairs} of adversaries,"
            f" {report.failures:,} failed",
        ]
    return "\n".join(lines)


def _headline(verification: Verification) -> str:
    status = [one for one in verification.findings if one.fault is Fault.STATUS]
    if status:
        return f"{verification.verdict.value}: {status[0].words}"
    match verification.verdict:
        case Verdict.PROVEN if verification.motions:
            strategy = verification.strategy
            if strategy.steps:
                motions = count(len(strategy.steps), "motion")
            else:
                most = max(strategy.region(start).rank for start in strategy.start)
                motions = f"at most {count(most, 'motion')}"
            if strategy.failures:
                known = "it ends in the goal, or where that is out of reach, and knows which"
            else:
                known = "it ends in the goal and knows it"
            return f"proven in {motions}: whatever happens, {known}"
        case Verdict.PROVEN:
            return "proven: the start lies in the goal"
        case Verdict.REFUTED:
            return "refuted"
        case Verdict.UNPROVEN:
            return "not proven"


def _motion(motion: MotionVerdict, strategy: Strategy) -> Iterator[str]:
    region = strategy.region(motion.region)
    goals = region.motion.goals if region.motion else ()
    to = " or ".join("the goal" if goal == 0 else f"region {goal}" for goal in goals)
    yield (
        f"region {motion.region}: {direction_words(motion.direction)} to {to}: "
        f"{motion.verdict.value}"
    )
    for finding in motion.findings:
        yield from _finding(finding)
    if not motion.findings:
        yield from _margins(motion.margins, strategy)
    for confusion in motion.uncertain[:MOST]:
        yield f"  uncertain  {_confusion(confusion, strategy.space)}"
    if len(motion.uncertain) > MOST:
        yield f"             and {len(motion.uncertain) - MOST} more parts of the target"
    if motion.maximality is not None:
        yield f"  maximal    {_maximality(motion.maximality)}"


def _finding(finding: Finding) -> Iterator[str]:
    yield f"  {finding.words}"
    if finding.trace is not None:
        yield from _way(finding.trace)


def _way(trace: Trace) -> Iterator[str]:
    space = trace.strategy.space
    near = space.tolerance.length
    for leg in trace.legs:
        for index, feature in enumerate(leg.features.tolist()):
            word = ("from", "to")[index > 0]
            at = np.where(np.abs(leg.places[index]) > near, leg.places[index], 0.0)
            yield f"    {word:5}{place(at)}, {feature_words(feature, space)}"


def _margins(margins: Margins, strategy: Strategy) -> Iterator[str]:
    near = strategy.space.tolerance.length
    if math.isfinite(margins.entry):
        yield f"  begins     {_amount(margins.entry, near)} inside the region"
    if math.isfinite(margins.reading):
        yield f"  readings   {_amount(margins.reading, near)} to spare before one is misread"
    if math.isfinite(margins.progress):
        yield f"  sticking   {_amount(margins.progress, near)} to spare before a slide looks so"


def _amount(value: float, near: float) -> str:
    """A length; what is of the order of the tolerance is 0."""
    return number(value) if value > 16.0 * near else "0"


def _confusion(confusion: Confusion, space: ConfigurationSpace) -> str:
    here = f"{feature_words(confusion.feature, space)} at {place(confusion.place)}"
    there = f"{feature_words(confusion.other, space)} at {place(confusion.elsewhere)}"
    return f"{here} may be read as {there}, {number(confusion.distance)} away"


def _maximality(maximality: Maximality) -> str:
    words = []
    for area, length, what in (
        (maximality.missing_area, maximality.missing_length, "more is possible"),
        (maximality.excess_area, maximality.excess_length, "too much is claimed"),
    ):
        if area > 0.0 or length > 0.0:
            words.append(f"{what}: {number(area)} of area, {number(length)} of contact")
    if maximality.vertices:
        words.append(f"differs in {count(len(maximality.vertices), 'vertex', 'vertices')}")
    return "; ".join(words) if words else "no larger region is possible for this target"
