"""The robot as a physical thing: how heavy, how stiff, how often looked at, how exact."""

from __future__ import annotations

import math
from dataclasses import dataclass

from preimage.task.task import Task

WINDOW_PARTS = 50.0
"""Without a position error to compare with, the window's larger side over this is the length."""

SHORTEST = 1e-3
"""The length is at least this part of the window's larger side."""


@dataclass(frozen=True, slots=True)
class Plant:
    """What the engine is asked to simulate, in terms of the task's *length*: its position error.

    Nothing here is known to the planner, whose robot has no mass and is seen at all times.

    Parameters
    ----------
    settling : the time constant m / B with which the robot takes up a commanded velocity.
    steps : how many of the engine's steps make a settling time.
    every : the sensors are read at every so many steps.
    smoothing : the time constant of the force sensor's filter; all force sensors have one.
    pause : so long after a motion has begun nothing is read, since the force is still that of the
        motion before; the filter begins anew then.
    settled : a force counts that the filter has found, and whose direction it has found to within
        so much, radians. What is read before, at an impact, is kept from the executor.
    longest : but no longer than this: soft contacts in a corner may tremble for ever.
    reserve : errors are drawn within `1 - reserve` of the bounds of position and force angle. The
        rest is the margin that has to absorb what the planner's model leaves out.
    slack : so far from the goal, or outside the window, a robot still counts as in it: it coasts,
        contact gives way, and forces come late.
    """

    settling: float = 0.02
    steps: int = 4
    every: int = 4
    smoothing: float = 0.04
    pause: float = 0.1
    settled: float = math.radians(1.0)
    longest: float = 0.5
    reserve: float = 0.1
    slack: float = 0.1

    @property
    def step(self) -> float:
        """The engine's time step."""
        return self.settling / self.steps


def length_of(task: Task) -> float:
    """The length that a task is simulated by: the position error, if there is one to speak of."""
    window = task.workspace.window
    extent = max(window.xmax - window.xmin, window.ymax - window.ymin)
    if not task.uncertainty.has_position_sensor:
        return extent / WINDOW_PARTS
    return min(max(task.uncertainty.position, SHORTEST * extent), extent / 20.0)
