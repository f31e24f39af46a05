"""The executor drives simulated robots, reading by reading, as it would drive a real one."""

import math
from dataclasses import replace

import numpy as np
import pytest

from preimage.configuration.start import start_region
from preimage.execution.chunk import Scene
from preimage.execution.control import CONTROLS
from preimage.execution.executor import Answer, Doing, Executor
from preimage.execution.sensing import SENSINGS, read
from preimage.execution.simulator import Choices, Manner, Robots, advance
from preimage.execution.situation import LOTS, Situation
from preimage.execution.starts import is_in, of_start
from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict
from preimage.strategy.plan_parse import parse_plan
from preimage.strategy.strategy import Status, Strategy
from preimage.task.examples import named_task, named_tasks
from preimage.task.options import Method

MOST = 20_000
"""Readings of one run."""


def drive(
    strategy: Strategy, pair: tuple[str, str], seed: int, step: float
) -> tuple[Answer, Robots]:
    """One run: nature chooses before every reading, and whenever something is met."""
    scene = Scene.of(strategy)
    rng = np.random.default_rng(seed)
    robots = of_start(strategy.space, start_region(strategy.task, strategy.space), 1, rng)
    lots, met, time = rng.random((1, LOTS)), np.zeros(1, dtype=np.int32), 0.0
    first = scene.conditions[strategy.start[0]]
    now = Situation(first, robots, np.zeros(1), lots, met, rng)
    executor = Executor(scene.program)
    x, y = read(SENSINGS[pair[1]], now, np.zeros(1))[0][0].tolist()
    answer = executor.start(time, x, y)
    for _ in range(MOST):
        motion = scene.conditions[answer.region]
        now = Situation(motion, robots, np.full(1, time), lots, met, rng)
        choices = CONTROLS[pair[0]](now)
        positions, forces = read(SENSINGS[pair[1]], now, choices.angle)
        (x, y), force = positions[0].tolist(), float(forces[0])
        before, answer = answer, executor.read(time, x, y, None if math.isnan(force) else force)
        if answer.doing is not Doing.MOVING:
            return answer, robots
        if answer is not before:
            motion = scene.conditions[answer.region]
            choices = CONTROLS[pair[0]](replace(now, motion=motion))
        soon = Choices(
            choices.angle, np.minimum(choices.duration, step), choices.wish, choices.chance
        )
        moves = advance(motion.simulator, robots, soon)
        assert moves.manner[0] != Manner.ESCAPES
        n = len(strategy.space.contact)
        met = met + ((moves.robots.feature != robots.feature) & (moves.robots.feature < 2 * n))
        robots, time = moves.robots, time + max(float(moves.time[0]), 1e-9)
    return answer, robots


def planned(name: str, method: Method) -> Strategy:
    task = named_task(name)
    return plan(replace(task, options=replace(task.options, method=method)))


@pytest.mark.parametrize("name", sorted(named_tasks()))
def test_it_ends_in_the_goal_and_is_never_contradicted(name: str) -> None:
    strategy = planned(name, named_task(name).options.method)
    if strategy.status is not Status.SOLVED:
        pytest.skip("unsolvable by this method")
    sensings = list(SENSINGS)
    for count, control in enumerate(CONTROLS):
        pair = (control, sensings[count % len(sensings)])
        answer, robots = drive(strategy, pair, count, step=0.2)
        failures = {region.id for region in strategy.failures}
        ends = Doing.FAILED if answer.region in failures else Doing.DONE
        assert answer.doing is ends, (pair, answer.words)
        slack = 100.0 * strategy.space.tolerance.length
        end = strategy.region(answer.region)
        assert is_in(strategy.space, end.region, robots, slack).all(), pair


def test_a_world_that_breaks_its_bounds_is_found_out() -> None:
    """Much more control noise than the plan was made for: never a silent success elsewhere."""
    strategy = planned("peg-in-hole", Method.COMBINED)
    data = plan_to_dict(strategy)
    data["task"]["uncertainty"]["control"] = 40.0
    wild = parse_plan(data)
    scene = Scene.of(wild)
    found = set()
    for seed in range(30):
        rng = np.random.default_rng(seed)
        robots = of_start(wild.space, start_region(wild.task, wild.space), 1, rng)
        lots, met, time = rng.random((1, LOTS)), np.zeros(1, dtype=np.int32), 0.0
        executor = Executor(strategy)
        now = Situation(scene.conditions[strategy.start[0]], robots, np.zeros(1), lots, met, rng)
        x, y = read(SENSINGS["noise"], now, np.zeros(1))[0][0].tolist()
        answer = executor.start(time, x, y)
        while answer.doing is Doing.MOVING:
            motion = scene.conditions[answer.region]
            now = Situation(motion, robots, np.full(1, time), lots, met, rng)
            choices = CONTROLS["bias"](now)
            positions, forces = read(SENSINGS["noise"], now, choices.angle)
            force = float(forces[0])
            x, y = positions[0].tolist()
            answer = executor.read(time, x, y, None if math.isnan(force) else force)
            soon = replace(choices, duration=np.minimum(choices.duration, 0.1))
            moves = advance(motion.simulator, robots, soon)
            if moves.manner[0] == Manner.ESCAPES and answer.doing is Doing.MOVING:
                robots = replace(moves.robots, feature=robots.feature)
            else:
                robots = moves.robots
            time += max(float(moves.time[0]), 1e-9)
        found.add(answer.doing)
        if answer.doing is Doing.BROKEN:
            assert answer.command is None
            assert answer.broken is not None
            assert answer.words
    assert Doing.BROKEN in found
