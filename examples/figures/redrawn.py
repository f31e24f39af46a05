"""What one redrawn figure is, and what several of them need."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from preimage import Method, Strategy, Task, named_task, plan
from preimage.configuration.region import Region
from preimage.execution.runs import RunOptions, trace_of
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.inflate import grow
from preimage.preimages.setting import Setting
from preimage.recognition.outside import area_outside
from preimage.rendering.style import Layer
from preimage.rendering.views import Line, Place, Views
from preimage.task import Window

DOWN = math.radians(270)


@dataclass(frozen=True, slots=True, eq=False)
class Redrawn:
    """A figure of the paper, made from what the planner computes.

    Parameters
    ----------
    number : of the figure.
    caption : as the paper has it.
    views : the picture.
    shows : what is to be seen; Markdown.
    differs : where it is not the paper's, and why; empty if it is.
    numbers : what the text quotes, by name, for whoever checks it.
    panel_width : of the picture, in inches; as wide as usual by default.
    """

    number: int
    caption: str
    views: Views
    shows: str
    differs: str = ""
    numbers: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    panel_width: float | None = None

    def region(self, view: int, name: str) -> Region:
        """The region with this letter in one of the panels, the first being 0."""
        (found,) = (part.region for part in self.views.views[view].parts if part.name == name)
        return found


def letter(name: str, below: str | int = "", above: str = "") -> str:
    r"""A letter of the paper, as it is written in pictures.

    >>> print(letter("T", 2), letter("T", above="s"))
    $\mathcal{T}_{2}$ $\mathcal{T}^{s}$
    """
    low = f"_{{{below}}}" if below != "" else ""
    high = f"^{{{above}}}" if above else ""
    return rf"$\mathcal{{{name}}}{low}{high}$"


def label(name: str, at: tuple[float, float]) -> Place:
    """A letter without a dot."""
    return Place(at, name, Layer.NAME)


def by_method(name: str, method: Method) -> Strategy:
    """The shortest strategy for a named task by one method."""
    task = named_task(name)
    return plan(replace(task, options=replace(task.options, method=method)))


def seen(name: str, box: tuple[float, float, float, float]) -> Task:
    """A named task in a smaller window, with all that matters in it."""
    task = named_task(name)
    return replace(task, workspace=replace(task.workspace, window=Window(*box)))


def ways(strategy: Strategy) -> tuple[Line, ...]:
    """The way of a robot without errors: an arrow for each motion, v_1 the first."""
    trace = trace_of(strategy, ("exact", "true"), options=RunOptions(runs=1))
    one = len(trace.legs) == 1
    return tuple(
        Line(leg.places, r"$\mathbf{v}$" if one else rf"$\mathbf{{v}}_{number}$", Layer.RUN, True)
        for number, leg in enumerate(trace.legs, 1)
    )


def part_of_contact(region: Region) -> Region:
    """What contact space has of a region."""
    return Region(Area.empty(), region.contact)


def part_of_area(region: Region) -> Region:
    """What free space has of a region."""
    return replace(Region.empty(), area=region.area)


def ending_readings(setting: Setting, goal: Region, domain: Region | None = None) -> Region:
    """The positions that may be measured in the goal, and that tell it, where nothing is touched.

    `(T & Delta) (+) D(rho)` without `(Delta - T) (+) D(rho)`: the condition `K_v(q, 0) & Delta <=
    T` holds there (theory 5). Arcs are on the safe side of what is taken away.
    """
    rho = setting.uncertainty.position
    told = goal.area if domain is None else areas.intersection(goal.area, domain.area)
    rest = area_outside(setting.space, goal, domain)
    near = grow(told, rho, setting.arc_tolerance)
    if not rest.is_empty:
        near = areas.difference(near, grow(rest, rho, setting.arc_tolerance))
    return Region(near, Region.empty().contact)
