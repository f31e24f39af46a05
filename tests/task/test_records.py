"""The constructors: what they make clean, and what they refuse by themselves."""

from __future__ import annotations

import math
from dataclasses import FrozenInstanceError, fields, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from preimage.errors import TaskError
from preimage.task import (
    ChainObstacle,
    Continuous,
    Goal,
    InitialPoint,
    InitialPolygon,
    Method,
    PlannerOptions,
    PolygonObstacle,
    Robot,
    SolidSide,
    Task,
    Uncertainty,
    Window,
    Workspace,
    named_task,
    parse_task,
    uniform_directions,
)
from preimage.task.degrees import representable, to_degrees, to_radians
from preimage.task.rings import reverse
from tests.task.strategies import rings

SQUARE = ((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0))
HOLE = ((1.0, 1.0), (3.0, 1.0), (2.0, 3.0))
WINDOW = Window(-10, -10, 10, 10)
BASE: dict[str, Any] = {
    "version": 1,
    "uncertainty": {"control": 5, "position": 0.1},
    "initial": {"point": [0, 5]},
    "goal": {"points": [[0, 0]]},
}


@given(st.floats(-1000, 1000).map(lambda value: round(value, 9)))
def test_degrees_keep_their_digits(degrees: float) -> None:
    assert to_degrees(to_radians(degrees)) == degrees


@given(st.floats(-10, 10))
def test_representable_angles_stay(radians: float) -> None:
    angle = representable(radians)
    assert angle == pytest.approx(radians, rel=1e-15, abs=0)
    assert representable(angle) == angle
    assert to_radians(to_degrees(angle)) == angle


@pytest.mark.parametrize("quarter", range(5))
def test_quarter_turns_are_exact(quarter: int) -> None:
    assert to_radians(90.0 * quarter) == quarter * math.pi / 2


@pytest.mark.parametrize("outer", [SQUARE, reverse(SQUARE)])
@pytest.mark.parametrize("inner", [HOLE, reverse(HOLE)])
def test_a_workspace_turns_polygons(outer: Any, inner: Any) -> None:
    workspace = Workspace(WINDOW, frozenset(), (PolygonObstacle(outer, (inner,)),))
    assert workspace.obstacles == (PolygonObstacle(SQUARE, (reverse(HOLE),)),)


@given(rings())
def test_turned_rings_keep_their_vertices(ring: Any) -> None:
    for made in (InitialPolygon(ring).vertices, Goal(polygons=(ring,)).polygons[0]):
        assert made[0] == ring[0]
        assert made in (ring, reverse(ring))
        assert made == InitialPolygon(reverse(ring)).vertices


def test_collinear_vertices_are_kept() -> None:
    ring = ((0.0, 0.0), (1.0, 0.0), (4.0, 0.0), (0.0, 4.0))
    assert InitialPolygon(ring).vertices == ring
    assert Robot(ring).polygon == ring


def test_what_was_given_becomes_plain() -> None:
    array = np.array(SQUARE)
    obstacle = PolygonObstacle(array.tolist())
    assert obstacle == PolygonObstacle(SQUARE)
    point = InitialPoint((np.float64(-0.0), np.int64(2)))  # type: ignore[arg-type]
    assert repr(point.point) == "(0.0, 2.0)"
    assert hash(obstacle) == hash(PolygonObstacle(SQUARE))


def test_records_are_frozen() -> None:
    task = named_task("flat-floor")
    with pytest.raises((FrozenInstanceError, TypeError)):
        task.friction = 0.0  # type: ignore[misc]
    assert not hasattr(task, "__dict__")


def test_a_robot_is_a_point_or_has_a_shape() -> None:
    assert Robot().is_point
    assert Robot().shape == ((0.0, 0.0),)
    assert Robot(None, (1.0, 2.0)) == Robot()
    robot = Robot(reverse(SQUARE), (2.0, 0.0))
    assert not robot.is_point
    assert robot.shape == ((-2.0, 0.0), (2.0, 0.0), (2.0, 4.0), (-2.0, 4.0))


def test_sensors_may_be_missing() -> None:
    blind = Uncertainty(0.0, math.inf, 0.3)
    assert not blind.has_position_sensor
    assert not blind.has_force_sensor
    assert blind.force_angle == 0.0
    seeing = Uncertainty(0.0, 0.0, 0.1, (0.0, 0.5))
    assert seeing.has_position_sensor
    assert seeing.has_force_sensor


@pytest.mark.parametrize("position", ["inf", ".inf", math.inf])
@pytest.mark.parametrize("force", [{}, {"force": "none"}])
def test_missing_sensors_in_files(position: Any, force: dict[str, Any]) -> None:
    data = {**BASE, "window": [-9, -9, 9, 9]}
    task = parse_task({**data, "uncertainty": {"control": 5, "position": position, **force}})
    assert task.uncertainty == Uncertainty(math.radians(5), math.inf)


def test_friction_by_coefficient() -> None:
    data = {**BASE, "window": [-9, -9, 9, 9]}
    task = parse_task({**data, "friction": {"coefficient": 1}})
    assert task.friction == math.radians(45)
    assert parse_task(data).friction == 0.0
    assert parse_task({**data, "friction": 90}).friction == math.pi / 2


@pytest.mark.parametrize(
    ("given", "degrees"),
    [
        (2, [0, 180]),
        (4.0, [0, 90, 180, 270]),
        ([270, -90, 360, 0, 720.0], [0, 270]),
        ([1e-12, 360 - 1e-12, 10], [0, 10]),
        ([-1e-30], [0]),
        ([359.5, 0.5], [0.5, 359.5]),
    ],
)
def test_directions(given: Any, degrees: list[float]) -> None:
    task = parse_task({**BASE, "window": [-9, -9, 9, 9], "planner": {"directions": given}})
    assert isinstance(task.options.directions, tuple)
    assert [round(to_degrees(angle), 9) for angle in task.options.directions] == degrees


def test_options_say_unit_and_reason() -> None:
    for option in fields(PlannerOptions):
        assert option.metadata["reason"]
        assert "unit" in option.metadata
    assert PlannerOptions().directions == uniform_directions(8)
    assert PlannerOptions(directions=Continuous()).directions == Continuous()


@pytest.mark.parametrize(
    ("build", "key"),
    [
        (lambda: PlannerOptions(directions=()), "planner.directions"),
        (lambda: PlannerOptions(directions=(math.nan,)), "planner.directions[0]"),
        (lambda: PlannerOptions(max_steps=0), "planner.max_steps"),
        (lambda: PlannerOptions(method="kernels"), "planner.method"),  # type: ignore[arg-type]
        (lambda: Uncertainty(math.pi / 2, 0.0), "uncertainty.control"),
        (lambda: Uncertainty(0.0, 0.0, 0.0, (0.0, math.inf)), "uncertainty.force.threshold[1]"),
        (lambda: Robot(SQUARE, (0.0, math.inf)), "robot.reference[1]"),
        (lambda: Goal(), "goal"),
        (lambda: Workspace((0, 0, 1, 1)), "window"),  # type: ignore[arg-type]
        (lambda: Workspace(WINDOW, frozenset(), ("x",)), "obstacles[0]"),  # type: ignore[arg-type]
        (lambda: replace(named_task("flat-floor"), goal=None), "goal"),  # type: ignore[arg-type]
        (lambda: replace(named_task("flat-floor"), friction=2.0), "friction"),
        (lambda: replace(named_task("flat-floor"), name=""), "name"),
    ],
)
def test_constructors_refuse(build: Any, key: str) -> None:
    with pytest.raises(TaskError) as caught:
        build()
    assert caught.value.key == key


def test_words_are_members() -> None:
    options = PlannerOptions(method="kernel")  # type: ignore[arg-type]
    assert options.method is Method.KERNEL
    chain = ChainObstacle(((0, 0), (1, 0)), "left")  # type: ignore[arg-type]
    assert chain.solid is SolidSide.LEFT


@pytest.mark.parametrize(
    ("change", "bounds"),
    [
        # 20 by 5, margin 10
        ({"obstacles": [{"chain": [[-10, 0], [10, 0]], "solid": "right"}]}, (-20, -10, 20, 15)),
        # 4 by 5, margin 2.5
        ({"obstacles": [{"polygon": [[0, 0], [4, 0], [4, 4]]}]}, (-3, -3, 7, 8)),
        # the same, and a robot that reaches 2
        (
            {
                "obstacles": [{"polygon": [[0, 0], [4, 0], [4, 4]]}],
                "robot": {"polygon": [[0, 0], [2, 0], [0, 1]], "reference": [0, 0]},
            },
            (-5, -5, 9, 10),
        ),
        # 0.004 by 0.005: the start is near
        (
            {
                "obstacles": [{"polygon": [[0, 0], [0.004, 0], [0.004, 0.004]]}],
                "initial": {"point": [0, 0.005]},
            },
            (-0.003, -0.003, 0.007, 0.008),
        ),
        # a disc of radius 7 around (0, 5), everywhere else nothing larger
        (
            {
                "obstacles": [{"polygon": [[0, 0], [4, 0], [4, 4]]}],
                "initial": {"disc": {"center": [0, 5], "radius": 7}},
            },
            (-14, -9, 14, 19),
        ),
    ],
)
def test_the_default_window(change: dict[str, Any], bounds: tuple[float, ...]) -> None:
    assert parse_task({**BASE, **change}).workspace.window.bounds == bounds


@given(rings(), st.floats(1e-6, 1e6), st.floats(-1e6, 1e6))
def test_the_default_window_is_round_and_wide(ring: Any, scale: float, shift: float) -> None:
    polygon = [[scale * x + shift, scale * y] for x, y in ring]
    data = {**BASE, "obstacles": [{"polygon": polygon}], "initial": "everywhere"}
    data["goal"] = {"points": [polygon[0]]}
    try:
        window = parse_task(data).workspace.window
    except TaskError:
        assert scale < 1e-3 * abs(shift)
        return
    extent = max(np.ptp(np.array(polygon), axis=0))
    for (x, y), margin in ((point, 0.5 * extent) for point in polygon):
        slack = 1e-9 * abs(shift)
        assert window.xmin <= x - margin + slack
        assert window.ymin <= y - margin + slack
        assert x + margin - slack <= window.xmax
        assert y + margin - slack <= window.ymax
    assert window.ymax - window.ymin <= 4 * extent


def test_a_task_is_made_of_parts() -> None:
    task = Task(
        workspace=Workspace(WINDOW),
        uncertainty=Uncertainty(0.1, 0.0),
        initial=InitialPoint((0, 0)),
        goal=Goal(points=((1, 1),)),
    )
    assert task.name == "task"
    assert task.robot.is_point
    assert task.workspace.window.tolerance.length == pytest.approx(2e-9)
