from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from preimage.analysis.cell import Answer, Cell
from preimage.analysis.grid import NONE, UNKNOWN
from preimage.analysis.map import ErrorMap, error_map
from preimage.analysis.survey import Survey
from preimage.errors import InputError
from preimage.task.examples import named_task
from preimage.task.options import Method

MAPS = [
    ("flat-floor", "control", "position", (9, 8)),
    ("peg-in-hole", "control", "position", (8, 8)),
    ("cradle", "position", "force", (6, 4)),
    ("landmark-edge", "friction", "control", (5, 7)),
]


def mapped(name: str, x: str, y: str, places: tuple[int, int], most: int) -> ErrorMap:
    task = named_task(name)
    task = replace(task, options=replace(task.options, max_steps=most))
    return error_map(Survey.of(task), x, y, places=places, ranges=RANGES.get(name))


RANGES = {
    "flat-floor": {"control": (0.0, 40.0), "position": (0.0, 2.0)},
    "landmark-edge": {"friction": (0.0, 80.0), "control": (0.0, 20.0)},
}


@pytest.mark.parametrize(("name", "x", "y", "places"), MAPS)
def test_a_map_equals_the_full_grid(name: str, x: str, y: str, places: tuple[int, int]) -> None:
    found = mapped(name, x, y, places, 3)
    assert found.looked_at < found.size
    task = named_task(name)
    survey = Survey.of(replace(task, options=replace(task.options, max_steps=3)))
    for layer in found.layers:
        for i in range(places[0]):
            for j in range(places[1]):
                if layer.looked_at[i, j]:
                    continue
                keys = {found.x.key: found.x.value(i), found.y.key: found.y.value(j)}
                cell = Cell.at(layer.method, **keys)
                outcome = survey.ask([cell])[cell]
                assert outcome.answer is not Answer.REFUSED
                expected = NONE if outcome.motions is None else outcome.motions
                assert layer.motions[i, j] == expected


def test_the_map_of_a_kernel_on_a_floor_has_a_closed_form() -> None:
    # 5 tan theta <= 2 - 2 rho, from (0, 5) onto [-2, 2]
    task = named_task("flat-floor")
    options = replace(task.options, max_steps=1, directions=(np.radians(270.0),))
    ranges = {"control": (0.0, 25.0), "position": (0.0, 1.2)}
    found = error_map(
        Survey.of(replace(task, options=options)), "control", "position", places=(26, 25),
        ranges=ranges, methods=[Method.KERNEL],
    )  # fmt: skip
    theta, rho = np.meshgrid(found.x.values, found.y.values, indexing="ij")
    room = 2.0 - 2.0 * rho - 5.0 * np.tan(np.radians(theta))
    clear = np.abs(room) > 1e-9
    assert np.array_equal(found.motions[clear] == 1, room[clear] > 0.0)
    assert found.looked_at < found.size / 3


def test_the_plainest_method_is_the_first_that_needs_no_more_motions() -> None:
    found = mapped("peg-in-hole", "control", "position", (6, 6), 4)
    best = found.motions
    for i in range(6):
        for j in range(6):
            needed = [int(layer.motions[i, j]) for layer in found.layers]
            assert best[i, j] == min(needed)
            if best[i, j] == NONE:
                assert found.plainest[i, j] == -1
            else:
                assert found.plainest[i, j] == needed.index(min(needed))
    assert set(np.unique(found.plainest)) >= {-1}


def test_what_had_no_answer_is_unknown() -> None:
    task = named_task("peg-in-hole")
    task = replace(task, options=replace(task.options, time_limit=1e-9))
    found = error_map(
        Survey.of(task), "control", "position", places=(2, 3), methods=[Method.KERNEL],
        ranges={"control": (1.0, 2.0), "position": (0.1, 0.2)},
    )  # fmt: skip
    assert np.all(found.motions == UNKNOWN)
    assert np.all(found.plainest == -1)
    assert found.given.answer is Answer.STOPPED


@pytest.mark.parametrize(
    ("x", "y", "places", "rule"),
    [
        ("control", "control", (3, 3), "differ"),
        ("control", "positon", (3, 3), "position"),
        ("control", "position", (1, 3), "2 to 1000"),
        ("control", "position", (3, 10**7), "2 to 1000"),
    ],
)
def test_what_is_no_map_is_refused(x: str, y: str, places: tuple[int, int], rule: str) -> None:
    with pytest.raises(InputError, match=rule):
        error_map(Survey.of(named_task("flat-floor")), x, y, places=places)
