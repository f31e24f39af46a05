"""What of a target is certain: told by readings, or by resting, for one goal or another."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, union
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.recognition.termination import ReadingCondition
from preimage.strategy.strategy import Motion, Strategy
from preimage.verification.features import Features
from preimage.verification.reading_sets import ReadingSets
from preimage.verification.recognised import Recognised, recognised, told_by_some

ROUNDS = 4
"""What arcs cut off is looked at so often: a sliver may be told by one goal here, another there."""


@dataclass(frozen=True, slots=True, eq=False)
class Aim:
    """What of a motion's target is certain.

    Parameters
    ----------
    told, held : by reading, and since it holds every motion; for each goal.
    region : all of that; with several goals also what is told by one goal here, by another there.
    """

    told: tuple[Recognised, ...]
    held: tuple[Recognised, ...]
    region: Region

    @property
    def margin(self) -> float:
        """By how much the worst reading is not misread."""
        return min((one.margin for one in (*self.told, *self.held)), default=math.inf)


def aim_of(strategy: Strategy, motion: Motion, features: Features, sets: ReadingSets) -> Aim:
    """The certain parts of a target."""
    space, position = strategy.space, strategy.task.uncertainty.position
    goals = [strategy.region(goal).region for goal in motion.goals]
    told: list[Recognised] = []
    held: list[Recognised] = []
    region = Region.empty()
    for condition in motion.termination:
        if not isinstance(condition, ReadingCondition):
            continue
        found = [
            recognised(space, sets, goal, motion.target, position, condition.domain)
            for goal in goals
        ]
        told += found
        region = _together(space, region, found)
        if len(goals) > 1:
            for more in _told_in_parts(
                strategy, motion.target, goals, sets, condition.domain, region
            ):
                region = union(region, more, space.tolerance)
    if any(not isinstance(one, ReadingCondition) for one in motion.termination):
        sure = _holding(motion.target, features)
        # once the motion rests, it is known to be in one of these places
        held = [recognised(space, sets, goal, sure, position, sure) for goal in goals]
        region = _together(space, region, held)
    return Aim(tuple(told), tuple(held), region)


def _together(space: ConfigurationSpace, region: Region, found: Sequence[Recognised]) -> Region:
    for one in found:
        region = union(region, one.region, space.tolerance)
    return region


def _told_in_parts(
    strategy: Strategy,
    target: Region,
    goals: Sequence[Region],
    sets: ReadingSets,
    domain: Region | None,
    sofar: Region,
) -> list[Region]:
    """What else of the target is told: vertices, and what arcs drawn outside them have cut off.

    Where a target is made of several goals' parts, the arcs around what confuses one of them run
    through the others, and touch its own border; the slivers between arc and polyline are looked
    at one by one.
    """
    space, position = strategy.space, strategy.task.uncertainty.position
    corners = np.setdiff1d(target.contact.vertices, sofar.contact.vertices)
    none = np.empty(0)
    vertices = told_by_some(space, sets, goals, corners, position, domain)
    found = [Region(Area.empty(), ContactSet(np.empty(0, np.int32), none, none, vertices))]
    rest = areas.difference(target.area, sofar.area)
    for _ in range(ROUNDS):
        parts = [Region(part, ContactSet.empty()) for part in rest.parts]
        more = [
            one
            for part in parts
            for goal in goals
            if not (one := recognised(space, sets, goal, part, position, domain).region).is_empty
        ]
        if not more:
            break
        found += more
        for one in more:
            rest = areas.difference(rest, one.area)
    return found


def _holding(target: Region, features: Features) -> Region:
    """The part of a target that holds every motion for sure."""
    contact = target.contact
    on = features.surely[contact.edge]
    corners = contact.vertices[features.surely_vertex[contact.vertices]]
    return Region(
        Area.empty(), ContactSet(contact.edge[on], contact.low[on], contact.high[on], corners)
    )
