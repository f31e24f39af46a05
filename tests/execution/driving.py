"""A robot that an executor drives: exact motion in small steps, nature's errors by chance."""

import math
from dataclasses import dataclass

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import start_region
from preimage.execution.contact_forces import contact_forces
from preimage.execution.executor import Answer, Doing, Executor
from preimage.execution.program import Program
from preimage.execution.simulator import Choices, Manner, Robots, Simulator, Wish, advance
from preimage.execution.starts import of_start

INSIDE = 1.0 - 1e-9
"""The bounds of errors are open."""

MOST = 20_000


@dataclass
class Drive:
    """What became of a robot."""

    answer: Answer
    regions: tuple[int, ...]
    robots: Robots
    readings: int


def drive(program: Program, seed: int, stride: float) -> Drive:
    """Start anywhere, obey the executor; a reading after every `stride` at most."""
    strategy, rng = program.strategy, np.random.default_rng(seed)
    task, space = strategy.task, strategy.space
    senses = task.uncertainty
    simulator = Simulator.of(space, task.friction, task.sliding)
    executor = Executor(program)
    start = start_region(task, space)
    robots = of_start(space, start, 1, rng).part(np.zeros(1, dtype=np.intp))
    cone = max(0.0, senses.control - 2.0 * space.tolerance.angle)

    def place() -> tuple[float, float]:
        if not senses.has_position_sensor:
            return math.nan, math.nan
        turn = rng.uniform(0.0, math.tau)
        off = INSIDE * senses.position * rng.choice((1.0, rng.random()))
        return robots.x[0] + off * math.cos(turn), robots.y[0] + off * math.sin(turn)

    def force(angle: float) -> float | None:
        direction, size = contact_forces(simulator, robots, np.array([angle]), rng.random(1))
        if size[0] <= rng.choice(senses.force_thresholds):
            return None
        return float(direction[0] + INSIDE * senses.force_angle * rng.uniform(-1.0, 1.0))

    time, readings, turn, until = 0.0, 0, 0.0, 0.0
    answer = executor.start(time, *place())
    regions = [answer.region]
    while answer.doing is Doing.MOVING and readings < MOST:
        assert answer.command is not None
        if time >= until:
            turn = rng.choice((-cone, cone, rng.uniform(-cone, cone)))
            until = time + rng.choice((stride, rng.uniform(0.0, 100.0 * stride)))
        angle, step = answer.command + turn, stride * rng.uniform(0.1, 1.0)
        robots = moved(simulator, robots, angle, step, rng)
        time += step
        answer = executor.read(time, *place(), force(angle))
        readings += 1
        if answer.region != regions[-1]:
            regions.append(answer.region)
    return Drive(answer, tuple(regions), robots, readings)


def moved(
    simulator: Simulator, robots: Robots, angle: float, time: float, rng: np.random.Generator
) -> Robots:
    """A robot after a time under one actual direction."""
    while time > 0.0:
        choices = Choices(
            np.array([angle]), np.array([time]), np.full(1, Wish.ANY, np.uint8), rng.random(1)
        )
        moves = advance(simulator, robots, choices)
        robots = moves.robots
        assert moves.manner[0] != Manner.ESCAPES
        if moves.manner[0] == Manner.RESTS:
            break
        time -= float(moves.time[0])
    return robots


def holds(space: ConfigurationSpace, region: Region, robots: Robots) -> bool:
    """Whether a robot is in a region; ends of edges count as their edges' here."""
    n, feature = len(space.contact), int(robots.feature[0])
    near = 10.0 * space.tolerance.length
    if feature < n:
        return region.contact.contains(feature, float(robots.along[0]), near)
    if feature < 2 * n:
        return region.contact.has_vertex(feature - n)
    return region.area.distance(float(robots.x[0]), float(robots.y[0])) <= near
