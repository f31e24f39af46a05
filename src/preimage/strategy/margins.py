"""How much slack a plan has: of its start, its sensors and its drive."""

from __future__ import annotations

import math
from dataclasses import dataclass

from preimage.task.degrees import to_degrees, to_radians
from preimage.task.task import Task

HUNDREDTH = 0.01
"""Where the position error is no unit, this share of the window's larger side is one."""


@dataclass(frozen=True, slots=True)
class Margins:
    """How far each assumption of a plan may be off, one at a time, while it holds.

    All are lower bounds: that much was shown to be harmless. Infinite where nothing bounds it.

    Parameters
    ----------
    start : how far inside its first region the start lies, within its features: a length. None
        where a reading chooses the first region.
    reading : with a position error that is larger by this length, the same directions still make
        a plan. None if nothing is known.
    force : the same for the error of a measured force's direction, radians. None without a force
        sensor, or if nothing is known.
    direction : every commanded direction may be off by this, all at once, radians. None if nothing
        is known.
    """

    start: float | None
    reading: float | None
    force: float | None
    direction: float | None

    def smallest(self, task: Task) -> float:
        """The smallest margin in units of the bound that it widens; 0 where one is not known.

        Lengths count in position errors, or hundredths of the window's larger side where that is
        0 or infinite; angles in the control error or the force's, or degrees where those are 0.

        >>> from preimage.task.examples import named_task
        >>> task = named_task("flat-floor")  # a position error of 0.1, a control error of 10°
        >>> Margins(0.05, math.inf, math.inf, to_radians(6.0)).smallest(task)
        0.5
        """
        bounds = task.uncertainty
        length, turn = length_unit(task), angle_unit(bounds.control)
        shares = [_share(self.start, length), _share(self.reading, length)]
        shares.append(_share(self.direction, turn))
        if bounds.has_force_sensor:
            shares.append(_share(self.force, angle_unit(bounds.force_angle)))
        return min(shares)

    @property
    def words(self) -> str:
        """The margins in a line, angles in degrees.

        >>> Margins(0.12, math.inf, None, to_radians(3.0)).words
        'start 0.12, position error unbounded, every direction ±3°'
        """
        parts = [f"start {_length(self.start)}"]
        more = "+" if self.reading is not None and math.isfinite(self.reading) else ""
        parts.append(f"position error {more}{_length(self.reading)}")
        if self.force is not None:
            more = "+" if math.isfinite(self.force) else ""
            parts.append(f"force angle {more}{_angle(self.force)}")
        known = self.direction is not None and math.isfinite(self.direction)
        parts.append(f"every direction {'±' if known else ''}{_angle(self.direction)}")
        return ", ".join(parts)


def length_unit(task: Task) -> float:
    """The length that a plan's margins are compared in."""
    error = task.uncertainty.position
    if 0.0 < error < math.inf:
        return error
    return HUNDREDTH * larger_side(task)


def larger_side(task: Task) -> float:
    """The length of the window's larger side."""
    xmin, ymin, xmax, ymax = task.workspace.window.bounds
    return max(xmax - xmin, ymax - ymin)


def angle_unit(bound: float) -> float:
    """The angle that a margin of a bound is compared in, radians."""
    return bound if bound > 0.0 else to_radians(1.0)


def _share(margin: float | None, unit: float) -> float:
    return 0.0 if margin is None else margin / unit


def _length(value: float | None) -> str:
    if value is None:
        return "unknown"
    return "unbounded" if math.isinf(value) else f"{value:.3g}"


def _angle(value: float | None) -> str:
    if value is None:
        return "unknown"
    return "unbounded" if math.isinf(value) else f"{to_degrees(value):.3g}°"
