"""Figures 16 to 19: what the termination condition knows."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from examples.figures.redrawn import DOWN, Redrawn, ending_readings, letter, seen
from preimage import Method, Setting, named_task
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.geometry import area as areas
from preimage.geometry.inflate import outer_stadiums
from preimage.preimages.preimage import Preimage
from preimage.preimages.start_search import stateful_preimage
from preimage.reachability.forward_projection import forward_project
from preimage.recognition.termination import ReadingCondition
from preimage.rendering.style import Layer
from preimage.rendering.views import Line, Part, Place, View, Views
from preimage.task import Termination

Point = tuple[float, float]

RECTANGLE = "figure-16"

KERNEL = r"$\chi$"
WORDS = {Layer.TARGET: r"kernel $\chi$", Layer.GOAL: "goal $T$"}

WINDOWS = {"figure-16": (-6.0, -4.0, 6.0, 9.0), "flat-floor": (-6.0, -2.0, 6.0, 13.0)}
"""What is drawn of these tasks."""


@cache
def posed(name: str) -> tuple[Setting, Region]:
    """The setting of a task as it is drawn, and its goal."""
    task = seen(name, WINDOWS[name])
    setting = Setting.of(task)
    return setting, goal_region(task, setting.space)


@cache
def made(name: str, termination: Termination) -> Preimage:
    """The preimage of a task's goal for a motion straight down, by a condition."""
    setting, goal = posed(name)
    found = stateful_preimage(setting, [goal], DOWN, Method.KERNEL, termination)
    assert found is not None
    return found


def domain(name: str, termination: Termination) -> Region | None:
    """What that condition takes to hold the robot; None for all of valid space."""
    (condition,) = made(name, termination).termination
    assert isinstance(condition, ReadingCondition)
    return condition.domain


def stops(name: str, termination: Termination) -> Region:
    """The positions that may be measured at which its motion ends."""
    return ending_readings(*posed(name), domain(name, termination))


def _view(name: str, heading: str, *parts: Part, **more: Any) -> View:
    """A panel of a task, without its goal's letter unless it is given."""
    setting, _ = posed(name)
    view = View(
        task=seen(name, WINDOWS[name]), space=setting.space, heading=heading, goal_name="",
        parts=parts,
    )  # fmt: skip
    return replace(view, **more)


def _rectangle() -> tuple[float, float, float, float]:
    """Half the width and half the height of Figure 16's goal, `2 rho`, and theta."""
    task = named_task("figure-16")
    ((x, y),) = (ring[2] for ring in task.goal.polygons)
    return x, y, 2.0 * task.uncertainty.position, task.uncertainty.control


def mirrored(left: dict[str, Point], names: str) -> dict[str, Point]:
    """The points, and those on the other side: `names` are their letters, two by two."""
    pairs = dict(name.split("-") for name in names.split())
    return left | {pairs[name]: (-x, y) for name, (x, y) in left.items()}


def points_of_17() -> dict[str, Point]:
    """The points that the paper's construction names, for Figure 16's rectangle."""
    w, h, r, theta = _rectangle()
    low = h - 2.0 * r * math.cos(theta)  # of P'
    left = {
        "A": (r * math.sin(theta) - w, h - r * math.cos(theta)),
        "B": (2.0 * r * math.sin(theta) - w, h - r),
        "G": (r - w, r - h),
        "H": (r - w, low),
        "P": (2.0 * r * math.sin(theta) - w, h),
        "P'": (-w, low),
    }
    return mirrored(left, "A-D B-C G-F H-E P-Q P'-Q'")


def points_of_19() -> dict[str, Point]:
    """The same for Figure 19."""
    w, h, r, theta = _rectangle()
    left = {
        "R": (r * math.sin(theta) - w, h),
        "R'": (-w, h - r * math.cos(theta)),
    }
    return mirrored(left, "R-S R'-S'")


def _answer(found: Preimage, number: str | int = "") -> tuple[Part, Part]:
    """A kernel and its preimage, as parts of a panel."""
    kernel = found.target.kernel
    return (
        Part(Layer.TARGET, kernel, KERNEL),
        Part(Layer.PREIMAGE, found.region, letter("P", number), kernel.area),
    )


def _places(points: dict[str, Point]) -> tuple[Place, ...]:
    return tuple(Place(at, f"${name}$") for name, at in points.items())


def _between(points: dict[str, Point], *pairs: str) -> tuple[Line, ...]:
    """Lines between points: `P-P'`."""
    ends = [pair.split("-") for pair in pairs]
    return tuple(Line(np.array([points[a], points[b]]), "", Layer.NAME) for a, b in ends)


def figure_16() -> Redrawn:
    """A rectangle in empty space by instantaneous readings: kernel, preimage, readings."""
    found = made(RECTANGLE, Termination.INSTANTANEOUS)
    readings = stops(RECTANGLE, Termination.INSTANTANEOUS)
    chi, safe = _answer(found)
    views = (
        _view(RECTANGLE, "a  Kernel", chi),
        _view(RECTANGLE, "b  Preimage", chi, safe, direction=DOWN),
        _view(RECTANGLE, "c  Readings", Part(Layer.STOPS, readings), goal_name="$T$"),
    )
    sizes = {
        "kernel": found.target.kernel.area.measure,
        "preimage": found.region.area.measure,
        "readings": readings.area.measure,
    }
    return Redrawn(
        16,
        "Rectangular Goal in Empty Configuration Space",
        Views(views, words=WORDS, command=True),
        "A goal of 8 by 4 in empty space, which only the position can tell. Its kernel `χ` is what "
        f"is `2ρ = 1` from its border (a): 6 by 2, an area of {sizes['kernel']:.4g}. The preimage "
        "is all that cannot miss `χ` on the way down (b). A position measured in the goal, `ρ` or "
        "more from its border, tells it: the rectangle in panel c.",
        "Our preimage is cut by the window; without that it would go on to a tip.",
        sizes,
    )  # fmt: skip


def figure_17() -> Redrawn:
    """The same goal, known where the motion began."""
    found = made(RECTANGLE, Termination.INITIAL_STATE)
    points = points_of_17()
    readings = stops(RECTANGLE, Termination.INITIAL_STATE)
    view = _view(
        RECTANGLE, "", *_answer(found), Part(Layer.STOPS, readings), direction=DOWN,
        lines=_between(points, "P-P'", "Q-Q'"), places=_places(points),
    )  # fmt: skip
    sizes = {
        "preimage": found.region.area.measure,
        "before": made(RECTANGLE, Termination.INSTANTANEOUS).region.area.measure,
    }
    return Redrawn(
        17,
        "Using Initial State",
        Views((view,), words=WORDS, command=True),
        "The condition knows the preimage in which the motion began, so that the robot is in the "
        "forward projection of that; no reading can mean what lies beside it. At `A` all that fits "
        "a reading lies in the goal, or where no motion gets. `PP'` and `QQ'` are as long as `4ρ`, "
        "and the arcs have the radius `2ρ`. The preimage has an area of "
        f"{sizes['preimage']:.4g}, instead of {sizes['before']:.4g} in Figure 16.",
        "`A` and `D` are cusps. Left of `A` the kernel goes on to the side of the goal, along a "
        "second cusp that no motion from the preimage visits, so that `B(χ, v)` is larger than "
        "what is drawn: the figure's preimage is no fixpoint of the backprojection alone. Nor is "
        "it the largest, since what the lines lose further inside, the kernel gains below. "
        "The planner searches, and finds one of that family. As drawn the construction needs a "
        "height of `2ρ + 4ρ cos θ` and a width of `8ρ sin θ`, not just the `4ρ` of the text.",
        sizes,
        5.0,
    )  # fmt: skip


def figure_18() -> Redrawn:
    """A segment of a line: with the start known, nothing is lost at its ends."""
    name = "flat-floor"
    found = {
        "b": made(name, Termination.INSTANTANEOUS), "c": made(name, Termination.INITIAL_STATE),
    }  # fmt: skip
    views = (
        _view(name, "a  Goal", goal_name="$T$"),
        _view(name, "b  Readings alone", *_answer(found["b"], 1), direction=DOWN),
        _view(name, "c  Known start", *_answer(found["c"], 2), direction=DOWN),
    )
    sizes = {part: one.region.area.measure for part, one in found.items()}
    length = found["b"].target.kernel.contact.total_length
    return Redrawn(
        18,
        "Using Initial State (Other Example)",
        Views(views, words=WORDS, command=True),
        "The goal is a segment of a straight floor, 4 long (a). Readings alone confuse its ends "
        f"with the floor beside it: the kernel is {length:.3g} long, and the preimage a "
        f"triangle of {sizes['b']:.4g} (b). Who knows that the motion began in the triangle over "
        "all of the goal knows that it cannot meet the floor beside it: nothing is confused "
        f"with the goal, and that triangle, of {sizes['c']:.4g}, is its own preimage (c). Both "
        "are `L²/(4 tan θ)`.",
        "The floor of the paper is infinite, ours ends far outside.",
        {**sizes, "kernel": length},
    )


def figure_19() -> Redrawn:
    """The rectangle, known where the motion began and where it would have ended."""
    setting, goal = posed(RECTANGLE)
    found = made(RECTANGLE, Termination.FINAL_STATE)
    points = points_of_19()
    visited = forward_project(
        setting.space, found.region, DOWN, setting.uncertainty.control, setting.friction
    ).region
    about = np.array([points["R'"]])
    disc = outer_stadiums(about, about, 2.0 * setting.uncertainty.position)
    behind = areas.difference(areas.intersection(disc, visited.area), goal.area)
    view = _view(
        RECTANGLE, "", Part(Layer.LOST, Region(behind, Region.empty().contact)), *_answer(found),
        Part(Layer.STOPS, stops(RECTANGLE, Termination.FINAL_STATE)), direction=DOWN,
        lines=_between(points, "R-R'", "S-S'"), places=_places(points),
    )  # fmt: skip
    sizes = {
        "preimage": found.region.area.measure,
        "before": made(RECTANGLE, Termination.INITIAL_STATE).region.area.measure,
        "behind": behind.measure,
    }
    words = {**WORDS, Layer.LOST: "possible if the motion went on"}
    return Redrawn(
        19,
        "Using Initial and Final States",
        Views((view,), words=words, command=True),
        "Now the condition also knows itself: where it would have been true on the way, the motion "
        "has not got beyond. At `R'` a reading may mean the sector beside the goal that the "
        "forward projection holds; but a motion has to cross the kernel to get there, and would "
        "have ended. So the kernel is all of the goal that is `2ρ` or more below its upper side, "
        "but for arcs at `R'` and `S'`, down to the lower corners. The preimage has an area of "
        f"{sizes['preimage']:.4g} instead of {sizes['before']:.4g}.",
        "The paper has a construction for this rectangle; the planner approaches the fixpoint from "
        "above, for any goal. Arcs are tangents on the safe side, which costs less than a percent.",
        sizes,
        5.0,
    )  # fmt: skip
