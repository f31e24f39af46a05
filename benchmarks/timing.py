"""Measuring, and printing what was measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter

Benchmark = Callable[[], object]


def best(benchmark: Benchmark, seconds: float = 1.0, least: int = 3) -> float:
    """The shortest run, in seconds, of as many as fit in `seconds`, and at `least` that many."""
    runs: list[float] = []
    while len(runs) < least or sum(runs) < seconds:
        start = perf_counter()
        benchmark()
        runs.append(perf_counter() - start)
    return min(runs)


def table(benchmarks: Mapping[str, Benchmark]) -> None:
    """Run the benchmarks and print a line each."""
    width = max(map(len, benchmarks))
    for name, benchmark in benchmarks.items():
        print(f"{name:{width}}  {best(benchmark) * 1e3:10.2f} ms")
