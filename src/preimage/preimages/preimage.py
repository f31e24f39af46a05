"""Preimages: from where one motion surely reaches, and recognises, a goal."""

from __future__ import annotations

from dataclasses import dataclass

from preimage.configuration.region import Region
from preimage.display import Shown
from preimage.reachability.backprojection import Backprojection
from preimage.recognition.termination import Condition
from preimage.task.options import Method


@dataclass(frozen=True, slots=True, eq=False)
class Target:
    """What a motion aims at, and how it is known to be there.

    Parameters
    ----------
    region : the part of the goal whose attainment is recognised.
    sticking, kernel : the parts of it by which it is recognised: where the motion sticks for sure,
        and what no reading confuses with anything outside the goal.
    """

    region: Region
    sticking: Region
    kernel: Region

    @classmethod
    def of_kernel(cls, kernel: Region) -> Target:
        """A target that readings alone tell."""
        return cls(kernel, Region.empty(), kernel)


@dataclass(frozen=True, slots=True, eq=False)
class Preimage(Shown):
    """A region from which a motion along `direction` surely ends in a goal (paper 4, 8).

    Which of the goals it is, is known when the motion ends.

    Parameters
    ----------
    region : the starts. Empty where the method finds none.
    direction : the commanded direction, radians.
    target : what the motion aims at, a part of the goal.
    termination : the conditions; the first that holds ends the motion.
    backprojection : the stage that gave the region.
    """

    region: Region
    direction: float
    goals: tuple[Region, ...]
    method: Method
    target: Target
    termination: tuple[Condition, ...]
    backprojection: Backprojection

    @property
    def goal(self) -> Region:
        """The goal, where there is one alone."""
        return self.goals[0]
