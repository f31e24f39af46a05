"""The force filter: what has settled, and what has not."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.physics.plant import Plant
from preimage.physics.touch import Touch

ANGLES = st.floats(-math.pi, math.pi)


def push(angle: float, size: float = 1.0) -> tuple[float, float]:
    return size * math.cos(angle), size * math.sin(angle)


def settled(touch: Touch) -> bool:
    return touch.is_settled


@given(ANGLES, st.floats(0.2, 5.0))
def test_a_steady_force_settles_to_itself(angle: float, size: float) -> None:
    touch = Touch(Plant(), 0.05)
    for _ in range(100):
        touch.add(push(angle, size))
    assert touch.felt == pytest.approx(push(angle, size))
    assert settled(touch)


@given(ANGLES, st.floats(math.radians(3.0), math.pi))
def test_a_turn_is_not_believed_at_once(angle: float, turn: float) -> None:
    touch = Touch(Plant(), 0.05)
    for _ in range(100):
        touch.add(push(angle))
    touch.add(push(angle + turn))
    assert not settled(touch)
    for _ in range(100):
        touch.add(push(angle + turn))
    assert settled(touch)


def test_coming_and_going_are_not_believed_at_once() -> None:
    touch = Touch(Plant(), 0.05)
    assert settled(touch)
    touch.add(push(0.0, 0.1))
    assert not settled(touch)
    for _ in range(100):
        touch.add(push(0.0))
    assert settled(touch)
    touch.add((0.0, 0.0))
    assert not settled(touch)
    for _ in range(100):
        touch.add((0.0, 0.0))
    assert settled(touch)


def test_forgetting_begins_anew() -> None:
    touch = Touch(Plant(), 0.05)
    for force in (push(0.0), push(1.0)):
        touch.add(force)
    touch.forget()
    assert touch.felt == push(1.0)
