"""The planner: from a task to a strategy."""

from __future__ import annotations

import logging
from collections.abc import Callable

from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, start_region
from preimage.errors import UnsupportedError
from preimage.preimages.setting import Setting
from preimage.search import led
from preimage.search.conditional import Layers, layers
from preimage.search.limits import Limits, Progress
from preimage.search.linear import Node, Outcome, search
from preimage.search.policy import policy
from preimage.strategy.strategy import Motion, Statistics, Status, Strategy, StrategyRegion
from preimage.task.options import Continuous, SearchOrder, StrategyKind, Termination
from preimage.task.task import Task

logger = logging.getLogger(__name__)


def plan(
    task: Task,
    *,
    progress: Callable[[Progress], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Strategy:
    """Find a strategy that surely ends in the goal, and knows that it did.

    Backchains preimages from the goal until one holds the start region (paper 4), as the task's
    options say. That there is no strategy, or that a limit came first, is an answer, not an error.

    Parameters
    ----------
    progress : called after every preimage.
    cancelled : asked before every preimage; once it says True, what was found so far is returned.

    Raises
    ------
    TaskError : the goal is not in contact space, the start not in valid space, …
    UnsupportedError : the task asks for a strategy or a condition that the planner does not know.

    >>> from preimage.task.examples import named_task
    >>> strategy = plan(named_task("peg-in-hole-point"))
    >>> strategy.status.value
    'solved'
    """
    options = task.options
    if isinstance(options.directions, Continuous):
        raise UnsupportedError("planner.directions", "continuous directions are not available yet")
    if options.termination is not Termination.INSTANTANEOUS:
        rule = f"{options.termination.value} conditions are not available yet"
        raise UnsupportedError("planner.termination", rule)
    limits = Limits(options.time_limit, options.max_regions, cancelled)
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    start = start_region(task, setting.space)
    find = _conditional if options.strategy is StrategyKind.CONDITIONAL else _linear
    strategy = find(task, setting, goal, start, limits, progress)
    logger.info("%d regions in %.3f s", strategy.statistics.regions, limits.seconds)
    return strategy


def _linear(
    task: Task,
    setting: Setting,
    goal: Region,
    start: Start,
    limits: Limits,
    progress: Callable[[Progress], None] | None,
) -> Strategy:
    options = task.options
    assert not isinstance(options.directions, Continuous)
    directions, method, most = options.directions, options.method, options.max_steps
    if options.search is SearchOrder.LED:
        outcome = led.search(setting, goal, start, directions, method, most, limits, progress)
    else:
        outcome = search(
            setting, goal, start, directions, method, options.search, most, limits, progress
        )
    return _strategy(task, setting, outcome, limits.seconds)


def _conditional(
    task: Task,
    setting: Setting,
    goal: Region,
    start: Start,
    limits: Limits,
    progress: Callable[[Progress], None] | None,
) -> Strategy:
    options = task.options
    assert not isinstance(options.directions, Continuous)
    found = layers(
        setting,
        [goal],
        start,
        options.directions,
        options.method,
        options.max_steps,
        limits,
        progress,
    )
    return _policy(task, setting, found, limits.seconds)


def _policy(task: Task, setting: Setting, found: Layers, seconds: float) -> Strategy:
    statistics = Statistics(
        regions=len(found.regions),
        seconds=seconds,
        preimages=found.computed,
        pruned=found.pruned,
        layers=max(known.rank for known in found.regions),
    )
    goals = tuple(known for known in found.regions if known.preimage is None)
    if found.start:
        status = Status.SOLVED
    else:
        status = Status.STOPPED if found.stopped else Status.UNSOLVABLE
    return Strategy(
        task=task,
        space=setting.space,
        status=status,
        kind=StrategyKind.CONDITIONAL,
        regions=policy(found.aimed, found.start or found.regions, goals),
        start=tuple(known.id for known in found.start),
        steps=(),
        statistics=statistics,
        reason=found.stopped or "",
    )


def _strategy(task: Task, setting: Setting, outcome: Outcome, seconds: float) -> Strategy:
    statistics = Statistics(
        regions=len(outcome.nodes),
        seconds=seconds,
        preimages=outcome.computed,
        pruned=outcome.pruned,
        layers=max(node.rank for node in outcome.nodes),
    )
    chain = outcome.solution.chain if outcome.solution else ()
    used = sorted(chain or outcome.nodes, key=lambda node: node.id)
    if chain:
        status = Status.SOLVED
    else:
        status = Status.STOPPED if outcome.stopped else Status.UNSOLVABLE
    return Strategy(
        task=task,
        space=setting.space,
        status=status,
        kind=StrategyKind.LINEAR,
        regions=tuple(_region(node) for node in used),
        start=(chain[0].id,) if chain else (),
        steps=tuple(node.id for node in chain if node.preimage),
        statistics=statistics,
        reason=outcome.stopped or "",
    )


def _region(node: Node) -> StrategyRegion:
    motion = None
    if node.preimage is not None and node.parent is not None:
        made = node.preimage
        motion = Motion(
            direction=made.direction,
            goals=(node.parent.id,),
            target=made.target.region,
            termination=made.termination,
            margin=node.margin,
        )
    return StrategyRegion(node.id, node.rank, node.region, motion)
