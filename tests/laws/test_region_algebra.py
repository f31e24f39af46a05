"""The algebra of contact sets, regions and areas: unions, intersections, differences."""

from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration import contact_set, region
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from tests.laws.similarity import contact_gap, gap, same, within
from tests.strategies import random_space, random_target

SLACK = 1e-6

randoms = st.randoms(use_true_random=False)


def some_space(rng: Random) -> ConfigurationSpace:
    return random_space(rng, rng.random() < 0.6)


def some_contact(rng: Random, space: ConfigurationSpace) -> ContactSet:
    """Intervals that overlap, touch or fill their edge, and vertices."""
    contact = space.contact
    edges, low, high = [], [], []
    for _ in range(rng.randint(0, 6)):
        edge = rng.choice(contact.edges.tolist())
        length = float(contact.length[edge])
        cuts = sorted(rng.choice((0.0, 0.25, 0.5, 1.0, rng.random())) * length for _ in range(2))
        edges.append(edge)
        low.append(cuts[0])
        high.append(cuts[1])
    vertices = [v for v in contact.vertices.tolist() if rng.random() < 0.3]
    return ContactSet.of(edges, low, high, vertices, space.tolerance.length)


def some_region(rng: Random, space: ConfigurationSpace) -> Region:
    return random_target(rng, space, rng.uniform(0.0, 6.0), rng.random() < 0.6)


def assert_normal(part: ContactSet, space: ConfigurationSpace) -> None:
    """Sorted, disjoint, on contact edges and within them, longer than the tolerance."""
    near = space.tolerance.length
    assert np.all(np.diff(part.edge) >= 0)
    assert np.all(part.high - part.low > near)
    same_edge = part.edge[1:] == part.edge[:-1]
    assert np.all(part.low[1:][same_edge] - part.high[:-1][same_edge] > near)
    assert np.all(part.low >= 0.0)
    assert np.all(part.high <= space.contact.length[part.edge] + near)
    assert not np.any(space.contact.open[part.edge])
    assert np.all(np.diff(part.vertices) > 0)


@given(randoms)
@settings(max_examples=100)
def test_contact_sets(rng: Random) -> None:
    space = some_space(rng)
    near = space.tolerance.length
    a, b, c = (some_contact(rng, space) for _ in range(3))

    def union(x: ContactSet, y: ContactSet) -> ContactSet:
        found = contact_set.union(x, y, near)
        assert_normal(found, space)
        return found

    def intersection(x: ContactSet, y: ContactSet) -> ContactSet:
        found = contact_set.intersection(x, y, near)
        assert_normal(found, space)
        return found

    def difference(x: ContactSet, y: ContactSet) -> ContactSet:
        found = contact_set.difference(x, y, near)
        assert_normal(found, space)
        return found

    def outside(x: ContactSet) -> ContactSet:
        return contact_set.complement(x, space.contact, near)

    def equal(x: ContactSet, y: ContactSet) -> bool:
        return contact_gap(x, y) <= SLACK

    assert equal(union(a, b), union(b, a))
    assert equal(intersection(a, b), intersection(b, a))
    assert equal(union(union(a, b), c), union(a, union(b, c)))
    assert equal(intersection(intersection(a, b), c), intersection(a, intersection(b, c)))
    assert equal(union(a, intersection(b, c)), intersection(union(a, b), union(a, c)))
    assert equal(intersection(a, union(b, c)), union(intersection(a, b), intersection(a, c)))
    assert equal(union(a, a), a)
    assert equal(intersection(a, a), a)
    assert equal(union(a, intersection(a, b)), a)
    assert equal(intersection(a, union(a, b)), a)
    assert equal(outside(union(a, b)), intersection(outside(a), outside(b)))
    assert equal(outside(intersection(a, b)), union(outside(a), outside(b)))
    assert equal(outside(outside(a)), a)
    assert equal(difference(a, b), intersection(a, outside(b)))
    assert equal(union(a, ContactSet.empty()), a)
    assert intersection(a, ContactSet.empty()).is_empty
    assert intersection(a, outside(a)).is_empty
    assert equal(union(a, outside(a)), ContactSet.whole(space.contact))
    for smaller, larger in ((a, union(a, b)), (intersection(a, b), a), (difference(a, b), a)):
        assert contact_set.is_subset(smaller, larger, near)
    assert contact_set.is_subset(a, b, near) == equal(union(a, b), b)
    assert union(a, b).total_length + intersection(a, b).total_length == pytest.approx(
        a.total_length + b.total_length
    )


@given(randoms)
@settings(max_examples=60)
def test_areas(rng: Random) -> None:
    space = some_space(rng)
    a, b, c = (some_region(rng, space).area for _ in range(3))

    def equal(x: Area, y: Area) -> bool:
        return gap(x, y) <= SLACK

    union, intersection, difference = areas.union, areas.intersection, areas.difference
    assert equal(union(a, b), union(b, a))
    assert equal(intersection(a, b), intersection(b, a))
    assert equal(union(union(a, b), c), union(a, union(b, c)))
    assert equal(intersection(intersection(a, b), c), intersection(a, intersection(b, c)))
    assert equal(union(a, intersection(b, c)), intersection(union(a, b), union(a, c)))
    assert equal(union(a, intersection(a, b)), a)
    assert equal(intersection(a, union(a, b)), a)
    assert equal(
        difference(space.free, union(a, b)),
        intersection(difference(space.free, a), difference(space.free, b)),
    )
    assert equal(
        difference(space.free, intersection(a, b)),
        union(difference(space.free, a), difference(space.free, b)),
    )
    assert equal(difference(a, b), intersection(a, difference(space.free, b)))
    near = space.tolerance.length
    for smaller, larger in ((a, union(a, b)), (intersection(a, b), a), (difference(a, b), a)):
        assert areas.is_subset(smaller, larger, near)
    assert areas.is_subset(a, space.free, near)
    assert union(a, b).measure + intersection(a, b).measure == pytest.approx(
        a.measure + b.measure, abs=SLACK
    )


@given(randoms)
@settings(max_examples=60)
def test_regions(rng: Random) -> None:
    space = some_space(rng)
    tolerance = space.tolerance
    a, b, c = (some_region(rng, space) for _ in range(3))

    def union(x: Region, y: Region) -> Region:
        return region.union(x, y, tolerance)

    def intersection(x: Region, y: Region) -> Region:
        return region.intersection(x, y, tolerance)

    assert same(union(a, b), union(b, a), SLACK)
    assert same(intersection(a, b), intersection(b, a), SLACK)
    assert same(union(union(a, b), c), union(a, union(b, c)), SLACK)
    assert same(union(a, intersection(a, b)), a, SLACK)
    assert same(intersection(a, union(a, b)), a, SLACK)
    assert same(intersection(a, union(b, c)), union(intersection(a, b), intersection(a, c)), SLACK)
    assert same(union(a, Region.empty()), a, SLACK)
    assert intersection(a, Region.empty()).is_empty
    whole = Region(space.free, ContactSet.whole(space.contact))
    assert same(intersection(a, whole), a, SLACK)
    for smaller, larger in ((a, union(a, b)), (intersection(a, b), a), (a, whole)):
        assert region.is_subset(smaller, larger, tolerance)
        assert within(smaller, larger, SLACK)
    if not within(a, b, 1e-4):
        assert not region.is_subset(a, b, tolerance)
