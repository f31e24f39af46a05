"""What goes on a robot: it ends in the goal and knows it, or says what broke, and never lies."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.errors import PlanFileError
from preimage.execution.assumptions import Assumption
from preimage.execution.executor import Answer, Doing, Executor, felt
from preimage.execution.history import SLOTS, History
from preimage.execution.program import Program, compiled
from preimage.geometry.area import Area
from preimage.recognition.termination import ReadingCondition
from preimage.search.planner import plan
from preimage.strategy.strategy import Status, Strategy, StrategyRegion
from preimage.task.examples import named_task
from preimage.task.initial import InitialPolygon
from preimage.task.options import Method
from tests.execution.driving import drive, holds
from tests.laws.tasks import random_task

DOWN = math.radians(270)
UP = math.radians(90)

Reading = tuple[float, float, float, float | None]


def planned(name: str, method: Method = Method.COMBINED) -> Strategy:
    task = named_task(name)
    return plan(replace(task, options=replace(task.options, method=method)))


COMBINED, STICKING, KERNEL = (
    compiled(planned("flat-floor", method))
    for method in (Method.COMBINED, Method.STICKING, Method.KERNEL)
)
"""A goal from -2 to 2 on a floor, the start at (0, 5); rho 0.1, theta 10 degrees."""

BLIND = compiled(planned("blind-corner"))


def fed(program: Program, readings: Iterable[Reading]) -> tuple[Executor, Answer]:
    """An executor after readings, which all but the last leave moving."""
    executor = Executor(program)
    answer = executor.start(0.0, 0.0, 5.0)
    for reading in readings:
        assert answer.doing is Doing.MOVING, answer
        answer = executor.read(*reading)
    return executor, answer


def falling(until: float, step: float = 0.25) -> list[Reading]:
    """Straight down from the start."""
    return [(t, 0.0, 5.0 - t, None) for t in np.arange(step, until + 1e-9, step).tolist()]


# --- the way it should be -----------------------------------------------------------------------


def test_the_start_commands_the_first_motion() -> None:
    answer = Executor(COMBINED).start(0.0, 0.0, 5.0)
    assert answer.doing is Doing.MOVING
    assert answer.command == pytest.approx(DOWN)
    assert answer.region == COMBINED.strategy.start[0]
    assert answer.broken is None


def test_contact_is_read_and_ends_the_motion_at_once() -> None:
    executor, answer = fed(COMBINED, [*falling(4.75), (5.0, 0.03, 0.02, UP)])
    assert answer == Answer(Doing.DONE, None, 0, None, "in the goal")
    assert executor.read(9.0, 0.0, 3.0, None) is answer
    assert executor.start(10.0, 0.0, 5.0) is answer


def test_standing_still_for_the_period_ends_the_motion() -> None:
    motion = next(iter(STICKING.motions.values()))
    assert motion.sticking is not None
    period = motion.sticking.period
    resting = [(5.0 + t, 0.0, 0.02, UP) for t in np.arange(0.0, 3.0, 0.01).tolist()]
    executor, answer = Executor(STICKING), None
    executor.start(0.0, 0.0, 5.0)
    for reading in [*falling(4.75), *resting]:
        answer = executor.read(*reading)
        if answer.doing is not Doing.MOVING:
            break
    assert answer is not None
    assert answer.doing is Doing.DONE
    # what is read before the robot rests is far away, but for the condition's distance
    assert 5.0 + period - motion.sticking.distance <= reading[0] <= 5.0 + period + 0.02


def test_the_clock_ends_a_motion_without_sensors() -> None:
    (motion,) = BLIND.motions.values()
    assert motion.elapsed is not None
    executor = Executor(BLIND)
    assert executor.start(7.0, math.nan, math.nan).doing is Doing.MOVING
    before = executor.read(7.0 + 0.999 * motion.elapsed.period, math.nan, math.nan, None)
    assert before.doing is Doing.MOVING
    after = executor.read(7.0 + motion.elapsed.period, math.nan, math.nan, None)
    assert after.doing is Doing.DONE


def test_answers_are_made_ahead() -> None:
    executor, answer = fed(COMBINED, falling(1.0))
    assert executor.read(1.5, 0.0, 3.5, None) is answer


def test_the_first_reading_may_come_with_the_start() -> None:
    executor = Executor(COMBINED)
    executor.start(3.0, 0.0, 5.0)
    assert executor.read(3.0, 0.01, 5.01, None).doing is Doing.MOVING
    assert executor.read(3.0, 0.0, 5.0, None).broken is Assumption.READING


NAMED = ("peg-in-hole", "connector", "cradle", "rails", "example-3", "figure-9b", "landmark-edge")
PROGRAMS: dict[str, Program] = {}


def program_of(name: str) -> Program:
    if name not in PROGRAMS:
        PROGRAMS[name] = compiled(planned(name))
    return PROGRAMS[name]


def carried_out(name: str, seeds: Sequence[int]) -> None:
    program = program_of(name)
    strategy = program.strategy
    xmin, _, xmax, _ = strategy.space.window
    for seed in seeds:
        run = drive(program, seed, (xmax - xmin) / (600.0, 2000.0)[seed % 2])
        assert run.answer.doing is Doing.DONE, (name, seed, run.answer)
        assert holds(strategy.space, strategy.region(0).region, run.robots), (name, seed)
        assert run.regions == (*strategy.steps, 0)


@pytest.mark.parametrize("name", NAMED)
def test_it_ends_in_the_goal_under_any_errors(name: str) -> None:
    carried_out(name, range(3))


@pytest.mark.slow
@pytest.mark.parametrize("name", [*NAMED, "cluttered-hall", "example-4", "figure-6", "l-room"])
def test_it_ends_in_the_goal_many_times(name: str) -> None:
    carried_out(name, range(3, 60))


def carried_out_at_random(seeds: range) -> None:
    """Random tasks: done means in the goal; who looks rarely may miss a thin target, and stops."""
    done, broken = 0, 0
    for seed in seeds:
        task = random_task(Random(seed))
        options = replace(task.options, time_limit=1.0, max_steps=3)
        strategy = plan(replace(task, options=options))
        if strategy.status is not Status.SOLVED or not strategy.steps:
            continue
        xmin, _, xmax, _ = strategy.space.window
        run = drive(compiled(strategy), seed, (xmax - xmin) / 400.0)
        if run.answer.doing is Doing.DONE:
            assert holds(strategy.space, strategy.region(0).region, run.robots), seed
            done += 1
        else:
            assert run.answer.broken in (Assumption.CONTROL, Assumption.TIME, None), (seed, run)
            broken += 1
    assert done > 0
    assert broken <= 1 + 0.02 * done


def test_it_ends_in_the_goal_of_random_tasks() -> None:
    carried_out_at_random(range(40))


@pytest.mark.slow
def test_it_ends_in_the_goal_of_many_random_tasks() -> None:
    carried_out_at_random(range(40, 1_000))


# --- what breaks --------------------------------------------------------------------------------


@pytest.mark.parametrize("place", [(0.2, 5.0), (0.0, 4.8), (1e9, 0.0), (math.inf, 5.0)])
def test_a_start_elsewhere(place: tuple[float, float]) -> None:
    executor = Executor(COMBINED)
    answer = executor.start(0.0, *place)
    expected = Assumption.START if math.isfinite(place[0]) else Assumption.READING
    assert (answer.doing, answer.broken, answer.command) == (Doing.BROKEN, expected, None)
    assert executor.read(1.0, 0.0, 5.0, None) is answer


MALFORMED: list[tuple[object, object, object, object]] = [
    (1.0, math.nan, 4.0, None),
    (1.0, 0.0, math.inf, None),
    (1.0, 0.0, 4.0, math.nan),
    (1.0, 0.0, 4.0, -math.inf),
    (math.nan, 0.0, 4.0, None),
    (math.inf, 0.0, 4.0, None),
    (-1.0, 0.0, 4.0, None),
    (1.0, "a", 4.0, None),
    (1.0, 0.0, None, None),
    (1.0, 0.0, 4.0, "push"),
    (10**400, 0.0, 4.0, None),
    (1.0, [0.0], 4.0, None),
]


@pytest.mark.parametrize("reading", MALFORMED, ids=str)
def test_what_is_no_reading(reading: tuple[float, float, float, float]) -> None:
    executor, answer = fed(COMBINED, [reading])
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.READING)
    assert answer.command is None
    assert "\n" not in answer.words
    assert executor.read(1.0, 0.0, 4.0, None) is answer


def test_time_that_stands_still_or_goes_back() -> None:
    for late in (1.0, 0.5):
        _, answer = fed(COMBINED, [(1.0, 0.0, 4.0, None), (late, 0.0, 4.0, None)])
        assert answer.broken is Assumption.READING
        assert "time" in answer.words


def test_a_reading_before_the_start_and_two_starts() -> None:
    assert Executor(COMBINED).read(0.0, 0.0, 5.0, None).broken is Assumption.READING
    executor = Executor(COMBINED)
    executor.start(0.0, 0.0, 5.0)
    assert executor.start(0.0, 0.0, 5.0).broken is Assumption.READING
    assert executor.read(1.0, 0.0, 4.0, None).doing is Doing.BROKEN


def test_a_position_inside_the_floor() -> None:
    _, answer = fed(COMBINED, [*falling(5.0), (5.4, 0.0, -0.25, UP)])
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.POSITION)


def test_a_push_in_the_air() -> None:
    _, answer = fed(COMBINED, [*falling(2.0), (2.25, 0.0, 2.75, UP)])
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.FORCE)


def test_a_push_from_above() -> None:
    _, answer = fed(COMBINED, [*falling(4.75), (5.0, 0.0, 0.02, DOWN)])
    assert answer.broken is Assumption.FORCE


def test_a_robot_that_is_too_fast() -> None:
    _, answer = fed(COMBINED, [*falling(1.0), (1.25, 0.0, 3.0, None)])
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.SPEED)


def test_a_robot_that_is_a_little_too_fast_all_the_time() -> None:
    fast = [(t, 0.0, 5.0 - 1.1 * t, None) for t in np.arange(0.05, 3.0, 0.05).tolist()]
    executor = Executor(COMBINED)
    executor.start(0.0, 0.0, 5.0)
    for reading in fast:
        answer = executor.read(*reading)
        if answer.doing is Doing.BROKEN:
            break
    assert answer.broken is Assumption.SPEED
    assert 2.0 <= reading[0] <= 2.1  # 0.1 t exceeds 2 rho


def test_a_robot_that_drifts_out_of_its_region() -> None:
    turn = math.radians(30)
    executor = Executor(COMBINED)
    executor.start(0.0, 0.0, 5.0)
    for t in np.arange(0.05, 5.0, 0.05).tolist():
        answer = executor.read(t, t * math.sin(turn), 5.0 - t * math.cos(turn), None)
        if answer.doing is Doing.BROKEN:
            break
    assert answer.broken is Assumption.CONTROL
    assert 3.0 < t < 4.0  # at x = 2 - y tan 10 degrees, and rho further


def test_touching_what_is_not_in_the_region() -> None:
    """The place fits a fall beside the goal, the push only the floor there."""
    executor = Executor(branching(0.0, 0.3))
    executor.start(0.0, -0.9, 4.5)
    for step in range(1, 10):
        assert executor.read(0.5 * step, -0.9 - 0.3 * step, 4.5 - 0.4 * step, None).command
    touching = (6.0, -3.9, 0.02)
    assert executor.read(*touching, None).doing is Doing.MOVING
    answer = executor.read(6.1, *touching[1:], UP)
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.CONTROL)
    assert "push" in answer.words


def test_a_domain_that_does_not_hold_the_robot() -> None:
    """What no reading of a domain can give would be contained in any goal."""
    strategy = COMBINED.strategy
    goal, first = strategy.regions
    motion = first.motion
    assert motion is not None
    domain = Region(Area.box(-0.5, 3.0, 0.5, 6.0), ContactSet.empty())
    known = replace(motion, termination=(ReadingCondition(domain),))
    program = compiled(replace(strategy, regions=(goal, replace(first, motion=known))))
    _, answer = fed(program, falling(2.0))
    assert answer.doing is Doing.MOVING
    _, answer = fed(program, falling(2.25))
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.CONTROL)


def test_standing_still_in_the_air() -> None:
    executor, answer = fed(STICKING, falling(2.0))
    for t in np.arange(2.05, 6.0, 0.05).tolist():
        answer = executor.read(t, 0.0, 3.0, None)
        if answer.doing is not Doing.MOVING:
            break
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.FRICTION)


def test_never_arriving() -> None:
    (motion,) = KERNEL.motions.values()
    assert motion.sticking is None
    executor, answer = fed(KERNEL, falling(2.0))
    for t in np.arange(2.1, 40.0, 0.1).tolist():
        answer = executor.read(t, 0.0, 3.0, None)
        if answer.doing is not Doing.MOVING:
            break
    assert (answer.doing, answer.broken) == (Doing.BROKEN, Assumption.TIME)
    assert motion.longest < t < motion.longest + 1.0


def test_a_frozen_position_is_no_success() -> None:
    """The robot falls on, its position sensor says that it stands still."""
    for program in (COMBINED, STICKING):
        executor = Executor(program)
        executor.start(0.0, 0.0, 5.0)
        for t in np.arange(0.05, 20.0, 0.05).tolist():
            answer = executor.read(t, 0.0, 5.0, UP if t >= 5.0 else None)
            if answer.doing is not Doing.MOVING:
                break
        assert answer.doing is Doing.BROKEN


def test_a_plan_that_is_not_solved_is_refused() -> None:
    strategy = COMBINED.strategy
    for status in (Status.UNSOLVABLE, Status.STOPPED):
        with pytest.raises(PlanFileError, match=rf"status: is {status.value}"):
            Executor(replace(strategy, status=status))


numbers = st.one_of(
    st.floats(-20.0, 20.0), st.floats(), st.none(), st.sampled_from([0.0, 5.0, UP, DOWN, math.nan])
)


@given(st.lists(st.tuples(numbers, numbers, numbers, numbers), max_size=12))
@settings(max_examples=150)
def test_a_strangers_readings(readings: list[tuple[float, float, float, float]]) -> None:
    """Whatever comes, an answer comes back; only a push by the floor in the goal is success."""
    executor = Executor(COMBINED)
    executor.start(0.0, 0.0, 5.0)
    for reading in readings:
        answer = executor.read(*reading)
        if answer.doing is Doing.DONE:
            _, x, y, force = reading
            assert abs(y) < 0.1
            assert abs(x) < 1.9 + 1e-6
            assert force is not None
            assert abs(math.remainder(force - UP, math.tau)) < math.radians(10 + 10 + 1)
        assert (answer.command is None) == (answer.doing is not Doing.MOVING)
        assert (answer.broken is None) == (answer.doing is not Doing.BROKEN)


# --- branching ----------------------------------------------------------------------------------


def branching(cut: float, overlap: float) -> Strategy:
    """From a wide start two regions for the same motion, left and right of a line."""
    strategy = COMBINED.strategy
    corners = ((-1.0, 4.0), (1.0, 4.0), (1.0, 5.0), (-1.0, 5.0))
    task = replace(strategy.task, initial=InitialPolygon(corners))
    goal, first = strategy.region(0), strategy.region(strategy.steps[0])
    motion = first.motion
    assert motion is not None
    sides = (Area.box(-9, 0, cut + overlap, 9), Area.box(cut - overlap, 0, 9, 9))
    regions = [
        StrategyRegion(number, rank, Region(area, first.region.contact), motion)
        for number, rank, area in ((1, 2, sides[0]), (2, 1, sides[1]))
    ]
    return replace(strategy, task=task, regions=(goal, *regions), start=(1, 2), steps=())


@pytest.mark.parametrize(("x", "region"), [(-0.8, 1), (0.0, 2), (0.8, 2), (-0.19, 1), (-0.18, 2)])
def test_the_position_chooses_the_first_region(x: float, region: int) -> None:
    """Of those that hold every start near enough, the one of least rank."""
    x -= 0.015  # the second region surely holds the robot from -0.2 on, on its border not
    answer = Executor(branching(0.0, 0.3)).start(0.0, x, 4.5)
    assert (answer.doing, answer.region) == (Doing.MOVING, region)


def test_a_position_that_tells_no_region() -> None:
    answer = Executor(branching(0.0, 0.05)).start(0.0, 0.0, 4.5)
    assert answer.broken is Assumption.START
    assert "no region" in answer.words


def test_a_start_region_is_checked() -> None:
    for place in ((0.0, 5.11), (1.2, 4.5), (-3.0, 0.0)):
        answer = Executor(branching(0.0, 0.3)).start(0.0, *place)
        assert answer.broken is Assumption.START
    assert Executor(branching(0.0, 0.3)).start(0.0, 0.5, 5.09).doing is Doing.MOVING


def test_a_start_in_the_goal_is_done() -> None:
    strategy = replace(COMBINED.strategy, start=(0,), steps=())
    assert Executor(strategy).start(0.0, 0.0, 5.0).doing is Doing.DONE


# --- parts --------------------------------------------------------------------------------------


def test_felt() -> None:
    assert felt(0.03, 0.04, 0.05) is None
    assert felt(-1.0, 0.0, 0.05) == math.pi
    assert math.isnan(felt(math.nan, 0.0, 0.05) or 0.0)
    assert math.isnan(felt(math.inf, 0.0, 0.05) or 0.0)


@given(st.lists(st.floats(1e-4, 2.0), min_size=1, max_size=600), st.floats(0.1, 5.0))
def test_history_remembers_a_reading_from_before_the_period(
    steps: list[float], period: float
) -> None:
    history, times, now = History(), [0.0], 0.0
    history.begin(period)
    history.add(0.0, 0.0, 0.0)
    for step in steps:
        now += step
        times.append(now)
        history.add(now, now, -now)
        found = history.before(now - period)
        known = [time for time in times if time <= now - period]
        if not known:
            assert found is None
        else:
            assert found is not None
            assert found[0] == -found[1]
            assert found[0] in known
            assert found[0] >= known[-1] - period / (SLOTS - 2) - 1e-12


def test_history_needs_no_more_room_at_any_rate() -> None:
    history = History()
    history.begin(1.0)
    for step in range(20_000):
        history.add(1e-4 * step, 1e-4 * step, 0.0)
        if step % 7 == 0:
            history.before(1e-4 * step - 1.0)
    found = history.before(2.0 - 1e-4 - 1.0)
    assert found is not None
    assert 0.99 < found[0] <= 1.0


@pytest.mark.parametrize("value", ["1", None, [], b"1", 1j, 10**400, math.nan, math.inf])
def test_a_force_that_is_no_number_is_not_felt_as_one(value: object) -> None:
    told = felt(value, 0.0, 0.1)  # type: ignore[arg-type]  # whatever a driver hands over
    assert told is not None
    assert math.isnan(told)


HOSTILE = [
    ("1.5", -2.5, 2.5, None), (None, -2.5, 2.5, None), (math.nan, -2.5, 2.5, None),
    (math.inf, -2.5, 2.5, None), (10**400, -2.5, 2.5, None), (1.4, -2.5, 2.5, None),
    (0.3, -2.5, 2.5, None), (1e308, -2.5, 2.5, None), (1.5, math.nan, 2.5, None),
    (1.5, math.inf, 2.5, None), (1.5, 1e300, 2.5, None), (1.5, "a", [], None),
    (1.5, 10**400, 2.5, None), (1.5, -2.5, 2.5, math.nan), (1.5, -2.5, 2.5, math.inf),
    (1.5, -2.5, 2.5, "up"), (1.5, -2.5, 2.5, 1j),
]  # fmt: skip


@pytest.mark.parametrize("reading", HOSTILE, ids=repr)
def test_a_hostile_reading_on_the_way_stops_the_robot(reading: tuple[Any, ...]) -> None:
    executor = Executor(compiled(plan(named_task("peg-in-hole"))))
    executor.start(0.0, -4.0, 2.5)
    for step in range(1, 15):
        answer = executor.read(0.1 * step, -4.0 + 0.1 * step, 2.5, None)
        assert answer.doing is Doing.MOVING
    answer = executor.read(*reading)
    assert answer.doing is Doing.BROKEN
    assert answer.command is None
    assert answer.broken is not None
    assert executor.read(99.0, 0.0, -3.0, math.pi / 2) is answer
