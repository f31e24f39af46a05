"""Motions carried out against nature, with their termination conditions (theory 5, 6, 8).

A run is judged at every instant that matters, not by one sensor's luck: where the robot is outside
the goal, no admissible reading may make a condition true; where it is in the recognised part of
the goal, every admissible reading must. Between them it must stay in the preimage.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from random import Random

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.configuration.start import StartKind, start_region
from preimage.preimages.methods import preimage
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.recognition.interpretation import contained, interpretation
from preimage.recognition.outside import Outside, outside
from preimage.recognition.termination import (
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.strategy.strategy import Strategy
from tests.laws.adversaries import CONTROLS, Motion, Reading, forces, pick, positions
from tests.laws.passage import between, on_the_way, starts
from tests.laws.world import AtVertex, Doing, Free, Lost, Move, OnEdge, State, World

LONGEST = 3_000
"""Moves after which a motion counts as endless."""

PATIENCE = 200
"""Moves after which nature changes her mind at contacts alone."""

SLACK = 1e-6
"""A state this near to a region, within its feature, may be in it: a fraction of the window."""


class Told(Enum):
    """Whether the readings that a state may give make a condition true."""

    NOT = "none does"
    MAYBE = "some do"
    SURELY = "all do"


class ViolationError(AssertionError):
    """The guarantee is broken."""


@dataclass(slots=True)
class Track:
    """Where the robot was, and when: straight and at constant speed in between."""

    times: list[float] = field(default_factory=list)
    places: list[tuple[float, float]] = field(default_factory=list)
    states: list[State] = field(default_factory=list)

    def add(self, time: float, place: tuple[float, float], state: State) -> None:
        """Go on to a place."""
        self.times.append(time)
        self.places.append(place)
        self.states.append(state)

    def nearest_return(self, period: float) -> float:
        """The least distance between two places that are `period` apart in time; else infinite."""
        times = np.array(self.times)
        if times[-1] < period:
            return math.inf
        places = np.array(self.places)
        instants = np.unique(np.concatenate((times, times + period)))
        instants = instants[(instants >= period) & (instants <= times[-1])]
        gaps = np.stack(
            [
                np.interp(instants, times, places[:, axis])
                - np.interp(instants - period, times, places[:, axis])
                for axis in (0, 1)
            ],
            axis=1,
        )
        if len(gaps) == 1:
            return float(np.hypot(*gaps[0]))
        # in between the gap changes linearly
        origin = shapely.Point(0.0, 0.0)
        return float(shapely.distance(shapely.LineString(gaps), origin))


@dataclass(frozen=True, slots=True)
class Execution:
    """One preimage, ready to be carried out from any start in it.

    Parameters
    ----------
    rest : what of valid space is outside the goal; `lines` are its parts in contact space, and
        `features` the features that they are parts of.
    """

    setting: Setting
    preimage: Preimage
    world: World
    rest: Outside
    lines: NDArray[np.object_]
    features: NDArray[np.int32]
    tree: shapely.STRtree

    @classmethod
    def of(cls, setting: Setting, preimage: Preimage) -> Execution:
        """The execution of a preimage's motion."""
        world = World(setting.space, setting.friction, setting.sliding)
        rest = outside(setting.space, preimage.goal)
        parts, contact = rest.contact, setting.space.contact
        ends = [contact.at(parts.edge, end) for end in (parts.low, parts.high)]
        corners = shapely.points(contact.points[parts.vertices])
        lines = np.concatenate((shapely.linestrings(np.stack(ends, axis=1)), corners))
        features = np.concatenate((parts.edge, len(contact) + parts.vertices)).astype(np.int32)
        shapely.prepare(rest.area.geometry)
        return cls(setting, preimage, world, rest, lines, features, shapely.STRtree(lines))

    # --- the reading condition --------------------------------------------------------------

    def tells(self, readings: Sequence[Reading], rng: Random) -> list[bool]:
        """The reading condition: `K_v(q, f)` in the goal, as it misses all outside the goal.

        By distances taken here, ties on the safe side; now and then the package's own answer is
        held against it.
        """
        if not any(isinstance(c, ReadingCondition) for c in self.preimage.termination):
            return [False] * len(readings)
        rho, near = self.setting.uncertainty.position, self.setting.space.tolerance.length
        rho = max(rho, near)
        told = self._misses(readings, rho + 0.5 * near)
        sample = [rng.choice(readings)]
        package = self.package_tells(sample[0])
        if package and self._misses(sample, rho - near) == [False]:
            raise ViolationError(f"{sample[0]} does not tell by the definition")
        if not package and self._misses(sample, rho + near) == [True]:
            raise ViolationError(f"{sample[0]} tells by the definition")
        return told

    def _misses(self, readings: Sequence[Reading], rho: float) -> list[bool]:
        """Whether all that is consistent with each reading misses the rest."""
        sets = self.setting.command(self.preimage.direction).readings
        readable = {force: sets.can_read(force) for _, force in readings}
        places = shapely.points(np.array([place for place, _ in readings]))
        near = np.ones((len(places), len(self.lines)), dtype=np.bool_)
        near_free = np.full(len(places), not self.rest.area.is_empty)
        if math.isfinite(rho):
            near[:] = False
            place, line = self.tree.query(places, predicate="dwithin", distance=rho)
            near[place, line] = shapely.distance(places[place], self.lines[line]) < rho
        if math.isfinite(rho) and not self.rest.area.is_empty:
            area = self.rest.area.geometry
            near_free = shapely.intersects(area, places)
            outer = np.flatnonzero(~near_free)
            near_free[outer] = shapely.distance(places[outer], area) < rho
        told = []
        for count, (_, force) in enumerate(readings):
            alike = near[count] & readable[force][self.features]
            told.append(not np.any(alike) and not (near_free[count] and readable[force][-1]))
        return told

    def package_tells(self, reading: Reading) -> bool:
        """The same, as the package has it."""
        sets = self.setting.command(self.preimage.direction).readings
        told = interpretation(sets, reading[0], reading[1], self.setting.uncertainty)
        return contained(self.setting.space, sets, told, self.rest)

    def readings(self, state: State, angle: float, rng: Random) -> list[Reading]:
        """Worst readings: every kind of force, with offsets to and from the goal."""
        place = self.world.place(state)
        marks = []
        for other in (self.preimage.goal.area, self.preimage.target.region.area, self.rest.area):
            if other.is_empty:
                continue
            line = shapely.shortest_line(shapely.Point(place), other.geometry.boundary)
            (x, y), (tx, ty) = shapely.get_coordinates(line).tolist()
            if math.hypot(tx - x, ty - y) > 0.0:
                towards = math.atan2(ty - y, tx - x)
                marks += [towards, towards + math.pi]
        senses = self.setting.uncertainty
        return [
            (position, force)
            for force in forces(self.world, state, angle, senses, rng)
            for position in positions(place, senses.position, marks, rng)
        ]

    def judge(self, state: State, angle: float, rng: Random) -> Told:
        """What the reading condition makes of a state.

        Raises
        ------
        ViolationError : a reading makes the condition true outside the goal, or not in the kernel.
        """
        slack = SLACK * self.world.size
        in_goal = self.world.is_in(self.preimage.goal, state, slack)
        in_kernel = self.world.is_in(self.preimage.target.kernel, state)
        readings = self.readings(state, angle, rng)
        told = self.tells(readings, rng)
        for reading, tells in zip(readings, told, strict=True):
            if tells and not in_goal:
                raise ViolationError(f"recognised at {state}, not in the goal, by {reading}")
            if in_kernel and not tells:
                raise ViolationError(f"not recognised at {state}, in the kernel, by {reading}")
        if in_kernel:
            return Told.SURELY
        return Told.MAYBE if any(told) else Told.NOT

    # --- one motion -------------------------------------------------------------------------

    def run(self, start: State, control: str, rng: Random, hasty: float = 0.0) -> Track:
        """Carry the motion out until it surely ends in the goal.

        Parameters
        ----------
        hasty : how often nature lets it end where some reading, but not every one, does so.

        Raises
        ------
        ViolationError : it does not end, or not there.
        """
        setting, made, world = self.setting, self.preimage, self.world
        theta = setting.uncertainty.control
        motion = Motion(world, made.direction, theta, made.region)
        track = Track()
        track.add(0.0, world.place(start), start)
        state: State = start
        for count in range(LONGEST):
            angle, time = CONTROLS[control](motion, state, count, rng)
            if count > PATIENCE:  # a slow slide
                time = math.inf
            if self._ends(self.judge(state, angle, rng), hasty, rng):
                self.judge_times(track)
                return track
            if world.is_in(made.target.sticking, state):
                self.judge_sticking(track)
                return track
            move = pick(control, world.moves(state, angle, time), rng)
            ended = self._ends_on_the_way(move, angle, hasty, rng)
            if ended is not None:
                gone = math.dist(world.place(ended), move.start) / max(
                    math.dist(move.stop, move.start), world.near
                )
                track.add(track.times[-1] + gone * move.time, world.place(ended), ended)
                self.judge_times(track)
                return track
            self._judge_move(move, angle, track)
            assert not isinstance(move.end, Lost)
            state = move.end
            track.add(track.times[-1] + move.time, move.stop, state)
        raise ViolationError(f"an endless motion: {track.states[:3]} ... {track.states[-3:]}")

    def _judge_move(self, move: Move, angle: float, track: Track) -> None:
        """Neither escape nor rest, nor a way out of the preimage but into the target."""
        made, world = self.preimage, self.world
        if isinstance(move.end, Lost):
            raise ViolationError(f"escaped from {move.begin} along {angle}, track {track.states}")
        at_goal = world.is_in(made.target.region, move.end, world.near)
        if world.escaped(move.end) and not at_goal:
            raise ViolationError(f"escaped at {move.end} from {move.begin}, track {track.states}")
        if move.doing is Doing.STICKS:
            raise ViolationError(f"sticks at {move.begin} along {angle}, track {track.states}")
        if not at_goal and not world.is_in(made.region, move.end, SLACK * world.size):
            raise ViolationError(f"left the preimage at {move.end} from {move.begin} along {angle}")

    def _ends(self, told: Told, hasty: float, rng: Random) -> bool:
        return told is Told.SURELY or (told is Told.MAYBE and rng.random() < hasty)

    def _ends_on_the_way(self, move: Move, angle: float, hasty: float, rng: Random) -> State | None:
        """Where a move ends inside a feature, at the latest where it crosses the kernel."""
        crossings = on_the_way(move, self.preimage.target.kernel, self.world.near)
        if not crossings and math.isinf(move.time):
            return None
        for state in crossings or [between(move, share) for share in (0.3, 0.8)]:
            if self._ends(self.judge(state, angle, rng), hasty, rng):
                return state
        return None

    def judge_times(self, track: Track) -> None:
        """No sticking condition may be true while the robot moves, whatever is measured."""
        for condition in self.preimage.termination:
            if isinstance(condition, StickingCondition):
                rho = self.setting.uncertainty.position
                gap = track.nearest_return(condition.period)
                if gap - 2.0 * rho < condition.distance and not math.isinf(gap):
                    raise ViolationError(
                        f"still on its way, {gap} in {condition.period} of time may seem"
                        f" {condition.distance}: {track.states}"
                    )
            if isinstance(condition, ElapsedCondition) and track.times[-1] > condition.period:
                raise ViolationError(f"not yet there after {condition.period}: {track.states}")

    def judge_sticking(self, track: Track) -> None:
        """What has stuck is recognised after a while, and not before."""
        self.judge_times(track)
        rho = self.setting.uncertainty.position
        for condition in self.preimage.termination:
            if isinstance(condition, ElapsedCondition):
                break
            if isinstance(condition, StickingCondition) and 2.0 * rho <= condition.distance:
                break
        else:
            raise ViolationError(f"no condition tells that it sticks: {self.preimage.termination}")
        if not self.world.is_in(self.preimage.goal, track.states[-1]):
            raise ViolationError(f"sticks outside the goal: {track.states}")
        sure = self.setting.uncertainty.control * (1.0 - 1e-9)
        for share in (-1.0, 0.0, 1.0):
            angle = self.preimage.direction + share * sure
            for move in self.world.moves(track.states[-1], angle, 0.1):
                if move.doing is not Doing.STICKS:
                    raise ViolationError(f"moves on from {track.states[-1]} along {angle}")


def carry_out(strategy: Strategy, control: str, rng: Random) -> State:
    """A linear plan carried out whole, from a start that nature picks; where it ends.

    Raises
    ------
    ViolationError : a motion breaks its promise, or begins outside its preimage.
    """
    task, space = strategy.task, strategy.space
    setting = Setting.of(task, space)
    state = start_of(strategy, rng)
    for step in strategy.steps:
        region = strategy.region(step)
        assert region.motion is not None
        goal = strategy.region(region.motion.goals[0]).region
        made = preimage(setting, goal, region.motion.direction, task.options.method)
        execution = Execution.of(setting, made)
        if not execution.world.is_in(made.region, state, execution.world.near):
            raise ViolationError(f"motion {step} starts outside its preimage, at {state}")
        state = execution.run(state, control, rng, rng.choice((0.0, 0.3, 1.0))).states[-1]
    world = World(space, task.friction)
    if not world.is_in(strategy.region(0).region, state, SLACK * world.size):
        raise ViolationError(f"the plan ends at {state}, not in the goal")
    return state


def start_of(strategy: Strategy, rng: Random) -> State:
    """Where the robot is before a plan is carried out."""
    start = start_region(strategy.task, strategy.space)
    match start.kind:
        case StartKind.FREE_POINT:
            assert start.point is not None
            return Free(*start.point)
        case StartKind.EDGE_POINT:
            return OnEdge(start.edge, start.distance)
        case StartKind.VERTEX:
            return AtVertex(rng.choice(start.vertices))
        case StartKind.REGION:
            return starts(World(strategy.space, 0.0), start.region, rng, 1)[0]
