"""Adversaries keep within the errors' bounds, and forces are those of the rules."""

import math
from dataclasses import replace
from random import Random

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.errors import InputError
from preimage.execution.contact_forces import contact_forces
from preimage.execution.control import CONTROLS, Control, by_contact, constant, mixed
from preimage.execution.nearest import outline
from preimage.execution.sensing import SENSINGS, read
from preimage.execution.simulator import Choices, Robots, Simulator
from preimage.execution.situation import LOTS, Conditions, Situation
from preimage.geometry.angles import wrap
from preimage.geometry.area import Area
from preimage.task.uncertainty import Uncertainty
from tests.execution.scenes import somewhere, state_of
from tests.laws.world import World
from tests.strategies import Scene, random_scene, space_of

INFINITE = math.inf


def situation(seed: int, **bounds: float) -> tuple[Situation, Scene]:
    rng = Random(seed)
    scene = random_scene(rng)
    space = scene.space
    senses = Uncertainty(
        bounds.get("control", scene.control),
        bounds.get("position", rng.choice((0.0, 0.3, INFINITE))),
        rng.choice((0.0, 0.2)),
        rng.choice(((0.1, 0.1), (0.2, 0.6), (0.0, 0.0), (INFINITE, INFINITE))),
    )
    robots = somewhere(space, rng, 8)
    count = len(robots)
    motion = Conditions(
        Simulator.of(space, scene.friction, watched=scene.target),
        scene.direction,
        senses,
        scene.target,
        outline(space.contact, scene.target),
    )
    generator = np.random.default_rng(seed)
    return (
        Situation(
            motion,
            robots,
            np.zeros(count),
            generator.random((count, LOTS)),
            np.arange(count, dtype=np.int32) % 3,
            generator,
        ),
        scene,
    )


@pytest.mark.parametrize("name", CONTROLS)
@given(seed=st.integers(0, 10**6))
@settings(max_examples=15, deadline=None)
def test_control_stays_within_the_cone(name: str, seed: int) -> None:
    now, scene = situation(seed)
    choices = CONTROLS[name](now)
    off = np.abs(wrap(choices.angle - scene.direction))
    if scene.control > 0.0:
        assert np.all(off < scene.control)
    else:
        assert np.all(off <= 1e-12)
    assert np.all(choices.duration > 0.0)
    assert np.all((choices.chance >= 0.0) & (choices.chance < 1.0))
    assert len(choices.angle) == len(now)


@pytest.mark.parametrize("name", SENSINGS)
@given(seed=st.integers(0, 10**6))
@settings(max_examples=15, deadline=None)
def test_readings_are_within_the_errors_of_a_force_that_the_rules_allow(
    name: str, seed: int
) -> None:
    now, scene = situation(seed)
    senses = now.motion.uncertainty
    angle = scene.direction + now.cone * (2.0 * now.chance() - 1.0)
    positions, forces = read(SENSINGS[name], now, angle)
    if senses.has_position_sensor:
        off = np.hypot(*(positions - now.robots.places).T)
        assert np.all(off <= senses.position)
        if senses.position > 0.0:
            assert np.all(off < senses.position)
    else:
        assert np.all(np.isnan(positions))
    world = World(scene.space, scene.friction)
    low, high = senses.force_thresholds
    for i in range(len(now)):
        allowed = world.forces(state_of(scene.space, now.robots, i), float(angle[i]))
        if math.isnan(forces[i]):
            assert any(force.magnitude <= high for force in allowed)
        else:
            assert any(
                force.magnitude > low - 1e-12
                and abs(wrap(forces[i] - force.angle)) <= senses.force_angle + 1e-9
                for force in allowed
            )


@given(seed=st.integers(0, 10**6))
@settings(max_examples=60, deadline=None)
def test_every_force_of_the_rules_occurs_and_no_other(seed: int) -> None:
    now, scene = situation(seed)
    world = World(scene.space, scene.friction)
    angle = scene.direction + now.cone * (2.0 * now.chance() - 1.0)
    met: list[set[int]] = [set() for _ in range(len(now))]
    for chance in (0.0, 0.3, 0.6, 0.9):
        found = contact_forces(now.motion.simulator, now.robots, angle, np.full(len(now), chance))
        for i in range(len(now)):
            allowed = world.forces(state_of(scene.space, now.robots, i), float(angle[i]))
            pushes = [
                (f.magnitude * math.cos(f.angle), f.magnitude * math.sin(f.angle)) for f in allowed
            ]
            here = (found[1][i] * math.cos(found[0][i]), found[1][i] * math.sin(found[0][i]))
            gaps = [math.dist(here, push) for push in pushes]
            assert min(gaps) < 1e-7
            met[i].add(int(np.argmin(gaps)))
            if chance == 0.9:
                distinct = {(round(x, 6), round(y, 6)) for x, y in pushes[: len(allowed)]}
                assert len(met[i]) >= min(len(distinct), 4) or len(allowed) < 3


def test_adversaries_are_put_together() -> None:
    now, _ = situation(3, control=0.3)
    assert np.any(now.touching)
    assert np.any(~now.touching)
    turn = wrap(by_contact(constant(1.0), constant(-1.0))(now).angle - now.motion.direction)
    assert np.all((turn > 0.0) == ~now.touching)
    one_of = mixed(constant(1.0), constant(-1.0))
    sides = {
        float(np.sign(t)) for _ in range(8) for t in wrap(one_of(now).angle - now.motion.direction)
    }
    assert sides == {1.0, -1.0}


def test_one_of_your_own_takes_a_few_lines() -> None:
    def swinging(now: Situation) -> Choices:
        side = np.where(np.floor(2.0 * now.time) % 2 == 0, 1.0, -1.0)
        return now.choices(side * 10.0, duration=0.5)

    own: Control = swinging
    now, scene = situation(5, control=0.3)
    assert np.all(np.abs(wrap(own(now).angle - scene.direction)) < 0.3)


def test_choices_are_brought_back_into_the_cone() -> None:
    now, scene = situation(5, control=0.3)
    count = len(now)
    wild = Choices(
        scene.direction + np.linspace(-3.0, 3.0, count),
        np.full(count, np.inf),
        np.zeros(count, np.uint8),
        np.zeros(count),
    )
    kept = now.admissible(wild)
    assert np.all(np.abs(wrap(kept.angle - scene.direction)) < 0.3)
    for changed in (
        {"angle": np.full(count, np.nan)},
        {"angle": np.zeros(count + 1)},
        {"duration": np.full(count, -1.0)},
        {"duration": np.full(count, np.nan)},
        {"chance": np.full(count, np.nan)},
    ):
        with pytest.raises(InputError, match="adversary"):
            now.admissible(replace(wild, **changed))


def test_hunters_go_for_what_holds() -> None:
    """From beside a goal on a sticking floor, the floor next to it, as far as the cone allows."""
    space = space_of([shapely.box(-6.0, -6.0, 6.0, -2.0)])
    contact = space.contact
    floor = next(edge for edge in contact.edges.tolist() if contact.length[edge] > 11.0)
    goal = Region(Area.empty(), ContactSet.of([floor], [5.0], [7.0], [], space.tolerance.length))
    senses = Uncertainty(0.2, 0.1)
    motion = Conditions(
        Simulator.of(space, 0.5, watched=goal),
        -0.5 * math.pi,
        senses,
        goal,
        outline(contact, goal),
    )
    robots = Robots.free(contact, np.array([[0.9, -1.0], [-0.9, -1.0]]))
    now = Situation(
        motion,
        robots,
        np.zeros(2),
        np.zeros((2, LOTS)),
        np.zeros(2, np.int32),
        np.random.default_rng(0),
    )
    turn = wrap(CONTROLS["hunting"](now).angle - motion.direction)
    wanted = math.atan2(0.1, 1.0)  # the goal ends at x = 1 and -1
    assert turn.tolist() == pytest.approx([wanted, -wanted], abs=1e-6)
    assert np.all(motion.surely_sticks[floor])
