#!/usr/bin/env python3
"""A plan that carries itself out: the standard library is all it needs (Python 3.9 or later).

How it is used::

    from plan import Executor
    executor = Executor()
    answer = executor.start(time, x, y)
    while answer.command is not None:
        command(answer.command)                  # a direction in radians, at speed 1
        answer = executor.read(time, x, y, felt(fx, fy))

As a program it reads lines "time x y fx fy" and writes what to do; "--check" compares its answers
with those that were recorded when it was made. What the tables mean is said in docs/export.md of
preimage, which wrote this file.
"""

import math
import sys
from collections import deque

PLAN: dict = {}  # the tables: filled in when a plan is exported

MOVING, DONE, FAILED, BROKEN = "moving", "done", "failed", "broken"


class Answer:
    """What to do now.

    `doing` is one of MOVING, DONE (in the goal), FAILED (known to have failed) and BROKEN (what is
    read contradicts the model); `command` the direction in radians, None: stop; `region` the
    plan's region whose motion it is.
    """

    __slots__ = ("command", "doing", "region", "words")

    def __init__(self, doing, command, region, words=""):
        self.doing = doing
        self.command = command
        self.region = region
        self.words = words

    def __repr__(self):
        return f"Answer({self.doing!r}, {self.command!r}, {self.region!r}, {self.words!r})"


def felt(fx, fy, threshold=None):
    """The reading of a force: its angle, or None up to the threshold; NaN if it is not finite."""
    if not (_is_finite(fx) and _is_finite(fy)):
        return math.nan
    most = PLAN["threshold"] if threshold is None else threshold
    return None if math.hypot(fx, fy) <= most else math.atan2(fy, fx)


class Executor:
    """Carries the plan out, reading by reading; it stops where a reading contradicts the model."""

    def __init__(self, plan=None):
        plan = PLAN if plan is None else plan
        self._plan = plan
        self._motions = {motion["region"]: _Motion(motion, plan) for motion in plan["motions"]}
        self._ends = {region: FAILED if failure else DONE for region, failure in plan["ends"]}
        self._choices = _conditions(plan["choices"], plan)
        self._initial = _Condition(plan["initial"], plan) if plan["initial"] else None
        self._far = plan["slack"] + 2.0 * plan["position"]
        self._motion = None
        self._answer = None
        self._history: deque = deque()
        self._first = self._last = (0.0, math.nan, math.nan)
        self._began = self._gap = 0.0
        self._fresh = True

    def start(self, time, x, y):
        """Begin: the position is read once, which chooses the first region."""
        if self._motion is not None:
            return self._break("the plan was started twice")
        if self._answer is not None:
            return self._answer
        words = self._malformed(time, x, y, None)
        if words:
            return self._break(words)
        if not self._plan["senses_position"]:
            x = y = math.nan
        elif self._is_elsewhere(x, y):
            return self._break("further from every start than the position error")
        region = _told(self._choices, x, y, None)
        if region is None:
            return self._break("no region surely holds every start that may be there")
        self._first = (time, x, y)
        return self._enter(region, time, x, y)

    def read(self, time, x, y, force):
        """What to do after a reading; `force` is its angle, None where 0 is read (see `felt`)."""
        motion = self._motion
        if motion is None:
            return self._answer or self._break("a reading came before the start")
        words = self._malformed(time, x, y, force)
        if words:
            return self._break(words)
        if not self._plan["senses_position"]:
            x = y = math.nan
        if not self._plan["senses_force"]:
            force = None
        words = self._contradicted(motion, time, x, y, force)
        if words:
            return self._break(words)
        self._gap = max(self._gap, time - self._last[0])
        self._last, self._fresh = (time, x, y), False
        goal = _told(motion.by_reading, x, y, force)
        if goal is None and self._rests(motion, time, x, y):
            if motion.resting.misses(x, y, force):
                return self._break("stands still where nothing of the target sticks for sure")
            goal = _told(motion.by_rest, x, y, force)
            if goal is None:
                return self._break("stands still where no goal can be told")
        if goal is not None:
            return self._enter(goal, time, x, y)
        if time - self._began > motion.longest + 2.0 * self._gap + math.ulp(time):
            return self._break("still moving after the time that is enough")
        return self._answer

    def _contradicted(self, motion, time, x, y, force):
        if self._is_too_fast(time, x, y):
            return "faster than 1"
        if motion.possible.misses(x, y, force):
            return f"nothing of region {motion.region} gives this reading"
        if any(domain.misses(x, y, force) for domain in motion.domains):
            return "the robot is where this motion cannot have led"
        return ""

    def _enter(self, region, time, x, y):
        self._began, self._gap = time, 0.0
        self._last = (time, x, y)
        self._motion = self._motions.get(region)
        self._history.clear()
        if self._motion is None:
            self._answer = Answer(self._ends[region], None, region)
            return self._answer
        self._history.append(self._last)
        self._answer = Answer(MOVING, self._motion.direction, region)
        return self._answer

    def _break(self, words):
        region = -1 if self._motion is None else self._motion.region
        self._motion = None
        self._answer = Answer(BROKEN, None, region, words)
        return self._answer

    def _is_elsewhere(self, x, y):
        if self._initial is not None:
            return self._initial.misses(x, y, None)
        px, py = self._plan["point"]
        return math.hypot(x - px, y - py) > 0.5 * (self._far + self._plan["slack"])

    def _is_too_fast(self, time, x, y):
        if not self._plan["senses_position"]:
            return False
        return any(
            math.hypot(x - bx, y - by) > time - before + self._far + math.ulp(time)
            for before, bx, by in (self._last, self._first)
        )

    def _rests(self, motion, time, x, y):
        if motion.sticking is not None:
            period, distance = motion.sticking
            history = self._history
            if time - history[-1][0] >= period / 254:
                history.append((time, x, y))
            while len(history) > 1 and history[1][0] <= time - period:
                history.popleft()
            before, bx, by = history[0]
            if before <= time - period and math.hypot(x - bx, y - by) <= distance:
                return True
        return motion.elapsed is not None and time - self._began >= motion.elapsed

    def _malformed(self, time, x, y, force):
        if not _is_finite(time):
            return "the time is not a number"
        last = self._last[0]
        if self._motion is not None and (time < last or (time == last and not self._fresh)):
            return "the time is not after the last one"
        if self._plan["senses_position"] and not (_is_finite(x) and _is_finite(y)):
            return "the position is not two numbers"
        if self._plan["senses_force"] and force is not None and not _is_finite(force):
            return "the force is not an angle"
        return ""


class _Motion:
    def __init__(self, table, plan):
        self.region = table["region"]
        self.direction = table["direction"]
        self.by_reading = _conditions(table["by_reading"], plan)
        self.by_rest = _conditions(table["by_rest"], plan)
        self.possible = _Condition(table["possible"], plan)
        self.domains = [_Condition(domain, plan) for domain in table["domains"]]
        self.resting = _Condition(table["resting"], plan) if table["resting"] else None
        self.sticking = table["sticking"]
        self.elapsed = table["elapsed"]
        self.longest = math.inf if table["longest"] is None else table["longest"]


def _conditions(tables, plan):
    return [(goal, _Condition(table, plan) if table else None) for goal, table in tables]


def _told(conditions, x, y, force):
    for goal, condition in conditions:
        if condition is None or condition.misses(x, y, force):
            return goal
    return None


class _Condition:
    """Whether no configuration of a set gives a reading.

    `kinds` are (reads 0, center and half-width of the directions that are read), `segments` are
    (x0, y0, x1, y1, kind, whether it bounds the set's part of free space).
    """

    def __init__(self, table, plan):
        self._kinds = table["kinds"]
        self._segments = table["segments"]
        self._reach = plan["reach"]

    def misses(self, x, y, force):
        reads = [_reads(kind, force) for kind in self._kinds]
        if self._reach is None:
            return not any(reads[kind] for _, _, _, _, kind, _ in self._segments)
        inside = False
        for x0, y0, x1, y1, kind, bounds in self._segments:
            if not reads[kind]:
                continue
            if not _distance(x, y, x0, y0, x1, y1) >= self._reach:
                return False
            if bounds and (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
                inside = not inside
        return not inside


def _reads(kind, force):
    zero, center, half = kind
    if force is None:
        return zero
    return half >= 0.0 and abs(math.remainder(force - center, 2.0 * math.pi)) <= half


def _distance(x, y, x0, y0, x1, y1):
    dx, dy = x1 - x0, y1 - y0
    size = dx * dx + dy * dy
    share = ((x - x0) * dx + (y - y0) * dy) / size if size > 0.0 else 0.0
    share = min(1.0, max(0.0, share))
    return math.hypot(x0 + share * dx - x, y0 + share * dy - y)


def _is_finite(value):
    try:
        return math.isfinite(value)
    except (TypeError, ValueError, OverflowError):
        return False


def check():
    """Whether the recorded runs still give the recorded answers; the number of readings."""
    count = 0
    for run in PLAN["examples"]:
        executor = Executor()
        for place, (time, x, y, force, doing, region) in enumerate(run):
            x, y = (math.nan if value is None else value for value in (x, y))
            answer = executor.read(time, x, y, force) if place else executor.start(time, x, y)
            if (answer.doing, answer.region) != (doing, region):
                raise SystemExit(f"reading {place}: {answer!r}, not {doing} in region {region}")
            count += 1
    return count


def main():
    """Read lines "time x y fx fy", write what to do."""
    if sys.argv[1:] == ["--check"]:
        print(f"{check()} readings answered as recorded")
        return 0
    executor, begun = Executor(), False
    for line in sys.stdin:
        try:
            time, x, y, fx, fy = (float(word) for word in line.split())
        except ValueError:
            time = x = y = fx = fy = math.nan
        answer = executor.read(time, x, y, felt(fx, fy)) if begun else executor.start(time, x, y)
        begun = True
        if answer.command is None:
            print(f"stop {answer.doing} {answer.words}".rstrip(), flush=True)
            return 0 if answer.doing == DONE else 1
        print(f"go {math.degrees(answer.command):.12g}", flush=True)
    return 1


if __name__ == "__main__":
    sys.exit(main())
