"""What the readings of a run contradict, and in which words (theory 2, 3)."""

from __future__ import annotations

import math
from enum import Enum

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.space import ConfigurationSpace
from preimage.execution.program import CompiledMotion, force_blind
from preimage.recognition.interpretation import Interpretation, contained
from preimage.recognition.outside import Outside
from preimage.recognition.readings import Readings
from preimage.strategy.strategy import Strategy


class Assumption(Enum):
    """What a plan counts on."""

    READING = "every reading is whole and later than the one before"
    START = "the robot starts where the task says"
    POSITION = "a measured position is nearer than the position error"
    FORCE = "a measured force is one that what is touched can give"
    SPEED = "the robot is no faster than its speed of 1"
    CONTROL = "the robot moves within the cone of control errors"
    FRICTION = "the robot sticks where the plan says it does, and there alone"
    TIME = "the robot makes the progress that the plan guarantees"


Blame = tuple[Assumption, str]


def blame(
    strategy: Strategy, motion: CompiledMotion, x: float, y: float, force: float | None
) -> Blame:
    """Which assumption a reading breaks that nothing in preimage and target can give.

    Slow: everything is looked at, by the plain definitions. A robot that is looked at too rarely
    may leave its region through a thin target; that cannot be told from a control error.
    """
    space, radius = strategy.space, strategy.task.uncertainty.position
    if math.isfinite(radius):
        apart = space.free.distance(x, y)
        if apart >= radius + 2.0 * space.tolerance.length:
            return _outside(space, x, y, apart, radius)
    valid = Outside(space.free, ContactSet.whole(space.contact))
    near = f"within {radius:.6g} of ({x:.6g}, {y:.6g})" if math.isfinite(radius) else "anywhere"
    push = "no push" if force is None else f"a push at {math.degrees(force):.6g}°"
    if _misses(space, motion.readings, (x, y), force, radius, valid):
        return Assumption.FORCE, f"nothing {near} gives {push}"
    within = f"region {motion.region.id}"
    if _misses(space, force_blind(space), (x, y), None, radius, motion.within):
        rarely = ", or ran through its target between two readings" if motion.by_reading else ""
        return Assumption.CONTROL, f"the robot has left {within}{rarely}: nothing of it is {near}"
    return Assumption.CONTROL, f"nothing of {within} {near} gives {push}"


def _outside(space: ConfigurationSpace, x: float, y: float, apart: float, radius: float) -> Blame:
    edge, _ = space.contact.index.nearest(x, y)
    if edge >= 0 and space.contact.open[edge]:
        return Assumption.CONTROL, f"({x:.6g}, {y:.6g}) is beyond an open side of the window"
    words = f"({x:.6g}, {y:.6g}) is {apart:.3g} from all free space, more than {radius:.6g}"
    return Assumption.POSITION, words


def _misses(
    space: ConfigurationSpace,
    readings: Readings,
    place: tuple[float, float],
    force: float | None,
    radius: float,
    rest: Outside,
) -> bool:
    told = Interpretation(place, radius, readings.can_read(force))
    return contained(space, readings, told, rest)
