"""The termination condition: true throughout the kernel, false where it would be a lie."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry.area import Area
from preimage.recognition.interpretation import contained, interpretation
from preimage.recognition.outside import outside
from tests.recognition.cases import Case, places_in, random_case, sampled_forces, seeds
from tests.strategies import space_of

SCENES = 40


def placed(case: Case, region: Region, rng: np.random.Generator) -> list[tuple[int, np.ndarray]]:
    """Configurations in a region: features and places on them."""
    contact, n = case.space.contact, len(case.space.contact)
    found = [(2 * n, place) for place in places_in(region.area, 10, rng)]
    part = region.contact
    for edge, low, high in zip(part.edge.tolist(), part.low, part.high, strict=True):
        along = np.array([low, high, rng.uniform(low, high)])
        found += [(edge, place) for place in contact.at(np.full(3, edge, np.int32), along)]
    return found + [(n + int(v), contact.points[v]) for v in part.vertices]


def sensed(case: Case, feature: int, rng: np.random.Generator) -> list[float | None]:
    """Forces that may be measured there: directions, or None for 0."""
    low, high = case.senses.force_thresholds
    read: list[float | None] = []
    for x, y in sampled_forces(case, feature)[::4].tolist():
        size = math.hypot(x, y)
        if size <= high:
            read.append(None)
        if size > low + 1e-9:
            error = 0.999 * case.senses.force_angle * rng.uniform(-1, 1)
            read.append(math.atan2(y, x) + error)
    return read


def measured(case: Case, place: np.ndarray, rng: np.random.Generator) -> tuple[float, float]:
    """A position that may be measured there."""
    turn = rng.uniform(0, math.tau)
    off = 0.999999 * case.senses.position * rng.choice((1.0, rng.random()))
    return float(place[0] + off * math.cos(turn)), float(place[1] + off * math.sin(turn))


@given(seeds)
@settings(max_examples=SCENES)
def test_true_throughout_the_kernel(seed: int) -> None:
    case, rng = random_case(seed), np.random.default_rng(seed)
    sets, rest = case.readings, outside(case.space, case.target, case.domain)
    for feature, place in placed(case, case.kernel, rng):
        for force in sensed(case, feature, rng):
            told = interpretation(sets, measured(case, place, rng), force, case.senses)
            assert told.features[feature]
            assert contained(case.space, sets, told, rest)


@given(seeds)
@settings(max_examples=SCENES)
def test_false_where_the_robot_may_be_outside(seed: int) -> None:
    case, rng = random_case(seed), np.random.default_rng(seed)
    sets, rest = case.readings, outside(case.space, case.target, case.domain)
    for feature, place in placed(case, Region(rest.area, rest.contact), rng):
        for force in sensed(case, feature, rng):
            told = interpretation(sets, measured(case, place, rng), force, case.senses)
            assert not contained(case.space, sets, told, rest)


@given(seeds)
@settings(max_examples=SCENES // 2)
def test_without_a_position_sensor(seed: int) -> None:
    case, rng = random_case(seed), np.random.default_rng(seed)
    case.senses = replace(case.senses, position=math.inf)
    sets, rest = case.readings, outside(case.space, case.target, case.domain)
    for region, expected in ((case.kernel, True), (Region(rest.area, rest.contact), False)):
        for feature, _ in placed(case, region, rng):
            for force in sensed(case, feature, rng):
                told = interpretation(sets, (0.0, 0.0), force, case.senses)
                assert contained(case.space, sets, told, rest) is expected


@given(seeds)
@settings(max_examples=SCENES)
def test_exact_position(seed: int) -> None:
    case, rng = random_case(seed), np.random.default_rng(seed)
    case = replace(case, senses=replace(case.senses, position=0.0))
    sets, rest = case.readings, outside(case.space, case.target, case.domain)
    for feature, place in placed(case, case.kernel, rng):
        if feature == sets.free and np.min(_off_contact(case, place)) < 1e-6:
            continue  # on the border of free space, where that ends
        at_end = feature < sets.size and np.min(_off_vertices(case, place)) < 1e-6
        for force in sensed(case, feature, rng) if not at_end else []:
            told = interpretation(sets, (float(place[0]), float(place[1])), force, case.senses)
            assert contained(case.space, sets, told, rest)


def _off_vertices(case: Case, place: np.ndarray) -> np.ndarray:
    return np.asarray(np.hypot(*(case.space.contact.points - place).T))


def _off_contact(case: Case, place: np.ndarray) -> np.ndarray:
    contact = case.space.contact
    along = np.einsum("ij,ij->i", place - contact.points, contact.tangent)
    foot = contact.points + np.clip(along, 0, contact.length)[:, None] * contact.tangent
    return np.asarray(np.hypot(*(foot - place).T))


def test_outside_with_exact_position() -> None:
    space = space_of([])
    target = Region(Area.box(0, 0, 2, 2), ContactSet.empty())
    case = Case(space, target, 0.0, 0.0, random_case(0).senses)
    case.senses = replace(case.senses, position=0.0)
    rest = outside(space, target)
    for place, expected in (((1.0, 1.0), True), ((2.0, 1.0), False), ((2.1, 1.0), False)):
        told = interpretation(case.readings, place, None, case.senses)
        assert contained(space, case.readings, told, rest) is expected


def test_a_position_that_is_no_number_tells_nothing() -> None:
    case = random_case(0)
    space = space_of([shapely.box(-3, -3, 3, 0)])
    senses = replace(case.senses, position=0.5)
    case = Case(space, Region.empty(), -math.pi / 2, 0.2, senses)
    rest = outside(space, Region.empty())
    for force in (None, math.pi / 2):
        told = interpretation(case.readings, (math.nan, 0.0), force, senses)
        assert not contained(space, case.readings, told, rest)


def test_interpretation_of_a_force() -> None:
    """Paper 5.3: contact within rho of q that may push back that way."""
    case = random_case(0)
    space = space_of([shapely.box(-3, -3, 3, 0)])
    senses = replace(
        case.senses, control=0.1, position=0.5, force_angle=0.1, force_thresholds=(0.05, 0.05)
    )
    case = Case(space, Region.empty(), -math.pi / 2, 0.2, senses)
    told = interpretation(case.readings, (1.0, 0.3), math.pi / 2, senses)
    assert not told.free
    part = told.contact(space.contact)
    assert (part.high - part.low).tolist() == pytest.approx([0.8])
    assert not len(part.vertices)
    told = interpretation(case.readings, (2.8, 0.1), None, senses)
    assert told.free
    corner = int(np.argmin(np.hypot(*(space.contact.points - (3, 0)).T)))
    assert told.contact(space.contact).vertices.tolist() == [corner]
    blind = replace(senses, position=math.inf)
    told = interpretation(case.readings, (9.0, 9.0), math.pi / 2, blind)
    assert (told.contact(space.contact).high).max() == pytest.approx(6.0)
