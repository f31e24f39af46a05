"""The environment: command a direction, read the sensors, say when the goal is reached."""

from __future__ import annotations

import math
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from preimage.environment.world import Place, World, new_lots
from preimage.errors import InputError, shown
from preimage.execution.control import CONTROLS
from preimage.execution.sensing import SENSINGS
from preimage.task.examples import named_task
from preimage.task.task import Task

Observation = dict[str, NDArray[np.float64]]
Action = Any

STEPS_ACROSS = 120.0
"""Steps in which the robot crosses the window."""


class GuardedMotion(gymnasium.Env[Observation, Action]):
    """A robot with uncertain motion and senses, which has to reach a goal and to say that it did.

    Each step commands a direction for a while, or says “here I am”: then the episode ends, well if
    the robot truly is in the goal. Nature chooses all errors within the task's bounds. What the
    robot may know is the observation; the truth is in `info["truth"]`, for who judges.

    Observations are `position`, (2,) as measured, 0 without a sensor; `force`, (2,) the unit vector
    of the measured force, 0 where none is read; `time`, (1,) since the episode began.

    Parameters
    ----------
    task : a task, or the name of a named one.
    directions : so many commands all round and one more action, which says “here I am”
        (`Discrete`); with None, an action is `(x, y, here)` in [-1, 1], which commands the
        direction of `(x, y)`, or says it where `here > 0` (`Box`).
    control, sensing : who plays nature, by name (`preimage.execution`); `"any"`: another one in
        each episode.
    step : how long a command is kept, in units of length; 1/120 of the window by default.
    patience : the episode is cut short after so much time; 10 windows by default.
    reward, penalty, cost : for a true “here I am”; for a false one, and for leaving the window; for
        each step.

    Raises
    ------
    InputError : an option is out of its range.
    """

    metadata = {"render_modes": ["ansi"], "render_fps": 20}  # noqa: RUF012 (as its base has it)

    def __init__(
        self,
        task: Task | str = "peg-in-hole",
        *,
        directions: int | None = 8,
        control: str = "random",
        sensing: str = "noise",
        step: float | None = None,
        patience: float | None = None,
        reward: float = 1.0,
        penalty: float = 1.0,
        cost: float = 0.0,
        render_mode: str | None = None,
    ) -> None:
        self.world = World(named_task(task) if isinstance(task, str) else task)
        self.render_mode = render_mode
        xmin, ymin, xmax, ymax = self.world.space.window
        across = max(xmax - xmin, ymax - ymin)
        self.step_time = _positive("step", across / STEPS_ACROSS if step is None else step)
        self.patience = _positive("patience", 10.0 * across if patience is None else patience)
        self._nature = _known("control", control, CONTROLS), _known("sensing", sensing, SENSINGS)
        self._reward, self._penalty, self._cost = reward, penalty, cost
        self.directions = directions
        self.action_space = _actions(directions)
        senses = self.world.task.uncertainty
        reach = senses.position if senses.has_position_sensor else 0.0
        low = np.minimum(np.array([xmin, ymin]) - reach, 0.0) - 1e-6 * across
        high = np.maximum(np.array([xmax, ymax]) + reach, 0.0) + 1e-6 * across
        self._box = spaces.Box(low, high, dtype=np.float64)
        self.observation_space: spaces.Space[Any] = spaces.Dict(
            {
                "position": self._box,
                "force": spaces.Box(-1.0, 1.0, (2,), dtype=np.float64),
                "time": spaces.Box(0.0, 2.0 * self.patience, (1,), dtype=np.float64),
            }
        )
        self._place: Place | None = None
        self._time = 0.0
        self._direction = 0.0
        self._outcome = ""

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin anew, anywhere in the task's start; nothing is felt before the first command."""
        super().reset(seed=seed)
        names = [
            table[int(self.np_random.integers(len(table)))] if name == "any" else name
            for name, table in zip(self._nature, (list(CONTROLS), list(SENSINGS)), strict=True)
        ]
        self._control, self._sensing = CONTROLS[names[0]], SENSINGS[names[1]]
        self._names = names
        self._lots = new_lots(self.np_random)
        self._place = self.world.begin(self.np_random)
        self._time, self._direction, self._outcome = 0.0, 0.0, ""
        observation = self._observation()
        observation["force"] = np.zeros(2)
        return observation, self._info()

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Command a direction for a while, or say “here I am”."""
        assert self._place is not None, "reset first"
        direction = self._commanded(action)
        if direction is None:
            true = self.world.is_in_goal(self._place)
            self._outcome = "in the goal, and said so" if true else "said so, and is not there"
            gain = self._reward if true else -self._penalty
            return self._observation(), gain, True, False, self._info()
        if direction != self._direction:
            self._place = Place(self._place.robots)
        self._direction = direction
        self._place = self.world.move(
            self._place, direction, self.step_time, self._control, self._lots, self.np_random
        )
        self._time += self.step_time
        if self._place.escaped:
            self._outcome = "left the window"
            return self._observation(), -self._penalty, True, False, self._info()
        late = self._time >= self.patience
        if late:
            self._outcome = "took too long"
        return self._observation(), 0.0 - self._cost, False, late, self._info()

    def action_of(self, direction: float | None) -> Action:
        """The action that commands a direction, radians, or says “here I am” where it is None.

        With a number of directions it is the nearest one.
        """
        if self.directions is None:
            if direction is None:
                return np.array([0.0, 0.0, 1.0])
            return np.array([math.cos(direction), math.sin(direction), -1.0])
        if direction is None:
            return self.directions
        return round(direction * self.directions / (2.0 * math.pi)) % self.directions

    def render(self) -> str:
        """Where the robot is, in a line."""
        assert self._place is not None, "reset first"
        x, y = self._place.point
        end = f": {self._outcome}" if self._outcome else ""
        told = math.degrees(self._direction) % 360.0
        return f"t = {self._time:.4g}: at ({x:.4g}, {y:.4g}), told {told:.4g}°{end}\n"

    def _commanded(self, action: Action) -> float | None:
        """The direction that an action commands, radians; None where it says “here I am”."""
        if self.directions is not None:
            number = int(action)
            if number == self.directions:
                return None
            return 2.0 * math.pi * number / self.directions
        x, y, here = (float(part) for part in action)
        return None if here > 0.0 else math.atan2(y, x)

    def _observation(self) -> Observation:
        assert self._place is not None
        sensed = self.world.sense(
            self._place, self._direction, self._control, self._sensing, self._lots, self.np_random
        )
        position = np.array(sensed.position)
        box = self._box
        force = sensed.force
        push = (0.0, 0.0) if force is None else (math.cos(force), math.sin(force))
        return {
            "position": np.clip(np.nan_to_num(position, nan=0.0), box.low, box.high),
            "force": np.array(push),
            "time": np.array([self._time]),
        }

    def _info(self) -> dict[str, Any]:
        assert self._place is not None
        return {
            "truth": {
                "place": np.array(self._place.point),
                "in_goal": self.world.is_in_goal(self._place),
            },
            "control": self._names[0],
            "sensing": self._names[1],
            "outcome": self._outcome,
        }


def _actions(directions: int | None) -> spaces.Space[Any]:
    if directions is None:
        return spaces.Box(-1.0, 1.0, (3,), dtype=np.float64)
    if not directions >= 1 or directions != int(directions):
        raise InputError("directions", f"must be a whole number of at least 1, not {directions}")
    return spaces.Discrete(directions + 1)


def _positive(name: str, value: float) -> float:
    if not 0.0 < value < math.inf:
        raise InputError(name, f"must be finite and more than 0, not {shown(value)}")
    return value


def _known(name: str, chosen: str, table: dict[str, Any]) -> str:
    if chosen != "any" and chosen not in table:
        raise InputError(name, f"must be one of {', '.join(table)}, any, not {shown(chosen)}")
    return chosen
