"""The way to a place that is reached: back along what touched it, to the start."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from preimage.verification.flights import Flight, FromAbove, FromEdge, FromVertex, Point
from preimage.verification.slabs import Span
from preimage.verification.spreading import Spreading, Touch


@dataclass(frozen=True, slots=True)
class Stop:
    """A place on a way: straight lines lead from each to the next.

    Parameters
    ----------
    place : in the turned plane.
    feature : edge i is i, vertex i is n + i, free space is 2 n.
    along : the edge on which one slides here; -1 for who flies, and at the start.
    """

    place: Point
    feature: int
    along: int = -1


class NoWayError(Exception):
    """What is reached cannot be traced back."""


class Ways:
    """Finds ways within what is reached, once that is all."""

    def __init__(self, spreading: Spreading) -> None:
        self.spreading, self.spread = spreading, spreading.spread
        self.levels, self.reached = spreading.levels, spreading.reached
        self.count = len(self.levels.next)

    def to_edge(self, edge: int, distance: float) -> tuple[Stop, ...]:
        """A way from the start to a reached place of an edge."""
        stop = self._on_edge(edge, distance)
        return self._found(stop, lambda: self._back(stop, self.spreading.time + 1))

    def to_vertex(self, vertex: int) -> tuple[Stop, ...]:
        """A way from the start to a reached vertex."""
        stop = self._at(vertex)
        return self._found(stop, lambda: self._back(stop, self.spreading.time + 1))

    def to_side(self, edge: int) -> tuple[Stop, ...]:
        """A way from the start to an open side that is reached."""
        touch = self.reached.escapes[edge]
        stop = self._on_edge(edge, 0.5 * (touch.low + touch.high))
        return self._found(stop, lambda: self._leading(stop, touch))

    def to_free(self, flight: Flight, place: Point) -> tuple[Stop, ...]:
        """A way from the start to a place where something flies."""
        stop = Stop(place, 2 * self.count)
        return self._found(stop, lambda: (*self._flown(flight, place), stop))

    def _found(self, stop: Stop, find: Callable[[], tuple[Stop, ...]]) -> tuple[Stop, ...]:
        """The way that is found; the place alone if it is lost in ties, or has too many bends."""
        try:
            return _joined(find(), self.levels.tolerance, self.count)
        except (NoWayError, RecursionError):
            return (stop,)

    def _leading(self, stop: Stop, touch: Touch) -> tuple[Stop, ...]:
        """The way to a place that is touched so."""
        match touch.origin:
            case None:
                return (stop,)
            case Flight() as flight:
                return (*self._flown(flight, stop.place), stop)
            case FromVertex(vertex):
                return (*self._back(self._at(vertex), touch.time), stop)
            case FromEdge(edge, time):
                end = self.levels.length[edge]
                distance = end if self.levels.next[edge] == stop.feature - self.count else 0.0
                return (*self._back(self._on_edge(edge, distance), time), stop)

    def _back(self, stop: Stop, time: int) -> tuple[Stop, ...]:
        """The way to a place of contact space by what touched it before a time."""
        if stop.feature >= self.count:
            return self._leading(stop, self.reached.vertices[stop.feature - self.count])
        edge = stop.feature
        touch, near = self._touch(edge, self._distance(edge, stop.place), time)
        return (*self._leading(self._on_edge(edge, near), touch), replace(stop, along=edge))

    def _touch(self, edge: int, distance: float, time: int) -> tuple[Touch, float]:
        """What touched an edge so that one gets to a distance from there, and where."""
        slack, found = self.levels.tolerance, []
        gaps = self.spreading.gaps[edge]
        if not gaps:
            raise NoWayError
        gap = min(gaps, key=lambda one: max(one[0] - distance, distance - one[1]))
        for touch in self.reached.touches[edge]:
            near = min(max(distance, touch.low), touch.high)
            leads = (
                abs(near - distance) <= slack
                or (near < distance and self.spreading.forward[edge])
                or (near > distance and self.spreading.backward[edge])
            )
            if touch.time < time and leads and gap[0] - slack <= near <= gap[1] + slack:
                found.append((abs(distance - near), touch.time, touch, near))
        if not found:
            raise NoWayError
        _, _, touch, near = min(found)
        return touch, near

    def _flown(self, flight: Flight, place: Point, lean: float = 0.0) -> tuple[Stop, ...]:
        """The way to the start of a flight that gets to a place."""
        first = self._start(flight, place, lean)
        match flight.origin:
            case None:
                return (Stop(first, 2 * self.count),)
            case FromVertex(vertex):
                return self._back(self._at(vertex), 0)
            case FromEdge(edge, time):
                return self._back(Stop(first, edge), time)
            case FromAbove(parents):
                x = first[0]
                low, high, parent = min(parents, key=lambda one: max(one[0] - x, x - one[1]))
                through = (min(max(x, low), high), first[1])
                rise = through[1] - place[1]
                lean = (through[0] - place[0]) / rise if rise > 0.0 else lean
                return (*self._flown(parent, through, lean), Stop(through, 2 * self.count))

    def _start(self, flight: Flight, place: Point, lean: float) -> Point:
        """A start of a flight from which it gets to a place, if possible as steep as it went on."""
        if isinstance(flight.origin, FromAbove):
            ((begin, end),) = flight.starts
            low, high = self._feasible(begin, end, place)
            wide = end[0] - begin[0]
            wanted = place[0] + lean * (begin[1] - place[1]) - begin[0]
            part = wanted / wide if wide > 0.0 else 0.0
            return _between(begin, end, min(max(part, low, 0.0), max(low, high), 1.0))
        found: list[tuple[float, Point]] = []
        for begin, end in flight.starts:
            low, high = self._feasible(begin, end, place)
            part = min(max(0.5 * (low + high), 0.0), 1.0)
            found.append((low - high, _between(begin, end, part)))
        return min(found)[1]

    def _feasible(self, begin: Point, end: Point, place: Point) -> Span:
        """Which part of a segment gets to a place: ends in [0, 1], in order unless it is none."""
        low, high = 0.0, 1.0
        for sign in (1.0, -1.0):
            # sign * (x - place) <= spread * (h - place), linear along the segment
            slack = [
                self.spread * (point[1] - place[1]) - sign * (point[0] - place[0])
                for point in (begin, end)
            ]
            change = slack[1] - slack[0]
            if change == 0.0:
                if slack[0] < 0.0:
                    high = min(high, low)
                continue
            root = -slack[0] / change
            if change > 0.0:
                low = max(low, root)
            else:
                high = min(high, root)
        return low, high

    def _on_edge(self, edge: int, distance: float) -> Stop:
        return Stop(self.levels.place(edge, distance), edge)

    def _at(self, vertex: int) -> Stop:
        return Stop(self.levels.corner(vertex), self.count + vertex)

    def _distance(self, edge: int, place: Point) -> float:
        """How far along an edge a place on it is."""
        start, end = self.levels.corner(edge), self.levels.corner(self.levels.next[edge])
        along = end[0] - start[0], end[1] - start[1]
        off = place[0] - start[0], place[1] - start[1]
        return (off[0] * along[0] + off[1] * along[1]) / self.levels.length[edge]


def _between(begin: Point, end: Point, part: float) -> Point:
    return begin[0] + part * (end[0] - begin[0]), begin[1] + part * (end[1] - begin[1])


def _joined(stops: tuple[Stop, ...], tolerance: float, count: int) -> tuple[Stop, ...]:
    """A way without stops at the place of the next one; a vertex counts more than its edges."""
    kept: list[Stop] = []
    for stop in stops:
        if kept and math.dist(kept[-1].place, stop.place) <= tolerance:
            before = kept.pop()
            corner = stop.feature < count <= before.feature < 2 * count
            stop = replace(before if corner else stop, along=before.along)
        kept.append(stop)
    return tuple(kept)
