"""A turned, moved, scaled or mirrored task has the turned, moved, … answer (theory 8)."""

import math
from dataclasses import replace
from random import Random

import numpy as np
import pytest

from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.start import start_region
from preimage.errors import TaskError
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.search.planner import plan
from preimage.strategy.strategy import Status
from preimage.task.goal import Goal
from preimage.task.initial import InitialPoint, InitialPolygon
from preimage.task.options import Method, SearchOrder
from preimage.task.robot import Robot
from preimage.task.task import Task
from preimage.task.workspace import PolygonObstacle, Side, Window, Workspace
from tests.laws.similarity import Similarity, gap, same
from tests.laws.tasks import random_setting, random_task
from tests.strategies import HALF

SLACK = 1e-6
SIMILARITIES = {
    "quarter": Similarity(turn=0.5 * math.pi),
    "half": Similarity(turn=math.pi),
    "turned": Similarity(turn=1.1),
    "mirrored": Similarity(mirrored=True),
    "smaller": Similarity(scale=0.37),
    "larger": Similarity(scale=1000.0),
    "moved": Similarity(shift=(3.3, -7.1)),
    "moved far": Similarity(shift=(150.0, 200.0)),
    "all": Similarity(turn=2.5, scale=7.3, shift=(20.0, -3.0), mirrored=True),
}


def check_preimages(similarity: Similarity, seeds: range) -> None:
    for seed in seeds:
        setting, scene = random_setting(Random(seed))
        senses = setting.uncertainty
        space = similarity.space(scene.space)
        moved = Setting(
            space,
            replace(senses, position=senses.position * similarity.scale),
            setting.friction,
            setting.sliding,
            setting.arc_tolerance,
        )
        contact = scene.space.contact
        target = similarity.region(scene.target, contact)
        # where arcs meet, rounding decides which of their tangents show
        arcs = 0.0 if math.isinf(senses.position) else 2e-3 * senses.position
        slack = similarity.scale * (2.0 * HALF * SLACK + arcs)
        for method in Method:
            before = preimage(setting, scene.target, scene.direction, method)
            after = preimage(moved, target, similarity.angle(scene.direction), method)
            for a, b in (
                (before.target.region, after.target.region),
                (before.region, after.region),
            ):
                assert same(similarity.region(a, contact), b, slack), (seed, method)
            assert list(map(type, before.termination)) == list(map(type, after.termination))


@pytest.mark.parametrize("name", SIMILARITIES)
def test_preimages_of_random_scenes(name: str) -> None:
    check_preimages(SIMILARITIES[name], range(25))


@pytest.mark.slow
@pytest.mark.parametrize("name", SIMILARITIES)
def test_preimages_of_random_scenes_at_length(name: str) -> None:
    check_preimages(SIMILARITIES[name], range(50_000, 50_300))


# --- whole tasks ----------------------------------------------------------------------------

Ring = tuple[tuple[float, float], ...]


def moved_task(task: Task, similarity: Similarity) -> Task:
    """A task moved in every part, by quarter turns; its walls must be all or none."""

    def ring(points: Ring) -> Ring:
        return tuple((x, y) for x, y in similarity.points(np.array(points)).tolist())

    def centred(points: Ring) -> Ring:
        still = replace(similarity, shift=(0.0, 0.0))
        return tuple((x, y) for x, y in still.points(np.array(points)).tolist())

    obstacles = tuple(
        PolygonObstacle(ring(part.exterior), tuple(ring(hole) for hole in part.holes))
        for part in task.workspace.obstacles
        if isinstance(part, PolygonObstacle)
    )
    (ax, ay), (bx, by) = ring(((-HALF, -HALF), (HALF, HALF)))
    window = Window(min(ax, bx), min(ay, by), max(ax, bx), max(ay, by))
    robot = task.robot
    if robot.polygon is not None:
        robot = Robot(centred(robot.polygon), centred((robot.reference,))[0])
    initial = task.initial
    if isinstance(initial, InitialPoint):
        initial = InitialPoint(ring((initial.point,))[0])
    elif isinstance(initial, InitialPolygon):
        initial = InitialPolygon(ring(initial.vertices))
    goal = task.goal
    edges = tuple((pair[0], pair[1]) for pair in (ring(edge) for edge in goal.edges))
    directions = task.options.directions
    assert isinstance(directions, tuple)
    return replace(
        task,
        workspace=Workspace(window, task.workspace.walls, obstacles),
        robot=robot,
        uncertainty=replace(
            task.uncertainty, position=task.uncertainty.position * similarity.scale
        ),
        initial=initial,
        goal=Goal(edges, tuple(map(ring, goal.polygons)), ring(goal.points) if goal.points else ()),
        options=replace(
            task.options, directions=tuple(similarity.angle(angle) for angle in directions)
        ),
    )


QUARTERS = ("quarter", "half", "mirrored", "smaller", "larger", "moved")


def turnable_task(seed: int) -> Task | None:
    """A random task with all sides walls, or all open; None if its ends do not survive that."""
    task = random_task(Random(seed))
    walls = frozenset(Side) if len(task.workspace.walls) > 1 else frozenset()
    options = replace(
        task.options, search=SearchOrder.BREADTH_FIRST, max_steps=3, max_regions=10_000
    )
    task = replace(task, workspace=replace(task.workspace, walls=walls), options=options)
    try:
        space = configuration_space(task)
        goal_region(task, space)
        start_region(task, space)
    except TaskError:
        return None
    return task


def check_plans(name: str, seeds: range) -> int:
    solved = 0
    for seed in seeds:
        task = turnable_task(seed)
        if task is None:
            continue
        before, after = plan(task), plan(moved_task(task, SIMILARITIES[name]))
        assert before.status is after.status, seed
        assert len(before.steps) == len(after.steps), seed
        solved += before.status is Status.SOLVED
    return solved


@pytest.mark.parametrize("name", QUARTERS)
def test_plans_of_random_tasks(name: str) -> None:
    assert check_plans(name, range(15)) > 1


@pytest.mark.slow
@pytest.mark.parametrize("name", QUARTERS)
def test_plans_of_random_tasks_at_length(name: str) -> None:
    assert check_plans(name, range(60_000, 60_100)) > 6


# --- the order in which things are written down ---------------------------------------------


def rewritten(task: Task, rng: Random) -> Task:
    """The task with its obstacles in another order, and rings begun elsewhere, the other way."""

    def ring(points: Ring) -> Ring:
        begin = rng.randrange(len(points))
        return tuple(reversed(points[begin:] + points[:begin]))

    obstacles = [
        PolygonObstacle(ring(part.exterior), tuple(map(ring, reversed(part.holes))))
        for part in task.workspace.obstacles
        if isinstance(part, PolygonObstacle)
    ]
    goal = Goal(
        tuple((b, a) for a, b in reversed(task.goal.edges)),
        tuple(map(ring, reversed(task.goal.polygons))),
        tuple(reversed(task.goal.points)),
    )
    robot = task.robot
    if robot.polygon is not None:
        robot = Robot(ring(robot.polygon), robot.reference)
    workspace = replace(task.workspace, obstacles=tuple(reversed(obstacles)))
    return replace(task, workspace=workspace, goal=goal, robot=robot)


@pytest.mark.parametrize("first", [0, 20])
def test_order_changes_nothing(first: int) -> None:
    for seed in range(first, first + 20):
        task = random_task(Random(seed))
        before, after = plan(task), plan(rewritten(task, Random(seed)))
        assert before.status is after.status, seed
        assert before.steps == after.steps, seed
        assert len(before.regions) == len(after.regions), seed
        for a, b in zip(before.regions, after.regions, strict=True):
            assert gap(a.region.area, b.region.area) < SLACK, seed
            length = a.region.contact.total_length
            assert length == pytest.approx(b.region.contact.total_length, abs=SLACK), seed
            corners = [
                sorted(found.space.contact.points[part.region.contact.vertices].tolist())
                for found, part in ((before, a), (after, b))
            ]
            assert len(corners[0]) == len(corners[1]), seed
            assert np.allclose(corners[0], corners[1]), seed
