"""What threads could gain: the share of a search that is spent without the interpreter's lock."""

from __future__ import annotations

import cProfile
import pstats
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from time import process_time

import numpy as np

from benchmarks.layers import NOWHERE
from benchmarks.timing import Row, best
from preimage.configuration.goals import goal_region
from preimage.preimages.setting import Setting
from preimage.search.conditional import layers
from preimage.search.limits import Limits
from preimage.search.planner import plan
from preimage.task.examples import named_task
from preimage.task.options import Continuous, Directions, Method, uniform_directions

THREADS = 2

SCENES: tuple[tuple[str, str, Directions], ...] = (
    ("peg-in-hole", "8 directions", uniform_directions(8)),
    ("peg-in-hole", "continuous", Continuous()),
    ("hall-12", "16 directions", uniform_directions(16)),
    ("hall-38", "8 directions", uniform_directions(8)),
    ("hall-38", "16 directions", uniform_directions(16)),
    ("hall-180", "8 directions", uniform_directions(8)),
    ("hall-180", "16 directions", uniform_directions(16)),
    ("hall-1820", "8 directions", uniform_directions(8)),
    ("hall-1820", "16 directions", uniform_directions(16)),
)

FIXPOINTS = (("hall-38", 16), ("hall-38", 64))


def threads() -> list[Row]:
    """Linear plans and fixpoints of conditional layers, each with the bound on two threads' gain.

    Two whole plans that share nothing are the best case: no direction waits for another. Two
    sorts, which need no lock, say how many cores there are at the time.
    """
    rows: list[Row] = [("two sorts that need no lock", *_gain(_sort))]
    for name, words, directions in SCENES:
        task = named_task(name)
        task = replace(task, options=replace(task.options, directions=directions))
        work = partial(plan, task, reasoned=False)
        spent, gain = _gain(work)
        rows.append((f"{name}, {words}: two plans", spent, f"{gain}; {_bound(work)}"))
    for name, count in FIXPOINTS:
        closing = partial(_fixpoint, name, count)
        begin = process_time()
        words = _bound(closing)
        rows.append((f"{name}, {count} directions: layers", process_time() - begin, words))
    return rows


def _sort() -> None:
    np.random.default_rng(1).random(1_000_000).sort()


def _fixpoint(name: str, count: int) -> None:
    task = named_task(name)
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    layers(
        setting, [goal], NOWHERE, uniform_directions(count), Method.COMBINED, 8, Limits(None, 10**6)
    )


def _gain(work: Callable[[], object]) -> tuple[float, str]:
    """The time of two runs one after the other, and how much faster two threads do them."""

    def in_turn() -> None:
        work()
        work()

    with ThreadPoolExecutor(THREADS) as crew:

        def together() -> None:
            for done in [crew.submit(work) for _ in range(THREADS)]:
                done.result()

        spent = best(in_turn)
        return spent, f"{spent / best(together):.2f} x with threads"


def _bound(work: Callable[[], object]) -> str:
    """The share of a run in GEOS and native code, and what it lets two threads gain at most.

    All of shapely is taken to release the lock, which it does not when it makes geometries; on the
    other hand a profile makes Python's own share larger than it is.
    """
    work()
    profile = cProfile.Profile()
    profile.runcall(work)
    entries = pstats.Stats(profile).stats.items()  # type: ignore[attr-defined]
    whole = sum(own for _, (_, _, own, _, _) in entries)
    free = sum(own for place, (_, _, own, _, _) in entries if _may_be_unlocked(place))
    most = min(float(THREADS), whole / (whole - free))
    return f"{free / whole:.0%} in GEOS and native code: at most {most:.2f} x"


def _may_be_unlocked(place: tuple[str, int, str]) -> bool:
    file, _, name = place
    return "shapely" in file or "shapely" in name or "_native" in name or name == "_sweep"
