from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.analysis.grid import NONE, UNKNOWN, Grid
from preimage.task.options import Method
from tests.analysis.questions import answered, axis

Frontier = list[tuple[int, int]]


def needed(corners: Frontier, i: int, j: int) -> int | None:
    """How many of the corners lie below and before a place; none from three on."""
    count = sum(a <= i and b <= j for a, b in corners)
    return count + 1 if count < 3 else None


SIZES = st.integers(1, 24)
CORNERS = st.lists(st.tuples(st.integers(0, 24), st.integers(0, 24)), max_size=6)


def whole(grid: Grid, corners: Frontier) -> np.ndarray[tuple[int, ...], np.dtype[np.int16]]:
    rows = [
        [needed(corners, i, j) or NONE for j in range(grid.y.steps + 1)]
        for i in range(grid.x.steps + 1)
    ]
    return np.array(rows, dtype=np.int16)


@given(corners=CORNERS, nx=SIZES, ny=SIZES)
def test_a_grid_of_monotone_axes_equals_the_full_one(corners: Frontier, nx: int, ny: int) -> None:
    grid = Grid(axis("x", nx), axis("y", ny), Method.KERNEL)

    def motions(values: Mapping[str, float]) -> int | None:
        return needed(corners, round(values["x"] / 0.5), round(values["y"] / 0.5))

    asked = answered(grid, motions)
    assert asked <= (nx + 1) * (ny + 1)
    assert np.array_equal(grid.motions, whole(grid, corners))


@pytest.mark.parametrize("monotone", [(True, False), (False, True), (False, False)])
@given(data=st.data())
def test_along_what_is_not_monotone_nothing_is_inferred(
    monotone: tuple[bool, bool], data: st.DataObject
) -> None:
    nx, ny = data.draw(SIZES), data.draw(SIZES)
    if monotone == (True, False):
        limits = data.draw(st.lists(st.integers(0, 25), min_size=ny + 1, max_size=ny + 1))
    else:
        limits = data.draw(st.lists(st.integers(0, 25), min_size=nx + 1, max_size=nx + 1))
    grid = Grid(axis("x", nx, monotone[0]), axis("y", ny, monotone[1]), Method.KERNEL)

    def motions(values: Mapping[str, float]) -> int | None:
        i, j = round(values["x"] / 0.5), round(values["y"] / 0.5)
        reached = i < limits[j] if monotone == (True, False) else j < limits[i]
        return 2 if reached else None

    answered(grid, motions)
    for i in range(nx + 1):
        for j in range(ny + 1):
            found = motions({"x": 0.5 * i, "y": 0.5 * j})
            assert grid.motions[i, j] == (NONE if found is None else found)
    if not any(monotone):
        assert len(grid.outcomes) == grid.low.size


def test_a_frontier_is_found_with_few_questions() -> None:
    size = 127
    grid = Grid(axis("x", size), axis("y", size), Method.KERNEL)
    asked = answered(grid, lambda v: 1 if v["x"] ** 2 + v["y"] ** 2 < 40.0**2 else None)
    assert asked < 4 * size


def test_a_cell_without_an_answer_says_nothing_of_others() -> None:
    grid = Grid(axis("x", 4), axis("y", 4), Method.KERNEL)
    late = grid.cell_of(4, 4)
    while cells := grid.wanted():
        for cell in cells:
            stopped = Outcome(Answer.STOPPED, None, "the time limit of 1 s came first")
            grid.learn(cell, stopped if cell == late else Outcome(Answer.SOLVED, 1))
    assert grid.motions[4, 4] == UNKNOWN
    assert np.count_nonzero(grid.motions == UNKNOWN) == 1
    assert np.count_nonzero(grid.motions == 1) == 24


def test_cells_have_the_values_of_the_axes() -> None:
    grid = Grid(axis("x", 3), axis("y", 2), Method.STICKING)
    assert grid.cell_of(2, 1) == Cell.at(Method.STICKING, x=1.0, y=0.5)
