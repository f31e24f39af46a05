"""What bounds save a linear search, on every named task by every method, as a table.

Run from anywhere: `python examples/tables/led_search.py [--repeats N] [FILE]`.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from preimage import Method, Task, named_task, named_tasks
from preimage.configuration.goals import goal_region
from preimage.configuration.start import start_region
from preimage.preimages import methods
from preimage.preimages.setting import Setting
from preimage.recognition.kernel import kernel
from preimage.search import led, linear
from preimage.search.bounds import Sensing
from preimage.search.limits import Limits
from preimage.search.linear import Outcome
from preimage.task.options import Continuous, SearchOrder, uniform_directions

OF_FAMILIES = ("comb-12", "hall-12", "hall-40", "saw-tooth-12")
MANY = 16
PATIENCE = 20.0
"""Seconds for one search."""

HEAD = """# Led search

Made by `python examples/tables/led_search.py docs/led-search.md`. Every named task, by each method,
is searched in four orders: breadth-first; nearest region first; led by the layers of the same
problem with perfect sensing (`--search led`); led by layers of what the method recognises of each
goal by itself, which are the regions of the conditional planner. First with each task's own
directions, then with {many}. A cell says: backprojections computed, those of the layers included /
kernels computed / milliseconds of processor time, the least of {repeats}. A search that took more
than {patience:g} s was stopped: *late*. `+1`: the plan has one motion more than the shortest. The
last lines are sums over the tasks that no search was late for.

What it says. The layers rule out first motions and lengths, so that fewer kernels are computed;
they take a sweep for each direction and layer themselves. With each task's own few directions that
comes to about the same time. They pay where the graph's last layer would be wide, with many
directions (`example-2` to `example-4`, the combined method), and where there is no plan and
perfect sensors would not help: that is known without making one preimage (`cluttered-hall`,
sticking). They do not pay where only sensing stands in the way (the kernel method on
`peg-in-hole`, `landmark-edge`, `connector`, `rails`): with perfect sensing almost all first
motions are possible, and the graph is searched as before. Plans of three motions or more
(`cluttered-hall`) take as long as without, on the whole.

Layers of what is recognised are tighter, and then lead to fewer backprojections, but a kernel for
each goal, direction and layer costs more than it saves. To ask the bounds for sequences of two
first motions, rather than for the first alone, was tried too: on ten tasks with {many} directions
it took 3,916 kernels, against 782 without, and 1,197 without bounds.

Breadth-first stays the default: on small tasks nothing is won, and where the start lies beyond the
layers of the motions allowed, it may know by exhaustion that there is no plan, while the led search
names the limit.
"""

TABLE = """
## {title}

| task | method | motions | breadth-first | best-first | led: perfect sensing | led: as sensed |
|---|---|--:|--:|--:|--:|--:|
"""

KINDS: tuple[tuple[str, Collection[int | None]], ...] = (
    ("all", (None, *range(-1, 100))),
    ("no or one motion", (0, 1)),
    ("two motions", (2,)),
    ("three or more", range(3, 100)),
    ("no plan", (-1,)),
)

Search = Callable[[Task, Setting], Outcome]


@dataclass(slots=True)
class Count:
    """How often a kernel was computed."""

    kernels: int = 0

    def kernel(self, *arguments: object, **options: object) -> object:
        """The kernel, counted."""
        self.kernels += 1
        return kernel(*arguments, **options)  # type: ignore[arg-type]


COUNT = Count()


@dataclass(frozen=True, slots=True)
class Effort:
    """What one search took; `motions` is -1 for none, and None if it was stopped."""

    motions: int | None
    computed: int
    kernels: int
    seconds: float
    late: bool


def blindly(order: SearchOrder, task: Task, setting: Setting) -> Outcome:
    """A search without bounds."""
    options = task.options
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    assert not isinstance(options.directions, Continuous)
    return linear.search(
        setting, goal, start, options.directions, options.method, order, options.max_steps,
        Limits(PATIENCE, options.max_regions),
    )  # fmt: skip


def led_by(sensing: Sensing, task: Task, setting: Setting) -> Outcome:
    """A search that bounds lead."""
    options = task.options
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)
    assert not isinstance(options.directions, Continuous)
    return led.search(
        setting, goal, start, options.directions, options.method, options.max_steps,
        Limits(PATIENCE, options.max_regions), sensing=sensing,
    )  # fmt: skip


SEARCHES: tuple[Search, ...] = (
    *(partial(blindly, order) for order in linear.ORDERS),
    *(partial(led_by, sensing) for sensing in Sensing),
)


def effort(search: Search, task: Task, repeats: int) -> Effort:
    """The least time of several searches, each in a setting of its own."""
    least = float("inf")
    for _ in range(repeats):
        setting = Setting.of(task)
        COUNT.kernels = 0
        began = time.process_time()
        outcome = search(task, setting)
        least = min(least, time.process_time() - began)
        late = "time" in (outcome.stopped or "")
        if late:
            break
    if outcome.solution is not None:
        motions: int | None = outcome.solution.rank
    else:
        motions = None if outcome.stopped else -1
    return Effort(motions, outcome.computed, COUNT.kernels, least, late)


def cell(one: Effort, shortest: int | None) -> str:
    """What one search took."""
    if one.late:
        return "late"
    words = f"{one.computed} / {one.kernels} / {1e3 * one.seconds:.0f}"
    more = (one.motions or 0) - (shortest or 0)
    if one.motions is None and shortest == -1:
        return f"{words} (not exhausted)"
    return f"{words} +{more}" if more > 0 else words


def table(title: str, tasks: list[Task], repeats: int) -> list[str]:
    """A table, and the sums below it."""
    lines = [TABLE.format(title=title).strip("\n")]
    rows: list[list[Effort]] = []
    for task in tasks:
        for method in Method:
            this = replace(task, options=replace(task.options, method=method))
            row = [effort(search, this, repeats) for search in SEARCHES]
            shortest = next((one.motions for one in row if one.motions is not None), None)
            length = {None: "?", -1: "none"}.get(shortest, str(shortest))
            cells = " | ".join(cell(one, shortest) for one in row)
            lines.append(f"| `{task.name}` | {method.value} | {length} | {cells} |")
            print(lines[-1], flush=True)
            rows.append(row)
    for words, lengths in KINDS:
        kept = [
            row for row in rows if row[0].motions in lengths and not any(one.late for one in row)
        ]
        if not kept:
            continue
        sums = (
            f"{sum(one.computed for one in column)} / {sum(one.kernels for one in column)} / "
            f"{1e3 * sum(one.seconds for one in column):.0f}"
            for column in zip(*kept, strict=True)
        )
        lines.append(f"| *{words}: {len(kept)}* | | | {' | '.join(sums)} |")
        print(lines[-1], flush=True)
    return ["", *lines]


def main() -> int:
    """Search, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", nargs="?", type=Path, help="a file for the table")
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args()
    setattr(methods, "kernel", COUNT.kernel)  # noqa: B010
    own = [named_task(name) for name in (*sorted(named_tasks()), *OF_FAMILIES)]
    own = [task for task in own if not isinstance(task.options.directions, Continuous)]
    ways = uniform_directions(MANY)
    many = [replace(task, options=replace(task.options, directions=ways)) for task in own]
    many = [task for task in many if not task.name.startswith("figure")]
    lines = table("Each task's own directions", own, arguments.repeats)
    lines += table(f"{MANY} directions", many, arguments.repeats)
    if arguments.page is not None:
        head = HEAD.format(many=MANY, repeats=arguments.repeats, patience=PATIENCE)
        arguments.page.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
