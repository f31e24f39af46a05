"""The figures, each made once."""

from __future__ import annotations

from functools import cache

from examples.figures.book import FIGURES
from examples.figures.redrawn import Redrawn


@cache
def figure(number: int) -> Redrawn:
    """What is computed for a figure."""
    return FIGURES[number]()
