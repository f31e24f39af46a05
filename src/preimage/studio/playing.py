"""A game: the person is nature, and tries to beat a plan (theory 8).

The page sends all moves that were made, so that nothing is kept for it but what saves time.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.start import Start
from preimage.errors import InputError, shown
from preimage.execution.chunk import SLACK, Scene
from preimage.execution.executor import Answer, Doing, Executor
from preimage.execution.sensing import Sensing, read
from preimage.execution.simulator import Choices, Manner, Wish, advance
from preimage.execution.situation import LOTS, Conditions, Situation
from preimage.execution.starts import is_in, of_start
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.inflate import grow
from preimage.recognition.interpretation import interpretation
from preimage.strategy.strategy import Strategy
from preimage.studio.plain import degrees_of, features_of, points_of, region_of
from preimage.studio.questions import Body, Tell
from preimage.studio.requests import drawable, needed, number, point, strategy_of
from preimage.studio.standing import begun_at
from preimage.task.uncertainty import Uncertainty

Plain = dict[str, Any]

MOST_MOVES = 20_000
"""A game of so many moves is over."""

MOST_MEETINGS = 200
"""A move in which more is met than this is cut short."""

MOST_CHEATING = 100.0
"""By so much at most nature may have larger errors than the plan was told."""


@dataclass(frozen=True, slots=True)
class Hand:
    """What nature does for a while.

    Parameters
    ----------
    time : for how long, in units of length.
    push : from -1 to 1: where in the control cone the actual direction is.
    offset : where the measured position is off, in the unit disc.
    tilt : from -1 to 1: where in the force's error its measured direction is.
    """

    time: float
    push: float = 0.0
    offset: tuple[float, float] = (0.0, 0.0)
    tilt: float = 0.0


class Game:
    """One robot, a plan that drives it, and nature's hand."""

    def __init__(self, strategy: Strategy, start: Start, cheat: dict[str, float]) -> None:
        self._strategy = strategy
        self._scene = Scene.of(strategy)
        self._executor = Executor(self._scene.program)
        self._rng = np.random.default_rng(0)
        self._errors = _cheating(strategy.task.uncertainty, cheat)
        self._robots = of_start(strategy.space, start, 1, self._rng)
        self._time = 0.0
        self._answer: Answer | None = None
        self._seen: tuple[float, float, float | None] = (math.nan, math.nan, None)
        self._actual: float | None = None
        self._last_motion = -1
        self._looked = -1.0
        self._escaped = False
        self._way: list[list[float]] = []
        self.moves: list[list[float]] = []

    def play(self, hands: list[Hand]) -> list[list[float]]:
        """Let nature do all that; the places on the way."""
        self._way = points_of(self._robots.places)
        if self._answer is None:
            self._look(hands[0] if hands else Hand(0.0))
        for hand in hands:
            self._move(hand)
        return self._way

    @property
    def over(self) -> bool:
        """Whether nothing moves any more."""
        return self._escaped or (self._answer is not None and self._answer.command is None)

    def _move(self, hand: Hand) -> None:
        left = hand.time
        for _ in range(MOST_MEETINGS):
            if self.over or left <= 0.0:
                return
            now = self._situation()
            actual = now.motion.direction + now.cone * hand.push
            choices = Choices(
                np.array([actual]),
                np.array([left]),
                np.array([Wish.ANY], dtype=np.uint8),
                self._rng.random(1),
            )
            moves = advance(now.motion.simulator, now.robots, choices)
            self._robots, self._actual = moves.robots, actual
            spent = float(moves.time[0])
            self._time += spent
            left -= spent
            self._way += points_of(self._robots.places)
            self._escaped = bool(moves.manner[0] == Manner.ESCAPES) or self._is_outside()
            if not self._escaped and self._time > self._looked:
                self._look(hand)
            if spent == 0.0 and moves.manner[0] == Manner.RESTS:
                return

    def _is_outside(self) -> bool:
        """At a vertex beside an open side, and not in what is aimed at: it has escaped."""
        contact = self._strategy.space.contact
        vertex = int(self._robots.feature[0]) - len(contact)
        if not 0 <= vertex < len(contact):
            return False
        beside = contact.open[vertex] or contact.open[contact.previous[vertex]]
        target = self._conditions().target
        return bool(beside) and not target.contact.has_vertex(vertex)

    def _conditions(self) -> Conditions:
        assert self._answer is not None
        region = self._answer.region if self._answer.command is not None else self._last_motion
        return replace(self._scene.conditions[region], uncertainty=self._errors)

    def _situation(self) -> Situation:
        nothing = np.zeros(1)
        lots = np.zeros((1, LOTS))
        met = np.zeros(1, dtype=np.int32)
        return Situation(self._conditions(), self._robots, nothing, lots, met, self._rng)

    def _look(self, hand: Hand) -> None:
        """The sensors are looked at, as nature has them read, and the executor answers."""
        sensing = Sensing(lambda _: np.array([hand.offset]), lambda _: np.array([hand.tilt]))
        if self._answer is None:
            self._begin(hand)
            return
        now = self._situation()
        actual = now.motion.direction + now.cone * hand.push
        positions, forces = read(sensing, now, np.array([actual]))
        x, y = positions[0].tolist()
        force = None if math.isnan(forces[0]) else float(forces[0])
        self._seen = (x, y, force)
        self._last_motion = self._answer.region
        self._looked = self._time
        self._answer = self._executor.read(self._time, x, y, force)

    def _begin(self, hand: Hand) -> None:
        """The first look tells the position alone."""
        x, y = self._robots.places[0].tolist()
        if self._errors.has_position_sensor:
            reach = self._errors.position * (1.0 - 1e-9)
            x, y = x + reach * hand.offset[0], y + reach * hand.offset[1]
        else:
            x = y = math.nan
        self._seen = (x, y, None)
        self._answer = self._executor.start(self._time, x, y)
        if self._answer.command is not None:
            self._last_motion = self._answer.region

    # --- what a page shows ----------------------------------------------------------------------

    def shown(self) -> Plain:
        """The truth, what is read, what the robot makes of it."""
        answer = self._answer
        assert answer is not None
        contact = self._strategy.space.contact
        x, y, force = self._seen
        known = math.isfinite(x)
        return {
            "time": self._time,
            "place": points_of(self._robots.places)[0],
            "feature": features_of(self._robots.feature, len(contact))[0],
            "measured": [x, y] if known else None,
            "force": degrees_of(force),
            "actual": degrees_of(self._actual),
            "direction": degrees_of(answer.command),
            "region": answer.region,
            "doing": answer.doing.name.lower(),
            "words": answer.words,
            "believed": region_of(self._believed(), contact),
            "truly_in_goal": self._is_in_goal(),
            "over": self.over,
            "verdict": self._verdict(),
        }

    def _is_in_goal(self) -> bool:
        space = self._strategy.space
        slack = SLACK * space.tolerance.length
        goal = self._strategy.region(0).region
        return bool(is_in(space, goal, self._robots, slack)[0])

    def _verdict(self) -> str:
        if not self.over:
            return ""
        if self._escaped:
            return "the robot has left through an open side of the window: nature has won"
        assert self._answer is not None
        match self._answer.doing:
            case Doing.DONE if self._is_in_goal():
                return "the robot is in the goal, and knows it: the plan has won"
            case Doing.DONE:
                return "the robot believes that it is in the goal, and is not: nature has won"
            case Doing.FAILED:
                return "the robot knows that it has failed, as the plan allows"
            case _:
                return f"the robot has stopped: {self._answer.words}"

    def _believed(self) -> Region:
        """The places that fit what was read last."""
        space, (x, y, force) = self._strategy.space, self._seen
        if self._last_motion < 0 or not math.isfinite(x):
            return Region.empty()
        motion = self._scene.program.motions[self._last_motion]
        told = interpretation(motion.readings, (x, y), force, self._strategy.task.uncertainty)
        around = Area.empty()
        if told.free and 0.0 < told.radius < math.inf:
            reach = told.radius
            square = Area.box(x - reach, y - reach, x + reach, y + reach)
            around = areas.intersection(areas.intersection(_disc(x, y, reach), square), space.free)
        return Region(around, told.contact(space.contact))


def _disc(x: float, y: float, radius: float) -> Area:
    """A disc as it is drawn: a polygon around it."""
    speck = 1e-6 * radius
    return grow(Area.box(x - speck, y - speck, x + speck, y + speck), radius)


def _cheating(errors: Uncertainty, cheat: dict[str, float]) -> Uncertainty:
    """Errors larger than those that the plan was told."""
    control = min(errors.control * cheat["control"], 0.49 * math.pi)
    return replace(
        errors,
        control=control,
        position=errors.position * cheat["position"],
        force_angle=min(errors.force_angle * cheat["force"], 0.99 * math.pi),
    )


_kept: list[tuple[str, Game]] = []
"""The last game, which the next request goes on with."""


def play(body: Body, tell: Tell) -> Body:
    """A game up to now: where the robot is, what it reads, what it does."""
    moves = _moves(body)
    place = point(needed(body, "start"), "start")
    cheat = _factors(body)
    key = json.dumps([body.get("plan"), place, cheat], sort_keys=True, default=str)
    game = _going_on(key, moves)
    if game is None:
        strategy, start = begun_at(strategy_of(body, solved=True), place)
        drawable(strategy.space)
        game = Game(strategy, start, cheat)
    new = moves[len(game.moves) :]
    way = game.play([_hand(move) for move in new])
    game.moves = moves
    _kept[:] = [(key, game)]
    return {"places": way, **game.shown()}


def _going_on(key: str, moves: list[list[float]]) -> Game | None:
    """The last game, if these moves go on from it."""
    for known, game in _kept:
        if known == key and moves[: len(game.moves)] == game.moves:
            return game
    return None


def _hand(move: list[float]) -> Hand:
    time, push, x, y, tilt = move
    size = max(1.0, math.hypot(x, y))
    return Hand(time, push, (x / size, y / size), tilt)


def _moves(body: Body) -> list[list[float]]:
    """The moves, each `[time, push, x, y, tilt]`, brought within what nature may do."""
    given = body.get("moves", [])
    if not isinstance(given, list) or len(given) > MOST_MOVES:
        raise InputError("moves", f"must be a list of at most {MOST_MOVES}, not {shown(given)}")
    return [_move(move, f"moves[{place}]") for place, move in enumerate(given)]


def _move(value: object, key: str) -> list[float]:
    if not isinstance(value, list) or len(value) != 5:
        raise InputError(key, f"must be five numbers, not {shown(value)}")
    time, *rest = (number(part, f"{key}[{place}]") for place, part in enumerate(value))
    return [min(max(time, 0.0), 1e6), *(min(max(part, -1.0), 1.0) for part in rest)]


def _factors(body: Body) -> dict[str, float]:
    """By how much nature's errors are larger than the plan was told."""
    given = body.get("cheat") or {}
    if not isinstance(given, dict):
        raise InputError("cheat", f"must be a mapping, not {shown(given)}")
    return {
        name: number(given.get(name, 1.0), f"cheat.{name}", 0.0, MOST_CHEATING)
        for name in ("control", "position", "force")
    }
