"""What drives and what reads the robot in the engine: errors within the task's bounds."""

from __future__ import annotations

import math
from enum import Enum

import numpy as np

from preimage.geometry.angles import angle_of, wrap
from preimage.physics.plant import Plant, length_of
from preimage.task.task import Task

Point = tuple[float, float]


class Steering(Enum):
    """How the actual direction errs: always within the cone."""

    STEADY = "one deviation all the time"
    EXTREME = "to one end of the cone or the other, now and then to the other"
    WANDERING = "a new deviation now and then"


class Sensing(Enum):
    """How the readings err: always within their bounds."""

    OFFSET = "one error near the bound all the time"
    INDEPENDENT = "a new error at every reading"


BETWEEN = {Steering.EXTREME: 10.0, Steering.WANDERING: 2.0}
"""Lengths between two changes, on average."""


class Nature:
    """The errors of one run.

    Parameters
    ----------
    task : its bounds.
    steering, sensing : how the errors come.
    generator : all chance is drawn from it.
    """

    def __init__(
        self,
        task: Task,
        plant: Plant,
        steering: Steering,
        sensing: Sensing,
        generator: np.random.Generator,
    ) -> None:
        bounds = task.uncertainty
        within = 1.0 - plant.reserve
        self._random = generator
        self._steering = steering
        self._steady = sensing is Sensing.OFFSET
        self._control = bounds.control
        self._position = within * bounds.position
        self._turn = within * bounds.force_angle
        self._thresholds = bounds.force_thresholds
        self._between = BETWEEN.get(steering, math.inf) * length_of(task)
        self._deviation = self._control * generator.uniform(-1.0, 1.0)
        if steering is Steering.EXTREME:
            self._deviation = math.copysign(self._control, self._deviation)
        self._changes = self._next_change(0.0)
        way = generator.uniform(-math.pi, math.pi)
        self._offset = (math.cos(way), math.sin(way))
        self._offset_turn = generator.choice((-1.0, 1.0))

    def deviation(self, time: float) -> float:
        """By how much the actual direction is off, radians."""
        while time >= self._changes:
            if self._steering is Steering.EXTREME:
                self._deviation = -self._deviation
            else:
                self._deviation = self._control * self._random.uniform(-1.0, 1.0)
            self._changes = self._next_change(self._changes)
        return self._deviation

    def position(self, place: Point) -> Point:
        """What the position sensor reads there; NaN without one."""
        if not math.isfinite(self._position):
            return math.nan, math.nan
        if self._steady:
            x, y = self._offset
            return place[0] + self._position * x, place[1] + self._position * y
        way = self._random.uniform(-math.pi, math.pi)
        far = self._position * math.sqrt(self._random.uniform())
        return place[0] + far * math.cos(way), place[1] + far * math.sin(way)

    def force(self, felt: Point) -> float | None:
        """What the force sensor reads: a direction in radians, or None for 0."""
        size = math.hypot(*felt)
        low, high = self._thresholds
        if size <= low or (size <= high and self._random.uniform() < 0.5):
            return None
        share = self._offset_turn if self._steady else self._random.uniform(-1.0, 1.0)
        return float(wrap(angle_of(*felt) + self._turn * share))

    def _next_change(self, time: float) -> float:
        if not math.isfinite(self._between):
            return math.inf
        return time + self._random.exponential(self._between)
