import dataclasses
import json
import os
import stat
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from preimage.configuration.region import is_subset
from preimage.errors import PlanFileError
from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.search.planner import plan
from preimage.strategy.plan_file import format_plan, plan_to_dict, read_plan, write_plan
from preimage.strategy.plan_schema import plan_schema
from preimage.strategy.strategy import Statistics, Status
from preimage.task.examples import named_task, named_tasks
from preimage.task.options import Method, StrategyKind
from tests.strategy.plans import plan_data, planned


@pytest.mark.parametrize("name", [*named_tasks(), "comb-4", "saw-tooth-3", "hall-6"])
@pytest.mark.parametrize("method", Method)
def test_reading_and_writing_gives_the_same_bytes(name: str, method: Method) -> None:
    task = named_task(name)
    options = dataclasses.replace(task.options, method=method, max_regions=60, max_steps=4)
    strategy = plan(dataclasses.replace(task, options=options))
    text = format_plan(strategy)
    again = read_plan(json.loads(text))
    assert format_plan(again) == text
    assert again.task == strategy.task
    assert (again.status, again.kind) == (strategy.status, strategy.kind)
    assert (again.start, again.steps) == (strategy.start, strategy.steps)
    for one, other in zip(again.regions, strategy.regions, strict=True):
        assert (one.id, one.rank) == (other.id, other.rank)
        assert is_subset(one.region, other.region, strategy.space.tolerance)
        assert is_subset(other.region, one.region, strategy.space.tolerance)
        if other.motion is not None:
            assert one.motion is not None
            assert one.motion.direction == other.motion.direction
            assert one.motion.goals == other.motion.goals
            assert one.motion.termination[:1] == other.motion.termination[:1] or isinstance(
                other.motion.termination[0], ReadingCondition
            )


def test_the_same_task_gives_the_same_bytes_but_for_the_time() -> None:
    task = named_task("peg-in-hole")
    texts = []
    for _ in range(2):
        strategy = plan(task)
        statistics = dataclasses.replace(strategy.statistics, seconds=0.0)
        texts.append(format_plan(dataclasses.replace(strategy, statistics=statistics)))
    assert texts[0] == texts[1]


def test_the_text_is_the_data() -> None:
    strategy = planned("peg-in-hole")
    text = format_plan(strategy)
    assert json.loads(text) == plan_to_dict(strategy)
    assert list(json.loads(text)) == [
        "version", "task", "status", "strategy", "regions", "start", "steps", "statistics",
    ]  # fmt: skip
    assert text.endswith("}\n")


def test_the_data_are_plain() -> None:
    def check(value: object) -> None:
        assert type(value) in (dict, list, str, int, float), type(value)
        if isinstance(value, dict | list):
            for inner in value.values() if isinstance(value, dict) else value:
                check(inner)

    check(plan_to_dict(planned("peg-in-hole")))


def test_files_are_written_whole(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    strategy = planned("flat-floor")
    write_plan(strategy, path)
    assert path.read_text(encoding="utf-8") == format_plan(strategy)
    assert format_plan(read_plan(path)) == format_plan(strategy)
    path.chmod(0o640)
    link = tmp_path / "link.json"
    link.symlink_to(path)
    write_plan(strategy, link)
    assert link.is_symlink()
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert sorted(os.listdir(tmp_path)) == ["link.json", "plan.json"]
    with pytest.raises(OSError, match="No such file"):
        write_plan(strategy, tmp_path / "nowhere" / "plan.json")


def test_foreign_plans() -> None:
    data = plan_data("flat-floor")
    del data["statistics"]
    goal, first = data["regions"]
    # a second preimage, a choice between both goals, all kinds of conditions
    area = {"type": "Polygon", "coordinates": [[[0, 1], [1, 1], [1, 2], [0, 2], [0, 1]]]}
    second = {
        "id": 7, "rank": 2, "direction": -90, "geometry": area,
        "goals": [first["id"], 0], "target": first["geometry"],
        "termination": [
            {"kind": "elapsed", "period": 3},
            {"kind": "sticking", "period": 2.5, "distance": 0.25},
            {"kind": "reading", "domain": "valid"},
            {"kind": "reading", "domain": first["geometry"]},
        ],
    }  # fmt: skip
    data |= {"strategy": "conditional", "regions": [second, first, goal], "start": [7, 1]}
    data["steps"] = []
    strategy = read_plan(data)
    assert strategy.kind is StrategyKind.CONDITIONAL
    motion = strategy.region(7).motion
    assert motion is not None
    assert motion.direction == pytest.approx(4.71238898038469)
    assert motion.goals == (first["id"], 0)
    assert motion.termination[:3] == (
        ElapsedCondition(3.0),
        StickingCondition(2.5, 0.25),
        motion.termination[2],
    )
    domains = [one.domain for one in motion.termination if isinstance(one, ReadingCondition)]
    assert domains[0] is None
    assert domains[1] is not None
    assert strategy.statistics == Statistics(regions=3)
    text = format_plan(strategy)
    assert format_plan(read_plan(json.loads(text))) == text


def test_a_start_in_the_goal_needs_no_steps() -> None:
    data = plan_data("flat-floor")
    data |= {"regions": data["regions"][:1], "start": [0], "steps": []}
    assert read_plan(data).status is Status.SOLVED


@pytest.mark.parametrize("status", [Status.UNSOLVABLE, Status.STOPPED])
def test_without_a_strategy_what_was_found_is_kept(status: Status) -> None:
    data = plan_data() | {"status": status.value, "start": [], "steps": []}
    strategy = read_plan(data)
    assert strategy.status is status
    assert len(strategy.regions) == 3
    assert json.loads(format_plan(strategy)) == data


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"start": 0.5, "reading": "inf", "force": 12.5, "direction": 3.1},
        {"start": 0, "direction": "inf"},
        {"reading": 0.1, "direction": 180},
    ],
)
def test_margins_that_others_wrote(given: dict[str, Any]) -> None:
    data = plan_data()
    data["margins"] = given
    strategy = read_plan(data)
    jsonschema.Draft202012Validator(plan_schema()).validate(data)
    kept = plan_to_dict(strategy)
    assert list(kept)[-1] == "margins"
    assert kept["margins"] == given
    again = format_plan(strategy)
    assert format_plan(read_plan(json.loads(again))) == again


def test_margins_of_a_plan_that_is_none_are_refused() -> None:
    data = plan_data()
    data |= {"status": "stopped", "margins": {"start": 1}}
    with pytest.raises(PlanFileError, match="margins: must not be given"):
        read_plan(data)
