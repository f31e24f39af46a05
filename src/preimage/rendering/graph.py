"""A strategy as a graph: regions in columns by rank, and arrows to what their motions end in."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch

from preimage.rendering.glyphs import draw_direction
from preimage.rendering.layers import draw_region
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import POINTS_AN_INCH, Panel
from preimage.rendering.scene import Scene, draw_scene
from preimage.rendering.sheet import wrapped
from preimage.rendering.strategy import degrees, title
from preimage.rendering.style import (
    BLUE,
    FADED,
    GREEN,
    INK,
    PAPER,
    SMALL_SIZE,
    TEXT_SIZE,
    TITLE_SIZE,
    VERMILLION,
    Layer,
)
from preimage.strategy.decisions import Case, cases
from preimage.strategy.strategy import Strategy, StrategyRegion

MOST_NODES = 30
"""Of larger strategies the part is drawn that lies nearest to the start, and the goal."""

MOST_LABELS = 16
"""With more arrows than this they bear no words."""

NODE, LOWEST, HIGHEST = 118.0, 46.0, 150.0
"""Points: how wide nodes are, and bounds of their height."""

BETWEEN, BELOW, MARGIN = 150.0, 34.0, 12.0
"""Points: between columns, between rows, and around."""

WORDS = 128.0
"""Points: how wide what is read is written."""

LABEL = 24.0
"""Points: what is read takes so much room, from line to line."""

Corner = tuple[float, float]


def graph_figure(strategy: Strategy, options: PictureOptions) -> Figure:
    """The graph of a strategy: the start on the left, the goal on the right.

    Each node is a thumbnail of its region; each arrow leads to a goal of its motion, and says what
    is read where the motion ends in it.
    """
    scene = Scene.of(strategy.task, strategy.space)
    shown = nodes(strategy)
    xmin, ymin, xmax, ymax = scene.box
    high = min(max(NODE * (ymax - ymin) / (xmax - xmin), LOWEST), HIGHEST)
    columns = _columns(shown)
    rows = max(len(column) for column in columns)
    width = 2.0 * MARGIN + BELOW + len(columns) * (NODE + BETWEEN) - BETWEEN
    head = TITLE_SIZE + MARGIN if options.titles else 0.0
    height = 2.0 * MARGIN + head + rows * (high + BELOW)
    figure = Figure(figsize=(width / POINTS_AN_INCH, height / POINTS_AN_INCH))
    FigureCanvasAgg(figure)
    words = title(strategy, options)
    if len(shown) < len(strategy.regions):
        words += f"; {len(shown)} of {len(strategy.regions)} regions shown, nearest to the start"
    figure.set_label(words)
    places: dict[int, Corner] = {}
    for index, column in enumerate(columns):
        x = MARGIN + BELOW + index * (NODE + BETWEEN)
        left = 0.5 * (rows - len(column)) * (high + BELOW)
        for row, region in enumerate(column):
            places[region.id] = x, height - MARGIN - head - left - (row + 1) * (high + BELOW)
    _draw_arrows(figure, strategy, shown, places, (width, height), high)
    for region in shown:
        _draw_node(figure, strategy, scene, region, places[region.id], (width, height), high)
    if options.titles:
        figure.text(
            MARGIN / width, 1.0 - MARGIN / height, words, fontsize=TITLE_SIZE, weight="bold",
            color=INK, va="top", gid="title",
        )  # fmt: skip
    return figure


def nodes(strategy: Strategy) -> list[StrategyRegion]:
    """The regions of the graph, by id: what may be come to from the start, the nearest first.

    Without a start, those of least rank.
    """
    known = {region.id: region for region in strategy.regions}
    goals = [region.id for region in strategy.regions if region.motion is None]
    first = list(strategy.start)
    if not first:
        first = sorted(known, key=lambda number: (known[number].rank, number))
    order = dict.fromkeys([*goals, *first])
    waiting = list(first)
    while waiting:
        motion = known[waiting.pop(0)].motion
        for goal in sorted(motion.goals) if motion else ():
            if goal not in order:
                order[goal] = None
                waiting.append(goal)
    return [known[number] for number in sorted(list(order)[:MOST_NODES])]


def _columns(shown: Sequence[StrategyRegion]) -> list[list[StrategyRegion]]:
    """Regions by rank, the highest first; ranks that no region has take no room."""
    ranks = sorted({region.rank for region in shown}, reverse=True)
    return [[region for region in shown if region.rank == rank] for rank in ranks]


def _draw_node(
    figure: Figure,
    strategy: Strategy,
    scene: Scene,
    region: StrategyRegion,
    place: Corner,
    size: Corner,
    high: float,
) -> None:
    (x, y), (width, height) = place, size
    name = f"node-{region.id}"
    axes = figure.add_axes((x / width, y / height, NODE / width, high / height), label=name)
    axes.set_gid(name)
    xmin, ymin, xmax, ymax = scene.box
    unit = max((xmax - xmin) / NODE, (ymax - ymin) / high)
    middle = 0.5 * (xmin + xmax), 0.5 * (ymin + ymax)
    axes.set_xlim(middle[0] - 0.5 * NODE * unit, middle[0] + 0.5 * NODE * unit)
    axes.set_ylim(middle[1] - 0.5 * high * unit, middle[1] + 0.5 * high * unit)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_facecolor(PAPER)
    color = VERMILLION if region.failure else GREEN if region.motion is None else FADED
    for spine in axes.spines.values():
        spine.set_edgecolor(color)
    panel = Panel.of(axes, name, scene.space, unit, scene.box)
    draw_scene(panel, scene, start=region.id in strategy.start)
    if region.motion is None:
        words = "failed, and knows it" if region.failure else "the goal"
        draw_region(panel, Layer.FOUND if region.failure else Layer.GOAL, region.region)
    else:
        words = f"{region.id}: {degrees(region.motion.direction)}"
        draw_region(panel, Layer.PREIMAGE, region.region, number=region.id)
        draw_direction(panel, region.motion.direction, strategy.task.uncertainty.control)
    figure.text(
        x / width, (y + high + 3.0) / height, words, fontsize=TEXT_SIZE, weight="bold",
        color=INK, va="bottom",
    )  # fmt: skip


def _draw_arrows(
    figure: Figure,
    strategy: Strategy,
    shown: Sequence[StrategyRegion],
    places: dict[int, Corner],
    size: Corner,
    high: float,
) -> None:
    total = sum(len(region.motion.goals) for region in shown if region.motion)
    for number in strategy.start:
        if number in places:
            x, y = places[number][0], places[number][1] + 0.5 * high
            _arrow(figure, (x - BELOW, y), (x - 2.0, y), size, INK, f"start-{number}")
    for region in shown:
        if region.motion is None:
            continue
        asked: list[Case]
        if total <= MOST_LABELS and len(region.motion.goals) > 1:
            asked = list(cases(strategy, region.motion))
        else:
            asked = [Case(goal, ()) for goal in region.motion.goals]
        asked = [case for case in asked if case.goal in places]
        asked.sort(key=lambda case: (-places[case.goal][1], -places[case.goal][0], case.goal))
        step = max(high / max(len(asked), 1), LABEL)
        for row, case in enumerate(asked):
            x, y = places[region.id]
            begin = x + NODE, y + high * (1.0 - (row + 0.5) / len(asked))
            end = places[case.goal][0] - 2.0, places[case.goal][1] + 0.5 * high
            color = GREEN if strategy.region(case.goal).motion is None else BLUE
            if strategy.region(case.goal).failure:
                color = VERMILLION
            far = end[0] - begin[0] > BETWEEN
            _arrow(
                figure, begin, end, size, color, f"arrow-{region.id}-{case.goal}",
                -0.25 if far and end[1] <= begin[1] else 0.25 if far else 0.0,
            )  # fmt: skip
            level = y + 0.5 * high + step * (0.5 * (len(asked) - 1) - row)
            _write(figure, case, (begin[0], level), size, step)


def _arrow(
    figure: Figure, begin: Corner, end: Corner, size: Corner, color: str, name: str, bow: float = 0
) -> None:
    (width, height) = size
    arrow = FancyArrowPatch(
        (begin[0] / width, begin[1] / height),
        (end[0] / width, end[1] / height),
        transform=figure.transFigure,
        connectionstyle=f"arc3,rad={bow}",
        arrowstyle="-|>",
        mutation_scale=9.0,
        shrinkA=0.0,
        shrinkB=0.0,
        linewidth=1.1,
        color=color,
    )
    arrow.set_gid(name)
    figure.add_artist(arrow)


def _write(figure: Figure, case: Case, place: Corner, size: Corner, room: float) -> None:
    """What is read, beside the node; its first clause if there are several."""
    if not case.clauses:
        return
    words = case.clauses[0].words
    if len(case.clauses) > 1:
        words += ", …"
    words = f"{case.goal or 'goal'}: {words}"
    lines = wrapped(words, WORDS, SMALL_SIZE)[: max(2, math.floor(room / SMALL_SIZE))]
    figure.text(
        (place[0] + 7.0) / size[0],
        place[1] / size[1],
        "\n".join(lines),
        fontsize=SMALL_SIZE,
        color=INK,
        va="center",
        bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 0.6, "alpha": 0.85},
        zorder=5,
    )
