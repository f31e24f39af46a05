from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from preimage.analysis.axis import Axis, axis_of, default_bounds, task_at
from preimage.analysis.budget import Budget, budget
from preimage.analysis.cell import Answer, Cell, planned
from preimage.analysis.survey import CancelledError, Survey
from preimage.errors import InputError
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.examples import named_task
from preimage.task.template import Template, named_template
from preimage.verification.verdict import Verdict
from preimage.verification.verify import verify

TASKS = ("peg-in-hole", "landmark-edge")


@cache
def survey_of(name: str) -> Survey:
    return Survey.of(named_task(name))


@cache
def budget_of(name: str) -> Budget:
    return budget(survey_of(name), ["control", "position", "friction"])


def test_the_control_error_of_one_motion_onto_a_floor_has_a_closed_form() -> None:
    # from (0, 5) onto [-2, 2] on the floor: tan theta = 2 / 5
    task = named_task("flat-floor")
    one = replace(task, options=replace(task.options, max_steps=1))
    found = budget(Survey.of(one), ["control"], resolutions={"control": 0.001}).axes[0]
    (limit,) = found.limits
    exact = math.degrees(math.atan2(2.0, 5.0))
    assert limit.inside <= exact <= limit.outside
    assert limit.outside - limit.inside == pytest.approx(0.001)
    assert found.slack == pytest.approx(exact - 10.0, abs=0.002)
    assert (limit.cause.motions, limit.cause.of) == ((1,), 1)


def test_the_position_error_of_a_kernel_has_a_closed_form() -> None:
    # straight down onto [-2, 2] without force: the floor beside the goal reads the same, so that
    # the kernel is [-2 + 2 rho, 2 - 2 rho], and 5 tan theta has to fit into it
    task = named_task("flat-floor")
    options = replace(task.options, max_steps=1, method=task.options.method.KERNEL)
    one = replace(task, options=options)
    found = budget(Survey.of(one), ["position"], resolutions={"position": 0.001}).axes[0]
    (limit,) = found.limits
    exact = 0.5 * (2.0 - 5.0 * math.tan(task.uncertainty.control))
    assert limit.inside <= exact <= limit.outside


@pytest.mark.parametrize("name", TASKS)
def test_inside_a_limit_a_plan_is_proven_and_outside_it_is_beaten(name: str) -> None:
    survey, found = survey_of(name), budget_of(name)
    limits = [(axis, limit) for axis in found.axes for limit in axis.limits]
    assert limits
    for axis, limit in limits:
        inside, outside = (
            Cell.at(survey.options.method, **{axis.axis.key: value})
            for value in (limit.inside, limit.outside)
        )
        kept = planned(survey.template, survey.options, inside)
        assert verify(kept, runs=1).verdict is Verdict.PROVEN
        assert planned(survey.template, survey.options, outside).status is not Status.SOLVED
        changed = task_at(survey.template, kept.task.options, dict(outside.values))
        beaten = verify(replace(kept, task=changed), runs=0)
        assert beaten.verdict is Verdict.REFUTED
        assert beaten.counterexample is not None


@pytest.mark.parametrize("name", TASKS)
def test_between_its_ends_a_stretch_has_one_answer(name: str) -> None:
    survey, found = survey_of(name), budget_of(name)
    for axis in found.axes:
        assert axis.stretches[0].low == axis.axis.low
        assert axis.stretches[-1].high == axis.axis.high
        for stretch in axis.stretches:
            middle = 0.5 * (stretch.low + stretch.high)
            if not axis.axis.monotone:
                continue
            cell = Cell.at(survey.options.method, **{axis.axis.key: middle})
            outcome = survey.ask([cell])[cell]
            assert (outcome.answer, outcome.motions) == (
                stretch.outcome.answer,
                stretch.outcome.motions,
            )


@pytest.mark.parametrize("name", TASKS)
def test_more_error_takes_more_motions(name: str) -> None:
    for axis in budget_of(name).axes:
        if axis.axis.monotone:
            motions = [
                math.inf if one.outcome.motions is None else one.outcome.motions
                for one in axis.stretches
            ]
            assert motions == sorted(motions)
            assert axis.spacing is None
        else:
            assert axis.spacing is not None


def test_the_motion_that_binds_breaks_the_plan_alone() -> None:
    survey, found = survey_of("peg-in-hole"), budget_of("peg-in-hole")
    for axis in found.axes:
        for limit in axis.limits:
            assert limit.cause.words
            assert all(1 <= place <= limit.cause.of for place in limit.cause.motions)
            cell = Cell.at(survey.options.method, **{axis.axis.key: limit.inside})
            assert len(planned(survey.template, survey.options, cell).steps) == limit.cause.of
            if limit.cause.reason is not None:
                assert limit.cause.reason.words in limit.cause.words or limit.cause.reason.origin


def test_without_a_plan_the_cheapest_change_makes_one() -> None:
    template = Template.of(named_task("peg-in-hole"))
    options = template.task().options
    task = task_at(template, options, {"uncertainty.control": 22.0})
    assert plan(task).status is Status.UNSOLVABLE
    found = budget(Survey.of(task), ["control", "position", "friction"])
    assert found.given.answer is Answer.UNSOLVABLE
    assert all(axis.slack is None for axis in found.axes)
    best = found.cheapest
    assert best is not None
    assert best.change is not None
    changed = task_at(Template.of(task), options, {best.axis.key: best.change})
    assert plan(changed).status is Status.SOLVED
    effort = {
        one.axis.name: abs(one.change - one.axis.given) / one.axis.given
        for one in found.axes
        if one.change is not None
    }
    assert effort[best.axis.name] == min(effort.values())


def test_a_parameter_is_a_bound_like_any_other() -> None:
    template = named_template("tight-hole")
    found = budget(
        Survey.of(template), ["clearance"], ranges={"clearance": (0.0, 1.0)},
        resolutions={"clearance": 0.01},
    ).axes[0]  # fmt: skip
    assert found.axis.key == "parameters.clearance"
    assert found.spacing is not None
    assert found.limits
    for limit in found.limits:
        assert plan(template.task(clearance=limit.inside)).status is Status.SOLVED
        assert abs(limit.outside - limit.inside) == pytest.approx(0.01)


def test_a_budget_is_the_same_from_a_store(tmp_path: Path) -> None:
    path = tmp_path / "cells"
    task = named_task("flat-floor")
    task = replace(task, options=replace(task.options, max_steps=1))
    fresh = budget(Survey.of(task), ["control", "position"])
    seen: list[int] = []
    survey = Survey.of(task, store=path, cancelled=lambda: len(seen) > 4)
    survey.progress = lambda done, _wanted: seen.append(done)
    with pytest.raises(CancelledError):
        budget(survey, ["control", "position"])
    survey.close()
    survey = Survey.of(task, store=path)
    assert 0 < len(survey.store) < fresh.cells
    resumed = budget(survey, ["control", "position"])
    survey.close()
    assert [(one.stretches, one.limits) for one in resumed.axes] == [
        (one.stretches, one.limits) for one in fresh.axes
    ]
    assert resumed.cells == fresh.cells


@pytest.mark.parametrize(
    ("name", "within", "resolution", "rule"),
    [
        ("contrl", None, None, "did you mean control"),
        ("control", (0.0, 95.0), None, "must lie within 0 to 89"),
        ("control", (-1.0, 5.0), None, "must lie within"),
        ("control", (5.0, 5.0), None, "rise"),
        ("control", (math.nan, 5.0), None, "rise"),
        ("control", (0.0, math.inf), None, "rise"),
        ("control", None, 0.0, "above 0"),
        ("control", None, math.nan, "above 0"),
        ("position", (0.0, 1e9), None, "must lie within"),
    ],
)
def test_what_cannot_be_varied_is_refused(
    name: str, within: tuple[float, float] | None, resolution: float | None, rule: str
) -> None:
    with pytest.raises(InputError, match=rule):
        axis_of(Template.of(named_task("peg-in-hole")), name, within, resolution)


def test_a_task_without_a_force_sensor_has_no_bound_on_it() -> None:
    task = named_task("peg-in-hole")
    task = replace(task, uncertainty=replace(task.uncertainty, force_thresholds=(math.inf,) * 2))
    with pytest.raises(InputError, match="no force sensor"):
        axis_of(Template.of(task), "force")
    assert default_bounds(Template.of(task)) == ["control", "position", "friction"]


@pytest.mark.parametrize("step", [1e-7, 0.003, 0.05, 2.0])
def test_values_of_an_axis_are_decimal(step: float) -> None:
    axis = axis_of(Template.of(named_task("peg-in-hole")), "control", (0.1, 3.0), step)
    assert isinstance(axis, Axis)
    assert axis.step <= step or axis.steps > 100_000
    assert axis.value(0) >= 0.1 or math.isclose(axis.value(0), 0.1)
    assert axis.high <= 3.0
    for place in (0, 1, axis.steps // 2, axis.steps):
        assert float(f"{axis.value(place):.9f}") == axis.value(place)
        assert round((axis.value(place) - axis.low) / axis.step) == place
