"""The scripts that make the tables run, with few runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mujoco")

EXAMPLES = Path(__file__).parents[2] / "examples"


def printed(script: str, *arguments: str) -> str:
    command = [sys.executable, str(EXAMPLES / script), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_success() -> None:
    text = printed(
        "physics/success.py", "--runs", "2", "--tasks", "peg-in-hole", "--stressed", "example-1"
    )
    assert "| peg-in-hole | 2 | 100 % | – |" in text
    assert "| as above | 100 % |" in text


def test_what_it_costs() -> None:
    pytest.importorskip("ompl")
    script = "uncertainty/what_it_costs.py"
    text = printed(script, "--runs", "1", "--positions", "0.6", "inf", "--tasks")
    rows = [line for line in text.splitlines() if line.startswith("| ")]
    assert [row.split(" | ")[0] for row in rows] == [
        "| ρ",
        "| 0.6, offset",
        "| no sensor",
        "| 0.6, independent",
    ]
    assert all(row.endswith("| 100 |") for row in rows if "plan" not in row)


def test_pictures(tmp_path: Path) -> None:
    pytest.importorskip("PIL")
    command = [sys.executable, str(EXAMPLES / "physics" / "pictures.py")]
    command += ["--frames", "3", "--folder", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode and ("OpenGL" in done.stderr or "EGL" in done.stderr):
        pytest.skip("nothing to draw with: no OpenGL without a screen")
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "peg-in-hole-mujoco.gif",
        "peg-in-hole-mujoco.png",
    ]
