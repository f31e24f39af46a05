from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from preimage.analysis.axis import Bound, task_at, with_bound
from preimage.analysis.cell import length
from preimage.analysis.counter import beaten
from preimage.analysis.explanation import explain
from preimage.analysis.explanation_words import describe_explanation
from preimage.analysis.survey import Survey
from preimage.configuration.start import covered, start_region
from preimage.execution.trace import Trace
from preimage.geometry.angles import wrap
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.examples import named_task
from preimage.task.options import StrategyKind
from preimage.task.task import Task


def unsolvable(name: str, control: float) -> Task:
    return with_bound(named_task(name), Bound.CONTROL, control)


CASES = [
    unsolvable("peg-in-hole", 22.0),
    unsolvable("connector", 35.0),
    unsolvable("cradle", 35.0),
    named_task("peg-in-hole"),
    named_task("landmark-edge"),
]


@pytest.mark.parametrize("task", CASES, ids=lambda task: task.name)
def test_nature_beats_the_most_promising_motion(task: Task) -> None:
    found = explain(Survey.of(task), budgeted=False)
    assert found.asked is not None
    assert found.asked.status is not Status.SOLVED
    assert found.counter is not None
    trace = found.counter.trace
    assert trace is not None
    _follows_the_rules(trace)
    start = start_region(task, found.asked.space)
    first = trace.legs[0].places[0]
    if start.point is not None:
        assert np.allclose(first, start.point, atol=1e-5)
    else:
        around = start.region.area.bounds
        assert around[0] - 1e-5 <= first[0] <= around[2] + 1e-5
        assert around[1] - 1e-5 <= first[1] <= around[3] + 1e-5
    direction = trace.legs[0].direction
    assert direction in {why.direction for why in found.asked.why}
    words = describe_explanation(found)
    assert found.counter.words.split()[0] in words


def _follows_the_rules(trace: Trace) -> None:
    """Free flights keep to the control cone, and nothing goes through the target's features."""
    task, space = trace.strategy.task, trace.strategy.space
    for leg in trace.legs:
        free = 2 * len(space.contact)
        steps = np.diff(leg.places, axis=0)
        for step, feature in zip(steps, leg.features[1:], strict=True):
            if feature == free and np.hypot(*step) > 1e-4:
                off = wrap(np.arctan2(step[1], step[0]) - leg.direction)
                assert abs(off) <= task.uncertainty.control + 1e-3
        assert np.all(np.diff(leg.times) >= 0.0)


@pytest.mark.parametrize("name", ["peg-in-hole", "landmark-edge", "cradle"])
def test_why_a_plan_is_no_shorter_is_asked_of_as_many_motions_less_one(name: str) -> None:
    task = named_task(name)
    found = explain(Survey.of(task), budgeted=False)
    motions = length(found.plan)
    assert motions is not None
    assert motions > 1
    assert found.asked is not None
    assert found.asked.task.options.max_steps == motions - 1
    assert max(region.rank for region in found.asked.regions) <= motions - 1


def test_what_remains_of_the_start_is_in_no_region() -> None:
    task = named_task("conditional-hall")
    options = replace(task.options, strategy=StrategyKind.LINEAR, max_steps=2)
    found = explain(Survey.of(replace(task, options=options)), budgeted=False)
    assert found.asked is not None
    rest, space = found.remaining, found.asked.space
    assert not rest.is_empty
    start = start_region(task, space).region
    assert rest.area.measure <= start.area.measure * (1.0 + 1e-9)
    corners = np.concatenate(list(rest.area.rings))
    inner = corners.mean(axis=0)[None, :]
    for region in found.asked.regions:
        held = region.region.area.contains_all(inner) & rest.area.contains_all(inner)
        assert not held.any()


def test_the_cheapest_change_comes_first_and_works() -> None:
    task = unsolvable("peg-in-hole", 22.0)
    survey = Survey.of(task)
    found = explain(survey, ["control", "position", "friction"])
    efforts = [one.effort for one in found.changes]
    assert efforts == sorted(efforts)
    best = found.changes[0]
    assert best.value is not None
    changed = task_at(survey.template, survey.options, {best.axis.key: best.value})
    assert plan(changed).status is Status.SOLVED


def test_a_plan_of_one_motion_needs_no_explanation() -> None:
    found = explain(Survey.of(named_task("flat-floor")))
    assert found.asked is None
    assert "nothing to explain" in describe_explanation(found)


def test_a_start_that_is_covered_in_parts_says_so() -> None:
    task = named_task("two-bays")
    task = replace(task, options=replace(task.options, strategy=StrategyKind.LINEAR))
    found = explain(Survey.of(task), budgeted=False)
    assert found.asked is not None
    assert found.remaining.is_empty
    assert "not all of them in one" in " ".join(describe_explanation(found).split())
    start = start_region(task, found.asked.space)
    assert not any(covered(start, one.region, found.asked.space) for one in found.asked.regions)


def test_a_plan_is_beaten_by_larger_errors_only() -> None:
    task = named_task("peg-in-hole")
    made = plan(task)
    assert beaten(made, task) is None
    assert beaten(made, with_bound(task, Bound.CONTROL, 30.0)) is not None
