"""What nature knows when she chooses: the motion, the robots, and what would do most harm."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.random import Generator

from preimage.configuration import contact_set
from preimage.configuration.contact import Bools, Floats
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.errors import InputError
from preimage.execution.nearest import outline
from preimage.execution.simulator import Bytes, Choices, Robots, Simulator, Wish
from preimage.geometry.angles import wrap
from preimage.mechanics.behaviour import Behaviour
from preimage.reachability.sources import sources
from preimage.task.uncertainty import Uncertainty

LOTS = 4
"""Numbers that each robot draws once and keeps: for what persists."""


@dataclass(frozen=True, eq=False)
class Conditions:
    """What holds for a whole motion.

    Parameters
    ----------
    direction : v, radians.
    target : what the motion aims at.
    goal : all regions together in one of which it is to end, as segments (s, 4).
    """

    simulator: Simulator
    direction: float
    uncertainty: Uncertainty
    target: Region
    goal: Floats

    @property
    def cone(self) -> float:
        """How far nature may turn the command, radians: theta, less what counts as a tie."""
        return max(0.0, self.uncertainty.control - 2.0 * self.simulator.space.tolerance.angle)

    @cached_property
    def surely_sticks(self) -> Bools:
        """(2n + 1,) the features that hold every actual direction of the cone."""
        edges, vertices = self._behaviour(Behaviour.STICKS_SURELY)
        return np.concatenate((edges, vertices, (False,)))

    @cached_property
    def target_outline(self) -> Floats:
        """(s, 4) the target's borders."""
        return outline(self.simulator.space.contact, self.target)

    @cached_property
    def hazards(self) -> Floats:
        """(s, 4) where a robot may get stuck outside the target, or leave the window."""
        space = self.simulator.space
        contact = space.contact
        edges, vertices = self._behaviour(Behaviour.MAY_STICK)
        whole = ContactSet.whole(contact)
        on = edges[whole.edge]
        stuck = ContactSet(
            whole.edge[on],
            whole.low[on],
            whole.high[on],
            whole.vertices[vertices[whole.vertices]],
        )
        rest = contact_set.difference(stuck, self.target.contact, space.tolerance.length)
        sides = np.concatenate((contact.points, contact.ends), axis=1)[contact.open]
        return np.concatenate((outline(contact, Region(Region.empty().area, rest)), sides))

    def _behaviour(self, what: Behaviour) -> tuple[Bools, Bools]:
        space = self.simulator.space
        control, friction = self.uncertainty.control, self.simulator.friction
        found = sources(space.contact, self.direction, control, friction, space.tolerance)
        return found.where(what)


@dataclass(frozen=True, slots=True, eq=False)
class Situation:
    """What nature sees of k robots before she chooses again.

    Parameters
    ----------
    motion : what holds for the whole motion.
    time : (k,) since the motion began.
    lots : (k, `LOTS`) numbers in [0, 1) that each robot keeps through the run.
    met : (k,) how many contacts each has met since the motion began.
    rng : where chance comes from.
    """

    motion: Conditions
    robots: Robots
    time: Floats
    lots: Floats
    met: np.ndarray[tuple[int], np.dtype[np.int32]]
    rng: Generator

    def __len__(self) -> int:
        return len(self.robots)

    @property
    def cone(self) -> float:
        """How far nature may turn the command, radians."""
        return self.motion.cone

    @property
    def touching(self) -> Bools:
        """(k,) whether each robot is in contact."""
        return self.robots.feature < 2 * len(self.motion.simulator.space.contact)

    @property
    def scale(self) -> float:
        """The larger side of the window."""
        xmin, ymin, xmax, ymax = self.motion.simulator.space.window
        return max(xmax - xmin, ymax - ymin)

    def chance(self) -> Floats:
        """(k,) fresh numbers in [0, 1)."""
        return self.rng.random(len(self))

    def turn_to(self, angle: Floats) -> Floats:
        """(k,) by how much an actual direction differs from the command, radians."""
        return np.asarray(wrap(angle - self.motion.direction))

    def choices(
        self,
        turn: Floats | float,
        duration: Floats | float = np.inf,
        wish: Wish | Bytes = Wish.ANY,
    ) -> Choices:
        """Directions that are turned from the command by so much, as far as the cone allows.

        Parameters
        ----------
        turn : radians, counter-clockwise.
        duration : how long each is kept unless something is met, in units of length.
        """
        count = len(self)
        kept = np.clip(np.broadcast_to(turn, (count,)), -self.cone, self.cone)
        return Choices(
            self.motion.direction + kept,
            np.array(np.broadcast_to(duration, (count,)), dtype=np.float64),
            np.array(np.broadcast_to(wish, (count,)), dtype=np.uint8),
            self.chance(),
        )

    def admissible(self, chosen: Choices) -> Choices:
        """The same choices, with directions brought back into the cone.

        Raises
        ------
        InputError : there is not one of each for every robot, or one is no number.
        """
        columns = (chosen.angle, chosen.duration, chosen.chance, chosen.wish)
        if any(np.shape(column) != (len(self),) for column in columns):
            raise InputError("adversary", f"must choose for each of {len(self)} robots")
        angle, duration, chance = (np.asarray(column, np.float64) for column in columns[:3])
        if not np.all(np.isfinite(angle)) or not np.all(np.isfinite(chance)):
            raise InputError("adversary", "must choose directions that are numbers")
        if not np.all(duration >= 0.0):
            raise InputError("adversary", "must choose durations that are not negative")
        turn = np.clip(self.turn_to(angle), -self.cone, self.cone)
        wish = np.asarray(chosen.wish, dtype=np.uint8)
        return Choices(self.motion.direction + turn, duration, wish, chance)

    def part(self, which: Bools) -> Situation:
        """Of some of the robots alone."""
        return replace(
            self,
            robots=self.robots.part(which),
            time=self.time[which],
            lots=self.lots[which],
            met=self.met[which],
        )
