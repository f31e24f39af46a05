"""MuJoCo, and all that is asked of it: the only module that knows it."""

from __future__ import annotations

import math
from importlib import import_module
from typing import Any

from preimage.errors import UnsupportedError
from preimage.physics.scene import Scene

Point = tuple[float, float]


def loaded() -> Any:
    """MuJoCo: an extra, loaded when the first scene is played."""
    try:
        return import_module("mujoco")
    except ImportError as error:
        rule = "needs MuJoCo, which is not installed: pip install 'preimage[physics]'"
        raise UnsupportedError("physics", rule) from error


class Engine:
    """One robot in its scene. Lengths and times here are the task's, forces those of the damper.

    The force of a robot that is held is 1, whatever its mass: contact forces are divided by the
    damping, as are those of the model (theory 2).

    Raises
    ------
    UnsupportedError : without MuJoCo.
    """

    def __init__(self, scene: Scene) -> None:
        self._mujoco = loaded()
        self._length = scene.length
        self._model = self._mujoco.MjModel.from_xml_string(scene.mjcf)
        self._data = self._mujoco.MjData(self._model)
        self._settling = scene.plant.settling
        self._force = (0.0, 0.0)

    @property
    def model(self) -> Any:
        """The engine's own model, for its viewer and its renderer."""
        return self._model

    @property
    def data(self) -> Any:
        """The engine's own state."""
        return self._data

    @property
    def step(self) -> float:
        """The time of a step."""
        return float(self._model.opt.timestep) * self._length

    @property
    def time(self) -> float:
        """Since the robot was placed."""
        return float(self._data.time) * self._length

    @property
    def position(self) -> Point:
        """Where the robot's reference point is."""
        x, y = self._data.qpos
        return float(x) * self._length, float(y) * self._length

    @property
    def force(self) -> Point:
        """The sum of the contact forces on the robot, in the plane, over the last `move`."""
        return self._force

    @property
    def depth(self) -> float:
        """How deep the robot is inside an obstacle: contact is soft."""
        if not self._data.ncon:
            return 0.0
        return max(0.0, -float(self._data.contact.dist.min())) * self._length

    def place(self, x: float, y: float) -> None:
        """Put the robot there, at rest, and set the clock to 0."""
        self._mujoco.mj_resetData(self._model, self._data)
        self._data.qpos[:] = x / self._length, y / self._length
        self._mujoco.mj_forward(self._model, self._data)
        self._force = (0.0, 0.0)

    def move(self, direction: float | None, steps: int) -> None:
        """Pull in a direction, or stop, for so many steps."""
        pull = (0.0, 0.0) if direction is None else (math.cos(direction), math.sin(direction))
        self._data.ctrl[:] = pull
        step, whole_x, whole_y = self._mujoco.mj_step, 0.0, 0.0
        for _ in range(steps):
            step(self._model, self._data)
            x, y = self._data.qfrc_constraint.tolist()
            whole_x, whole_y = whole_x + x, whole_y + y
        mean = self._settling / steps
        self._force = whole_x * mean, whole_y * mean
