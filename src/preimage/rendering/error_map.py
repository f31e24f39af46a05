"""Pictures of maps of two bounds."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from preimage.analysis.axis import Axis
from preimage.analysis.describe import outcome_words, with_unit
from preimage.analysis.grid import NONE, UNKNOWN, Ints
from preimage.analysis.map import ErrorMap
from preimage.rendering.budget import NO_PLAN, motion_patches, shade
from preimage.rendering.style import (
    FADED,
    INK,
    ORANGE,
    PAPER,
    SMALL_SIZE,
    TEXT_SIZE,
    TITLE_SIZE,
    VERMILLION,
)

SIZE = (6.4, 5.2)
"""Inches."""

HATCHES = ("", "....", "////")
"""Of the methods on a map, the plainest first."""


def map_figure(found: ErrorMap) -> Figure:
    """The figure of a map: cells by the fewest motions, hatched by the plainest method."""
    made = Figure(figsize=SIZE)
    made.set_label(f"error map of {found.name}")
    axes = made.add_axes((0.12, 0.13, 0.62, 0.76))
    title = f"{found.name}: {outcome_words(found.given)}"
    axes.set_title(title.replace("$", r"\$"), fontsize=TITLE_SIZE, color=INK, loc="left")
    motions, plainest = found.motions, found.plainest
    colors = np.empty((*motions.shape, 4))
    for value in np.unique(motions):
        color = NO_PLAN if value == NONE else PAPER if value == UNKNOWN else shade(int(value))
        colors[motions == value] = to_rgba(color)
    xs, ys = _borders(found.x), _borders(found.y)
    axes.pcolormesh(xs, ys, np.transpose(colors, (1, 0, 2)), rasterized=motions.size > 4_000)
    used = [place for place in range(len(found.layers)) if np.any(plainest == place)]
    for place in used:
        _hatch(axes, xs, ys, plainest == place, HATCHES[place % len(HATCHES)])
    _hatch(axes, xs, ys, motions == UNKNOWN, "xxxx")
    _draw_frontiers(axes, xs, ys, motions)
    asked = np.argwhere(np.any([layer.looked_at for layer in found.layers], axis=0))
    axes.plot(
        np.array(found.x.values)[asked[:, 0]], np.array(found.y.values)[asked[:, 1]], ".",
        color=FADED, markersize=1.2, gid="looked-at",
    )  # fmt: skip
    _mark_given(axes, found, xs, ys)
    for axis, label in ((found.x, axes.set_xlabel), (found.y, axes.set_ylabel)):
        unit = " (°)" if axis.unit else ""
        label(f"{axis.key.replace('$', '')}{unit}", fontsize=TEXT_SIZE)
    axes.tick_params(labelsize=SMALL_SIZE)
    patches: list[Patch | Line2D] = []
    patches += motion_patches(
        {int(one) for one in np.unique(motions) if one not in (NONE, UNKNOWN)}
    )
    if np.any(motions == NONE):
        patches.append(Patch(facecolor=NO_PLAN, label="no plan"))
    if np.any(motions == UNKNOWN):
        patches.append(Patch(facecolor=PAPER, edgecolor=FADED, hatch="xxxx", label="no answer"))
    if len(found.layers) > 1:
        for place in used:
            hatch, name = HATCHES[place % len(HATCHES)], found.layers[place].method.value
            patches.append(Patch(facecolor=PAPER, edgecolor=INK, hatch=hatch, label=f"by {name}"))
    dot = Line2D([], [], marker=".", color=FADED, linestyle="", markersize=3, label="looked at")
    made.legend(
        handles=[*patches, dot], loc="upper left", bbox_to_anchor=(0.755, 0.89), frameon=False,
        fontsize=SMALL_SIZE,
    )  # fmt: skip
    return made


def _borders(axis: Axis) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Where cells meet: half-way between values."""
    values = np.array(axis.values)
    middles = 0.5 * (values[1:] + values[:-1])
    first, last = 1.5 * values[0] - 0.5 * values[1], 1.5 * values[-1] - 0.5 * values[-2]
    return np.concatenate(([first], middles, [last]))


def _hatch(
    axes: Axes,
    xs: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    ys: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    where: np.ndarray[tuple[int, ...], np.dtype[np.bool_]],
    hatch: str,
) -> None:
    """Hatch cells, runs of a column at a time."""
    if not hatch:
        return
    boxes = []
    for i, column in enumerate(where):
        places = np.flatnonzero(column)
        for run in np.split(places, np.flatnonzero(np.diff(places) > 1) + 1):
            if len(run):
                low, high = ys[run[0]], ys[run[-1] + 1]
                boxes.append(Rectangle((xs[i], low), xs[i + 1] - xs[i], high - low))
    cells = PatchCollection(boxes, facecolor="none", edgecolor=to_rgba(INK, 0.35), linewidth=0.0)
    cells.set_hatch(hatch)
    axes.add_collection(cells)


def _draw_frontiers(
    axes: Axes,
    xs: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    ys: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    motions: Ints,
) -> None:
    """Lines where the motions change; where plans end, a heavy one."""
    for i, j in np.argwhere(motions[1:] != motions[:-1]):
        ends = NONE in (motions[i, j], motions[i + 1, j])
        _line(axes, (xs[i + 1], xs[i + 1]), (ys[j], ys[j + 1]), bool(ends))
    for i, j in np.argwhere(motions[:, 1:] != motions[:, :-1]):
        ends = NONE in (motions[i, j], motions[i, j + 1])
        _line(axes, (xs[i], xs[i + 1]), (ys[j + 1], ys[j + 1]), bool(ends))


def _line(axes: Axes, xs: tuple[float, float], ys: tuple[float, float], ends: bool) -> None:
    color, width = (VERMILLION, 1.4) if ends else (PAPER, 0.8)
    gid = "frontier" if ends else "change"
    axes.plot(xs, ys, color=color, linewidth=width, solid_capstyle="projecting", gid=gid)


def _mark_given(
    axes: Axes,
    found: ErrorMap,
    xs: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    ys: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
) -> None:
    """The task as it is, if it lies on the map."""
    axes.set_xlim(xs[0], xs[-1])
    axes.set_ylim(ys[0], ys[-1])
    x, y = found.x.given, found.y.given
    if not (
        math.isfinite(x) and math.isfinite(y) and xs[0] <= x <= xs[-1] and ys[0] <= y <= ys[-1]
    ):
        return
    axes.plot(
        [x], [y], "*", color=ORANGE, markeredgecolor=INK, markersize=11, markeredgewidth=0.7,
        gid="given", zorder=9,
    )  # fmt: skip
    words = f"given: {with_unit(found.x, x)}, {with_unit(found.y, y)}"
    axes.annotate(
        words, (x, y), (7, 7), textcoords="offset points", fontsize=SMALL_SIZE, color=INK, zorder=9,
        bbox={"facecolor": PAPER, "alpha": 0.8, "linewidth": 0.0, "pad": 0.8},
    )  # fmt: skip
