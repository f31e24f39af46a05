"""Pictures of budgets, maps and explanations."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.patches import Rectangle

from preimage.analysis.budget import Budget, budget
from preimage.analysis.budget_file import format_budget, format_map
from preimage.analysis.cell import Answer
from preimage.analysis.describe import describe_budget, describe_map
from preimage.analysis.explanation import explain
from preimage.analysis.map import ErrorMap, error_map
from preimage.analysis.survey import Survey
from preimage.rendering import draw, figure
from preimage.task.examples import named_task


@pytest.fixture(scope="module")
def table() -> Budget:
    return budget(Survey.of(named_task("peg-in-hole")), ["control", "position", "friction"])


@pytest.fixture(scope="module")
def chart() -> ErrorMap:
    task = named_task("peg-in-hole")
    return error_map(Survey.of(task), "control", "position", places=(7, 6))


def test_each_bound_has_a_bar_with_its_stretches(table: Budget) -> None:
    made = figure(table)
    bars = {axes.get_gid(): axes for axes in made.axes}
    assert set(bars) == {f"bound-{axis.axis.name}" for axis in table.axes}
    for axis in table.axes:
        axes = bars[f"bound-{axis.axis.name}"]
        drawn = [one for one in axes.patches if isinstance(one, Rectangle)]
        low, high = axes.get_xlim()
        shown = [one for one in axis.stretches if one.low < high]
        assert len(drawn) == len(shown)
        assert math.isclose(sum(one.get_width() for one in drawn), high - low, rel_tol=1e-9)
        assert low <= axis.axis.given <= high
    words = " ".join(text.get_text() for text in made.texts)
    assert "motion" in words
    for axis in table.axes:
        for limit in axis.limits[:1]:
            assert limit.cause.words.split("(")[0] in words


def test_a_map_shows_its_frontier_and_what_is_given(chart: ErrorMap) -> None:
    (axes,) = figure(chart).axes
    names = {line.get_gid() for line in axes.lines}
    assert {"frontier", "given", "looked-at"} <= names
    assert axes.get_xlabel() == "uncertainty.control (°)"
    assert axes.get_ylabel() == "uncertainty.position"


def test_an_explanation_shows_what_stands_in_the_way_and_what_nature_does() -> None:
    found = explain(Survey.of(named_task("peg-in-hole")), budgeted=False)
    assert found.counter is not None
    made = figure(found)
    assert len(made.axes) >= 2
    everything = " ".join(text.get_text() for text in made.findobj() if hasattr(text, "get_text"))
    assert "What nature may do" in everything
    assert found.counter.words[:12] in everything


def test_pictures_are_the_same_bytes_each_time(
    table: Budget, chart: ErrorMap, tmp_path: Path
) -> None:
    for name, subject in (("table", table), ("chart", chart)):
        paths = [tmp_path / f"{name}-{number}.svg" for number in (1, 2)]
        for path in paths:
            draw(subject, path)
        assert paths[0].read_bytes() == paths[1].read_bytes()


def test_words_name_every_bound_and_every_limit(table: Budget, chart: ErrorMap) -> None:
    words = " ".join(describe_budget(table).split())
    for axis in table.axes:
        assert axis.axis.key in words
        for limit in axis.limits:
            assert f"{limit.inside:.6g} | {limit.outside:.6g}" in words
    assert "not monotone" in words
    assert str(chart.looked_at) in describe_map(chart)
    assert "sampled" in words


def test_files_hold_no_infinities_and_no_times(table: Budget, chart: ErrorMap) -> None:
    import json

    content = json.loads(format_budget(table))
    assert [one["key"] for one in content["bounds"]] == [axis.axis.key for axis in table.axes]
    assert "seconds" not in format_budget(table)
    again = json.loads(format_map(chart))
    assert len(again["layers"][0]["motions"]) == 7
    assert len(again["layers"][0]["motions"][0]) == 6
    assert content["given"] == {"answer": "solved", "motions": 2}


def test_a_task_without_a_plan_is_drawn_too() -> None:
    task = named_task("peg-in-hole")
    errors = replace(task.uncertainty, control=math.radians(22.0))
    found = budget(Survey.of(replace(task, uncertainty=errors)), ["control", "force"])
    assert found.given.answer is Answer.UNSOLVABLE
    assert figure(found).axes
    assert "cheapest change" in describe_budget(found)
