from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping
from itertools import groupby, pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.analysis.axis import KEYS, Axis, Bound
from preimage.analysis.cell import Answer
from preimage.analysis.ladder import SAMPLES, Ladder
from preimage.task.options import Method
from tests.analysis.questions import answered, axis


def stairs(changes: list[int], lost: bool) -> list[int | None]:
    """Motions that grow by one at each of these places, and in the end are none."""

    def at(place: int) -> int | None:
        passed = bisect_right(changes, place)
        return None if lost and passed == len(changes) and changes else passed

    return [at(place) for place in range(10_001)]


@given(
    changes=st.lists(st.integers(1, 1_000), unique=True, max_size=5).map(sorted),
    steps=st.integers(1, 1_000),
    lost=st.booleans(),
)
def test_a_ladder_finds_every_change_of_a_monotone_bound(
    changes: list[int], steps: int, lost: bool
) -> None:
    motions = stairs(changes, lost)
    ladder = Ladder(axis("a", steps), Method.COMBINED)
    asked = answered(ladder, lambda values: motions[round(values["a"] / 0.5)])
    found = [(low, high, one.motions) for low, high, one in ladder.stretches]
    expected = []
    for count, group in groupby(range(steps + 1), key=lambda place: motions[place]):
        places = list(group)
        expected.append((places[0], places[-1], count))
    assert found == expected
    changed = len(expected) - 1
    assert asked <= 2 + changed * math.ceil(math.log2(steps + 1) + 1)


@given(st.data())
def test_a_sampled_bound_is_right_at_all_samples_and_at_every_end(data: st.DataObject) -> None:
    steps = data.draw(st.integers(1, 300))
    values = data.draw(st.lists(st.sampled_from([1, 2, None]), min_size=301, max_size=301))
    ladder = Ladder(axis("a", steps, monotone=False), Method.COMBINED)
    answered(ladder, lambda at: values[round(at["a"] / 0.5)])
    assert {*range(0, steps, ladder.spacing), steps} <= set(ladder.known)
    assert steps // ladder.spacing <= SAMPLES
    for place, outcome in ladder.known.items():
        assert outcome.motions == values[place]
    ends = [(low, high) for low, high, _ in ladder.stretches]
    assert ends[0][0] == 0
    assert ends[-1][1] == steps
    assert all(before[1] + 1 == after[0] for before, after in pairwise(ends))


@pytest.mark.parametrize("needed", [True, False])
def test_the_position_error_is_looked_at_without_a_sensor_too(needed: bool) -> None:
    key = KEYS[Bound.POSITION]
    ladder = Ladder(Axis("position", key, "", 0.1, 0.0, 0.1, 20, True), Method.COMBINED)

    def motions(values: Mapping[str, float]) -> int | None:
        return None if needed and math.isinf(values[key]) else 1

    answered(ladder, motions)
    assert ladder.unbounded is not needed
    assert [(low, high) for low, high, _ in ladder.stretches] == [(0, 20)]
    assert ladder.stretches[0][2].answer is Answer.SOLVED
