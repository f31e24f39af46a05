"""`preimage export`."""

from __future__ import annotations

from pathlib import Path

import pytest

from preimage.cli.main import run


def test_plans_are_exported_and_refusals_are_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["plan", "--example", "peg-in-hole", "-o", "plan.json"]) == 0
    for name in ("plan.py", "plan.xml", "plan.txt"):
        assert run(["export", "plan.json", "-o", name]) == 0
        assert Path(name).exists()
    capsys.readouterr()
    assert run(["export", "plan.json", "-o", "plan.doc"]) == 2
    assert run(["export", "plan.json", "-o", "nowhere/plan.py"]) == 2
    assert run(["export", "missing.json", "-o", "plan.py"]) == 2
    run(["plan", "--example", "peg-in-hole", "--max-steps", "1", "-o", "none.json"])
    capsys.readouterr()
    assert run(["export", "none.json", "-o", "none.py"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "only a solved" in said
    assert not Path("none.py").exists()
