"""Curved borders on a chosen side: polylines that a curve does not cross.

A curve is cut into pieces, each in the convex hull of its control points and rising along its
chord. The hull's border from end to end, on the left or on the right, then lies on that side of the
piece: both are graphs over the chord, one nowhere below the other. So for a closed border with its
region on the left, the right chains enclose the region and the left ones are enclosed by it (each
replaced piece moves winding numbers one way only), none further off than the hulls are thick.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from preimage.errors import InputError

Floats = NDArray[np.float64]

MAX_PIECES = 100_000
"""Pieces of a border: beyond, the tolerance is not meant."""

MAX_HALVINGS = 48
"""Then a piece is as short as rounding, and its chord stands for it."""

SMOOTH = 1e-12
"""Sine of the angle up to which a curve goes on straight where another piece begins."""


class Hand(Enum):
    """A side of a curve, seen in its direction of travel."""

    LEFT = 1
    RIGHT = -1


@dataclass(frozen=True, slots=True, eq=False)
class Bezier:
    """A Bézier curve of any degree; of two points, a segment.

    Parameters
    ----------
    points : (k, 2) control points, two or more.
    """

    points: Floats

    @classmethod
    def segment(cls, start: Sequence[float], end: Sequence[float]) -> Bezier:
        """The segment between two points."""
        return cls(np.array([start, end], dtype=np.float64))

    @property
    def start(self) -> Floats:
        """Where it begins."""
        point: Floats = self.points[0]
        return point

    @property
    def end(self) -> Floats:
        """Where it ends."""
        point: Floats = self.points[-1]
        return point

    @property
    def hull(self) -> Floats:
        """Points whose convex hull holds it."""
        return self.points

    def at(self, t: Floats) -> Floats:
        """Its points at parameters from 0 to 1, by de Casteljau."""
        rows = [np.broadcast_to(point, (len(t), 2)) for point in self.points]
        while len(rows) > 1:
            rows = [a + t[:, None] * (b - a) for a, b in pairwise(rows)]
        return rows[0]

    def reverse(self) -> Bezier:
        """The other way."""
        return Bezier(self.points[::-1])

    def moved(self, matrix: Floats) -> Bezier:
        """Its image under `(2, 3)`: a linear map and a shift."""
        return Bezier(self.points @ matrix[:, :2].T + matrix[:, 2])


@dataclass(frozen=True, slots=True, eq=False)
class Arc:
    """An arc of an ellipse: `center + u cos s + v sin s`, `s` from `begin` by `sweep`.

    Parameters
    ----------
    center, u, v : (2,) the middle and two conjugate half-axes.
    begin, sweep : radians; a sweep of at most a full turn, negative towards smaller `s`.
    """

    center: Floats
    u: Floats
    v: Floats
    begin: float
    sweep: float

    @classmethod
    def circle(
        cls, center: Sequence[float], radius: float, begin: float = 0.0, sweep: float = 2 * np.pi
    ) -> Arc:
        """A circle, or an arc of it."""
        axes = radius * np.eye(2)
        return cls(np.array(center, dtype=np.float64), axes[0], axes[1], begin, sweep)

    @classmethod
    def bulged(cls, start: Sequence[float], end: Sequence[float], bulge: float) -> Arc:
        """The arc between two points with a bulge, the tangent of a quarter of its angle.

        As DXF has it: counter-clockwise where it is positive; not 0.

        >>> Arc.bulged((0, 0), (2, 0), 1.0).center.tolist()
        [1.0, 0.0]
        """
        a, b = np.array(start, dtype=np.float64), np.array(end, dtype=np.float64)
        chord = b - a
        left = np.array([-chord[1], chord[0]])
        center = 0.5 * (a + b) + left * (1.0 - bulge * bulge) / (4.0 * bulge)
        # With `a` at s = 0 it begins exactly there.
        u = a - center
        v = np.array([-u[1], u[0]])
        return cls(center, u, v, 0.0, 4.0 * float(np.arctan(bulge)))

    @property
    def reach(self) -> float:
        """Its larger half-axis."""
        return float(np.linalg.norm(np.stack((self.u, self.v)), 2))

    @property
    def start(self) -> Floats:
        """Where it begins."""
        point: Floats = self._place(np.array([self.begin]))[0]
        return point

    @property
    def end(self) -> Floats:
        """Where it ends."""
        point: Floats = self._place(np.array([self.begin + self.sweep]))[0]
        return point

    @property
    def hull(self) -> Floats:
        """Points whose convex hull holds it: where its quarters end, and their tangents meet."""
        if not np.isfinite(self.sweep):  # which has no parts
            return np.full((1, 2), np.nan)
        ends, apices = self.parts(max(int(np.ceil(abs(self.sweep) / (0.5 * np.pi))), 1))
        return np.concatenate((ends, apices))

    def at(self, t: Floats) -> Floats:
        """Its points at parameters from 0 to 1."""
        return self._place(self.begin + self.sweep * t)

    def reverse(self) -> Arc:
        """The other way."""
        return Arc(self.center, self.u, self.v, self.begin + self.sweep, -self.sweep)

    def moved(self, matrix: Floats) -> Arc:
        """Its image under `(2, 3)`: a linear map and a shift."""
        linear = matrix[:, :2]
        center = linear @ self.center + matrix[:, 2]
        return Arc(center, linear @ self.u, linear @ self.v, self.begin, self.sweep)

    def parts(self, count: int) -> tuple[Floats, Floats]:
        """The arc in equal parts of a quarter turn at most: their ends, and where tangents meet."""
        knots = self.begin + self.sweep * np.arange(count + 1) / count
        stretch = 1.0 / np.cos(0.5 * self.sweep / count)
        middles = self._place(0.5 * (knots[1:] + knots[:-1]))
        return self._place(knots), self.center + (middles - self.center) * stretch

    def _place(self, turn: Floats) -> Floats:
        places: Floats = (
            self.center + np.cos(turn)[:, None] * self.u + np.sin(turn)[:, None] * self.v
        )
        return places


Curve = Bezier | Arc


class Border(NamedTuple):
    """A polyline, and how far it is from the curves that it stands for, at most."""

    points: Floats
    off: float


def beside(curves: Sequence[Curve], hand: Hand, tolerance: float, closed: bool = False) -> Border:
    """A polyline on one side of curves that follow each other; segments stay as they are.

    Parameters
    ----------
    curves : each begins where the one before ends.
    hand : the side of the curves on which the polyline lies.
    tolerance : how far it may be from them, a length above 0.
    closed : whether the last ends where the first begins; then that point is not repeated.

    Returns
    -------
    Border : `(n, 2)` points from the start of the first curve on, no two in a row the same.

    Raises
    ------
    InputError : if that takes more than `MAX_PIECES` pieces.

    >>> half = Arc.circle((0, 0), 1.0, 0.0, np.pi)
    >>> inside, outside = (beside([half], hand, 0.1).points for hand in Hand)
    >>> bool(np.hypot(*inside.T).max() < 1 + 1e-12 <= np.hypot(*outside.T).max())
    True
    """
    lines: list[Floats] = [curves[0].start[None]]
    straight: list[bool] = []
    off = 0.0
    for curve in curves:
        if isinstance(curve, Arc):
            chains, thick = _arc_chains(curve, hand, tolerance)
        else:
            chains, thick = _bezier_chains(curve, hand, tolerance)
        off = max(off, thick)
        lines += [chain[1:] for chain in chains]
        segment = isinstance(curve, Bezier) and len(curve.points) == 2
        straight += [segment] * sum(len(chain) - 1 for chain in chains)
        if len(straight) > MAX_PIECES:
            raise InputError("", f"takes more than {MAX_PIECES} edges: allow a larger tolerance")
    return Border(_smooth(np.concatenate(lines), np.array(straight), closed), off)


def _smooth(points: Floats, straight: NDArray[np.bool_], closed: bool) -> Floats:
    """Without repeated points, and without those where a curve begins or ends and nothing turns."""
    moves = np.any(points[1:] != points[:-1], axis=1)
    points, straight = points[np.append(True, moves)], straight[moves]
    if closed and len(points) > 1:
        points = points[:-1]
    if len(points) < 3:
        return points
    before = points - np.roll(points, 1, axis=0)
    after = np.roll(before, -1, axis=0)
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    ahead = np.einsum("ij,ij->i", before, after) > 0.0
    flat = ahead & (np.abs(cross) <= SMOOTH * np.hypot(*before.T) * np.hypot(*after.T))
    if closed:
        flat &= ~(straight & np.roll(straight, 1))
    else:
        flat[1:-1] &= ~(straight[1:] & straight[:-1])
        flat[[0, -1]] = False
    kept: Floats = points[~flat]
    return kept


def _arc_chains(arc: Arc, hand: Hand, tolerance: float) -> tuple[list[Floats], float]:
    """Tangents where the arc bulges to that side, chords where it bulges away."""
    reach, sweep = arc.reach, abs(arc.sweep)
    if reach == 0.0 or sweep == 0.0:
        return [np.stack((arc.start, arc.end))], 0.0
    widest = 2.0 * float(np.arccos(1.0 / (1.0 + tolerance / reach)))
    count = int(np.ceil(min(sweep / widest, MAX_PIECES + 1.0)))
    count = max(count, int(np.ceil(sweep / (0.5 * np.pi) - 1e-12)), 1)
    while True:
        ends, apices = arc.parts(count)
        rising = [_rises(np.stack(three)) for three in zip(ends, apices, ends[1:], strict=False)]
        if all(rising) or count > MAX_PIECES:
            break
        count *= 2
    off = reach * (1.0 / float(np.cos(0.5 * sweep / count)) - 1.0)
    u, v = arc.u, arc.v
    turns_left = (u[0] * v[1] - u[1] * v[0]) * arc.sweep > 0.0
    if turns_left == (hand is Hand.RIGHT):
        return [np.concatenate((ends[:1], apices, ends[-1:]))], off
    return [ends], off


def _bezier_chains(curve: Bezier, hand: Hand, tolerance: float) -> tuple[list[Floats], float]:
    """The hulls' chains of pieces that are thin enough, and how thick the thickest is."""
    if len(curve.points) == 2:
        return [curve.points], 0.0
    chains: list[Floats] = []
    off = 0.0
    waiting = [(curve.points, 0)]
    while waiting:
        points, depth = waiting.pop()
        if depth >= MAX_HALVINGS:
            chains.append(points[[0, -1]])
            continue
        along, across = _over_chord(points)
        thick = float(np.ptp(np.append(across, 0.0)))
        if thick <= tolerance and _rises(points):
            chains.append(points[_chain(along, hand.value * across)])
            off = max(off, thick)
        else:
            first, second = _halves(points)
            waiting += [(second, depth + 1), (first, depth + 1)]
        if len(chains) + len(waiting) > MAX_PIECES:
            break
    chains = [chain for chain in chains if np.any(chain[0] != chain[-1])]
    return chains or [curve.points[[0, -1]]], off


def _rises(points: Floats) -> bool:
    """Whether the control points go forward along the chord, or stay."""
    legs, chord = np.diff(points, axis=0), points[-1] - points[0]
    return bool(np.all(legs @ chord >= 0.0)) and bool(np.any(chord) or not np.any(legs))


def _over_chord(points: Floats) -> tuple[Floats, Floats]:
    """Places along the chord, and to the left of it, as lengths."""
    chord = points[-1] - points[0]
    length = float(np.hypot(*chord)) or 1.0  # of no chord, nothing rises
    x, y = chord / length
    place = points - points[0]
    return place @ np.array([x, y]), place @ np.array([-y, x])


def _chain(along: Floats, height: Floats) -> list[int]:
    """The upper hull of places over the chord, by number, from the first to the last."""
    last = len(along) - 1
    inner = sorted(range(1, last), key=lambda k: (along[k], height[k], k))
    chain: list[int] = []
    for k in (0, *inner, last):
        while len(chain) > 1:
            i, j = chain[-2], chain[-1]
            turn = (along[j] - along[i]) * (height[k] - height[i]) - (height[j] - height[i]) * (
                along[k] - along[i]
            )
            if turn < 0.0:
                break
            chain.pop()
        chain.append(k)
    return chain


def _halves(points: Floats) -> tuple[Floats, Floats]:
    """The control points of both halves (de Casteljau)."""
    first, second = [points[0]], [points[-1]]
    row = points
    while len(row) > 1:
        row = 0.5 * (row[1:] + row[:-1])
        first.append(row[0])
        second.append(row[-1])
    return np.stack(first), np.stack(second[::-1])
