"""A plan made ready: which condition tells which goal, and what bounds a motion."""

import math
from dataclasses import replace

import numpy as np
import pytest

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.errors import PlanFileError
from preimage.execution.program import Program, compiled, surely_holds
from preimage.geometry.area import Area
from preimage.reachability.sources import sources
from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict
from preimage.strategy.plan_parse import parse_plan
from preimage.strategy.strategy import Motion, Status, Strategy, StrategyRegion
from preimage.task.examples import named_task
from preimage.task.options import Method

UP = math.radians(90)
NAMES = ("flat-floor", "peg-in-hole", "connector", "rails", "example-4", "blind-corner")


def planned(name: str, method: Method = Method.COMBINED) -> Strategy:
    task = named_task(name)
    return plan(replace(task, options=replace(task.options, method=method)))


PROGRAMS: dict[str, Program] = {name: compiled(planned(name)) for name in NAMES}


@pytest.mark.parametrize("status", [Status.UNSOLVABLE, Status.STOPPED])
def test_only_solved_plans(status: Status) -> None:
    strategy = replace(PROGRAMS["flat-floor"].strategy, status=status)
    with pytest.raises(PlanFileError, match=r"^status: is \w+: only a solved plan can be"):
        compiled(strategy)


def test_goals_and_starts_that_are_not_there() -> None:
    strategy = PROGRAMS["flat-floor"].strategy
    goal, first = strategy.regions
    assert first.motion is not None
    astray = replace(first, motion=replace(first.motion, goals=(7,)))
    with pytest.raises(PlanFileError, match="goal 7"):
        compiled(replace(strategy, regions=(goal, astray)))
    for start in ((), (9,)):
        with pytest.raises(PlanFileError, match=r"^start: "):
            compiled(replace(strategy, start=start))


@pytest.mark.parametrize("name", NAMES)
def test_every_motion_is_ready(name: str) -> None:
    program = PROGRAMS[name]
    strategy = program.strategy
    assert set(program.motions) == {region.id for region in strategy.regions} - {0}
    for number, motion in program.motions.items():
        made = strategy.region(number).motion
        assert made is not None
        kinds = {type(condition) for condition in made.termination}
        assert bool(motion.by_reading) == (ReadingCondition in kinds)
        assert (motion.sticking is not None) == (StickingCondition in kinds)
        assert (motion.elapsed is not None) == (ElapsedCondition in kinds)
        rests = bool(kinds - {ReadingCondition})
        assert [told.goal for told in motion.by_rest] == list(made.goals) * rests
        assert all(told.cells is None for told in motion.by_rest)  # with one goal
        assert (motion.resting is not None) == rests
        assert motion.longest > 0.0


@pytest.mark.parametrize("name", NAMES)
def test_what_was_written_and_read_is_the_same_program(name: str) -> None:
    program = PROGRAMS[name]
    again = compiled(parse_plan(plan_to_dict(program.strategy)))
    space = program.strategy.space
    rng = np.random.default_rng(2)
    places = rng.uniform(space.window[:2], space.window[2:], (400, 2))
    forces = np.where(rng.random(400) < 0.5, np.nan, rng.uniform(-math.pi, math.pi, 400))
    for number, motion in program.motions.items():
        other = again.motions[number]
        assert other.longest == pytest.approx(motion.longest)
        pairs = [
            (motion.possible, other.possible),
            *(
                (one.cells, two.cells)
                for one, two in zip(motion.by_reading, other.by_reading, strict=True)
            ),
        ]
        for one, two in pairs:
            assert one is not None
            assert two is not None
            assert np.mean(one.misses_all(places, forces) != two.misses_all(places, forces)) < 0.01


def test_the_longest_time_of_a_fall() -> None:
    """The preimage is 2 / tan theta high, and a fall makes cos theta of its speed downwards."""
    control = math.radians(10)
    high = 2.0 / math.tan(control)
    (motion,) = compiled(planned("flat-floor", Method.KERNEL)).motions.values()
    kernel_high = (2.0 - 2.0 * 0.1) / math.tan(control)
    assert motion.longest == pytest.approx(kernel_high / math.cos(control), rel=1e-6)
    (motion,) = compiled(planned("flat-floor", Method.STICKING)).motions.values()
    assert motion.sticking is not None
    period = motion.sticking.period
    assert motion.longest == pytest.approx(high / math.cos(control) + period, rel=1e-6)


def test_without_sensors_the_clock_is_the_bound() -> None:
    (motion,) = PROGRAMS["blind-corner"].motions.values()
    assert motion.elapsed is not None
    assert motion.longest == motion.elapsed.period


@pytest.mark.parametrize("name", NAMES)
def test_what_may_be_read_in_a_region_is_possible_there(name: str) -> None:
    program = PROGRAMS[name]
    strategy = program.strategy
    rho = min(strategy.task.uncertainty.position, 1e9)
    rng = np.random.default_rng(4)
    for number, motion in program.motions.items():
        points = np.concatenate(strategy.region(number).region.area.rings)
        turn = rng.uniform(0.0, math.tau, len(points))
        off = 0.999999 * rho * np.stack((np.cos(turn), np.sin(turn)), axis=1)
        nothing = np.full(len(points), np.nan)
        assert not np.any(motion.possible.misses_all(points + off, nothing))


def branches() -> Strategy:
    """One motion down to two goals on a floor, recognised by standing still."""
    strategy = planned("flat-floor", Method.STICKING)
    goal, first = strategy.regions
    motion = first.motion
    assert motion is not None
    contact = goal.region.contact
    (edge,) = contact.edge.tolist()
    (low,) = contact.low.tolist()

    def part(begin: float, end: float) -> Region:
        held = ContactSet.of([edge], [low + begin], [low + end], [], 1e-9)
        return Region(Area.empty(), held)

    left, right = StrategyRegion(0, 0, part(0.0, 1.0), None), part(3.0, 4.0)
    onward = Motion(0.0, (0,), part(0.0, 1.0), (ReadingCondition(),))
    both = Region(
        Area.empty(),
        ContactSet.of([edge, edge], [low, low + 3.0], [low + 1.0, low + 4.0], [], 1e-9),
    )
    down = replace(motion, goals=(5, 0), target=both)
    regions = (
        left,
        StrategyRegion(5, 1, right, onward),
        StrategyRegion(6, 2, first.region, down),
    )
    return replace(strategy, regions=regions, start=(6,), steps=())


def test_with_several_goals_the_reading_tells_which_by_rank() -> None:
    motion = compiled(branches()).motions[6]
    assert [told.goal for told in motion.by_rest] == [0, 5]
    left, right = (told.cells for told in motion.by_rest)
    assert left is not None
    assert right is not None
    near = 0.05
    for x, told in ((-2.0, (True, False)), (-1.0, (True, False)), (1.0, (False, True))):
        assert (left.misses(x, near, UP), right.misses(x, near, UP)) == told
    assert motion.resting is not None
    assert not motion.resting.misses(-2.0, near, UP)
    assert motion.resting.misses(0.0, near, UP)
    assert motion.resting.misses(-2.0, 0.5, None)


def test_what_holds_a_motion_for_sure() -> None:
    strategy = PROGRAMS["flat-floor"].strategy
    space, goal = strategy.space, strategy.region(0).region
    found = [
        sources(space.contact, math.radians(angle), 0.1, 0.3, space.tolerance)
        for angle in (270, 300)
    ]
    assert surely_holds(goal, found[0]).contact.total_length == pytest.approx(4.0)
    assert surely_holds(goal, found[1]).is_empty
    assert surely_holds(Region(space.free, ContactSet.empty()), found[0]).is_empty
