"""The ranges that the values of a task must lie in: one table for the parser and the schema."""

from __future__ import annotations

import math
from dataclasses import dataclass

from preimage.errors import TaskError

MAX_COORDINATE = 1e9
"""Coordinates are at most this, either way: their products stay far from overflow."""

MAX_VERTICES = 1_000_000
"""Vertices of all obstacles together; as many for the goal and for the start."""

MAX_ROBOT_VERTICES = 1_000
"""Vertices of the robot, since obstacles grow by their number times it."""

MIN_WINDOW = 1e-9
"""The window's sides are at least this long, so that areas stay far from underflow."""

RESOLUTION = 1e-6
"""The window's sides are at least this fraction of its coordinates, and of those of everything in
the task: with 1e-16 for the rounding of numbers, 1e-10 of the window is left to resolve."""

MAX_DIRECTIONS = 3_600
"""Directions of motion, one for each tenth of a degree."""

MAX_NAME = 100
"""Characters of a task's name."""


@dataclass(frozen=True, slots=True)
class Range:
    """An interval of numbers, and how a refusal puts it.

    >>> CONTROL.words
    'at least 0 and below 90 degrees'
    >>> 90 in CONTROL, 0 in CONTROL
    (False, True)
    """

    low: float
    high: float
    low_open: bool = False
    high_open: bool = False
    unit: str = ""

    def __contains__(self, value: float) -> bool:
        """Whether the value lies in the interval; NaN does not."""
        above = value > self.low if self.low_open else value >= self.low
        below = value < self.high if self.high_open else value <= self.high
        return above and below

    @property
    def words(self) -> str:
        """The interval in words."""
        parts = []
        if math.isfinite(self.low):
            parts.append(f"{'above' if self.low_open else 'at least'} {self.low:g}")
        if math.isfinite(self.high):
            parts.append(f"{'below' if self.high_open else 'at most'} {self.high:g}")
        return " and ".join(parts) + (f" {self.unit}" if self.unit else "")


COORDINATE = Range(-MAX_COORDINATE, MAX_COORDINATE)
CONTROL = Range(0.0, 90.0, high_open=True, unit="degrees")
POSITION = Range(0.0, MAX_COORDINATE)
FORCE_ANGLE = Range(0.0, 180.0, high_open=True, unit="degrees")
THRESHOLD = Range(0.0, MAX_COORDINATE)
FRICTION = Range(0.0, 90.0, unit="degrees")
COEFFICIENT = Range(0.0, math.inf)
RADIUS = Range(0.0, MAX_COORDINATE, low_open=True)
DIRECTION = Range(-36_000.0, 36_000.0, unit="degrees")
DIRECTIONS = Range(2, MAX_DIRECTIONS)
STEPS = Range(1, 64)
REGIONS = Range(1, 10_000_000)
TIME_LIMIT = Range(0.0, 1e9, low_open=True, unit="seconds")
ARC_TOLERANCE = Range(0.0, 0.1, low_open=True)
DIRECTION_RESOLUTION = Range(1e-4, 45.0, unit="degrees")


def check_count(vertices: int, key: str) -> None:
    """Refuse more vertices than can be looked at."""
    if vertices > MAX_VERTICES:
        raise TaskError(key, f"must have {MAX_VERTICES} vertices in all or fewer, not {vertices}")
