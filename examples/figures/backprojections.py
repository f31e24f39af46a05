"""Figures 5 and 6: maximal backprojections."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from examples.figures.redrawn import DOWN, Redrawn, letter
from preimage import Setting, backproject, named_task
from preimage.configuration.contact import ContactSpace, Ints
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.geometry.angles import unit
from preimage.mechanics.behaviour import Behaviour
from preimage.reachability.backprojection import Backprojection
from preimage.reachability.sources import Sources
from preimage.rendering.style import Layer
from preimage.rendering.views import Line, Part, Place, View, Views
from preimage.task.task import Task


def marked(contact: ContactSpace, goal: Region, command: Sources) -> Ints:
    """The vertices that Erdmann's algorithm marks for a goal of edges (paper 5.2, step 1)."""
    before = contact.previous
    may_stick, _ = command.where(Behaviour.MAY_STICK)
    may_slide, _ = command.where(Behaviour.MAY_SLIDE)
    along = (contact.ends - contact.points) @ np.array(unit(command.direction))
    forth, back = may_slide & (along > 0.0), (may_slide & (along < 0.0))[before]
    in_goal = np.isin(np.arange(len(contact)), goal.contact.vertices)
    goal_edge = np.isin(np.arange(len(contact)), goal.contact.edge)
    other = ~in_goal & (may_stick | may_stick[before] | (forth & back))
    leaving = in_goal & ((forth & ~goal_edge) | (back & ~goal_edge[before]))
    return np.flatnonzero((other | leaving) & ~contact.open & ~contact.open[before]).astype(
        np.int32
    )


def places(contact: ContactSpace, vertices: Ints, name: str = "") -> tuple[Place, ...]:
    """Vertices as marked ones."""
    return tuple(Place((x, y), name, Layer.REASON) for x, y in contact.points[vertices].tolist())


def _view(task: Task, found: Backprojection, heading: str, marks: tuple[Place, ...]) -> View:
    return View(
        task=task, space=found.space, heading=heading, goal=False, places=marks, direction=DOWN,
        parts=(
            Part(Layer.TARGET, found.target, letter("T", above="s")),
            Part(Layer.PREIMAGE, found.region, letter("B")),
        ),
        lines=tuple(Line(ray) for ray in found.rays),
    )  # fmt: skip


WORDS = {
    Layer.PREIMAGE: "backprojection",
    Layer.TARGET: letter("T", above="s"),
    Layer.REASON: "vertex marked in step 1",
}


def figure_5() -> Redrawn:
    """The rays of marked vertices bound a backprojection."""
    task = named_task("figure-5")
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    command = setting.command(DOWN).sources
    found = backproject(setting.space, goal, command)
    marks = marked(setting.space.contact, goal, command)
    return Redrawn(
        5,
        "Computation of a Backprojection",
        Views((_view(task, found, "", places(setting.space.contact, marks)),), words=WORDS,
              command=True),
        "Three C-obstacles; the target is the edge `Tˢ`, on which a motion straight down sticks. "
        f"Erdmann's first step marks {len(marks)} vertices: those beside an edge on which the "
        "motion may stick, those from which it may slide to either side, and the ends of `Tˢ` "
        "from which it may slide away. From each, two rays go up along the sides of the inverted "
        f"control cone; {len(found.rays)} of them bound the backprojection. The others are of no "
        "consequence, and the sweep does not follow them.",
        "The algorithm of the paper traces the region from its rays. Ours sweeps a line upwards "
        "and keeps what is avoidable below it; the marks are drawn for comparison.",
        {"marks": float(len(marks)), "rays": float(len(found.rays)),
         "area": found.region.area.measure},
    )  # fmt: skip


def figure_6() -> Redrawn:
    """The same by marks, and with the hole that both slides off a tip leave."""
    task = named_task("figure-6")
    setting = Setting.of(task)
    contact = setting.space.contact
    goal = goal_region(task, setting.space)
    command = setting.command(DOWN).sources
    marks = marked(contact, goal, command)
    (tip,) = (mark for mark in marks if contact.points[mark].tolist() == [0.0, 6.0])
    # a marked vertex counts as one at which the motion may be held
    codes = command.vertices.copy()
    codes[tip] |= np.uint8(Behaviour.MAY_STICK)
    erdmann = backproject(setting.space, goal, replace(command, vertices=codes))
    maximal = backproject(setting.space, goal, command)
    here = places(contact, marks[marks == tip], "$X$")
    views = (
        _view(task, erdmann, "a  With the rays from X", here),
        _view(task, maximal, "b  Maximal", here),
    )
    sizes = [found.region.area.measure for found in (erdmann, maximal)]
    return Redrawn(
        6,
        "Multiply-Connected Backprojection",
        Views(views, words={**WORDS, Layer.REASON: "vertex $X$"}, command=True),
        "Whoever hits `X` slides to its left or to its right, nobody knows where. Erdmann's "
        "algorithm marks such a vertex, and loses all above it that may hit it (a). But on both "
        "sides the slide ends at a corner from which only `Tˢ` can be reached; so `X` is no "
        "danger, and the maximal backprojection goes all around the obstacle (b). "
        f"It measures {sizes[1]:.5g}, the other {sizes[0]:.5g}.",
        "Panel a is our sweep with `X` declared a vertex that may hold the robot, which is what "
        "its mark amounts to.",
        {"marked": sizes[0], "maximal": sizes[1]},
    )
