"""Write docs/gallery.md: every named task with its plan, a run under adversaries, and its table.

Run from anywhere: `python examples/gallery/make.py [NAME…]`. With names only their pictures are
drawn, and their sections replaced.
"""

from __future__ import annotations

import argparse
import re
import sys
from dataclasses import replace
from pathlib import Path

from preimage import (
    Method,
    Status,
    Strategy,
    Task,
    animate,
    describe,
    named_task,
    named_tasks,
    plan,
    run,
)
from preimage.execution.report import Report
from preimage.execution.runs import RunOptions
from preimage.task import StrategyKind, task_families

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGE = DOCS / "gallery.md"
FOLDER = DOCS / "images" / "gallery"

OF_FAMILIES = ("comb-4", "hall-9", "saw-tooth-3")
"""Members that are small enough to be looked at."""

RUNS = 50
CONTROL, SENSING = "hunting", "towards"

FILM = {"seconds": 4.0, "rate": 12, "width": 480}

MANY = 6
"""Plans with more regions than this are drawn as a graph."""

HEAD = f"""# Gallery

Made by `python examples/gallery/make.py`, which takes names of tasks. Every named task: the
shortest plan by its own options, a run of it, and how many motions each method needs.

In the picture of a plan each panel shows one motion: from anywhere in the blue region, the command
in the circle surely ends in the orange target, and is known to have ended there. Large plans are
shown as a graph of their regions. The films show the longest of {RUNS} runs under two adversaries:
`{CONTROL}` steers towards places where the robot might get stuck or lost, and `{SENSING}` shifts
the measured positions towards the target, as far as the bound allows, so that a motion might stop
too early. The orange disc is what the robot knows of its position, the red arrow the force that it
reads.

In the tables, *motions* are those of the shortest linear strategy by each method, for the task's
directions, and the most of a conditional one by the combined method; “–” says that the search was
exhausted without one, “stopped” that a limit came first. *Regions* are all that were made until
then, the goal among them. No plan in the tables may end in known failure. How long planning takes
is [another page](named-tasks.md).
"""


def names() -> tuple[str, ...]:
    """All that is shown, in this order."""
    return (*named_tasks(), *OF_FAMILIES)


def what(name: str) -> str:
    """The task in a sentence."""
    known = named_tasks()
    return known[name] if name in known else task_families()[name.rpartition("-")[0]]


def cells(strategy: Strategy) -> tuple[str, str]:
    """Motions and regions of an answer of the planner, for the table."""
    motions = {
        Status.SOLVED: str(max(strategy.region(number).rank for number in strategy.start or (0,))),
        Status.UNSOLVABLE: "–",
        Status.STOPPED: "stopped",
    }[strategy.status]
    return motions, str(strategy.statistics.regions)


def table(task: Task) -> str:
    """Motions and regions by each method, and of a conditional strategy."""
    options = replace(task.options, or_fail=False)
    columns = []
    for method in Method:
        linear = replace(options, method=method, strategy=StrategyKind.LINEAR)
        columns.append((method.value, *cells(plan(replace(task, options=linear)))))
    conditional = replace(options, method=Method.COMBINED, strategy=StrategyKind.CONDITIONAL)
    columns.append(("conditional", *cells(plan(replace(task, options=conditional)))))
    heads, motions, regions = zip(*columns, strict=True)
    rows = (("", *heads), ("---", *["--:"] * len(heads)), ("motions", *motions))
    return "\n".join(f"| {' | '.join(row)} |" for row in (*rows, ("regions", *regions)))


def picture(strategy: Strategy, name: str) -> Path:
    """Draw the plan; the file."""
    from examples.small_picture import write_small

    moving = sum(region.motion is not None for region in strategy.regions)
    return write_small(strategy, FOLDER / name, graph=moving > MANY)


def film(strategy: Strategy, name: str) -> tuple[Path, Report]:
    """Film a run; the file, and what happened in all of them."""
    options = RunOptions(runs=RUNS)
    report = run(strategy, control=CONTROL, sensing=SENSING, options=options)
    path = FOLDER / f"{name}.gif"
    animate(report, path, **FILM)
    return path, report


def ended(report: Report) -> str:
    """How the runs ended, in a sentence."""
    if len(report.outcomes) == 1:
        (outcome,) = report.outcomes
        return f"All {report.runs} runs ended {outcome.value}."
    parts = [f"{count} ended {outcome.value}" for outcome, count in report.outcomes.items()]
    return f"Of {report.runs} runs {', '.join(parts)}."


def section(name: str) -> str:
    """Draw a task's pictures, and say what the page says of it."""
    task = named_task(name)
    strategy = plan(task)
    drawn = picture(strategy, name)
    moving, report = film(strategy, name)
    said = describe(strategy).partition("\n")[0]
    source = f"../src/preimage/task/named/{name}.yaml"
    of_family = "A family's member: [its makers](../src/preimage/task/families.py)"
    return f"""## {name}

{what(name)}

![The plan of {name}](images/gallery/{drawn.name})

![A run of {name}](images/gallery/{moving.name})

{ended(report)}

```python
>>> from preimage import describe, named_task, plan
>>> strategy = plan(named_task("{name}"))
>>> print(describe(strategy).splitlines()[0])
{said}
```

{table(task)}

{f"[The task's file]({source})" if name in named_tasks() else of_family}, also by
`preimage examples {name}`.
"""


def sections(text: str) -> dict[str, str]:
    r"""The sections of a page by their names.

    >>> sections("head\n\n## a\n\nx\n\n## b\n\ny\n")
    {'a': '## a\n\nx\n', 'b': '## b\n\ny\n'}
    """
    parts = re.split(r"^(?=## )", text, flags=re.MULTILINE)[1:]
    return {part.partition("\n")[0].removeprefix("## "): part.strip("\n") + "\n" for part in parts}


def main() -> None:
    """Draw what is asked for, and write the page."""
    sys.path.insert(0, str(ROOT))
    parser = argparse.ArgumentParser(description="Make the gallery.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="all tasks by default")
    chosen = parser.parse_args().names
    unknown = sorted(set(chosen) - set(names()))
    if unknown:
        parser.error(f"no task of the gallery: {', '.join(unknown)}")
    FOLDER.mkdir(parents=True, exist_ok=True)
    known = sections(PAGE.read_text(encoding="utf-8")) if PAGE.exists() else {}
    for name in names():
        if name in chosen or not chosen:
            known[name] = section(name)
            sizes = [path.stat().st_size for path in sorted(FOLDER.glob(f"{name}.*"))]
            print(name, *(f"{size:,}" for size in sizes), flush=True)
    shown = [known[name] for name in names() if name in known]
    PAGE.write_text("\n".join([HEAD, *shown]), encoding="utf-8")


if __name__ == "__main__":
    main()
