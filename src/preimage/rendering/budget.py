"""Pictures of error budgets: a bar for each bound, with what is given, the slack and the cause."""

from __future__ import annotations

import math
import textwrap

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from preimage.analysis.budget import AxisBudget, Budget
from preimage.analysis.cell import Answer, Outcome
from preimage.analysis.describe import cause_words, outcome_words, slack_words, with_unit
from preimage.rendering.style import (
    BLUE,
    FADED,
    INK,
    PAPER,
    SMALL_SIZE,
    TEXT_SIZE,
    TITLE_SIZE,
    VERMILLION,
)

WIDTH, ROW, HEAD = 7.6, 1.0, 0.85
"""Inches: of the picture, for each bound, and for the title and the legend."""

BEYOND = 1.3
"""A bar reaches so much further than the last change and the given value."""

SHADES = ("#0072b2", "#56a0cc", "#8fbfdd", "#bcd8ea", "#d9e8f3")
"""One motion, two, …; the last stands for all that are longer."""

NO_PLAN, NO_ANSWER = "#dddddd", PAPER

LETTERS = 108
"""Of a line of causes."""


def budget_figure(budget: Budget) -> Figure:
    """The figure of a budget; each bound has its own scale."""
    height = HEAD + ROW * max(1, len(budget.axes))
    made = Figure(figsize=(WIDTH, height))
    made.set_label(f"error budget of {budget.name}")
    title = f"{budget.name}, {budget.method.value}: {outcome_words(budget.given)}"
    made.text(
        0.02, 1.0 - 0.12 / height, title.replace("$", r"\$"), fontsize=TITLE_SIZE, va="top",
        color=INK,
    )  # fmt: skip
    for row, axis in enumerate(budget.axes):
        bottom = height - HEAD - ROW * (row + 1) + 0.58
        axes = made.add_axes((0.22, bottom / height, 0.63, 0.24 / height))
        _draw_bar(axes, axis)
        causes = [f"{with_unit(axis.axis, one.inside)}: {cause_words(one)}" for one in axis.limits]
        lines = [line for cause in causes[:2] for line in textwrap.wrap(cause, LETTERS)]
        made.text(
            0.22, (bottom - 0.22) / height, "\n".join(lines[:3]), fontsize=SMALL_SIZE - 0.5,
            color=FADED, va="top", linespacing=1.05,
        )  # fmt: skip
    _draw_legend(made, budget, height)
    return made


def _draw_bar(axes: Axes, axis: AxisBudget) -> None:
    """What becomes of one bound."""
    axes.set_gid(f"bound-{axis.axis.name}")
    low, high = axis.axis.low, _end(axis)
    for stretch in axis.stretches:
        left = max(low, stretch.low)
        following = min((one.low for one in axis.stretches if one.low > stretch.low), default=high)
        width = min(following, high) - left
        if width <= 0.0:
            continue
        color = _color(stretch.outcome)
        bar = Rectangle((left, 0.0), width, 1.0, facecolor=color, edgecolor=PAPER, linewidth=0.4)
        if stretch.outcome.answer in (Answer.STOPPED, Answer.REFUSED, Answer.TOO_LONG):
            bar.set_hatch("////")
            bar.set_edgecolor(FADED)
        bar.set_gid(f"{stretch.outcome.answer.value}-{stretch.outcome.motions}")
        axes.add_patch(bar)
    if axis.spacing is not None:
        samples = math.floor((high - low) / axis.spacing) + 1
        places = [low + number * axis.spacing for number in range(samples)]
        axes.plot(places, [-0.08] * samples, "|", color=FADED, markersize=3, clip_on=False)
    given = axis.axis.given
    axes.set_xlim(low, high)
    axes.set_ylim(0.0, 1.0)
    if low <= given <= high:
        axes.plot([given, given], [-0.15, 1.25], color=INK, linewidth=1.6, clip_on=False)
        slack = axis.slack
        if slack is not None and 0.0 < slack < math.inf:
            axes.annotate(
                "", (given + slack, 0.5), (given, 0.5),
                arrowprops={"arrowstyle": "->", "color": INK, "linewidth": 0.9},
            )  # fmt: skip
    for limit in axis.limits:
        edge = 0.5 * (limit.inside + limit.outside)
        if low <= edge <= high:
            axes.plot([edge, edge], [0.0, 1.0], color=VERMILLION, linewidth=1.4)
    axes.set_yticks([])
    axes.tick_params(axis="x", labelsize=SMALL_SIZE, length=2.0, pad=1.5)
    for side in ("top", "left", "right"):
        axes.spines[side].set_visible(False)
    name = axis.axis.key.removeprefix("uncertainty.").replace("$", r"\$")
    unit = " (°)" if axis.axis.unit else ""
    axes.text(
        -0.02, 0.95, f"{name}{unit}", transform=axes.transAxes, ha="right", va="top",
        fontsize=TEXT_SIZE, color=INK,
    )  # fmt: skip
    axes.text(
        -0.02, -0.05, f"given {with_unit(axis.axis, given)}", transform=axes.transAxes, ha="right",
        va="center", fontsize=SMALL_SIZE, color=FADED,
    )  # fmt: skip
    axes.text(
        1.015, 0.5, slack_words(axis), transform=axes.transAxes, ha="left", va="center",
        fontsize=TEXT_SIZE, color=BLUE,
    )  # fmt: skip


def _end(axis: AxisBudget) -> float:
    """Where a bar is cut off: some way beyond the last change, and what is given."""
    last = [one.high for one in axis.stretches[:-1]]
    if math.isfinite(axis.axis.given):
        last.append(axis.axis.given)
    if not last or max(last) <= axis.axis.low:
        return axis.axis.high
    return min(axis.axis.high, axis.axis.low + BEYOND * (max(last) - axis.axis.low))


def _color(outcome: Outcome) -> str:
    if outcome.answer is Answer.SOLVED:
        assert outcome.motions is not None
        return shade(outcome.motions)
    return NO_PLAN if outcome.answer is Answer.UNSOLVABLE else NO_ANSWER


def shade(motions: int) -> str:
    """The colour of a number of motions: the fewer, the darker."""
    return SHADES[min(max(motions, 1), len(SHADES)) - 1]


def motion_patches(numbers: set[int]) -> list[Patch]:
    """What shades mean, for a legend."""
    words = {
        number: f"{number} or more motions" if number == len(SHADES) else
        f"{number} motion{'s' if number != 1 else ''}"
        for number in sorted({min(max(one, 1), len(SHADES)) for one in numbers})
    }  # fmt: skip
    return [Patch(facecolor=shade(number), label=label) for number, label in words.items()]


def _draw_legend(made: Figure, budget: Budget, height: float) -> None:
    outcomes = [one.outcome for axis in budget.axes for one in axis.stretches]
    patches = motion_patches({one.motions for one in outcomes if one.motions is not None})
    found = {one.answer for one in outcomes}
    if Answer.UNSOLVABLE in found:
        patches.append(Patch(facecolor=NO_PLAN, label="no plan"))
    if found & {Answer.STOPPED, Answer.REFUSED, Answer.TOO_LONG}:
        label = "no answer, or too long"
        patches.append(Patch(facecolor=PAPER, edgecolor=FADED, hatch="////", label=label))
    made.legend(
        handles=patches, loc="upper left", bbox_to_anchor=(0.015, 1.0 - 0.28 / height), ncols=7,
        frameon=False, fontsize=SMALL_SIZE, handlelength=1.4, columnspacing=1.2,
    )  # fmt: skip
