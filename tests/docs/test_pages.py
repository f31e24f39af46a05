"""What the pages show is what comes out; their links and pictures are there."""

from __future__ import annotations

import doctest
import re
import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from preimage.cli.main import run

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted(DOCS.glob("*.md")),
    *sorted(DOCS.glob("reference/*.md")),
]
FLAGS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def blocks(page: Path, language: str) -> list[str]:
    """The fenced blocks of one language."""
    text = page.read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def commands(page: Path) -> Iterator[tuple[str, str]]:
    """What is typed, and what is to come out; nothing is said of it where nothing is shown."""
    for block in blocks(page, "console"):
        for one in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            typed, _, wanted = one.replace("\\\n", " ").partition("\n")
            yield typed, wanted


def with_sessions(language: str) -> list[Path]:
    mark = {"python": ">>>", "console": "$ "}[language]
    return [page for page in PAGES if any(mark in block for block in blocks(page, language))]


@pytest.fixture
def beside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def name_of(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", with_sessions("python"), ids=name_of)
def test_sessions_say_what_they_say(page: Path, beside: Path) -> None:
    provide(page, beside)
    session = "\n".join(block for block in blocks(page, "python") if ">>>" in block)
    test = doctest.DocTestParser().get_doctest(session, {}, page.name, str(page), 0)
    assert doctest.DocTestRunner(optionflags=FLAGS).run(test).failed == 0


@pytest.mark.parametrize("page", with_sessions("console"), ids=name_of)
def test_commands_print_what_they_print(
    page: Path, beside: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    provide(page, beside)
    for typed, wanted in commands(page):
        words = shlex.split(typed, comments=True)
        assert words[0] == "preimage", typed
        status = run(words[1:])
        said = capsys.readouterr()
        assert status in (0, 1), said.err
        if not wanted:
            continue
        example = doctest.Example(typed, wanted)
        checker = doctest.OutputChecker()
        assert checker.check_output(wanted, said.out + said.err, FLAGS), checker.output_difference(
            example, said.out + said.err, FLAGS
        )


def provide(page: Path, folder: Path) -> None:
    """The files that a page shows lie beside what it runs, and so do the examples."""
    (folder / "examples").symlink_to(ROOT / "examples")
    for shown in re.findall(r"{literalinclude} (\S+)", page.read_text(encoding="utf-8")):
        shutil.copy(page.parent / shown, folder)


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_and_pictures_are_there(page: Path) -> None:
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    made = {DOCS / "reference" / "commands.rst"}
    for link in re.findall(r"\]\(([^)\s#]*)[^)]*\)", text):
        target = (page.parent / link).resolve()
        assert link.startswith("http") or target.exists() or target in made, link


def test_readme_has_a_session_of_ten_lines(beside: Path) -> None:
    (session,) = blocks(ROOT / "README.md", "python")
    assert session.count(">>>") <= 10
