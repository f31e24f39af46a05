"""Is a plan true? Every motion that it may come to, and all of them together."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.depth import depth_of_start, depth_within
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, StartKind, covered, start_region
from preimage.execution.report import Report
from preimage.execution.runs import RunOptions, run
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.recognition.termination import StickingCondition
from preimage.strategy.strategy import Status, Strategy, StrategyRegion
from preimage.verification.faults import faults
from preimage.verification.out_of_reach import out_of_reach
from preimage.verification.proof import MARGIN, Case, case_of, least_progress
from preimage.verification.recognised import blurred
from preimage.verification.reference import reference_backprojection
from preimage.verification.verdict import (
    Fault,
    Finding,
    Margins,
    Maximality,
    MotionVerdict,
    Verdict,
    Verification,
)

Progress = Callable[[str], None]

RUNS = 10
"""Runs from each region under each pair of adversaries, unless said otherwise."""


def verify(
    strategy: Strategy,
    *,
    runs: int = RUNS,
    seed: int = 0,
    maximality: bool = False,
    progress: Progress | None = None,
) -> Verification:
    """Check a plan, whoever made it, with reachability and reading sets of its own.

    Each motion that the plan may come to is proven, by a forward projection from its region, or a
    counter-example is given (see `preimage.verification.proof`). The start must be covered, the
    plan's goal be the task's, and out of reach where it is given up.

    Parameters
    ----------
    runs : how many adversarial runs are made besides, from the region of each motion under each
        pair of adversaries.
    seed : of the runs.
    maximality : compare each region with the maximal backprojection of its target, too.
    progress : told what is looked at.

    >>> import preimage
    >>> verify(preimage.plan(preimage.named_task("flat-floor"))).verdict
    <Verdict.PROVEN: 'proven'>
    """
    began = time.monotonic()
    tell = progress or (lambda _words: None)
    findings = _graph(strategy)
    if any(one.fault is Fault.GRAPH for one in findings):
        return Verification(strategy, tuple(findings), (), None, time.monotonic() - began)
    findings += [*_goal(strategy), *_start(strategy), *out_of_reach(strategy)]
    used = _used(strategy)
    motions: list[MotionVerdict] = []
    cases: dict[int, Case] = {}
    for region in used:
        tell(f"region {region.id}")
        cases[region.id] = case_of(strategy, region)
    for region in used:
        case = cases[region.id]
        motions.append(
            MotionVerdict(
                region.id,
                case.motion.direction,
                tuple(faults(case)),
                _margins(strategy, region, cases),
                case.uncertain,
                _maximality(case) if maximality else None,
            )
        )
    report = None
    if runs > 0 and strategy.status is Status.SOLVED:
        tell("runs")
        report = _runs(strategy, cases, RunOptions(runs=runs, seed=seed))
        if report.failure is not None:
            words = f"in a run: {report.failure.words or report.failure.outcome.value}"
            findings.append(Finding(Fault.RUNS, Verdict.REFUTED, words, report.failure))
    seconds = time.monotonic() - began
    return Verification(strategy, tuple(findings), tuple(motions), report, seconds)


def _used(strategy: Strategy) -> tuple[StrategyRegion, ...]:
    """The regions that the plan may come to, first ones first; without the goal."""
    known = {region.id: region for region in strategy.regions}
    found: dict[int, StrategyRegion] = {}
    queue = [*strategy.start, *strategy.steps]
    while queue:
        region = known[queue.pop()]
        if region.id not in found and region.motion is not None:
            found[region.id] = region
            queue.extend(region.motion.goals)
    return tuple(sorted(found.values(), key=lambda region: (-region.rank, region.id)))


# --- the plan as a whole --------------------------------------------------------------------


def _graph(strategy: Strategy) -> list[Finding]:
    """Ids exist, ranks fall, and there is a start."""
    ranks = {region.id: region.rank for region in strategy.regions}
    findings = []
    if strategy.status is not Status.SOLVED:
        words = f"the plan's status is {strategy.status.value}: it promises nothing"
        findings.append(Finding(Fault.STATUS, Verdict.UNPROVEN, words))
    named = {*strategy.start, *strategy.steps}
    for region in strategy.regions:
        goals = region.motion.goals if region.motion else ()
        named.update(goals)
        if any(ranks.get(goal, -1) >= region.rank for goal in goals):
            words = f"the rank does not fall from region {region.id} to its goals"
            findings.append(Finding(Fault.GRAPH, Verdict.UNPROVEN, words))
        if (region.motion is None) != (region.id == 0 or region.failure):
            words = f"region {region.id} must have a motion, unless it is the goal, 0, or failure"
            findings.append(Finding(Fault.GRAPH, Verdict.UNPROVEN, words))
    missing = sorted(named - set(ranks))
    if missing or len(ranks) < len(strategy.regions):
        words = f"there is no region {missing[0]}" if missing else "an id is there twice"
        findings.append(Finding(Fault.GRAPH, Verdict.UNPROVEN, words))
    if strategy.status is Status.SOLVED and not strategy.start:
        findings.append(Finding(Fault.GRAPH, Verdict.UNPROVEN, "no region is named as the start"))
    return findings


def _goal(strategy: Strategy) -> list[Finding]:
    """Region 0 lies in the task's goal."""
    space = strategy.space
    claimed = next((region.region for region in strategy.regions if region.id == 0), None)
    if claimed is None:
        return []
    real = goal_region(strategy.task, space)
    slack = MARGIN * space.tolerance.length
    if areas.is_subset(claimed.area, real.area, slack) and contact_set.is_subset(
        claimed.contact, real.contact, slack
    ):
        return []
    words = "region 0 has configurations that are not in the task's goal"
    return [Finding(Fault.GOAL, Verdict.REFUTED, words)]


def _start(strategy: Strategy) -> list[Finding]:
    """One region holds the start, or after one reading of the position one always does."""
    if strategy.status is not Status.SOLVED:
        return []
    space = strategy.space
    start = start_region(strategy.task, space)
    chosen = [strategy.region(number).region for number in strategy.start]
    inside = [region for region in chosen if covered(start, region, space)]
    near = MARGIN * space.tolerance.length
    if any(depth_of_start(start, region, space) > near for region in inside):
        return []
    if inside:
        words = "the start is as near to the border of its region as rounding"
        return [Finding(Fault.START, Verdict.UNPROVEN, words)]
    if start.kind is StartKind.REGION and len(chosen) > 1:
        position = strategy.task.uncertainty.position
        if math.isfinite(position) and _told_apart(start, chosen, position, strategy):
            return []
    words = "no region of the start holds all of the task's start"
    if len(chosen) > 1:
        words += ", and no reading of the position tells which holds it"
    return [Finding(Fault.START, Verdict.REFUTED, words)]


def _told_apart(start: Start, regions: list[Region], position: float, strategy: Strategy) -> bool:
    """Whether `intersection of ((I - P) (+) D(rho))` over all regions misses `I (+) D(rho)`.

    The sums are taken from outside, and what touches meets.
    """
    space, inside = strategy.space, start.region
    slack = MARGIN * space.tolerance.length
    radius = position + slack
    common: Area | None = None
    for region in regions:
        left = contact_set.difference(inside.contact, region.contact, space.tolerance.length)
        area = inside.area
        if not area.is_empty and not region.area.is_empty:
            area = areas.regularised(areas.difference(area, region.area), space.tolerance.length)
        corners = space.contact.points[left.vertices]
        low = np.concatenate((space.contact.at(left.edge, left.low), corners))
        high = np.concatenate((space.contact.at(left.edge, left.high), corners))
        parts = [inflate.grow(area, radius)] if not area.is_empty else []
        if len(low):
            parts.append(inflate.outer_stadiums(low, high, radius))
        if not parts:
            return True
        grown = areas.union(*parts)
        common = grown if common is None else areas.intersection(common, grown)
    assert common is not None
    return common.is_empty


# --- margins and more -----------------------------------------------------------------------


def _margins(strategy: Strategy, region: StrategyRegion, cases: dict[int, Case]) -> Margins:
    """How near a motion is to failing."""
    space, case = strategy.space, cases[region.id]
    entry = math.inf
    if region.id in strategy.start and strategy.status is Status.SOLVED:
        start = start_region(strategy.task, space)
        entry = min(entry, depth_of_start(start, region.region, space))
    for other in cases.values():
        if region.id in other.motion.goals:
            goals = [strategy.region(goal).region for goal in other.motion.goals]
            if len(goals) == 1:
                entry = min(entry, depth_within(other.stop, region.region, space))
    progress = math.inf
    speed, _ = least_progress(case)
    for condition in case.motion.termination:
        if isinstance(condition, StickingCondition):
            error = blurred(strategy.task.uncertainty.position, space.tolerance.length)
            certain = speed * condition.period - 2.0 * error
            progress = min(progress, certain - condition.distance)
    return Margins(entry, case.aim.margin, progress)


def _maximality(case: Case) -> Maximality:
    """The region against the maximal backprojection of the certain target."""
    task, space = case.strategy.task, case.strategy.space
    best = reference_backprojection(
        space, case.stop, case.motion.direction, task.uncertainty.control, task.friction
    ).region
    own, slack = case.region.region, MARGIN * space.tolerance.length
    more, less = (
        areas.regularised(areas.difference(one.area, other.area), slack).measure
        for one, other in ((best, own), (own, best))
    )
    missing = contact_set.difference(best.contact, own.contact, slack)
    excess = contact_set.difference(own.contact, best.contact, slack)
    vertices = sorted({*missing.vertices.tolist(), *excess.vertices.tolist()})
    return Maximality(more, missing.total_length, less, excess.total_length, tuple(vertices))


def _runs(strategy: Strategy, cases: dict[int, Case], options: RunOptions) -> Report:
    """Runs from everywhere: of the rest of the plan, from all over the region of each motion."""
    reports = []
    marks = {number: case.stop for number, case in cases.items()}
    for number, case in cases.items():
        rest = replace(strategy, start=(number,))
        with contextlib.suppress(ValueError):  # too thin a region to start in
            start = Start.anywhere_in(case.region.region)
            reports.append(run(rest, start=start, marks=marks, options=options))
    failures = [report.failure for report in reports if report.failure is not None]
    slowest = [report.slowest for report in reports if report.slowest is not None]
    return Report(
        strategy,
        tuple(tally for report in reports for tally in report.tallies),
        failures[0] if failures else None,
        max(slowest, key=lambda trace: trace.time, default=None),
        tuple(trace for report in reports for trace in report.samples),
        sum(report.seconds for report in reports),
    )
