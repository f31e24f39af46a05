"""Counter-strategies: what nature does to the best motion that there is, as a trajectory."""

from __future__ import annotations

from dataclasses import replace

from preimage.configuration.start import Start, distance_to, start_region
from preimage.errors import TaskError
from preimage.preimages.methods import aim, preimage, reach
from preimage.preimages.setting import Setting
from preimage.preimages.starts import start_as_region
from preimage.recognition.termination import Condition, ReadingCondition
from preimage.strategy.reason import Reason
from preimage.strategy.strategy import Motion, Status, Strategy, StrategyRegion
from preimage.task.initial import InitialPoint
from preimage.task.task import Task
from preimage.verification.verdict import Finding, Verdict
from preimage.verification.verify import verify

MOST_GOALS = 24
"""Of the regions that a motion might lead to so many are looked at, those of the fewest motions."""


def counter_strategy(strategy: Strategy, reason: Reason) -> Finding | None:
    """What nature may do to a motion from the reason's place of the start, in its direction.

    The motion is given the best of the regions that were found: the one whose preimage comes
    nearest to the place. That it leads there is claimed as a plan of its own, and handed to
    verification, which shares no code with the planner. Where nothing of any region is
    recognised, all of the goal is claimed.

    Returns
    -------
    A refuted finding with its trace; None if verification knows none, or the reason is not about a
    motion.
    """
    if reason.direction is None:
        return None
    task, space = strategy.task, strategy.space
    setting = Setting.of(task, space)
    begin = _place(strategy, reason)
    goal = _nearest(strategy, setting, begin, reason.direction)
    method = task.options.method
    target = aim(setting, goal.region, reason.direction, method)
    conditions: tuple[Condition, ...] = (ReadingCondition(domain=None),)
    aimed = goal.region
    if not target.region.is_empty:
        made = reach(setting, goal.region, reason.direction, method, target)
        conditions, aimed = made.termination, made.target.region
    claimed = StrategyRegion(
        max(region.id for region in strategy.regions) + 1,
        max(region.rank for region in strategy.regions) + 1,
        start_as_region(begin, space),
        Motion(reason.direction, (goal.id,), aimed, conditions),
    )
    claim = replace(
        strategy,
        status=Status.SOLVED,
        regions=(*strategy.regions, claimed),
        start=(claimed.id,),
        steps=(),
    )
    verdicts = verify(claim, runs=0).motions
    findings = [
        one for motion in verdicts if motion.region == claimed.id for one in motion.findings
    ]
    return next((one for one in findings if _is_shown(one)), None)


def beaten(strategy: Strategy, task: Task) -> Finding | None:
    """How a plan fails under the errors of another task with the same scene.

    Returns
    -------
    A refuted finding with its trace; None if verification knows none.
    """
    found = verify(replace(strategy, task=task), runs=0)
    return next((one for one in found.every if _is_shown(one)), None)


def _is_shown(finding: Finding) -> bool:
    return finding.verdict is Verdict.REFUTED and finding.trace is not None


def _place(strategy: Strategy, reason: Reason) -> Start:
    """The place of the start that the reason is about, or all of the start."""
    if reason.origin is not None:
        try:
            return start_region(
                replace(strategy.task, initial=InitialPoint(reason.origin)), strategy.space
            )
        except TaskError:  # between two features by rounding
            pass
    return start_region(strategy.task, strategy.space)


def _nearest(
    strategy: Strategy, setting: Setting, begin: Start, direction: float
) -> StrategyRegion:
    """The region of which the preimage comes nearest; the goal if there is none of any."""
    method = strategy.task.options.method
    most = strategy.task.options.max_steps
    known = [one for one in strategy.regions if one.rank < most and not one.failure]
    candidates = sorted(known, key=lambda one: (one.rank, one.id))[:MOST_GOALS]
    best, nearest = candidates[0], float("inf")
    for candidate in candidates:
        found = preimage(setting, candidate.region, direction, method).region
        if found.is_empty:
            continue
        away = distance_to(begin, found, strategy.space)
        if away < nearest:
            best, nearest = candidate, away
    return best
