"""The pictures of all figures, their page, and the script that makes them."""

from __future__ import annotations

import doctest
import re
import runpy
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from examples import small_picture
from examples.figures import redrawn
from examples.figures.book import FIGURES, HEAD, picture_of, section
from examples.gallery import make
from examples.small_picture import LARGEST, smaller
from preimage.rendering import svg
from tests.figures.drawn import figure

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "figures.md"


def test_there_are_twenty() -> None:
    assert list(FIGURES) == list(range(1, 21))
    assert [figure(number).number for number in FIGURES] == list(FIGURES)


@pytest.mark.parametrize("number", FIGURES)
def test_a_picture_is_small_and_has_a_panel_for_each_view(number: int, tmp_path: Path) -> None:
    made = figure(number)
    path = picture_of(made, tmp_path)
    assert path.suffix == ".svg"
    assert path.stat().st_size <= LARGEST
    ids = {node.get("id", "") for node in ET.parse(path).iter()}
    panels = {name for name in ids if re.fullmatch(r"view-\d+", name)}
    assert panels == {f"view-{place + 1}" for place in range(len(made.views.views))}
    for place, view in enumerate(made.views.views):
        drawn = {name for name in ids if name.startswith(f"view-{place + 1}-")}
        for part in (part for part in view.parts if not part.region.is_empty):
            assert any(part.layer.value in name for name in drawn)
    assert [path.name for path in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("number", [5, 17])
def test_the_same_figure_gives_the_same_bytes(number: int, tmp_path: Path) -> None:
    written = [picture_of(make, tmp_path).read_bytes() for make in (
        figure(number), FIGURES[number](),
    )]  # fmt: skip
    assert written[0] == written[1]


def test_a_smaller_picture_is_the_same_picture() -> None:
    whole = svg(figure(7).views)
    less = smaller(whole)
    assert len(less) < 0.6 * len(whole)
    before, after = ET.fromstring(whole), ET.fromstring(less)
    assert [node.tag for node in before.iter()] == [node.tag for node in after.iter()]
    for old, new in zip(before.iter(), after.iter(), strict=True):
        assert old.get("transform") == new.get("transform")
        numbers = [re.findall(r"-?\d+(?:\.\d+)?", node.get("d", "")) for node in (old, new)]
        if len(numbers[0]) == len(numbers[1]):  # no dots of a hatch
            pairs = np.array(numbers, dtype=float)
            assert np.all(np.abs(pairs[0] - pairs[1]) <= 0.0051)


def test_the_page_is_what_the_figures_say() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert text.startswith(HEAD)
    for number in FIGURES:
        assert section(figure(number), f"images/figures/figure-{number:02d}.svg") in text
        assert (PAGE.parent / f"images/figures/figure-{number:02d}.svg").exists()
    for link in re.findall(r"\]\(([^)]+)\)", text):
        assert (PAGE.parent / link).exists()


def test_the_script_draws_what_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    before = PAGE.read_bytes()
    monkeypatch.setattr(sys, "argv", ["figures", "8", "1", "-o", str(tmp_path)])
    monkeypatch.setattr(sys, "path", list(sys.path))
    runpy.run_path(str(ROOT / "examples" / "figures"), run_name="__main__")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["figure-01.svg", "figure-08.svg"]
    assert "figure-08.svg" in capsys.readouterr().out
    assert PAGE.read_bytes() == before


def test_the_script_refuses_other_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["figures", "21"])
    monkeypatch.setattr(sys, "path", list(sys.path))
    with pytest.raises(SystemExit) as stopped:
        runpy.run_path(str(ROOT / "examples" / "figures"), run_name="__main__")
    assert stopped.value.code == 2


@pytest.mark.parametrize("module", [redrawn, small_picture, make])
def test_examples_in_docstrings(module: ModuleType) -> None:
    found = doctest.testmod(module)
    assert found.attempted
    assert not found.failed
