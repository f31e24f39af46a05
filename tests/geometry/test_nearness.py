"""The gap between families of segments, against distances taken pair by pair."""

import math
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.geometry.area import Floats
from preimage.geometry.nearness import gap
from preimage.verification.distances import apart

Segments = tuple[Floats, Floats]


def family(rng: Random, lattice: bool) -> Segments:
    """Some segments, some of them points."""

    def place() -> list[float]:
        spread = (rng.randint(-4, 4), rng.randint(-4, 4)) if lattice else (0.0, 0.0)
        return [part + (0.0 if lattice else rng.uniform(-4.0, 4.0)) for part in spread]

    starts = [place() for _ in range(rng.randint(1, 6))]
    ends = [start if rng.random() < 0.3 else place() for start in starts]
    return np.array(starts, dtype=np.float64), np.array(ends, dtype=np.float64)


@given(st.integers(0, 10_000), st.booleans())
def test_is_the_least_of_all_pairs(seed: int, lattice: bool) -> None:
    rng = Random(seed)
    first, second = family(rng, lattice), family(rng, lattice)
    least = float(np.min(apart(first, second)))
    assert gap(first, second) == pytest.approx(least, abs=1e-12)
    assert gap(second, first) == pytest.approx(least, abs=1e-12)


def test_nothing_is_infinitely_far() -> None:
    none = np.empty((0, 2)), np.empty((0, 2))
    point = np.zeros((1, 2)), np.zeros((1, 2))
    assert gap(none, point) == gap(point, none) == gap(none, none) == math.inf
    assert gap(point, point) == 0.0
