"""Starts on the border of a preimage: a line along which nature may lead astray."""

from __future__ import annotations

from typing import Any

import pytest

from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.parse import parse_task


@pytest.mark.parametrize("method", ["sticking", "kernel", "combined"])
@pytest.mark.parametrize(("height", "solved"), [(0.0, False), (1e-9, False), (1e-3, True)])
def test_a_start_level_with_a_tip_is_not_solved(method: str, height: float, solved: bool) -> None:
    """Perfect control to the left: the robot may hit the tip at (0, 0), whose side holds it."""
    document: dict[str, Any] = {
        "version": 1,
        "window": [-6, -6, 6, 6],
        "walls": ["left", "bottom", "top"],
        "obstacles": [
            {"polygon": [[-9, -9], [0, -9], [0, 0], [-9, 0]]},
            {"polygon": [[2, -3], [9, -3], [9, 3], [2, 3], [3, 0]]},
            {"polygon": [[-6, -1], [-4, -1], [-4, 7], [-6, 7]]},
        ],
        "uncertainty": {
            "control": 0,
            "position": 0.01,
            "force": {"angle": 10, "threshold": 0.05},
        },
        "friction": 45,
        "initial": {"point": [2, height]},
        "goal": {"edges": [[[-4, 0], [-4, 6]]]},
        "planner": {"directions": [180], "max_steps": 1, "method": method},
    }
    assert (plan(parse_task(document)).status is Status.SOLVED) == solved
