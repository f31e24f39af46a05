"""All directions of one motion, against single ones, and against closed forms."""

import math
from dataclasses import replace
from itertools import pairwise
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region, is_subset
from preimage.configuration.start import Start, covered, start_region
from preimage.errors import TaskError
from preimage.geometry.angles import TAU, wrap
from preimage.geometry.area import Area
from preimage.mechanics.behaviour import Behaviour
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.recognition.readings import alike
from preimage.search.cones import narrowed, widened
from preimage.search.directions import Arc, Verdict, solving_directions
from preimage.search.limits import Limits
from preimage.search.witness import possible_target
from preimage.task.examples import named_task
from preimage.task.options import Method
from preimage.task.task import InitialPoint, Task
from tests.laws.tasks import random_task
from tests.search.critical import critical_directions

TENTH = math.radians(0.1)
COARSE = math.radians(1.0)
SEEDS = st.integers(0, 10_000)


def arcs_of(task: Task, resolution: float = TENTH) -> tuple[Arc, ...]:
    setting, goal, start = parts(task)
    return solving_directions(setting, [goal], start, task.options.method, resolution)


def parts(task: Task) -> tuple[Setting, Region, Start]:
    setting = Setting.of(task)
    return setting, goal_region(task, setting.space), start_region(task, setting.space)


def some_task(rng: Random) -> Task:
    """A random task whose start is not refused."""
    while True:
        task = random_task(rng)
        try:
            parts(task)
        except TaskError:
            continue
        return task


class Single:
    """Asks one direction at a time."""

    def __init__(self, task: Task) -> None:
        self.setting, self.goal, self.start = parts(task)
        self.method = task.options.method

    def __call__(self, direction: float) -> bool:
        made = preimage(self.setting, self.goal, direction % TAU, self.method)
        return covered(self.start, made.region, self.setting.space)


def with_control(task: Task, control: float) -> Task:
    return replace(task, uncertainty=replace(task.uncertainty, control=control))


def solving(arcs: tuple[Arc, ...]) -> list[Arc]:
    return [arc for arc in arcs if arc.verdict is Verdict.SOLVES]


def check_cover(arcs: tuple[Arc, ...]) -> None:
    """The full turn, in order, no neighbours alike."""
    assert 0.0 <= arcs[0].low < TAU
    assert arcs[-1].high - arcs[0].low == pytest.approx(TAU, abs=1e-9)
    for one, other in pairwise(arcs):
        assert one.high == pytest.approx(other.low, abs=1e-12)
        assert one.verdict is not other.verdict
    for arc in arcs:
        assert arc.low <= arc.high
        assert arc.low < arc.high or arc.verdict is Verdict.SOLVES


# --- closed forms -----------------------------------------------------------------------------


def test_flat_floor_to_the_resolution() -> None:
    """From a point over the middle of an edge: what the cone leaves of the angle to its ends."""
    task = named_task("flat-floor")
    control = task.uncertainty.control
    assert isinstance(task.initial, InitialPoint)
    half = math.atan2(2.0, task.initial.point[1]) - control
    (arc,) = solving(arcs_of(task))
    assert arc.margin <= half + 1e-9
    assert arc.margin >= half - TENTH
    assert arc.widest == pytest.approx(1.5 * math.pi, abs=TENTH)


@pytest.mark.parametrize("control", [0.0, math.radians(0.02), math.radians(1.0)])
def test_flat_floor_with_little_noise(control: float) -> None:
    task = with_control(named_task("flat-floor"), control)
    (arc,) = solving(arcs_of(task))
    half = math.atan2(2.0, 5.0) - control
    assert half - TENTH <= arc.margin <= half + 1e-9
    for arc in arcs_of(task):
        if arc.verdict is Verdict.UNPROVEN:
            assert arc.margin <= TENTH


def test_too_much_noise_leaves_nothing() -> None:
    task = with_control(named_task("flat-floor"), math.atan2(2.0, 5.0) + 1e-6)
    arcs = arcs_of(task)
    assert not solving(arcs)
    solves = Single(task)
    assert not any(solves(arc.widest) for arc in arcs)


def test_an_arc_below_the_resolution_is_found() -> None:
    """Half as wide as the resolution, and told how wide it is for sure."""
    half = math.radians(0.02)
    task = with_control(named_task("flat-floor"), math.atan2(2.0, 5.0) - half)
    (arc,) = solving(arcs_of(task, math.radians(0.5)))
    assert 0.0 < arc.margin <= half
    assert abs(wrap(arc.widest - 1.5 * math.pi)) <= half


def test_every_direction_may_solve() -> None:
    """In a closed box whose border is the goal."""
    task = named_task("l-room")
    setting, _, start = parts(task)
    contact = setting.space.contact
    border = Region(Area.empty(), ContactSet.whole(contact))
    arcs = solving_directions(setting, [border], start, Method.COMBINED, COARSE)
    assert arcs == (Arc(0.0, TAU, Verdict.SOLVES),)
    assert arcs[0].margin == pytest.approx(math.pi)


def test_goals_are_taken_together() -> None:
    task = named_task("flat-floor")
    setting, goal, start = parts(task)
    contact = goal.contact
    middle = 0.5 * (contact.low + contact.high)
    left = replace(goal, contact=ContactSet(contact.edge, contact.low, middle, contact.vertices))
    right = replace(goal, contact=ContactSet(contact.edge, middle, contact.high, contact.vertices))
    method = task.options.method
    both = solving_directions(setting, [left, right], start, method, TENTH)
    assert both == solving_directions(setting, [goal], start, method, TENTH)


def test_limits_leave_the_rest_unproven() -> None:
    task = named_task("flat-floor")
    setting, goal, start = parts(task)
    limits = Limits(None, 10, cancelled=lambda: True)
    arcs = solving_directions(setting, [goal], start, task.options.method, TENTH, limits)
    assert arcs == (Arc(0.0, TAU, Verdict.UNPROVEN),)


def test_refuses_what_makes_no_sense() -> None:
    setting, goal, start = parts(named_task("flat-floor"))
    for resolution in (0.0, -1.0, math.nan):
        with pytest.raises(ValueError, match="positive"):
            solving_directions(setting, [goal], start, Method.KERNEL, resolution)
    with pytest.raises(ValueError, match="goal"):
        solving_directions(setting, [], start, Method.KERNEL, TENTH)
    arcs = solving_directions(setting, [Region.empty()], start, Method.KERNEL, TENTH)
    assert arcs == (Arc(0.0, TAU, Verdict.FAILS),)


# --- against single directions ----------------------------------------------------------------


def check_arcs(task: Task, rng: Random, resolution: float, samples: int) -> None:
    """What is said of an arc holds at its ends, in its middle, and at random in between."""
    arcs, solves = arcs_of(task, resolution), Single(task)
    check_cover(arcs)
    for arc in arcs:
        if arc.verdict is Verdict.UNPROVEN:
            continue
        inside = [rng.uniform(arc.low, arc.high) for _ in range(samples)]
        for direction in (arc.low, arc.high, arc.widest, *inside):
            # an end that all of an arc shares with the next is the next's as well
            if arc.verdict is Verdict.FAILS and direction in (arc.low, arc.high):
                continue
            assert solves(direction) is (arc.verdict is Verdict.SOLVES), (arc, direction)


@settings(max_examples=12, deadline=None)
@given(SEEDS)
def test_arcs_agree_with_single_directions(seed: int) -> None:
    rng = Random(seed)
    check_arcs(some_task(rng), rng, COARSE, 3)


@settings(max_examples=8, deadline=None)
@given(SEEDS)
def test_arcs_agree_without_noise(seed: int) -> None:
    rng = Random(seed)
    check_arcs(with_control(some_task(rng), 0.0), rng, COARSE, 3)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(SEEDS, st.sampled_from([None, 0.0, math.radians(0.05), math.radians(60.0)]))
def test_arcs_agree_with_many_directions(seed: int, control: float | None) -> None:
    rng = Random(seed)
    task = some_task(rng)
    task = task if control is None else with_control(task, control)
    check_arcs(task, rng, math.radians(0.25), 30)


@settings(max_examples=8, deadline=None)
@given(SEEDS)
def test_dense_directions_are_where_they_belong(seed: int) -> None:
    """Of many directions none solves outside the arcs that may."""
    rng = Random(seed)
    task = some_task(rng)
    arcs, solves = arcs_of(task, COARSE), Single(task)
    for direction in np.linspace(0.0, TAU, 73)[:-1] + rng.uniform(0.0, TAU / 72):
        place = next(
            arc for arc in arcs if arc.low <= direction <= arc.high
            or arc.low <= direction + TAU <= arc.high
        )  # fmt: skip
        if place.verdict is not Verdict.UNPROVEN:
            assert solves(float(direction)) is (place.verdict is Verdict.SOLVES)


# --- what intervals rest on -------------------------------------------------------------------


@settings(max_examples=25, deadline=None)
@given(SEEDS, st.floats(0.0, 0.3), st.floats(-1.0, 1.0))
def test_wide_cones_are_inside_and_narrow_ones_outside(
    seed: int, half: float, share: float
) -> None:
    """Behaviours, reading sets, targets and backprojections of an interval are bounded."""
    rng = Random(seed)
    task = some_task(rng)
    setting, goal, _ = parts(task)
    middle = rng.choice((rng.uniform(0.0, TAU), math.radians(rng.choice((0, 45, 90, 270)))))
    direction, method = middle + share * half, task.options.method
    exact = preimage(setting, goal, direction, method)
    command = setting.command(direction)
    near = setting.space.tolerance
    wide = widened(setting, half, (goal,))
    if wide is not None:
        bound, outer = preimage(wide, goal, middle, method), wide.command(middle)
        surely, _ = outer.sources.where(Behaviour.STICKS_SURELY)
        assert np.all(command.sources.where(Behaviour.STICKS_SURELY)[0][surely])
        for one in (Behaviour.MAY_STICK, Behaviour.MAY_SLIDE, Behaviour.MAY_LEAVE):
            assert np.all(outer.sources.where(one)[0][command.sources.where(one)[0]])
        features = np.arange(len(command.readings.zero))
        for feature in features[:: max(1, len(features) // 12)].tolist():
            same = alike(command.readings, feature, features)
            assert np.all(alike(outer.readings, feature, features)[same])
        assert is_subset(bound.target.region, exact.target.region, near)
        assert is_subset(bound.region, exact.region, near)
    narrow = narrowed(setting, half, (goal,))
    if narrow is not None:
        assert is_subset(exact.region, preimage(narrow, goal, middle, method).region, near)
    elif half > 0.0:
        possible = possible_target(setting, goal, method, middle, half)
        assert is_subset(exact.target.region, possible, near)


# --- against critical directions --------------------------------------------------------------

FINE = math.radians(0.02)


def sticking_task(rng: Random) -> Task | None:
    """A task whose target is contact that sticks; None if it is too large, or has an area."""
    task = some_task(rng)
    task = replace(task, options=replace(task.options, method=Method.STICKING))
    setting, goal, start = parts(task)
    small = len(setting.space.contact) <= 12
    return task if small and goal.area.is_empty and start.point is not None else None


def check_critical(task: Task) -> bool:
    """Arcs end at critical directions; between two neighbours all answer alike."""
    setting, goal, start = parts(task)
    critical = critical_directions(setting, goal, start)
    arcs, solves = arcs_of(task, FINE), Single(task)
    if not solving(arcs):
        return False
    for place, arc in enumerate(arcs):
        if arc.verdict is Verdict.UNPROVEN:
            assert any(
                arc.low - 1e-9 <= one + turn <= arc.high + 1e-9
                for one in critical
                for turn in (0.0, TAU)
            ), (place, arc)
    for one, other in pairwise([*critical, critical[0] + TAU]):
        if other - one < 1e-6:
            continue
        middle = 0.5 * (one + other)
        answer = solves(middle)
        assert solves(one + 0.99 * (other - one)) is answer
        verdict = next(
            arc.verdict for arc in arcs
            if arc.low <= middle <= arc.high or arc.low <= middle + TAU <= arc.high
        )  # fmt: skip
        assert verdict in (Verdict.UNPROVEN, Verdict.SOLVES if answer else Verdict.FAILS)
    return True


@pytest.mark.parametrize("seed", [6, 193, 238])
def test_ends_are_critical(seed: int) -> None:
    task = sticking_task(Random(seed))
    assert task is not None
    assert check_critical(task)


@pytest.mark.slow
def test_ends_are_critical_in_many_scenes() -> None:
    tried = 0
    for seed in range(1000, 1250):
        task = sticking_task(Random(seed))
        tried += task is not None and check_critical(task)
    assert tried >= 10
