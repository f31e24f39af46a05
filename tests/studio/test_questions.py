"""Every question, on many tasks, and with anything for a body."""

import base64
import json
import math
from functools import cache
from typing import Any

import pytest
import shapely

from preimage import Status, named_task, named_tasks, plan
from preimage.errors import InputError
from preimage.execution.control import CONTROLS
from preimage.execution.sensing import SENSINGS
from preimage.strategy.plan_file import plan_to_dict
from preimage.studio.questions import QUESTIONS
from preimage.task.files import dump_task

Body = dict[str, Any]

NAMES = ("flat-floor", "l-room", "peg-in-hole", "two-bays", "blind-corner", "cradle")

QUICK = ("space", "stage", "write", "plan_file", "run", "play", "plan")


def ask(question: str, **body: Any) -> Any:
    """An answer as a page gets it."""
    told: list[Body] = []
    found = QUESTIONS[question].answer(body, told.append)
    json.dumps(told, allow_nan=False)
    return json.loads(json.dumps(found, allow_nan=False))


@cache
def task_text(name: str) -> str:
    return json.dumps(dump_task(named_task(name)))


@cache
def plan_text(name: str) -> str:
    return json.dumps(plan_to_dict(plan(named_task(name))))


def task_of(name: str) -> Any:
    return json.loads(task_text(name))


def plan_of(name: str) -> Any:
    return json.loads(plan_text(name))


def start_of(name: str) -> list[float]:
    found: list[float] = ask("run", plan=plan_of(name))["legs"][0]["places"][0]
    return found


# --- what is answered ---------------------------------------------------------------------------


def test_all_named_tasks_are_listed_and_given() -> None:
    assert [one["name"] for one in ask("examples")["examples"]] == list(named_tasks())
    for name in named_tasks():
        assert ask("example", name=name)["task"] == task_of(name)


@pytest.mark.parametrize("kind", ["yaml", "json", "toml"])
@pytest.mark.parametrize("name", NAMES)
def test_what_is_written_is_read(name: str, kind: str) -> None:
    written = ask("write", task=task_of(name), format=kind)
    assert written["name"] == f"{name}.{kind}"
    assert ask("read", text=written["text"], format=kind)["task"] == task_of(name)


@pytest.mark.parametrize("name", named_tasks())
def test_every_space_is_drawn(name: str) -> None:
    found = ask("space", task=task_of(name))
    assert found["task"] == task_of(name)
    ids = [feature["id"] for feature in found["features"]]
    assert len(ids) == len(set(ids))
    for feature in found["features"]:
        (x0, y0), (x1, y1) = feature["from"], feature["to"]
        turn = math.radians(feature["normal"])
        length = math.hypot(x1 - x0, y1 - y0)
        assert length > 0.0
        along = (x1 - x0) * math.cos(turn) + (y1 - y0) * math.sin(turn)
        assert abs(along) <= 1e-6 * max(length, 1.0)


def measure(areas: list[list[list[list[float]]]]) -> float:
    """Twice the shoelace, halved; holes are taken away."""
    total = 0.0
    for outer, *holes in areas:
        total += shoelace(outer) - sum(map(shoelace, holes))
    return total


def shoelace(ring: list[list[float]]) -> float:
    pairs = zip(ring, [*ring[1:], ring[0]], strict=True)
    return abs(sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in pairs)) / 2.0


def shape(areas: list[list[list[list[float]]]]) -> shapely.Geometry:
    return shapely.union_all([shapely.Polygon(outer, holes) for outer, *holes in areas])


@pytest.mark.parametrize("name", NAMES)
def test_free_and_forbidden_share_the_window(name: str) -> None:
    found = ask("space", task=task_of(name))
    window = shapely.box(*found["window"])
    free, forbidden = shape(found["free"]), shape(found["obstacles"]).intersection(window)
    assert free.area + forbidden.area == pytest.approx(window.area, rel=1e-6)
    assert free.intersection(forbidden).area <= 1e-6 * window.area


def test_a_square_robot_among_a_square_obstacle() -> None:
    """Two squares of sides 2 and 1: the C-obstacle is a square of side 3."""
    square = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    small = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]
    changes = {
        "window": [-20, -20, 20, 20],
        "obstacles": [{"polygon": square}],
        "robot": {"polygon": small, "reference": [0, 0]},
        "goal": {"edges": [[[-1.5, 1.5], [1.5, 1.5]]]},
    }
    found = ask("space", task={**task_of("flat-floor"), **changes})
    assert measure(found["solid"]) == pytest.approx(4.0)
    assert measure(found["obstacles"]) == pytest.approx(9.0)
    assert measure(found["free"]) == pytest.approx(1600.0 - 9.0)
    lengths = [math.dist(feature["from"], feature["to"]) for feature in found["features"]]
    assert sum(lengths) == pytest.approx(12.0)
    normals = {round(feature["normal"]) % 360 for feature in found["features"]}
    assert normals == {0, 90, 180, 270}
    assert not any(vertex["concave"] for vertex in found["vertices"])


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("direction", [-90, 0.0, 37.5, 720.0])
def test_every_stage_is_shown(name: str, direction: float) -> None:
    found = ask("stage", task=task_of(name), direction=direction)
    turned = ask("stage", task=task_of(name), direction=math.fmod(direction, 360.0))
    assert found == turned
    heights = [event["height"] for event in found["sweep"]]
    assert heights == sorted(heights)
    turn = math.radians(direction)
    for event in found["sweep"]:
        x, y = event["at"]
        assert event["height"] == pytest.approx(-x * math.cos(turn) - y * math.sin(turn), abs=1e-6)
    assert measure(found["preimage"]["area"]) <= measure(found["backprojection"]["area"]) + 1e-6
    assert measure(found["kernel"]["area"]) <= measure(found["target"]["area"]) + 1e-6


@pytest.mark.parametrize("name", NAMES)
def test_a_plan_is_made_kept_and_read(name: str) -> None:
    made = ask("plan", task=task_of(name))
    assert made["status"] == "solved"
    again = ask("plan_file", plan=made["plan"])
    for key in ("plan", "start", "steps", "status", "reason"):
        assert again[key] == made[key]
    for read, found in zip(again["regions"], made["regions"], strict=True):
        assert read["direction"] == found["direction"]
        assert read["conditions"] == found["conditions"]
        assert sorted(read["region"]["edges"]) == sorted(found["region"]["edges"])
        areas = read["region"]["area"], found["region"]["area"]
        assert measure(areas[0]) == pytest.approx(measure(areas[1]), rel=1e-6, abs=1e-9)
    ids = {region["id"] for region in made["regions"]}
    for region in made["regions"]:
        assert set(region["goals"]) <= ids
    for region in made["regions"]:
        if region["direction"] is not None:
            stage = ask(
                "stage", plan=made["plan"], direction=region["direction"], goal=region["goals"][0]
            )
            assert stage["direction"] == pytest.approx(region["direction"], abs=1e-6)


@pytest.mark.parametrize("name", ["flat-floor", "two-bays"])
def test_a_sound_plan_is_proven_and_never_fails(name: str) -> None:
    document = plan_of(name)
    assert ask("verify", plan=document)["proven"]
    report = ask("runs", plan=document, runs=3)
    assert report["failures"] == 0
    assert len(report["pairs"]) == len(CONTROLS) * len(SENSINGS)
    assert report["runs"] == sum(pair["runs"] for pair in report["pairs"])


@pytest.mark.parametrize("name", NAMES)
def test_margins_are_not_negative(name: str) -> None:
    found = ask("margins", plan=plan_of(name))
    for entry in found["entries"]:
        assert entry["value"] is None or entry["value"] >= 0.0


def test_every_adversary_runs_and_is_explained() -> None:
    told = ask("adversaries")
    for kind, names in (("control", CONTROLS), ("sensing", SENSINGS)):
        assert [one["name"] for one in told[kind]] == list(names)
        assert all(one["words"] for one in told[kind])
    for control in CONTROLS:
        for sensing in SENSINGS:
            found = ask("run", plan=plan_of("l-room"), control=control, sensing=sensing)
            assert found["good"], (control, sensing)


def test_a_run_begins_where_it_is_put() -> None:
    place = start_of("two-bays")
    found = ask("run", plan=plan_of("two-bays"), start=place, seed=3)
    assert found["legs"][0]["places"][0] == pytest.approx(place, abs=1e-6)
    with pytest.raises(InputError) as refused:
        ask("run", plan=plan_of("two-bays"), start=[1e6, 0.0])
    assert refused.value.key == "start"


@pytest.mark.parametrize(
    ("kind", "magic"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")]
)
def test_pictures(kind: str, magic: bytes) -> None:
    for body in ({"task": task_of("l-room")}, {"plan": plan_of("l-room")}):
        found = ask("draw", format=kind, **body)
        assert base64.b64decode(found["base64"]).startswith(magic)
        assert found["name"] == f"l-room.{kind}"


def test_a_film() -> None:
    found = ask("film", plan=plan_of("flat-floor"))
    assert base64.b64decode(found["base64"]).startswith(b"GIF8")


@pytest.mark.parametrize("name", ["/etc/passwd", "../../x", "a\x00b", "\ud800", "", "x" * 500, "."])
def test_names_of_files_are_plain(name: str) -> None:
    try:
        found = ask("write", task={**task_of("flat-floor"), "name": name})
    except InputError as error:
        assert error.key == "name"  # noqa: PT017
        return
    stem, _, kind = found["name"].rpartition(".")
    assert kind == "yaml"
    assert stem
    assert not set(stem) & set("/\\\0.\n")
    assert len(stem) <= 60
    found["name"].encode()


def test_a_task_without_a_plan_is_explained() -> None:
    task = task_of("flat-floor")
    task["uncertainty"] = {**task["uncertainty"], "control": 80.0}
    made = ask("plan", task=task)
    if made["status"] == Status.SOLVED.value:
        pytest.fail("it has a plan")
    found = ask("explain", task=task, bounds=["control"], budgeted=True)
    assert found["words"]
    assert [change["bound"] for change in found["changes"]] == ["control"]


@pytest.mark.slow
def test_a_budget_holds_what_is_given() -> None:
    [axis] = ask("budget", task=task_of("flat-floor"), bounds=["control"])["axes"]
    assert any(low <= axis["given"] <= high for low, high in axis["solved"])


# --- what is refused ----------------------------------------------------------------------------

REFUSED: list[tuple[str, Body, str]] = [
    ("space", {}, "task"),
    ("space", {"task": None}, "task"),
    ("stage", {"task": "flat-floor"}, "direction"),
    ("stage", {"task": "flat-floor", "direction": "up"}, "direction"),
    ("stage", {"task": "flat-floor", "direction": True}, "direction"),
    ("stage", {"task": "flat-floor", "direction": math.nan}, "direction"),
    ("stage", {"task": "flat-floor", "direction": 10**400}, "direction"),
    ("stage", {"task": "flat-floor", "direction": 0, "method": "magic"}, "method"),
    ("stage", {"plan": "flat-floor", "direction": 0, "goal": 99}, "goal"),
    ("stage", {"plan": "flat-floor", "direction": 0, "goal": False}, "goal"),
    ("example", {}, "name"),
    ("example", {"name": ["peg-in-hole"]}, "name"),
    ("example", {"name": "../x"}, "name"),
    ("read", {}, "text"),
    ("read", {"text": 3, "format": "yaml"}, "text"),
    ("read", {"text": "x" * (2**20 + 1), "format": "yaml"}, "text"),
    ("read", {"text": "{}"}, "format"),
    ("read", {"text": "{}", "format": "xml"}, "format"),
    ("write", {"task": "flat-floor", "format": None}, "format"),
    ("plan_file", {}, "plan"),
    ("plan_file", {"plan": 3}, "plan"),
    ("run", {"plan": "flat-floor", "control": "evil"}, "control"),
    ("run", {"plan": "flat-floor", "sensing": {}}, "sensing"),
    ("run", {"plan": "flat-floor", "seed": -1}, "seed"),
    ("run", {"plan": "flat-floor", "seed": 1.5}, "seed"),
    ("run", {"plan": "flat-floor", "seed": 2**80}, "seed"),
    ("run", {"plan": "flat-floor", "number": 10**6}, "number"),
    ("run", {"plan": "flat-floor", "start": 3}, "start"),
    ("run", {"plan": "flat-floor", "start": [0, None]}, "start[1]"),
    ("runs", {"plan": "flat-floor", "runs": 0}, "runs"),
    ("runs", {"plan": "flat-floor", "runs": 10**9}, "runs"),
    ("explain", {"task": "flat-floor", "bounds": []}, "bounds"),
    ("explain", {"task": "flat-floor", "bounds": [3]}, "bounds[0]"),
    ("explain", {"task": "flat-floor", "budgeted": 1}, "budgeted"),
    ("budget", {"task": "flat-floor", "bounds": ["x"] * 99}, "bounds"),
    ("draw", {"task": "flat-floor", "format": "exe"}, "format"),
    ("film", {"plan": "flat-floor", "format": "mp4"}, "format"),
]


@pytest.mark.parametrize(("question", "body", "where"), REFUSED)
def test_refusals_name_the_key(question: str, body: Body, where: str) -> None:
    body = dict(body)
    if isinstance(body.get("task"), str):
        body["task"] = task_of(body["task"])
    if isinstance(body.get("plan"), str):
        body["plan"] = plan_of(body["plan"])
    with pytest.raises(InputError) as refused:
        ask(question, **body)
    assert refused.value.key == where
    assert "\n" not in refused.value.rule


@pytest.mark.parametrize("question", ["run", "play", "runs", "margins", "film"])
def test_a_plan_that_is_none_is_not_run(question: str) -> None:
    task = task_of("flat-floor")
    task["uncertainty"] = {**task["uncertainty"], "control": 80.0}
    document = ask("plan", task=task)["plan"]
    with pytest.raises(InputError) as refused:
        ask(question, plan=document, start=[0, 0])
    assert refused.value.key == "plan.status"
