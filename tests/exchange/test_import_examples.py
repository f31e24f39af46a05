"""The drawings of examples/imports: each is imported, planned and drawn."""

import math
from pathlib import Path
from typing import Any

import pytest

from preimage.exchange.importing import import_task
from preimage.rendering import svg
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.goal import Goal
from preimage.task.initial import InitialPoint
from preimage.verification.verdict import Verdict
from preimage.verification.verify import verify

FOLDER = Path(__file__).parents[2] / "examples" / "imports"

CORNER = Goal(polygons=(((0.05, 0.05), (0.5, 0.05), (0.5, 0.5), (0.05, 0.5)),))

EXAMPLES: dict[str, dict[str, Any]] = {
    "map.yaml": {"initial": InitialPoint((0.5, 1.6)), "goal": CORNER, "robot_radius": 0.1},
    "peg.dxf": {"control": math.radians(3), "position": 1.0},
    "pit.geojson": {},
    "pit.wkt": {},
    "room.svg": {"units": "cm"},
}


def test_all_examples_are_tested() -> None:
    assert set(EXAMPLES) | {"map.pgm"} == {path.name for path in FOLDER.iterdir()}


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_is_planned(name: str) -> None:
    found = import_task(FOLDER / name, **EXAMPLES[name])
    strategy = plan(found.task)
    assert strategy.status is Status.SOLVED
    assert verify(strategy, runs=2).verdict is Verdict.PROVEN
    assert "<svg" in str(svg(found.task))
