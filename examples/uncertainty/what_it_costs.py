"""What uncertainty costs who ignores it: shortest paths against plans, in MuJoCo.

Four controllers drive the same robot in the same scenes, under the same errors:

    open loop   a shortest path (OMPL), by the clock
    feedback    the same with room to the obstacles, corrected by the position sensor at 10 Hz; at
                its end it goes on pushing, and stops by the clock
    arrive      the same, but it stops as soon as the reading is within 5 cm of the goal
    plan        ours

With ours the robot is told nothing more. Run from anywhere, with the extras `physics` and OMPL:

    pip install 'preimage[physics]' ompl
    python examples/uncertainty/what_it_costs.py [--runs 200] [--seed 1] [--processes 2]

Lengths are the task's; “10 Hz” and “5 cm” are meant for a window 20 wide, and scaled with it.
"""

from __future__ import annotations

import argparse
import math
import sys
from argparse import Namespace
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
import ompl.base as ob
import ompl.geometric as og
from ompl import util

from preimage import Status, Task, named_task, plan
from preimage.configuration.contact import Floats
from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, start_region
from preimage.execution.executor import Answer, Doing
from preimage.execution.program import compiled
from preimage.execution.trace import Outcome
from preimage.geometry.angles import unit
from preimage.physics.drive import Controller
from preimage.physics.nature import Sensing, Steering
from preimage.physics.scene import scene
from preimage.physics.trials import plan_trials, trials
from preimage.task.parse import parse_task
from preimage.task.task import SlidingLaw

Point = tuple[float, float]

CONTROLLERS = ("open loop", "feedback", "arrive", "plan")

RATE = 0.1  # seconds between two corrections
ARRIVED = 0.05  # a reading within this of the goal: there
SCRAPE = 0.02  # the shortest path keeps off obstacles by so much
ROOM = 1.0  # feedback's path by so much if it can, else by as much as it can
AHEAD = 0.3  # feedback steers for the point of the path that is so far ahead
PUSH = 0.2  # at a goal in contact a path is gone on with, by so much of its length
CHECKS = 6_000  # a path is improved until so many configurations have been looked at

POSITIONS = (0.2, 0.4, 0.6, 0.8, 1.5, math.inf)
"""Position errors of the first table; the hole is 1 wide."""

TASKS = ("peg-in-hole", "cradle", "rails", "connector", "example-3", "blind-corner")


def hole(position: float) -> Task:
    """A peg above a hole 1 wide and 3 deep, to go to its bottom."""
    chain = [[-2, 0], [-0.5, 0], [-0.5, -3], [0.5, -3], [0.5, 0], [2, 0]]
    force = {"angle": 10, "threshold": 0.05}
    data = {
        "version": 1,
        "window": [-10, -6, 10, 10],
        "obstacles": [{"chain": chain, "solid": "right"}],
        "uncertainty": {"control": 5, "position": position, "force": force},
        "friction": 20,
        "sliding": "damper",
        "initial": {"point": [-4, 2.5]},
        "goal": {"edges": [[[-0.5, -3], [0.5, -3]]]},
        "planner": {"directions": 8, "method": "combined"},
    }
    return parse_task(data, name="hole")


# --- paths ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """A path, `(k, 2)` points, and at which length along it the goal is."""

    points: Floats
    goal: float

    @property
    def places(self) -> Floats:
        """(k,) how far along the path its points are."""
        steps = np.hypot(*np.diff(self.points, axis=0).T)
        return np.concatenate(([0.0], np.cumsum(steps)))

    def at(self, length: float) -> Point:
        """The point so far along the path."""
        places = self.places
        x, y = (float(np.interp(length, places, axis)) for axis in self.points.T)
        return x, y


def track(task: Task, space: ConfigurationSpace, start: Point, room: float) -> Track:
    """A short path to the goal that keeps off obstacles by `room`, or by nearly as much."""
    goal, inward = aim(task, space)
    points = None
    while points is None:
        # Above a corner, further away than room.
        for far in (room, 1.25 * room, 1.5 * room, 2.0 * room):
            hover = (goal[0] + far * inward[0], goal[1] + far * inward[1])
            points = shortest(space, start, hover, room)
            if points is not None:
                break
        room *= 0.8
        if room < space.tolerance.length:
            raise SystemExit(f"{task.name}: no path")
    points = np.concatenate((points, [goal]))
    length = float(np.sum(np.hypot(*np.diff(points, axis=0).T)))
    beyond = np.array(goal) - PUSH * length * np.array(inward)
    return Track(np.concatenate((points, [beyond])) if any(inward) else points, length)


def aim(task: Task, space: ConfigurationSpace) -> tuple[Point, Point]:
    """A point of the goal, and the unit vector from there into free space; 0 if it is there."""
    region, contact = goal_region(task, space), space.contact
    if not region.area.is_empty:
        xmin, ymin, xmax, ymax = region.area.bounds
        grid = product(np.linspace(xmin, xmax, 41), np.linspace(ymin, ymax, 41))
        inside = [(float(x), float(y)) for x, y in grid if region.area.contains(x, y)]
        return max(inside, key=lambda place: region.area.depth(*place)), (0.0, 0.0)
    found = region.contact
    if len(found.edge):
        best = int(np.argmax(found.high - found.low))
        middle = (found.low[best] + found.high[best]) / 2.0
        x, y = contact.at(found.edge[[best]], np.array([middle]))[0]
        return (float(x), float(y)), unit(float(contact.normal[found.edge[best]]))
    corner = int(found.vertices[0])
    x, y = contact.points[corner]
    sides = contact.normal[corner], contact.normal[contact.previous[corner]]
    (ax, ay), (bx, by) = (unit(float(side)) for side in sides)
    size = math.hypot(ax + bx, ay + by)
    return (float(x), float(y)), ((ax + bx) / size, (ay + by) / size)


def shortest(space: ConfigurationSpace, start: Point, stop: Point, room: float) -> Floats | None:
    """A nearly shortest path, `(k, 2)`, by BIT* and shortcuts; None if none was found."""
    plane, bounds = ob.RealVectorStateSpace(2), ob.RealVectorBounds(2)
    for axis in (0, 1):
        bounds.setLow(axis, space.window[axis])
        bounds.setHigh(axis, space.window[axis + 2])
    plane.setBounds(bounds)
    looked = 0

    def valid(state: Floats) -> bool:
        nonlocal looked
        looked += 1
        place = float(state[0]), float(state[1])
        if not space.free.contains(*place):
            return False
        near = min(room, 0.99 * space.free.depth(*start))
        return space.free.depth(*place) >= near * (1.0 - 1e-9)

    setup = og.SimpleSetup(plane)
    setup.setStateValidityChecker(valid)
    ends = [plane.allocState(), plane.allocState()]
    for state, place in zip(ends, (start, stop), strict=True):
        state[0], state[1] = place
    if not valid(ends[1]):
        return None
    setup.setStartAndGoalStates(*ends)
    setup.getSpaceInformation().setStateValidityCheckingResolution(0.002)
    setup.setPlanner(og.BITstar(setup.getSpaceInformation()))
    setup.solve(ob.PlannerTerminationCondition(lambda: looked > CHECKS))
    if not setup.haveExactSolutionPath():
        return None
    setup.simplifySolution()
    states = setup.getSolutionPath().getStates()
    return np.array([(state[0], state[1]) for state in states])


# --- controllers ----------------------------------------------------------------------------


class OpenLoop:
    """Follows a path by the clock."""

    def __init__(self, path: Track) -> None:
        self._path = path
        self._places = path.places

    def start(self, time: float, x: float, y: float) -> Answer:
        """The path's first direction."""
        return self.read(time, x, y, None)

    def read(self, time: float, x: float, y: float, force: float | None) -> Answer:
        """The direction of the path where the robot should be by now."""
        if time >= self._places[-1]:
            return Answer(Doing.DONE, None, 0, None, "the time is over")
        part = int(np.searchsorted(self._places, time, side="right")) - 1
        across, up = self._path.points[part + 1] - self._path.points[part]
        return Answer(Doing.MOVING, math.atan2(up, across), 0, None, "")


class Feedback:
    """Follows a path by what it reads, now and then.

    Parameters
    ----------
    scale : of its constants.
    arrive : it stops where the reading says that the goal is near; else by the clock.
    """

    def __init__(self, path: Track, scale: float, arrive: bool) -> None:
        self._path, self._scale, self._arrive = path, scale, arrive
        self._along, self._next = 0.0, 0.0
        self._until = 1.25 * float(path.places[-1])
        self._last = Answer(Doing.MOVING, None, 0, None, "")

    def start(self, time: float, x: float, y: float) -> Answer:
        """Towards the path's first part."""
        return self.read(time, x, y, None)

    def read(self, time: float, x: float, y: float, force: float | None) -> Answer:
        """Towards a point of the path that is ahead of what was read."""
        if time < self._next:
            return self._last
        self._next = time + RATE * self._scale
        if math.isnan(x):
            x, y = self._path.at(time)  # nothing to see: where it should be
        goal = self._path.at(self._path.goal)
        if self._arrive and math.dist((x, y), goal) <= ARRIVED * self._scale:
            self._last = Answer(Doing.DONE, None, 0, None, "the reading is near the goal")
        elif not self._arrive and time >= self._until:
            self._last = Answer(Doing.DONE, None, 0, None, "the time is over")
        else:
            self._along = max(self._along, self._nearest(x, y))
            ahead = self._path.at(self._along + AHEAD * self._scale)
            command = math.atan2(ahead[1] - y, ahead[0] - x)
            self._last = Answer(Doing.MOVING, command, 0, None, "")
        return self._last

    def _nearest(self, x: float, y: float) -> float:
        """How far along the path its point nearest to a place is, not far from the last one."""
        ahead = self._along + np.linspace(0.0, 2.0 * AHEAD * self._scale, 33)
        across, up = (np.interp(ahead, self._path.places, axis) for axis in self._path.points.T)
        return float(ahead[np.argmin(np.hypot(across - x, up - y))])


# --- tables ---------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Case:
    """A cell of a table: who drives along which path, and how sensors err (None: either way)."""

    task: Task
    controller: str
    path: Track
    sensing: Sensing | None
    runs: int
    seed: int


def ran(case: Case) -> Counter[Outcome]:
    """How the runs of a case ended."""
    stage = scene(case.task)
    kinds = tuple(product(Steering, Sensing if case.sensing is None else (case.sensing,)))
    if case.controller == "plan":
        strategy = plan(case.task)
        if strategy.status is not Status.SOLVED:
            return Counter()
        drives = plan_trials(stage, compiled(strategy), case.runs, case.seed, kinds)
    else:
        patience = 1.5 * float(case.path.places[-1])
        drives = trials(stage, lambda _: follower(case), case.runs, case.seed, patience, kinds)
    return Counter(one.outcome for one in drives)


def follower(case: Case) -> Controller:
    """Follows a path for one run."""
    if case.controller == "open loop":
        return OpenLoop(case.path)
    return Feedback(case.path, scale_of(case.task), case.controller == "arrive")


def scale_of(task: Task) -> float:
    """What the constants are multiples of."""
    window = task.workspace.window
    return max(window.xmax - window.xmin, window.ymax - window.ymin) / 20.0


def paths(tasks: Sequence[Task]) -> list[dict[str, Track]]:
    """For each task the path of each controller; those with feedback share one."""
    found: dict[object, dict[str, Track]] = {}
    for task in tasks:
        known = task.workspace, task.robot, task.initial, task.goal
        if known in found:
            continue
        space = configuration_space(task)
        start, scale = expected(start_region(task, space)), scale_of(task)
        short = track(task, space, start, SCRAPE * scale)
        roomy = track(task, space, start, ROOM * scale)
        found[known] = dict.fromkeys(CONTROLLERS, roomy) | {"open loop": short}
    return [found[task.workspace, task.robot, task.initial, task.goal] for task in tasks]


def expected(start: Start) -> Point:
    """The middle of where the robot may be."""
    if start.point is not None:
        return start.point
    xmin, ymin, xmax, ymax = start.region.area.bounds
    return (xmin + xmax) / 2.0, (ymin + ymax) / 2.0


WORDS = {
    Outcome.WRONG: "wrong",
    Outcome.UNKNOWN: "unaware",
    Outcome.ENDLESS: "lost",
    Outcome.ESCAPED: "escaped",
    Outcome.BROKEN: "noticed",
}
"""How runs fail: it says that it is there and is not; is there and does not know; never arrives;
leaves the window; says that its readings contradict the model."""


def cell(ends: Counter[Outcome]) -> str:
    """A cell's words: the share of success, and how the others failed, all in per cent."""
    runs = ends.total()
    if not runs:
        return "no plan"
    share = {how: f"{100.0 * many / runs:.3g}" for how, many in ends.items() if many}
    failed = ", ".join(f"{share[how]} {word}" for how, word in WORDS.items() if how in share)
    return share.get(Outcome.SUCCESS, "0") + (f" ({failed})" if failed else "")


Row = tuple[str, Task, Sensing | None]


def table(head: str, rows: Sequence[Row], options: Namespace) -> str:
    """A table in Markdown: a row a task, a column a controller."""
    tracks = paths([task for _, task, _ in rows])
    cases = [
        Case(task, controller, tracks[row][controller], sensing, options.runs, options.seed)
        for row, (_, task, sensing) in enumerate(rows)
        for controller in CONTROLLERS
    ]
    with ProcessPoolExecutor(options.processes) as pool:
        ends = pool.map(ran, cases)
        lines = [f"| {head} | " + " | ".join(CONTROLLERS) + " |"]
        lines.append("|---|" + "--:|" * len(CONTROLLERS))
        for name, _, _ in rows:
            mine = [cell(next(ends)) for _ in CONTROLLERS]
            lines.append(f"| {name} | " + " | ".join(mine) + " |")
    return "\n".join(lines)


def holes(options: Namespace) -> str:
    """The hole 1 wide, by position error."""
    rows: list[Row] = []
    for sensing, error in product(Sensing, options.positions):
        if math.isfinite(error):
            rows.append((f"{error:g}, {sensing.name.lower()}", hole(error), sensing))
        elif sensing is Sensing.OFFSET:
            rows.append(("no sensor", hole(error), sensing))
    return table("ρ", rows, options)


def named(options: Namespace) -> str:
    """Named tasks."""
    tasks = [replace(named_task(name), sliding=SlidingLaw.DAMPER) for name in options.tasks]
    return table("task", [(task.name, task, None) for task in tasks], options)


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--runs", type=int, default=200, help="runs a cell (200)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--positions", type=float, nargs="*", default=POSITIONS)
    parser.add_argument("--tasks", nargs="*", default=TASKS)
    options = parser.parse_args()
    util.setLogLevel(util.LOG_ERROR)
    util.RNG.setSeed(options.seed)
    for rows, made in ((options.positions, holes), (options.tasks, named)):
        if rows:
            sys.stdout.write(made(options) + "\n\n")


if __name__ == "__main__":
    main()
