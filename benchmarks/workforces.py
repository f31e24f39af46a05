"""Who does the work: the same map by one process, by two, and by a cluster of one and two."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager

from benchmarks.timing import Row
from preimage.analysis.map import error_map
from preimage.analysis.survey import Survey
from preimage.jobs import Here, Processes, Workforce, workforce
from preimage.task.examples import named_task
from preimage.task.options import Method

TASK = "peg-in-hole"
PLACES = (16, 16)
RUNS = 2

ITEMS = 2_000
"""Empty pieces of work, to see what one costs that is nothing."""


@contextmanager
def cluster(workers: int) -> Iterator[Workforce]:
    """A cluster on this machine."""
    from distributed import LocalCluster

    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    with (
        LocalCluster(
            n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=":0",
            scheduler_port=0, silence_logs=logging.CRITICAL,
        ) as made,
        workforce(scheduler=made.scheduler_address) as crew,
    ):  # fmt: skip
        yield crew


def mapped(crew: Workforce) -> tuple[float, int]:
    """The least seconds for a map, and how many plans it took."""
    least, plans = float("inf"), 0
    for _ in range(RUNS):
        began = time.perf_counter()
        survey = Survey.of(named_task(TASK), workforce=crew)
        found = error_map(survey, "control", "position", places=PLACES, methods=(Method.COMBINED,))
        least, plans = min(least, time.perf_counter() - began), found.looked_at
    return least, plans


def empty(crew: Workforce) -> float:
    """Milliseconds for a piece of work that is nothing."""
    began = time.perf_counter()
    list(crew.carry_out(abs, range(ITEMS)))
    return 1e3 * (time.perf_counter() - began) / ITEMS


def workforces() -> Iterator[Row]:
    """Seconds, gain and efficiency beside this process alone."""
    alone, plans = mapped(Here())
    rows: list[tuple[str, int, float, float]] = [("this process", 1, alone, empty(Here()))]
    for number in (1, 2):
        with Processes(number) as crew:
            rows.append((f"{number} processes", number, mapped(crew)[0], empty(crew)))
    for number in (1, 2):
        with cluster(number) as crew:
            rows.append((f"cluster of {number}", number, mapped(crew)[0], empty(crew)))
    for who, number, seconds, cost in rows:
        words = f"gain {alone / seconds:.2f}, efficiency {100.0 * alone / seconds / number:.0f} %"
        yield f"{plans} plans by {who}", seconds, f"{words}, {cost:.2f} ms an empty item"
