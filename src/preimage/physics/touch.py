"""The force sensor's filter, and whether what it says has settled."""

from __future__ import annotations

import math

from preimage.geometry.angles import angle_of, wrap
from preimage.physics.plant import Plant

Point = tuple[float, float]


class Touch:
    """A force, smoothed over the looks.

    The planner's model is quasi-static: a force is that of what is touched, at once. An engine's
    contact comes and goes from step to step, hits at first, and turns as the robot rolls off a
    corner that is round; of the smoothed force, only what has settled is compared with the model.

    Parameters
    ----------
    plant : the filter, and what counts as settled.
    threshold : a smaller force is none.
    """

    def __init__(self, plant: Plant, threshold: float) -> None:
        self._share = -math.expm1(-plant.every * plant.step / plant.smoothing)
        self._settled, self._threshold = plant.settled, threshold
        self._felt = self._latest = (0.0, 0.0)

    @property
    def felt(self) -> Point:
        """The force, smoothed."""
        return self._felt

    @property
    def is_settled(self) -> bool:
        """Whether the filter and the latest force agree: both are none, or point the same way."""
        some = math.hypot(*self._felt) > self._threshold
        if some != (math.hypot(*self._latest) > self._threshold):
            return False
        turn = float(wrap(angle_of(*self._latest) - angle_of(*self._felt))) if some else 0.0
        return abs(turn) <= self._settled

    def add(self, force: Point) -> None:
        """The mean force since the look before."""
        self._latest = force
        x, y = (old + self._share * (new - old) for old, new in zip(self._felt, force, strict=True))
        self._felt = (x, y)

    def forget(self) -> None:
        """Let the filter begin anew with the latest force."""
        self._felt = self._latest
