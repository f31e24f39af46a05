"""The executor: what goes on a robot. A plan and a stream of readings in, commands out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from preimage.execution.assumptions import Assumption, Blame, blame
from preimage.execution.history import History
from preimage.execution.program import CompiledMotion, Program, Recognition, compiled
from preimage.strategy.strategy import Strategy


class Doing(Enum):
    """What the executor is at."""

    MOVING = "moving"
    DONE = "in the goal"
    FAILED = "known to have failed"
    BROKEN = "the readings contradict the model"


@dataclass(frozen=True, slots=True)
class Answer:
    """What to do now.

    Parameters
    ----------
    command : the direction to command, radians; None: stop.
    region : id of the region whose motion it is; 0 in the goal, that of the region of failure if
        the goal is known to be out of reach, -1 before there is any.
    broken : what the readings contradict, if they do.
    words : the same in words, for people.
    """

    doing: Doing
    command: float | None
    region: int
    broken: Assumption | None
    words: str


def felt(fx: float, fy: float, threshold: float) -> float | None:
    """The reading of a force: its angle, radians, or None for 0, up to the threshold.

    NaN, which every executor refuses, for a force that is not finite.

    Parameters
    ----------
    fx, fy : the measured force, in units of the force that drives the robot in free space.
    threshold : with two thresholds any number between them, both included.

    >>> felt(0.0, 0.02, 0.05) is None
    True
    >>> felt(0.0, 1.0, 0.05) == math.pi / 2
    True
    """
    if not (_is_finite(fx) and _is_finite(fy)):
        return math.nan
    return None if math.hypot(fx, fy) <= threshold else math.atan2(fy, fx)


class Executor:
    """Carries a solved plan out: reading by reading it says what to command, and when to stop.

    It ends in the goal and knows it, or says which assumption of the model a reading contradicts,
    and stops; after that every call has the same answer. A plan with regions of failure may also
    end in one of them, and knows that too. A stream from a world as the task describes it, read
    often enough, is never found broken.

    The conditions of a plan are looked at continuously; this one looks when a reading comes. A
    motion that is ended by its sticking condition loses nothing but time. One that is ended by a
    reading must be looked at while it is in its target: at least once while the robot goes as far
    as the target is deep. Between two looks it may run through a thin target, and is then soon
    found outside its region, or late: it is stopped, not believed.

    Nothing is allocated per reading to speak of, and the time for one grows as the logarithm of
    the number of edges.

    Parameters
    ----------
    program : a plan made ready; a strategy is made ready first.

    Raises
    ------
    PlanFileError : if the plan is not solved.

    >>> from preimage.search.planner import plan
    >>> from preimage.task.examples import named_task
    >>> executor = Executor(plan(named_task("flat-floor")))
    >>> executor.start(0.0, 0.0, 5.0).words
    'region 1: command 270°'
    """

    __slots__ = (
        "_answer",
        "_began",
        "_ends",
        "_far",
        "_first",
        "_fresh",
        "_gap",
        "_history",
        "_last",
        "_motion",
        "_moving",
        "_position",
        "_program",
        "_pushed",
        "_slack",
    )

    def __init__(self, program: Program | Strategy) -> None:
        self._program = compiled(program) if isinstance(program, Strategy) else program
        strategy = self._program.strategy
        senses = strategy.task.uncertainty
        self._slack = strategy.space.tolerance.length
        self._far = self._slack + 2.0 * senses.position
        self._position, self._pushed = senses.has_position_sensor, senses.has_force_sensor
        self._moving = {
            number: Answer(
                Doing.MOVING,
                motion.direction,
                number,
                None,
                f"region {number}: command {math.degrees(motion.direction):.6g}°",
            )
            for number, motion in self._program.motions.items()
        }
        self._ends = {
            region.id: Answer(Doing.FAILED, None, region.id, None, "known to have failed")
            if region.failure
            else Answer(Doing.DONE, None, region.id, None, "in the goal")
            for region in strategy.regions
            if region.motion is None
        }
        self._answer: Answer | None = None
        self._motion: CompiledMotion | None = None
        self._history = History()
        self._first = self._last = (0.0, math.nan, math.nan)
        self._began = self._gap = 0.0
        self._fresh = True

    @property
    def program(self) -> Program:
        """The plan, made ready."""
        return self._program

    def start(self, time: float, x: float, y: float) -> Answer:
        """Begin: the position is read once, which chooses the first region (theory 7).

        Parameters
        ----------
        time : of the reading, on a clock of the caller's, in units of length.
        x, y : as measured; NaN, NaN without a position sensor.
        """
        if self._motion is not None:
            return self._break(Assumption.READING, "the plan was started twice")
        if self._answer is not None:
            return self._answer
        words = self._malformed(time, x, y, None)
        if words:
            return self._break(Assumption.READING, words)
        beginning = self._program.beginning
        if not self._position:
            x = y = math.nan
        elif self._is_elsewhere(x, y):
            words = f"({x:.6g}, {y:.6g}) is further from every start than the position error"
            return self._break(Assumption.START, words)
        region = _told(beginning.choices, x, y, None)
        if region < 0:
            words = f"no region surely holds every start that may be at ({x:.6g}, {y:.6g})"
            return self._break(Assumption.START, words)
        self._first = (time, x, y)
        return self._enter(region, time, x, y)

    def read(self, time: float, x: float, y: float, force: float | None) -> Answer:
        """What to do after a reading.

        Parameters
        ----------
        time : later than all before; the first reading may come at the time of the start.
        x, y : the position as measured; ignored without a position sensor.
        force : the angle of the measured force, radians, or None where 0 is read, see `felt`;
            ignored without a force sensor.
        """
        motion = self._motion
        if motion is None:
            if self._answer is not None:
                return self._answer
            return self._break(Assumption.READING, "a reading came before the start")
        words = self._malformed(time, x, y, force)
        if words:
            return self._break(Assumption.READING, words)
        if not self._position:
            x = y = math.nan
        if not self._pushed:
            force = None
        broken = self._contradicted(motion, time, x, y, force)
        if broken is not None:
            return self._break(*broken)
        self._gap = max(self._gap, time - self._last[0])
        self._last, self._fresh = (time, x, y), False
        goal = _told(motion.by_reading, x, y, force)
        if goal < 0 and self._rests(motion, time, x, y):
            assert motion.resting is not None
            if motion.resting.misses(x, y, force):
                words = "stands still where nothing of the target sticks for sure"
                return self._break(Assumption.FRICTION, words)
            goal = _told(motion.by_rest, x, y, force)
            if goal < 0:
                return self._break(Assumption.FRICTION, "stands still where no goal can be told")
        if goal >= 0:
            return self._enter(goal, time, x, y)
        spent = time - self._began
        if spent > motion.longest + 2.0 * self._gap + math.ulp(time):
            words = f"still moving after {spent:.6g}, though {motion.longest:.6g} is enough"
            return self._break(Assumption.TIME, words)
        return self._moving[motion.region.id]

    def _contradicted(
        self, motion: CompiledMotion, time: float, x: float, y: float, force: float | None
    ) -> Blame | None:
        """What a reading contradicts wherever in its region the robot is."""
        if self._is_too_fast(time, x, y):
            return Assumption.SPEED, f"faster than 1 on the way to ({x:.6g}, {y:.6g})"
        if motion.possible.misses(x, y, force):
            return blame(self._program.strategy, motion, x, y, force)
        for domain in motion.domains:  # what misses it is contained in every goal
            if domain.misses(x, y, force):
                return Assumption.CONTROL, "the robot is where this motion cannot have led"
        return None

    def _is_elsewhere(self, x: float, y: float) -> bool:
        """Whether the robot cannot be at the start."""
        beginning = self._program.beginning
        if beginning.initial is not None:
            return beginning.initial.misses(x, y, None)
        assert beginning.point is not None
        off = math.hypot(x - beginning.point[0], y - beginning.point[1])
        return off > 0.5 * (self._far + self._slack)

    def _is_too_fast(self, time: float, x: float, y: float) -> bool:
        """Whether the robot is further from where it was than its speed allows."""
        if not self._position:
            return False
        for before, from_x, from_y in (self._last, self._first):
            gone = math.hypot(x - from_x, y - from_y)
            if gone > time - before + self._far + math.ulp(time):
                return True
        return False

    def _rests(self, motion: CompiledMotion, time: float, x: float, y: float) -> bool:
        """Whether the sticking condition holds, or the clock says that it is over."""
        if motion.sticking is not None:
            self._history.add(time, x, y)
            before = self._history.before(time - motion.sticking.period)
            if before is not None:
                gone = math.hypot(x - before[0], y - before[1])
                if gone <= motion.sticking.distance:
                    return True
        return motion.elapsed is not None and time - self._began >= motion.elapsed.period

    def _malformed(self, time: float, x: float, y: float, force: float | None) -> str:
        """What is wrong with a reading as such, in words; nothing if it can be read."""
        if not _is_finite(time):
            return "the time is not a number"
        last = self._last[0]
        if self._motion is not None and (time < last or (time == last and not self._fresh)):
            return f"the time {time:.9g} is not after {last:.9g}"
        if self._position and not (_is_finite(x) and _is_finite(y)):
            return "the position is not two numbers"
        if self._pushed and force is not None and not _is_finite(force):
            return "the force is not an angle"
        return ""

    def _enter(self, region: int, time: float, x: float, y: float) -> Answer:
        """Go on from a region in which the robot surely is: clocks and history start anew."""
        self._began, self._gap = time, 0.0
        self._last = (time, x, y)
        self._motion = self._program.motions.get(region)
        if self._motion is None:
            self._answer = self._ends[region]
            return self._answer
        if self._motion.sticking is not None:
            self._history.begin(self._motion.sticking.period)
            self._history.add(time, x, y)
        self._answer = self._moving[region]
        return self._answer

    def _break(self, assumption: Assumption, words: str) -> Answer:
        region = self._motion.region.id if self._motion is not None else -1
        self._motion = None
        self._answer = Answer(Doing.BROKEN, None, region, assumption, words)
        return self._answer


def _told(recognitions: tuple[Recognition, ...], x: float, y: float, force: float | None) -> int:
    """The first goal that a reading certainly tells; -1 if there is none."""
    for recognition in recognitions:
        if recognition.cells is None or recognition.cells.misses(x, y, force):
            return recognition.goal
    return -1


def _is_finite(value: float) -> bool:
    """Whether a reading is a number at all; whatever comes from outside."""
    try:
        return math.isfinite(value)
    except (TypeError, ValueError, OverflowError):
        return False
