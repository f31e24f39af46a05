"""Families of tasks that grow with a size `n`. Same size, same task."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import Any

Data = dict[str, Any]

_UNCERTAINTY: Data = {
    "control": 5,
    "position": 0.3,
    "force": {"angle": 10, "threshold": 0.05},
}


def saw_tooth(size: int) -> Data:
    """A floor with n notches like a saw's teeth, 2 wide and 1 deep; the goal is one's bottom."""
    points: list[list[float]] = [[-2, 0], [0, 0]]
    for tooth in range(size):
        points += [[2 * tooth + 1, -1], [2 * tooth + 2, 0]]
    points.append([2 * size + 2, 0])
    middle = 2 * (size // 2) + 1
    return {
        "version": 1,
        "window": [-10, -5, 2 * size + 10, 15],
        "obstacles": [{"chain": points, "solid": "right"}],
        "uncertainty": _UNCERTAINTY,
        "friction": 20,
        "initial": {"point": [middle, 2]},
        "goal": {"points": [[middle, -1]]},
        "planner": {"directions": 4},
    }


def comb(size: int) -> Data:
    """A floor with n slots, 2 wide and 3 deep, 2 apart; the goal is the bottom of one."""
    points: list[list[float]] = [[-3, 0]]
    for slot in range(size):
        left = 4 * slot - 1
        points += [[left, 0], [left, -3], [left + 2, -3], [left + 2, 0]]
    points.append([4 * size - 1, 0])
    middle = 4 * (size // 2)
    return {
        "version": 1,
        "window": [-10, -6, 4 * size + 6, 10],
        "obstacles": [{"chain": points, "solid": "right"}],
        "uncertainty": _UNCERTAINTY,
        "friction": 20,
        "initial": {"point": [middle - 3, 2.5]},
        "goal": {"edges": [[[middle - 1, -3], [middle + 1, -3]]]},
        "planner": {"directions": 4},
    }


def hall(size: int) -> Data:
    """A walled hall with n pillars of 4 to 7 corners; the goal is the lower end of a far wall."""
    generator = random.Random(size)
    columns = math.ceil(math.sqrt(size))
    rows = math.ceil(size / columns)
    pillars = []
    for pillar in range(size):
        row, column = divmod(pillar, columns)
        x = 10 * column + 7 + generator.uniform(-1, 1)
        y = 10 * row + 9 + generator.uniform(-1, 1)
        corners = generator.randint(4, 7)
        turn = generator.uniform(0, 2 * math.pi)
        polygon = []
        for corner in range(corners):
            # Spread unevenly, yet never by more than half a turn.
            at = turn + 2 * math.pi * (corner + generator.uniform(0, 0.5)) / corners
            reach = generator.uniform(1.5, 3)
            polygon.append([round(x + reach * math.cos(at), 6), round(y + reach * math.sin(at), 6)])
        pillars.append({"polygon": polygon})
    right, top = 10 * columns + 4, 10 * rows + 8
    return {
        "version": 1,
        "window": [0, 0, right, top],
        "walls": ["left", "right", "bottom", "top"],
        "obstacles": pillars,
        "uncertainty": _UNCERTAINTY,
        "friction": 20,
        "initial": {"point": [2, 2]},
        "goal": {"edges": [[[right, 0], [right, 4]]]},
        "planner": {"directions": 8},
    }


FAMILIES: dict[str, Callable[[int], Data]] = {"comb": comb, "hall": hall, "saw-tooth": saw_tooth}
