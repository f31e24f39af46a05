"""The generalised damper with Coulomb friction, move by move, from theory 2 and 3 alone.

Nothing here knows of sweeps, kernels or of the package's mechanics: a robot has a place and a
feature, nature picks an actual direction, and the rules of theory 2 say what may come of it. From
the package come contact space, as plain arrays, and regions, as plain sets.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.task.task import SlidingLaw

Vector = NDArray[np.float64]

NEAR = 1e-9
"""A fraction of the window: what is nearer has met."""

HALF_PI = 0.5 * math.pi

ALONG = HALF_PI + 1e-12
"""Up to this angle from the normal a direction slides: exactly along the edge, by rounding."""


@dataclass(frozen=True, slots=True)
class Free:
    """A configuration of free space."""

    x: float
    y: float


@dataclass(frozen=True, slots=True)
class OnEdge:
    """A configuration inside a contact edge, `along` from its start."""

    edge: int
    along: float


@dataclass(frozen=True, slots=True)
class AtVertex:
    """A configuration at a vertex: at a pinch, in one of the wedges of free space there."""

    vertex: int


class Lost(Enum):
    """The end of a robot that has left through an open side."""

    ESCAPED = "escaped"


State = Free | OnEdge | AtVertex


class Doing(Enum):
    """What the robot does on a move."""

    FLIES = "flies"
    SLIDES = "slides"
    STICKS = "sticks"


@dataclass(frozen=True, slots=True)
class Move:
    """One straight move under one actual direction.

    Parameters
    ----------
    begin, end : where it leads from and to.
    doing : how; `edge` is the edge of a slide, else -1.
    time : how long it takes; infinite if the robot sticks.
    """

    begin: State
    end: State | Lost
    start: tuple[float, float]
    stop: tuple[float, float]
    doing: Doing
    edge: int
    time: float


@dataclass(frozen=True, slots=True)
class Force:
    """A reaction: its angle, and its magnitude."""

    angle: float
    magnitude: float


def turned(angle: float) -> float:
    """The same angle between -pi and pi."""
    return math.remainder(angle, math.tau)


class World:
    """A scene in which a robot moves.

    Parameters
    ----------
    space : whose contact space and free area are used as plain data.
    friction : phi, radians.
    """

    def __init__(
        self,
        space: ConfigurationSpace,
        friction: float,
        sliding: SlidingLaw = SlidingLaw.PROJECTION,
    ) -> None:
        contact: ContactSpace = space.contact
        self.space, self.friction, self.sliding = space, friction, sliding
        self.points = contact.points
        self.next = contact.next.tolist()
        self.previous = [0] * len(self.next)
        for edge, vertex in enumerate(self.next):
            self.previous[vertex] = edge
        self.open = contact.open.tolist()
        ends = self.points[contact.next]
        along = ends - self.points
        self.length = np.hypot(along[:, 0], along[:, 1])
        self.tangent = along / self.length[:, None]
        self.normal = np.stack((-self.tangent[:, 1], self.tangent[:, 0]), axis=1)
        self.angle_of_normal = np.arctan2(self.normal[:, 1], self.normal[:, 0])
        xmin, ymin, xmax, ymax = space.window
        self.size = max(xmax - xmin, ymax - ymin)
        self.near = NEAR * self.size

    # --- what a state is ------------------------------------------------------------------

    def place(self, state: State) -> tuple[float, float]:
        """Where a state is."""
        match state:
            case Free(x, y):
                return x, y
            case OnEdge(edge, along):
                x, y = self.points[edge] + along * self.tangent[edge]
                return float(x), float(y)
            case AtVertex(vertex):
                x, y = self.points[vertex]
                return float(x), float(y)

    def off(self, region: Region, state: State) -> float:
        """How far a state is from a region, within its own feature; infinite if nothing is."""
        match state:
            case Free(x, y):
                if region.area.is_empty:
                    return math.inf
                return float(shapely.distance(region.area.geometry, shapely.Point(x, y)))
            case OnEdge(edge, along):
                on = region.contact.edge == edge
                gaps = np.maximum(region.contact.low[on] - along, along - region.contact.high[on])
                return float(np.maximum(gaps, 0.0).min(initial=math.inf))
            case AtVertex(vertex):
                return 0.0 if vertex in region.contact.vertices.tolist() else math.inf

    def is_in(self, region: Region, state: State, slack: float = 0.0) -> bool:
        """Whether a state belongs to a region, up to some slack within its own feature."""
        return self.off(region, state) <= slack

    def escaped(self, state: State) -> bool:
        """Whether the robot has touched an open side."""
        match state:
            case Free():
                return False
            case OnEdge(edge, _):
                return bool(self.open[edge])
            case AtVertex(vertex):
                return bool(self.open[vertex] or self.open[self.previous[vertex]])

    # --- what nature may make of it ---------------------------------------------------------

    def moves(self, state: State, angle: float, time: float) -> list[Move]:
        """What may come of an actual direction that is kept for some time, one event at most."""
        u = np.array((math.cos(angle), math.sin(angle)))
        match state:
            case Free():
                return [self._fly(state, u, time)]
            case OnEdge(edge, _):
                pressing = self.pressing(edge, angle)
                if abs(pressing) > ALONG:
                    return [self._fly(state, u, time)]
                if abs(pressing) <= self.friction:
                    return [self._stick(state)]
                return [self._slide(state, edge, pressing, time)]
            case AtVertex(vertex):
                return self._from_vertex(vertex, angle, u, time)

    def pressing(self, edge: int, angle: float) -> float:
        """`a = angle(nu, -v*)`."""
        return turned(angle + math.pi - self.angle_of_normal[edge])

    def speed(self, pressing: float) -> float:
        """How fast the robot slides (theory 2)."""
        if self.sliding is SlidingLaw.PROJECTION:
            return math.sin(abs(pressing))
        if self.friction >= HALF_PI:
            return 1.0
        return math.sin(abs(pressing) - self.friction) / math.cos(self.friction)

    def concave(self, vertex: int) -> bool:
        """Whether the free space around a vertex spans less than pi."""
        a, b = self.tangent[self.previous[vertex]], self.tangent[vertex]
        return bool(a[0] * b[1] - a[1] * b[0] > 0.0)

    def holds(self, vertex: int, angle: float) -> bool:
        """Whether a concave vertex holds the robot: -v* in [nu1 - phi, nu2 + phi]."""
        first = self.angle_of_normal[self.previous[vertex]]
        hull = (self.angle_of_normal[vertex] - first) % math.tau
        behind = (angle + math.pi - first + self.friction) % math.tau
        return bool(behind <= hull + 2.0 * self.friction)

    def _stick(self, state: State) -> Move:
        place = self.place(state)
        return Move(state, state, place, place, Doing.STICKS, -1, math.inf)

    def _from_vertex(self, vertex: int, angle: float, u: Vector, time: float) -> list[Move]:
        state = AtVertex(vertex)
        if self.concave(vertex) and self.holds(vertex, angle):
            return [self._stick(state)]
        found: list[Move] = []
        for edge, outward in ((vertex, 1.0), (self.previous[vertex], -1.0)):
            if self.open[edge]:
                continue
            pressing = self.pressing(edge, angle)
            if abs(pressing) <= self.friction:
                if not self.concave(vertex):
                    found.append(self._stick(state))
            elif abs(pressing) <= ALONG and outward * float(u @ self.tangent[edge]) > 0.0:
                found.append(self._slide(state, edge, pressing, time))
        # into the free wedge, from the edge that starts here to the one that ends here
        ahead, wedge = self._wedge(vertex)
        if 0.0 < (angle - ahead) % math.tau < wedge:
            found.append(self._fly(state, u, time))
        return found

    def _slide(self, state: State, edge: int, pressing: float, time: float) -> Move:
        length = float(self.length[edge])
        match state:
            case OnEdge(_, along):
                begin = along
            case AtVertex(vertex):
                begin = 0.0 if vertex == edge else length
            case Free():
                raise AssertionError("what flies does not slide")
        # nu turned by a quarter to the left points against the edge's own tangent: with -v* to
        # the left of nu, v* goes along the tangent
        forward = pressing > 0.0
        speed = self.speed(pressing)
        reach = min(speed * time, length - begin if forward else begin)
        stop = begin + reach if forward else begin - reach
        end: State = OnEdge(edge, stop)
        if stop >= length - self.near:
            end = AtVertex(self.next[edge])
        elif stop <= self.near:
            end = AtVertex(edge)
        taken = reach / speed if speed > 0.0 else math.inf
        return Move(state, end, self.place(state), self.place(end), Doing.SLIDES, edge, taken)

    def _fly(self, state: State, u: Vector, time: float) -> Move:
        x, y = self.place(state)
        towards = -(self.normal @ u)
        facing = np.flatnonzero(towards > 1e-14)
        offset = self.points[facing] - (x, y)
        height = -np.sum(offset * self.normal[facing], axis=1)
        reach = height / towards[facing]
        where = reach[:, None] * u - offset
        along = np.sum(where * self.tangent[facing], axis=1)
        hit = (along >= -self.near) & (along <= self.length[facing] + self.near)
        hit &= reach >= -self.near
        if isinstance(state, AtVertex):
            # the wedge is left: what starts here faces the other way, or belongs to other wedges
            here = np.hypot(*(self.points - (x, y)).T) <= self.near
            there = np.hypot(*(self.points[self.next] - (x, y)).T) <= self.near
            hit &= ~(here | there)[facing]
        limit = min(time, 4.0 * self.size)
        reach = np.where(hit, np.maximum(reach, 0.0), math.inf)
        if not len(reach) or reach.min() > limit + self.near:
            stop = (x + limit * float(u[0]), y + limit * float(u[1]))
            return Move(state, Free(*stop), (x, y), stop, Doing.FLIES, -1, limit)
        first = int(np.argmin(reach))
        edge, place, taken = int(facing[first]), float(along[first]), float(reach[first])
        stop = (x + taken * float(u[0]), y + taken * float(u[1]))
        end: State | Lost = OnEdge(edge, place)
        at_end = place >= self.length[edge] - self.near
        if place <= self.near or at_end:
            corner = self.next[edge] if at_end else edge
            end = self._met(corner, x, y)
            stop = self.place(end)
        elif self.open[edge]:
            end = Lost.ESCAPED
        return Move(state, end, (x, y), stop, Doing.FLIES, -1, taken)

    def _met(self, vertex: int, x: float, y: float) -> AtVertex:
        """The vertex at a place in whose wedge a flight from (x, y) arrives."""
        here = np.flatnonzero(np.hypot(*(self.points - self.points[vertex]).T) <= self.near)
        px, py = self.points[vertex]
        back = math.atan2(y - py, x - px)

        def beyond(other: int) -> float:
            ahead, wedge = self._wedge(other)
            return abs(turned(back - ahead - 0.5 * wedge)) - 0.5 * wedge

        return AtVertex(min(here.tolist(), key=beyond))

    def _wedge(self, vertex: int) -> tuple[float, float]:
        """The free wedge at a vertex: the direction of the edge that starts here, and its span."""
        ahead = math.atan2(self.tangent[vertex][1], self.tangent[vertex][0])
        back = -self.tangent[self.previous[vertex]]
        return ahead, (math.atan2(back[1], back[0]) - ahead) % math.tau

    # --- what is felt ---------------------------------------------------------------------

    def reaction(self, edge: int, angle: float) -> Force:
        """The reaction of an edge to an actual direction (theory 2)."""
        pressing = self.pressing(edge, angle)
        if abs(pressing) > HALF_PI:
            return Force(0.0, 0.0)
        if abs(pressing) <= self.friction:
            return Force(angle + math.pi, 1.0)
        magnitude = math.cos(pressing) / math.cos(self.friction)
        tilt = math.copysign(self.friction, pressing)
        return Force(float(self.angle_of_normal[edge]) + tilt, max(magnitude, 0.0))

    def forces(self, state: State, angle: float) -> list[Force]:
        """All that may push back in a state, under an actual direction (theory 3)."""
        match state:
            case Free():
                return [Force(0.0, 0.0)]
            case OnEdge(edge, _):
                return [self.reaction(edge, angle)]
            case AtVertex(vertex):
                pair = (vertex, self.previous[vertex])
                found = [self.reaction(edge, angle) for edge in pair if not self.open[edge]]
                if len(found) == 2:
                    found.append(_sum(found))
                    if self.concave(vertex) and self.holds(vertex, angle):
                        found.append(Force(angle + math.pi, 1.0))
                return found


def _sum(forces: Sequence[Force]) -> Force:
    x = sum(force.magnitude * math.cos(force.angle) for force in forces)
    y = sum(force.magnitude * math.sin(force.angle) for force in forces)
    return Force(math.atan2(y, x), math.hypot(x, y))
