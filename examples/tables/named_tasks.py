"""Write docs/named-tasks.md: every named task by every method and conditional, with its time.

Run from anywhere: `python examples/tables/named_tasks.py [FILE]`.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from preimage import Method, Status, Task, named_task, named_tasks, plan
from preimage.task import StrategyKind

PAGE = Path(__file__).resolve().parents[2] / "docs" / "named-tasks.md"

OF_FAMILIES = ("comb-12", "comb-200", "hall-12", "hall-200", "saw-tooth-12", "saw-tooth-200")

HEAD = """# Named tasks

Made by `python examples/tables/named_tasks.py`. `preimage examples` lists the tasks, and
`preimage examples NAME` writes one out; their files are in `src/preimage/task/named`.

For each task and method: the *motions* of the shortest strategy for the task's directions, or “–”
where the search was exhausted without one; the *regions* that were made until then, the goal among
them; and the *time* in milliseconds, the best of several plans in one process that had warmed up,
the configuration space included. Times are of the machine at hand; compare them with each other.

The last columns are of the conditional strategy by the combined method: the motions at most, and
the regions made. No plan here may end in known failure (`or_fail` is off).
"""


def shortest(task: Task, runs: int = 5, enough: float = 1.0) -> tuple[str, int, float]:
    """Motions, regions, and the least time in ms of so many runs, or of those in `enough` s."""
    times: list[float] = []
    while len(times) < 2 or (len(times) < runs and sum(times) < enough):
        began = perf_counter()
        strategy = plan(task)
        times.append(perf_counter() - began)
    motions = {
        Status.SOLVED: str(max(strategy.region(number).rank for number in strategy.start or (0,))),
        Status.UNSOLVABLE: "–",
        Status.STOPPED: "stopped",
    }[strategy.status]
    return motions, strategy.statistics.regions, 1e3 * min(times)


def row(name: str) -> str:
    """A task's row of the table."""
    task = named_task(name)
    options = replace(task.options, or_fail=False)
    cells = [f"`{name}`"]
    for method in Method:
        linear = replace(options, method=method, strategy=StrategyKind.LINEAR)
        motions, regions, time = shortest(replace(task, options=linear))
        cells += [motions, str(regions), f"{time:.1f}"]
    conditional = replace(options, method=Method.COMBINED, strategy=StrategyKind.CONDITIONAL)
    motions, regions, time = shortest(replace(task, options=conditional))
    cells += [motions, str(regions), f"{time:.1f}"]
    return "| " + " | ".join(cells) + " |"


def table(names: tuple[str, ...]) -> str:
    """The tasks by method, as a table in Markdown."""
    head = ["task", *(f"{method.value} | regions | ms" for method in Method)]
    head.append("conditional | regions | ms")
    lines = ["| " + " | ".join(head) + " |", "|---|" + "--:|" * 3 * (len(Method) + 1)]
    return "\n".join([*lines, *map(row, names)])


def page() -> str:
    """The page."""
    what = "\n".join(f"- `{name}`: {text}" for name, text in named_tasks().items())
    parts = (
        HEAD,
        "## By method\n",
        table(tuple(named_tasks())),
        "\n## Families\n\nOf any size, the number at the end of the name.\n",
        table(OF_FAMILIES),
        "\n## What they are\n",
        what,
    )
    return "\n".join(parts) + "\n"


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description="Plan every named task by every method.")
    parser.add_argument("file", nargs="?", type=Path, default=PAGE, help="where to write the table")
    parser.parse_args().file.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
