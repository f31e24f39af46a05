"""The readings of the last period, in bounded memory whatever the rate."""

from __future__ import annotations

SLOTS = 256
"""Of readings that come faster than a period has slots, some are passed over: what is remembered
from before a period is then older by up to a slot, which is sound for a condition of sticking."""


class History:
    """Positions that were read, and when: a ring that is filled and emptied by time.

    >>> history = History()
    >>> history.begin(2.0)
    >>> for time in range(5):
    ...     history.add(float(time), 10.0 * time, 0.0)
    >>> history.before(4.0 - 2.0)
    (20.0, 0.0)
    """

    __slots__ = ("_first", "_gap", "_kept", "_times", "_x", "_y")

    def __init__(self) -> None:
        self._times = [0.0] * SLOTS
        self._x = [0.0] * SLOTS
        self._y = [0.0] * SLOTS
        self.begin(0.0)

    def begin(self, period: float) -> None:
        """Forget everything; from now on what lies a period back will be asked for."""
        self._first = 0
        self._kept = 0
        self._gap = period / (SLOTS - 2)

    def add(self, time: float, x: float, y: float) -> None:
        """Remember a reading, which is later than all before."""
        if self._kept:
            last = (self._first + self._kept - 1) % SLOTS
            if time - self._times[last] < self._gap:
                return
            if self._kept == SLOTS:  # nobody has asked for a while
                self._first = (self._first + 1) % SLOTS
                self._kept -= 1
        place = (self._first + self._kept) % SLOTS
        self._times[place] = time
        self._x[place] = x
        self._y[place] = y
        self._kept += 1

    def before(self, time: float) -> tuple[float, float] | None:
        """The latest remembered position that was read at or before a time; None if there is none.

        Times may not fall from call to call: what is older is forgotten.
        """
        while self._kept > 1 and self._times[(self._first + 1) % SLOTS] <= time:
            self._first = (self._first + 1) % SLOTS
            self._kept -= 1
        if not self._kept or self._times[self._first] > time:
            return None
        return self._x[self._first], self._y[self._first]
