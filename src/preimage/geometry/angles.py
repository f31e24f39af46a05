"""Angles and directions: radians, counter-clockwise positive, wrapped to (-pi, pi]."""

from __future__ import annotations

import math
from typing import overload

import numpy as np
from numpy.typing import NDArray

TAU = 2.0 * math.pi


@overload
def wrap(angle: float) -> float: ...
@overload
def wrap(angle: NDArray[np.float64]) -> NDArray[np.float64]: ...
def wrap(angle: float | NDArray[np.float64]) -> float | NDArray[np.float64]:
    """The same angle in (-pi, pi].

    >>> wrap(-math.pi) == math.pi
    True
    >>> wrap(0.25)
    0.25
    """
    if isinstance(angle, np.ndarray):
        turns: NDArray[np.float64] = np.ceil(angle / TAU - 0.5)
        return angle - TAU * turns
    if -math.pi < angle <= math.pi:
        return angle
    return angle - TAU * math.ceil(angle / TAU - 0.5)


def unit(angle: float) -> tuple[float, float]:
    """The unit vector at `angle`, exact at multiples of a quarter turn.

    >>> unit(-math.pi / 2)
    (0.0, -1.0)
    """
    quarter = angle / (0.5 * math.pi)
    nearest = round(quarter)
    if abs(quarter - nearest) < 4 * np.finfo(float).eps * max(1.0, abs(quarter)):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[nearest % 4]
    return math.cos(angle), math.sin(angle)


def angle_of(x: float, y: float) -> float:
    """The angle of the vector (x, y), in (-pi, pi].

    >>> angle_of(0.0, -2.0) == -math.pi / 2
    True
    """
    return wrap(math.atan2(y, x))
