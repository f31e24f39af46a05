"""How much slack a plan has, by making it anew with larger errors (theory 7)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from preimage.configuration.depth import depth_of_start
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, covered, start_region
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.search.conditional import layers
from preimage.search.cones import widened
from preimage.search.limits import Limits
from preimage.search.linear import search
from preimage.strategy.margins import Margins, angle_unit, larger_side, length_unit
from preimage.strategy.strategy import Status, Strategy
from preimage.task import limits as ranges
from preimage.task.options import PlannerOptions, SearchOrder, StrategyKind, Termination
from preimage.task.task import Task
from preimage.task.uncertainty import Uncertainty

RELATIVE = 0.05
"""Margins are found to this share of them, from below."""

FIRST = 0.0625
"""The first amount that is tried, in units of the bound."""

HALVINGS = 10
"""Where the first amount is too much, it is halved so many times before the margin is 0."""

BLIND = math.pi * (1.0 - 1e-9)
"""A force error with which all directions of forces read alike."""

DOUBLINGS = 20
"""No search for a margin begins below its bound halved so often, however small the unit is."""


def margins(strategy: Strategy, limits: Limits | None = None) -> Strategy:
    """The same strategy with its margins: the largest errors that were shown to be harmless.

    Of a linear plan with instantaneous conditions the chain of preimages is made anew along its own
    directions, with a larger position or force error, or for a wider cone around every direction.
    Other plans are searched for anew, with the directions that they use and in no more motions.
    It takes some forty times the plan's own preimages, or as many searches.

    Parameters
    ----------
    limits : once one is reached, what was shown so far is returned; None for no bound.

    Returns
    -------
    A strategy that is not solved comes back as it is; of one that may know its failure, and of one
    that cannot be made anew even with its own errors, the start's margin alone is known.

    >>> from preimage.search.planner import plan
    >>> from preimage.task.examples import named_task
    >>> margins(plan(named_task("flat-floor"))).margins.words
    'start 1.1, position error unbounded, force angle unbounded, every direction ±11.6°'
    """
    if strategy.status is not Status.SOLVED:
        return strategy
    limits = limits or Limits(None, strategy.task.options.max_regions)
    return replace(strategy, margins=_margins(strategy, limits))


def _margins(strategy: Strategy, limits: Limits) -> Margins:
    task, space = strategy.task, strategy.space
    start = start_region(task, space)
    first = [strategy.region(number).region for number in strategy.start]
    whole = [region for region in first if covered(start, region, space)]
    depth = max((depth_of_start(start, region, space) for region in whole), default=None)
    if strategy.failures:
        return Margins(depth, None, None, None)
    if whole and 0 in strategy.start and covered(start, strategy.region(0).region, space):
        sensed = math.inf if task.uncertainty.has_force_sensor else None
        return Margins(depth, math.inf, sensed, math.inf)  # nothing is commanded, nor recognised
    return slack(again(strategy, start, limits), depth, task)


# --- a plan, made anew ----------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Again:
    """What of a plan stays the same while errors grow, to ask whether there is still one.

    Parameters
    ----------
    setting : with the plan's own errors.
    directions : of a chain, the first motion first; else all that the plan uses; radians.
    chained : whether the directions are commanded in this order; else they are searched.
    most : the motions that the plan has at most.
    """

    setting: Setting
    goal: Region
    start: Start
    options: PlannerOptions
    directions: tuple[float, ...]
    chained: bool
    most: int
    limits: Limits

    def works(self) -> bool:
        """Whether there is a plan with its own errors at all."""
        return self._leads(self.setting.uncertainty)

    def misread(self, more: float) -> bool:
        """Whether there is one with a position error that is larger by a length."""
        bounds = self.setting.uncertainty
        return self._leads(replace(bounds, position=bounds.position + more))

    def misfelt(self, more: float) -> bool:
        """Whether there is one with a force error that is larger by an angle, radians."""
        bounds = self.setting.uncertainty
        return self._leads(replace(bounds, force_angle=min(bounds.force_angle + more, BLIND)))

    def astray(self, turn: float) -> bool:
        """Whether there is one for which every direction may be off by `turn` radians."""
        return self._leads(self.setting.uncertainty, turn)

    def _leads(self, bounds: Uncertainty, turn: float = 0.0) -> bool:
        if self.limits.exceeded(0):
            return False
        if self.chained:
            return self._chain_leads(self._setting(bounds), turn)
        control = bounds.control + turn
        if control >= 0.5 * math.pi:
            return False
        return self._is_found(self._setting(replace(bounds, control=control)))

    def _setting(self, bounds: Uncertainty) -> Setting:
        return replace(self.setting, uncertainty=bounds, _commands={})

    def _chain_leads(self, setting: Setting, turn: float) -> bool:
        goal = self.goal
        for direction in reversed(self.directions):
            wide = widened(setting, turn, (goal,)) if turn > 0.0 else setting
            if wide is None or self.limits.exceeded(0):
                return False
            goal = preimage(wide, goal, direction, self.options.method).region
            if goal.is_empty:
                return False
        return covered(self.start, goal, setting.space)

    def _is_found(self, setting: Setting) -> bool:
        options, directions = self.options, tuple(sorted(set(self.directions)))
        if options.strategy is StrategyKind.CONDITIONAL:
            found = layers(
                setting,
                [self.goal],
                self.start,
                directions,
                options.method,
                self.most,
                self.limits,
                termination=options.termination,
            )
            return bool(found.start)
        outcome = search(
            setting,
            self.goal,
            self.start,
            directions,
            options.method,
            SearchOrder.BREADTH_FIRST,
            self.most,
            self.limits,
            termination=options.termination,
        )
        return outcome.solution is not None


def again(strategy: Strategy, start: Start, limits: Limits) -> Again:
    """What a solved strategy is made anew from."""
    task, options = strategy.task, strategy.task.options
    ordered = strategy.kind is StrategyKind.LINEAR
    used = strategy.steps if ordered else [region.id for region in strategy.regions]
    motions = [strategy.region(number).motion for number in used]
    return Again(
        setting=Setting.of(task, strategy.space),
        goal=goal_region(task, strategy.space),
        start=start,
        options=replace(options, strategy=strategy.kind),
        directions=tuple(motion.direction for motion in motions if motion is not None),
        chained=ordered and options.termination is Termination.INSTANTANEOUS,
        most=max(strategy.region(number).rank for number in strategy.start),
        limits=limits,
    )


def slack(plan: Again, depth: float | None, task: Task) -> Margins:
    """The margins of a plan whose start lies so deep in its first region."""
    bounds = task.uncertainty
    if not plan.works():
        return Margins(depth, None, None, None)
    reading, force = math.inf, None
    if bounds.has_position_sensor and not plan.misread(math.inf):
        most = min(4.0 * larger_side(task), ranges.POSITION.high - bounds.position)
        reading = largest(plan.misread, FIRST * length_unit(task), most)
    if bounds.has_force_sensor:
        force = math.inf
        if not plan.misfelt(math.pi):
            first = FIRST * angle_unit(bounds.force_angle)
            force = largest(plan.misfelt, first, BLIND - bounds.force_angle)
    first = FIRST * angle_unit(bounds.control)
    direction = largest(plan.astray, first, 0.5 * math.pi - bounds.control)
    return Margins(depth, reading, force, direction)


def has_slack(plan: Again, depth: float, task: Task, level: float) -> bool:
    """Whether a plan is shown to have margins of `level` units each, at least (`smallest`)."""
    bounds, length = task.uncertainty, level * length_unit(task)
    if depth < length or not plan.astray(level * angle_unit(bounds.control)):
        return False
    if bounds.has_position_sensor and not plan.misread(length):
        return False
    turn = level * angle_unit(bounds.force_angle)
    return not bounds.has_force_sensor or plan.misfelt(turn)


def largest(works: Callable[[float], bool], first: float, most: float) -> float:
    """The largest amount below `most` that is seen to work, to 5 % of it; 0 if none is.

    Doubles from the first amount up, or halves it, and bisects then.

    >>> 0.285 <= largest(lambda amount: amount <= 0.3, 0.1, 10.0) <= 0.3
    True
    """
    amount = max(min(first, 0.5 * most), most * 0.5**DOUBLINGS)
    if amount <= 0.0:
        return 0.0
    low, high = 0.0, most
    while amount < most:
        if not works(amount):
            high = amount
            break
        low, amount = amount, 2.0 * amount
    for _ in range(HALVINGS):
        if low > 0.0:
            break
        if works(0.5 * high):
            low = 0.5 * high
        else:
            high = 0.5 * high
    while low > 0.0 and high - low > RELATIVE * low:
        middle = 0.5 * (low + high)
        if works(middle):
            low = middle
        else:
            high = middle
    return low
