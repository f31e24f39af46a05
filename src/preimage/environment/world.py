"""One robot in a task, driven step by step, with nature's errors (theory 2, 3)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from preimage.configuration.contact import Floats
from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, start_region
from preimage.execution.chunk import SLACK
from preimage.execution.control import Control
from preimage.execution.nearest import outline
from preimage.execution.sensing import Sensing, read
from preimage.execution.simulator import Choices, Manner, Robots, Simulator, advance
from preimage.execution.situation import LOTS, Conditions, Situation
from preimage.execution.starts import is_in, of_start
from preimage.task.task import Task

MOST_MEETINGS = 64
"""In one step no more contacts are met than this; a robot that chatters is cut short."""


@dataclass(frozen=True, slots=True, eq=False)
class Sensed:
    """What the robot may know.

    Parameters
    ----------
    position : as measured; NaN, NaN without a sensor.
    force : the angle of the measured force, radians; None where 0 is read.
    """

    position: tuple[float, float]
    force: float | None


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """Where the robot truly is.

    Parameters
    ----------
    robots : it alone.
    time, met : since the command last changed: how long, and how many contacts were met.
    escaped : it has left through an open side.
    """

    robots: Robots
    time: float = 0.0
    met: int = 0
    escaped: bool = False

    @property
    def point(self) -> tuple[float, float]:
        """Its reference point."""
        return float(self.robots.x[0]), float(self.robots.y[0])


class World:
    """A task in which a robot is commanded.

    Parameters
    ----------
    task : its bounds are nature's.
    """

    def __init__(self, task: Task) -> None:
        self.task = task
        self.space: ConfigurationSpace = configuration_space(task)
        self.goal: Region = goal_region(task, self.space)
        self.start: Start = start_region(task, self.space)
        contact = self.space.contact
        self._conditions = Conditions(
            Simulator.of(self.space, task.friction, task.sliding, self.goal),
            0.0,
            task.uncertainty,
            self.goal,
            outline(contact, self.goal),
        )

    def begin(self, rng: Generator) -> Place:
        """A place of the start, by chance: inside, on its borders, at its vertices."""
        return Place(of_start(self.space, self.start, 1, rng))

    def move(
        self,
        place: Place,
        direction: float,
        time: float,
        control: Control,
        lots: Floats,
        rng: Generator,
    ) -> Place:
        """Where the robot is after it was commanded for a time.

        Parameters
        ----------
        direction : commanded, radians.
        time : how long, in units of length.
        lots : (1, LOTS) what nature keeps through the run.
        """
        conditions = replace(self._conditions, direction=direction)
        left, now = time, place
        for _ in range(MOST_MEETINGS):
            if left <= 0.0 or now.escaped:
                break
            seen = self._situation(conditions, now, lots, rng)
            wished = seen.admissible(control(seen))
            limit = np.minimum(wished.duration, left)
            moves = advance(
                conditions.simulator,
                now.robots,
                Choices(wished.angle, limit, wished.wish, wished.chance),
            )
            spent = float(moves.time[0])
            touched = moves.robots.feature[0] != now.robots.feature[0]
            now = Place(
                moves.robots,
                now.time + spent,
                now.met + int(touched and moves.robots.feature[0] < 2 * len(self.space.contact)),
                bool(moves.manner[0] == Manner.ESCAPES) or self._is_outside(moves.robots),
            )
            left -= spent if spent > 0.0 or moves.manner[0] != Manner.RESTS else left
        return now

    def sense(
        self,
        place: Place,
        direction: float,
        control: Control,
        sensing: Sensing,
        lots: Floats,
        rng: Generator,
    ) -> Sensed:
        """What is read while the robot is pushed along a commanded direction."""
        conditions = replace(self._conditions, direction=direction)
        seen = self._situation(conditions, place, lots, rng)
        actual = seen.admissible(control(seen)).angle
        positions, forces = read(sensing, seen, actual)
        x, y = positions[0].tolist()
        force = float(forces[0])
        return Sensed((x, y), None if math.isnan(force) else force)

    def is_in_goal(self, place: Place) -> bool:
        """Whether the robot truly is in the goal."""
        slack = SLACK * self.space.tolerance.length
        return bool(is_in(self.space, self.goal, place.robots, slack)[0])

    def _situation(
        self, conditions: Conditions, place: Place, lots: Floats, rng: Generator
    ) -> Situation:
        met = np.array([place.met], dtype=np.int32)
        return Situation(conditions, place.robots, np.array([place.time]), lots, met, rng)

    def _is_outside(self, robots: Robots) -> bool:
        """At a vertex beside an open side it has escaped, unless that is in the goal."""
        contact = self.space.contact
        vertex = int(robots.feature[0]) - len(contact)
        if not 0 <= vertex < len(contact) or self.goal.contact.has_vertex(vertex):
            return False
        return bool(contact.open[vertex] or contact.open[contact.previous[vertex]])


def new_lots(rng: Generator) -> Floats:
    """What nature keeps through a run."""
    lots: Floats = rng.random((1, LOTS))
    return lots
