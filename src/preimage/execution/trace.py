"""What happened in one run: where the robot was, what drove it, what was read, how it ended."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from preimage.configuration.contact import Floats, Ints
from preimage.display import Shown
from preimage.strategy.strategy import Strategy


class Outcome(Enum):
    """How a run ended."""

    SUCCESS = "in the goal, and known to be"
    FAILED = "failed, and known to have"
    WRONG = "stopped outside the goal"
    ESCAPED = "left through an open side"
    ENDLESS = "never stopped, outside the goal"
    UNKNOWN = "in the goal, without knowing it"
    BROKEN = "the readings contradicted the model"

    @property
    def as_planned(self) -> bool:
        """Whether the plan kept its promise: it ended in the goal, or knows that it has failed."""
        return self in (Outcome.SUCCESS, Outcome.FAILED)


@dataclass(frozen=True, slots=True, eq=False)
class Leg:
    """One motion of a run: straight and at constant speed from each instant to the next.

    Parameters
    ----------
    region : id of the plan's region in which the motion was commanded.
    direction : the commanded direction, radians.
    times : (k,) ascending, from the beginning of the run; times are in units of length.
    places : (k, 2) where the robot was.
    features : (k,) what it touched: edge i is i, vertex i is n + i, free space is 2 n.
    actual : (k,) the actual direction from this instant to the next, radians; the last stands for
        the force at the end.
    measured : (k, 2) what the position sensor read at each instant; NaN without one.
    forces : (k,) what the force sensor read, radians; NaN where it read 0.
    ended_by : the termination condition that ended the motion, in a word; empty if none did.
    """

    region: int
    direction: float
    times: Floats
    places: Floats
    features: Ints
    actual: Floats
    measured: Floats
    forces: Floats
    ended_by: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Trace(Shown):
    """One run of a plan.

    Parameters
    ----------
    control, sensing : names of the adversaries that nature played.
    number : which of the runs it was.
    words : what went wrong, if anything did.
    """

    strategy: Strategy = field(repr=False)
    legs: tuple[Leg, ...] = field(repr=False)
    outcome: Outcome
    control: str = ""
    sensing: str = ""
    number: int = 0
    words: str = ""

    @property
    def time(self) -> float:
        """How long the run took, in units of length."""
        return float(self.legs[-1].times[-1]) if self.legs else 0.0
