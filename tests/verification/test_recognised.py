"""What is certainly recognised, against distances by hand and the planner's kernels."""

from __future__ import annotations

import math
from random import Random

import numpy as np
import pytest
import shapely

from preimage.configuration import contact_set
from preimage.configuration import region as regions
from preimage.configuration.region import Region
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.recognition.kernel import kernel
from preimage.recognition.readings import readings
from preimage.task.uncertainty import Uncertainty
from preimage.verification.distances import Floats, apart, closest, taken
from preimage.verification.reading_sets import reading_sets
from preimage.verification.recognised import recognised
from tests.recognition.scenes import DOWN, FRICTION, SENSES, contact, edge_at, space_of
from tests.strategies import random_scene
from tests.verification.test_reading_sets import scene_of

# --- distances --------------------------------------------------------------------------------


def segments(rng: Random, many: int) -> tuple[Floats, Floats]:
    """Segments, some of them points, half of them on a lattice."""
    lattice = rng.random() < 0.5

    def draw() -> tuple[float, float]:
        x, y = rng.uniform(-3, 3), rng.uniform(-3, 3)
        return (round(x), round(y)) if lattice else (x, y)

    starts = [draw() for _ in range(many)]
    ends = [draw() if rng.random() < 0.8 else start for start in starts]
    return np.array(starts, dtype=np.float64), np.array(ends, dtype=np.float64)


@pytest.mark.parametrize("seed", range(10))
def test_distances_of_segments(seed: int) -> None:
    rng = Random(seed)
    first, second = segments(rng, 12), segments(rng, 12)
    found = apart(first, second)
    lines = [shapely.linestrings(np.stack(pair, axis=1)) for pair in (first, second)]
    expected = shapely.distance(lines[0][:, None], lines[1][None, :])
    assert found == pytest.approx(expected, abs=1e-12)
    for i in range(12):
        pair = [(tuple(a[k]), tuple(b[k])) for (a, b), k in ((first, i), (second, i))]
        if expected[i, i] > 0.0:
            assert math.dist(*closest(*pair)) == pytest.approx(expected[i, i], abs=1e-12)


def test_segments_in_one_line_do_not_cross() -> None:
    """Rounding must not make a crossing of them."""
    turn = np.linspace(0.0, math.tau, 200)
    tangent = np.stack((np.cos(turn), np.sin(turn)), axis=1)
    first = 0.3 * tangent, 1.7 * tangent
    second = 1.8 * tangent, 2.9 * tangent
    assert np.diagonal(apart(first, second)) == pytest.approx(0.1, abs=1e-12)


@pytest.mark.parametrize("seed", range(20))
def test_what_a_disc_takes_from_a_line(seed: int) -> None:
    rng = Random(seed)
    turn, radius = rng.uniform(0.0, math.tau), rng.choice((0.5, 1.0, 2.0))
    tangent = (math.cos(turn), math.sin(turn)) if rng.random() < 0.7 else (1.0, 0.0)
    starts, ends = segments(rng, 1)
    far = 20.0 * np.array(tangent)
    line = shapely.LineString([-far, far])
    same = math.dist(starts[0], ends[0]) == 0.0
    segment = shapely.Point(starts[0]) if same else shapely.LineString([starts[0], ends[0]])
    cut = line.intersection(segment.buffer(radius, quad_segs=4096))
    found = taken((0.0, 0.0), tangent, tuple(starts[0]), tuple(ends[0]), radius)
    length = 0.0 if found is None else found[1] - found[0]
    assert length == pytest.approx(cut.length, abs=3e-2 if cut.length < 0.1 else 1e-3)


# --- recognition ------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(40))
def test_what_is_certain_is_the_kernel(seed: int) -> None:
    """Of the goal, exactly the kernel; of the kernel, all, by a margin that is not negative."""
    scene, errors = scene_of(seed)
    space, near = scene.space, scene.space.tolerance
    position = Random(seed).choice((0.0, 0.2, 0.5, math.inf))
    errors = Uncertainty(errors.control, position, errors.force_angle, errors.force_thresholds)
    theirs = readings(space.contact, scene.direction, errors, scene.friction, near)
    own = reading_sets(space.contact, scene.direction, errors, scene.friction, near.angle)
    core = kernel(space, theirs, scene.target, errors)
    all_of_it = recognised(space, own, scene.target, core, position)
    assert regions.is_subset(core, all_of_it.region, near)
    assert all_of_it.margin >= 0.0
    assert not all_of_it.confusions
    best = recognised(space, own, scene.target, scene.target, position).region
    # the kernel is cut a tolerance further away: where lines just touch discs that is a bit more
    left = contact_set.difference(best.contact, core.contact, 1e-4)
    assert not len(left.edge)
    assert left.vertices.tolist() == []
    # arcs are replaced on the safe side
    assert areas.difference(best.area, core.area).measure <= 0.02 * position**2 * 40 + 1e-6


def test_a_floor_in_a_domain_that_holds_no_other() -> None:
    space = space_of([shapely.box(-10, -10, 10, 0)])
    floor = edge_at(space, 0, 0)
    middle = float(space.contact.length[floor]) / 2.0
    goal = Region(Area.empty(), contact(space, [(floor, middle - 2.0, middle + 2.0)]))
    own = reading_sets(space.contact, DOWN, SENSES, FRICTION, space.tolerance.angle)
    found = recognised(space, own, goal, goal, 0.5)
    assert found.region.contact.total_length == pytest.approx(2.0, abs=1e-6)
    assert found.margin == 0.0
    (confusion,) = found.confusions
    assert (confusion.feature, confusion.other) == (floor, floor)
    assert confusion.distance == pytest.approx(0.0, abs=1e-6)
    inner = Region(Area.empty(), contact(space, [(floor, middle - 0.5, middle + 0.5)]))
    assert recognised(space, own, goal, inner, 0.5).margin == pytest.approx(0.5, abs=1e-6)
    known = recognised(space, own, goal, goal, 0.5, goal)
    assert known.region.contact.total_length == pytest.approx(4.0)
    assert known.margin == math.inf


def test_nothing_is_certain_without_sensors() -> None:
    scene = random_scene(Random(3))
    blind = Uncertainty(scene.control, math.inf)
    near = scene.space.tolerance.angle
    own = reading_sets(scene.space.contact, scene.direction, blind, scene.friction, near)
    assert recognised(scene.space, own, scene.target, scene.target, math.inf).region.is_empty
