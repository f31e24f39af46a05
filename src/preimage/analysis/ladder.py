"""How the answer changes along one axis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from preimage.analysis.axis import KEYS, Axis, Bound
from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.task.options import Method

SAMPLES = 32
"""Of an axis that is not monotone so many parts are looked at."""


@dataclass(slots=True, eq=False)
class Ladder:
    """Bisects the changes of the answer along an axis, down to neighbouring values.

    What is not monotone is sampled first. Between two values with the same answer nothing changes
    along a monotone axis; along another one nothing is known to.

    Parameters
    ----------
    known : outcomes by place.
    blind : the outcome without a position sensor, once it is known.
    """

    axis: Axis
    method: Method
    known: dict[int, Outcome] = field(default_factory=dict)
    blind: Outcome | None = None

    @property
    def spacing(self) -> int:
        """How many steps samples are apart."""
        return max(1, -(-self.axis.steps // SAMPLES))

    @property
    def unbounded(self) -> bool:
        """Whether there is a plan without a position sensor."""
        return self.blind is not None and self.blind.answer is Answer.SOLVED

    @property
    def stretches(self) -> list[tuple[int, int, Outcome]]:
        """First and last place of each answer, and the answer; ascending."""
        found: list[tuple[int, int, Outcome]] = []
        for place in sorted(self.known):
            outcome = self.known[place]
            if found and _same(found[-1][2], outcome):
                found[-1] = (found[-1][0], place, found[-1][2])
            else:
                found.append((place, place, outcome))
        return found

    def cell_of(self, value: float) -> Cell:
        """The cell in which the axis has this value, and all else is as given."""
        return Cell.at(self.method, **{self.axis.key: value})

    def wanted(self) -> Sequence[Cell]:
        """What is to be looked at next."""
        if not self.known:
            places = [0, self.axis.steps]
            if not self.axis.monotone:
                places += range(0, self.axis.steps, self.spacing)
            cells = [self.cell_of(self.axis.value(place)) for place in sorted(set(places))]
            if self.axis.key == KEYS[Bound.POSITION]:
                cells.append(self.cell_of(math.inf))
            return cells
        return [
            self.cell_of(self.axis.value((low + high) // 2))
            for low, high in pairwise(sorted(self.known))
            if high - low > 1 and not _same(self.known[low], self.known[high])
        ]

    def learn(self, cell: Cell, outcome: Outcome) -> None:
        """Take in what was found."""
        ((_, value),) = cell.values
        if math.isinf(value):
            self.blind = outcome
        else:
            self.known[round((value - self.axis.low) / self.axis.step)] = outcome


def _same(one: Outcome, other: Outcome) -> bool:
    return (one.answer, one.motions) == (other.answer, other.motions)
