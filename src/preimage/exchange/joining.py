"""Open curves joined at their ends: chains, and outlines where these close."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preimage.errors import InputError
from preimage.exchange.drawing import Figure, Line, Role, Shape
from preimage.geometry.curves import Bezier, Curve, Floats

ROUNDING = 1e-11
"""Gaps up to this part of the drawing are rounding, and are not bridged."""


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """Open curves that follow each other, and where in the drawing they are."""

    place: str
    curves: tuple[Curve, ...]

    def reverse(self) -> Piece:
        """The other way."""
        return Piece(self.place, tuple(curve.reverse() for curve in reversed(self.curves)))


def joined(pieces: Sequence[Piece], role: Role, near: float, extent: float) -> list[Figure]:
    """Lines, and shapes where the ends of pieces meet all around.

    A chain goes the way of the piece of it that comes first. Gaps are bridged by segments.

    Parameters
    ----------
    near : ends up to so far apart meet.
    extent : the size of the drawing.

    Raises
    ------
    InputError : three ends meet, so that it is not clear what goes on where.
    """
    ends = np.array([end for piece in pieces for end in _ends(piece)]).reshape(-1, 2)
    partner = _partners(ends, near)
    left = set(range(len(pieces)))
    figures: list[Figure] = []
    for first in range(len(pieces)):
        if first not in left:
            continue
        begin = _begin(first, partner)
        chain, closed = _walked(begin, partner, left)
        steps = [pieces[end // 2] if end % 2 == 0 else pieces[end // 2].reverse() for end in chain]
        figures.append(_figure(steps, closed, pieces[first].place, role, ROUNDING * extent))
    return figures


def _ends(piece: Piece) -> tuple[Floats, Floats]:
    return piece.curves[0].start, piece.curves[-1].end


def _partners(ends: Floats, near: float) -> dict[int, int]:
    """Of each end that meets another one, that one. End `2k` begins piece `k`, `2k + 1` ends it."""
    side = max(near, float(np.abs(ends).max(initial=1.0)) * 1e-15)
    cells: dict[tuple[int, int], list[int]] = {}
    keys = np.floor(ends / side).astype(np.int64).tolist()
    for number, (i, j) in enumerate(keys):
        cells.setdefault((i, j), []).append(number)
    partner: dict[int, int] = {}
    for number, (i, j) in enumerate(keys):
        around = [k for a in (-1, 0, 1) for b in (-1, 0, 1) for k in cells.get((i + a, j + b), ())]
        met = [
            k for k in around if k != number and float(np.hypot(*(ends[k] - ends[number]))) <= near
        ]
        if len(met) > 1:
            x, y = ends[number]
            raise InputError("", f"{len(met) + 1} ends of lines meet at ({x:.6g}, {y:.6g})")
        if met:
            partner[number] = met[0]
    return partner


def _begin(first: int, partner: dict[int, int]) -> int:
    """The end of a piece at which its chain begins: walked back, or its own if that closes.

    So the chain goes through that piece from its start to its end.
    """
    end = 2 * first
    while end in partner:
        end = partner[end] ^ 1
        if end == 2 * first:
            return end
    return end


def _walked(end: int, partner: dict[int, int], left: set[int]) -> tuple[list[int], bool]:
    """The ends at which the pieces of a chain are entered, and whether it closes."""
    chain: list[int] = []
    while True:
        chain.append(end)
        left.discard(end // 2)
        if end ^ 1 not in partner:
            return chain, False
        end = partner[end ^ 1]
        if end == chain[0]:
            return chain, True


def _figure(steps: list[Piece], closed: bool, place: str, role: Role, rounding: float) -> Figure:
    curves: list[Curve] = []
    for piece in steps:
        if curves:
            _bridge(curves, piece.curves[0].start, rounding)
        curves += piece.curves
    more = f" and {len(steps) - 1} more" if len(steps) > 1 else ""
    if not closed:
        return Line(role, f"{place}{more}", tuple(curves))
    _bridge(curves, curves[0].start, rounding)
    return Shape(role, f"{place}{more}", (tuple(curves),))


def _bridge(curves: list[Curve], to: Floats, rounding: float) -> None:
    if float(np.hypot(*(to - curves[-1].end))) > rounding:
        curves.append(Bezier.segment(curves[-1].end.tolist(), to.tolist()))
