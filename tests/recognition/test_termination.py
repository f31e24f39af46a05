"""Sticking and elapsed time as conditions."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
    sticking_condition,
)


@given(st.floats(1e-3, 1.0), st.floats(1e-9, 1e3))
def test_sticking_is_told_from_moving(progress: float, rho: float) -> None:
    got = sticking_condition(progress, rho)
    assert isinstance(got, StickingCondition)
    assert 2 * rho <= got.distance < progress * got.period - 2 * rho


def test_paper_5_2() -> None:
    """2.5 rho over 5 rho / s."""
    assert sticking_condition(0.5, 0.3) == StickingCondition(3.0, 0.75)


def test_exact_position_needs_a_resolution() -> None:
    got = sticking_condition(0.5, 0.0, resolution=1e-6)
    assert isinstance(got, StickingCondition)
    assert 0.0 < got.distance < 0.5 * got.period
    with pytest.raises(ValueError, match="resolution"):
        sticking_condition(0.5, 0.0)


@given(st.floats(1e-3, 1.0), st.floats(0.0, 1e3))
def test_without_position_time_is_waited_for(progress: float, extent: float) -> None:
    got = sticking_condition(progress, math.inf, extent=extent)
    assert isinstance(got, ElapsedCondition)
    assert got.period * progress >= extent * (1 - 1e-15)
    assert got.period >= extent / progress


def test_what_follows_from_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match="displacement"):
        sticking_condition(0.5, math.inf)
    for progress in (0.0, -0.1, math.nan):
        with pytest.raises(ValueError, match="positive"):
            sticking_condition(progress, 0.1)


def test_conditions_are_data() -> None:
    assert ReadingCondition().domain is None
    with pytest.raises(AttributeError):
        ReadingCondition().domain = None  # type: ignore[misc]
