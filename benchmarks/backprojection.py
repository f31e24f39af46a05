"""One backprojection in halls of growing size, against the sort of its event keys."""

from __future__ import annotations

import math
import subprocess
import sys
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.halls import hall, united_by_geos
from benchmarks.timing import Row, best
from preimage.configuration.contact import ContactSpace
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.angles import unit
from preimage.reachability.backprojection import backproject
from preimage.reachability.sources import Sources, sources

DOWN = math.radians(270)
CONTROL, FRICTION = math.radians(5), math.radians(20)


def command(space: ConfigurationSpace, direction: float = DOWN) -> Sources:
    """What features do to a motion along a direction."""
    return sources(space.contact, direction, CONTROL, FRICTION, space.tolerance)


def region(space: ConfigurationSpace, goal: Region, along: Sources) -> Region:
    """A backprojection down to its polygons."""
    return backproject(space, goal, along).region


def event_keys(contact: ContactSpace) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """The heights of both ends of every edge, in the order of the edges."""
    x, y = unit(DOWN)
    return np.concatenate([-(points @ (x, y)) for points in (contact.points, contact.ends)])


def growth() -> list[Row]:
    """Time, ratio to numpy's sort, and memory, over sizes."""
    rows: list[Row] = []
    times: dict[int, float] = {}
    for edges in (10**2, 10**3, 10**4, 10**5, 10**6):
        space, goal = hall(edges)
        _ = space.contact.place, space.contact.previous
        down = command(space)
        spent = times[edges] = best(partial(backproject, space, goal, down))
        whole = best(partial(region, space, goal, down))
        sort = best(partial(np.sort, event_keys(space.contact)))
        rows.append((f"hall of {edges:,} edges: sweep", spent, f"{spent / sort:.1f} x numpy.sort"))
        rows.append((f"hall of {edges:,} edges: sweep and region", whole, ""))
        if edges == 10**5:
            geos = best(partial(united_by_geos, edges), seconds=0.0, least=1)
            rows.append((f"GEOS unites {edges:,} edges", geos, f"{geos / spent:.0f} x the sweep"))
    exponent = math.log(times[10**6] / times[10**4]) / math.log(100)
    rows.append(("growth exponent from 10,000 to 1,000,000 edges", math.nan, f"{exponent:.2f}"))
    rows.append(("memory of the sweep at 1,000,000 edges", math.nan, memory(10**6)))
    return rows


def memory(edges: int) -> str:
    """The peak that one sweep adds, measured in a process of its own."""
    script = f"from benchmarks.backprojection import peak; print(peak({edges}))"
    run = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
    return f"{float(run.stdout) / edges:.0f} bytes an edge"


def peak(edges: int) -> int:
    """Bytes by which the process grows in one sweep."""
    space, goal = hall(edges)
    _ = space.contact.place, space.contact.previous
    down = command(space)
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")  # the peak is now what is used
    before = _kilobytes("VmRSS")
    backproject(space, goal, down)
    return 1024 * (_kilobytes("VmHWM") - before)


def _kilobytes(entry: str) -> int:
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(next(line.split()[1] for line in status.splitlines() if line.startswith(entry)))
