"""One motion of many robots, until its termination condition ends it (theory 5, 6)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import TypeVar

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from preimage.configuration.contact import Bools, Floats, Ints
from preimage.execution.control import Control
from preimage.execution.program import CompiledMotion, Recognition
from preimage.execution.sensing import INSIDE, Sensing, read
from preimage.execution.simulator import Bytes, Choices, Manner, Moves, Robots, advance
from preimage.execution.situation import Conditions, Situation
from preimage.execution.tracks import Tracks, first_return, where

Indices = NDArray[np.intp]
Kind = TypeVar("Kind", bound=np.generic)

STRIDES = 12.0
"""Nature and the sensors are asked again at least so many times while the window is crossed."""

MOST_LOOKS = 2_000
"""A robot that has been looked at so often never stops."""

PATIENCE = 300
"""After so many looks nature changes her mind at events alone: some slides are very slow."""

AT_REST = 4
"""A robot that is held for good is looked at so often before it is given up or waited for."""


class Ended(IntEnum):
    """What ended a motion."""

    MOVING = 0
    READING = 1
    STICKING = 2
    ELAPSED = 3
    ESCAPED = 4
    LATE = 5  # it took longer than it may
    ENDLESS = 6


@dataclass(frozen=True, slots=True, eq=False)
class MotionRun:
    """What became of k robots in one motion.

    Parameters
    ----------
    robots : where they are at the end.
    time : (k,) how long it took, in units of length.
    ended : (k,) `Ended`.
    goal : (k,) id of the goal that was recognised, -1 if none.
    distance : (k,) how far they went.
    """

    robots: Robots
    time: Floats
    ended: Bytes
    goal: Ints
    distance: Floats
    tracks: Tracks


class _Notes:
    """What is noted of all robots on the way, in the order of time."""

    def __init__(self) -> None:
        self._rows: list[tuple[Indices, Floats, Robots, Ints, Floats, Floats, Floats]] = []

    def add(
        self,
        who: Indices,
        time: Floats,
        robots: Robots,
        between: Ints,
        angle: Floats,
        read_: tuple[Floats, Floats],
    ) -> None:
        self._rows.append((who, time, robots, between, angle, *read_))

    def last_angle(self, count: int) -> Floats:
        """(k,) the direction that each robot was last driven in."""
        angle = np.zeros(count)
        for row in self._rows:
            angle[row[0]] = row[4]
        return angle

    def tracks(self, count: int) -> Tracks:
        """The same robot by robot."""
        who = np.concatenate([row[0] for row in self._rows])
        order = np.argsort(who, kind="stable")

        def column(values: list[NDArray[Kind]]) -> NDArray[Kind]:
            return np.concatenate(values)[order]

        start = np.zeros(count + 1, dtype=np.int64)
        np.cumsum(np.bincount(who, minlength=count), out=start[1:])
        return Tracks(
            start,
            time=column([row[1] for row in self._rows]),
            places=column([row[2].places for row in self._rows]),
            feature=column([row[2].feature for row in self._rows]),
            between=column([row[3] for row in self._rows]),
            angle=column([row[4] for row in self._rows]),
            measured=column([row[5] for row in self._rows]),
            force=column([row[6] for row in self._rows]),
        )


class _Flock:
    """The state of all robots while a motion is carried out."""

    def __init__(self, robots: Robots, lots: Floats) -> None:
        count = len(robots)
        self.robots = robots
        self.lots = lots
        self.time, self.distance = np.zeros(count), np.zeros(count)
        self.met = np.zeros(count, dtype=np.int32)
        self.rested = np.zeros(count, dtype=np.int32)
        self.ended = np.zeros(count, dtype=np.uint8)
        self.goal = np.full(count, -1, dtype=np.int32)

    def situation(self, conditions: Conditions, who: Indices, rng: Generator) -> Situation:
        """What nature sees of some of them."""
        return Situation(
            conditions,
            self.robots.part(who),
            self.time[who],
            self.lots[who],
            self.met[who],
            rng,
        )


def carry_out(
    motion: CompiledMotion,
    conditions: Conditions,
    starts: Robots,
    lots: Floats,
    control: Control,
    sensing: Sensing,
    rng: Generator,
) -> MotionRun:
    """Carry one motion out, from many starts, until it ends.

    The sensors are looked at whenever something is met, wherever the border of the target is
    crossed, and in between at least every `1 / STRIDES` of the window. That the robot has hardly
    moved is noticed at the very instant at which it becomes true.

    Parameters
    ----------
    conditions : for the same motion; its simulator is interrupted at the target's border.
    lots : (k, `LOTS`) what persists in each robot's errors.
    """
    everybody: Indices = np.arange(len(starts), dtype=np.intp)
    flock, notes = _Flock(starts.part(everybody), lots), _Notes()
    active = everybody
    xmin, ymin, xmax, ymax = conditions.simulator.space.window
    stride = max(xmax - xmin, ymax - ymin) / STRIDES
    for looks in range(MOST_LOOKS):
        if not len(active):
            break
        now = flock.situation(conditions, active, rng)
        choices = now.admissible(control(now))
        seen = read(sensing, now, choices.angle)
        told = recognised(motion.by_reading, *seen)
        flock.goal[active] = told
        over = told >= 0
        flock.ended[active[over]] = Ended.READING
        if looks >= PATIENCE:
            stride = np.inf
            choices = replace(choices, duration=np.full(len(active), np.inf))
        moves = advance(conditions.simulator, now.robots, _soon(motion, now, choices, stride))
        notes.add(active, now.time, now.robots, moves.between, choices.angle, seen)
        going = ~over
        who, moves_on = active[going], _part(moves, going)
        _move(flock, motion, conditions, who, moves_on)
        active = who[flock.ended[who] == Ended.MOVING]
    flock.ended[active] = Ended.ENDLESS
    final = notes.last_angle(len(starts))
    nothing = (np.full((len(starts), 2), np.nan), np.full(len(starts), np.nan))
    robots = flock.robots.part(everybody)
    notes.add(everybody, flock.time.copy(), robots, robots.feature, final, nothing)
    tracks = notes.tracks(len(starts))
    _stuck(flock, motion, conditions, tracks, sensing)
    _rest_goals(flock, motion, conditions, sensing, rng, final)
    return MotionRun(flock.robots, flock.time, flock.ended, flock.goal, flock.distance, tracks)


def recognised(recognitions: tuple[Recognition, ...], positions: Floats, forces: Floats) -> Ints:
    """(k,) the first goal that each reading certainly tells, -1 where it tells none."""
    goal = np.full(len(forces), -1, dtype=np.int32)
    for recognition in recognitions:
        open_ = np.flatnonzero(goal < 0)
        if recognition.cells is None:
            goal[open_] = recognition.goal
            break
        if len(open_):
            tells = recognition.cells.misses_all(positions[open_], forces[open_])
            goal[open_[tells]] = recognition.goal
    return goal


def _soon(motion: CompiledMotion, now: Situation, choices: Choices, stride: float) -> Choices:
    """The same choices, with another look after a stride at the latest, or when time is up."""
    limit = np.minimum(choices.duration, stride)
    if motion.elapsed is not None:
        limit = np.minimum(limit, np.maximum(motion.elapsed.period - now.time, 0.0))
    return Choices(choices.angle, limit, choices.wish, choices.chance)


def _part(moves: Moves, which: Bools) -> Moves:
    return Moves(
        moves.robots.part(which), moves.time[which], moves.between[which], moves.manner[which]
    )


def _move(
    flock: _Flock, motion: CompiledMotion, conditions: Conditions, who: Indices, moves: Moves
) -> None:
    """Let robots go on, and see who has ended by itself."""
    n = len(conditions.simulator.space.contact)
    gone = moves.robots.places - flock.robots.places[who]
    flock.distance[who] += np.hypot(gone[:, 0], gone[:, 1])
    met = (moves.robots.feature != flock.robots.feature[who]) & (moves.robots.feature < 2 * n)
    flock.met[who] += met
    flock.robots.put(who, moves.robots)
    flock.time[who] += moves.time
    held = (moves.manner == Manner.RESTS) & conditions.surely_sticks[moves.robots.feature]
    flock.rested[who] = np.where(held, flock.rested[who] + 1, 0)
    flock.ended[who[_escaped(moves, conditions)]] = Ended.ESCAPED
    moving = flock.ended[who] == Ended.MOVING
    if motion.elapsed is not None:
        up = moving & (flock.time[who] >= motion.elapsed.period)
        flock.ended[who[up]] = Ended.ELAPSED
    for_good = moving & (flock.rested[who] >= AT_REST)
    if motion.sticking is not None:
        # where it rests now the condition becomes true, at the latest after a whole period
        wait = who[for_good]
        flock.time[wait] += motion.sticking.period
        flock.ended[wait] = Ended.ENDLESS
    elif motion.elapsed is None:
        flock.ended[who[for_good]] = Ended.ENDLESS
    if math.isfinite(motion.longest):
        slack = conditions.simulator.space.tolerance.length
        late = (flock.ended[who] == Ended.MOVING) & (flock.time[who] > motion.longest + slack)
        flock.ended[who[late]] = Ended.LATE


def _escaped(moves: Moves, conditions: Conditions) -> Bools:
    """Who is outside: flown through an open side, or at a vertex beside one, outside the target."""
    contact = conditions.simulator.space.contact
    n = len(contact)
    escaped = moves.manner == Manner.ESCAPES
    corner = np.flatnonzero((moves.robots.feature >= n) & (moves.robots.feature < 2 * n))
    vertex = moves.robots.feature[corner] - n
    beside = contact.open[vertex] | contact.open[contact.previous[vertex]]
    beside &= ~np.isin(vertex, conditions.target.contact.vertices)
    escaped[corner[beside]] = True
    return np.asarray(escaped)


def _stuck(
    flock: _Flock,
    motion: CompiledMotion,
    conditions: Conditions,
    tracks: Tracks,
    sensing: Sensing,
) -> None:
    """Who has hardly moved for long enough has ended at the first instant of that."""
    rho = conditions.uncertainty.position
    if motion.sticking is None or math.isinf(rho):
        return  # without a position sensor nothing is seen to stand still
    most = motion.sticking.distance + 2.0 * INSIDE * rho * sensing.still
    reach = np.full(len(flock.time), most)
    back = first_return(tracks, motion.sticking.period, reach)
    open_ = ~np.isin(flock.ended, (Ended.READING, Ended.ELAPSED))
    first = np.flatnonzero((back < flock.time) | ((back <= flock.time) & open_))
    if not len(first):
        return
    places, feature, _ = where(tracks, first, back[first])
    flock.robots.put(first, _standing(conditions, places, feature))
    flock.time[first] = back[first]
    flock.ended[first] = Ended.STICKING
    flock.goal[first] = -1


def _standing(conditions: Conditions, places: Floats, feature: Ints) -> Robots:
    """Robots at places on features."""
    contact = conditions.simulator.space.contact
    edge = np.where(feature < len(contact), feature, 0)
    off = places - contact.points[edge]
    along = np.sum(off * contact.tangent[edge], axis=1)
    return Robots(
        places[:, 0].copy(),
        places[:, 1].copy(),
        feature.astype(np.int32),
        np.where(feature < len(contact), along, 0.0),
    )


def _rest_goals(
    flock: _Flock,
    motion: CompiledMotion,
    conditions: Conditions,
    sensing: Sensing,
    rng: Generator,
    angle: Floats,
) -> None:
    """In which goal they are who ended by standing still, or by the clock."""
    who = np.flatnonzero(np.isin(flock.ended, (Ended.STICKING, Ended.ELAPSED)))
    if not len(who):
        return
    now = flock.situation(conditions, who, rng)
    flock.goal[who] = recognised(motion.by_rest, *read(sensing, now, angle[who]))
