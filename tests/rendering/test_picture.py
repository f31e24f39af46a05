"""Files and text."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from collections import Counter
from pathlib import Path

import matplotlib as mpl
import pytest

from preimage.errors import InputError, UnsupportedError
from preimage.rendering import Format, draw, figure, format_of, svg
from preimage.task import Task
from tests.rendering.drawn import preimage_of, strategy, task

STARTS = {Format.SVG: b"<?xml", Format.PNG: b"\x89PNG", Format.PDF: b"%PDF"}


@pytest.mark.parametrize("kind", Format)
def test_files_are_what_their_ending_says_and_always_the_same(kind: Format, tmp_path: Path) -> None:
    solved = strategy(task(), 2)
    contents = []
    for name in ("first", "second"):
        path = tmp_path / f"{name}.{kind.value.upper()}"
        draw(solved, path)
        contents.append(path.read_bytes())
    assert contents[0].startswith(STARTS[kind])
    assert contents[0] == contents[1]
    assert len(list(tmp_path.iterdir())) == 2


def test_the_same_bytes_in_another_process(tmp_path: Path) -> None:
    script = (
        "from preimage.rendering import svg; from preimage.task import named_task;"
        "import sys; sys.stdout.write(svg(named_task('peg-in-hole')))"
    )
    texts = set()
    for seed in ("0", "1"):
        environment = os.environ | {"PYTHONHASHSEED": seed, "MPLCONFIGDIR": str(tmp_path)}
        done = subprocess.run(
            [sys.executable, "-c", script], env=environment, capture_output=True, check=True
        )
        texts.add(done.stdout)
    assert len(texts) == 1


def test_svg_is_xml_with_a_group_for_each_layer() -> None:
    posed = task()
    for subject in (strategy(posed, 3), posed, preimage_of(posed)):
        root = ET.fromstring(svg(subject, task=posed))
        names = Counter(element.get("id") for element in root.iter() if element.get("id"))
        assert max(names.values()) == 1
        assert "legend" in names
        assert any(name and name.endswith("-goal") for name in names)
    names_of_strategy = {
        element.get("id") for element in ET.fromstring(svg(strategy(posed, 3))).iter()
    }
    assert {"motion-1", "motion-1-preimage-3", "motion-3-target", "motion-2-subgoal-1"} <= (
        names_of_strategy
    )


def test_pictures_have_titles_and_no_dates(tmp_path: Path) -> None:
    text = svg(task(name="a box"))
    assert "a box" in text
    assert "<dc:date>" not in text
    draw(task(), tmp_path / "a.pdf")
    assert b"/CreationDate" not in (tmp_path / "a.pdf").read_bytes()


@pytest.mark.parametrize("name", ["a", "a.jpg", "a.svg.gz", ".svg", "a."])
def test_other_endings_are_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"must end in \.svg, \.png or \.pdf"):
        draw(task(), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_file_is_written_whole_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.svg"
    path.write_text("before")

    def fail(*_: object) -> None:
        raise OSError("no space left")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(OSError, match="no space left"):
        draw(task(), path)
    assert path.read_text() == "before"
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.svg"]
    monkeypatch.undo()
    with pytest.raises(FileNotFoundError):
        draw(task(), tmp_path / "nowhere" / "a.svg")


def test_links_are_followed_and_kept(tmp_path: Path) -> None:
    target, link = tmp_path / "target.svg", tmp_path / "link.svg"
    target.write_text("before")
    link.symlink_to(target)
    draw(task(), link)
    assert link.is_symlink()
    assert target.read_bytes().startswith(b"<?xml")


def test_settings_of_the_user_neither_matter_nor_change() -> None:
    plain = svg(task())
    with mpl.rc_context({"font.size": 30, "axes.facecolor": "red", "svg.fonttype": "none"}):
        before = dict(mpl.rcParams)
        assert svg(task()) == plain
        assert dict(mpl.rcParams) == before


def test_nothing_is_shown_and_pyplot_is_not_loaded() -> None:
    script = (
        "import sys; from preimage.rendering import svg, format_of; from preimage.task import *;"
        "assert not any(name.startswith('matplotlib') for name in sys.modules);"
        "format_of('a.png'); svg(named_task('peg-in-hole'));"
        "assert 'matplotlib' in sys.modules and 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_without_matplotlib_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.style", None)
    with pytest.raises(UnsupportedError, match=r"preimage\[draw\]"):
        figure(task())
    assert format_of("a.png") is Format.PNG


def hall(side: int) -> Task:
    obstacles = [
        {"polygon": [[x, y], [x + 0.5, y + 0.1], [x + 0.6, y + 0.5], [x + 0.1, y + 0.4]]}
        for x in range(side)
        for y in range(side)
    ]
    return task(
        window=[-2, -2, side + 2, side + 2], walls=["bottom"], obstacles=obstacles,
        initial={"point": [-1, -1]}, goal={"edges": [[[-2, -2], [side + 2, -2]]]},
    )  # fmt: skip


def test_large_scenes_are_few_artists() -> None:
    small, large = (figure(hall(side)) for side in (3, 50))
    counts = [len(made.axes[0].get_children()) for made in (small, large)]
    assert max(counts) < 30


@pytest.mark.slow
def test_large_scenes_are_drawn_soon(tmp_path: Path) -> None:
    posed = hall(100)
    made = preimage_of(posed)
    began = time.perf_counter()
    draw(made, tmp_path / "a.png", task=posed, space=made.backprojection.space)
    assert time.perf_counter() - began < 20.0
