"""Margins: closed forms, plans made anew at them and beyond, and what they do with the task."""

import json
import math
from dataclasses import replace
from functools import cache
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import preimage
from preimage.configuration.goals import goal_region
from preimage.configuration.start import covered, start_region
from preimage.preimages.methods import preimage as preimage_of
from preimage.preimages.setting import Setting
from preimage.search.cones import widened
from preimage.search.limits import Limits
from preimage.search.margins import RELATIVE, largest, margins
from preimage.search.planner import plan
from preimage.strategy.describe import describe
from preimage.strategy.margins import Margins
from preimage.strategy.plan_file import format_plan, plan_to_dict, read_plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task
from preimage.task.files import dump_task
from preimage.task.goal import Goal
from preimage.task.initial import InitialPoint
from preimage.task.options import PlannerOptions, StrategyKind
from preimage.task.parse import parse_task
from preimage.task.task import Task
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import Window, Workspace
from preimage.verification.verdict import Verdict
from tests.search.three_notches import or_fail

DOWN = 1.5 * math.pi
BOUNDED = ["peg-in-hole-point", "example-1", "example-4", "cradle", "connector", "figure-10"]
"""Whose position error is bounded."""

NAMED = ["flat-floor", *BOUNDED, "blind-cradle", "l-room", "rails"]
SAFE = 1.0 - 1e-9


@cache
def measured(name: str) -> Strategy:
    return margins(plan(named_task(name)))


def known(strategy: Strategy) -> Margins:
    assert strategy.margins is not None
    return strategy.margins


def with_bounds(task: Task, **bounds: Any) -> Task:
    return replace(task, uncertainty=replace(task.uncertainty, **bounds))


def along(strategy: Strategy) -> list[float]:
    """The directions of a linear plan, the first motion first."""
    motions = [strategy.region(step).motion for step in strategy.steps]
    return [motion.direction for motion in motions if motion is not None]


def leads(task: Task, directions: list[float], turn: float = 0.0) -> bool:
    """Whether the chain of preimages along these directions holds the start."""
    setting = Setting.of(task)
    region = goal_region(task, setting.space)
    for direction in reversed(directions):
        wide = widened(setting, turn, [region]) if turn else setting
        if wide is None:
            return False
        region = preimage_of(wide, region, direction, task.options.method).region
    return covered(start_region(task, setting.space), region, setting.space)


def again(strategy: Strategy, task: Task) -> Strategy:
    """Planned for another task, with no other directions and in no more motions."""
    options = replace(
        task.options, directions=tuple(along(strategy)), max_steps=len(strategy.steps)
    )
    return plan(replace(task, options=options), reasoned=False)


def scaled(task: Task, factor: float) -> Task:
    """The task in another unit of length."""

    def grow(data: Any) -> Any:
        if isinstance(data, dict):
            return {word: grow(value) for word, value in data.items()}
        if isinstance(data, list):
            return [grow(value) for value in data]
        return data if isinstance(data, str) else data * factor

    document = dump_task(task)
    for word in ("window", "obstacles", "robot", "initial", "goal"):
        document[word] = grow(document[word])
    uncertainty = document["uncertainty"]
    uncertainty["position"] = grow(uncertainty["position"])
    return parse_task(document)


# --- closed forms -----------------------------------------------------------------------------


def square(
    x: float, height: float, half: float, position: float, control: float
) -> tuple[Task, float]:
    """A square in free space that only the position tells, from above; and its kernel's half."""
    corners = ((-half, -half), (half, -half), (half, half), (-half, half))
    task = Task(
        workspace=Workspace(Window(-20.0, -20.0, 20.0, 20.0), frozenset(), ()),
        uncertainty=Uncertainty(control, position),
        initial=InitialPoint((x, height)),
        goal=Goal(polygons=(corners,)),
        options=PlannerOptions(directions=(DOWN,), max_steps=1),
    )
    return task, half - 2.0 * position


@given(
    st.floats(-0.8, 0.8), st.floats(6.0, 12.0), st.floats(3.0, 5.0), st.floats(0.1, 0.6),
    st.floats(0.0, 0.04),
)  # fmt: skip
@settings(max_examples=15)
def test_square_in_free_space(
    x: float, height: float, half: float, position: float, control: float
) -> None:
    """The cone that falls from the start must meet the top of the kernel, all of it."""
    task, kernel = square(x, height, half, position, control)
    found = known(margins(plan(task)))
    tan = math.tan(control)
    depth = (kernel - abs(x) - (height - kernel) * tan) * math.cos(control)
    assert found.start == pytest.approx(depth, rel=1e-3, abs=1e-3)
    smallest = (abs(x) + height * tan) / (1.0 + tan)  # of all kernels that it meets
    reading = 0.5 * (half - smallest) - position
    assert found.reading is not None
    assert (1.0 - RELATIVE) * reading - 0.02 <= found.reading <= reading + 1e-6
    direction = math.atan2(kernel - abs(x), height - kernel) - control
    assert found.direction is not None
    assert (1.0 - RELATIVE) * direction - 0.01 <= found.direction <= direction + 1e-9
    assert found.force is None


def test_flat_floor() -> None:
    found = known(measured("flat-floor"))
    turn = math.radians(10.0)
    assert found.start == pytest.approx(2.0 * math.cos(turn) - 5.0 * math.sin(turn), rel=1e-4)
    assert found.reading == math.inf  # contact alone tells: it is the only floor there is
    assert found.direction is not None
    half = math.atan2(2.0, 5.0) - turn
    assert (1.0 - RELATIVE) * half <= found.direction <= half


# --- at the margin, and beyond it -------------------------------------------------------------


@pytest.mark.parametrize("name", BOUNDED)
def test_readings_may_be_off_so_far_and_hardly_further(name: str) -> None:
    strategy = measured(name)
    task, more = strategy.task, known(strategy).reading
    assert more is not None
    assert 0.0 < more < math.inf
    position = task.uncertainty.position
    worse = with_bounds(task, position=position + more)
    assert leads(worse, along(strategy))
    other = again(strategy, worse)
    assert other.status is Status.SOLVED
    assert preimage.verify(other, runs=0).verdict is not Verdict.REFUTED
    beyond = with_bounds(task, position=position + (1.0 + 1.2 * RELATIVE) * more)
    assert not leads(beyond, along(strategy))


@pytest.mark.parametrize("name", NAMED)
def test_directions_may_be_off_so_far_and_hardly_further(name: str) -> None:
    strategy = measured(name)
    task, turn = strategy.task, known(strategy).direction
    assert turn is not None
    assert turn > 0.0
    assert leads(task, along(strategy), turn)
    assert not leads(task, along(strategy), (1.0 + 1.2 * RELATIVE) * turn)


@pytest.mark.parametrize("name", ["flat-floor", "peg-in-hole-point", "cradle", "example-1"])
def test_turned_plans_are_not_refuted(name: str) -> None:
    """A plan for the wider cone, commanded with all directions off by the margin."""
    strategy = measured(name)
    task, turn = strategy.task, known(strategy).direction
    assert turn is not None
    wider = again(strategy, with_bounds(task, control=task.uncertainty.control + SAFE * turn))
    assert wider.status is Status.SOLVED
    for side in (-SAFE, SAFE):
        regions = tuple(
            replace(
                region,
                motion=replace(
                    region.motion, direction=(region.motion.direction + side * turn) % math.tau
                ),
            )
            if region.motion
            else region
            for region in wider.regions
        )
        turned = replace(wider, task=task, regions=regions)
        assert preimage.verify(turned, runs=1).verdict is not Verdict.REFUTED


@pytest.mark.parametrize("name", ["flat-floor", "peg-in-hole-point", "example-4"])
def test_starts_may_be_off_so_far_and_no_further(name: str) -> None:
    strategy = measured(name)
    task, space = strategy.task, strategy.space
    assert isinstance(task.initial, InitialPoint)
    (x, y), depth = task.initial.point, known(strategy).start
    assert depth is not None
    region = strategy.region(strategy.start[0]).region

    def moved(by: float, turn: int) -> bool:
        angle = math.tau * turn / 720
        place = x + by * math.cos(angle), y + by * math.sin(angle)
        if not (space.free.contains(*place) and space.free.depth(*place) > 0.01):
            return True
        return region.area.contains(*place)

    assert all(moved(0.999 * depth, turn) for turn in range(720))
    assert not all(moved(1.01 * depth, turn) for turn in range(720))


@pytest.mark.parametrize("name", ["between-posts", "l-room-anywhere", "two-bays"])
def test_policies_exist_at_their_margins(name: str) -> None:
    strategy = measured(name)
    assert strategy.kind is StrategyKind.CONDITIONAL
    task, found = strategy.task, known(strategy)
    bounds = task.uncertainty
    assert found.reading
    assert found.direction
    used = tuple({region.motion.direction for region in strategy.regions if region.motion})
    most = max(strategy.region(number).rank for number in strategy.start)
    options = replace(task.options, directions=used, max_steps=most)
    for changed in (
        {"position": bounds.position + found.reading},
        {"control": bounds.control + found.direction},
    ):
        worse = with_bounds(replace(task, options=options), **changed)
        assert plan(worse, reasoned=False).status is Status.SOLVED


# --- laws -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["peg-in-hole-point", "example-4", "figure-10"])
@pytest.mark.parametrize("factor", [0.25, 8.0])
def test_another_unit_of_length_changes_lengths_alone(name: str, factor: float) -> None:
    here = known(measured(name))
    task = scaled(named_task(name), factor)
    there = known(margins(plan(task)))
    assert there.start == pytest.approx(factor * (here.start or 0.0), rel=1e-6)
    assert there.reading == pytest.approx(factor * (here.reading or 0.0), rel=1e-6)
    assert there.direction == pytest.approx(here.direction, rel=1e-6)
    assert there.force == here.force
    assert there.smallest(task) == pytest.approx(here.smallest(named_task(name)), rel=1e-6)


@pytest.mark.parametrize("name", ["peg-in-hole-point", "example-1", "example-4"])
def test_larger_errors_leave_smaller_margins(name: str) -> None:
    task, before = named_task(name), math.inf
    least = known(measured(name)).reading or 0.0
    for share in (0.0, 0.3, 0.6):
        strategy = plan(with_bounds(task, position=task.uncertainty.position + share * least))
        found = margins(again(measured(name), strategy.task))
        assert found.margins is not None
        assert found.margins.reading is not None
        assert found.margins.reading <= before * (1.0 + RELATIVE)
        assert found.margins.reading >= (1.0 - share) * least * (1.0 - 2.0 * RELATIVE)
        before = found.margins.reading


@given(st.floats(1e-6, 9.0), st.floats(1e-3, 5.0), st.floats(0.1, 10.0))
def test_largest_amount_is_found_from_below(limit: float, first: float, most: float) -> None:
    asked: list[float] = []

    def works(amount: float) -> bool:
        asked.append(amount)
        return amount <= limit

    found = largest(works, first, most)
    assert found <= min(limit, most)
    assert found == 0.0 or found in asked
    begun = max(min(first, 0.5 * most), most * 0.5**20)
    if min(limit, most) >= 1.05 * begun * 0.5**10:
        assert found >= (1.0 - RELATIVE) * min(limit, most)
    assert len(asked) <= 40


@pytest.mark.parametrize("most", [0.0, -1.0])
def test_nothing_is_asked_below_nothing(most: float) -> None:
    assert largest(lambda amount: True, 1.0, most) == 0.0


# --- what has no margins ----------------------------------------------------------------------


def test_what_is_not_solved_has_none() -> None:
    task = named_task("flat-floor")
    options = replace(task.options, directions=(0.5 * math.pi,))
    strategy = plan(replace(task, options=options), reasoned=False)
    assert margins(strategy) is strategy


def test_nothing_to_do_cannot_go_wrong() -> None:
    task, _ = square(0.5, 0.25, 3.0, 0.1, 0.02)
    found = known(margins(plan(task)))
    assert found.start == pytest.approx(2.5)
    assert replace(found, start=None) == Margins(None, math.inf, None, math.inf)


def test_of_a_plan_that_may_fail_the_start_alone_is_known() -> None:
    found = known(margins(or_fail()))
    assert (found.reading, found.force, found.direction) == (None, None, None)


def test_without_time_nothing_is_known() -> None:
    strategy = plan(named_task("flat-floor"))
    found = known(margins(strategy, Limits(None, 100, lambda: True)))
    assert found.start == known(measured("flat-floor")).start
    assert (found.reading, found.force, found.direction) == (None, None, None)


def test_a_false_plan_has_no_margins() -> None:
    strategy = plan(named_task("flat-floor"))
    regions = tuple(
        replace(region, motion=replace(region.motion, direction=0.0)) if region.motion else region
        for region in strategy.regions
    )
    found = known(margins(replace(strategy, regions=regions)))
    assert (found.reading, found.force, found.direction) == (None, None, None)


# --- units, words and files -------------------------------------------------------------------


def test_smallest_in_units_of_the_bounds() -> None:
    task = named_task("flat-floor")
    position, control = task.uncertainty.position, task.uncertainty.control
    good = Margins(2.0 * position, 3.0 * position, math.inf, 4.0 * control)
    assert good.smallest(task) == pytest.approx(2.0)
    assert replace(good, start=math.inf).smallest(task) == pytest.approx(3.0)
    assert replace(good, force=task.uncertainty.force_angle).smallest(task) == pytest.approx(1.0)
    assert replace(good, direction=None).smallest(task) == 0.0
    assert replace(good, force=None).smallest(task) == 0.0
    blind = with_bounds(task, position=math.inf, control=0.0)
    assert replace(good, start=0.8).smallest(blind) == pytest.approx(3.0 * position / 0.4)
    assert Margins(4.0, math.inf, math.inf, math.radians(3.0)).smallest(blind) == pytest.approx(3.0)


def test_margins_are_told() -> None:
    lines = describe(measured("peg-in-hole-point")).splitlines()
    (line,) = (line for line in lines if line.startswith("margins: "))
    found = known(measured("peg-in-hole-point"))
    assert line.startswith(f"margins: start {found.start:.3g}, position error +{found.reading:.3g}")
    assert line.endswith(f"every direction ±{math.degrees(found.direction or 0.0):.3g}°")
    assert "margins" not in describe(plan(named_task("flat-floor")))


@pytest.mark.parametrize("name", ["flat-floor", "peg-in-hole-point", "l-room-anywhere"])
def test_plan_files_keep_margins(name: str) -> None:
    text = format_plan(measured(name))
    strategy = read_plan(json.loads(text))
    assert format_plan(strategy) == text
    one, other = known(strategy), known(measured(name))
    assert (one.start, one.reading) == (other.start, other.reading)
    assert one.direction == pytest.approx(other.direction, rel=1e-15)
    assert "margins" not in plan_to_dict(replace(strategy, margins=None))
