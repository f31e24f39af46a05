"""Where there is room in a picture: for the arrow of a command, and for names beside regions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from preimage.geometry.area import Area

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Box = tuple[float, float, float, float]

MOST_CELLS = 96
"""Cells along the longer side of a lattice."""

CELL = 3.5
"""Points: the side of a cell, where the picture is not too large for that."""

TAKEN = 1000.0
"""Cost of what must not be covered."""


class Lattice:
    """A picture cut into square cells, and what it costs to cover each of them.

    Parameters
    ----------
    box : what the lattice covers, in the unit of length.
    unit : the length of a point on paper.
    """

    def __init__(self, box: Box, unit: float) -> None:
        xmin, ymin, xmax, ymax = box
        wide, high = xmax - xmin, ymax - ymin
        self.cell = max(CELL * unit, max(wide, high) / MOST_CELLS)
        self.columns = max(1, round(wide / self.cell))
        self.rows = max(1, round(high / self.cell))
        self.step = np.array((wide / self.columns, high / self.rows))
        self.x: Floats = xmin + (np.arange(self.columns) + 0.5) * self.step[0]
        self.y: Floats = ymin + (np.arange(self.rows) + 0.5) * self.step[1]
        self.box = box
        self.cost: Floats = np.zeros((self.rows, self.columns))

    def inside(self, area: Area) -> Bools:
        """(rows, columns) the cells whose middle is in an area."""
        if area.is_empty:
            return np.zeros(self.cost.shape, dtype=np.bool_)
        x, y = np.meshgrid(self.x, self.y)
        middles = np.stack((x.ravel(), y.ravel()), axis=1)
        return area.contains_all(middles).reshape(self.cost.shape)

    def along(self, starts: Floats, ends: Floats) -> Bools:
        """The cells through which segments run: (k, 2) starts and (k, 2) ends."""
        hit = np.zeros(self.cost.shape, dtype=np.bool_)
        if not len(starts):
            return hit
        steps = np.hypot(*(ends - starts).T) / (0.5 * self.cell)
        count = np.minimum(np.ceil(steps), 4.0 * MOST_CELLS).astype(np.int64) + 1
        owner = np.repeat(np.arange(len(starts)), count)
        place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
        share = place / np.maximum(count - 1, 1)[owner]
        points = starts[owner] + share[:, None] * (ends - starts)[owner]
        place = np.floor((points - np.array(self.box[:2])) / self.step).astype(np.int64)
        column, row = place[:, 0], place[:, 1]
        seen = (column >= 0) & (column < self.columns) & (row >= 0) & (row < self.rows)
        hit[row[seen], column[seen]] = True
        return hit

    def take(self, x: float, y: float, wide: float, high: float) -> None:
        """Mark a box about a point as taken."""
        column = np.abs(self.x - x) <= 0.5 * (wide + self.cell)
        row = np.abs(self.y - y) <= 0.5 * (high + self.cell)
        self.cost[np.ix_(row, column)] += TAKEN

    def covering(self, wide: float, high: float) -> Floats:
        """(rows, columns) cost of a box about each cell; infinite where it leaves the lattice."""
        half_columns = int(np.ceil(0.5 * wide / self.cell))
        half_rows = int(np.ceil(0.5 * high / self.cell))
        total = np.zeros((self.rows + 1, self.columns + 1))
        total[1:, 1:] = self.cost.cumsum(axis=0).cumsum(axis=1)
        result = np.full(self.cost.shape, np.inf)
        row = np.arange(half_rows, self.rows - half_rows)
        column = np.arange(half_columns, self.columns - half_columns)
        if not len(row) or not len(column):
            return result
        top, bottom = row[:, None] + half_rows + 1, row[:, None] - half_rows
        right, left = column + half_columns + 1, column - half_columns
        covered = total[top, right] - total[bottom, right] - total[top, left] + total[bottom, left]
        result[np.ix_(row, column)] = covered
        return result

    def clearest(self, wide: float, high: float, penalty: Floats) -> tuple[float, float] | None:
        """The middle of the box that costs least, with a further cost for each middle.

        Of several, that at the upper left; None if the box is larger than the lattice.
        """
        order = np.arange(self.columns)[None, :] - np.arange(self.rows)[:, None]
        cost = np.round(self.covering(wide, high) + penalty, 6) + 1e-9 * order
        best = int(np.argmin(cost))
        row, column = divmod(best, self.columns)
        if not np.isfinite(cost[row, column]):
            return None
        return float(self.x[column]), float(self.y[row])

    def from_corners(self) -> Floats:
        """(rows, columns) distance from the nearest corner, as a fraction of the diagonal."""
        across = np.minimum(np.arange(self.columns), np.arange(self.columns)[::-1])
        up = np.minimum(np.arange(self.rows), np.arange(self.rows)[::-1])
        away: Floats = np.hypot(across[None, :], up[:, None])
        away /= np.hypot(self.columns, self.rows)
        return away

    def from_point(self, x: float, y: float) -> Floats:
        """(rows, columns) distance from a point, in the unit of length."""
        away: Floats = np.hypot(self.x[None, :] - x, self.y[:, None] - y)
        return away


def distance(mask: Bools) -> Floats:
    """How many steps each cell is from a mask; 0 inside."""
    reached = np.pad(mask, 1)
    result = np.zeros(mask.shape)
    while mask.any() and not reached[1:-1, 1:-1].all():
        result += ~reached[1:-1, 1:-1]
        larger = reached.copy()
        larger[1:-1, 1:-1] |= (
            reached[:-2, 1:-1] | reached[2:, 1:-1] | reached[1:-1, :-2] | reached[1:-1, 2:]
        )
        reached = larger
    return result


def depth(mask: Bools) -> Floats:
    """How many cells each cell is inside a mask, horizontally and vertically; 0 outside."""
    padded = np.pad(mask, 1)
    result = np.zeros(mask.shape)
    while padded.any():
        result += padded[1:-1, 1:-1]
        smaller = padded.copy()
        smaller[1:-1, 1:-1] &= (
            padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
        )
        padded = smaller
    return result
