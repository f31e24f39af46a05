"""Plans carried out in MuJoCo: how often they succeed, and what the margin absorbs.

Run from anywhere, with the extra `physics`:

    python examples/physics/success.py [--runs 200] [--seed 1] [--processes 2] [--tasks ...]

Tables in Markdown. Plans use the damper's law of sliding, which is that of the engine.
"""

from __future__ import annotations

import argparse
import math
import sys
from argparse import Namespace
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace

from preimage import Status, named_task, plan
from preimage.execution.program import compiled
from preimage.execution.trace import Outcome
from preimage.physics.drive import Drive
from preimage.physics.plant import Plant
from preimage.physics.scene import scene
from preimage.physics.trials import plan_trials
from preimage.task.task import SlidingLaw

TASKS = (
    "peg-in-hole",
    "cradle",
    "rails",
    "connector",
    "example-2",
    "example-3",
    "example-4",
    "example-5",
    "blind-corner",
)

STRESSED = ("peg-in-hole", "connector", "example-2", "example-4")
"""Tasks of the second table."""

USUAL = Plant()

PLANTS = {
    "as above": USUAL,
    "no reserve: errors up to their bounds": replace(USUAL, reserve=0.0),
    "errors up to 1.5 times their bounds": replace(USUAL, reserve=-0.5),
    "unsettled forces are read too": replace(USUAL, settled=math.pi),
    "five times heavier": replace(USUAL, settling=5.0 * USUAL.settling, steps=20, every=4),
    "25 times heavier": replace(USUAL, settling=25.0 * USUAL.settling, steps=100, every=4),
    "looked at ten times less often": replace(USUAL, every=40),
}
"""Robots of the second table."""

CLAIMED = (Outcome.SUCCESS, Outcome.WRONG)


@dataclass(frozen=True, slots=True)
class Case:
    """Runs of a task's plan on a robot."""

    task: str
    law: SlidingLaw
    plant: Plant
    runs: int
    seed: int


@dataclass(frozen=True, slots=True)
class Result:
    """What became of them.

    Parameters
    ----------
    ends : how many ended how.
    gap : how far from the goal a robot was at most that said it was there, in position errors.
    depth : how deep in an obstacle one was at most, in the same unit.
    time : how long a run took on average, in the task's unit of length.
    words : what the executors said that found the model contradicted.
    """

    ends: Counter[Outcome]
    gap: float
    depth: float
    time: float
    words: tuple[str, ...]


def result(case: Case) -> Result:
    """Plan, compile and run; nothing but zeros if there is no plan."""
    stage = scene(replace(named_task(case.task), sliding=case.law), case.plant)
    strategy = plan(stage.task)
    if strategy.status is not Status.SOLVED:
        return Result(Counter(), 0.0, 0.0, 0.0, ())
    drives = list(plan_trials(stage, compiled(strategy), case.runs, case.seed))
    return summed(drives, stage.length)


def summed(drives: list[Drive], length: float) -> Result:
    """Many runs in a few numbers."""
    return Result(
        Counter(one.outcome for one in drives),
        max((one.gap / length for one in drives if one.outcome in CLAIMED), default=0.0),
        max(one.depth / length for one in drives),
        math.fsum(one.time for one in drives) / len(drives),
        tuple(one.words for one in drives if one.outcome is Outcome.BROKEN),
    )


def share(ends: Counter[Outcome]) -> str:
    """The share of success."""
    runs = ends.total()
    return f"{100.0 * ends[Outcome.SUCCESS] / runs:.4g} %" if runs else "no plan"


def others(ends: Counter[Outcome]) -> str:
    """All other ends."""
    bad = [how for how in Outcome if how is not Outcome.SUCCESS and ends[how]]
    return ", ".join(f"{ends[how]} {how.value}" for how in bad) or "–"


def by_task(options: Namespace, pool: ProcessPoolExecutor) -> str:
    """The first table: the tasks."""
    cases = [
        Case(name, SlidingLaw.DAMPER, USUAL, options.runs, options.seed) for name in options.tasks
    ]
    lines = [
        "| task | runs | success | other ends | gap / ρ | depth / ρ | time |",
        "|---|--:|--:|---|--:|--:|--:|",
    ]
    for case, found in zip(cases, pool.map(result, cases), strict=True):
        lines.append(
            f"| {case.task} | {found.ends.total()} | {share(found.ends)} | {others(found.ends)} "
            f"| {found.gap:.3f} | {found.depth:.3f} | {found.time:.1f} |"
        )
    return "\n".join(lines)


def by_plant(options: Namespace, pool: ProcessPoolExecutor) -> str:
    """The second table: some tasks, on other robots than the usual; and what went wrong."""
    rows = {name: (SlidingLaw.DAMPER, plant) for name, plant in PLANTS.items()}
    rows["planned with the law of projection"] = SlidingLaw.PROJECTION, USUAL
    cases = [
        Case(task, law, plant, options.runs, options.seed)
        for law, plant in rows.values()
        for task in options.stressed
    ]
    found = iter(list(pool.map(result, cases)))
    lines = ["| robot | " + " | ".join(options.stressed) + " |"]
    lines.append("|---|" + "--:|" * len(options.stressed))
    remarks = []
    for name in rows:
        mine = [next(found) for _ in options.stressed]
        lines.append(f"| {name} | " + " | ".join(share(one.ends) for one in mine) + " |")
        for task, one in zip(options.stressed, mine, strict=True):
            if one.ends.total() > one.ends[Outcome.SUCCESS]:
                said = f"; one said: {one.words[0]}" if one.words else ""
                remarks.append(f"- {name}, {task}: {others(one.ends)}{said}")
    return "\n".join([*lines, "", *remarks])


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--runs", type=int, default=200, help="runs a task (200)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--tasks", nargs="*", default=TASKS)
    parser.add_argument("--stressed", nargs="*", default=STRESSED)
    options = parser.parse_args()
    with ProcessPoolExecutor(options.processes) as pool:
        if options.tasks:
            sys.stdout.write(by_task(options, pool) + "\n\n")
        if options.stressed:
            sys.stdout.write(by_plant(options, pool) + "\n")


if __name__ == "__main__":
    main()
