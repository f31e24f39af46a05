"""Speeds and guaranteed progress, against dense sampling."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from preimage.geometry.angles import wrap
from preimage.mechanics.damper import guaranteed_progress, sliding_speed
from preimage.task.task import SlidingLaw

laws = st.sampled_from(SlidingLaw)


def sampled_progress(
    beta: float, control: float, friction: float, law: SlidingLaw
) -> tuple[float, float]:
    """The least progress along v on an edge over samples of v*, and how near samples lie."""
    least = math.inf
    for offset in np.linspace(-control, control, 4001)[1:-1] if control else [0.0]:
        a = wrap(beta + offset)
        if friction < abs(a) <= math.pi / 2:
            along = math.sin(beta) * math.copysign(1.0, a)
            speed = float(sliding_speed(np.array([a]), friction, law)[0])
            least = min(least, along * speed)
    return least, control / 1000


@given(st.floats(-math.pi, math.pi), st.floats(0, 1.5), st.floats(0, 1.5), laws)
def test_progress_is_the_least_over_natures_choices(
    beta: float, control: float, friction: float, law: SlidingLaw
) -> None:
    for tie in (abs(beta) - control - math.pi / 2, abs(beta) + control - friction):
        assume(abs(tie) > 0.01)
    assume(abs(control - abs(beta) - friction) > 0.01)
    assume(abs(beta) + control < math.pi)
    least, near = sampled_progress(beta, control, friction, law)
    slope = 1.0 if law is SlidingLaw.PROJECTION else 1.0 / math.cos(friction)
    got = guaranteed_progress(np.array([beta]), control, friction, law)
    expected = min(least, math.cos(control))
    assert got <= expected + 1e-12
    assert got >= expected - near * slope - 1e-12


def test_in_free_space_the_cone_decides() -> None:
    assert guaranteed_progress(np.array([]), math.radians(60), 0.3) == pytest.approx(0.5)


def test_edges_that_are_left_or_stick_do_not_count() -> None:
    beta = np.radians([0.0, 5.0, 150.0])  # two stick for sure, one is left for sure
    got = guaranteed_progress(beta, math.radians(10), math.radians(20))
    assert got == pytest.approx(math.cos(math.radians(10)))


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        (SlidingLaw.PROJECTION, math.sin(math.radians(60)) * math.sin(math.radians(50))),
        (
            SlidingLaw.DAMPER,
            math.sin(math.radians(60)) * math.sin(math.radians(30)) / math.cos(math.radians(20)),
        ),
    ],
)
def test_a_slide_that_is_sure(law: SlidingLaw, expected: float) -> None:
    beta, control, friction = math.radians(60), math.radians(10), math.radians(20)
    assert guaranteed_progress(np.array([beta, -beta]), control, friction, law) == pytest.approx(
        expected
    )


def test_a_slide_that_may_go_back_guarantees_nothing() -> None:
    assert guaranteed_progress(np.radians([10.0]), math.radians(40), 0.0) < 0.0


def test_speeds() -> None:
    a = np.radians([30.0, -60.0, 90.0])
    assert sliding_speed(a, 0.3, SlidingLaw.PROJECTION) == pytest.approx(np.sin(np.abs(a)))
    phi = math.radians(30)
    damper = sliding_speed(a, phi, SlidingLaw.DAMPER)
    assert damper == pytest.approx([0.0, 0.5 / math.cos(phi), 1.0])
    frictionless = [sliding_speed(a, 0.0, law) for law in SlidingLaw]
    assert frictionless[0] == pytest.approx(frictionless[1])
    assert sliding_speed(a[2:], math.pi / 2, SlidingLaw.DAMPER) == pytest.approx([1.0])
