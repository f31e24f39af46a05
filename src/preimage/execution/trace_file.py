"""Runs as JSON."""

from __future__ import annotations

import json
import math
from typing import Any

from preimage.execution.describe import feature_words
from preimage.execution.report import Report
from preimage.execution.trace import Leg, Trace
from preimage.task.degrees import to_degrees

Data = dict[str, Any]

VERSION = 1


def format_report(report: Report) -> str:
    """The text of a trace file: all counts, and the runs that were kept whole.

    Angles are in degrees, times and lengths in the task's unit; what no sensor read is null, and
    so is a force that was read as 0.
    """
    kept = [("failure", report.failure), ("slowest", report.slowest)]
    data: Data = {
        "version": VERSION,
        "task": report.strategy.task.name,
        "runs": report.runs,
        "outcomes": {outcome.name.lower(): many for outcome, many in report.outcomes.items()},
        "adversaries": [
            {
                "control": tally.control,
                "sensing": tally.sensing,
                "runs": tally.runs,
                "outcomes": {key.name.lower(): value for key, value in tally.outcomes.items()},
                "time": {"mean": tally.time[0], "most": tally.time[1]},
                "distance": {"mean": tally.distance[0], "most": tally.distance[1]},
                "motions": {"mean": tally.motions[0], "most": tally.motions[1]},
            }
            for tally in report.tallies
        ],
        **{key: None if trace is None else trace_to_dict(trace) for key, trace in kept},
        "samples": [trace_to_dict(trace) for trace in report.samples],
    }
    return json.dumps(data, indent=1, allow_nan=False) + "\n"


def trace_to_dict(trace: Trace) -> Data:
    """One run."""
    edges = len(trace.strategy.space.contact)
    found: Data = {
        "control": trace.control,
        "sensing": trace.sensing,
        "run": trace.number,
        "outcome": trace.outcome.name.lower(),
        "motions": [_leg(leg, edges) for leg in trace.legs],
    }
    if not trace.outcome.as_planned:
        found["words"] = trace.words
    return found


def _leg(leg: Leg, edges: int) -> Data:
    """One motion: parallel lists, one entry an instant."""
    return {
        "region": leg.region,
        "direction": to_degrees(leg.direction),
        "ended_by": leg.ended_by,
        "time": leg.times.tolist(),
        "position": leg.places.tolist(),
        "feature": [feature_words(number, edges) for number in leg.features.tolist()],
        "driven": [to_degrees(angle) for angle in leg.actual.tolist()],
        "measured": [None if math.isnan(x) else [x, y] for x, y in leg.measured.tolist()],
        "force": [None if math.isnan(f) else to_degrees(f) for f in leg.forces.tolist()],
    }
