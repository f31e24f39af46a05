"""Every named task's plans against every pair of adversaries, as a table.

Run from anywhere: `python examples/tables/soundness.py [--runs N] [--seed S] [FILE]`. The exit
status is 1 if any run failed.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path

from preimage import Method, Status, Strategy, named_task, named_tasks, plan, run
from preimage.configuration.start import Start
from preimage.execution.describe import describe_report
from preimage.execution.report import Report
from preimage.execution.runs import RunOptions

OF_FAMILIES = ("comb-12", "hall-12", "saw-tooth-12")

HEAD = """# Soundness

Made by `make soundness`. Every plan of every named task, by each method, is carried out {runs:,}
times under each of the {pairs} pairs of an adversary for control and one for sensing
(`preimage run --adversaries`), from anywhere in the task's start, and, last column, from anywhere
in the preimages of its motions, their borders and vertices included. A run succeeds if the
readings said that the goal was attained, and the robot was in it. Seed {seed}.

| task | method | motions | runs | failures | longest | from preimages | failures |
|---|---|--:|--:|--:|--:|--:|--:|
"""


def from_preimages(strategy: Strategy, options: RunOptions) -> list[Report]:
    """The rest of the plan, begun anywhere in each of its regions."""
    return [
        run(
            replace(strategy, start=(number,)),
            start=Start.anywhere_in(strategy.region(number).region),
            options=options,
        )
        for number in strategy.steps
    ]


def row(name: str, method: Method, options: RunOptions) -> tuple[str, list[Report]]:
    """A line of the table, and all runs that it stands for."""
    task = named_task(name)
    strategy = plan(replace(task, options=replace(task.options, method=method)))
    if strategy.status is not Status.SOLVED:
        return "", []
    report = run(strategy, options=options)
    others = from_preimages(strategy, options)
    cells = (
        f"`{name}`",
        method.value,
        str(len(strategy.steps)),
        f"{report.runs:,}",
        str(report.failures),
        f"{max(tally.time[1] for tally in report.tallies):.4g}",
        f"{sum(other.runs for other in others):,}",
        str(sum(other.failures for other in others)),
    )
    return f"| {' | '.join(cells)} |", [report, *others]


def main() -> int:
    """Run everything, print what failed, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", nargs="?", type=Path, help="a file for the table")
    parser.add_argument("--runs", type=int, default=1_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int, default=1)
    arguments = parser.parse_args()
    options = RunOptions(arguments.runs, arguments.seed, arguments.workers)
    lines, everything = [], []
    for name in (*sorted(named_tasks()), *OF_FAMILIES):
        for method in Method:
            line, reports = row(name, method, options)
            if line:
                print(line, flush=True)
                lines.append(line)
            everything += reports
    for report in everything:
        if report.failures:
            print(describe_report(report))
    total, failures = (sum(getattr(r, word) for r in everything) for word in ("runs", "failures"))
    last = f"\nIn all {total:,} runs, {failures} failures.\n"
    print(last)
    if arguments.page is not None:
        pairs = len(everything[0].tallies)
        head = HEAD.format(runs=options.runs, pairs=pairs, seed=options.seed)
        arguments.page.write_text(head + "\n".join(lines) + "\n" + last, encoding="utf-8")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
