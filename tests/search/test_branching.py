"""Initial branching against sampling: what the first reading of the position leaves (theory 7)."""

import math
from dataclasses import dataclass, replace
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, covered
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.preimages.setting import Setting
from preimage.search.branching import Branching, choices
from tests.laws.tasks import random_setting
from tests.strategies import HALF, space_of

seeds = st.integers(0, 2**32 - 1)
POSITIONS = (0.0, 0.1, 0.5, math.inf)


@dataclass(frozen=True)
class Choice:
    rank: int
    region: Region


def box(space: ConfigurationSpace, low: tuple[float, float], high: tuple[float, float]) -> Region:
    """Valid space in a box."""
    patch = Area.box(*low, *high)
    contact = space.contact
    found = ContactSet.empty()
    for edge in contact.edges.tolist():
        a, b = contact.points[edge], contact.ends[edge]
        begin, end = 0.0, 1.0
        for axis in range(2):
            step = b[axis] - a[axis]
            if abs(step) < 1e-12:
                if not low[axis] <= a[axis] <= high[axis]:
                    end = -1.0
                continue
            one, other = sorted(((low[axis] - a[axis]) / step, (high[axis] - a[axis]) / step))
            begin, end = max(begin, one), min(end, other)
        if end - begin > 1e-6:
            length = float(contact.length[edge])
            piece = ContactSet(
                np.array([edge], np.int32), np.array([begin * length]), np.array([end * length]),
                np.empty(0, np.int32),
            )  # fmt: skip
            found = contact_set.union(found, piece, space.tolerance.length)
    inside = [
        vertex
        for vertex in contact.vertices.tolist()
        if np.all(contact.points[vertex] >= low) and np.all(contact.points[vertex] <= high)
    ]
    corners = ContactSet(found.edge, found.low, found.high, np.array(inside, dtype=np.int32))
    corners = contact_set.without_outermost(corners, contact)
    return Region(areas.intersection(patch, space.free), corners)


def case(seed: int, position: float) -> tuple[Setting, Start, list[Choice]]:
    """A start, and overlapping boxes that cover it, or most of it."""
    rng = Random(seed)
    setting, _ = random_setting(rng)
    setting = replace(setting, uncertainty=replace(setting.uncertainty, position=position))
    x, y, half = rng.uniform(-2, 2), rng.uniform(-2, 2), rng.choice((0.5, 1.5))
    start = Start.anywhere_in(box(setting.space, (x - half, y - half), (x + half, y + half)))
    cut, other = x + rng.uniform(-half, half), y + rng.uniform(-half, half)
    lap = rng.choice((0.0, 0.05, 0.15, 0.6, 1.2))
    far = 2.0 * HALF
    parts = [
        box(setting.space, (-far, -far), (cut + lap, far)),
        box(setting.space, (cut - lap, -far), (far, other + lap)),
        box(setting.space, (cut - lap, other - lap), (far, far)),
    ]
    return setting, start, [Choice(rank + 1, part) for rank, part in enumerate(parts)]


def samples(space: ConfigurationSpace, region: Region, rng: np.random.Generator) -> list[tuple[
    int, float, np.ndarray
]]:  # fmt: skip
    """(feature, distance, place) all over a region; -1 is free space, -2 a vertex."""
    found = []
    if not region.area.is_empty:
        low_x, low_y, high_x, high_y = region.area.bounds
        some = rng.uniform((low_x, low_y), (high_x, high_y), (300, 2))
        found += [(-1, 0.0, point) for point in some[region.area.contains_all(some)]]
    part = region.contact
    for edge, low, high in zip(part.edge, part.low, part.high, strict=True):
        for distance in np.linspace(low, high, 25)[1:-1]:
            place = space.contact.at(np.array([edge]), np.array([distance]))[0]
            found.append((int(edge), float(distance), place))
    return found + [(-2, float(one), space.contact.points[one]) for one in part.vertices]


def holds(region: Region, one: tuple[int, float, np.ndarray]) -> bool:
    feature, distance, place = one
    if feature == -1:
        return region.area.contains(float(place[0]), float(place[1]))
    if feature == -2:
        return region.contact.has_vertex(int(distance))
    return region.contact.contains(feature, distance, 0.0)


def check(seed: int, position: float) -> int:
    setting, start, offered = case(seed, position)
    if start.region.is_empty:
        return 0
    space, rng = setting.space, np.random.default_rng(seed)
    chosen = choices(setting, start, offered)
    places = samples(space, start.region, rng)
    assert all(one in offered for one in chosen)
    points = np.array([place for _, _, place in places]).reshape(-1, 2)
    kept = chosen if chosen else tuple(offered)
    inside = np.array([[holds(one.region, place) for place in places] for one in kept])
    radius = max(position, space.tolerance.length)
    if chosen and math.isinf(position):
        assert len(chosen) == 1
        assert covered(start, chosen[0].region, space)
        return 1
    if chosen:
        for point in points[::3]:
            turn, off = rng.uniform(0.0, math.tau), rng.choice((0.0, 0.7, 0.999))
            q = point + off * position * np.array((math.cos(turn), math.sin(turn)))
            possible = np.hypot(*(points - q).T) < radius
            assert np.any(np.all(inside[:, possible], axis=1)), (seed, q)
        return len(chosen)
    return 0


@given(seeds, st.sampled_from(POSITIONS))
@settings(max_examples=30, deadline=None)
def test_every_reading_leaves_the_start_in_one_of_the_regions(seed: int, position: float) -> None:
    check(seed, position)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 600, 200))
def test_readings_in_many_scenes(first: int) -> None:
    several = 0
    for seed in range(first, first + 200):
        several += check(seed, POSITIONS[seed % 4]) > 1
    assert several


def half_planes(lap: float, position: float) -> tuple[Setting, Start, list[Choice]]:
    """A square in free space, and two regions that overlap by `2 lap` across its middle."""

    setting, _ = random_setting(Random(0))
    space = space_of([])
    setting = Setting(
        space, replace(setting.uncertainty, position=position), 0.0, setting.sliding, 0.005
    )
    start = Start.anywhere_in(Region(Area.box(-1, -1, 1, 1), ContactSet.empty()))
    left = Region(Area.box(-2, -2, lap, 2), ContactSet.empty())
    right = Region(Area.box(-lap, -2, 2, 2), ContactSet.empty())
    return setting, start, [Choice(1, left), Choice(2, right)]


@pytest.mark.parametrize("position", [0.1, 0.3])
@pytest.mark.parametrize("factor", [0.0, 0.5, 0.98, 1.02, 1.5])
def test_two_halves_are_told_apart_if_they_overlap_by_twice_the_error(
    position: float, factor: float
) -> None:
    setting, start, offered = half_planes(factor * position, position)
    found = choices(setting, start, offered)
    assert len(found) == (2 if factor > 1.0 else 0)
    alike = Branching[Choice](setting, start)
    assert alike.further(offered[:1]) == ()
    assert len(alike.further(offered[1:])) == len(found)


def test_without_a_position_sensor_one_region_must_hold_all() -> None:
    setting, start, offered = half_planes(0.5, math.inf)
    assert choices(setting, start, offered) == ()
    whole = Choice(3, Region(Area.box(-2, -2, 2, 2), ContactSet.empty()))
    assert choices(setting, start, [*offered, whole]) == (whole,)


def test_the_region_with_the_fewest_motions_is_taken() -> None:
    setting, start, _ = half_planes(0.5, 0.1)
    whole = Region(Area.box(-2, -2, 2, 2), ContactSet.empty())
    assert choices(setting, start, [Choice(3, whole), Choice(1, whole)])[0].rank == 1
