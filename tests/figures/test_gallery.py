"""The gallery: every named task is there, with its pictures and what other pages say of it."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from examples.gallery import make
from preimage import named_task, named_tasks
from preimage.task import task_families

TEXT = make.PAGE.read_text(encoding="utf-8")
SECTIONS = make.sections(TEXT)


def rows(text: str) -> list[list[str]]:
    """The tables in a text, row by row."""
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line.strip("| ").split(" | ")] for line in lines]


def test_every_named_task_is_there_in_order() -> None:
    assert tuple(SECTIONS) == make.names()
    assert set(named_tasks()) < set(SECTIONS)
    families = {name.rpartition("-")[0] for name in make.names() if name not in named_tasks()}
    assert families == set(task_families())
    assert TEXT.startswith(make.HEAD)


@pytest.mark.parametrize("name", make.names())
def test_a_section_has_its_pictures_and_its_code(name: str) -> None:
    section = SECTIONS[name]
    assert make.what(name) in section
    pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", section)
    assert [Path(one).stem for one in pictures] == [name, name]
    assert Path(pictures[0]).suffix in (".svg", ".png")
    assert Path(pictures[1]).suffix == ".gif"
    for one in pictures:
        assert 5_000 < (make.DOCS / one).stat().st_size < 500_000
    assert (make.DOCS / pictures[1]).stat().st_size < 300_000
    assert f'plan(named_task("{name}"))' in section


def test_nothing_lies_about_and_all_of_it_is_small() -> None:
    files = list(make.FOLDER.iterdir())
    assert len(files) == 2 * len(make.names())
    assert sum(path.stat().st_size for path in files) < 10_000_000


def test_its_tables_are_those_of_the_page_with_the_times() -> None:
    other = {
        row[0].strip("`"): row[1:]
        for row in rows((make.DOCS / "named-tasks.md").read_text(encoding="utf-8"))
    }
    both = [name for name in named_tasks() if name in other]  # a task may be newer than that page
    assert len(both) > 25
    for name in both:
        motions, regions = rows(SECTIONS[name])[-2:]
        assert motions[1:] == other[name][0::3]
        assert regions[1:] == other[name][1::3]


@pytest.mark.parametrize("name", ["blind-corner", "between-posts", "saw-tooth-3"])
def test_a_section_comes_out_again(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(make, "FOLDER", tmp_path)
    assert make.section(name) == SECTIONS[name]
    written = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert len(written) == 2
    make.section(name)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == written


@pytest.mark.slow
@pytest.mark.parametrize("name", make.names())
def test_every_table_comes_out_again(name: str) -> None:
    assert make.table(named_task(name)) in SECTIONS[name]


def test_tasks_are_replaced_one_by_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "gallery.md"
    monkeypatch.setattr(make, "FOLDER", tmp_path / "images")
    monkeypatch.setattr(make, "PAGE", page)
    monkeypatch.setattr(sys, "path", list(sys.path))
    old = "## flat-floor\n\nold\n\n## comb-4\n\nkept\n\n## gone\n\nnot kept\n"
    page.write_text(f"{make.HEAD}\n{old}", encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["make.py", "flat-floor", "blind-corner"])
    make.main()
    found = make.sections(page.read_text(encoding="utf-8"))
    assert list(found) == ["blind-corner", "flat-floor", "comb-4"]
    assert found["flat-floor"] == SECTIONS["flat-floor"]
    assert found["comb-4"] == "## comb-4\n\nkept\n"
    assert len(capsys.readouterr().out.splitlines()) == 2


def test_unknown_names_are_refused(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["make.py", "flat-flour"])
    monkeypatch.setattr(sys, "path", list(sys.path))
    with pytest.raises(SystemExit) as stopped:
        make.main()
    assert stopped.value.code == 2
    assert "flat-flour" in capsys.readouterr().err
