"""Lanes: how the lines of several regions lie beside each other on one contact edge."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.configuration.contact_set import ContactSet

Floats = NDArray[np.float64]

GAP = 0.3
"""Points between neighbouring lines."""

BLUNT = 2.8
"""Radians: lines run through corners blunter than this."""

MOST_CUT = 5_000
"""Sets with more intervals lie outside whatever is on their edges, and are not cut."""

Piece = tuple[float, float, float]
"""A piece of an edge: from, to, and how many points beside it are taken."""


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Pieces of intervals, each in a lane of its own.

    Parameters
    ----------
    edge, low, high : (k,) as in a `ContactSet`.
    offset : (k,) of the middle of the line from its edge, in points.
    """

    edge: NDArray[np.int32]
    low: Floats
    high: Floats
    offset: Floats


class Lanes:
    """What is taken beside the contact edges of a space, in points on paper."""

    def __init__(self, contact: ContactSpace, near: float) -> None:
        self.contact = contact
        self.near = near
        self.taken: dict[int, list[Piece]] = {}
        self.at_start: Floats = np.zeros(len(contact))
        self.at_end: Floats = np.zeros(len(contact))

    def outermost(self, edge: int) -> float:
        """How many points beside an edge are taken anywhere along it."""
        return max((top for _, _, top in self.taken.get(edge, ())), default=0.0)

    def place(self, contact: ContactSet, width: float) -> Pieces:
        """Lanes for lines that are `width` points wide, outside all that is there already.

        Intervals are cut where what lies inside them ends.
        """
        edge, low, high = contact.edge, contact.low, contact.high
        beside = np.array([int(number) in self.taken for number in edge], dtype=np.bool_)
        parts = [(edge[~beside], low[~beside], high[~beside], np.zeros(len(edge))[~beside])]
        cut = len(edge) <= MOST_CUT
        for place in np.flatnonzero(beside):
            pieces = self._cut(int(edge[place]), float(low[place]), float(high[place]), cut)
            start, stop, top = (np.array(column) for column in zip(*pieces, strict=True))
            parts.append((np.full(len(pieces), edge[place], dtype=np.int32), start, stop, top))
        found, start, stop, top = (np.concatenate(column) for column in zip(*parts, strict=True))
        order = np.lexsort((start, found))
        placed = Pieces(found[order], start[order], stop[order], top[order] + 0.5 * width)
        self._take(placed, 0.5 * width + GAP)
        return placed

    def _cut(self, edge: int, low: float, high: float, cut: bool) -> list[Piece]:
        """An interval in pieces of equal lanes."""
        taken = [piece for piece in self.taken[edge] if piece[0] < high and low < piece[1]]
        ends = {end for piece in taken for end in piece[:2] if low < end < high and cut}
        marks = [low, *sorted(ends), high]
        pieces: list[Piece] = []
        for start, stop in pairwise(marks):
            middle = 0.5 * (start + stop)
            inside = (top for first, last, top in taken if not cut or first < middle < last)
            top = max(inside, default=0.0)
            if pieces and pieces[-1][2] == top:
                pieces[-1] = (pieces[-1][0], stop, top)
            else:
                pieces.append((start, stop, top))
        return pieces

    def _take(self, placed: Pieces, half: float) -> None:
        top = placed.offset + half
        for edge, low, high, points in zip(
            placed.edge.tolist(), placed.low.tolist(), placed.high.tolist(), top.tolist(),
            strict=True,
        ):  # fmt: skip
            self.taken.setdefault(edge, []).append((low, high, points))
        first = placed.low <= self.near
        np.maximum.at(self.at_start, placed.edge[first], top[first])
        last = placed.high >= self.contact.length[placed.edge] - self.near
        np.maximum.at(self.at_end, placed.edge[last], top[last])

    def lines(self, contact: ContactSet, width: float, unit: float) -> Floats:
        """(k, 2, 2) the lines of a set, `width` points wide, shortened where others cross them.

        Parameters
        ----------
        unit : the length of a point.
        """
        features = self.contact
        before = self.at_start.copy(), self.at_end.copy()
        placed = self.place(contact, width)
        edge, low, high = placed.edge, placed.low.copy(), placed.high.copy()
        most = 0.4 * (high - low)
        # lines of one set meet in the corner; those of others keep them out of their lanes
        previous, following = features.previous[edge], features.next[edge]
        meets = placed.offset
        inner = np.where(before[1][previous] < self.at_end[previous], meets, before[1][previous])
        lost = _lost(features.span[edge], placed.offset, inner) * unit
        low += np.where(low <= self.near, np.minimum(lost, most), 0.0)
        inner = np.where(
            before[0][following] < self.at_start[following], meets, before[0][following]
        )
        lost = _lost(features.span[following], placed.offset, inner) * unit
        at_end = high >= features.length[edge] - self.near
        high -= np.where(at_end, np.minimum(lost, most), 0.0)
        normal = features.normal[edge]
        shift = (placed.offset * unit)[:, None] * np.stack((np.cos(normal), np.sin(normal)), axis=1)
        return np.stack((features.at(edge, low) + shift, features.at(edge, high) + shift), axis=1)


def _lost(span: Floats, offset: Floats, taken: Floats) -> Floats:
    """What a line leaves out at the corner where its edge ends, in points.

    Parameters
    ----------
    span : of the free wedge there.
    offset : of the line from its edge.
    taken : how wide the lines beside the other edge are.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        lost = (taken + offset * np.cos(span)) / np.sin(span)
    return np.where(span < BLUNT, np.maximum(lost, 0.0), 0.0)
