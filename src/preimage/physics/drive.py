"""One run: a controller drives the engine's robot, as it would a robot."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from preimage.configuration.contact import Floats
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.execution.executor import Answer, Doing
from preimage.execution.trace import Outcome
from preimage.geometry.clipping import distances
from preimage.physics.engine import Engine
from preimage.physics.nature import Nature
from preimage.physics.scene import Scene
from preimage.physics.touch import Touch

Point = tuple[float, float]

SETTLED = 10.0
"""A robot told to stop is looked at again after so many settling times."""


class Controller(Protocol):
    """What decides: the executor of a plan, or anything else that answers readings."""

    def start(self, time: float, x: float, y: float) -> Answer:
        """The first command."""

    def read(self, time: float, x: float, y: float, force: float | None) -> Answer:
        """The command after a reading."""


@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """What happened in a run.

    Parameters
    ----------
    outcome : how it ended, judged by where the robot was.
    gap : how far from the goal it was when it was told to stop, in the unit of length.
    rest : the same once it stood still.
    time : how long it took.
    depth : how deep it was in an obstacle at most.
    withheld : how many readings were kept from the controller, as the force had not settled.
    words : what the controller said at the end.
    times, places, measured, forces, commands, actual, regions : (k,) and (k, 2), at every reading:
        the clock, the true position, what was read (NaN where nothing or 0 was), the direction
        that was commanded next and the one that it became (NaN for none), and the plan's region.
    """

    outcome: Outcome
    gap: float
    rest: float
    time: float
    depth: float
    withheld: int
    words: str
    times: Floats
    places: Floats
    measured: Floats
    forces: Floats
    commands: Floats
    actual: Floats
    regions: Floats


@dataclass(slots=True)
class _Log:
    """One row a reading."""

    rows: list[tuple[float, ...]] = field(default_factory=list)

    def add(
        self,
        time: float,
        place: Point,
        read: Point,
        force: float | None,
        answer: Answer,
        nature: Nature,
    ) -> None:
        """Note a reading and its answer."""
        felt = math.nan if force is None else force
        command = math.nan if answer.command is None else answer.command
        actual = command + nature.deviation(time)
        self.rows.append((time, *place, *read, felt, command, actual, float(answer.region)))


def drive(
    scene: Scene,
    engine: Engine,
    controller: Controller,
    nature: Nature,
    start: Point,
    patience: float,
) -> Drive:
    """Let a controller drive from a start until it stops, gives up, or patience ends.

    Parameters
    ----------
    scene, engine : the world; the engine is used again from run to run.
    nature : the errors; the position at the start is read through it too.
    start : where the robot is.
    patience : the longest time to wait, in units of length.
    """
    log, depth = _Log(), 0.0
    engine.place(*start)
    read = nature.position(start)
    answer = controller.start(0.0, *read)
    log.add(0.0, start, read, None, answer, nature)
    slack = scene.plant.slack * scene.length
    pause = scene.plant.pause * scene.length
    longest = scene.plant.longest * scene.length
    quiet, shown, withheld = pause, 0.0, 0
    touch = Touch(scene.plant, scene.task.uncertainty.force_thresholds[0])
    while answer.doing is Doing.MOVING and engine.time < patience:
        depth = max(depth, _move(scene, engine, nature, answer))
        place = engine.position
        if _outside(scene.space, place, slack):
            break
        touch.add(engine.force)
        if engine.time < quiet:
            touch.forget()
            continue
        if not touch.is_settled and engine.time - shown < longest:
            withheld += 1
            continue
        read, force = nature.position(place), nature.force(touch.felt)
        shown, before = engine.time, answer.region
        answer = controller.read(engine.time, *read, force)
        if answer.region != before:
            quiet = engine.time + pause
        log.add(engine.time, place, read, force, answer, nature)
    place, time = engine.position, engine.time
    engine.move(None, math.ceil(SETTLED * scene.plant.steps))
    goal = goal_region(scene.task, scene.space)
    gap = distance_from(goal, scene.space, place)
    rest = distance_from(goal, scene.space, engine.position)
    table = np.array(log.rows)
    return Drive(
        _outcome(answer.doing, gap <= slack, _outside(scene.space, place, slack)),
        gap,
        rest,
        time,
        depth,
        withheld,
        answer.words,
        table[:, 0],
        table[:, 1:3],
        table[:, 3:5],
        table[:, 5],
        table[:, 6],
        table[:, 7],
        table[:, 8],
    )


def _move(scene: Scene, engine: Engine, nature: Nature, answer: Answer) -> float:
    """Go on until the next look; how deep the robot then is in an obstacle."""
    pull = None
    if answer.command is not None:
        pull = answer.command + nature.deviation(engine.time)
    engine.move(pull, scene.plant.every)
    return engine.depth


def distance_from(region: Region, space: ConfigurationSpace, place: Point) -> float:
    """How far a place is from a region of valid space; 0 within."""
    contact = region.contact
    low, high = (space.contact.at(contact.edge, at) for at in (contact.low, contact.high))
    corners = space.contact.points[contact.vertices]
    starts, ends = np.concatenate((low, corners)), np.concatenate((high, corners))
    return float(distances(np.array([place]), region.area, starts, ends)[0])


def _outside(space: ConfigurationSpace, place: Point, slack: float) -> bool:
    """Whether the robot has left the window; walls give way a little."""
    xmin, ymin, xmax, ymax = space.window
    x, y = place
    return not (xmin - slack <= x <= xmax + slack and ymin - slack <= y <= ymax + slack)


def _outcome(doing: Doing, near: bool, escaped: bool) -> Outcome:
    if escaped:
        return Outcome.ESCAPED
    if doing is Doing.DONE:
        return Outcome.SUCCESS if near else Outcome.WRONG
    if doing is Doing.FAILED:
        return Outcome.WRONG if near else Outcome.FAILED
    if doing is Doing.BROKEN:
        return Outcome.BROKEN
    return Outcome.UNKNOWN if near else Outcome.ENDLESS
