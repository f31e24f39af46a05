"""A plan as an agent of the environment."""

from __future__ import annotations

import math
from typing import Any

from preimage.environment.guarded import GuardedMotion, Observation
from preimage.execution.executor import Answer, Executor
from preimage.execution.program import Program, compiled
from preimage.strategy.strategy import Strategy


class PlanAgent:
    """Carries a plan out in the environment: observations in, actions out.

    Parameters
    ----------
    strategy : solved. With a number of directions the environment must have those of the plan.

    Raises
    ------
    PlanFileError : the plan is not solved.
    """

    def __init__(self, strategy: Strategy) -> None:
        self._program: Program = compiled(strategy)
        self._executor: Executor | None = None
        self.answer: Answer | None = None

    def act(self, environment: GuardedMotion, observation: Observation) -> Any:
        """The next action; the first observation of an episode begins the plan anew.

        Where the plan is known to have failed, or the readings contradict the model, the robot
        says nothing and keeps its last command: it is not in the goal, or does not know it.
        """
        (time,) = observation["time"].tolist()
        x, y = observation["position"].tolist()
        fx, fy = observation["force"].tolist()
        if time == 0.0 or self._executor is None:
            self._executor = Executor(self._program)
            self.answer = self._executor.start(time, x, y)
        else:
            force = None if fx == fy == 0.0 else math.atan2(fy, fx)
            self.answer = self._executor.read(time, x, y, force)
        if self.answer.command is not None:
            self._last = environment.action_of(self.answer.command)
            return self._last
        if self.answer.doing.name == "DONE":
            return environment.action_of(None)
        return getattr(self, "_last", environment.action_of(0.0))
