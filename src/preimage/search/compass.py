"""Compass roses: which directions lead to the goal in one motion, from where (theory 7)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind
from preimage.display import Shown
from preimage.geometry.border import border
from preimage.preimages.setting import Setting
from preimage.search.directions import Arc, Verdict, solving_directions
from preimage.search.limits import Limits
from preimage.task.options import Method
from preimage.task.task import Task

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Rose:
    """What is known of all directions from one start.

    Parameters
    ----------
    point : where the rose is drawn: the start, or a place in it.
    arcs : of `solving_directions`.
    """

    point: Point
    arcs: tuple[Arc, ...]

    @property
    def solving(self) -> tuple[Arc, ...]:
        """The arcs that solve, the widest first."""
        found = (arc for arc in self.arcs if arc.verdict is Verdict.SOLVES)
        return tuple(sorted(found, key=lambda arc: (-arc.margin, arc.low)))


@dataclass(frozen=True, slots=True, eq=False)
class Compass(Shown):
    """Roses in the scene of a task.

    Parameters
    ----------
    roses : of starts that are of interest one by one.
    grid : of starts all over free space.
    """

    task: Task
    space: ConfigurationSpace
    roses: tuple[Rose, ...]
    grid: tuple[Rose, ...] = ()


def rose(
    setting: Setting,
    goals: Sequence[Region],
    start: Start,
    method: Method,
    resolution: float,
    limits: Limits | None = None,
) -> Rose:
    """All directions from a start; parameters as of `solving_directions`."""
    arcs = solving_directions(setting, goals, start, method, resolution, limits)
    return Rose(_place(start, setting.space), arcs)


def free_point(point: Point) -> Start:
    """A start at a point of free space."""
    return Start(StartKind.FREE_POINT, point, -1, 0.0, (), Region.empty())


def grid_points(space: ConfigurationSpace, columns: int, rows: int) -> tuple[Point, ...]:
    """The points of free space among the middles of the window's cells, row by row.

    >>> from preimage.task.examples import named_task
    >>> space = Setting.of(named_task("flat-floor")).space
    >>> [(round(x, 9), round(y, 9)) for x, y in grid_points(space, 2, 2)]
    [(-10.0, 10.0), (10.0, 10.0)]
    """
    xmin, ymin, xmax, ymax = space.window
    x = xmin + (np.arange(columns) + 0.5) * (xmax - xmin) / columns
    y = ymin + (np.arange(rows) + 0.5) * (ymax - ymin) / rows
    every = [(float(a), float(b)) for b in y for a in x]
    near = 4.0 * space.tolerance.length
    return tuple(
        (a, b) for a, b in every if space.free.contains(a, b) and space.free.depth(a, b) > near
    )


def _place(start: Start, space: ConfigurationSpace) -> Point:
    """A place to draw a rose at."""
    if start.point is not None:
        return start.point
    region = start.region
    if not region.area.is_empty:
        return region.area.inner_point
    contact = space.contact
    points = np.concatenate(
        (
            border(region.area)[0],
            contact.at(region.contact.edge, 0.5 * (region.contact.low + region.contact.high)),
            contact.points[region.contact.vertices],
        )
    )
    if not len(points):
        return math.nan, math.nan
    return float(points[0][0]), float(points[0][1])
