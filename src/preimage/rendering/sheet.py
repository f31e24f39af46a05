"""A sheet: panels in rows, each under its title, and one legend below them all."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.legend import Legend
from matplotlib.textpath import TextPath
from matplotlib.ticker import MaxNLocator

from preimage.rendering.glyphs import COMPASS
from preimage.rendering.legend import Glyph, Key, keys, proxy
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import FRAME, POINTS_AN_INCH, Panel
from preimage.rendering.scene import Scene
from preimage.rendering.style import (
    FADED,
    FONTS,
    INK,
    SMALL_SIZE,
    TEXT_SIZE,
    TITLE_SIZE,
    Layer,
)

Box = tuple[float, float, float, float]

AREA = 9.6
"""Square inches: the size of a panel, tall or wide."""

NARROWEST, WIDEST = 2.3, 6.6
SHORTEST, TALLEST = 0.3, 6.0
"""Inches: bounds of a panel's sides."""

PAGE = 10.4
"""Inches: rows are no wider, but for a single panel."""

SMALLER = 0.72
"""Panels become smaller by this at most so that one more fits in a row."""

LONG = 2.5
"""Panels this many times as wide as high are not made smaller."""

LOW, ROOM_ABOVE = 110.0, 2.0 * COMPASS + 5.0
"""Points: in panels that are lower, a direction has its own room above."""

LEADING = 1.28
"""The distance of lines of text, in their size."""

MARGIN = 7.0
"""Points: around the sheet, and between its parts."""

TICK_ROOM = (26.0, 15.0)
"""Points that the ticks' numbers need on the left and below; more if they are long."""


@dataclass(frozen=True, slots=True, eq=False)
class Plate:
    """What one panel shows.

    Parameters
    ----------
    name : of the panel, in ids.
    heading, detail : its title, and what is said below it.
    paint : draws it.
    compass : whether a direction is drawn in it.
    """

    name: str
    heading: str
    detail: str
    paint: Callable[[Panel], None]
    compass: bool = False


@dataclass(frozen=True, slots=True)
class Layout:
    """Sizes in points: of panels, each `wide` by `high`; `unit` is the length of a point."""

    columns: int
    wide: float
    high: float
    above: float
    unit: float
    ticks: tuple[float, float]
    xticks: tuple[float, ...]
    yticks: tuple[float, ...]


def compose(
    scene: Scene,
    plates: Sequence[Plate],
    title: str,
    options: PictureOptions,
    *,
    words: dict[Layer, str] | None = None,
    command: bool = False,
) -> Figure:
    """A figure with these panels.

    Parameters
    ----------
    title : of the whole sheet; may be empty.
    words : names for layers that are not the usual ones.
    command : whether bounds on all errors matter, and go into the legend.
    """
    layout = arrange(
        scene.box, len(plates), options, compass=any(plate.compass for plate in plates)
    )
    figure = Figure(figsize=(1.0, 1.0))
    figure.set_label(title)
    FigureCanvasAgg(figure)
    panels = []
    for plate in plates:
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), label=plate.name)
        axes.set_gid(plate.name)
        _prepare(axes, scene.box, layout)
        panel = Panel.of(axes, plate.name, scene.space, layout.unit, scene.box)
        plate.paint(panel)
        panels.append(panel)
    drawn: dict[Layer, set[str]] = {}
    for panel in panels:
        for layer, parts in panel.layers.items():
            drawn.setdefault(layer, set()).update(parts)
    legend = keys(drawn, scene, words or {}, command) if options.legend else []
    _place(figure, plates, panels, layout, title, legend, options)
    return figure


# --- sizes ------------------------------------------------------------------------------------


def arrange(box: Box, count: int, options: PictureOptions, *, compass: bool = False) -> Layout:
    """How many panels stand in a row, and how large they are.

    Parameters
    ----------
    compass : whether a direction is drawn in each; above a low window room is made for it.

    >>> options = PictureOptions()
    >>> [arrange((0, 0, 4, 4), count, options).columns for count in (1, 2, 3, 4, 5, 8)]
    [1, 2, 3, 2, 3, 3]
    """
    xmin, ymin, xmax, ymax = box
    ratio = (xmax - xmin) / (ymax - ymin)
    if options.panel_width is None:
        wide = min(math.sqrt(AREA * ratio), TALLEST * ratio)
        wide = min(max(wide, NARROWEST), WIDEST)
        columns = options.columns or _columns(count, wide, ratio)
        wide = min(wide, _room(columns)) if columns > 1 else wide
    else:
        wide = options.panel_width
        columns = options.columns or _columns(count, wide, math.inf)
    columns = min(columns, count)
    frame = 2.0 * (FRAME + 1.0)
    unit = (xmax - xmin) / max(wide * POINTS_AN_INCH - frame, 10.0)
    high = (ymax - ymin) / unit
    limit = TALLEST * POINTS_AN_INCH
    if high > limit and options.panel_width is None:
        unit *= high / limit
        high = limit
    xticks = _ticks(xmin, xmax, max(2, round((xmax - xmin) / unit / 44.0)))
    yticks = _ticks(ymin, ymax, max(2, round((ymax - ymin) / unit / 36.0)))
    above = ROOM_ABOVE if compass and high < LOW else 0.0
    high = max(high, SHORTEST * POINTS_AN_INCH) + frame + above
    longest = max((len(label(value)) for value in yticks), default=1)
    room = (max(TICK_ROOM[0], 4.0 * longest + 8.0), TICK_ROOM[1]) if options.ticks else (0.0, 0.0)
    return Layout(columns, wide * POINTS_AN_INCH, high, above, unit, room, xticks, yticks)


def _room(columns: int) -> float:
    """Inches for each of so many panels in a row of a page."""
    return PAGE / columns - (TICK_ROOM[0] + 1.5 * MARGIN) / POINTS_AN_INCH


def _columns(count: int, wide: float, ratio: float) -> int:
    """As many panels as fit in a row, a little smaller if need be; wide ones one by one."""
    least = wide if ratio > LONG else SMALLER * wide
    fitting = max(
        (columns for columns in range(1, count + 1) if _room(columns) >= least), default=1
    )
    return math.ceil(count / math.ceil(count / fitting))


def _ticks(low: float, high: float, most: int) -> tuple[float, ...]:
    """Round numbers in an interval, fewer if they are long to write."""
    for count in range(min(most, 9), 0, -1):
        values = MaxNLocator(nbins=count, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
        slack = 1e-9 * (high - low)
        inside = tuple(
            0.0 if abs(value) < slack else float(value)
            for value in values
            if low - slack <= value <= high + slack
        )
        if sum(len(label(value)) + 2 for value in inside) <= 4.5 * most:
            return inside
    return ()


def label(value: float) -> str:
    """A number on an axis.

    >>> label(-2.5), label(1e6)
    ('−2.5', '1000000')
    """
    return f"{value:.10g}".replace("-", "\N{MINUS SIGN}")


@lru_cache(maxsize=4096)
def text_width(words: str, size: float, bold: bool = False) -> float:
    """How wide a text without spaces is, in points, or a little less."""
    font = FontProperties(family=FONTS, weight="bold" if bold else "normal", size=size)
    font.set_math_fontfamily("stix")
    corners = np.asarray(TextPath((0.0, 0.0), words, prop=font, size=size).vertices)
    return float(corners[:, 0].max(initial=0.0))


def wrapped(words: str, width: float, size: float, bold: bool = False) -> list[str]:
    """A text in lines no wider than `width` points, where its words allow that."""
    lines: list[str] = []
    used, space = 0.0, 0.3 * size
    for word in words.split():
        wide = text_width(word, size, bold)
        if lines and used + space + wide <= width:
            lines[-1] += f" {word}"
            used += space + wide
        else:
            lines.append(word)
            used = wide
    return lines


# --- places -----------------------------------------------------------------------------------


def _prepare(axes: Axes, box: Box, layout: Layout) -> None:
    """Equal scales about the middle of the box, few ticks, no frame."""
    middle = 0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3] + layout.above * layout.unit)
    half = 0.5 * layout.wide * layout.unit, 0.5 * layout.high * layout.unit
    axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    axes.set_ylim(middle[1] - half[1], middle[1] + half[1])
    axes.set_facecolor("none")
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_xticks(layout.xticks, [label(value) for value in layout.xticks])
    axes.set_yticks(layout.yticks, [label(value) for value in layout.yticks])
    axes.tick_params(
        length=2.5, width=0.5, pad=1.5, labelsize=SMALL_SIZE, color=FADED, labelcolor=FADED
    )


def _place(
    figure: Figure,
    plates: Sequence[Plate],
    panels: Sequence[Panel],
    layout: Layout,
    title: str,
    legend: Sequence[Key],
    options: PictureOptions,
) -> None:
    columns, rows = layout.columns, math.ceil(len(plates) / layout.columns)
    step = layout.wide + layout.ticks[0] + 1.5 * MARGIN
    width = 2.0 * MARGIN + columns * step - 1.5 * MARGIN
    texts = [_title_lines(plate, layout, options) for plate in plates]
    heads = [
        max(_height(lines) for lines in texts[row * columns : (row + 1) * columns])
        for row in range(rows)
    ]
    top = wrapped(title, width - 2.0 * MARGIN, TITLE_SIZE, bold=True) if options.titles else []
    top_height = len(top) * TITLE_SIZE * LEADING + (0.4 * MARGIN if top else 0.0)
    body = sum(heads) + rows * (layout.high + layout.ticks[1] + MARGIN)
    drawn, foot = _legend(figure, legend, width - 2.0 * MARGIN)
    height = 2.0 * MARGIN + top_height + body + foot
    figure.set_size_inches(width / POINTS_AN_INCH, height / POINTS_AN_INCH)

    y = height - MARGIN
    for line in top:
        figure.text(
            MARGIN / width, y / height, line, fontsize=TITLE_SIZE, weight="bold", color=INK,
            va="top", gid=None if line is not top[0] else "title",
        )  # fmt: skip
        y -= TITLE_SIZE * LEADING
    y -= 0.4 * MARGIN if top else 0.0
    for row in range(rows):
        for column, place in enumerate(range(row * columns, min((row + 1) * columns, len(plates)))):
            x = MARGIN + column * step + layout.ticks[0]
            _write(figure, texts[place], x + FRAME + 1.0, y, width, height)
            bottom = y - heads[row] - layout.high
            panels[place].axes.set_position(
                (x / width, bottom / height, layout.wide / width, layout.high / height)
            )
            if not options.ticks:
                panels[place].axes.set_axis_off()
        y -= heads[row] + layout.high + layout.ticks[1] + MARGIN
    if drawn is not None:
        drawn.set_bbox_to_anchor((0.5, MARGIN / height))


def _title_lines(plate: Plate, layout: Layout, options: PictureOptions) -> list[tuple[str, bool]]:
    if not options.titles:
        return []
    width = layout.wide - FRAME
    head = wrapped(plate.heading, width, TEXT_SIZE, bold=True)
    rest = wrapped(plate.detail, width, TEXT_SIZE)
    return [(line, True) for line in head] + [(line, False) for line in rest]


def _height(lines: Sequence[tuple[str, bool]]) -> float:
    return len(lines) * TEXT_SIZE * LEADING + (0.6 * MARGIN if lines else 0.0)


def _write(
    figure: Figure,
    lines: Sequence[tuple[str, bool]],
    x: float,
    y: float,
    width: float,
    height: float,
) -> None:
    for line, bold in lines:
        figure.text(
            x / width, y / height, line, fontsize=TEXT_SIZE, color=INK, va="top",
            weight="bold" if bold else "normal",
        )  # fmt: skip
        y -= TEXT_SIZE * LEADING


def _legend(figure: Figure, legend: Sequence[Key], width: float) -> tuple[Legend | None, float]:
    """The legend, in as many columns as fit, and its height in points."""
    if not legend:
        return None, 0.0
    canvas = figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    artists = [proxy(key) for key in legend]
    glyphs = {artist: Glyph() for artist in artists}
    for columns in range(min(len(legend), 6), 0, -1):
        drawn = figure.legend(
            artists, [key.words for key in legend], handler_map=glyphs, ncols=columns,
            loc="lower center", frameon=False, fontsize=TEXT_SIZE, handlelength=2.4,
            handleheight=0.95, borderpad=0.2, labelspacing=0.75, columnspacing=1.4,
            borderaxespad=0.0,
        )  # fmt: skip
        # matplotlib leaves get_renderer untyped
        size = drawn.get_window_extent(canvas.get_renderer())  # type: ignore[no-untyped-call]
        scale = POINTS_AN_INCH / figure.dpi
        if size.width * scale <= width or columns == 1:
            drawn.set_gid("legend")
            return drawn, size.height * scale + MARGIN
        drawn.remove()
    raise AssertionError("a legend has at least one column")
