"""Counter-examples: a way as a trace that a person can look at, and whether nature may take it."""

from __future__ import annotations

import math

import numpy as np

from preimage.configuration.space import ConfigurationSpace
from preimage.execution.trace import Leg, Outcome, Trace
from preimage.strategy.strategy import Strategy
from preimage.task.task import SlidingLaw, Task
from preimage.verification.distances import Point, apart
from preimage.verification.features import Features
from preimage.verification.forward import ForwardProjection
from preimage.verification.paths import Stop

SLOWEST = 1.0 / 64.0
"""The slowest slide is approached, not attained: so far from it, as a part of what is possible."""

INSIDE = 1e-6
"""The ends of a line that touch something are so much of it."""

SHORT = 64.0
"""Legs of no more tolerances have no direction worth looking at."""


def sliding_angles(slope: float, onward: bool, control: float, friction: float) -> Point:
    """The least and the largest |a| with which a slide to one end of an edge may be driven.

    Parameters
    ----------
    slope : angle(nu, -v) of the edge.
    onward : to its end, else to its start.

    >>> sliding_angles(0.5, True, 0.25, 0.125)
    (0.25, 0.75)
    """
    tilt = slope if onward else -slope
    low = max(friction, tilt - control, 0.0)
    return low, max(low, min(0.5 * math.pi, tilt + control))


def sliding_speed(angle: float, friction: float, law: SlidingLaw) -> float:
    """How fast a slide is (theory 2)."""
    if law is SlidingLaw.PROJECTION:
        return math.sin(angle)
    if friction >= 0.5 * math.pi:
        return 1.0
    return math.sin(max(angle - friction, 0.0)) / math.cos(friction)


def trace_of(
    strategy: Strategy,
    region: int,
    projection: ForwardProjection,
    stops: tuple[Stop, ...],
    outcome: Outcome,
    words: str,
) -> Trace:
    """A way as a run of one motion of a plan, with readings free of error.

    Parameters
    ----------
    region : id of the region in which the motion is commanded.
    """
    task, motion = strategy.task, strategy.region(region).motion
    assert motion is not None
    stops = _straightened(stops, projection)
    places = np.array([place_of(projection, stop) for stop in stops])
    times, actual = [0.0], []
    for index, stop in enumerate(stops[1:]):
        length = math.dist(places[index], places[index + 1])
        direction = math.atan2(*(places[index + 1] - places[index])[::-1])
        speed = 1.0
        if stop.along >= 0:
            direction, speed = _slide(strategy, projection.features, stop.along, direction)
        actual.append(direction)
        times.append(times[-1] + length / speed)
    actual.append(actual[-1] if actual else motion.direction)
    known = task.uncertainty.has_position_sensor
    leg = Leg(
        region=region,
        direction=motion.direction,
        times=np.array(times),
        places=places,
        features=np.array([stop.feature for stop in stops], dtype=np.int32),
        actual=np.array(actual),
        measured=places if known else np.full_like(places, np.nan),
        forces=np.full(len(stops), np.nan),
    )
    return Trace(strategy, (leg,), outcome, words=words)


def place_of(projection: ForwardProjection, stop: Stop) -> Point:
    """Where a stop is: on its feature, which slabs move by less than the tolerance."""
    contact, count = projection.space.contact, len(projection.space.contact)
    x, y = projection.restored(stop.place)
    if stop.feature >= 2 * count:
        return x, y
    if stop.feature >= count:
        x, y = contact.points[stop.feature - count].tolist()
    else:
        start, tangent = contact.points[stop.feature], contact.tangent[stop.feature]
        along = (x - start[0]) * tangent[0] + (y - start[1]) * tangent[1]
        x, y = (start + max(along, 0.0) * tangent).tolist()
    return x, y


def _straightened(stops: tuple[Stop, ...], projection: ForwardProjection) -> tuple[Stop, ...]:
    """The same way with fewer bends in free space, where nothing is in between."""
    free = 2 * len(projection.space.contact)
    kept = [0]
    while kept[-1] < len(stops) - 1:
        first = last = kept[-1]
        while last < len(stops) - 1 and stops[last + 1].along < 0:
            last += 1
            if stops[last].feature != free:
                break
        last = max(last, first + 1)
        while last > first + 1 and not _is_clear(stops[first].place, stops[last].place, projection):
            last = first + (last - first) // 2
        kept.append(last)
    return tuple(stops[index] for index in kept)


def _is_clear(begin: Point, end: Point, projection: ForwardProjection) -> bool:
    """Whether a straight line, but for its very ends, meets neither contact nor the stop set."""
    frame, contact = projection.slabs.frame, projection.space.contact
    line = np.array([begin, end])
    inner = line + INSIDE * (line[::-1] - line)
    for starts, ends in ((contact.points, contact.ends), projection.stop.area.segments):
        if len(starts):
            turned = frame.turned(starts), frame.turned(ends)
            if np.min(apart((inner[:1], inner[1:]), turned)) == 0.0:
                return False
    return True


def _slide(
    strategy: Strategy, features: Features, edge: int, towards: float
) -> tuple[float, float]:
    """What drives a slide, as slowly as may be, and its speed."""
    task: Task = strategy.task
    tangent = strategy.space.contact.tangent[edge]
    onward = math.cos(towards) * tangent[0] + math.sin(towards) * tangent[1] > 0.0
    low, high = sliding_angles(
        float(features.slope[edge]), onward, task.uncertainty.control, task.friction
    )
    angle = low + SLOWEST * (high - low)
    normal = math.atan2(tangent[0], -tangent[1])
    actual = normal + (angle if onward else -angle) + math.pi
    speed = sliding_speed(angle, task.friction, task.sliding)
    return math.atan2(math.sin(actual), math.cos(actual)), speed if speed > 0.0 else SLOWEST


def admissible(trace: Trace, slack: float) -> bool:
    """Whether nature may drive a trace's motions so (theory 2), from the record alone.

    Every actual direction lies in the control cone; who is in free space, or leaves for it, moves
    along it; who is on an edge moves along the edge, and is pushed against it by more than the
    friction holds.

    Parameters
    ----------
    slack : for angles, in radians: what rounding may do.
    """
    task, contact = trace.strategy.task, trace.strategy.space.contact
    count = len(contact)
    for leg in trace.legs:
        for index, actual in enumerate(leg.actual[:-1].tolist()):
            step = leg.places[index + 1] - leg.places[index]
            if math.hypot(*step) <= SHORT * trace.strategy.space.tolerance.length:
                continue
            if abs(_turn(leg.direction, actual)) > task.uncertainty.control + slack:
                return False
            heading = math.atan2(step[1], step[0])
            if abs(_turn(heading, actual)) <= slack:
                continue
            edges = _edges(leg.features[index : index + 2].tolist(), count, contact.next.tolist())
            if not any(
                _slides(contact.tangent[edge], heading, actual, task, slack) for edge in edges
            ):
                return False
    return True


def _edges(features: list[int], count: int, following: list[int]) -> list[int]:
    """The edges on which one may slide between two features."""
    sides = []
    for feature in features:
        if feature < count:
            sides.append({feature})
        elif feature < 2 * count:
            sides.append({feature - count, following.index(feature - count)})
        else:
            sides.append(set())
    return sorted(sides[0] & sides[1])


def _slides(
    tangent: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
    heading: float,
    actual: float,
    task: Task,
    slack: float,
) -> bool:
    along = math.atan2(tangent[1], tangent[0])
    off = _turn(along + 0.5 * math.pi, actual + math.pi)
    onward = along if off > 0.0 else along + math.pi
    return (
        abs(_turn(onward, heading)) <= slack
        and task.friction - slack <= abs(off) <= 0.5 * math.pi + slack
    )


def _turn(first: float, second: float) -> float:
    """The angle from one direction to another, in [-pi, pi)."""
    return (second - first + math.pi) % math.tau - math.pi


def feature_words(feature: int, space: ConfigurationSpace) -> str:
    """A feature by its number."""
    size = len(space.contact)
    if feature < size:
        return f"open side {feature}" if space.contact.open[feature] else f"edge {feature}"
    return f"vertex {feature - size}" if feature < 2 * size else "free space"
