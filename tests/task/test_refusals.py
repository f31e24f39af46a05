"""One line of a table for each refusal: a change of a good task, and the line that it gives."""

from __future__ import annotations

import copy
import math
from typing import Any

import jsonschema
import pytest
from hypothesis import given, settings

from preimage.errors import TaskError
from preimage.task import dump_task, named_task, named_tasks, parse_task, task_schema
from tests.task.strategies import garbage, mutated

SCHEMA = jsonschema.Draft202012Validator(task_schema())

GOOD: dict[str, Any] = {
    "version": 1,
    "name": "good",
    "window": [-10, -10, 10, 10],
    "walls": ["left"],
    "robot": {"polygon": [[0, 0], [1, 0], [0, 1]], "reference": [0, 0]},
    "obstacles": [
        {"polygon": [[0, 0], [4, 0], [4, 4], [0, 4]], "holes": [[[1, 1], [2, 1], [1, 2]]]},
        {"chain": [[-5, -5], [5, -5]], "solid": "right"},
    ],
    "uncertainty": {
        "control": 5,
        "position": 0.1,
        "force": {"angle": 10, "threshold": [0.05, 0.1]},
    },
    "friction": 20,
    "sliding": "projection",
    "initial": {"disc": {"center": [7, 7], "radius": 1}},
    "goal": {
        "edges": [[[4, 0], [4, 4]]],
        "polygons": [[[5, 5], [6, 5], [5, 6]]],
        "points": [[0, 0]],
    },
    "planner": {"directions": 8, "max_steps": 4},
}
GONE = object()
Path = tuple[str | int, ...]

OB = ("obstacles", 0, "polygon")
UN = "uncertainty"

# path, value, the refusal, whether the schema refuses it too
TABLE: list[tuple[Path, Any, str, bool]] = [
    # version and name
    (("version",), GONE, "version: is missing", True),
    (("version",), 2, "version: must be 1, not 2", True),
    (("version",), True, "version: must be a number, not true", True),
    (("version",), "1", "version: must be a number, not '1'", True),
    (("name",), 3, "name: must be a text, not 3", True),
    (("name",), " ", "name: must be 1 to 100 printable characters, not ' '", False),
    (("name",), "a\nb", r"name: must be 1 to 100 printable characters, not 'a\nb'", False),
    # unknown keys
    (("obstacle",), [], "obstacle: unknown key, did you mean obstacles?", True),
    (
        (UN, "contrl"),
        3,
        "uncertainty.contrl: unknown key, did you mean control?",
        True,
    ),
    (("planner", "zzz"), 3, "planner.zzz: unknown key: must be directions, method, strateg", True),
    ((3,), 3, "task: keys must be words, not 3", True),
    (("a\nb" * 50,), 3, "a ba ba", True),
    # window and walls
    (("window",), 3, "window: must be a list, not 3", True),
    (("window",), [0, 0, 1], "window: must be [xmin, ymin, xmax, ymax], not 3 numbers", True),
    (("window", 2), "9", "window[2]: must be a number, not '9'", True),
    (("window", 2), math.inf, "window[2]: must be a finite number, not inf", True),
    (("window", 2), math.nan, "window[2]: must be a finite number, not nan", False),
    (("window", 2), 2e9, "window[2]: must be at least -1e+09 and at most 1e+09, not 20", True),
    (("window", 2), -10, "window: xmin must be below xmax, but -10 is not below -10", False),
    (("window", 3), -11, "window: ymin must be below ymax, but -10 is not below -11", False),
    (("window",), [1e6, 0, 1e6 + 0.5, 1], "window: sides must be 1 or longer, not 0.5", False),
    (("window",), [0, 0, 1e-10, 1e-10], "window: sides must be 1e-09 or longer, not", False),
    (("walls",), "left", "walls: must be a list, not 'left'", True),
    (("walls", 0), "lefft", "walls[0]: must be left, right, bottom or top, not 'lefft', did", True),
    (("walls",), ["left", "left"], "walls[1]: names left again", True),
    # robot
    (("robot",), "disc", "robot: must be point or a mapping, not 'disc'", True),
    (("robot", "polygon"), None, "robot.polygon: must be a list, not nothing", True),
    (("robot", "reference"), GONE, "robot.reference: is missing", True),
    (("robot", "polygon"), [[0, 0], [1, 0]], "robot.polygon: must have 3 vertices or more", True),
    (
        ("robot", "polygon"),
        [[0, 0], [1, 1], [1, 0], [0, 1]],
        "robot.polygon: edges 0 and 2 cross",
        False,
    ),
    (("robot", "polygon"), [[0, 0]] * 1001, "robot.polygon: must have 1000 vertices or few", False),
    (
        ("robot", "reference"),
        [1e9, 0],
        "robot.polygon: coordinates must be at most 2e+07 in this window, not 1e+09",
        False,
    ),
    # obstacles
    (("obstacles",), {}, "obstacles: must be a list, not a mapping", True),
    (("obstacles", 0), 3, "obstacles[0]: must be a mapping, not 3", True),
    (("obstacles", 0), {}, "obstacles[0]: must have a polygon or a chain, one of the two", True),
    (("obstacles", 1, "polygon"), [], "obstacles[1]: must have a polygon or a chain, one", True),
    (("obstacles", 1, "holes"), [], "obstacles[1].holes: unknown key", True),
    (("obstacles", 0, "solid"), "left", "obstacles[0].solid: unknown key", True),
    (("obstacles", 1, "solid"), GONE, "obstacles[1].solid: is missing", True),
    (("obstacles", 1, "solid"), "top", "obstacles[1].solid: must be left or right, not 't", True),
    (("obstacles", 1, "chain"), [[0, 0]], "obstacles[1].chain: must have 2 points or more", True),
    (
        ("obstacles", 1, "chain"),
        [[0, 2], [0, 0], [3, 0], [3, 1], [2, 1]],
        "obstacles[1].chain: edge 0 and the ray after the last vertex cross",
        False,
    ),
    (
        ("obstacles", 1, "chain"),
        [[0, 0], [3, 0], [3, 1e-10], [0, 5]],
        "obstacles[1].chain: the edge at (3, 0) is 1e-10 long, too short for the window",
        False,
    ),
    (OB, [[0, 0], [4, 0]], "obstacles[0].polygon: must have 3 vertices or more, not 2", True),
    (OB, [[0, 0], [4, 0], 3], "obstacles[0].polygon[2]: must be a point [x, y], not 3", True),
    (OB, [[0, 0], [4, 0], [4]], "obstacles[0].polygon[2]: must be a point [x, y], not 1 n", True),
    (OB, [[0, 0], [4, 0], [4, True]], "obstacles[0].polygon[2][1]: must be a number, not t", True),
    (OB, [[0, 0], [4, 0], [4, None]], "obstacles[0].polygon[2][1]: must be a number, not n", True),
    (OB, [[0, 0], [4, 0], [4, math.nan]], "obstacles[0].polygon[2][1]: must be a finite n", False),
    (OB, [[0, 0], [4, 0], [4, 10**400]], "obstacles[0].polygon[2][1]: must be a finite nu", True),
    (OB, [[0, 0], [4, 0], [4, 2e9]], "obstacles[0].polygon[2][1]: must be at least -1e+09", True),
    (
        OB,
        [[0, 0], [4, 0], [4, 3e7]],
        "obstacles[0].polygon: coordinates must be at most 2e+07 in this window, not 30000000",
        False,
    ),
    (OB, [[0, 0], [4, 4], [4, 0], [0, 4]], "obstacles[0].polygon: edges 0 and 2 cross", False),
    (OB, [[0, 0], [0, 4], [4, 0], [4, 4]], "obstacles[0].polygon: edges 1 and 3 cross", False),
    (OB, [[0, 0], [4, 0], [4, 0], [4, 4]], "obstacles[0].polygon: vertices 1 and 2 are the", False),
    (OB, [[0, 0], [4, 0], [4, 4], [0, 0]], "obstacles[0].polygon: the last vertex repeats", False),
    (
        ("obstacles", 0),
        {"polygon": [[0, 0], [4, 0], [8, 1e-10]]},
        "obstacles[0].polygon: turns back at (8, 1e-10)",
        False,
    ),
    (
        ("obstacles", 0, "holes", 0),
        [[1, 1], [5, 1], [1, 2]],
        "obstacles[0].holes[0]: edge 0 crosses edge 1 of the polygon",
        False,
    ),
    (("obstacles", 0, "holes"), 3, "obstacles[0].holes: must be a list, not 3", True),
    # uncertainty
    ((UN,), GONE, "uncertainty: is missing", True),
    ((UN, "control"), GONE, "uncertainty.control: is missing", True),
    ((UN, "control"), 90, "uncertainty.control: must be at least 0 and below 90 degrees, no", True),
    ((UN, "control"), -1, "uncertainty.control: must be at least 0 and below 90 degrees, no", True),
    ((UN, "control"), math.inf, "uncertainty.control: must be a finite number, not inf", True),
    ((UN, "control"), "five", "uncertainty.control: must be a number, not 'five'", True),
    (
        (UN, "position"),
        -0.1,
        "uncertainty.position: must be at least 0 and at most 1e+09, not",
        True,
    ),
    ((UN, "position"), -math.inf, "uncertainty.position: must be a finite number, not -inf", True),
    ((UN, "position"), math.nan, "uncertainty.position: must be a finite number, not nan", False),
    ((UN, "position"), "Infinity", "uncertainty.position: must be a number, not 'Infinity'", True),
    ((UN, "force"), 3, "uncertainty.force: must be none or a mapping, not 3", True),
    ((UN, "force", "angle"), 180, "uncertainty.force.angle: must be at least 0 and below 18", True),
    ((UN, "force", "angle"), GONE, "uncertainty.force.angle: is missing", True),
    ((UN, "force", "threshold"), -1, "uncertainty.force.threshold: must be at least 0 and", True),
    ((UN, "force", "threshold"), math.inf, "uncertainty.force.threshold: must be a finite", True),
    (
        (UN, "force", "threshold"),
        [math.inf, math.inf],
        "uncertainty.force.threshold: must be finite (no sensor is force: none)",
        True,
    ),
    ((UN, "force", "threshold"), [0.1], "uncertainty.force.threshold: must be one number or", True),
    (
        (UN, "force", "threshold"),
        [0.2, 0.1],
        "uncertainty.force.threshold: must not fall, but 0.2 is above 0.1",
        False,
    ),
    # friction and sliding
    (("friction",), 91, "friction: must be at least 0 and at most 90 degrees, not 91", True),
    (("friction",), "ice", "friction: must be a number, not 'ice'", True),
    (("friction",), {}, "friction.coefficient: is missing", True),
    (("friction",), {"coefficient": -1}, "friction.coefficient: must be at least 0, not -1", True),
    (("sliding",), "damped", "sliding: must be projection or damper, not 'damped', did you", True),
    # initial
    (("initial",), GONE, "initial: is missing", True),
    (("initial",), "anywhere", "initial: must be everywhere or a mapping, not 'anywhere'", True),
    (("initial",), {}, "initial: must have one key of point, disc, polygon, edges, not none", True),
    (
        ("initial", "point"),
        [0, 0],
        "initial: must have one key of point, disc, polygon, edges",
        True,
    ),
    (("initial",), {"point": [0]}, "initial.point: must be a point [x, y], not 1 numbers", True),
    (("initial",), {"polygon": [[0, 0], [1, 1]]}, "initial.polygon: must have 3 vertices o", True),
    (("initial",), {"edges": []}, "initial.edges: must have 1 items or more, not 0", True),
    (("initial",), {"edges": [[[0, 0]]]}, "initial.edges[0]: must be an edge of 2 points", True),
    (("initial",), {"edges": [[[0, 0]] * 2]}, "initial.edges[0]: must have two ends that d", False),
    (
        ("initial", "disc", "radius"),
        0,
        "initial.disc.radius: must be above 0 and at most 1e+",
        True,
    ),
    (
        ("initial", "disc", "radius"),
        1e-12,
        "initial.disc.radius: must be above 2e-09 and at",
        False,
    ),
    (("initial", "disc", "radius"), GONE, "initial.disc.radius: is missing", True),
    # goal
    (("goal",), GONE, "goal: is missing", True),
    (("goal",), [], "goal: must be a mapping, not a list of 0", True),
    (("goal",), {}, "goal: must have an edge, a polygon or a point", True),
    (("goal",), {"edges": []}, "goal: must have an edge, a polygon or a point", True),
    (("goal", "edges", 0), [[0, 0]], "goal.edges[0]: must be an edge of 2 points, not 1", True),
    (("goal", "edges", 0), [[0, 0]] * 2, "goal.edges[0]: must have two ends that differ", False),
    (("goal", "edges", 0, 1), [4, 1e-12], "goal.edges[0]: the edge at (4, 0) is 1e-12 long", False),
    (("goal", "polygons", 0), [[0, 0]] * 3, "goal.polygons[0]: the last vertex repeats the", False),
    (("goal", "polygons", 0), 1, "goal.polygons[0]: must be a list, not 1", True),
    (("goal", "points"), [3, 4], "goal.points[0]: must be a point [x, y], not 3", True),
    # planner
    (("planner",), None, "planner: must be a mapping, not nothing", True),
    (("planner", "directions"), 7, "planner.directions: must be even, not 7", True),
    (("planner", "directions"), 0, "planner.directions: must be at least 2 and at most 3600", True),
    (("planner", "directions"), 2.5, "planner.directions: must be a whole number, not 2.5", True),
    (("planner", "directions"), True, "planner.directions: must be an even number, a list", True),
    (("planner", "directions"), [], "planner.directions: must have 1 items or more, not 0", True),
    (("planner", "directions"), [0, "x"], "planner.directions[1]: must be a number, not 'x'", True),
    (("planner", "directions"), [0] * 3601, "planner.directions: must be 3600 or fewer, not", True),
    (("planner", "method"), "kernels", "planner.method: must be sticking, kernel or combine", True),
    (("planner", "strategy"), 1, "planner.strategy: must be linear or conditional, not 1", True),
    (("planner", "termination"), None, "planner.termination: must be instantaneous", True),
    (("planner", "search"), "depth", "planner.search: must be breadth-first, best-first", True),
    (
        ("planner", "max_steps"),
        0,
        "planner.max_steps: must be at least 1 and at most 64, not",
        True,
    ),
    (
        ("planner", "max_steps"),
        65,
        "planner.max_steps: must be at least 1 and at most 64, no",
        True,
    ),
    (("planner", "max_regions"), 0, "planner.max_regions: must be at least 1 and at most 1", True),
    (
        ("planner", "time_limit"),
        0,
        "planner.time_limit: must be above 0 and at most 1e+09 sec",
        True,
    ),
    (("planner", "time_limit"), None, "planner.time_limit: must be a number, not nothing", True),
    (("planner", "arc_tolerance"), 0.2, "planner.arc_tolerance: must be above 0 and at most", True),
    (
        ("planner", "resolution"),
        0,
        "planner.resolution: must be at least 0.0001 and at most 45",
        True,
    ),
    (("planner", "or_fail"), "yes", "planner.or_fail: must be true or false, not 'yes'", True),
]


def changed(path: Path, value: Any) -> dict[Any, Any]:
    data = copy.deepcopy(GOOD)
    holder: Any = data
    for key in path[:-1]:
        holder = holder[key]
    if value is GONE:
        del holder[path[-1]]
    else:
        holder[path[-1]] = value
    return data


def refusal(data: object) -> str:
    with pytest.raises(TaskError) as caught:
        parse_task(data)
    line = str(caught.value)
    assert line.isprintable()
    assert len(line) <= 400
    return line


def test_the_good_task_is_good() -> None:
    parse_task(GOOD)
    SCHEMA.validate(GOOD)


@pytest.mark.parametrize(("path", "value", "line", "structural"), TABLE)
def test_refuses_in_one_line(path: Path, value: Any, line: str, structural: bool) -> None:
    data = changed(path, value)
    assert refusal(data).startswith(line)
    if any(not isinstance(key, str) for key in data):
        return
    assert SCHEMA.is_valid(data) != structural


def test_refuses_what_is_no_mapping() -> None:
    assert refusal([1]) == "task: must be a mapping, not a list of 1"
    assert refusal(None) == "task: must be a mapping, not nothing"


def test_needs_a_window_or_obstacles() -> None:
    without = {key: value for key, value in GOOD.items() if key not in ("window", "obstacles")}
    line = "window: is missing, and there are no obstacles to make one around"
    assert refusal(without) == line
    assert refusal({**without, "obstacles": []}) == line
    assert not SCHEMA.is_valid(without)
    assert not SCHEMA.is_valid({**without, "obstacles": []})


def test_refuses_too_many_vertices_at_once() -> None:
    polygon = {"polygon": [[0.0, 0.0]] * 100_001}
    line = "obstacles: must have 1000000 vertices in all or fewer, not 1000010"
    assert refusal({**GOOD, "obstacles": [polygon] * 10}) == line
    places = [[0.0, 0.0]] * 1_000_001
    assert refusal({**GOOD, "goal": {"points": places}}).startswith("goal: must have 1000000 ver")


ORIGINALS = (GOOD, *(dump_task(named_task(name)) for name in named_tasks()))


@settings(max_examples=400)
@given(mutated(ORIGINALS))
def test_changed_tasks_are_refused_or_good(data: Any) -> None:
    try:
        task = parse_task(data)
    except TaskError as error:
        line = str(error)
    else:
        line = ""
        assert parse_task(dump_task(task)) == task
        SCHEMA.validate(data)
        SCHEMA.validate(dump_task(task))
    assert line.isprintable()


@given(garbage)
def test_garbage_is_refused(data: Any) -> None:
    assert refusal(data)
