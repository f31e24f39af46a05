"""Measuring, and printing what was measured."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from time import perf_counter

Row = tuple[str, float, str]
"""What was measured, its time in seconds or NaN, and a remark."""


def best(benchmark: Callable[[], object], seconds: float = 1.0, least: int = 3) -> float:
    """The shortest run, in seconds, of as many as fit in `seconds`, and at `least` that many."""
    runs: list[float] = []
    while len(runs) < least or sum(runs) < seconds:
        start = perf_counter()
        benchmark()
        runs.append(perf_counter() - start)
    return min(runs)


def table(rows: Iterable[Row]) -> str:
    """The rows as a table in Markdown."""
    lines = ["| what | ms | |", "|---|---:|---|"]
    for name, seconds, remark in rows:
        spent = "" if math.isnan(seconds) else f"{seconds * 1e3:,.3g}"
        lines.append(f"| {name} | {spent} | {remark} |")
    return "\n".join(lines)
