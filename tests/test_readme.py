"""The README's session runs, and its links lead somewhere."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]


def test_session_says_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    session = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(session) == 1
    monkeypatch.chdir(tmp_path)
    test = doctest.DocTestParser().get_doctest(session[0], {}, "README", "README.md", 0)
    assert len(test.examples) <= 10
    assert doctest.DocTestRunner().run(test).failed == 0
    assert {path.name for path in tmp_path.iterdir()} == {"peg-in-hole.json", "peg-in-hole.png"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
        assert link.startswith("http") or (page.parent / link).exists(), link
