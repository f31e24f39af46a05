"""The one tolerance of the project, scaled by the window."""

from __future__ import annotations

import math
from dataclasses import dataclass

RELATIVE_LENGTH = 1e-10
"""Lengths closer than this fraction of the scene's scale are the same length."""

ANGLE = 1e-10
"""Angles closer than this (radians) are the same angle."""

GRID_BITS = 40
"""Contact space lives on a grid of 2^-40 of the scale: 12 bits coarser than doubles, far finer
than the tolerance, so that touching obstacles share their vertices exactly."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """What counts as equal in one scene.

    Parameters
    ----------
    length : lengths (in the task's unit) up to this one are ties, decided on the safe side.
    angle : the same for angles, in radians.
    grid : spacing of the grid on which contact space is noded; a power of two.
    """

    length: float
    angle: float
    grid: float

    @classmethod
    def for_window(cls, xmin: float, ymin: float, xmax: float, ymax: float) -> Tolerance:
        """The tolerance of a scene in this window.

        >>> Tolerance.for_window(-10, -6, 10, 10).length
        2e-09
        """
        scale = max(abs(xmin), abs(ymin), abs(xmax), abs(ymax), xmax - xmin, ymax - ymin)
        return cls(
            length=RELATIVE_LENGTH * scale,
            angle=ANGLE,
            grid=2.0 ** (math.ceil(math.log2(scale)) - GRID_BITS),
        )
