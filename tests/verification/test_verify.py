"""Plans that are true are proven, and each way of being wrong is caught, with a trajectory."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from functools import cache, partial
from itertools import pairwise

import numpy as np
import pytest

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.region import Region
from preimage.execution.trace import Trace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.recognition.termination import (
    Condition,
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict, read_plan
from preimage.strategy.strategy import Motion, Status, Strategy, StrategyRegion
from preimage.task.examples import named_task, named_tasks
from preimage.task.goal import Goal
from preimage.task.initial import InitialPoint, InitialPolygon
from preimage.task.options import Method, StrategyKind
from preimage.task.parse import parse_task
from preimage.verification import faults
from preimage.verification import verify as verification
from preimage.verification.forward import forward_projection
from preimage.verification.trajectory import admissible
from preimage.verification.verdict import Fault, Verdict, Verification
from tests.laws.world import AtVertex, Free, OnEdge, State, World

verify = partial(verification.verify, runs=0)
"""The proof alone."""

DOWN = math.radians(270)
FAST = ("flat-floor", "l-room", "peg-in-hole", "blind-corner", "figure-6", "cradle", "example-3")


@cache
def planned(name: str, method: Method) -> Strategy:
    task = named_task(name)
    return plan(replace(task, options=replace(task.options, method=method)))


def changed(
    strategy: Strategy, number: int, region: Region | None = None, **motion: object
) -> Strategy:
    """The same plan with another region, or another motion in it."""
    regions = []
    for one in strategy.regions:
        if one.id == number:
            assert one.motion is not None
            # fields by name, of any type
            made = replace(one.motion, **motion)  # type: ignore[arg-type]
            one = replace(one, region=one.region if region is None else region, motion=made)
        regions.append(one)
    return replace(strategy, regions=tuple(regions))


def with_task(strategy: Strategy, **fields: object) -> Strategy:
    """The same plan for another task."""
    # fields by name, of any type
    return replace(strategy, task=replace(strategy.task, **fields))  # type: ignore[arg-type]


def with_errors(strategy: Strategy, **fields: object) -> Strategy:
    errors = replace(strategy.task.uncertainty, **fields)  # type: ignore[arg-type]
    return with_task(strategy, uncertainty=errors)


def state_of(world: World, trace: Trace, index: int) -> State:
    leg, count = trace.legs[0], len(trace.strategy.space.contact)
    feature, (x, y) = int(leg.features[index]), leg.places[index].tolist()
    if feature < count:
        return OnEdge(feature, math.dist((x, y), world.points[feature].tolist()))
    return AtVertex(feature - count) if feature < 2 * count else Free(x, y)


def replayed(trace: Trace) -> bool:
    """Whether the rules of theory 2, move by move, allow a trajectory: an independent check."""
    strategy = trace.strategy
    world = World(strategy.space, strategy.task.friction, strategy.task.sliding)
    leg = trace.legs[0]
    near = 1e-5 * world.size
    for index, (begin, end) in enumerate(pairwise(leg.times.tolist())):
        turn = math.remainder(float(leg.actual[index]) - leg.direction, math.tau)
        if abs(turn) > strategy.task.uncertainty.control + 1e-6:
            return False
        if math.dist(leg.places[index], leg.places[index + 1]) < near:
            continue
        moves = world.moves(state_of(world, trace, index), float(leg.actual[index]), end - begin)
        goal = leg.places[index + 1].tolist()
        if not any(math.dist(move.stop, goal) < near for move in moves):
            return False
    return True


def refuted(strategy: Strategy, fault: Fault | None = None) -> Verification:
    """The verdict on a plan that is wrong in this way."""
    found = verify(strategy)
    assert found.verdict is Verdict.REFUTED
    assert fault is None or fault in [one.fault for one in found.every]
    trace = found.counterexample
    assert trace is not None
    assert admissible(trace, 1e-6)
    assert replayed(trace)
    start = strategy.region(trace.legs[0].region).region
    world = World(strategy.space, strategy.task.friction)
    assert world.is_in(start, state_of(world, trace, 0), 1e-7)
    return found


# --- true plans -------------------------------------------------------------------------------


def cases(names: Iterable[str]) -> list[tuple[str, Method]]:
    return [(name, method) for name in names for method in Method]


def prove(name: str, method: Method) -> None:
    strategy = planned(name, method)
    found = verify(strategy, maximality=True)
    if strategy.status is not Status.SOLVED:
        assert found.verdict is Verdict.UNPROVEN
        return
    assert found.verdict is Verdict.PROVEN, [one.words for one in found.every]
    for motion in found.motions:
        assert not motion.uncertain
        assert motion.margins.entry >= 0.0
        assert motion.margins.reading >= 0.0
        assert motion.margins.progress > 0.0
        assert motion.maximality is not None
        assert motion.maximality.excess_area < 1e-6
        assert motion.maximality.missing_area < 1e-6
        assert motion.maximality.missing_length < 1e-6


@pytest.mark.parametrize(("name", "method"), cases(FAST))
def test_plans_are_proven(name: str, method: Method) -> None:
    prove(name, method)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "method"), cases(named_tasks()))
def test_all_plans_are_proven(name: str, method: Method) -> None:
    prove(name, method)


@pytest.mark.parametrize("name", ["peg-in-hole", "example-3"])
def test_a_plan_file_is_proven(name: str) -> None:
    """Rounding in the file does not matter."""
    strategy = read_plan(plan_to_dict(planned(name, Method.COMBINED)))
    assert verify(strategy).verdict is Verdict.PROVEN


def test_runs_are_made_if_wanted() -> None:
    found = verify(planned("flat-floor", Method.COMBINED), runs=2)
    assert found.report is not None
    assert found.report.failures == 0
    assert found.verdict is Verdict.PROVEN


# --- wrong plans ------------------------------------------------------------------------------


def larger(region: Region, strategy: Strategy, part: float) -> Region:
    """A region whose area is larger by a part of its size, to all sides of its middle."""
    ring = region.area.rings[0]
    middle = np.mean(ring[:-1], axis=0)
    grown = Area.polygon(middle + (1.0 + part) * (ring - middle))
    return Region(areas.intersection(grown, strategy.space.free), region.contact)


@pytest.mark.parametrize("part", [0.02, 1e-3, 1e-6, 4e-8])
@pytest.mark.parametrize("name", ["flat-floor", "peg-in-hole", "example-3"])
def test_a_preimage_that_is_too_big(name: str, part: float) -> None:
    """Two percent too big; and far less, down to some 1e-8 of the window."""
    strategy = planned(name, Method.COMBINED)
    number = strategy.steps[0]
    bigger = larger(strategy.region(number).region, strategy, part)
    wrong = changed(strategy, number, bigger)
    if part >= 1e-3:
        refuted(wrong)
    else:
        assert verify(wrong).verdict is not Verdict.PROVEN


def test_an_edge_too_many() -> None:
    """A wall that the preimage must not hold."""
    strategy = planned("flat-floor", Method.COMBINED)
    region = strategy.region(1).region
    floor = int(region.contact.edge[0])
    whole = ContactSet.of([floor], [0.0], [float(strategy.space.contact.length[floor])], [], 1e-9)
    refuted(changed(strategy, 1, Region(region.area, whole)), Fault.REST)


def notch(sloppy: bool) -> Strategy:
    """A plan for a floor beside a V-shaped notch that pushes back like the floor.

    Of the goal's floor, only what is further than `2 rho` from the notch is certain: up to
    1.882. Who forgets that vertices are features recognises all of it.
    """
    solid = [(-10, 0), (2, 0), (3, -1), (4, 0), (10, 0), (10, -6), (-10, -6)]
    force = {"angle": 5, "threshold": 0.05}
    task = parse_task(
        {
            "version": 1,
            "window": [-10, -6, 10, 14],
            "obstacles": [{"polygon": solid}],
            "uncertainty": {"control": 10, "position": 0.75, "force": force},
            "friction": 20,
            "initial": {"point": [-1, 2]},
            "goal": {"edges": [[[-7, 0], [2, 0]]]},
        }
    )
    space = configuration_space(task)
    honest = plan(replace(task, options=replace(task.options, method=Method.KERNEL)))
    goal = honest.region(0)
    edge = int(goal.region.contact.edge[0])
    high = 1.99 if sloppy else 1.88
    ends = [math.dist(space.contact.points[edge], (x, 0.0)) for x in (-5.4, high)]
    near = space.tolerance.length
    target = ContactSet.of([edge], [min(ends)], [max(ends)], [], near)
    tip = (high + 5.4) / 2.0 / math.tan(math.radians(10.0))
    cone = Area.polygon(np.array([(-5.4, 0.0), (high, 0.0), (0.5 * (high - 5.4), tip)]))
    region = Region(areas.intersection(cone, space.free), target)
    motion = Motion(DOWN, (0,), Region(Area.empty(), target), (ReadingCondition(),))
    return replace(
        honest,
        status=Status.SOLVED,
        regions=(goal, StrategyRegion(1, 1, region, motion)),
        start=(1,),
        steps=(1,),
    )


def test_a_kernel_that_forgets_vertices() -> None:
    found = refuted(notch(sloppy=True), Fault.UNKNOWN)
    (motion,) = found.motions
    count = len(found.strategy.space.contact)
    assert any(count <= one.other < 2 * count for one in motion.uncertain)
    assert all(one.distance < 1.5 for one in motion.uncertain)
    assert verify(notch(sloppy=False)).verdict is Verdict.PROVEN


@pytest.mark.parametrize("name", ["flat-floor", "example-2"])
def test_a_sticking_period_that_is_too_short(name: str) -> None:
    strategy = planned(name, Method.STICKING)
    for number in strategy.steps:
        motion = strategy.region(number).motion
        assert motion is not None
        (condition,) = motion.termination
        assert isinstance(condition, StickingCondition)
        short = replace(condition, period=0.5 * condition.period)
        refuted(changed(strategy, number, termination=(short,)), Fault.PERIOD)
        enough = replace(condition, period=2.0 * condition.period)
        assert verify(changed(strategy, number, termination=(enough,))).verdict is Verdict.PROVEN


def test_a_sticking_distance_within_the_sensors_error() -> None:
    strategy = planned("flat-floor", Method.STICKING)
    motion = strategy.region(1).motion
    assert motion is not None
    small = StickingCondition(1.0, 1.5 * strategy.task.uncertainty.position)
    found = verify(changed(strategy, 1, termination=(small,)))
    assert found.verdict is Verdict.UNPROVEN
    assert [one.fault for one in found.every] == [Fault.PERIOD]


def test_a_time_that_is_up_too_early() -> None:
    strategy = planned("blind-corner", Method.STICKING)
    motion = strategy.region(1).motion
    assert motion is not None
    (condition,) = motion.termination
    assert isinstance(condition, ElapsedCondition)
    early = ElapsedCondition(0.9 * condition.period)
    found = verify(changed(strategy, 1, termination=(early,)))
    assert found.verdict is not Verdict.PROVEN
    assert [one.fault for one in found.every] == [Fault.ELAPSED]


def informed(part: float) -> Strategy:
    """A plan that aims at all of the goal, since its condition knows where the motion may be.

    Parameters
    ----------
    part : how much of the forward projection's height its domain has.
    """
    strategy = planned("flat-floor", Method.KERNEL)
    space, task = strategy.space, strategy.task
    goal = strategy.region(0).region
    target = Region(
        Area.empty(),
        contact_set.intersection(
            goal.contact, ContactSet.whole(space.contact), space.tolerance.length
        ),
    )
    start = Region(Area.box(-0.25, 3.0, 0.25, 3.5), ContactSet.empty())
    found = forward_projection(
        space, start, DOWN, task.uncertainty.control, task.friction, target
    ).region
    view = Area.box(-50.0, -50.0, 50.0, 3.5 * part)
    domain = Region(areas.intersection(found.area, view), found.contact)
    conditions: tuple[Condition, ...] = (ReadingCondition(domain),)
    made = changed(strategy, 1, start, target=target, termination=conditions)
    return with_task(made, initial=InitialPoint((0.0, 3.25)))


def test_a_domain_that_is_too_small() -> None:
    assert verify(informed(1.0)).verdict is Verdict.PROVEN
    refuted(informed(0.5), Fault.DOMAIN)
    assert verify(informed(0.999)).verdict is not Verdict.PROVEN


def test_a_domain_without_free_space() -> None:
    """Who flies to the floor gives readings that nothing in the domain gives."""
    strategy = planned("flat-floor", Method.KERNEL)
    walls = Region(Area.empty(), ContactSet.whole(strategy.space.contact))
    blind = changed(strategy, 1, termination=(ReadingCondition(walls),))
    refuted(blind, Fault.DOMAIN)
    refuted(with_errors(blind, control=0.0), Fault.DOMAIN)


def test_what_cannot_be_shown_is_not_proven_either(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(faults, "admissible", lambda _trace, _slack: False)
    found = verify(informed(0.5))
    assert found.verdict is Verdict.UNPROVEN
    assert [one.fault for one in found.every] == [Fault.DOMAIN]


def test_a_domain_without_the_line_along_which_a_tip_is_left() -> None:
    """With perfect control a motion may take a line, which has no area."""
    task = parse_task(
        {
            "version": 1,
            "window": [-10, -6, 10, 14],
            "obstacles": [
                {"polygon": [(-10, 0), (10, 0), (10, -6), (-10, -6)]},
                {"polygon": [(0, 4), (1, 6), (-1, 6)]},
            ],
            "uncertainty": {
                "control": 0,
                "position": 0.1,
                "force": {"angle": 5, "threshold": 0.05},
            },
            "friction": 20,
            "initial": {"point": [0, 4]},
            "goal": {"edges": [[[-2, 0], [2, 0]]]},
            "planner": {"directions": [270]},
        }
    )
    strategy = plan(task)
    assert strategy.status is Status.SOLVED
    space = strategy.space
    corners = space.contact.vertices
    tip = corners[np.hypot(*(space.contact.points[corners] - (0.0, 4.0)).T) < 1e-6]
    assert len(tip) == 1
    start = Region(Area.empty(), ContactSet.of([], [], [], tip.tolist(), space.tolerance.length))
    goal = strategy.region(0).region
    for area, holds in ((Area.empty(), False), (Area.box(-0.1, 0.0, 0.1, 4.0), True)):
        domain = Region(area, contact_set.union(goal.contact, start.contact, 1e-9))
        reading = (ReadingCondition(domain),)
        found = verify(changed(strategy, 1, start, target=goal, termination=reading))
        assert (found.verdict is Verdict.PROVEN) == holds


def test_an_edge_that_may_stick_just_outside_the_goal() -> None:
    """A funnel leads to its bottom if its walls let slide; with more friction they hold."""
    solid = [(-10, 6), (-6, 6), (0, 0), (6, 6), (10, 6), (10, -6), (-10, -6)]
    task = parse_task(
        {
            "version": 1,
            "window": [-10, -6, 10, 14],
            "obstacles": [{"polygon": solid}],
            "uncertainty": {"control": 10, "position": 0.25},
            "friction": 30,
            "initial": {"point": [0.5, 3]},
            "goal": {"points": [[0, 0]]},
        }
    )
    strategy = plan(replace(task, options=replace(task.options, method=Method.STICKING)))
    assert verify(strategy).verdict is Verdict.PROVEN
    refuted(with_task(strategy, friction=math.radians(36)), Fault.REST)


@pytest.mark.parametrize("name", ["flat-floor", "peg-in-hole", "example-3"])
def test_made_for_less_control_error(name: str) -> None:
    strategy = planned(name, Method.COMBINED)
    wrong = with_errors(strategy, control=1.05 * strategy.task.uncertainty.control)
    assert verify(wrong).verdict is Verdict.REFUTED
    assert all(one.trace is None or replayed(one.trace) for one in verify(wrong).every)


@pytest.mark.parametrize("name", ["figure-7", "peg-in-hole", "example-3"])
def test_made_for_less_position_error(name: str) -> None:
    strategy = planned(name, Method.KERNEL)
    wrong = with_errors(strategy, position=1.05 * strategy.task.uncertainty.position)
    found = verify(wrong)
    assert found.verdict is Verdict.REFUTED
    assert any(motion.uncertain for motion in found.motions)
    assert all(one.trace is None or replayed(one.trace) for one in found.every)


def test_made_for_less_force_error() -> None:
    strategy = planned("peg-in-hole", Method.KERNEL)
    wrong = with_errors(strategy, force_angle=math.radians(80))
    assert verify(wrong).verdict is Verdict.REFUTED


def test_another_goal_and_another_start() -> None:
    strategy = planned("flat-floor", Method.COMBINED)
    found = verify(with_task(strategy, goal=Goal(edges=(((-1.0, 0.0), (1.0, 0.0)),))))
    assert [one.fault for one in found.findings] == [Fault.GOAL]
    found = verify(with_task(strategy, initial=InitialPoint((3.0, 2.0))))
    assert [one.fault for one in found.findings] == [Fault.START]


def test_a_start_on_the_border() -> None:
    """What is within rounding of a border is not proven, so that nothing may start there."""
    strategy = planned("flat-floor", Method.COMBINED)
    left, bottom, _, _ = strategy.region(1).region.area.bounds
    half_width = -left
    tip = half_width / math.tan(strategy.task.uncertainty.control)
    near = strategy.space.tolerance.length
    for off, verdict in ((4.0 * near, Verdict.UNPROVEN), (1e-6, Verdict.PROVEN)):
        place = (left + 1.0 / tip * half_width + off, bottom + 1.0)
        assert verify(with_task(strategy, initial=InitialPoint(place))).verdict is verdict


def test_a_region_without_width() -> None:
    strategy = planned("flat-floor", Method.COMBINED)
    near = strategy.space.tolerance.length
    line = Region(Area.box(0.0, 1.0, 8.0 * near, 2.0), ContactSet.empty())
    found = verify(changed(strategy, 1, line))
    assert Fault.THIN in [one.fault for one in found.every]
    assert found.verdict is not Verdict.PROVEN


def test_regions_that_lead_nowhere() -> None:
    strategy = planned("peg-in-hole", Method.COMBINED)
    number = strategy.steps[0]
    found = verify(changed(strategy, number, goals=(number,)))
    assert [one.fault for one in found.findings] == [Fault.GRAPH]
    found = verify(changed(strategy, number, goals=(77,)))
    assert found.verdict is Verdict.UNPROVEN
    assert not found.motions


def test_a_plan_that_is_not_solved_promises_nothing() -> None:
    found = verify(planned("cradle", Method.KERNEL))
    assert [one.fault for one in found.findings] == [Fault.STATUS]
    assert found.verdict is Verdict.UNPROVEN


# --- several goals, several starts ------------------------------------------------------------


def split(strategy: Strategy, number: int, overlap: float) -> Strategy:
    """A region in two, left and right of the middle of the window, that overlap."""
    one = strategy.region(number)
    parts = []
    for name, (low, high) in ((number, (-50.0, 0.5 * overlap)), (99, (-0.5 * overlap, 50.0))):
        half = areas.intersection(one.region.area, Area.box(low, -50.0, high, 50.0))
        parts.append(replace(one, id=name, region=Region(half, ContactSet.empty())))
    others = [region for region in strategy.regions if region.id != number]
    return replace(
        strategy,
        kind=StrategyKind.CONDITIONAL,
        regions=(*others, *parts),
        start=(number, 99) if number in strategy.start else strategy.start,
        steps=(),
    )


@pytest.mark.parametrize(("overlap", "holds"), [(0.3, True), (0.21, True), (0.15, False)])
def test_initial_branching_needs_regions_that_overlap(overlap: float, holds: bool) -> None:
    """Twice rho is 0.2: then one region or the other holds all that a reading leaves."""
    strategy = planned("flat-floor", Method.COMBINED)
    wide = InitialPolygon(((-1.0, 1.0), (1.0, 1.0), (1.0, 1.5), (-1.0, 1.5)))
    both = with_task(split(strategy, 1, overlap), initial=wide)
    found = verify(both)
    assert (found.verdict is Verdict.PROVEN) == holds
    assert [one.fault for one in found.findings] == ([] if holds else [Fault.START])
    blind = with_errors(both, position=math.inf)
    assert Fault.START in [one.fault for one in verify(blind).findings]


def test_each_piece_of_a_target_must_be_certain_for_one_goal() -> None:
    """Where two goals meet, no reading tells which it is, though it is one of them."""
    strategy = planned("l-room", Method.KERNEL)
    first, last = strategy.steps
    twice = replace(strategy.region(last), id=98)
    both = replace(strategy, kind=StrategyKind.CONDITIONAL, regions=(*strategy.regions, twice))
    both = replace(changed(both, first, goals=(last, 98)), steps=())
    assert verify(both).verdict is Verdict.PROVEN
    apart = split(changed(strategy, first, goals=(last, 99)), last, 0.0)
    found = verify(apart)
    assert found.verdict is Verdict.REFUTED
    (motion,) = [one for one in found.motions if one.region == first]
    assert motion.uncertain


def test_a_domain_may_not_hide_one_goal_from_another() -> None:
    """On the right of the floor nothing of the domain is consistent: so the left is told."""
    strategy = planned("flat-floor", Method.KERNEL)
    near, goal, one = strategy.space.tolerance.length, strategy.region(0), strategy.region(1)
    (edge,) = goal.region.contact.edge.tolist()

    def part(low: float, high: float) -> Region:
        return Region(Area.empty(), ContactSet.of([edge], [low], [high], [], near))

    left, right = part(18.0, 20.5), part(20.0, 22.0)
    valid = strategy.space.valid
    hidden = part(20.5, 22.0).contact
    domain = Region(valid.area, contact_set.difference(valid.contact, hidden, near))
    for condition, holds in ((ReadingCondition(), True), (ReadingCondition(domain), False)):
        assert one.motion is not None
        regions = (
            replace(goal, region=left),
            replace(
                one, rank=2, motion=replace(one.motion, goals=(0, 2), termination=(condition,))
            ),
            replace(one, id=2, region=right),
        )
        made = replace(strategy, regions=regions)
        motion = next(found for found in verify(made).motions if found.region == 1)
        assert [found.fault for found in motion.findings] == ([] if holds else [Fault.DOMAIN])
        assert holds or motion.verdict is Verdict.REFUTED


def test_a_target_that_claims_too_much_is_no_reason_for_runs_to_fail() -> None:
    """The sensors are looked at where the part that is certain begins."""
    strategy = planned("flat-floor", Method.KERNEL)
    found = verification.verify(changed(strategy, 1, target=strategy.space.valid), runs=2)
    assert found.verdict is Verdict.PROVEN
