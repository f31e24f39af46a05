"""Some runs of a plan under one pair of adversaries, from its start to its end."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self, TypeVar

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from preimage.configuration.contact import Bools, Floats, Ints
from preimage.configuration.region import Region
from preimage.execution.control import Control
from preimage.execution.motion import Ended, MotionRun, carry_out, recognised
from preimage.execution.nearest import outline
from preimage.execution.program import Program, compiled
from preimage.execution.sensing import Sensing, read
from preimage.execution.simulator import Robots, Simulator
from preimage.execution.situation import LOTS, Conditions, Situation
from preimage.execution.starts import is_in
from preimage.execution.trace import Leg, Outcome, Trace
from preimage.strategy.strategy import Strategy

Kind = TypeVar("Kind", bound=np.generic)

SLACK = 100.0
"""A robot so many tolerances from the goal, within its feature, is in it."""

WORDS = {
    Ended.READING: "reading",
    Ended.STICKING: "sticking",
    Ended.ELAPSED: "elapsed",
}
"""The conditions that end motions."""

OUTCOMES = tuple(Outcome)
"""Outcomes by number."""

NO_MARKS: Mapping[int, Region] = {}


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A plan made ready: its program, and what nature knows of each motion, by region id."""

    strategy: Strategy
    program: Program
    conditions: Mapping[int, Conditions]

    @classmethod
    def of(cls, strategy: Strategy, marks: Mapping[int, Region] = NO_MARKS) -> Self:
        """Compile a plan.

        Parameters
        ----------
        marks : by region id, the borders at which its motion is looked at, if not its target's.
        """
        program = compiled(strategy)
        conditions = {}
        for number, made in program.motions.items():
            motion = made.region.motion
            assert motion is not None
            goals = [strategy.region(goal).region for goal in motion.goals]
            mark = marks.get(number, motion.target)
            conditions[number] = _conditions(strategy, motion.direction, motion.target, mark, goals)
        return cls(strategy, program, conditions)


def _conditions(
    strategy: Strategy, direction: float, target: Region, mark: Region, goals: list[Region]
) -> Conditions:
    """What nature knows of a motion; its way is looked at at the borders of `mark`."""
    space, task = strategy.space, strategy.task
    return Conditions(
        Simulator.of(space, task.friction, task.sliding, mark),
        direction,
        task.uncertainty,
        target,
        np.concatenate([outline(space.contact, goal) for goal in goals]),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Stage:
    """One motion of some of the robots: who, when it began, and what became of them."""

    region: int
    who: NDArray[np.intp]
    begun: Floats
    made: MotionRun


@dataclass(frozen=True, slots=True, eq=False)
class Chunk:
    """Some runs under one pair of adversaries.

    Parameters
    ----------
    pair : names of the adversaries.
    first : number of the first of them.
    outcomes : (k,) how each ended, by its place in `Outcome`.
    time, distance, motions : (k,) what each took, in units of length, and a count.
    """

    scene: Scene
    pair: tuple[str, str]
    first: int
    stages: tuple[_Stage, ...]
    outcomes: NDArray[np.int8]
    time: Floats
    distance: Floats
    motions: Ints

    def trace(self, place: int) -> Trace:
        """One of them, whole."""
        legs = [
            _leg(self.scene, stage, int(np.flatnonzero(stage.who == place)[0]))
            for stage in self.stages
            if place in stage.who
        ]
        outcome = OUTCOMES[int(self.outcomes[place])]
        return Trace(
            self.scene.strategy,
            tuple(legs),
            outcome,
            *self.pair,
            number=self.first + place,
            words="" if outcome.as_planned else outcome.value,
        )


def carry_out_plan(
    scene: Scene,
    pair: tuple[str, str],
    adversaries: tuple[Control, Sensing],
    starts: Robots,
    rng: Generator,
    first: int = 0,
) -> Chunk:
    """Carry a plan out from many starts at once, until every run has ended (theory 8).

    Motions are carried out by falling rank, each for all robots that wait for it. A run ends where
    the goal or failure is recognised, or where nothing more can come of it; what it came to is
    judged by where the robot truly is.

    Parameters
    ----------
    pair : the adversaries' names.
    first : the number of the first run.
    """
    strategy, count = scene.strategy, len(starts)
    lots = rng.random((count, LOTS))
    region = _first(scene, starts, lots, adversaries[1], rng)
    now = starts.part(np.ones(count, dtype=np.bool_))
    total, went = np.zeros(count), np.zeros(count)
    motions = np.zeros(count, dtype=np.int32)
    outcomes = _begun(strategy, starts, region)
    stages = []
    for number in sorted(scene.conditions, key=lambda n: (-strategy.region(n).rank, n)):
        who = np.flatnonzero(region == number)
        if not len(who):
            continue
        made = carry_out(
            scene.program.motions[number],
            scene.conditions[number],
            now.part(who),
            lots[who],
            *adversaries,
            rng,
        )
        stages.append(_Stage(number, who, total[who], made))
        now.put(who, made.robots)
        total[who] += made.time
        went[who] += made.distance
        motions[who] += 1
        region[who], outcomes[who] = made.goal, _judged(strategy, made)
        region[who[outcomes[who] != OUTCOMES.index(Outcome.SUCCESS)]] = -1
    return Chunk(scene, pair, first, tuple(stages), outcomes, total, went, motions)


def _first(scene: Scene, starts: Robots, lots: Floats, sensing: Sensing, rng: Generator) -> Ints:
    """(k,) the region that each robot begins with, by one look at its position; -1 if none."""
    choices = scene.program.beginning.choices
    if len(choices) == 1 and choices[0].goal not in scene.conditions:
        return np.full(len(starts), choices[0].goal, dtype=np.int32)
    known = [scene.conditions[c.goal] for c in choices if c.goal in scene.conditions]
    motion = next(iter((*known, *scene.conditions.values())), None)
    if motion is None:
        goal = scene.strategy.region(0).region
        motion = _conditions(scene.strategy, 0.0, goal, goal, [goal])
    nothing = np.zeros(len(starts))
    now = Situation(motion, starts, nothing, lots, nothing.astype(np.int32), rng)
    positions, _ = read(sensing, now, nothing)
    return recognised(choices, positions, np.full(len(starts), np.nan))


def _begun(strategy: Strategy, starts: Robots, region: Ints) -> NDArray[np.int8]:
    """(k,) what came of choosing the first region: a success as well if the run goes on."""
    # who cannot tell which motion to begin with stays where it is
    cases = [(region < 0, Outcome.ENDLESS)]
    slack = SLACK * strategy.space.tolerance.length
    for end in strategy.failures:
        there = is_in(strategy.space, end.region, starts, slack)
        cases += [
            ((region == end.id) & there, Outcome.FAILED),
            ((region == end.id) & ~there, Outcome.WRONG),
        ]
    return _selected(cases)


def _judged(strategy: Strategy, made: MotionRun) -> NDArray[np.int8]:
    """(k,) what each robot's motion came to, in truth; a success as well if the run goes on."""
    space = strategy.space
    slack = SLACK * space.tolerance.length
    at_goal = is_in(space, strategy.region(0).region, made.robots, slack)
    truly = np.zeros(len(made.goal), dtype=np.bool_)
    for goal in np.unique(made.goal[made.goal >= 0]).tolist():
        there = is_in(space, strategy.region(goal).region, made.robots, slack)
        truly |= there & (made.goal == goal)
    cases: list[tuple[Bools, Outcome]] = [
        (made.ended == Ended.ESCAPED, Outcome.ESCAPED),
        ((made.goal < 0) & at_goal, Outcome.UNKNOWN),
        (made.goal < 0, Outcome.ENDLESS),
        (~truly, Outcome.WRONG),
        (np.isin(made.goal, [end.id for end in strategy.failures]), Outcome.FAILED),
    ]
    return _selected(cases)


def _selected(cases: list[tuple[Bools, Outcome]]) -> NDArray[np.int8]:
    """(k,) the first outcome whose case it is; else a success."""
    return np.select(
        [case for case, _ in cases],
        [np.int8(OUTCOMES.index(outcome)) for _, outcome in cases],
        np.int8(OUTCOMES.index(Outcome.SUCCESS)),
    )


def _leg(scene: Scene, stage: _Stage, index: int) -> Leg:
    """One robot's share of a stage, up to the instant at which it ended."""
    made, span = stage.made, stage.made.tracks.robot(index)
    tracks, end = made.tracks, float(made.time[index])
    before = tracks.time[span] < end
    before[0] = True  # also of a motion that ended where it began
    keep = np.arange(span.start, span.stop)[before]
    if end > tracks.time[keep[-1]]:
        last = min(int(keep[-1]) + 1, span.stop - 1)
    else:
        keep, last = keep[:-1], int(keep[-1])

    def column(values: NDArray[Kind], final: Any) -> NDArray[Kind]:
        return np.concatenate((values[keep], np.array([final], dtype=values.dtype)))

    place = (made.robots.x[index], made.robots.y[index])
    return Leg(
        region=stage.region,
        direction=scene.program.motions[stage.region].direction,
        times=column(tracks.time, end) + stage.begun[index],
        places=column(tracks.places, place),
        features=column(tracks.feature, made.robots.feature[index]),
        actual=column(tracks.angle, tracks.angle[last]),
        measured=column(tracks.measured, tracks.measured[last]),
        forces=column(tracks.force, tracks.force[last]),
        ended_by=WORDS.get(Ended(int(made.ended[index])), ""),
    )
