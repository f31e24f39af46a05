"""The compiled reading condition gives the answers of the plain one, to the last bit."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.execution.cells import FEW, ReadingCells, reading_cells
from preimage.geometry.area import Area
from preimage.recognition.interpretation import Interpretation, contained
from preimage.recognition.kernel import kernel
from preimage.recognition.outside import Outside, outside
from preimage.recognition.readings import Readings, readings
from preimage.task.examples import named_task, named_tasks
from preimage.task.uncertainty import Uncertainty
from tests.recognition.cases import random_case, seeds
from tests.strategies import space_of

RADII = (0.1, 0.3, 2.0, 0.0, math.inf)
SENSORS = (
    Uncertainty(0.1, 0.3, math.radians(10), (0.05, 0.05)),
    Uncertainty(0.3, 0.3, 0.0, (0.0, 0.5)),
    Uncertainty(0.0, 0.3, 0.0, (0.0, 0.0)),
    Uncertainty(0.1, 0.3),  # no force sensor
)

Question = tuple[np.ndarray, np.ndarray]


def questions(
    space: ConfigurationSpace, sets: Readings, radius: float, rng: np.random.Generator, count: int
) -> Question:
    """Readings anywhere, on features and their ends, on offset curves, at ends of reading sets."""
    contact = space.contact
    margin = space.tolerance.length
    reach = margin if radius == 0.0 else 1.0 if math.isinf(radius) else radius + 0.5 * margin
    edge = rng.integers(0, len(contact), count)
    normal = np.stack((np.cos(contact.normal[edge]), np.sin(contact.normal[edge])), axis=1)
    turn = rng.uniform(0.0, math.tau, count)
    around = np.stack((np.cos(turn), np.sin(turn)), axis=1)
    on = contact.points[edge] + rng.random((count, 1)) * (
        contact.length[edge, None] * contact.tangent[edge]
    )
    xmin, ymin, xmax, ymax = space.window
    choices = (
        rng.uniform((xmin - reach, ymin - reach), (xmax + reach, ymax + reach), (count, 2)),
        on,
        contact.points[edge],
        on + reach * normal,
        contact.points[edge] + reach * around,
        contact.points[edge] + margin * rng.normal(size=(count, 2)),
    )
    place = np.choose(rng.integers(0, len(choices), count)[:, None], choices)
    feature = rng.integers(0, len(sets.zero), count)
    half = np.where(sets.half >= 0.0, sets.half, 0.0)[feature]
    end = sets.center[feature] + rng.choice((-1.0, 1.0), count) * (
        half + sets.tolerance * rng.choice((-1.0, 0.0, 1.0), count)
    )
    end = np.where(
        np.abs(end) > math.pi, end - math.copysign(1.0, 1.0) * math.tau * np.sign(end), end
    )
    kind = rng.integers(0, 4, count)
    force = np.select((kind == 0, kind == 1), (end, rng.uniform(-math.pi, math.pi, count)), np.nan)
    return place, np.clip(force, -math.pi, math.pi)


def plainly(
    space: ConfigurationSpace, sets: Readings, rest: Outside, radius: float, asked: Question
) -> Iterator[bool]:
    for (x, y), force in zip(asked[0].tolist(), asked[1].tolist(), strict=True):
        features = sets.can_read(None if math.isnan(force) else force)
        yield contained(space, sets, Interpretation((x, y), radius, features), rest)


def compare(
    space: ConfigurationSpace,
    sets: Readings,
    rest: Outside,
    radius: float,
    rng: np.random.Generator,
    count: int,
) -> ReadingCells:
    cells = reading_cells(space, sets, rest, radius)
    asked = questions(space, sets, radius, rng, count)
    got = cells.misses_all(*asked)
    expected = np.fromiter(plainly(space, sets, rest, radius, asked), dtype=np.bool_)
    wrong = np.flatnonzero(got != expected)
    assert not len(wrong), (radius, asked[0][wrong[0]], asked[1][wrong[0]], expected[wrong[0]])
    return cells


@given(seeds)
@settings(max_examples=30)
def test_same_answers_in_random_scenes(seed: int) -> None:
    case, rng = random_case(seed), np.random.default_rng(seed)
    rest = outside(case.space, case.target, case.domain)
    for radius in (case.senses.position, 0.0, math.inf):
        compare(case.space, case.readings, rest, radius, rng, 60)


@given(seeds)
@settings(max_examples=15)
def test_same_answers_for_a_set_that_holds_the_robot(seed: int) -> None:
    case, rng = random_case(seed), np.random.default_rng(seed)
    for region in (case.target, case.kernel):
        rest = Outside(region.area, region.contact)
        for radius in (case.senses.position, 0.0, math.inf):
            compare(case.space, case.readings, rest, radius, rng, 40)


def compare_named(name: str, count: int) -> int:
    task = named_task(name)
    space = configuration_space(task)
    goal = goal_region(task, space)
    rng = np.random.default_rng(len(name))
    asked = 0
    for senses in (task.uncertainty, *SENSORS):
        for degrees in (270, 37):
            direction = math.radians(degrees)
            sets = readings(space.contact, direction, senses, task.friction, space.tolerance)
            core = kernel(space, sets, goal, senses)
            rests = (outside(space, goal), outside(space, core), outside(space, core, goal))
            for number, rest in enumerate(rests):
                radii = (*RADII, task.uncertainty.position)
                radius = radii[(number + degrees + len(name)) % len(radii)]
                for own in (radius, task.uncertainty.position):
                    compare(space, sets, rest, own, rng, count)
                    asked += count
    return asked


@pytest.mark.parametrize("name", ["connector", "cradle", "rails", "figure-9b", "example-3"])
def test_same_answers_in_named_tasks(name: str) -> None:
    compare_named(name, 12)


@pytest.mark.slow
def test_same_answers_to_very_many_readings() -> None:
    asked = sum(compare_named(name, 90) for name in [*named_tasks(), "hall-9", "comb-6"])
    assert asked >= 100_000


@pytest.mark.parametrize("radius", RADII)
def test_one_answer_a_call_is_the_same(radius: float) -> None:
    task = named_task("peg-in-hole")
    space = configuration_space(task)
    sets = readings(space.contact, -1.5, SENSORS[0], task.friction, space.tolerance)
    rest = outside(space, goal_region(task, space))
    cells = reading_cells(space, sets, rest, radius)
    places, forces = questions(space, sets, radius, np.random.default_rng(1), 200)
    forces = np.concatenate((forces, forces + math.tau))  # any turn of an angle
    places = np.concatenate((places, places))
    every = cells.misses_all(places, forces)
    for (x, y), force, expected in zip(places.tolist(), forces.tolist(), every, strict=True):
        assert cells.misses(x, y, force) == expected
        if math.isnan(force):
            assert cells.misses(x, y, None) == expected


def floor() -> tuple[ConfigurationSpace, Readings]:
    space = configuration_space(named_task("flat-floor"))
    return space, readings(space.contact, -math.pi / 2, SENSORS[0], 0.3, space.tolerance)


def test_what_is_no_reading_is_not_accepted() -> None:
    space, sets = floor()
    cells = reading_cells(space, sets, outside(space, Region.empty()), 0.1)
    for place in ((math.nan, 0.0), (0.0, math.nan), (math.nan, math.nan)):
        assert not cells.misses(*place, None)
        assert not cells.misses(*place, 1.0)
    assert not cells.misses(0.0, 0.0, math.inf)
    assert cells.misses(1e300, -1e300, None)
    assert cells.misses(math.inf, 0.0, None)


@pytest.mark.parametrize("radius", RADII)
def test_nothing_outside_is_always_missed(radius: float) -> None:
    space, sets = floor()
    cells = reading_cells(space, sets, Outside(Area.empty(), ContactSet.empty()), radius)
    for force in (None, 0.0, math.pi / 2, -math.pi):
        assert cells.misses(0.0, 0.0, force)
        assert cells.misses(3.0, 1.0, force)


def test_without_a_position_the_place_does_not_count() -> None:
    space, sets = floor()
    rest = outside(space, Region(space.free, ContactSet.empty()))
    cells = reading_cells(space, sets, rest, math.inf)
    for x, y in ((math.nan, math.nan), (0.0, 3.0), (math.inf, -math.inf)):
        assert cells.misses(x, y, None)
        assert not cells.misses(x, y, math.pi / 2)


@pytest.mark.parametrize("radius", [-1.0, math.nan])
def test_radii_that_are_none(radius: float) -> None:
    space, sets = floor()
    with pytest.raises(ValueError, match="radius"):
        reading_cells(space, sets, Outside(Area.empty(), ContactSet.empty()), radius)


def test_borders_that_touch_and_holes_inside_holes() -> None:
    """Inside or not is told right wherever the border is far, however it winds."""
    space = space_of([])
    rings = [Area.box(-5, -5, 5, 5), Area.box(-3, -3, 3, 3), Area.box(-1, -1, 1, 1)]
    rings[0] = Area.of(rings[0].geometry.difference(rings[1].geometry))
    diamond = Area.polygon(np.array([(-3.0, 0.0), (0.0, -2.0), (3.0, 0.0), (0.0, 2.0)]))
    area = Area.of(rings[0].geometry.union(rings[2].geometry))
    touching = Area.of(rings[0].geometry.union(diamond.geometry))
    sets = readings(space.contact, 0.0, SENSORS[0], 0.3, space.tolerance)
    rng = np.random.default_rng(3)
    for rest in (area, touching):
        for radius in (1e-3, 0.2, 0.0):
            compare(space, sets, Outside(rest, ContactSet.empty()), radius, rng, 500)


@pytest.mark.parametrize("radius", [0.05, 0.3, 30.0])
def test_few_segments_are_looked_at_and_memory_is_linear(radius: float) -> None:
    sizes = []
    for name in ("hall-20", "hall-80"):
        task = named_task(name)
        space = configuration_space(task)
        sets = readings(space.contact, 0.3, SENSORS[0], task.friction, space.tolerance)
        cells = reading_cells(space, sets, outside(space, goal_region(task, space)), radius)
        assert cells.most_looked_at <= FEW
        sizes.append(cells.memory / len(space.contact))
    assert sizes[1] < 3.0 * sizes[0]


def test_thousands_of_parts_in_one_place_are_cut_to_an_end() -> None:
    """All offset curves within one narrow ring: cutting stops at its bound."""
    task = named_task("saw-tooth-150")
    space = configuration_space(task)
    sets = readings(space.contact, 0.3, SENSORS[1], task.friction, space.tolerance)
    rest = outside(space, goal_region(task, space))
    rng = np.random.default_rng(5)
    cells = compare(space, sets, rest, 1e4, rng, 50)
    assert cells.memory < 2e7
