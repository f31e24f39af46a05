"""Runs in their scene: a panel for each motion, with the ways of many runs or of one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon, Wedge
from matplotlib.text import Text
from numpy.typing import NDArray

from preimage.configuration.region import Region
from preimage.execution.report import Report
from preimage.execution.trace import Leg, Outcome, Trace
from preimage.geometry.angles import unit
from preimage.rendering.glyphs import arrow, draw_direction
from preimage.rendering.layers import draw_region
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import Panel
from preimage.rendering.scene import Scene, draw_scene
from preimage.rendering.sheet import Plate, compose
from preimage.rendering.strategy import degrees, in_order
from preimage.rendering.style import BLUE, MARKS, ORANGE, PAPER, VERMILLION, Layer
from preimage.task.uncertainty import Uncertainty

Floats = NDArray[np.float64]

MOST_RUNS = 300
"""So many runs are drawn."""

FEW_RUNS = 6
"""Of so many runs also what was measured at the end of each motion is drawn."""

MOST_DISCS = 400.0
"""Points: larger discs of the position error would hide the scene."""

WAY_COST, MANY_WAYS_COST = 12.0, 0.3
"""What it costs to write over a cell of a way; many ways leave no room."""

FORCE_LENGTH = 20.0
"""Points: how long the arrow of a measured force is."""


def trace_figure(trace: Trace, options: PictureOptions) -> Figure:
    """The figure of one run: where it went in each motion, and what was read when that ended."""
    words = trace.words or trace.outcome.value
    name = trace.strategy.task.name.replace("$", r"\$")
    who = f"run {trace.number} under {trace.control}+{trace.sensing}"
    title = f"{name}: {who if trace.control else 'a counter-example'}, {words}"
    return _figure(trace, [trace], title, options)


def report_figure(report: Report, options: PictureOptions) -> Figure:
    """The figure of many runs: some of each pair of adversaries, and the first that failed."""
    name = report.strategy.task.name.replace("$", r"\$")
    runs = [trace for trace in report.samples if trace.outcome.as_planned]
    runs = runs[:: max(1, -(-len(runs) // MOST_RUNS))]
    shown = [*runs, *([report.failure] if report.failure else [])]
    words = (
        _as_planned(report)
        if not report.failures
        else (f"{report.failures:,} of {report.runs:,} runs failed")
    )
    title = f"{name}: {words}"
    if len(shown) < report.runs:
        title += f"; {len(shown)} of them shown"
    return _figure(report, shown, title, options)


def _as_planned(report: Report) -> str:
    """How many runs ended in the goal, if none broke the plan's promise."""
    known = report.outcomes.get(Outcome.FAILED, 0)
    if not known:
        return f"all {report.runs:,} runs succeeded"
    return f"{known:,} of {report.runs:,} runs know that they have failed, the others succeeded"


def _figure(
    subject: Trace | Report, traces: Sequence[Trace], title: str, options: PictureOptions
) -> Figure:
    strategy = subject.strategy
    scene = Scene.of(strategy.task, strategy.space)
    used = {leg.region for trace in traces for leg in trace.legs}
    order = [region.id for region in in_order(strategy) if region.id in used]
    order += sorted(used - set(order))
    plates = [
        _plate(scene, subject, traces, number, place, len(order))
        for place, number in enumerate(order[: options.max_panels])
    ]
    if not plates:
        detail = "the start lies in the goal"
        plates = [Plate("scene", "Nothing to do", detail, partial(draw_scene, scene=scene))]
    words = {Layer.FOUND: r"preimage $\mathcal{P}$"}
    return compose(scene, plates, title, options, words=words, command=bool(order))


def film_figure(trace: Trace, number: int) -> Figure:
    """The ground of a film of one of a run's motions: all that does not move in it."""
    strategy, leg = trace.strategy, trace.legs[number]
    scene = Scene.of(strategy.task, strategy.space)
    plate = _plate(scene, trace, [], leg.region, number, len(trace.legs))
    options = PictureOptions(legend=False)
    title = f"{strategy.task.name}: {trace.control}+{trace.sensing}".replace("$", r"\$")
    return compose(scene, [replace(plate, detail=" ")], title, options)


def _plate(
    scene: Scene,
    subject: Trace | Report,
    traces: Sequence[Trace],
    number: int,
    place: int,
    count: int,
) -> Plate:
    region = subject.strategy.region(number)
    motion = region.motion
    direction = motion.direction if motion is not None else 0.0
    legs = [(trace, leg) for trace in traces for leg in trace.legs if leg.region == number]

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene, start=place == 0)
        if motion is not None:
            draw_region(panel, Layer.TARGET, motion.target)
            quiet = Region(region.region.area, motion.target.contact)
            draw_region(panel, Layer.FOUND, quiet, number=number)
        errors = subject.strategy.task.uncertainty
        draw_legs(panel, legs, errors)
        draw_direction(panel, direction, errors.control)

    heading = f"Motion {place + 1} of {count}: {degrees(direction)}"
    return Plate(f"motion-{place + 1}", heading, _detail(legs), paint, compass=True)


def _detail(legs: Sequence[tuple[Trace, Leg]]) -> str:
    """How the motion was ended in these runs."""
    words = [leg.ended_by or "no condition" for _, leg in legs]
    kinds = sorted(set(words), key=lambda word: (-words.count(word), word))
    if len(words) == 1:
        return f"ended by {kinds[0]} after {legs[0][1].times[-1] - legs[0][1].times[0]:.4g}"
    return "ended by " + ", ".join(f"{kind} ({words.count(kind)})" for kind in kinds)


def draw_legs(panel: Panel, legs: Sequence[tuple[Trace, Leg]], errors: Uncertainty) -> None:
    """Draw the ways of runs in one motion, failures on top.

    Parameters
    ----------
    errors : bounds on them; of few runs the readings at the end of the motion are drawn too.
    """
    good = [leg for trace, leg in legs if trace.outcome.as_planned]
    bad = [(trace, leg) for trace, leg in legs if not trace.outcome.as_planned]
    if good:
        opacity = max(0.12, min(0.9, 8.0 / len(good)))
        width = 1.4 if len(good) <= FEW_RUNS else 0.7
        for layer, outcome, color in (
            (Layer.RUN, Outcome.SUCCESS, BLUE),
            (Layer.GIVEN_UP, Outcome.FAILED, ORANGE),
        ):
            ways = [leg for trace, leg in legs if trace.outcome is outcome]
            if ways:
                _draw_ways(panel, layer, ways, color, width, opacity, 7.0)
        _draw_marks(panel, Layer.BEGIN, [leg.places[0] for leg in good], len(good))
        _draw_marks(panel, Layer.END, [leg.places[-1] for leg in good], len(good))
    if bad:
        _draw_ways(panel, Layer.FAILURE, [leg for _, leg in bad], VERMILLION, 2.0, 1.0, 7.6)
        _draw_marks(panel, Layer.BEGIN, [leg.places[0] for _, leg in bad], 1)
        for trace, leg in bad:
            if leg is trace.legs[-1]:
                _draw_outcome(panel, trace, leg)
    if len(legs) <= FEW_RUNS:
        for _, leg in legs:
            draw_reading(panel, leg, len(leg.times) - 1, errors)


def _draw_ways(
    panel: Panel,
    layer: Layer,
    legs: Sequence[Leg],
    color: str,
    width: float,
    opacity: float,
    order: float,
) -> None:
    ways = LineCollection(
        [leg.places for leg in legs],
        colors=[color],
        linewidths=[width],
        alpha=opacity,
        capstyle="round",
        joinstyle="round",
        zorder=order,
    )
    panel.add(ways, layer)
    cost = WAY_COST if len(legs) <= FEW_RUNS else MANY_WAYS_COST
    for leg in legs:
        panel.lattice.cost += cost * panel.lattice.along(leg.places[:-1], leg.places[1:])


def _draw_marks(panel: Panel, layer: Layer, places: Sequence[Floats], count: int) -> None:
    shape, color = MARKS[layer]
    points = np.array(places)
    marks = Line2D(
        points[:, 0].tolist(),
        points[:, 1].tolist(),
        linestyle="none",
        marker=shape,
        markersize=4.5 if count <= FEW_RUNS else 2.2,
        markerfacecolor=color,
        markeredgecolor=PAPER,
        markeredgewidth=0.5 if count <= FEW_RUNS else 0.2,
        clip_on=False,
        zorder=8.0,
    )
    panel.add(marks, layer)
    if count <= FEW_RUNS:
        side = 5.0 * panel.unit
        for x, y in points.tolist():
            panel.lattice.take(x, y, side, side)


def _draw_outcome(panel: Panel, trace: Trace, leg: Leg) -> None:
    """Mark where a run failed, and say how."""
    x, y = leg.places[-1].tolist()
    cross = Line2D(
        [x], [y], linestyle="none", marker="X", markersize=8.0, markerfacecolor=VERMILLION,
        markeredgecolor=PAPER, clip_on=False, zorder=9.0,
    )  # fmt: skip
    panel.add(cross, Layer.FAILURE, "end")
    words = trace.outcome.value
    wide, high = 4.2 * len(words) * panel.unit, 10.0 * panel.unit
    away = panel.lattice.from_point(x, y) / panel.unit
    place = panel.lattice.clearest(wide, high, 4.0 * np.maximum(away - 12.0, 0.0))
    if place is None:
        return
    text = Text(
        *place, words, fontsize=7.5, color=VERMILLION, ha="center", va="center", zorder=10.0
    )
    text.set_bbox({"facecolor": PAPER, "alpha": 0.8, "edgecolor": "none", "pad": 0.6})
    panel.add(text, Layer.FAILURE, "words")
    panel.lattice.take(*place, wide, high)


def draw_reading(panel: Panel, leg: Leg, instant: int, errors: Uncertainty) -> None:
    """Draw what was read at an instant: the position and the force, with what bounds their errors.

    The real force pushes from within the cone behind the arrow.
    """
    error = errors.position
    place, measured = leg.places[instant], leg.measured[instant]
    if np.all(np.isfinite(measured)):
        shape, color = MARKS[Layer.MEASURED]
        mark = Line2D(
            [float(measured[0])], [float(measured[1])], linestyle="none", marker=shape,
            markersize=7.0, markeredgecolor=color, markeredgewidth=1.4, clip_on=False, zorder=8.4,
        )  # fmt: skip
        panel.add(mark, Layer.MEASURED)
        if 0.0 < panel.points(error) < MOST_DISCS:
            disc = Circle(
                (float(measured[0]), float(measured[1])), error, facecolor="none",
                edgecolor=color, linewidth=0.8, linestyle=(0.0, (1.0, 1.6)), zorder=8.3,
            )  # fmt: skip
            panel.add(disc, Layer.MEASURED, "error")
    force = float(leg.forces[instant])
    if math.isfinite(force):
        along = np.array(unit(force))
        tail = place - FORCE_LENGTH * panel.unit * along
        back, half = math.degrees(force) + 180.0, math.degrees(errors.force_angle)
        if half > 0.0:
            cone = Wedge(
                (float(place[0]), float(place[1])), FORCE_LENGTH * panel.unit, back - half,
                back + half, facecolor=to_rgba(ORANGE, 0.35), edgecolor=ORANGE, linewidth=0.6,
                zorder=8.45, clip_on=False,
            )  # fmt: skip
            panel.add(cone, Layer.FORCE_CONE)
        head = (5.0 * panel.unit, 1.9 * panel.unit)
        push = Polygon(
            arrow(tail, place, head, 1.1 * panel.unit),
            facecolor=VERMILLION, linewidth=0.0, zorder=8.5, clip_on=False,
        )  # fmt: skip
        panel.add(push, Layer.FORCE)
