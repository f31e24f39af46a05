import dataclasses
import math

import pytest

from preimage.configuration.region import Region
from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.search.planner import plan
from preimage.strategy.describe import contact_share, describe, describe_condition
from preimage.strategy.plan_file import read_plan
from preimage.strategy.region_geojson import region_from_geojson
from preimage.strategy.words import direction_words, region_words
from preimage.task.examples import named_task, named_tasks
from tests.strategy.plans import plan_data, planned


def test_every_motion_is_told() -> None:
    text = describe(planned("peg-in-hole-point"))
    lines = text.splitlines()
    assert lines[0] == "peg-in-hole-point: solved in 2 motions"
    assert [line for line in lines if line.startswith("motion ")] == [
        "motion 1 of 2: → right (0°)",
        "motion 2 of 2: ↓ down (270°)",
    ]
    last = lines[lines.index("motion 2 of 2: ↓ down (270°)") :]
    assert "  aims at     1 contact edge of length 2 and 2 contact vertices" in last
    assert "              edge (-1, -3) to (1, -3)" in last
    assert "  contact     all of it" in last
    assert any("moved by at most 0.75 within the last 1.50573" in line for line in last)
    assert any("every place that fits the readings is in the goal" in line for line in last)
    assert "  then it is  in the goal" in last
    assert lines[-1].startswith("3 regions made in ")


@pytest.mark.parametrize("name", named_tasks())
def test_every_named_task_can_be_told(name: str) -> None:
    text = describe(planned(name))
    assert text.startswith(f"{name}: ")
    assert "nan" not in text


def test_what_is_not_solved() -> None:
    task = named_task("example-4")
    options = dataclasses.replace(task.options, max_steps=1, directions=(math.radians(270),))
    text = describe(plan(dataclasses.replace(task, options=options)))
    assert "the start is in none of them" in text or "no motion is known" in text
    stopped = plan(task, cancelled=lambda: True)
    assert describe(stopped).splitlines()[0] == "example-4: stopped: interrupted"
    assert "no motion is known to end in the goal" in describe(stopped)


def test_a_choice_is_told_by_rank() -> None:
    data = plan_data() | {"strategy": "conditional", "steps": []}
    data["regions"][2]["goals"] = [0, 1]
    lines = describe(read_plan(data)).splitlines()
    assert lines[0] == "peg-in-hole-point: solved in 2 motions at most"
    assert "begins in region 2" in lines
    assert "  then it is  in the goal or region 1" in lines
    assert any(line.endswith("is in one of the goal and region 1") for line in lines)


def test_a_start_in_the_goal() -> None:
    data = plan_data("flat-floor")
    data |= {"regions": data["regions"][:1], "start": [0], "steps": []}
    assert "there is nothing to do" in describe(read_plan(data))


def test_conditions() -> None:
    assert describe_condition(ElapsedCondition(7.5), (0,)) == "a time of 7.5 has passed"
    words = describe_condition(StickingCondition(2.5, 0.25), (0,))
    assert words == "the measured position has moved by at most 0.25 within the last 2.5 of time"
    words = describe_condition(ReadingCondition(Region.empty()), (3,))
    assert words == "every place that fits the readings, of all in nothing, is in region 3"


def test_share_of_contact() -> None:
    space = planned("peg-in-hole-point").space
    edge = {"type": "LineString", "coordinates": [[-1, -3], [1, -3]]}
    box = [[-1, -3], [1, -3], [1, -1], [-1, -1], [-1, -3]]
    area = {"type": "Polygon", "coordinates": [box]}
    both = {"type": "GeometryCollection", "geometries": [area, edge]}
    shares = [contact_share(region_from_geojson(data, space), space) for data in (edge, area, both)]
    assert shares == ["all of it", "none of it", "25% of its outline"]
    assert contact_share(Region.empty(), space) == "nothing to touch"
    assert region_words(Region.empty()) == "nothing"


@pytest.mark.parametrize(
    ("degrees", "words"),
    [
        (0, "right (0°)"),
        (45, "up-right (45°)"),
        (359.9, "right and a little down (359.9°)"),
        (100, "up and a little left (100°)"),
        (190, "left and a little down (190°)"),
        (22.5, "right and a little up (22.5°)"),
    ],
)
def test_directions(degrees: float, words: str) -> None:
    assert direction_words(math.radians(degrees)) == words
