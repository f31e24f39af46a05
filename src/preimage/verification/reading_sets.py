"""What can be read at each feature, straight from theory 3: forces, hulls, and who is alike."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.task.uncertainty import Uncertainty

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

QUARTER = 0.5 * math.pi

STEPS = 32
"""In so many steps a piece is looked through on which the magnitude of a sum is a sine wave."""

HALVINGS = 60
"""So often the step in which it passes a threshold is halved."""


@dataclass(frozen=True, slots=True, eq=False)
class ReadingSets:
    """Reading sets: free space is `2n`, edge `i` is `i`, vertex `i` is `n + i`.

    Parameters
    ----------
    zero : (2n+1,) whether 0 can be read.
    low, high : (2n+1,) the hull of the directions that can be read, as offsets from `-v` in
        radians, an open interval; `inf` and `-inf` where none can.
    tolerance : sets that are no further apart have a reading in common; radians.
    """

    zero: Bools
    low: Floats
    high: Floats
    tolerance: float

    def alike(self, feature: int) -> Bools:
        """(2n+1,) which features have a reading in common with this one."""
        found: Bools = self.zero & self.zero[feature]
        if self.low[feature] <= self.high[feature]:
            for turn in (-math.tau, 0.0, math.tau):
                found = found | (
                    (self.low + turn <= self.high[feature] + self.tolerance)
                    & (self.high + turn >= self.low[feature] - self.tolerance)
                )
        return found

    def common(self, feature: int, other: int) -> float | None:
        """A reading that two features that are alike have in common, as an offset; None for 0."""
        if self.zero[feature] and self.zero[other]:
            return None
        for turn in (-math.tau, 0.0, math.tau):
            low = max(self.low[other] + turn, self.low[feature])
            high = min(self.high[other] + turn, self.high[feature])
            if low <= high + self.tolerance:
                return float(0.5 * (low + high))
        return None


def reading_sets(
    contact: ContactSpace,
    direction: float,
    uncertainty: Uncertainty,
    friction: float,
    tolerance: float,
) -> ReadingSets:
    """The reading sets of all features for the commanded direction `v` (theory 3).

    An edge pushes back by the table of theory 2. A vertex reads what either edge reads, what the
    sum of both forces reads, and, if it is concave and holds `v*`, what `-v*` reads; of the
    directions the hull. Open sides read nothing.

    Parameters
    ----------
    direction, friction : `v` and `phi`, radians.
    tolerance : ties nearer than this count as both; radians.
    """
    count = len(contact)
    control = uncertainty.control
    sensing = _Sensing(friction, uncertainty.force_thresholds, tolerance)
    # all angles are taken from -v, in whose frame -v* is in [-theta, theta]
    normals = [_wrapped(normal - direction - math.pi) for normal in contact.normal.tolist()]
    known = np.zeros(count, dtype=np.bool_)
    sets = [sensing.edge(normal, control) for normal in normals]
    zero = np.zeros(2 * count + 1, dtype=np.bool_)
    low, high = np.full(2 * count + 1, math.inf), np.full(2 * count + 1, -math.inf)
    for edge in range(count):
        known[edge] = not contact.open[edge]
        if known[edge]:
            zero[edge], low[edge], high[edge] = sets[edge]
    for vertex, before in enumerate(contact.previous.tolist()):
        every = [(bool(zero[edge]), low[edge], high[edge]) for edge in (before, vertex)]
        if known[vertex] and known[before]:
            pair = normals[before], normals[vertex]
            every.append(sensing.both(pair, control))
            if contact.concave[vertex]:
                every.append(sensing.held(pair, control))
        place = count + vertex
        zero[place] = any(one[0] for one in every)
        low[place] = min(one[1] for one in every)
        high[place] = max(one[2] for one in every)
    zero[-1] = True
    error = uncertainty.force_angle
    return ReadingSets(zero, low - error, high + error, tolerance)


Set = tuple[bool, float, float]
_NOTHING: Set = (False, math.inf, -math.inf)


@dataclass(frozen=True, slots=True)
class _Sensing:
    """What is felt of forces: see `reading_sets`; a set is zero or not, lowest and highest."""

    friction: float
    thresholds: tuple[float, float]
    tolerance: float

    def edge(self, normal: float, control: float) -> Set:
        """An edge's, over `-v*` in [-control, control]; the normal is in the same frame."""
        least, most = -control - normal, control - normal  # of a = angle(nu, -v*), not wrapped
        zero, lowest, highest = _NOTHING
        for turn in (-math.tau, 0.0, math.tau):
            first, last = max(least + turn, -math.pi), min(most + turn, math.pi)
            if first > last:
                continue
            far = max(abs(first), abs(last))
            zero |= self._magnitude(far + self.tolerance) <= self.thresholds[1]
            reach = self._felt()
            if reach is None or max(first, -last, 0.0) > reach + self.tolerance:
                continue
            ends = max(first, -reach), min(last, reach)
            phi = self.friction
            lowest = min(lowest, normal - turn + max(-phi, min(phi, min(ends))))
            highest = max(highest, normal - turn + max(-phi, min(phi, max(ends))))
        return zero, _near(lowest), _near(highest)

    def held(self, pair: tuple[float, float], control: float) -> Set:
        """What `-v*` reads where a concave vertex holds `v*`."""
        begin = pair[0] - self.friction
        width = (pair[1] - pair[0]) % math.tau + 2.0 * self.friction
        lowest, highest, holds = math.inf, -math.inf, False
        for turn in (-math.tau, 0.0, math.tau, 2.0 * math.tau):
            first = max(begin + turn - self.tolerance, -control)
            last = min(begin + turn + width + self.tolerance, control)
            if first <= last:
                holds = True
                lowest, highest = min(lowest, first), max(highest, last)
        zero = holds and self.thresholds[1] >= 1.0
        return (
            (zero, lowest, highest) if holds and self.thresholds[0] < 1.0 else (zero, *_NOTHING[1:])
        )

    def both(self, pair: tuple[float, float], control: float) -> Set:
        """What the sum of both edges' forces reads.

        Between the offsets at which an edge begins to stick, to slide or to be left, the sum is a
        linear image of `-v*`: its direction is extreme at an end of such a piece, or where its
        magnitude passes the threshold.
        """
        breaks = {-control, control}
        for normal in pair:
            for at in (-QUARTER, -self.friction, self.friction, QUARTER):
                offset = _wrapped(normal + at)
                if -control < offset < control:
                    breaks.add(offset)
        zero, lowest, highest = _NOTHING
        ends = sorted(breaks)
        pieces = list(pairwise(ends)) or [(ends[0], ends[0])]
        for first, last in pieces:
            states = tuple(self._state(0.5 * (first + last) - normal) for normal in pair)
            if not any(states):
                zero = True
                continue
            for _, magnitude, angle in self._samples(pair, states, first, last):
                zero |= magnitude <= self.thresholds[1] + self.tolerance
                if magnitude > max(self.thresholds[0] - self.tolerance, self.tolerance):
                    lowest, highest = min(lowest, angle), max(highest, angle)
        return zero, lowest, highest

    def _samples(
        self, pair: tuple[float, float], states: tuple[int, ...], first: float, last: float
    ) -> list[tuple[float, float, float]]:
        """Offsets in a piece, with magnitude and direction: its ends, and where a threshold is."""
        step = (last - first) / STEPS
        offsets = [first + step * index for index in range(STEPS)] + [last]
        found = [(at, *self._sum(pair, states, at)) for at in offsets]
        place = min(range(len(found)), key=lambda index: found[index][1])
        low, high = offsets[max(place - 1, 0)], offsets[min(place + 1, STEPS)]
        for _ in range(HALVINGS):  # down to the least magnitude
            thirds = low + (high - low) / 3.0, high - (high - low) / 3.0
            sizes = [self._sum(pair, states, at)[0] for at in thirds]
            low, high = (low, thirds[1]) if sizes[0] <= sizes[1] else (thirds[0], high)
        found = sorted([*found, (low, *self._sum(pair, states, low))])
        for before, after in pairwise(tuple(found)):
            for threshold in self.thresholds:
                if (before[1] - threshold) * (after[1] - threshold) < 0.0:
                    low, high = before[0], after[0]
                    for _ in range(HALVINGS):
                        middle = 0.5 * (low + high)
                        size = self._sum(pair, states, middle)[0]
                        if (size - threshold) * (before[1] - threshold) > 0.0:
                            low = middle
                        else:
                            high = middle
                    found.extend((at, *self._sum(pair, states, at)) for at in (low, high))
        return found

    def _state(self, a: float) -> int:
        """What an edge does: 0 leaves, 1 sticks, 2 and 3 slides to either side."""
        off = _wrapped(a)
        if abs(off) <= self.friction:
            return 1
        if abs(off) > QUARTER:
            return 0
        return 2 if off > 0.0 else 3

    def _sum(
        self, pair: tuple[float, float], states: tuple[int, ...], offset: float
    ) -> tuple[float, float]:
        """Magnitude and direction of the sum, with each edge in its state."""
        x = y = 0.0
        for normal, state in zip(pair, states, strict=True):
            if state == 1:
                size, angle = 1.0, offset
            elif state:
                size = math.cos(offset - normal) / max(math.cos(self.friction), 1e-300)
                angle = normal + (self.friction if state == 2 else -self.friction)
            else:
                continue
            x, y = x + size * math.cos(angle), y + size * math.sin(angle)
        return math.hypot(x, y), math.atan2(y, x)

    def _magnitude(self, a: float) -> float:
        """The magnitude of an edge's force, by theory 2."""
        if abs(a) <= self.friction:
            return 1.0
        if abs(a) >= QUARTER:
            return 0.0
        return math.cos(a) / math.cos(self.friction)

    def _felt(self) -> float | None:
        """Up to which |a| a force is above the lower threshold; None if none is."""
        if self.thresholds[0] >= 1.0:
            return None
        return max(self.friction, math.acos(self.thresholds[0] * math.cos(self.friction)))


def _wrapped(angle: float) -> float:
    """The same angle in [-pi, pi)."""
    return (angle + math.pi) % math.tau - math.pi


def _near(offset: float) -> float:
    return offset if math.isinf(offset) else _wrapped(offset)
