"""Big scenes: halls of 10^3 to 10^5 edges, and where the time of a search goes.

`python -m benchmarks.scale [n ...]` prints a table; a size of 18200 pillars has 10^5 edges.
"""

from __future__ import annotations

import argparse
import math
import resource
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from time import process_time
from typing import Any
from unittest.mock import patch

from preimage.configuration.goals import goal_region
from preimage.configuration.start import Start, start_region
from preimage.preimages import methods
from preimage.preimages.setting import Setting
from preimage.search import linear
from preimage.search.limits import Limits
from preimage.task.examples import named_task
from preimage.task.initial import InitialPoint
from preimage.task.options import uniform_directions
from preimage.task.task import Task

SIZES = (180, 1820, 18200)
PARTS = {"corner": None, "middle": (0.503, 0.505)}
"""Where the robot starts: where the family has it, or at these parts of the window."""

REGIONS = 24
"""So many regions are made at most, of which the start is in the middle of none."""

STAGES = {"kernel": (methods, "kernel"), "sweep": (methods, "backproject")}


@dataclass(slots=True)
class Spent:
    """CPU time by stage, seconds, and how often each ran."""

    seconds: dict[str, float] = field(default_factory=lambda: dict.fromkeys(STAGES, 0.0))
    calls: dict[str, int] = field(default_factory=lambda: dict.fromkeys(STAGES, 0))


@contextmanager
def watched() -> Iterator[Spent]:
    """Count what the stages of a search spend."""
    spent = Spent()

    def timed(stage: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **options: Any) -> Any:
            begin = process_time()
            try:
                return function(*arguments, **options)
            finally:
                spent.seconds[stage] += process_time() - begin
                spent.calls[stage] += 1

        return call

    patches = [
        patch.object(room, name, timed(stage, getattr(room, name)))
        for stage, (room, name) in STAGES.items()
    ]
    for one in patches:
        one.start()
    try:
        yield spent
    finally:
        for one in patches:
            one.stop()


def placed(task: Task, part: tuple[float, float] | None) -> Task:
    """The task with its start at a part of the window."""
    if part is None:
        return task
    window = task.workspace.window
    point = (2.0 + part[0] * window.xmax, 2.0 + part[1] * window.ymax)
    return replace(task, initial=InitialPoint(point))


def row(size: int, where: str) -> tuple[int, float, str]:
    """Edges, seconds a preimage, and a line of the table."""
    begin = process_time()
    task = placed(named_task(f"hall-{size}"), PARTS[where])
    setting = Setting.of(task)
    start, goal = start_region(task, setting.space), goal_region(task, setting.space)
    made = process_time() - begin
    begin = process_time()
    with watched() as spent:
        found = search(setting, goal, start, task)
    total = process_time() - begin
    count, edges = max(1, found.computed), len(setting.space.contact.edges)
    kernel, sweep = spent.seconds["kernel"], spent.seconds["sweep"]
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
    cells = (
        f"{edges:,}", where, "yes" if found.solution else "no", f"{found.computed}",
        f"{made:.2f}", f"{total:.2f}", f"{1e3 * kernel / count:.1f}", f"{1e3 * sweep / count:.1f}",
        f"{1e3 * (total - kernel - sweep) / count:.1f}", f"{peak:.2f}",
    )  # fmt: skip
    return edges, total / count, f"| {' | '.join(cells)} |"


def search(setting: Setting, goal: Any, start: Start, task: Task) -> linear.Outcome:
    """A linear search with no limit but that on regions."""
    options = task.options
    return linear.search(
        setting, goal, start, uniform_directions(8), options.method, options.search,
        options.max_steps, Limits(None, REGIONS),
    )  # fmt: skip


def main() -> None:
    """Print the table, and by which power of the edges a preimage's time grows."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sizes", nargs="*", type=int, default=SIZES)
    sizes = parser.parse_args().sizes
    print("| edges | start | solved | preimages | scene, s | search, s | kernel, ms |", end="")
    print(" sweep, ms | rest, ms | peak, GiB |\n|---:|---|---|---:|---:|---:|---:|---:|---:|---:|")
    measured: dict[str, list[tuple[int, float]]] = {where: [] for where in PARTS}
    for size in sizes:
        for where in PARTS:
            edges, each, line = row(size, where)
            measured[where].append((edges, each))
            print(line, flush=True)
    for where, points in measured.items():
        (few, fast), (many, slow) = points[0], points[-1]
        if many > few:
            power = math.log(slow / fast) / math.log(many / few)
            print(f"\nA preimage's time, start in the {where}: edges^{power:.2f}")


if __name__ == "__main__":
    main()
