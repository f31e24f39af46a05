"""Kernels of random scenes against their definition, and the laws of theory 8."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from preimage.configuration import contact_set
from preimage.configuration.contact import ContactSpace
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, is_subset
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.angles import wrap
from preimage.geometry.area import Area
from preimage.recognition.readings import alike
from tests.recognition.cases import (
    Case,
    outside_by_feature,
    places_in,
    random_case,
    sampled_forces,
    seeds,
)

SLACK = 1e-6
SCENES = 40


def least_distance(case: Case, feature: int, places: np.ndarray) -> np.ndarray:
    """How far places on a feature are from all outside the target that is alike."""
    sets = case.readings
    parts = outside_by_feature(case)
    features = np.array([other for other, _ in parts], dtype=np.int32)
    least = np.full(len(places), math.inf)
    if not len(parts):
        return least
    points = shapely.points(places)
    for (_, shape), confused in zip(parts, alike(sets, feature, features), strict=True):
        if confused:
            least = np.minimum(least, shapely.distance(shape, points))
    return least


@given(seeds)
@settings(max_examples=SCENES)
def test_definition_in_free_space(seed: int) -> None:
    case = random_case(seed)
    got, radius = case.kernel, 2 * case.senses.position
    rng = np.random.default_rng(seed)
    free = case.readings.free
    kept = least_distance(case, free, places_in(got.area, 100, rng))
    assert np.all(kept >= radius - 1e-9)
    wanted = places_in(case.target.area, 300, rng)
    if not len(wanted):
        assert got.area.is_empty
        return
    off = shapely.distance(got.area.geometry, shapely.points(wanted))
    lost = wanted[(off > SLACK) | np.isnan(off)]
    assert np.all(least_distance(case, free, lost) < radius * 1.005 + SLACK)


@given(seeds)
@settings(max_examples=SCENES)
def test_definition_on_contact_space(seed: int) -> None:
    case = random_case(seed)
    space, got, radius = case.space, case.kernel, 2 * case.senses.position
    assert contact_set.is_subset(got.contact, case.target.contact, space.tolerance.length)
    own = case.target.contact
    for edge, low, high in zip(own.edge.tolist(), own.low, own.high, strict=True):
        along = np.linspace(low + SLACK, high - SLACK, 60)
        places = space.contact.at(np.full(60, edge, np.int32), along)
        least = least_distance(case, edge, places)
        for distance, off in zip(along.tolist(), least.tolist(), strict=True):
            if got.contact.contains(edge, distance, 0.0):
                assert off >= radius - 1e-9
            elif not got.contact.contains(edge, distance, SLACK):
                assert off < radius + SLACK
    for vertex in own.vertices.tolist():
        feature = len(space.contact) + vertex
        off = float(least_distance(case, feature, space.contact.points[[vertex]])[0])
        if got.contact.has_vertex(vertex):
            assert off >= radius - 1e-9
            assert vertex not in space.contact.outermost
        elif vertex not in space.contact.outermost:
            assert off < radius + SLACK


@given(seeds)
@settings(max_examples=SCENES)
def test_no_reading_is_shared_with_the_outside(seed: int) -> None:
    """Straight from theory 3: nature's choices sampled, no reading set, no kernel's alikeness."""
    case = random_case(seed)
    space, got = case.space, case.kernel
    rng = np.random.default_rng(seed)
    n = len(space.contact)
    inside = [(2 * n, place) for place in places_in(got.area, 20, rng)]
    outside = []
    for feature, shape in outside_by_feature(case):
        if shape.geom_type in ("Point", "LineString"):
            ends = shapely.get_coordinates(shape)
            outside += [(feature, ends[0] + t * (ends[-1] - ends[0])) for t in rng.random(4)]
        else:
            outside += [(feature, place) for place in places_in(Area(shape), 40, rng)]
    for edge, low, high in zip(
        got.contact.edge.tolist(), got.contact.low, got.contact.high, strict=True
    ):
        along = np.array([low, high, *rng.uniform(low, high, 3)])
        inside += [(edge, place) for place in space.contact.at(np.full(5, edge, np.int32), along)]
    inside += [(n + int(v), space.contact.points[v]) for v in got.contact.vertices]
    read = {f: sampled_forces(case, f) for f, _ in (*inside, *outside)}
    for x, place in inside:
        for y, other in outside:
            if math.dist(place, other) < 2 * case.senses.position - 1e-9:
                assert not _share_a_reading(case, read[x], read[y])


def _share_a_reading(case: Case, first: np.ndarray, second: np.ndarray) -> bool:
    low, high = case.senses.force_thresholds
    sizes = [np.hypot(*forces.T) for forces in (first, second)]
    if all(np.any(size <= high) for size in sizes):
        return True
    angles = [
        np.arctan2(forces[:, 1], forces[:, 0])[size > low]
        for forces, size in zip((first, second), sizes, strict=True)
    ]
    apart = np.abs(wrap(angles[0][:, None] - angles[1][None, :]))
    return bool(np.any(apart < max(2 * case.senses.force_angle, 1e-13)))


# --- laws -------------------------------------------------------------------------------------

LESS = {
    "position": lambda u: replace(u, position=1.5 * u.position),
    "a little position": lambda u: replace(u, position=u.position + 1e-4),
    "no position": lambda u: replace(u, position=math.inf),
    "force angle": lambda u: replace(u, force_angle=min(u.force_angle + 0.3, 3.0)),
    "upper threshold": lambda u: replace(
        u, force_thresholds=(u.force_thresholds[0], u.force_thresholds[1] + 0.2)
    ),
    "lower threshold": lambda u: replace(u, force_thresholds=(0.0, u.force_thresholds[1])),
    "no force": lambda u: replace(u, force_thresholds=(0.0, 9.0)),
}


@pytest.mark.parametrize("change", LESS)
@given(seeds)
@settings(max_examples=SCENES // 2)
def test_kernels_shrink_with_less_sensing(change: str, seed: int) -> None:
    case = random_case(seed)
    if math.isinf(case.senses.force_thresholds[0]):
        case.senses = replace(case.senses, force_thresholds=(0.1, 0.1))
    worse = replace(case, senses=LESS[change](case.senses))
    # what is no longer than the tolerance is cut off or not
    near = replace(case.space.tolerance, length=4 * case.space.tolerance.length)
    assert is_subset(worse.kernel, case.kernel, near)
    exact = replace(case, senses=replace(case.senses, position=0.0))
    assert is_subset(case.kernel, exact.kernel, near)


@given(seeds)
@settings(max_examples=SCENES)
def test_kernels_lie_in_the_target_and_grow_with_it(seed: int) -> None:
    case = random_case(seed)
    got = case.kernel
    assert is_subset(got, case.target, case.space.tolerance)
    both = case.space.valid
    assert is_subset(got, replace(case, target=both).kernel, case.space.tolerance)
    if case.domain is not None:
        assert_inside(replace(case, domain=None).kernel, got, case)


@given(seeds)
@settings(max_examples=SCENES)
def test_all_of_valid_space_as_domain_is_no_domain(seed: int) -> None:
    case = replace(random_case(seed), domain=None)
    whole = replace(case, domain=case.space.valid)
    assert_inside(case.kernel, whole.kernel, case)
    assert_inside(whole.kernel, case.kernel, case)


def assert_inside(one: Region, other: Region, case: Case) -> None:
    """Up to how arcs around different pieces of the same thing are replaced."""
    assert contact_set.is_subset(one.contact, other.contact, case.space.tolerance.length)
    off = 0.005 * 2 * case.senses.position
    assert areas.is_subset(one.area, other.area, off)


def assert_same(one: Region, other: Region, space: ConfigurationSpace) -> None:
    near = replace(space.tolerance, length=8 * space.tolerance.length)
    assert is_subset(one, other, near)
    assert is_subset(other, one, near)


@given(seeds)
@settings(max_examples=SCENES)
def test_order_of_features_does_not_matter(seed: int) -> None:
    case = random_case(seed)
    order = np.random.default_rng(seed).permutation(len(case.space.contact)).astype(np.int32)
    place = np.argsort(order).astype(np.int32)
    old = case.space.contact
    new = ContactSpace(old.points[order], place[old.next[order]], old.open[order])
    space = replace(case.space, contact=new)

    def moved(region: Region) -> Region:
        part = region.contact
        contact = ContactSet.of(
            place[part.edge], part.low, part.high, place[part.vertices], space.tolerance.length
        )
        return Region(region.area, contact)

    domain = None if case.domain is None else moved(case.domain)
    other = replace(case, space=space, target=moved(case.target), domain=domain)
    assert_same(other.kernel, moved(case.kernel), space)


@given(seeds)
@settings(max_examples=SCENES)
def test_mirrored_scenes_have_mirrored_kernels(seed: int) -> None:
    """Left and right are exchanged: loops run the other way round, edge i starts where it ended."""
    case = random_case(seed)
    old = case.space.contact
    flip = np.array((-1.0, 1.0))
    # the edge that ran from vertex i to next[i] now starts at next[i]: edges take its number
    new = ContactSpace(old.points * flip, old.previous, old.open[old.previous])
    number = old.next

    def turned(area: Area) -> Area:
        return Area(shapely.transform(area.geometry, lambda points: points * flip))

    def moved(region: Region) -> Region:
        part = region.contact
        length = old.length[part.edge]
        contact = ContactSet.of(
            number[part.edge],
            length - part.high,
            length - part.low,
            part.vertices,
            case.space.tolerance.length,
        )
        return Region(turned(region.area), contact)

    space = replace(
        case.space,
        contact=new,
        free=turned(case.space.free),
        obstacles=turned(case.space.obstacles),
    )
    assert new.normal == pytest.approx(
        np.asarray(wrap(math.pi - old.normal[old.previous])), abs=1e-9
    ) or np.any(np.abs(np.abs(new.normal) - math.pi) < 1e-9)
    other = replace(
        case,
        space=space,
        target=moved(case.target),
        domain=None if case.domain is None else moved(case.domain),
        direction=math.pi - case.direction,
    )
    assert_same(other.kernel, moved(case.kernel), space)


@pytest.mark.parametrize("turn", [0.0, math.pi / 2, 0.7])
@given(seeds)
@settings(max_examples=SCENES // 2)
def test_turned_and_moved_scenes_have_turned_and_moved_kernels(turn: float, seed: int) -> None:
    case = random_case(seed)
    cos, sin = (0.0, 1.0) if turn == math.pi / 2 else (math.cos(turn), math.sin(turn))

    def placed(points: np.ndarray) -> np.ndarray:
        return np.asarray(points @ np.array(((cos, sin), (-sin, cos))) + (3.0, -7.0))

    def turned(area: Area) -> Area:
        return Area(shapely.transform(area.geometry, placed))

    def moved(region: Region) -> Region:
        return Region(turned(region.area), region.contact)

    old = case.space
    contact = ContactSpace(placed(old.contact.points), old.contact.next, old.contact.open)
    free, obstacles = turned(old.free), turned(old.obstacles)
    other = replace(
        case,
        space=replace(old, contact=contact, free=free, obstacles=obstacles),
        target=moved(case.target),
        domain=None if case.domain is None else moved(case.domain),
        direction=float(wrap(case.direction + turn)),
    )
    got, expected = other.kernel, moved(case.kernel)
    # a disc that barely reaches an edge takes from it the root of what rounding does to it
    for one, two in ((got, expected), (expected, got)):
        assert contact_set.is_subset(one.contact, two.contact, 1e-4)
        assert areas.is_subset(one.area, two.area, 1e-6)
