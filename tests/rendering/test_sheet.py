"""The arrangement of panels, titles and legend."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import combinations
from typing import Any

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

from preimage.errors import InputError
from preimage.rendering import figure, svg
from preimage.rendering.options import PictureOptions
from preimage.rendering.sheet import PAGE, arrange, text_width, wrapped
from preimage.strategy.strategy import Status, Strategy
from tests.rendering.drawn import strategy, task, words

TALL: dict[str, Any] = {
    "window": [-2, -40, 2, 4], "walls": ["left", "right"],
    "obstacles": [{"chain": [[-4, -38], [4, -38]], "solid": "right"}],
    "initial": {"point": [0, 2]}, "goal": {"edges": [[[-1.5, -38], [1.5, -38]]]},
}  # fmt: skip
WIDE: dict[str, Any] = {
    "window": [0, 0, 60, 5], "walls": ["top", "bottom", "left"], "obstacles": [],
    "initial": {"point": [2, 2]}, "goal": {"edges": [[[0, 0], [60, 0]]]},
}  # fmt: skip
FAR: dict[str, Any] = {
    "window": [1e6, 1e6, 1e6 + 10, 1e6 + 10], "walls": ["bottom"], "obstacles": [],
    "initial": {"point": [1e6 + 5, 1e6 + 5]},
    "goal": {"edges": [[[1e6, 1e6], [1e6 + 10, 1e6]]]},
}  # fmt: skip


def boxes(made: Figure) -> list[Bbox]:
    """Where panels, lines of text and the legend are, in pixels."""
    canvas = made.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    canvas.draw()  # type: ignore[no-untyped-call]
    renderer = canvas.get_renderer()  # type: ignore[no-untyped-call]
    found = [axes.get_tightbbox(renderer) for axes in made.axes]
    found += [text.get_window_extent(renderer) for text in made.texts]
    found += [legend.get_window_extent(renderer) for legend in made.legends]
    return [box for box in found if box is not None]


@pytest.mark.parametrize("scene", [{}, TALL, WIDE, FAR], ids=["box", "tall", "wide", "far"])
@pytest.mark.parametrize("count", [1, 2, 3, 5, 8])
def test_nothing_overlaps_and_all_is_on_the_sheet(scene: dict[str, Any], count: int) -> None:
    made = figure(strategy(task(**scene), count))
    sheet, found = made.bbox, boxes(made)
    for box in found:
        assert sheet.x0 - 1 <= box.x0 < box.x1 <= sheet.x1 + 1
        assert sheet.y0 - 1 <= box.y0 < box.y1 <= sheet.y1 + 1
    for first, second in combinations(found, 2):
        shared = Bbox.intersection(first, second)
        assert shared is None or min(shared.width, shared.height) < 2.0


@pytest.mark.parametrize("scene", [{}, TALL, WIDE, FAR], ids=["box", "tall", "wide", "far"])
def test_scales_are_equal(scene: dict[str, Any]) -> None:
    for made in (figure(task(**scene)), figure(strategy(task(**scene), 2))):
        wide, high = made.get_size_inches()
        for axes in made.axes:
            place = axes.get_position()
            (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
            across = place.width * wide / (right - left)
            assert across == pytest.approx(place.height * high / (top - bottom))


@pytest.mark.parametrize("ratio", [0.001, 0.1, 0.5, 1.0, 1.6, 3.0, 20.0, 1000.0])
@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6, 7, 8])
def test_rows_fit_on_a_page(ratio: float, count: int) -> None:
    layout = arrange((0.0, 0.0, ratio, 1.0), count, PictureOptions())
    assert layout.columns * layout.wide <= PAGE * 72 + 1
    rows = -(-count // layout.columns)
    assert (rows - 1) * layout.columns < count  # no empty row
    assert rows * layout.columns - count < rows  # nor holes in more than the last
    assert ratio / layout.unit <= layout.wide
    assert 1.0 / layout.unit <= layout.high


def test_the_user_has_the_last_word() -> None:
    given = strategy(task(), 4)
    assert len({round(axes.get_position().y0, 6) for axes in figure(given, columns=4).axes}) == 1
    assert len({round(axes.get_position().x0, 6) for axes in figure(given, columns=1).axes}) == 1
    made = figure(given, panel_width=5.0)
    wide = made.get_size_inches()[0]
    assert made.axes[0].get_position().width * wide == pytest.approx(5.0)
    plain = figure(given, legend=False, titles=False, ticks=False, names=False)
    assert not plain.legends
    assert not plain.texts
    for name, value in {"columns": 0, "dpi": 1e9, "panel_width": "wide", "legend": 1}.items():
        with pytest.raises(InputError, match=f"picture.{name}"):
            figure(given, **{name: value})  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        figure(given, colour="red")


def test_lines_of_text_are_no_wider_than_asked() -> None:
    text = r"aims at contact of length 2 in $\mathcal{P}_2$; stops when only $\mathcal{P}_2$ fits"
    lines = wrapped(text, 100.0, 8.5)
    assert len(lines) > 2
    assert " ".join(lines) == text
    assert all(sum(text_width(word, 8.5) for word in line.split()) <= 100 for line in lines)
    assert wrapped("", 100.0, 8.5) == []


@pytest.mark.parametrize("name", ["$5 & <a> 50% _x_ ^", "$x$", "名前", "a" * 100])
def test_names_may_be_anything(name: str) -> None:
    given = task(name=name)
    assert name.replace("$", r"\$") in words(figure(given))
    ET.fromstring(svg(given))


def unsolved() -> Strategy:
    return strategy(task(), 3, Status.UNSOLVABLE)


def test_legend_names_what_is_drawn_and_nothing_else() -> None:
    told = words(figure(unsolved()))
    assert "region found" in told
    assert "preimage" not in told
    assert "robot" not in told
    solved = words(figure(strategy(task(), 2)))
    assert "preimage" in solved
    assert "region found" not in solved
