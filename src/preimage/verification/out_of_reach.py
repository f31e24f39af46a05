"""Whether the goal is out of reach from where a plan gives it up."""

from __future__ import annotations

import math
from collections.abc import Iterator

from preimage.configuration import contact_set
from preimage.configuration import region as regions
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.strategy.strategy import Strategy
from preimage.task.options import Continuous, uniform_directions
from preimage.task.task import Task
from preimage.verification.forward import forward_projection
from preimage.verification.proof import MARGIN, shrunk
from preimage.verification.verdict import Fault, Finding, Verdict

BESIDE = 4.0 * MARGIN
"""Motions may lead so many tolerances beside what is claimed: borders are drawn up to rounding."""

AROUND = 4
"""Directions that stand for all; their cones are widened until they meet."""


def out_of_reach(strategy: Strategy) -> list[Finding]:
    """What is wrong with a plan's regions of failure, all taken together (theory 7).

    They must hold nothing of the goal, and hold all motions that begin in them, whatever is
    commanded of what the task allows; but that those may leave the window. Borders are drawn up to
    rounding: as in the proof of a motion, what is near to them is left out.
    """
    if not strategy.failures:
        return []
    space, task = strategy.space, strategy.task
    goal, lost = goal_region(task, space), Region.empty()
    for end in strategy.failures:
        lost = regions.union(lost, end.region, space.tolerance)
    if _meets(lost, goal, space):
        words = "what is given up holds a part of the goal"
        return [Finding(Fault.REACH, Verdict.REFUTED, words)]
    findings = []
    slack = BESIDE * space.tolerance.length
    for direction, control in _commands(task):
        inside = shrunk(lost, space, (direction - control, direction + control))
        found = forward_projection(space, inside, direction, control, task.friction)
        contact = contact_set.without_outermost(found.contact, space.contact)
        along = f"along {math.degrees(direction):.6g}°"
        if _meets(Region(found.area, contact), goal, space):
            words = f"from where the goal is given up, a motion {along} may lead to it"
            findings.append(Finding(Fault.REACH, Verdict.REFUTED, words))
        elif not (
            contact_set.is_subset(contact, lost.contact, slack)
            and areas.is_subset(found.area, lost.area, slack)
        ):
            words = f"from where the goal is given up, a motion {along} may lead elsewhere"
            findings.append(Finding(Fault.REACH, Verdict.UNPROVEN, words))
    return findings


def _commands(task: Task) -> Iterator[tuple[float, float]]:
    """Directions with their control errors, which hold all that nature may make of commands."""
    control, directions = task.uncertainty.control, task.options.directions
    if not isinstance(directions, Continuous):
        yield from ((direction, control) for direction in directions)
        return
    for direction in uniform_directions(AROUND):
        yield direction, max(control, math.pi / AROUND)


def _meets(a: Region, b: Region, space: ConfigurationSpace) -> bool:
    """Whether two regions have more in common than borders."""
    near = space.tolerance.length
    if not contact_set.intersection(a.contact, b.contact, near).is_empty:
        return True
    return not areas.regularised(areas.intersection(a.area, b.area), near).is_empty
