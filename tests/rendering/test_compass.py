"""Roses in pictures: what is drawn for which arcs."""

import math
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Wedge

from preimage.geometry.angles import TAU
from preimage.rendering.picture import draw, figure, svg
from preimage.search.compass import Compass, Rose
from preimage.search.directions import Arc, Verdict
from preimage.task.examples import named_task

TASK = named_task("peg-in-hole")
ALL = Arc(0.0, TAU, Verdict.SOLVES)
NONE = Arc(0.0, TAU, Verdict.FAILS)
MIXED = (
    Arc(0.5, 1.0, Verdict.SOLVES),
    Arc(1.0, 2.0, Verdict.UNPROVEN),
    Arc(2.0, 0.5 + TAU, Verdict.FAILS),
)


def compass(*roses: Rose, grid: tuple[Rose, ...] = ()) -> Compass:
    from preimage.configuration.obstacles import configuration_space

    return Compass(TASK, configuration_space(TASK), roses, grid)


def labelled(made: Figure, label: str) -> list[object]:
    return [artist for artist in made.axes[0].get_children() if artist.get_label() == label]


def test_sectors_are_the_arcs() -> None:
    made = figure(compass(Rose((-4.0, 2.5), MIXED)))
    (sector,) = labelled(made, "solves-0")
    assert isinstance(sector, Wedge)
    assert sector.theta1 == pytest.approx(math.degrees(0.5))
    assert sector.theta2 == pytest.approx(math.degrees(1.0))
    assert len(labelled(made, "unproven-0")) == 1
    assert len(labelled(made, "solves-widest")) == 1
    words = [text.get_text() for text in made.findobj() if hasattr(text, "get_text")]
    assert "directions that solve" in words
    assert "directions not proven" in words


def test_all_and_nothing() -> None:
    made = figure(compass(Rose((-4.0, 2.5), (ALL,))))
    (sector,) = labelled(made, "solves-0")
    assert isinstance(sector, Wedge)
    assert sector.theta2 - sector.theta1 == pytest.approx(360.0)
    made = figure(compass(Rose((-4.0, 2.5), (NONE,))))
    (dot,) = labelled(made, "rose-0-none")
    assert isinstance(dot, Circle)
    assert not labelled(made, "solves-0")


def test_narrow_arcs_are_lines() -> None:
    lone = (Arc(0.0, 1.0, Verdict.UNPROVEN), Arc(1.0, 1.0, Verdict.SOLVES),
            Arc(1.0, TAU, Verdict.UNPROVEN))  # fmt: skip
    made = figure(compass(Rose((-4.0, 2.5), lone)))
    assert len(labelled(made, "solves-0-line")) == 1


def test_roses_of_a_grid_do_not_touch() -> None:
    grid = tuple(Rose((float(x), 8.0), (ALL,)) for x in range(-3, 4))
    made = figure(compass(Rose((-4.0, 2.5), MIXED), grid=grid))
    discs = [one for number in range(7) for one in labelled(made, f"rose-{number}-ground")]
    assert len(discs) == 7
    assert all(isinstance(disc, Circle) and disc.get_radius() < 0.5 for disc in discs)


def test_roses_behind_one_that_matters_are_left_out() -> None:
    made = figure(compass(Rose((0.0, 4.0), MIXED), grid=(Rose((0.1, 4.0), (ALL,)),)))
    assert not labelled(made, "rose-0-ground")


def test_several_are_named(tmp_path: Path) -> None:
    both = compass(Rose((-4.0, 2.5), MIXED), Rose((4.0, 5.0), MIXED))
    words = [text.get_text() for text in figure(both).axes[0].texts]
    assert any("±" in word for word in words)
    assert svg(both) == svg(both)
    draw(both, tmp_path / "roses.png")
    assert (tmp_path / "roses.png").stat().st_size > 1000
