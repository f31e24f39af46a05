"""The errors of control and sensing."""

from __future__ import annotations

import math
from dataclasses import dataclass

from preimage.errors import TaskError
from preimage.task import checks, limits


@dataclass(frozen=True, slots=True)
class Uncertainty:
    """The bounds of control and sensing errors (theory 2, 3).

    Parameters
    ----------
    control : half-angle θ of the cone of actual directions, radians, in `[0, π/2)`.
    position : position error ρ, in the unit of length; infinite without a position sensor.
    force_angle : error ε of a measured force's direction, radians, in `[0, π)`.
    force_thresholds : forces up to the first are read as 0, above the second never, between
        them either way: `ω₁ ≤ ω₂`. Both infinite without a force sensor: then all is read as 0.

    Raises
    ------
    TaskError : if a bound is out of its range.
    """

    control: float
    position: float
    force_angle: float = 0.0
    force_thresholds: tuple[float, float] = (math.inf, math.inf)

    def __post_init__(self) -> None:
        """Refuse bounds that are out of range."""
        control = checks.angle(self.control, "uncertainty.control", limits.CONTROL)
        object.__setattr__(self, "control", control)
        position = checks.extended(self.position, "uncertainty.position", limits.POSITION)
        object.__setattr__(self, "position", position)
        if self.force_thresholds == (math.inf, math.inf):
            object.__setattr__(self, "force_angle", 0.0)
            return
        turn = checks.angle(self.force_angle, "uncertainty.force.angle", limits.FORCE_ANGLE)
        object.__setattr__(self, "force_angle", turn)
        key = "uncertainty.force.threshold"
        pair = checks.items(self.force_thresholds, key)
        if len(pair) != 2:
            raise TaskError(key, f"must be one number or two, not {len(pair)}")
        low, high = (
            checks.number(value, f"{key}[{index}]", limits.THRESHOLD)
            for index, value in enumerate(pair)
        )
        if low > high:
            raise TaskError(key, f"must not fall, but {low:.9g} is above {high:.9g}")
        object.__setattr__(self, "force_thresholds", (low, high))

    @property
    def has_position_sensor(self) -> bool:
        """Whether the position is measured at all."""
        return math.isfinite(self.position)

    @property
    def has_force_sensor(self) -> bool:
        """Whether the force is measured at all."""
        return math.isfinite(self.force_thresholds[0])
