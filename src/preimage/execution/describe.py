"""Runs in plain words."""

from __future__ import annotations

from collections.abc import Iterator

from preimage.execution.report import Report, Tally
from preimage.execution.trace import Outcome, Trace
from preimage.strategy.words import count, degrees, direction_words, number, place

MOST_FAILING = 6
"""So many pairs of adversaries that made runs fail are listed."""

MOST_INSTANTS = 8
"""So many instants of each motion of a failed run are listed, the last ones."""


def describe_report(report: Report) -> str:
    """What many runs came to: how many succeeded, what they took, what failed first."""
    name = report.strategy.task.name
    lines = [
        f"{name}: {report.runs:,} {'run' if report.runs == 1 else 'runs'} under"
        f" {count(len(report.tallies), 'pair')} of adversaries"
    ]
    done = report.outcomes.get(Outcome.SUCCESS, 0)
    lines.append(f"succeeded    {done:,} ({_share(done, report.runs)})")
    known = report.outcomes.get(Outcome.FAILED, 0)
    if known or report.strategy.failures:
        share = _share(known, report.runs)
        lines.append(f"out of reach {known:,} ({share}): {Outcome.FAILED.value}")
    lines += [
        f"failed       {many:,} ({_share(many, report.runs)}): {outcome.value}"
        for outcome, many in report.outcomes.items()
        if not outcome.as_planned
    ]
    lines += _totals(report)
    failing = [tally for tally in report.tallies if tally.failures]
    failing.sort(key=lambda tally: -tally.failures)
    lines += [
        f"{_pair(tally)}: {tally.failures} of {tally.runs} failed"
        for tally in failing[:MOST_FAILING]
    ]
    if len(failing) > MOST_FAILING:
        lines.append(f"and {len(failing) - MOST_FAILING} more pairs")
    if report.failure is not None:
        lines += ["", *_trace(report.failure)]
    return "\n".join(lines)


def _share(part: int, whole: int) -> str:
    """A percentage that says 100 of all alone."""
    if part == whole:
        return "100 %"
    return f"{min(100.0 * part / whole, 99.99):.2f} %"


def _totals(report: Report) -> Iterator[str]:
    """Means over all runs, and the worst with the adversaries that made it."""
    if not report.runs:
        return
    for word, field in (("time", "time"), ("distance", "distance"), ("motions", "motions")):
        mean = sum(getattr(t, field)[0] * t.runs for t in report.tallies) / report.runs
        worst: Tally = max(report.tallies, key=lambda t: getattr(t, field)[1])
        most = getattr(worst, field)[1]
        under = f" ({_pair(worst)})" if most > mean * (1.0 + 1e-9) else ""
        yield f"{word:<12} {mean:.4g} on average, {most:.4g} at most{under}"


def _pair(tally: Tally) -> str:
    return f"{tally.control}+{tally.sensing}"


def _trace(trace: Trace) -> Iterator[str]:
    """A run that failed, motion by motion, to its last instants."""
    yield (
        f"first failure: run {trace.number} under {trace.control}+{trace.sensing}, {trace.words}"
    )
    n = len(trace.strategy.space.contact)
    for leg in trace.legs:
        ended = f"ended by {leg.ended_by}" if leg.ended_by else "not ended by any condition"
        yield f"  region {leg.region}, {direction_words(leg.direction)}, {ended}"
        skipped = max(0, len(leg.times) - MOST_INSTANTS)
        if skipped:
            yield f"    {count(skipped, 'instant')} before"
        for at in range(skipped, len(leg.times)):
            yield (
                f"    {number(leg.times[at]):>8} at {place(leg.places[at])}"
                f" {feature_words(int(leg.features[at]), n)},"
                f" driven to {degrees(float(leg.actual[at]))}"
            )


def feature_words(feature: int, edges: int) -> str:
    """What a robot touches, by the feature's number.

    >>> feature_words(3, 10), feature_words(13, 10), feature_words(20, 10)
    ('on edge 3', 'at vertex 3', 'in free space')
    """
    if feature >= 2 * edges:
        return "in free space"
    return f"at vertex {feature - edges}" if feature >= edges else f"on edge {feature}"
