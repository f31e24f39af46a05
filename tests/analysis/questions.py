"""Inquiries answered by a function instead of the planner."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from preimage.analysis.axis import Axis
from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.analysis.survey import Inquiry

Motions = Callable[[Mapping[str, float]], int | None]
"""How many motions there are at these values; None for no plan."""


def axis(name: str, steps: int, monotone: bool = True, step: float = 0.5) -> Axis:
    return Axis(name, name, "", 1.0, 0.0, step, steps, monotone)


def outcome(motions: int | None) -> Outcome:
    return Outcome(Answer.UNSOLVABLE if motions is None else Answer.SOLVED, motions)


def answered(inquiry: Inquiry, motions: Motions, most: int = 100_000) -> int:
    """Ask until the inquiry knows enough; how many cells that took."""
    asked: set[Cell] = set()
    while cells := list(inquiry.wanted()):
        for cell in cells:
            assert cell not in asked, "a cell was asked for twice"
            asked.add(cell)
            inquiry.learn(cell, outcome(motions(dict(cell.values))))
        assert len(asked) <= most
    return len(asked)
