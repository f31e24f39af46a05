"""Tasks that once failed, each named after how."""

from __future__ import annotations

from pathlib import Path

import pytest

from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.files import load_task

TASKS = sorted(Path(__file__).parent.glob("*.yaml"))


@pytest.mark.parametrize("path", TASKS, ids=lambda path: path.stem)
def test_task_that_once_failed_is_planned(path: Path) -> None:
    assert plan(load_task(path)).status is Status.SOLVED
