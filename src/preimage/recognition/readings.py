"""Reading sets: what the force sensor may read at each feature (theory 3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import Bools, ContactSpace, Floats
from preimage.geometry.angles import TAU, wrap
from preimage.geometry.tolerance import Tolerance
from preimage.mechanics.reaction import (
    Reactions,
    edge_reactions,
    holding_reactions,
    summed_reactions,
)
from preimage.task.uncertainty import Uncertainty

Indices = NDArray[np.integer[Any]]


@dataclass(frozen=True, slots=True, eq=False)
class Readings:
    """The reading sets `F_v(X)` of all features X of a contact space, for one direction v.

    A feature is a number: edge `i` is `i`, vertex `i` is `n + i`, free space is `2 n`. What is no
    feature, an open side and a vertex between two of them, reads nothing.

    Parameters
    ----------
    direction : v, radians.
    zero : (2n+1,) whether 0 can be read.
    center, half : (2n+1,) the hull of the directions that can be read, an open interval of angles
        around `center`, radians; `half` is `-inf` where none can be read, 0 where one exact
        direction is, and pi where all can be. The hull is what condition and kernel share.
    tolerance : sets that miss each other by less than this have a reading in common; radians.
    """

    direction: float
    zero: Bools
    center: Floats
    half: Floats
    tolerance: float

    @property
    def size(self) -> int:
        """The number n of edges, and of vertices."""
        return len(self.zero) // 2

    @property
    def free(self) -> int:
        """The feature that is free space."""
        return len(self.zero) - 1

    def can_read(self, direction: float | None) -> Bools:
        """(2n+1,) the features that can read this direction, or 0 where it is None."""
        if direction is None:
            return self.zero
        off: Floats = np.abs(wrap(self.center - direction))
        return off <= self.half + self.tolerance


def readings(
    space: ContactSpace,
    direction: float,
    uncertainty: Uncertainty,
    friction: float,
    tolerance: Tolerance,
) -> Readings:
    """The reading sets of all features for the commanded direction v (theory 3, paper 5.4.1).

    An edge reads 0 if some reaction's magnitude is at most the upper threshold, and the directions
    within epsilon of a reaction above the lower one. A vertex reads what either of its edges reads,
    what the sum of both reactions reads, and, if it is concave and holds v*, what -v* reads; of the
    directions the hull. Beside an open side, a vertex reads what its one contact edge reads.

    Parameters
    ----------
    direction, friction : v and phi, radians.
    uncertainty : theta, epsilon and both thresholds; thresholds of infinity say that there is no
        force sensor: then 0 is all that is read.
    """
    control, thresholds = uncertainty.control, uncertainty.force_thresholds
    n = len(space)
    arguments = (direction, control, friction, thresholds, tolerance.angle)
    edges = edge_reactions(space.normal, *arguments)
    zero, low, high = _blank(edges, ~space.open)
    before = space.previous
    weak = np.concatenate((zero, zero | zero[before], (True,)))
    lowest = np.concatenate((low, np.minimum(low, low[before]), (np.inf,)))
    highest = np.concatenate((high, np.maximum(high, high[before]), (-np.inf,)))

    both = ~(space.open | space.open[before])
    concave = np.flatnonzero(both & space.concave)
    holds = holding_reactions(space.normal[before[concave]], space.normal[concave], *arguments)
    _add(weak, lowest, highest, n + concave, holds)
    sums = np.flatnonzero(both & _sum_tells(space, edges, *arguments[:2], tolerance.angle))
    if len(sums):
        total = summed_reactions(space.normal[before[sums]], space.normal[sums], *arguments)
        _add(weak, lowest, highest, n + sums, total)

    felt = lowest <= highest
    lowest, highest = np.where(felt, lowest, 0.0), np.where(felt, highest, 0.0)
    half = np.where(felt, 0.5 * (highest - lowest) + uncertainty.force_angle, -np.inf)
    center = wrap(0.5 * (highest + lowest) + direction + np.pi)
    return Readings(direction, weak, center, np.minimum(half, np.pi), tolerance.angle)


def alike(readings: Readings, feature: int, features: Indices) -> Bools:
    """Which features have a reading in common with this one: `F_v(X) & F_v(Y)` is not empty.

    Touching intervals count as overlapping, within the tolerance (theory 8: ties on the safe side).
    """
    return alike_pairs(readings, np.full(1, feature, dtype=np.intp), features)


def alike_pairs(readings: Readings, first: Indices, second: Indices) -> Bools:
    """The same pair by pair, with numpy's broadcasting."""
    apart = np.abs(readings.center[first] - readings.center[second])
    apart = np.minimum(apart, TAU - apart)
    reach = readings.half[first] + readings.half[second] + readings.tolerance
    return (readings.zero[first] & readings.zero[second]) | (apart <= reach)


def _blank(edges: Reactions, contact: Bools) -> tuple[Bools, Floats, Floats]:
    """The edges' reactions, none on open sides."""
    return (
        edges.weak & contact,
        np.where(contact, edges.low, np.inf),
        np.where(contact, edges.high, -np.inf),
    )


def _add(weak: Bools, low: Floats, high: Floats, features: Indices, more: Reactions) -> None:
    weak[features] |= more.weak
    low[features] = np.minimum(low[features], more.low)
    high[features] = np.maximum(high[features], more.high)


def _sum_tells(
    space: ContactSpace, edges: Reactions, direction: float, control: float, tolerance: float
) -> Bools:
    """(n,) vertices at which the sum of both reactions may be read as neither of them can be.

    The sum's direction lies between theirs, and theirs no further apart than the normals: so it
    tells something new only where one alone is too weak to be felt, or where both are felt and
    nearly cancel, more than two thirds of a half turn apart.
    """
    off = np.abs(wrap(space.normal - direction - np.pi))
    pushes = off - control <= 0.5 * np.pi + tolerance
    before = space.previous
    weak_alone = ~((edges.low <= edges.high) & (edges.low <= edges.high)[before])
    apart = np.abs(wrap(space.normal - space.normal[before])) >= 2.0 * np.pi / 3.0 - tolerance
    return pushes & pushes[before] & (weak_alone | apart)
