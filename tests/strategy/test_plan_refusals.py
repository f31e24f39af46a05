import contextlib
import json
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.errors import PlanFileError
from preimage.strategy.plan_file import read_plan
from tests.strategy.plans import plan_data

Change = Callable[[dict[str, Any]], object]

POINT = {"type": "Point", "coordinates": [50, 50]}


def setting(value: object, *place: str | int) -> Change:
    def change(data: Any) -> None:
        for step in place[:-1]:
            data = data[step]
        data[place[-1]] = value

    return change


def without(*place: str | int) -> Change:
    def change(data: Any) -> None:
        for step in place[:-1]:
            data = data[step]
        del data[place[-1]]

    return change


FIRST = ("regions", 1)
STOP = (*FIRST, "termination", 0)

REFUSED: list[tuple[Change, str]] = [
    (setting(2, "version"), "version: must be 1, not 2"),
    (setting("1", "version"), "version: must be a number, not '1'"),
    (setting(1, "extra"), "extra: unknown key"),
    (setting(1, "step"), "step: unknown key, did you mean steps?"),
    (without("task"), "task: is missing"),
    (without("regions"), "regions: is missing"),
    (without("start"), "start: is missing"),
    (setting("fine", "status"), "status: must be solved, unsolvable or stopped, not 'fine'"),
    (setting("tree", "strategy"), "strategy: must be linear or conditional, not 'tree'"),
    (setting(-1, "task", "uncertainty", "control"), "task.uncertainty.control: must be at least 0"),
    (setting(1, "task", "extra"), "task.extra: unknown key"),
    (setting([], "task"), "task.task: must be a mapping"),
    (setting([], "regions"), "regions: must have 1 items or more"),
    (setting({}, "regions"), "regions: must be a list"),
    (setting(3, "regions", 0), "regions[0]: must be a mapping, not 3"),
    (setting(1, "regions", 0, "extra"), "regions[0].extra: unknown key"),
    (setting(0, "regions", 0, "direction"), "regions[0].direction: unknown key"),
    (setting(1, "regions", 0, "rank"), "regions[0].rank: must be 0 for the goal, not 1"),
    (setting(0, *FIRST, "rank"), "regions[1].rank: must be 1 or more for a preimage, not 0"),
    (setting(9, "regions", 0, "id"), "regions[0].direction: is missing"),
    (setting(2, *FIRST, "id"), "regions[2].id: 2 is there already"),
    (setting(1.5, *FIRST, "id"), "regions[1].id: must be a whole number, not 1.5"),
    (setting(-1, *FIRST, "id"), "regions[1].id: must be at least 0"),
    (setting(True, *FIRST, "id"), "regions[1].id: must be a number, not true"),
    (without("regions", 0), "regions: must have region 0, the goal"),
    (without(*FIRST, "target"), "regions[1].target: is missing"),
    (without(*FIRST, "termination"), "regions[1].termination: is missing"),
    (setting(math.nan, *FIRST, "direction"), "regions[1].direction: must be a finite number"),
    (setting(1e9, *FIRST, "direction"), "regions[1].direction: must be at least -36000"),
    (setting(-1, *FIRST, "margin"), "regions[1].margin: must be at least 0"),
    (setting(181, *FIRST, "margin"), "regions[1].margin: must be at least 0 and at most 180"),
    (setting("wide", *FIRST, "margin"), "regions[1].margin: must be a number, not 'wide'"),
    (setting(1, "regions", 0, "margin"), "regions[0].margin: unknown key"),
    (setting(3, "margins"), "margins: must be a mapping, not 3"),
    (setting({"slack": 1}, "margins"), "margins.slack: unknown key"),
    (setting({"start": -1}, "margins"), "margins.start: must be at least 0"),
    (setting({"reading": "wide"}, "margins"), "margins.reading: must be a number, not 'wide'"),
    (setting({"reading": math.nan}, "margins"), "margins.reading: must be"),
    (setting({"direction": 181}, "margins"), "margins.direction: must be at least 0 and at most"),
    (setting({"force": True}, "margins"), "margins.force: must be a number"),
    (setting([], *FIRST, "goals"), "regions[1].goals: must have a region"),
    (setting([5], *FIRST, "goals"), "regions[1].goals[0]: there is no region 5"),
    (setting([0, 0], *FIRST, "goals"), "regions[1].goals[1]: names region 0 again"),
    (
        setting([2], *FIRST, "goals"),
        "regions[1].goals[0]: must be of lower rank than 1, but region 2 has 2",
    ),
    (setting(POINT, *FIRST, "geometry"), "regions[1].geometry: the point (50, 50) is no contact"),
    (setting(POINT, *FIRST, "target"), "regions[1].target: the point (50, 50) is no contact"),
    (setting(None, *FIRST, "target"), "regions[1].target: must be a GeoJSON geometry, not nothing"),
    (
        setting({"type": "LineString", "coordinates": [[0, 1], [1, 1]]}, *FIRST, "geometry"),
        "regions[1].geometry: the line from (0, 1) to (1, 1) does not lie in contact space",
    ),
    (
        setting({"type": "Point", "coordinates": [0, math.inf]}, *FIRST, "geometry"),
        "regions[1].geometry.coordinates[1]: must be a finite number, not inf",
    ),
    (setting([], *FIRST, "termination"), "regions[1].termination: must have 1 items or more"),
    (setting("stop", *STOP), "regions[1].termination[0]: must be a mapping, not 'stop'"),
    (without(*STOP, "kind"), "regions[1].termination[0].kind: is missing"),
    (
        setting("touch", *STOP, "kind"),
        "regions[1].termination[0].kind: must be sticking, reading or elapsed, not 'touch'",
    ),
    (without(*STOP, "period"), "regions[1].termination[0].period: is missing"),
    (setting(0, *STOP, "period"), "regions[1].termination[0].period: must be above 0"),
    (setting(-1, *STOP, "distance"), "regions[1].termination[0].distance: must be at least 0"),
    (setting(1, *STOP, "domain"), "regions[1].termination[0].domain: unknown key"),
    (
        setting("all", *FIRST, "termination", 1, "domain"),
        "regions[1].termination[1].domain: must be valid or a GeoJSON geometry, not 'all'",
    ),
    (
        setting(POINT, *FIRST, "termination", 1, "domain"),
        "regions[1].termination[1].domain: the point (50, 50) is no contact vertex",
    ),
    (setting([], "start"), "start: must name a region, since the status is solved"),
    (setting([9], "start"), "start[0]: there is no region 9"),
    (setting(["a"], "start"), "start[0]: must be a number, not 'a'"),
    (setting([9], "steps"), "steps[0]: there is no region 9"),
    (setting([1], "steps"), "steps[0]: must be in start, and region 1 is not"),
    (setting([], "steps"), "steps: must lead from the start to region 0"),
    (
        setting([2], "steps"),
        "steps[0]: must have region 0 among its goals, and region 2 has not",
    ),
    (setting([2, 1, 0], "steps"), "steps[2]: must be a preimage, not the goal"),
    (setting("conditional", "strategy"), "steps: must be empty, since the strategy is not linear"),
    (setting(1, "statistics", "extra"), "statistics.extra: unknown key"),
    (setting(-1, "statistics", "seconds"), "statistics.seconds: must be at least 0"),
]


@pytest.mark.parametrize(("change", "line"), REFUSED, ids=[line for _, line in REFUSED])
def test_refusals_name_key_value_and_rule(change: Change, line: str) -> None:
    data = plan_data()
    change(data)
    with pytest.raises(PlanFileError) as refusal:
        read_plan(data)
    assert str(refusal.value).startswith(line)
    assert "\n" not in str(refusal.value)


TEXTS = {
    "empty": ("", "is empty"),
    "no mapping": ("[1]", "must be a mapping, not a list of 1"),
    "broken": ('{"version": 1,', "is not JSON"),
    "repeated": ('{"version": 1, "version": 1}', "is repeated"),
    "nan": ('{"version": NaN}', "NaN is not JSON"),
    "deep": ("[" * 100_000 + "]" * 100_000, "must be nested 20 deep or less"),
    "digits": ('{"version": ' + "9" * 10_000 + "}", "too many digits"),
}


@pytest.mark.parametrize("name", TEXTS)
def test_hostile_files(name: str, tmp_path: Path) -> None:
    text, rule = TEXTS[name]
    path = tmp_path / "plan.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(PlanFileError) as refusal:
        read_plan(path)
    assert rule in str(refusal.value)


def test_files_that_are_none(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "nothing.json"):
        with pytest.raises(PlanFileError):
            read_plan(path)


def test_many_ids_take_no_longer_than_they_should() -> None:
    data = plan_data() | {"start": list(range(200_000))}
    began = time.monotonic()
    with pytest.raises(PlanFileError):
        read_plan(data)
    assert time.monotonic() - began < 10.0


values = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=4)
junk = st.recursive(values, lambda inner: st.lists(inner, max_size=3), max_leaves=5)


@settings(max_examples=100)
@given(st.randoms(use_true_random=False), junk)
def test_any_value_anywhere_is_read_or_refused(random: Any, value: object) -> None:
    data = plan_data()
    there: Any = data
    while True:
        keys = list(there) if isinstance(there, dict) else list(range(len(there)))
        key = random.choice(keys)
        inner = there[key]
        if not isinstance(inner, dict | list) or not inner or random.random() < 0.2:
            there[key] = value
            break
        there = inner
    with contextlib.suppress(PlanFileError):
        read_plan(json.loads(json.dumps(data)))
