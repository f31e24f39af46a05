"""What is there before anything is planned."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle, PathPatch

from preimage.configuration.obstacles import configuration_space
from preimage.rendering import figure
from preimage.task import Task
from tests.rendering.drawn import artists, measure, points, task, words


def test_obstacles_are_drawn_as_they_are_and_no_farther_than_the_window() -> None:
    given = task()
    scene = artists(figure(given), "scene")
    assert measure(scene["c-obstacle"]) == pytest.approx(8 * 3 + 4 * 4 / 2)
    drawn = points(scene["c-obstacle"])
    assert np.all(drawn >= (-10, -8))
    assert np.all(drawn <= (10, 8))
    assert "obstacle" not in scene  # of a point robot they are the same


def test_a_polygonal_robot_has_both_kinds_and_stands_at_the_start() -> None:
    robot = {"polygon": [[0, 0], [1, 0], [1, 2], [0, 2]], "reference": [0.5, 0]}
    given = task(robot=robot, goal={"edges": [[[-4, 0], [4, 0]]]})
    made = figure(given)
    scene = artists(made, "scene")
    assert measure(scene["c-obstacle"]) > measure(scene["obstacle"]) == pytest.approx(24 + 8)
    assert measure(scene["robot"]) == pytest.approx(2.0)
    assert points(scene["robot"]).min(axis=0).tolist() == [-0.5, 5.0]
    assert "C-obstacle obstacle" in words(made)


def test_a_robot_at_the_window_is_seen_whole() -> None:
    robot = {"polygon": [[0, 0], [4, 0], [4, 4], [0, 4]], "reference": [2, 2]}
    given = task(robot=robot, initial={"point": [9, 7]}, goal={"edges": [[[-6, 2], [6, 2]]]})
    axes = figure(given).axes[0]
    assert axes.get_xlim()[1] > 11
    assert axes.get_ylim()[1] > 9


def dashed(lines: LineCollection) -> bool:
    style: Any = lines.get_linestyle()
    return all(pattern is not None for _, pattern in style)


def test_sides_are_open_or_walls_or_closed_by_an_obstacle() -> None:
    given = task(obstacles=[{"polygon": [[10, -8], [12, -8], [12, 0], [10, 0]]}], goal={
        "edges": [[[-10, -8], [10, -8]]]
    })  # fmt: skip
    scene = artists(figure(given), "scene")
    opened = scene["open-side"]
    assert isinstance(opened, LineCollection)
    assert dashed(opened)
    sides = {tuple(np.round(np.abs(line[1] - line[0]), 9)) for line in opened.get_segments()}
    assert sides == {(20.0, 0.0), (0.0, 8.0)}  # the top, and the right side above the obstacle
    band = scene["wall-band"]
    assert isinstance(band, PathPatch)
    assert band.get_hatch()
    closed = scene["closed-side-band"]
    assert isinstance(closed, PathPatch)
    assert not closed.get_hatch()
    assert points(scene["closed-side"])[:, 0].tolist() == [10.0, 10.0]


def test_goals_have_areas_edges_and_vertices() -> None:
    given = task()
    scene = artists(figure(given), "scene")
    area = scene["goal"]
    assert isinstance(area, PathPatch)
    assert measure(area) == pytest.approx(18.0)
    hatch = scene["goal-hatch"]
    assert isinstance(hatch, PathPatch)
    assert hatch.get_hatch()
    contact = scene["goal-contact"]
    assert isinstance(contact, LineCollection)
    assert np.min(contact.get_linewidth()) > 2
    line = points(contact)
    assert sorted(line[:, 0].tolist()) == pytest.approx([-3.0, 3.0])
    assert np.all((line[:, 1] > 0.0) & (line[:, 1] < 0.2))  # beside the obstacle, in free space
    corner = artists(figure(task(goal={"points": [[4, 0]]})), "scene")
    assert points(corner["goal-vertices"]).tolist() == [[4.0, 0.0]]


def test_a_goal_too_small_to_be_seen_gets_a_ring() -> None:
    tiny = {"polygons": [[[6, 5], [6.01, 5], [6.01, 5.01]]]}
    scene = artists(figure(task(goal=tiny)), "scene")
    assert points(scene["goal-ring"]) == pytest.approx(np.array([[6.005, 5.005]]), abs=1e-2)
    both = {"polygons": [*tiny["polygons"], [[-3, 0], [3, 0], [3, 3], [-3, 3]]]}
    scene = artists(figure(task(goal=both)), "scene")
    assert len(points(scene["goal-ring"])) == 1
    assert "goal-ring" not in artists(figure(task()), "scene")


STARTS = {
    "point": {"point": [0, 5]},
    "disc": {"disc": {"center": [0, 5], "radius": 1}},
    "polygon": {"polygon": [[0, 4], [3, 4], [3, 7]]},
    "edges": {"edges": [[[-4, 0], [4, 0]]]},
}


@pytest.mark.parametrize(("kind", "parts"), [
    ("point", {"start-point", "position-error"}),
    ("disc", {"start", "start-hatch"}),
    ("polygon", {"start", "start-hatch"}),
    ("edges", {"start-contact"}),
])  # fmt: skip
def test_starts_of_all_kinds(kind: str, parts: set[str]) -> None:
    scene = artists(figure(task(initial=STARTS[kind])), "scene")
    drawn = {name for name in scene if name.startswith(("start", "position"))}
    assert drawn == parts
    assert "name-I" in scene


def test_the_disc_around_a_start_is_the_position_error() -> None:
    disc = artists(figure(task()), "scene")["position-error"]
    assert isinstance(disc, Circle)
    assert disc.get_radius() == 0.5
    assert np.asarray(disc.get_center()).tolist() == [0, 5]


def test_a_start_anywhere_is_said_in_words() -> None:
    made = figure(task(initial="everywhere"))
    assert not any("start" in name for name in artists(made, "scene"))
    assert "start: anywhere" in words(made)


def bounded(control: float, position: float | str) -> Task:
    force = {"angle": 0, "threshold": 0}
    bounds = {"control": control, "position": position, "force": force}
    return task(uncertainty=bounds, friction=0)


def test_bounds_are_in_the_legend() -> None:
    told = words(figure(task()))
    for text in ("direction ± 12°", r"$\rho$ = 0.5", "force ± 10°", "friction ± 20°"):
        assert text in told
    told = words(figure(bounded(0, math.inf)))
    for text in ("direction, exact", "no position sensor", "force, exact", "no friction"):
        assert text in told
    assert "position, exact" in words(figure(bounded(5, 0)))
    bounds = {"control": 5, "position": 1}
    assert "no force sensor" in words(figure(task(uncertainty=bounds)))


def test_a_space_alone_is_drawn_too() -> None:
    space = configuration_space(task())
    made = figure(space)
    assert {"c-obstacle", "open-side", "wall"} <= set(artists(made, "scene"))
    assert "position" not in words(made)


def test_edges_are_numbered_on_request() -> None:
    given = task()
    space = configuration_space(given)
    numbers = {
        name for name in artists(figure(given, edge_numbers=True), "scene") if "number" in name
    }
    assert numbers == {f"edge-number-{edge}" for edge in space.contact.edges}
    assert not any("number" in name for name in artists(figure(given), "scene"))
