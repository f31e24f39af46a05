"""How the answer changes over two axes, from fewer cells than there are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from preimage.analysis.axis import Axis
from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.task.options import Method

Ints = NDArray[np.int16]

NONE = np.int16(np.iinfo(np.int16).max)
"""Stands for the number of motions where there is no plan: more than any."""

UNKNOWN = np.int16(-1)
"""Stands for it where no answer was had: a limit came first, or there is no such task."""


class Grid:
    """The motions that one method needs at every pair of values, by bisection.

    Where an axis is monotone, the motions at a place are bounded by those at places before and
    behind it, and a place of which both bounds meet is not looked at. Rows are bisected coarse to
    fine, so that each bounds its neighbours. Where no axis is monotone every cell is looked at.

    Parameters
    ----------
    x, y : the axes.

    Attributes
    ----------
    low, high : (nx, ny), bounds of the motions; equal once a cell is decided.
    outcomes : of the cells that were looked at, by place.
    """

    def __init__(self, x: Axis, y: Axis, method: Method) -> None:
        self.x, self.y, self.method = x, y, method
        shape = x.steps + 1, y.steps + 1
        self.low: Ints = np.zeros(shape, dtype=np.int16)
        self.high: Ints = np.full(shape, NONE, dtype=np.int16)
        self.outcomes: dict[tuple[int, int], Outcome] = {}
        self._strides = _strides(y.steps) if y.monotone else [1]
        self._place = {self.cell_of(i, j): (i, j) for i in range(shape[0]) for j in range(shape[1])}

    def cell_of(self, i: int, j: int) -> Cell:
        """The cell at a place."""
        return Cell.at(self.method, **{self.x.key: self.x.value(i), self.y.key: self.y.value(j)})

    @property
    def motions(self) -> Ints:
        """(nx, ny), the motions; `NONE` without a plan, `UNKNOWN` where there was no answer."""
        found = self.high.copy()
        for place, outcome in self.outcomes.items():
            if _motions(outcome) is None:
                found[place] = UNKNOWN
        return found

    def wanted(self) -> Sequence[Cell]:
        """The middles of what is undecided, in the coarsest rows that have any."""
        if not self.outcomes:
            corners = {(0, 0), (self.x.steps, self.y.steps)}
            return [self.cell_of(*place) for place in sorted(corners)]
        undecided = self.low != self.high
        while self._strides:
            rows = range(0, self.y.steps + 1, self._strides[0])
            places = [place for j in rows for place in self._in_row(undecided[:, j], j)]
            if places:
                return [self.cell_of(*place) for place in places]
            self._strides.pop(0)
        return []

    def _in_row(self, undecided: NDArray[np.bool_], j: int) -> list[tuple[int, int]]:
        """The places of one row that are looked at next."""
        places = np.flatnonzero(undecided)
        if not self.x.monotone:
            # nothing is known of neighbours in the row; columns bound each other, coarse to fine
            return [(int(i), j) for i in places]
        runs = np.split(places, np.flatnonzero(np.diff(places) > 1) + 1) if len(places) else []
        return [(int(run[len(run) // 2]), j) for run in runs]

    def learn(self, cell: Cell, outcome: Outcome) -> None:
        """Take in what was found, and what follows from it."""
        i, j = place = self._place[cell]
        self.outcomes[place] = outcome
        motions = _motions(outcome)
        if motions is None:
            self.low[place] = self.high[place] = max(self.low[place], 0)
            return
        before = slice(0, i + 1) if self.x.monotone else slice(i, i + 1)
        below = slice(0, j + 1) if self.y.monotone else slice(j, j + 1)
        behind = slice(i, None) if self.x.monotone else slice(i, i + 1)
        above = slice(j, None) if self.y.monotone else slice(j, j + 1)
        self.high[before, below] = np.minimum(self.high[before, below], motions)
        self.low[behind, above] = np.maximum(self.low[behind, above], motions)
        # where a planner were not monotone, what was seen counts
        np.minimum(self.low, self.high, out=self.low)
        self.low[place] = self.high[place] = motions


def _strides(steps: int) -> list[int]:
    """Distances of rows, from coarse to 1."""
    strides = [1]
    while strides[-1] * 2 <= steps:
        strides.append(strides[-1] * 2)
    return strides[::-1]


def _motions(outcome: Outcome) -> np.int16 | None:
    """The motions as a number that grows with difficulty; None without an answer."""
    match outcome.answer:
        case Answer.SOLVED:
            assert outcome.motions is not None
            return np.int16(outcome.motions)
        case Answer.UNSOLVABLE | Answer.TOO_LONG:
            return NONE
        case _:
            return None
