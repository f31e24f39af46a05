"""All directions in which one motion surely reaches, and recognises, a goal (theory 7, paper 9)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import reduce
from itertools import pairwise

from preimage.configuration.region import Region, union
from preimage.configuration.start import Start, covered
from preimage.geometry.angles import TAU
from preimage.preimages.methods import preimage
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.search.cones import alone, narrowed, widened
from preimage.search.limits import Limits
from preimage.search.witness import misses
from preimage.task.options import Method

COARSEST = 16
"""The full turn is cut into so many intervals before any of them is bisected."""

HALVINGS = 24
"""How often an interval around a direction that solves is halved below the resolution."""

MOST = 4_000
"""So many intervals are looked at, the widest first; what is left then stays unproven."""


class Verdict(Enum):
    """What is known of the directions of an interval."""

    SOLVES = "solves"  # every one
    FAILS = "fails"  # none
    UNPROVEN = "unproven"


@dataclass(frozen=True, slots=True)
class Arc:
    """An interval of directions of which the same is known.

    Parameters
    ----------
    low, high : its ends, radians, 0 or more; of what lies over the direction 0 they run past 2 pi.
        Of a direction that solves, but nothing is known of its neighbours, both are the same.
    """

    low: float
    high: float
    verdict: Verdict

    @property
    def widest(self) -> float:
        """The direction farthest from both ends, radians in [0, 2 pi)."""
        return math.fmod(0.5 * (self.low + self.high), TAU)

    @property
    def margin(self) -> float:
        """How far `widest` is from both ends, radians."""
        return 0.5 * (self.high - self.low)


@dataclass(frozen=True, slots=True)
class _Problem:
    """One motion: from where, to where, by which method."""

    setting: Setting
    goal: Region
    start: Start
    method: Method


def solving_directions(
    setting: Setting,
    goals: Sequence[Region],
    start: Start,
    method: Method,
    resolution: float,
    limits: Limits | None = None,
) -> tuple[Arc, ...]:
    """All directions whose preimage of the goals holds the start, and all that surely fail.

    Intervals of directions are bisected (theory 7). One solves if the preimage for its middle with
    a control cone that is wider by half of it holds the start: that lies in the preimages of all
    its directions. One fails if the preimage for its middle with a cone that is narrower by as
    much, and so contains theirs, does not; or if no motion in any of its directions even meets the
    goals. Intervals between 'solves' and 'fails' are no wider than the resolution as long as that
    is not below twice the control uncertainty.

    Parameters
    ----------
    goals : taken together: the motion ends in one of them, whichever.
    resolution : radians; intervals this wide are not bisected any more. Positive.
    limits : what is not looked at when one is reached stays unproven.

    Returns
    -------
    Arcs that cover the full turn in order, no two neighbours alike; the last may run past 2 pi.
    Where nothing is proved around a direction that solves, an arc without width says so.

    Raises
    ------
    ValueError : if the resolution is not positive, or there are no goals.

    >>> from preimage.configuration.goals import goal_region
    >>> from preimage.configuration.start import start_region
    >>> from preimage.task.examples import named_task
    >>> task = named_task("flat-floor")
    >>> setting = Setting.of(task)
    >>> goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    >>> arcs = solving_directions(setting, [goal], start, task.options.method, math.radians(0.1))
    >>> [round(math.degrees(arc.margin)) for arc in arcs if arc.verdict is Verdict.SOLVES]
    [12]
    """
    if not resolution > 0.0:
        raise ValueError(f"resolution is {resolution}, must be positive")
    if not goals:
        raise ValueError("there must be a goal")
    tolerance = setting.space.tolerance
    goal = reduce(lambda a, b: union(a, b, tolerance), goals[1:], goals[0])
    if goal.is_empty:
        return (Arc(0.0, TAU, Verdict.FAILS),)
    problem = _Problem(setting, goal, start, method)
    found, lone = _bisected(problem, _leaf(setting.uncertainty.control, resolution), limits)
    return tuple(_with_lone(problem, _joined(found), lone))


def _leaf(control: float, resolution: float) -> float:
    """How narrow an interval is not bisected: what is narrower than the cone can be proved."""
    finest = 0.5 * resolution  # an end may fall between two intervals
    if 0.0 < control < finest:
        return max(control, 0.25 * finest)
    return finest


def _bisected(
    problem: _Problem, least: float, limits: Limits | None
) -> tuple[list[Arc], list[float]]:
    """Intervals that cover the full turn, in order, and directions that solve, but not around.

    The directions that people name are among the first that are looked at.
    """
    found: list[Arc] = []
    lone: list[float] = []
    ends = [TAU * (index - 0.5) / COARSEST for index in range(COARSEST + 1)]
    level = list(pairwise(ends))
    looked_at = 0
    while level:
        finer: list[tuple[float, float]] = []
        for low, high in level:
            looked_at += 1
            if looked_at > MOST or (limits is not None and limits.exceeded(0)):
                found.append(Arc(low, high, Verdict.UNPROVEN))
                continue
            arc, solves = _looked_at(problem, low, high)
            middle = 0.5 * (low + high)
            if arc.verdict is Verdict.UNPROVEN and solves:
                lone.append(middle)
            if arc.verdict is Verdict.UNPROVEN and high - low > least:
                finer += [(low, middle), (middle, high)]
            else:
                found.append(arc)
        level = finer
    return sorted(found, key=lambda arc: arc.low), lone


def _looked_at(problem: _Problem, low: float, high: float) -> tuple[Arc, bool]:
    """What is known of an interval without bisecting it, and whether its middle solves."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    preimage = _preimage(problem, alone(problem.setting), middle)
    solves = covered(problem.start, preimage.region, problem.setting.space)
    verdict = Verdict.UNPROVEN
    if solves and _solves_around(problem, middle, half):
        verdict = Verdict.SOLVES
    elif not solves and _fails_around(problem, middle, half, preimage.region):
        verdict = Verdict.FAILS
    return Arc(low, high, verdict), solves


def _with_lone(problem: _Problem, arcs: list[Arc], lone: list[float]) -> Iterator[Arc]:
    """The arcs, with what solves below the resolution, apart from everything else that does."""
    for place, arc in enumerate(arcs):
        beside = arcs[place - 1], arcs[(place + 1) % len(arcs)]
        apart = arc.verdict is Verdict.UNPROVEN and not any(
            one.verdict is Verdict.SOLVES for one in beside
        )
        turned = (one + turn for one in lone for turn in (0.0, TAU))
        inside = [one for one in turned if arc.low < one < arc.high] if apart else []
        if not inside:
            yield arc
            continue
        middle = inside[0]
        half = _proved(problem, middle, min(middle - arc.low, arc.high - middle))
        yield Arc(arc.low, middle - half, Verdict.UNPROVEN)
        yield Arc(middle - half, middle + half, Verdict.SOLVES)
        yield Arc(middle + half, arc.high, Verdict.UNPROVEN)


def _proved(problem: _Problem, direction: float, half: float) -> float:
    """How far around a direction that solves all others are proved to; 0 if not at all."""
    for _ in range(HALVINGS):
        half *= 0.5
        if _solves_around(problem, direction, half):
            return half
    return 0.0


def _preimage(problem: _Problem, setting: Setting, direction: float) -> Preimage:
    return preimage(setting, problem.goal, direction, problem.method)


def _solves_around(problem: _Problem, middle: float, half: float) -> bool:
    """Whether all directions of an interval are proved to solve."""
    wide = widened(problem.setting, half, (problem.goal,))
    if wide is None:
        return False
    return covered(problem.start, _preimage(problem, wide, middle).region, wide.space)


def _fails_around(problem: _Problem, middle: float, half: float, known: Region) -> bool:
    """Whether all directions of an interval are proved to fail."""
    narrow = narrowed(problem.setting, half, (problem.goal,))
    if narrow is None:
        arguments = problem.goal, problem.start, problem.method, middle, half, known
        return misses(problem.setting, *arguments)
    made = _preimage(problem, narrow, middle)
    if made.target.region.is_empty:
        return True
    backprojection = made.backprojection
    if backprojection.events == 0 or backprojection.target is not made.target.region:
        return False  # rounding spoiled the sweep: what it leaves is too small to prove anything
    return not covered(problem.start, made.region, narrow.space)


def _joined(found: list[Arc]) -> list[Arc]:
    """Neighbours of which the same is known as one arc, from the first that begins at 0 or more."""
    arcs: list[Arc] = []
    for arc in found:
        if arcs and arcs[-1].verdict is arc.verdict:
            arcs[-1] = Arc(arcs[-1].low, arc.high, arc.verdict)
        else:
            arcs.append(arc)
    first, *rest = arcs
    if not rest:
        return [Arc(0.0, TAU, first.verdict)]
    if first.verdict is rest[-1].verdict:
        *rest, last = rest
        arcs = [*rest, Arc(last.low, first.high + TAU, last.verdict)]
    before = [Arc(arc.low + TAU, arc.high + TAU, arc.verdict) for arc in arcs if arc.low < 0.0]
    return [*(arc for arc in arcs if arc.low >= 0.0), *before]
