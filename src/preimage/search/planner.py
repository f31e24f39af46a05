"""The planner: from a task to a strategy."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import replace

from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, start_region
from preimage.errors import UnsupportedError
from preimage.preimages.setting import Setting
from preimage.search import led
from preimage.search.conditional import Known, Layers, layers
from preimage.search.continuous import search_continuous
from preimage.search.failure import hopeless
from preimage.search.hoping import judged, promise
from preimage.search.limits import Limits, Progress
from preimage.search.linear import Node, Outcome, search
from preimage.search.margins import margins
from preimage.search.policy import found_so_far, policy
from preimage.search.preferring import compared_words, roomiest, roomiest_policy
from preimage.search.reasons import reasons
from preimage.strategy.strategy import Motion, Statistics, Status, Strategy, StrategyRegion
from preimage.task.options import (
    Continuous,
    PlannerOptions,
    Preference,
    SearchOrder,
    StrategyKind,
    Termination,
    uniform_directions,
)
from preimage.task.task import Task

MOST_PLANS = 16
"""Of plans that are equally short, and may know their failure, so many are compared."""

logger = logging.getLogger(__name__)


def plan(
    task: Task,
    *,
    progress: Callable[[Progress], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
    reasoned: bool = True,
) -> Strategy:
    """Find a strategy that surely ends in the goal, and knows that it did.

    Backchains preimages from the goal until one holds the start region (paper 4), as the task's
    options say. That there is no strategy, or that a limit came first, is an answer, not an error.

    Parameters
    ----------
    progress : called after every preimage.
    cancelled : asked before every preimage; once it says True, what was found so far is returned.
    reasoned : whether to look for what stands in the way where there is no strategy; that can take
        longer than the search.

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
    _refuse_unknown(options)
    limits = Limits(options.time_limit, options.max_regions, cancelled)
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    start = start_region(task, setting.space)
    if options.strategy is StrategyKind.CONDITIONAL:
        plans = _conditional(task, setting, [goal], start, limits, progress)
        strategy = _preferred(plans, options, limits)
    else:
        strategy = _linear(task, setting, goal, start, limits, progress)
    if strategy.status is not Status.SOLVED and not limits.exceeded(0):
        strategy = _second_best(task, setting, goal, start, limits, progress, strategy, reasoned)
    if options.prefer is Preference.MARGIN and strategy.margins is None:
        strategy = margins(strategy, limits)
    logger.info("%d regions in %.3f s", strategy.statistics.regions, limits.seconds)
    return strategy


def _refuse_unknown(options: PlannerOptions) -> None:
    """Refuse what does not go together."""
    conditional = options.strategy is StrategyKind.CONDITIONAL
    with_state = options.termination is not Termination.INSTANTANEOUS
    if isinstance(options.directions, Continuous) and (conditional or with_state):
        rule = "continuous directions are for linear strategies with instantaneous conditions"
        raise UnsupportedError("planner.directions", rule)
    if isinstance(options.directions, Continuous) and options.or_fail:
        rule = "a plan that may know its failure needs a list of directions, not continuous ones"
        raise UnsupportedError("planner.or_fail", rule)
    if options.search is SearchOrder.LED and with_state and not conditional:
        rule = "led searches know instantaneous conditions alone"
        raise UnsupportedError("planner.search", rule)
    if options.prefer is Preference.MARGIN and not conditional:
        _refuse_to_compare(options)


def _refuse_to_compare(options: PlannerOptions) -> None:
    """Refuse to compare linear plans by their margins where not all shortest ones are known."""
    rule = ""
    if isinstance(options.directions, Continuous):
        rule = "needs a list of directions: plans with continuous ones have the widest already"
    elif options.termination is not Termination.INSTANTANEOUS:
        rule = "needs instantaneous conditions, or a conditional strategy"
    elif options.search is SearchOrder.BEST_FIRST:
        rule = "needs a search that finds the fewest motions: breadth-first or led"
    if rule:
        raise UnsupportedError("planner.prefer", f"margin {rule}")


def _linear(
    task: Task,
    setting: Setting,
    goal: Region,
    start: Start,
    limits: Limits,
    progress: Callable[[Progress], None] | None,
) -> Strategy:
    options = task.options
    directions, method, most = options.directions, options.method, options.max_steps
    if isinstance(directions, Continuous):
        outcome = search_continuous(setting, goal, start, options, limits, progress)
    elif options.search is SearchOrder.LED:
        outcome = led.search(setting, goal, start, directions, method, most, limits, progress)
    else:
        outcome = search(
            setting,
            goal,
            start,
            directions,
            method,
            options.search,
            most,
            limits,
            progress,
            options.termination,
        )
    if options.prefer is Preference.SHORTEST or not outcome.solution or outcome.solution.rank == 0:
        return _strategy(task, setting, outcome, limits.seconds)
    best = roomiest(setting, start, task, outcome.solution, limits, progress)
    outcome.solution, outcome.stopped = best.solution, best.words
    outcome.computed += best.made
    return replace(_strategy(task, setting, outcome, limits.seconds), margins=best.margins)


def _preferred(plans: list[Strategy], options: PlannerOptions, limits: Limits) -> Strategy:
    """Of equally short plans the first one, or that with the largest margin."""
    if options.prefer is Preference.SHORTEST or plans[0].status is not Status.SOLVED:
        return plans[0]
    return replace(roomiest_policy(plans, limits), reason=compared_words(len(plans)))


def _conditional(
    task: Task,
    setting: Setting,
    goals: list[Region],
    start: Start,
    limits: Limits,
    progress: Callable[[Progress], None] | None,
) -> list[Strategy]:
    """What was found: a strategy, and others that are as short; or what there is without one."""
    options = task.options
    assert not isinstance(options.directions, Continuous)
    found = layers(
        setting,
        goals,
        start,
        options.directions,
        options.method,
        options.max_steps,
        limits,
        progress,
        options.termination,
    )
    begins = [found.start, *((one,) for one in found.others)]
    return [_policy(task, found, begin, limits.seconds) for begin in begins[:MOST_PLANS]]


def _second_best(
    task: Task,
    setting: Setting,
    goal: Region,
    start: Start,
    limits: Limits,
    progress: Callable[[Progress], None] | None,
    strategy: Strategy,
    reasoned: bool,
) -> Strategy:
    """Where there is no plan: one that may know its failure, if that is asked for, or why."""
    options = task.options
    directions = options.directions
    if options.or_fail and not isinstance(directions, Continuous):
        lost = hopeless(setting, goal, directions, limits)
        if not lost.is_empty:
            plans = _conditional(task, setting, [goal, lost], start, limits, progress)
            if plans[0].status is Status.SOLVED:
                return max((judged(plan) for plan in plans), key=promise)
    if options.termination is not Termination.INSTANTANEOUS or not reasoned:
        return strategy
    chosen = uniform_directions(16) if isinstance(directions, Continuous) else directions
    why = reasons(setting, start, strategy.regions, chosen, options.method, options.strategy)
    return replace(strategy, why=why)


def _policy(task: Task, found: Layers, begin: tuple[Known, ...], seconds: float) -> Strategy:
    statistics = Statistics(
        regions=len(found.regions),
        seconds=seconds,
        preimages=found.computed,
        pruned=found.pruned,
        layers=max(known.rank for known in found.regions),
    )
    if begin:
        status = Status.SOLVED
    else:
        status = Status.STOPPED if found.stopped else Status.UNSOLVABLE
    return Strategy(
        task=task,
        space=found.aimed.setting.space,
        status=status,
        kind=StrategyKind.CONDITIONAL,
        regions=policy(found.aimed, begin, found.goals) if begin else found_so_far(found),
        start=tuple(known.id for known in begin),
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
