"""Maps of two bounds: where there is a plan, of how many motions, by which method."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from preimage.analysis.axis import Axis, Range, axis_of
from preimage.analysis.cell import Answer, Cell, Outcome
from preimage.analysis.grid import NONE, UNKNOWN, Grid, Ints
from preimage.analysis.ladder import Ladder
from preimage.analysis.survey import Survey
from preimage.display import Shown
from preimage.errors import InputError
from preimage.task.options import Method

PLACES = (40, 40)
"""Values of each axis."""

MOST_PLACES = 1_000
"""Values of an axis at most."""

ROUGH = 50.0
"""To frame a map, limits are looked for to this part of the range that makes a difference."""

AROUND = 1.25
"""A map reaches so much further than the given value and the limit of the axis."""


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """What one method can do.

    Parameters
    ----------
    motions : (nx, ny), how many motions the plan has; `NONE` without a plan, `UNKNOWN` where a
        limit of time came first or there is no such task.
    looked_at : (nx, ny), where the planner was asked; elsewhere the answer follows.
    """

    method: Method
    motions: Ints
    looked_at: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class ErrorMap(Shown):
    """The answers over two axes.

    Parameters
    ----------
    name : of the task.
    layers : one for each method that was asked for, the plainest method first.
    given : the answer for the task as it is, by the last method.
    """

    name: str
    x: Axis
    y: Axis
    layers: tuple[Layer, ...]
    given: Outcome

    @property
    def motions(self) -> Ints:
        """(nx, ny), the fewest motions of any method."""
        known = np.stack([layer.motions for layer in self.layers])
        best = np.where(known == UNKNOWN, NONE, known).min(axis=0)
        return np.where((best == NONE) & (known == UNKNOWN).any(axis=0), UNKNOWN, best)

    @property
    def plainest(self) -> Ints:
        """(nx, ny), the first layer that needs no more motions than any; -1 without a plan."""
        best = self.motions
        found = np.full(best.shape, -1, dtype=np.int16)
        for index in reversed(range(len(self.layers))):
            found[(self.layers[index].motions == best) & (best >= 0) & (best != NONE)] = index
        return found

    @property
    def looked_at(self) -> int:
        """How often the planner was asked."""
        return int(sum(np.count_nonzero(layer.looked_at) for layer in self.layers))

    @property
    def size(self) -> int:
        """How often it would have been asked cell by cell."""
        return int(sum(layer.motions.size for layer in self.layers))


def error_map(
    survey: Survey,
    x: str,
    y: str,
    *,
    places: tuple[int, int] = PLACES,
    ranges: Mapping[str, Range] | None = None,
    methods: Sequence[Method] = tuple(Method),
) -> ErrorMap:
    """The answers over two axes, ends of the ranges included.

    The frontiers are found by bisection: where an axis is monotone, what lies between two cells
    with the same answer is not looked at (see `Grid`).

    Parameters
    ----------
    x, y : words of `Bound`, or names of parameters; two that differ.
    places : how many values each has.
    ranges : by bound, in the file's unit; by default a little beyond the given value, and beyond
        the limit of each axis by itself.
    methods : which are compared.

    Raises
    ------
    InputError : a bound that the task has not, or a range that makes no sense.
    CancelledError : somebody wants no more.
    """
    ranges = dict(ranges or {})
    if x == y:
        raise InputError("map", f"needs two bounds that differ, not {x} twice")
    if stray := [name for name in ranges if name not in (x, y)]:
        raise InputError(stray[0], "has a range, but is not on the map")
    for count in places:
        if not 2 <= count <= MOST_PLACES:
            raise InputError("resolution", f"must be 2 to {MOST_PLACES} each way, not {count}")
    for name in (x, y):  # refused before anything takes time
        axis_of(survey.template, name, ranges.get(name))
    as_given = Cell.at(methods[-1])
    given = survey.ask([as_given])[as_given]
    for name in (x, y):
        if name not in ranges:
            ranges[name] = _framed(survey, name, methods[-1])
    axes = [
        axis_of(survey.template, name, ranges[name], places=count)
        for name, count in zip((x, y), places, strict=True)
    ]
    grids = [Grid(axes[0], axes[1], method) for method in methods]
    survey.settle(grids)
    layers = tuple(Layer(grid.method, grid.motions, _looked_at(grid)) for grid in grids)
    return ErrorMap(survey.template.task().name, axes[0], axes[1], layers, given)


def _framed(survey: Survey, name: str, method: Method) -> Range:
    """A range that shows the given value and the limit."""
    whole = axis_of(survey.template, name)
    if not whole.monotone:
        return whole.low, whole.high
    rough = axis_of(
        survey.template, name, resolution=min(whole.step * 16, (whole.high - whole.low) / ROUGH)
    )
    ladder = Ladder(rough, method)
    survey.settle([ladder])
    solved = [high for _, high, outcome in ladder.stretches if outcome.answer is Answer.SOLVED]
    ends = [rough.value(place) for place in solved]
    if whole.given < np.inf:
        ends.append(whole.given)
    widest = max(ends, default=whole.high) or whole.high
    return whole.low, min(whole.high, float(f"{AROUND * widest:.2g}"))


def _looked_at(grid: Grid) -> NDArray[np.bool_]:
    found = np.zeros(grid.low.shape, dtype=np.bool_)
    for place in grid.outcomes:
        found[place] = True
    return found
