"""A strategy as data: what is commanded from where, until when, and what holds then."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.display import Shown
from preimage.recognition.termination import Condition
from preimage.strategy.margins import Margins
from preimage.strategy.reason import Reason
from preimage.task.options import StrategyKind
from preimage.task.task import Task


class Status(Enum):
    """How planning ended."""

    SOLVED = "solved"
    UNSOLVABLE = "unsolvable"  # for these directions and this method
    STOPPED = "stopped"  # a limit came first


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """A guarded motion: what is commanded in a preimage (paper 3.2).

    Parameters
    ----------
    direction : the commanded direction, radians in [0, 2 pi).
    goals : ids of the regions in one of which the motion ends.
    target : what the motion aims at: kernel, sticking features, or both.
    termination : the conditions; the first one that holds ends the motion.
    margin : radians: with any direction no further off than this, commanded instead, the motion
        keeps the same promise under the same conditions, whatever other motions make of their own
        margins. None if nothing is known.
    """

    direction: float
    goals: tuple[int, ...]
    target: Region
    termination: tuple[Condition, ...]
    margin: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class StrategyRegion:
    """The goal, a preimage with its motion, or a region of known failure (files.md).

    Parameters
    ----------
    id : its number; 0 is the goal.
    rank : how many motions may remain from here; 0 for the goal and for failure.
    motion : None for the goal and for failure.
    failure : from here the goal cannot be reached any more; a plan that ends here has failed, and
        knows it (theory 7).
    """

    id: int
    rank: int
    region: Region
    motion: Motion | None
    failure: bool = False


@dataclass(frozen=True, slots=True)
class Statistics:
    """What planning took: regions made, seconds, preimages computed, and sweep events."""

    regions: int = 0
    seconds: float = 0.0
    preimages: int = 0
    pruned: int = 0
    layers: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Strategy(Shown):
    """The answer of the planner: regions, where to start, and for a linear plan its steps.

    Parameters
    ----------
    regions : by ascending id; the goal first. Of a solved linear plan, the regions that it uses;
        else all that were found.
    start : ids of the regions that may be chosen at the start.
    steps : for a linear plan, the regions in the order of execution, the goal left out.
    why : what stands in the way where there is no strategy, the most promising direction first.
    certain : for a plan that may know its failure, the part of the start from which it surely ends
        in the goal; None if nothing is known. Plan files do not hold it.
    hope : False if such a plan is known to fail always; plan files do not hold it either.
    margins : how much slack a solved plan has; None if it was not asked for.
    """

    task: Task
    space: ConfigurationSpace
    status: Status
    kind: StrategyKind
    regions: tuple[StrategyRegion, ...]
    start: tuple[int, ...]
    steps: tuple[int, ...]
    statistics: Statistics
    reason: str = ""  # which limit stopped the planner, or the comparison of plans
    why: tuple[Reason, ...] = ()
    certain: Region | None = None
    hope: bool = True
    margins: Margins | None = None

    @property
    def failures(self) -> tuple[StrategyRegion, ...]:
        """The regions of known failure; none if all that is planned ends in the goal."""
        return tuple(region for region in self.regions if region.failure)

    @property
    def can_succeed(self) -> bool:
        """Whether motions lead from its start to the goal at all; that they may is not said."""
        todo, seen = list(self.start), set(self.start)
        while todo:
            motion = self.region(todo.pop()).motion
            following = set(motion.goals) - seen if motion else set()
            seen |= following
            todo += following
        return self.hope and 0 in seen

    def region(self, number: int) -> StrategyRegion:
        """The region with this id."""
        return next(region for region in self.regions if region.id == number)
