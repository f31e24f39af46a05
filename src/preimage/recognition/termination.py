"""Termination conditions, as data (theory 5, 6, paper 5.2, 5.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from preimage.recognition.outside import Domain

DISPLACEMENT = 5.0
"""In `period` a motion that does not stick gets this many times rho along v (paper 5.2)."""

DISTANCE = 2.5
"""A motion that gets no further than this many times rho, as measured, sticks (paper 5.2)."""


@dataclass(frozen=True, slots=True)
class StickingCondition:
    """Stop when the measured position has moved by at most `distance` over the last `period`.

    Parameters
    ----------
    period : a time, in units of length: the commanded speed is 1.
    distance : `2 rho <= distance < s * period - 2 rho`, with s the guaranteed progress along v.
    """

    period: float
    distance: float


@dataclass(frozen=True, slots=True, eq=False)
class ReadingCondition:
    """Stop when `K_v(q, f) & Delta` lies in the target.

    Parameters
    ----------
    domain : Delta; all of valid space if None.
    """

    domain: Domain = None


@dataclass(frozen=True, slots=True)
class ElapsedCondition:
    """Stop when `period` has passed since the motion began: no sensor is needed.

    Parameters
    ----------
    period : a time, in units of length: the commanded speed is 1.
    """

    period: float


Condition = StickingCondition | ReadingCondition | ElapsedCondition


def sticking_condition(
    progress: float, position: float, *, extent: float = math.inf, resolution: float = 0.0
) -> StickingCondition | ElapsedCondition:
    """The condition that recognises sticking (theory 6, paper 5.2).

    With the displacement `5 rho` in `period = 5 rho / s`, measured positions of a motion that does
    not stick are at least `3 rho` apart, and of one that sticks less than `2 rho`; `distance` is
    `2.5 rho`. Without a position sensor nothing moves visibly: then the time is waited for in
    which the motion certainly has arrived.

    Parameters
    ----------
    progress : s, the guaranteed progress along v; positive.
    position : rho.
    extent : the longest displacement along v of any motion to the target; needed if rho is
        infinite.
    resolution : the least displacement that can be told from none, where rho is smaller, as with
        rho = 0; in the unit of length.

    Raises
    ------
    ValueError : if no bound follows: without progress, or with nothing to measure it by.

    >>> sticking_condition(0.5, 0.25)
    StickingCondition(period=2.5, distance=0.625)
    >>> sticking_condition(0.5, math.inf, extent=4.0).period >= 8.0
    True
    """
    if not progress > 0.0:
        raise ValueError(f"progress is {progress}, must be positive")
    if math.isinf(position):
        if not math.isfinite(extent):
            raise ValueError("without a position sensor the longest displacement must be known")
        return ElapsedCondition(math.nextafter(extent / progress, math.inf))
    scale = max(position, resolution)
    if scale == 0.0:
        raise ValueError("with an exact position sensor a resolution must be given")
    return StickingCondition(DISPLACEMENT * scale / progress, DISTANCE * scale)
