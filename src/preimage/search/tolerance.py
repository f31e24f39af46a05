"""The most tolerant directions for the motions of a linear plan (theory 7)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from preimage.configuration.region import Region
from preimage.configuration.start import Start, covered
from preimage.geometry.angles import TAU
from preimage.preimages.methods import preimage
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.preimages.sticking import sticking_termination
from preimage.recognition.termination import Condition, ReadingCondition
from preimage.search.cones import widened
from preimage.search.limits import Limits
from preimage.search.linear import Node
from preimage.task.options import Method

WIDEST = 0.5 * math.pi
"""No interval of directions that one cone contains is wider than this to either side."""

CENTERED = 4.0
"""A direction so many resolutions off the middle of its interval, at most, stays as it is."""


@dataclass(frozen=True, slots=True)
class Leg:
    """One motion of a chain: any direction within `margin` of `direction`, both in radians."""

    direction: float
    margin: float = 0.0


@dataclass(slots=True)
class _Chain:
    """The preimages of a chain, and from where they hold, leg by leg.

    Parameters
    ----------
    legs : the first motion first.
    made : the preimage of each leg, for all of its directions.
    """

    setting: Setting
    goal: Region
    start: Start
    method: Method
    legs: list[Leg]
    made: list[Preimage]

    def with_leg(self, place: int, leg: Leg) -> list[Preimage] | None:
        """The preimages with another leg, as long as the chain still leads from the start."""
        legs = [*self.legs[:place], leg, *self.legs[place + 1 :]]
        return self._chained(legs, self.made[place + 1 :])

    def with_all(self, legs: list[Leg]) -> list[Preimage] | None:
        """The preimages with other legs, as long as the chain still leads from the start."""
        return self._chained(legs, [])

    def _chained(self, legs: list[Leg], known: list[Preimage]) -> list[Preimage] | None:
        made = list(known)
        for leg in reversed(legs[: len(legs) - len(known)]):
            goal = made[0].region if made else self.goal
            wide = widened(self.setting, leg.margin, (goal,)) if leg.margin else self.setting
            if wide is None:
                return None
            found = preimage(wide, goal, leg.direction, self.method)
            if found.region.is_empty:
                return None
            made.insert(0, found)
        return made if covered(self.start, made[0].region, self.setting.space) else None


def tolerant(
    setting: Setting,
    chain: Sequence[Node],
    start: Start,
    method: Method,
    resolution: float,
    limits: Limits | None = None,
) -> tuple[Node, ...]:
    """The same plan with the most tolerant directions, and how far each motion may be off.

    One motion after the other, the last first, gets the middle of the interval of directions with
    which the chain still leads from the start. Then all are given the largest margin that they can
    have at once, and each what it can have beyond that. The preimages are those for a control cone
    that is wider by the margin: from anywhere in them every direction within it, and any noise
    besides, leads to the next region, and by the same conditions; whichever of these directions
    the other motions use.

    Parameters
    ----------
    chain : the first motion first, the goal last, as in `Node.chain`.
    resolution : radians, to which intervals and margins are found; positive.
    limits : once one is reached, what was found so far is returned.

    Returns
    -------
    The chain with the same ids and ranks. A motion for which no margin is found has None; a chain
    that does not lead from the start is returned as it is.
    """
    *moving, last = chain
    if not moving:
        return tuple(chain)
    legs = [Leg(node.preimage.direction) for node in moving if node.preimage is not None]
    state = _Chain(setting, last.region, start, method, legs, [])
    made = state.with_all(legs)
    if made is None:
        return tuple(chain)
    state.made = made
    for place in reversed(range(len(legs))):
        _center(state, place, resolution, limits)
    _share(state, resolution, limits)
    for place in range(len(legs)):
        _extend(state, place, resolution, limits)
    return _nodes(state, moving, last)


def _center(state: _Chain, place: int, resolution: float, limits: Limits | None) -> None:
    """Move a direction to the middle of its interval, all others as they are."""
    direction = state.legs[place].direction

    def reaches(side: float) -> Callable[[float], bool]:
        def works(width: float) -> bool:
            leg = Leg(direction + 0.5 * side * width, 0.5 * width)
            return state.with_leg(place, leg) is not None

        return works

    left = _largest(reaches(1.0), resolution, WIDEST, limits)
    right = _largest(reaches(-1.0), resolution, WIDEST, limits)
    if abs(left - right) <= CENTERED * resolution:
        return
    leg = Leg(math.fmod(direction + 0.5 * (left - right) + TAU, TAU))
    made = state.with_leg(place, leg)
    if made is not None:
        state.legs[place], state.made = leg, made


def _share(state: _Chain, resolution: float, limits: Limits | None) -> None:
    """Give all motions the largest margin that they can have at once."""

    def legs(margin: float) -> list[Leg]:
        return [replace(leg, margin=margin) for leg in state.legs]

    def works(margin: float) -> bool:
        return state.with_all(legs(margin)) is not None

    margin = _largest(works, resolution, WIDEST, limits)
    made = state.with_all(legs(margin))
    if made is not None:
        state.legs, state.made = legs(margin), made


def _extend(state: _Chain, place: int, resolution: float, limits: Limits | None) -> None:
    """Give one motion what it can have beyond its margin, all others as they are."""
    leg = state.legs[place]

    def works(more: float) -> bool:
        return state.with_leg(place, replace(leg, margin=leg.margin + more)) is not None

    more = _largest(works, resolution, WIDEST, limits)
    wider = replace(leg, margin=leg.margin + more)
    made = state.with_leg(place, wider) if more else None
    if made is not None:
        state.legs[place], state.made = wider, made


def _largest(
    works: Callable[[float], bool], resolution: float, most: float, limits: Limits | None
) -> float:
    """The largest amount that works, found to the resolution; 0 if none is known to.

    Doubles from the resolution up, or halves from it down to a hundredth, and bisects then.
    """
    low, high = 0.0, most
    amount = resolution
    while amount < most:
        if limits is not None and limits.exceeded(0):
            return low
        if not works(amount):
            high = amount
            break
        low, amount = amount, 2.0 * amount
    finest = resolution if low else resolution / 100.0
    while high - low > finest:
        if limits is not None and limits.exceeded(0):
            break
        middle = 0.5 * (low + high)
        if works(middle):
            low, finest = middle, max(finest, 0.05 * middle)
        else:
            high = middle
    return low


def _nodes(state: _Chain, moving: Sequence[Node], last: Node) -> tuple[Node, ...]:
    """The chain's regions as nodes, with the ids and ranks that they had."""
    chain = [last]
    for node, leg, made in zip(moving[::-1], state.legs[::-1], state.made[::-1], strict=True):
        patient = replace(made, termination=_patient(state.setting, leg, made))
        chain.insert(
            0, Node(node.id, node.rank, made.region, chain[0], patient, leg.margin or None)
        )
    return tuple(chain)


def _patient(setting: Setting, leg: Leg, made: Preimage) -> tuple[Condition, ...]:
    """The conditions of a motion, with periods that are long enough for each of its directions.

    Progress along v is least at an end of the interval, where the edges that are slid on are
    hit most steeply.
    """
    if not leg.margin:
        return made.termination
    wide = widened(setting, leg.margin, made.goals)
    assert wide is not None  # the preimage was made in it
    position = wide.uncertainty.position
    own = replace(
        setting, uncertainty=replace(setting.uncertainty, position=position), _commands={}
    )
    ends = (leg.direction - leg.margin, leg.direction + leg.margin)
    others = [sticking_termination(own, own.command(end), made.region) for end in ends]
    return tuple(_longest(condition, others) for condition in made.termination)


def _longest(condition: Condition, others: Sequence[Condition | None]) -> Condition:
    if isinstance(condition, ReadingCondition):
        return condition
    periods = [one.period for one in others if one and not isinstance(one, ReadingCondition)]
    return replace(condition, period=max(condition.period, *periods))
