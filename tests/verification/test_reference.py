"""The reference backprojection: its slabs, its features, and laws of theory 8."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from preimage.configuration import region as regions
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.mechanics.behaviour import (
    Behaviour,
    concave_vertex_behaviour,
    convex_vertex_behaviour,
    edge_behaviour,
)
from preimage.verification.features import features_of
from preimage.verification.reference import ReferenceBackprojection, reference_backprojection
from preimage.verification.slabs import cut
from tests.strategies import (
    CONTROLS,
    Scene,
    contact_in,
    random_scene,
    random_target,
    scenes,
    space_of,
)

Point = tuple[float, float]


# --- slabs and features -----------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(40))
def test_cells_are_free_space_and_those_of_the_target_its_area(seed: int) -> None:
    scene = random_scene(Random(seed))
    slabs = cut(scene.space, scene.target, scene.direction)
    free = target = 0.0
    for row in slabs.cells:
        for cell in row:
            widths = cell.floor[1] - cell.floor[0] + cell.ceiling[1] - cell.ceiling[0]
            size = 0.5 * (cell.top - cell.bottom) * widths
            free += size
            target += size if cell.in_target else 0.0
    assert free == pytest.approx(scene.space.free.measure, abs=1e-7)
    assert target == pytest.approx(scene.target.area.measure, abs=1e-7)


@pytest.mark.parametrize("seed", range(40))
def test_features_are_those_of_mechanics(seed: int) -> None:
    """Two independent readings of theory 2."""
    scene = random_scene(Random(seed))
    contact, angle = scene.space.contact, scene.space.tolerance.angle
    motion = scene.direction, scene.control, scene.friction
    found = features_of(contact, *motion, angle)
    codes = edge_behaviour(contact.normal, *motion, angle)
    before = contact.previous
    concave = concave_vertex_behaviour(contact.normal[before], contact.normal, *motion, angle)
    convex = convex_vertex_behaviour(codes[before], codes)
    vertex = np.where(contact.concave, concave, convex)

    def has(codes: NDArray[np.uint8], bit: Behaviour) -> list[bool]:
        return [bool(code & bit) for code in codes.tolist()]

    edges = contact.edges
    assert found.keeps[edges].tolist() == has(codes[edges], Behaviour.MAY_STICK)
    assert found.leaves[edges].tolist() == has(codes[edges], Behaviour.MAY_LEAVE)
    slippery = edges[~found.keeps[edges]]
    assert found.slides[slippery].tolist() == has(codes[slippery], Behaviour.MAY_SLIDE)
    inner = np.flatnonzero(~contact.open & ~contact.open[before])
    assert found.keeps_vertex[inner].tolist() == has(vertex[inner], Behaviour.MAY_STICK)


# --- laws -------------------------------------------------------------------------------------


def samples(space: ConfigurationSpace, rng: Random, count: int) -> list[Point]:
    xmin, ymin, xmax, ymax = space.window
    places = [(rng.uniform(xmin, xmax), rng.uniform(ymin, ymax)) for _ in range(count)]
    return [place for place in places if space.free.contains(*place)]


def assert_grows(
    small: ReferenceBackprojection, large: ReferenceBackprojection, rng: Random
) -> None:
    contact = small.space.contact
    for x, y in samples(small.space, rng, 60):
        assert not small.holds_free(x, y) or large.holds_free(x, y), (x, y)
    for edge in contact.edges.tolist():
        distance = rng.uniform(0.0, float(contact.length[edge]))
        assert not small.holds_edge(edge, distance) or large.holds_edge(edge, distance)
    for vertex in contact.vertices.tolist():
        assert not small.holds_vertex(vertex) or large.holds_vertex(vertex)


@given(scenes, st.randoms(use_true_random=False))
@settings(max_examples=40)
def test_b_holds_its_target_and_grows_with_it(scene: Scene, rng: Random) -> None:
    space, target = scene.space, scene.target
    more = random_target(rng, space, scene.direction, rng.random() < 0.5)
    small = reference_backprojection(*scene)
    large = reference_backprojection(
        space, regions.union(target, more, space.tolerance), *scene[2:]
    )
    assert_grows(small, large, rng)
    for vertex in target.contact.vertices.tolist():
        assert small.holds_vertex(vertex)
    for x, y in samples(space, rng, 30):
        assert small.holds_free(x, y) or not target.area.contains(x, y)


@given(scenes, st.sampled_from(CONTROLS), st.randoms(use_true_random=False))
@settings(max_examples=40)
def test_b_shrinks_as_the_cone_opens(scene: Scene, other: float, rng: Random) -> None:
    wide, narrow = max(scene.control, other), min(scene.control, other)
    found = [
        reference_backprojection(
            scene.space, scene.target, scene.direction, control, scene.friction
        )
        for control in (wide, narrow)
    ]
    assert_grows(found[0], found[1], rng)


@pytest.mark.parametrize("seed", range(60))
def test_export_is_what_the_queries_say(seed: int) -> None:
    rng = Random(seed)
    scene = random_scene(rng)
    found = reference_backprojection(*scene)
    border = shapely.boundary(found.region.area.geometry)
    for x, y in samples(scene.space, rng, 60):
        if border.is_empty or border.distance(shapely.Point(x, y)) > 1e-6:
            assert found.region.area.contains(x, y) == found.holds_free(x, y), (x, y)
    contact = scene.space.contact
    for edge in contact.edges.tolist():
        for _ in range(3):
            distance = rng.uniform(0.0, float(contact.length[edge]))
            inside = found.region.contact.contains(edge, distance, -1e-6)
            outside = not found.region.contact.contains(edge, distance, 1e-6)
            assert not inside or found.holds_edge(edge, distance)
            assert not outside or not found.holds_edge(edge, distance)
    for vertex in contact.vertices.tolist():
        assert found.region.contact.has_vertex(vertex) == found.holds_vertex(vertex)
    assert regions.is_subset(scene.target, found.region, scene.space.tolerance)


@pytest.mark.parametrize("seed", range(40))
def test_turning_the_scene_turns_the_answer(seed: int) -> None:
    """A quarter turn is exact on lattices; the target is named by places, so found again."""
    rng = Random(seed)
    scene = random_scene(rng)
    space = scene.space
    turned = space_of(
        [shapely.affinity.rotate(space.obstacles.geometry, 90, origin=(0, 0))],
        (),
        space.window,
    )
    plain = space_of([space.obstacles.geometry], (), space.window)
    patch = shapely.box(*(sorted(rng.uniform(-6, 6) for _ in range(2)) * 2)).buffer(1.0, 1)
    measures = []
    for quarter, other in ((0, plain), (1, turned)):
        shape = shapely.affinity.rotate(patch, 90 * quarter, origin=(0, 0))
        area = areas.intersection(Area.of(shape), other.free)
        edges, vertices = contact_in(other, area)
        contact = ContactSet.of(
            [edge for edge, _, _ in edges],
            [low for _, low, _ in edges],
            [high for _, _, high in edges],
            vertices,
            other.tolerance.length,
        )
        direction = scene.direction + quarter * 0.5 * math.pi
        found = reference_backprojection(
            other, Region(area, contact), direction, scene.control, scene.friction
        )
        measures.append((found.area.measure, found.contact.total_length))
    assert measures[0] == pytest.approx(measures[1], abs=1e-6)
