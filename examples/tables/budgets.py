"""Error budgets of named tasks, each limit checked from both sides, as a page with pictures.

Run from anywhere: `python examples/tables/budgets.py [--workers N] [--runs N] [FILE]`. Inside each
limit the plan is proven and carried out under all adversaries; outside it verification has to find
a counter-example against that plan. The exit status is 1 if either fails.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from preimage import draw, named_task, verify
from preimage.analysis.axis import task_at
from preimage.analysis.budget import AxisBudget, Limit, budget
from preimage.analysis.cell import Cell, planned
from preimage.analysis.describe import describe_budget
from preimage.analysis.map import error_map
from preimage.analysis.survey import Survey
from preimage.execution.runs import RunOptions, run
from preimage.jobs import workforce
from preimage.strategy.strategy import Strategy
from preimage.task.template import named_template
from preimage.verification.verdict import Verdict

PAGE = Path(__file__).parents[2] / "docs" / "budgets.md"
MARK = "<!-- what follows is made by examples/tables/budgets.py -->"
TASKS = (
    "peg-in-hole", "cradle", "rails", "connector", "l-room",
    "example-1", "example-2", "example-3", "example-4", "example-5", "tight-hole",
)  # fmt: skip
SHORT = {"example-4": 3}
"""Motions at most, where longer plans take minutes each: its graph is the widest."""

MAPS = (("peg-in-hole", "control", "position"), ("connector", "friction", "control"))


@dataclass(frozen=True, slots=True)
class Side:
    """What became of one limit."""

    words: str
    holds: bool


def inside(kept: Strategy, runs: int) -> Side:
    """The last plan: proven, and carried out under all adversaries."""
    verdict = verify(kept, runs=0).verdict
    report = run(kept, options=RunOptions(runs))
    words = f"{verdict.value}; {report.runs:,} runs, {report.failures} failures"
    return Side(words, verdict is Verdict.PROVEN and not report.failures)


def outside(kept: Strategy, survey: Survey, cell: Cell) -> Side:
    """The same plan one step further: a counter-example."""
    if any(key.startswith("parameters.") for key, _ in cell.values):
        return Side("the scene is another one: the plan is not its", True)
    changed = task_at(survey.template, kept.task.options, dict(cell.values))
    found = verify(replace(kept, task=changed), runs=0)
    worst = next((one for one in found.every if one.trace is not None), None)
    if worst is None:
        return Side(f"{found.verdict.value}, without a counter-example", False)
    return Side(f"beaten: {worst.fault.value}", found.verdict is Verdict.REFUTED)


def sides(survey: Survey, axis: AxisBudget, limit: Limit, runs: int) -> tuple[str, bool]:
    """A line of the table, and whether the limit holds from both sides."""
    method = survey.options.method
    cells = [Cell.at(method, **{axis.axis.key: value}) for value in (limit.inside, limit.outside)]
    kept = planned(survey.template, survey.options, cells[0])
    found = inside(kept, runs), outside(kept, survey, cells[1])
    values = (f"`{axis.axis.key}`", f"{limit.inside:g}", found[0].words)
    line = " | ".join((*values, f"{limit.outside:g}", found[1].words))
    return f"| {line} |", all(side.holds for side in found)


def part(name: str, folder: Path, runs: int) -> tuple[str, bool]:
    """The section of one task, and whether all of its limits hold; the picture is drawn."""
    template = named_template(name)
    options = template.task().options
    options = replace(options, max_steps=SHORT.get(name, options.max_steps))
    survey = Survey.of(template, options=options)
    found = budget(survey)
    image = f"budget-{name}.png"
    draw(found, folder / "images" / image)
    short = f"Plans of at most {options.max_steps} motions.\n" if name in SHORT else ""
    lines = [
        f"## {name}\n",
        f"{short}\n![](images/{image})\n", "```", describe_budget(found), "```\n",
        "| bound | inside | the plan there | outside | the same plan there |",
        "|---|--:|---|--:|---|",
    ]  # fmt: skip
    checked = [sides(survey, axis, limit, runs) for axis in found.axes for limit in axis.limits]
    if not checked:
        lines = [*lines[:-2], "Nothing limits it."]
    return "\n".join([*lines, *(line for line, _ in checked), ""]), all(ok for _, ok in checked)


def maps(folder: Path) -> Iterator[str]:
    """The maps: pictures, and how few cells they took."""
    yield "## Maps\n"
    for name, x, y in MAPS:
        found = error_map(Survey.of(named_task(name)), x, y)
        image = f"map-{name}.png"
        draw(found, folder / "images" / image)
        part_asked = 100.0 * found.looked_at / found.size
        yield (
            f"![](images/{image})\n\n`{name}`, {x} and {y}, three methods: the planner was asked"
            f" {found.looked_at:,} times, cell by cell it would have been {found.size:,}"
            f" ({part_asked:.0f} %).\n"
        )


def write(page: Path, parts: dict[int, tuple[str, bool]], charts: list[str]) -> None:
    """Write the page with what there is."""
    text = page.read_text(encoding="utf-8") if page.exists() else ""
    made = [part for _, (part, _) in sorted(parts.items())]
    head = text.split(MARK)[0]
    page.write_text(f"{head}{MARK}\n\n" + "\n".join([*made, *charts]), encoding="utf-8")


def main() -> int:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", nargs="?", type=Path, default=PAGE)
    parser.add_argument("--runs", type=int, default=100, help="under each pair of adversaries")
    parser.add_argument("--workers", type=int, default=None)
    arguments = parser.parse_args()
    page: Path = arguments.page
    (page.parent / "images").mkdir(parents=True, exist_ok=True)
    parts: dict[int, tuple[str, bool]] = {}
    work = partial(part, folder=page.parent, runs=arguments.runs)
    with workforce(arguments.workers) as crew:
        for place, found in crew.carry_out(work, TASKS):
            parts[place] = found
            print(TASKS[place], "holds" if found[1] else "FAILS", flush=True)
            write(page, parts, [])
    write(page, parts, list(maps(page.parent)))
    return 0 if all(ok for _, ok in parts.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
