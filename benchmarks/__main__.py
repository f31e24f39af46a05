"""All benchmarks, printed, and kept in the docs: run alone on the machine."""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarks.backprojection import growth
from benchmarks.directions import compasses
from benchmarks.execution import motions
from benchmarks.executor import executors
from benchmarks.forward import forward_growth
from benchmarks.layers import fixpoints
from benchmarks.planning import processes, small_scenes, whole_plans
from benchmarks.threads import threads
from benchmarks.timing import table
from benchmarks.workforces import workforces

BENCHMARKS = {
    "Growth of the sweep": growth,
    "Growth of the forward projection": forward_growth,
    "Small scenes": small_scenes,
    "All directions": compasses,
    "Whole plans": whole_plans,
    "Conditional layers": fixpoints,
    "Processes": processes,
    "Motions": motions,
    "Readings": executors,
    "Threads": threads,
    "Workforces": workforces,
}

PAGE = """# Benchmarks

Made by `make bench`: the best of several runs in one process, on the machine at hand; compare the
ratios, not the times. The target of a hall is its whole floor, among boxes of any angle, at most
one a lattice cell. The sweep's own time leaves out what is computed once a scene and once a
direction, and the making of polygons for GEOS; “and region” is with them.

"""


def main() -> None:
    """Run the benchmarks that are asked for; with all of them, write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=sorted(BENCHMARKS))
    parser.add_argument("--page", type=Path, help="a file to write the tables to")
    arguments = parser.parse_args()
    page = PAGE
    for title, benchmark in BENCHMARKS.items():
        if arguments.only in (None, title):
            section = f"## {title}\n\n{table(benchmark())}\n\n"
            print(section, flush=True)
            page += section
    if arguments.page is not None:
        arguments.page.write_text(page.rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
