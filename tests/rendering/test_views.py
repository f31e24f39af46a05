"""Composed pictures: panels with chosen regions, letters and lines."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.text import Text

from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.region import Region
from preimage.errors import InputError
from preimage.rendering import draw, figure, svg
from preimage.rendering.style import REGIONS, Layer
from preimage.rendering.views import Line, Part, Place, View, Views
from tests.rendering.drawn import DOWN, artists, measure, preimage_of, task, words


def drawn_in(views: Views, place: int = 0) -> dict[str, Artist]:
    return artists(figure(views), f"view-{place + 1}")


def letters(made: Figure) -> dict[str, tuple[float, float]]:
    """Where the letters of the first panel stand."""
    texts = (artist for artist in made.axes[0].get_children() if isinstance(artist, Text))
    return {text.get_text(): text.get_position() for text in texts}


def test_regions_are_drawn_in_their_layers() -> None:
    posed = task()
    made = preimage_of(posed)
    parts = (
        Part(Layer.PREIMAGE, made.region, "$P$", made.target.kernel.area),
        Part(Layer.STOPS, made.goal),
    )
    panel = drawn_in(Views((View(task=posed, parts=parts),)))
    assert measure(panel["preimage"]) == pytest.approx(made.region.area.measure)
    assert measure(panel["stops"]) == pytest.approx(made.goal.area.measure)
    assert {"goal", "c-obstacle"} <= panel.keys()
    assert "start-point" not in panel


@pytest.mark.parametrize("goal", [True, False])
@pytest.mark.parametrize("start", [True, False])
def test_goal_and_start_are_drawn_if_they_should_be(goal: bool, start: bool) -> None:
    panel = drawn_in(Views((View(task=task(), goal=goal, start=start),)))
    assert ("goal" in panel) == goal
    assert ("start-point" in panel) == start


def test_panels_may_show_different_spaces() -> None:
    first, second = task(), task(obstacles=[{"polygon": [[-4, -3], [4, -3], [4, 0], [-4, 0]]}])
    space = configuration_space(second)
    goal = goal_region(second, space)
    on_goal = Region(Region.empty().area, goal.contact)
    views = Views((View(task=first), View(task=second, parts=(Part(Layer.TARGET, on_goal),))))
    sizes = [measure(drawn_in(views, place)["c-obstacle"]) for place in (0, 1)]
    assert sizes[0] > sizes[1] == pytest.approx(24.0)
    lines = drawn_in(views, 1)["target-contact"]
    assert isinstance(lines, LineCollection)
    ends = np.array(lines.get_segments()).reshape(-1, 2)
    assert ends[:, 0].min() == pytest.approx(-3.0, abs=0.1)  # of the second's edges
    assert ends[:, 0].max() == pytest.approx(3.0, abs=0.1)


def test_the_robot_stands_among_another_spaces_obstacles() -> None:
    posed = task(robot={"polygon": [[-1, 0], [1, 0], [0, 2]], "reference": [0, 0]})
    workspace = configuration_space(replace(posed, robot=task().robot))
    views = Views((View(task=posed, space=workspace, start=True),))
    panel = drawn_in(views)
    assert measure(panel["c-obstacle"]) == pytest.approx(measure(panel["obstacle"]))
    assert "robot" in panel


def test_lines_have_names_and_heads() -> None:
    way = Line(np.array([(-9.0, 5.0), (0.0, 5.0), (0.0, 5.001)]), "$v$", Layer.RUN, True)
    ray = Line(np.array([(-9.0, 6.0), (0.0, 6.0)]))
    thin = Line(np.array([(-9.0, 7.0), (0.0, 7.0)]), layer=Layer.NAME)
    made = figure(Views((View(task=task(), lines=(way, ray, thin)),)))
    panel = artists(made, "view-1")
    head = panel["run-head"]
    assert isinstance(head, Polygon)
    tip = head.get_xy()[np.argmax(head.get_xy()[:, 0])]
    assert tip == pytest.approx((0.0, 5.001), abs=0.02)
    assert {"run", "ray", "name-line"} <= panel.keys()
    assert "$v$" in letters(made)


def test_a_line_too_short_for_a_head_has_none() -> None:
    dot = Line(np.array([(0.0, 5.0), (0.0, 5.0)]), layer=Layer.RUN, arrow=True)
    assert "run-head" not in drawn_in(Views((View(task=task(), lines=(dot,)),)))


def test_a_letter_stands_beside_its_dot_or_alone_where_it_should() -> None:
    places = (Place((-6.0, 4.0), "$X$"), Place((6.0, 4.0), "$B$", Layer.NAME))
    made = figure(Views((View(task=task(), places=places),)))
    texts = letters(made)
    assert texts["$B$"] == (6.0, 4.0)
    assert 0.1 < math.dist(texts["$X$"], (-6.0, 4.0)) < 3.0
    assert sum(name.startswith("name-place") for name in artists(made, "view-1")) == 1


def test_names_can_be_left_out() -> None:
    views = Views((View(task=task(), places=(Place((-6.0, 4.0), "$X$"),), start=True),))
    assert "$X$" in letters(figure(views))
    assert "$X$" not in letters(figure(views, names=False))


def test_the_legend_has_the_given_words_and_the_bounds_of_a_command() -> None:
    made = preimage_of(task())
    view = View(task=task(), parts=(Part(Layer.PREIMAGE, made.region),), direction=DOWN)
    found = words(figure(Views((view,), "Title", {Layer.PREIMAGE: "what is safe"}, True)))
    for one in ("Title", "what is safe", "direction ± 12°", "friction ± 20°"):
        assert one in found
    assert "friction ± 20°" not in words(figure(Views((view,))))


def test_the_same_views_give_the_same_bytes(tmp_path: Path) -> None:
    views = Views((View(task=task(), start=True), View(task=task(), heading="b")))
    assert svg(views) == svg(views)
    ET.fromstring(svg(views))
    draw(views, tmp_path / "views.png", dpi=50)
    first = (tmp_path / "views.png").read_bytes()
    draw(views, tmp_path / "views.png", dpi=50)
    assert (tmp_path / "views.png").read_bytes() == first


@pytest.mark.parametrize("layer", [layer for layer in Layer if layer not in REGIONS])
def test_no_region_in_a_layer_of_something_else(layer: Layer) -> None:
    with pytest.raises(InputError, match="must be that of a region"):
        Part(layer, Region.empty())


@pytest.mark.parametrize(
    "points",
    [
        [],
        [[0.0, 0.0]],
        [[0.0, 0.0, 0.0]] * 2,
        [[0.0, 0.0], [math.nan, 0.0]],
        [[0, 0], [math.inf, 0]],
    ],
)
def test_no_line_of_less_than_two_places(points: list[list[float]]) -> None:
    with pytest.raises(InputError, match=r"view\.points"):
        Line(np.array(points))


@pytest.mark.parametrize("at", [(math.nan, 0.0), (0.0, math.inf), (0.0,), (0.0, 0.0, 0.0)])
def test_no_place_that_is_nowhere(at: tuple[float, float]) -> None:
    with pytest.raises(InputError, match=r"view\.place"):
        Place(at)


def test_options_add_what_they_add_elsewhere() -> None:
    made = preimage_of(task())
    views = Views((View(task=task(), parts=(Part(Layer.TARGET, made.target.region),)),))
    plain = artists(figure(views), "view-1")
    more = artists(figure(views, edge_numbers=True, friction_cones=True), "view-1")
    added = set(more) - set(plain)
    assert any(name.startswith("edge-number") for name in added)
    assert any(name.startswith("friction-cone") for name in added)


def test_no_picture_of_nothing() -> None:
    with pytest.raises(InputError, match="no view"):
        Views(())
