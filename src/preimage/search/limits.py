"""What stops a search before it is done."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a search has come.

    Parameters
    ----------
    regions : regions made.
    layer : the number of motions that the search is at.
    best : in words, what comes nearest to a solution.
    seconds : since the start.
    """

    regions: int
    layer: int
    best: str
    seconds: float


@dataclass(slots=True)
class Limits:
    """Bounds on one search, asked before every piece of work.

    Parameters
    ----------
    time_limit : seconds; None for no bound.
    max_regions : how many regions may be made.
    cancelled : asked from time to time whether to stop.
    """

    time_limit: float | None
    max_regions: int
    cancelled: Callable[[], bool] | None = None
    began: float = field(default_factory=time.monotonic)

    @property
    def seconds(self) -> float:
        """The time spent."""
        return time.monotonic() - self.began

    def exceeded(self, regions: int) -> str | None:
        """Which limit has been reached, in words; None if none has."""
        if self.cancelled is not None and self.cancelled():
            return "interrupted"
        if self.time_limit is not None and self.seconds >= self.time_limit:
            return f"the time limit of {self.time_limit:g} s came first"
        if regions >= self.max_regions:
            return f"the limit of {self.max_regions} regions came first"
        return None


def too_long(max_steps: int) -> str:
    """That a plan, if there is one, has more motions than are allowed, in words."""
    return f"the limit of {max_steps} motions came first"
