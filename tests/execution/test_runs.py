"""Runs: sound plans never fail, unsound ones do, and the same seed gives the same runs."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.start import Start, StartKind, start_region
from preimage.errors import PreimageError
from preimage.execution.control import CONTROLS
from preimage.execution.describe import describe_report
from preimage.execution.report import Report
from preimage.execution.runs import RunOptions, run, trace_of
from preimage.execution.sensing import SENSINGS
from preimage.execution.simulator import Choices
from preimage.execution.situation import Situation
from preimage.execution.starts import is_in, of_region, of_start
from preimage.execution.trace import Outcome
from preimage.geometry.area import Area
from preimage.recognition.termination import StickingCondition
from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict
from preimage.strategy.plan_parse import parse_plan
from preimage.strategy.strategy import Motion, Status, Strategy
from preimage.task.examples import named_task, named_tasks
from preimage.task.initial import InitialPoint
from preimage.task.options import Method
from preimage.task.task import SlidingLaw


def planned(name: str, method: Method = Method.COMBINED) -> Strategy:
    task = named_task(name)
    return plan(replace(task, options=replace(task.options, method=method)))


def from_region(strategy: Strategy, number: int) -> tuple[Strategy, Start]:
    """The rest of a plan, begun anywhere in one of its regions."""
    region = strategy.region(number)
    return replace(strategy, start=(number,)), Start.anywhere_in(region.region)


def with_motion(strategy: Strategy, number: int, motion: Motion) -> Strategy:
    """A plan with another motion in one of its regions."""
    changed = tuple(
        replace(region, motion=motion) if region.id == number else region
        for region in strategy.regions
    )
    return replace(strategy, regions=changed)


def run_zipped(strategy: Strategy, start: Start | None, runs: int, seed: int = 0) -> list[Report]:
    """Every adversary once, of control and of sensing."""
    sensings = list(SENSINGS)
    return [
        run(
            strategy,
            control=control,
            sensing=sensings[(count + seed) % len(sensings)],
            start=start,
            options=RunOptions(runs, seed),
        )
        for count, control in enumerate(CONTROLS)
    ]


# --- sound plans ----------------------------------------------------------------------------


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("name", sorted(named_tasks()))
def test_named_tasks_never_fail(name: str, method: Method) -> None:
    strategy = planned(name, method)
    if strategy.status is not Status.SOLVED:
        pytest.skip("unsolvable by this method")
    for report in run_zipped(strategy, None, 20):
        assert report.failures == 0, describe_report(report)


@pytest.mark.parametrize("name", ["peg-in-hole", "l-room", "example-3", "cradle", "figure-6"])
def test_nothing_fails_from_anywhere_in_any_preimage(name: str) -> None:
    strategy = planned(name)
    for number in strategy.steps:
        rest, start = from_region(strategy, number)
        for report in run_zipped(rest, start, 60, seed=3):
            assert report.failures == 0, describe_report(report)


@pytest.mark.slow
@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("name", sorted(named_tasks()))
def test_nothing_fails_from_anywhere_under_any_pair(name: str, method: Method) -> None:
    strategy = planned(name, method)
    if strategy.status is not Status.SOLVED:
        pytest.skip("unsolvable by this method")
    for number in strategy.steps:
        rest, start = from_region(strategy, number)
        report = run(rest, start=start, options=RunOptions(300, 1))
        assert report.failures == 0, describe_report(report)


@pytest.mark.parametrize("law", SlidingLaw)
def test_both_sliding_laws_are_run(law: SlidingLaw) -> None:
    strategy = plan(replace(named_task("example-1"), sliding=law))
    report = run(strategy, control="sticking", sensing="towards", options=RunOptions(50))
    assert report.failures == 0


# --- unsound ones ---------------------------------------------------------------------------


def with_bounds(strategy: Strategy, **bounds: float) -> Strategy:
    """The same plan for a task with other errors, as if its file had been changed."""
    data = plan_to_dict(strategy)
    data["task"]["uncertainty"].update(bounds)
    return parse_plan(data)


def failing(strategy: Strategy, start: Start | None = None, runs: int = 300) -> set[Outcome]:
    report = run(strategy, start=start, options=RunOptions(runs))
    return {outcome for outcome in report.outcomes if outcome is not Outcome.SUCCESS}


def test_a_plan_for_less_control_noise_fails() -> None:
    strategy = with_bounds(planned("peg-in-hole"), control=15.0)
    assert failing(*from_region(strategy, strategy.steps[0]))


def test_a_plan_for_a_better_position_sensor_is_not_recognised() -> None:
    strategy = with_bounds(planned("landmark-edge", Method.KERNEL), position=2.0)
    assert failing(strategy) & {Outcome.UNKNOWN, Outcome.ENDLESS, Outcome.ESCAPED}


def test_a_preimage_two_percent_too_big_fails() -> None:
    strategy = planned("flat-floor")
    number = strategy.steps[0]
    made = strategy.region(number)
    x, y = made.region.area.geometry.centroid.coords[0]
    scaled = shapely.transform(made.region.area.geometry, lambda p: (p - (x, y)) * 1.02 + (x, y))
    area = Area.of(shapely.intersection(scaled, strategy.space.free.geometry))
    start = Start.anywhere_in(Region(area, ContactSet.empty()))
    rest = replace(strategy, start=(number,))
    assert failing(rest, Start.anywhere_in(Region(made.region.area, ContactSet.empty()))) == set()
    assert failing(rest, start, 1_000)


def test_a_sticking_period_too_short_stops_on_the_way() -> None:
    strategy = planned("example-1", Method.STICKING)
    number = strategy.steps[0]
    motion = strategy.region(number).motion
    assert motion is not None
    (condition,) = motion.termination
    assert isinstance(condition, StickingCondition)
    hasty = StickingCondition(0.2 * condition.period, condition.distance)
    wrong = with_motion(strategy, number, replace(motion, termination=(hasty,)))
    report = run(wrong, sensing="towards", options=RunOptions(100))
    assert report.outcomes.get(Outcome.WRONG, 0) > 0
    assert report.failure is not None
    assert report.failure.legs[-1].ended_by == "sticking"
    assert "first failure" in describe_report(report)


# --- closed forms ---------------------------------------------------------------------------


def test_a_slide_into_a_corner_takes_as_long_as_it_must() -> None:
    """One dimension: a floor of length d, a wall at its end, the command 45 degrees into both."""
    strategy = planned("blind-corner", Method.STICKING)
    task = replace(
        strategy.task, uncertainty=replace(strategy.task.uncertainty, control=0.0, position=0.05)
    )
    exact = plan(task)
    if exact.status is not Status.SOLVED:
        pytest.skip("needs sticking in the corner")
    report = run(exact, control="exact", sensing="true", options=RunOptions(40))
    assert report.failures == 0
    motion = exact.region(exact.steps[0]).motion
    assert motion is not None
    sticking = next(c for c in motion.termination if isinstance(c, StickingCondition))
    checked = 0
    for trace in report.samples:
        (leg,) = trace.legs
        corner = leg.places[-1]
        arrived = leg.times[np.argmax(np.hypot(*(leg.places - corner).T) < 1e-6)]
        # the last stretch of `distance` before the corner has been left a period ago
        back = leg.times[-1] - sticking.period
        before = [float(np.interp(back, leg.times, leg.places[:, axis])) for axis in (0, 1)]
        moved = math.dist(before, corner)
        assert leg.ended_by == "sticking"
        if back > leg.times[0]:
            assert moved == pytest.approx(sticking.distance, abs=1e-6)
            assert leg.times[-1] <= arrived + sticking.period + 1e-6
            checked += 1
    assert checked


# --- the runs themselves --------------------------------------------------------------------


def test_the_same_seed_gives_the_same_runs() -> None:
    strategy = planned("l-room")
    reports = [
        run(strategy, control=["random", "bias"], options=RunOptions(30, seed))
        for seed in (5, 5, 6)
    ]
    assert reports[0].tallies == reports[1].tallies
    assert reports[0].tallies != reports[2].tallies


def test_processes_change_nothing() -> None:
    strategy = planned("peg-in-hole")
    alone, together = (
        run(strategy, control=["random", "hunting"], sensing="noise", options=options)
        for options in (RunOptions(20), RunOptions(20, workers=2))
    )
    assert alone.tallies == together.tallies
    assert together.samples[0].strategy is strategy
    first, other = alone.samples[0].legs[0], together.samples[0].legs[0]
    assert np.array_equal(first.places, other.places)


def test_a_run_can_be_had_whole() -> None:
    strategy = planned("peg-in-hole")
    report = run(strategy, control="random", sensing="noise", options=RunOptions(5))
    for sample in report.samples:
        again = trace_of(strategy, ("random", "noise"), sample.number, options=RunOptions(5))
        assert [leg.region for leg in again.legs] == [leg.region for leg in sample.legs]
        for leg, other in zip(again.legs, sample.legs, strict=True):
            assert np.array_equal(leg.times, other.times)


def test_traces_are_unbroken() -> None:
    strategy = planned("example-3")
    report = run(strategy, options=RunOptions(3))
    for trace in report.samples:
        assert trace.outcome is Outcome.SUCCESS
        assert [leg.region for leg in trace.legs] == list(strategy.steps)[-len(trace.legs) :]
        for leg in trace.legs:
            assert np.all(np.diff(leg.times) >= 0.0)
            steps = np.hypot(*np.diff(leg.places, axis=0).T)
            assert np.all(steps <= np.diff(leg.times) + 1e-6)  # the speed is 1 at most
            assert leg.ended_by
            columns = (leg.places, leg.features, leg.actual, leg.measured, leg.forces)
            assert {len(column) for column in columns} == {len(leg.times)}
        for leg, following in zip(trace.legs, trace.legs[1:], strict=False):
            assert following.times[0] == leg.times[-1]
            assert math.dist(following.places[0], leg.places[-1]) < 1e-9


def test_an_adversary_of_ones_own() -> None:
    calls = []

    def swinging(now: Situation) -> Choices:
        calls.append(len(now))
        side = np.where(np.floor(2.0 * now.time) % 2 == 0, 1.0, -1.0)
        return now.choices(side * now.cone, duration=0.5)

    strategy = planned("peg-in-hole")
    report = run(strategy, control={"swinging": swinging}, sensing="noise", options=RunOptions(10))
    assert report.failures == 0
    assert report.tallies[0].control == "swinging"
    assert calls


def test_runs_can_be_watched_and_stopped() -> None:
    seen: list[tuple[int, int]] = []
    report = run(
        planned("flat-floor"),
        control=["left", "right"],
        sensing="true",
        options=RunOptions(10),
        progress=lambda done, total: seen.append((done, total)),
        cancelled=lambda: len(seen) == 1,
    )
    assert seen == [(10, 20)]
    assert report.runs == 10


def test_refusals() -> None:
    strategy = planned("flat-floor")
    with pytest.raises(ValueError, match="control is 'nobody'"):
        run(strategy, control="nobody")
    with pytest.raises(PreimageError, match="unsolvable"):
        run(planned("cradle", Method.KERNEL))


# --- starts ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["peg-in-hole", "figure-6", "cradle", "example-3"])
def test_starts_lie_in_their_region_on_all_its_parts(name: str) -> None:
    strategy = planned(name)
    space = strategy.space
    n = len(space.contact)
    for number in strategy.steps:
        region = strategy.region(number).region
        robots = of_region(space, region, 400, np.random.default_rng(1))
        assert len(robots) == 400
        assert np.all(is_in(space, region, robots, 0.0))
        kinds = np.unique(np.where(robots.feature < n, 0, np.where(robots.feature < 2 * n, 1, 2)))
        wanted = [
            kind
            for kind, there in enumerate(
                (len(region.contact.edge), len(region.contact.vertices), not region.area.is_empty)
            )
            if there
        ]
        assert kinds.tolist() == wanted


def test_starts_may_be_points() -> None:
    strategy = planned("flat-floor")
    space, contact = strategy.space, strategy.space.contact
    edge = int(contact.edges[0])
    middle = contact.at(np.array([edge], np.int32), np.array([0.5 * contact.length[edge]]))[0]
    peg = planned("peg-in-hole").space
    inner = np.intersect1d(np.flatnonzero(peg.contact.concave), peg.valid.contact.vertices)
    corner = peg.contact.points[inner[0]]
    inside = space.free.geometry.representative_point()
    rng = np.random.default_rng(0)
    for point, kind, where in (
        (middle, StartKind.EDGE_POINT, space),
        (corner, StartKind.VERTEX, peg),
        ((inside.x, inside.y), StartKind.FREE_POINT, space),
    ):
        place = InitialPoint((float(point[0]), float(point[1])))
        start = start_region(replace(strategy.task, initial=place), where)
        assert start.kind is kind
        robots = of_start(where, start, 3, rng)
        assert np.allclose(robots.places, point, atol=1e-9)


def test_an_empty_region_has_no_start() -> None:
    with pytest.raises(ValueError, match="no place"):
        of_region(planned("flat-floor").space, Region.empty(), 3, np.random.default_rng(0))
