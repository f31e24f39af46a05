"""What many runs of a plan came to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from preimage.display import Shown
from preimage.execution.trace import Outcome, Trace
from preimage.strategy.strategy import Strategy


@dataclass(frozen=True, slots=True)
class Tally:
    """The runs under one pair of adversaries.

    Parameters
    ----------
    outcomes : how many runs ended how; outcomes that did not occur are left out.
    time, distance, motions : mean and largest of all runs, in units of length, and a count.
    """

    control: str
    sensing: str
    runs: int
    outcomes: Mapping[Outcome, int]
    time: tuple[float, float]
    distance: tuple[float, float]
    motions: tuple[float, int]

    @property
    def failures(self) -> int:
        """How many runs did not end as planned: in the goal, or in known failure."""
        return sum(many for outcome, many in self.outcomes.items() if not outcome.as_planned)


@dataclass(frozen=True, slots=True, eq=False)
class Report(Shown):
    """All runs.

    Parameters
    ----------
    tallies : one for each pair of adversaries.
    failure : the first run that did not end as planned, whole.
    slowest : of the runs that ended as planned, the one that took longest.
    samples : some runs of each pair, for pictures.
    """

    strategy: Strategy = field(repr=False)
    tallies: tuple[Tally, ...] = field(repr=False)
    failure: Trace | None
    slowest: Trace | None
    samples: tuple[Trace, ...] = field(repr=False)
    seconds: float = 0.0

    @property
    def runs(self) -> int:
        """How many there were."""
        return sum(tally.runs for tally in self.tallies)

    @property
    def failures(self) -> int:
        """How many did not end as planned: in the goal, or in known failure."""
        return sum(tally.failures for tally in self.tallies)

    @property
    def outcomes(self) -> dict[Outcome, int]:
        """How many ended how, in the order of `Outcome`."""
        found = {
            outcome: sum(tally.outcomes.get(outcome, 0) for tally in self.tallies)
            for outcome in Outcome
        }
        return {outcome: count for outcome, count in found.items() if count}
