"""All directions of one motion: what bisection costs beside single preimages."""

from __future__ import annotations

import math
from functools import partial

from benchmarks.timing import Row, best
from preimage.configuration.goals import goal_region
from preimage.configuration.start import start_region
from preimage.preimages.setting import Setting
from preimage.search.directions import solving_directions
from preimage.search.limits import Limits
from preimage.search.linear import search
from preimage.search.tolerance import tolerant
from preimage.task.degrees import to_degrees
from preimage.task.examples import named_task
from preimage.task.options import SearchOrder

RESOLUTION = math.radians(0.1)

SCENES = ("flat-floor", "peg-in-hole", "example-1", "landmark-edge", "hall-9", "hall-25")


def compasses() -> list[Row]:
    """All solving directions to a tenth of a degree, and the margins of plans, warm."""
    rows: list[Row] = []
    for name in SCENES:
        task = named_task(name)
        setting = Setting.of(task)
        goal, start = goal_region(task, setting.space), start_region(task, setting.space)
        look = partial(solving_directions, setting, [goal], start, task.options.method, RESOLUTION)
        edges = len(setting.space.contact)
        arcs = look()
        rows.append((f"{name}, {edges} edges: all directions", best(look), f"{len(arcs)} arcs"))
    for name in ("peg-in-hole", "example-4"):
        task = named_task(name)
        setting = Setting.of(task)
        goal, start = goal_region(task, setting.space), start_region(task, setting.space)
        directions, method = task.options.directions, task.options.method
        assert isinstance(directions, tuple)
        order, limits = SearchOrder.BREADTH_FIRST, Limits(None, 10_000)
        found = search(setting, goal, start, directions, method, order, 8, limits)
        assert found.solution is not None
        widen = partial(tolerant, setting, found.solution.chain, start, method, RESOLUTION)
        margins = ", ".join(f"{to_degrees(node.margin or 0.0):.3g}°" for node in widen()[:-1])
        rows.append((f"{name}: margins of its motions", best(widen), margins))
    return rows
