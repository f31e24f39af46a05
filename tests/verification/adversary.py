"""A second oracle: motions carried out one by one, straight from the rules of theory 2.

Nothing here knows of sweeps, slabs or cones that grow: a state moves under one actual direction
until it meets a feature, and a player (nature) picks the directions.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from random import Random

import shapely

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace

NEAR = 1e-7
"""A flight that passes this near to the end of an edge meets the vertex; scenes are 12 wide."""

QUARTER = 0.5 * math.pi + 1e-9
"""Up to this angle from the normal a direction slides: exactly along the edge included."""


class Outcome(Enum):
    MET = "met the target"
    STUCK = "stuck outside the target"
    ESCAPED = "left through an open side"


@dataclass(frozen=True)
class Free:
    x: float
    y: float


@dataclass(frozen=True)
class OnEdge:
    edge: int
    distance: float


@dataclass(frozen=True)
class AtVertex:
    vertex: int


State = Free | OnEdge | AtVertex


class World:
    """One scene in plain numbers."""

    def __init__(self, space: ConfigurationSpace, target: Region, friction: float) -> None:
        contact = space.contact
        self.points: list[tuple[float, float]] = [(x, y) for x, y in contact.points.tolist()]
        self.next: list[int] = contact.next.tolist()
        self.open: list[bool] = contact.open.tolist()
        self.previous = [0] * len(self.next)
        for edge, vertex in enumerate(self.next):
            self.previous[vertex] = edge
        self.tangent: list[tuple[float, float]] = []
        self.length: list[float] = []
        for (ax, ay), after in zip(self.points, self.next, strict=True):
            bx, by = self.points[after]
            length = math.hypot(bx - ax, by - ay)
            self.length.append(length)
            self.tangent.append(((bx - ax) / length, (by - ay) / length))
        self.intervals: dict[int, list[tuple[float, float]]] = {}
        chosen = target.contact
        for edge, low, high in zip(
            chosen.edge.tolist(), chosen.low.tolist(), chosen.high.tolist(), strict=True
        ):
            self.intervals.setdefault(edge, []).append((low, high))
        self.vertices = set(chosen.vertices.tolist())
        self.area = target.area.geometry
        shapely.prepare(self.area)
        self.friction = friction
        self.marks = list(self.points)
        self.marks += [(x, y) for x, y in shapely.get_coordinates(self.area).tolist()]
        for edge, spans in self.intervals.items():
            self.marks += [self.place(OnEdge(edge, end)) for span in spans for end in span]

    # --- what a state is ------------------------------------------------------------------

    def settled(self, state: State) -> Outcome | None:
        """Whether it is all over in a state, whatever the direction."""
        match state:
            case Free(x, y):
                return Outcome.MET if shapely.intersects_xy(self.area, x, y) else None
            case OnEdge(edge, distance):
                if self.open[edge]:
                    return Outcome.ESCAPED
                inside = any(
                    low - NEAR <= distance <= high + NEAR
                    for low, high in self.intervals.get(edge, ())
                )
                return Outcome.MET if inside else None
            case AtVertex(vertex):
                if vertex in self.vertices:
                    return Outcome.MET
                beside = self.open[vertex] or self.open[self.previous[vertex]]
                return Outcome.ESCAPED if beside else None

    def place(self, state: State) -> tuple[float, float]:
        match state:
            case Free(x, y):
                return x, y
            case OnEdge(edge, distance):
                (ax, ay), (tx, ty) = self.points[edge], self.tangent[edge]
                return ax + distance * tx, ay + distance * ty
            case AtVertex(vertex):
                return self.points[vertex]

    def edges_at(self, state: State) -> list[int]:
        match state:
            case Free():
                return []
            case OnEdge(edge, _):
                return [edge]
            case AtVertex(vertex):
                return [vertex, self.previous[vertex]]

    # --- one move -------------------------------------------------------------------------

    def moves(self, state: State, angle: float, reach: float) -> list[State | Outcome]:
        """What nature may make of a state under the actual direction `angle`, for a while.

        A flight of at most `reach`, or a slide of at most `reach`; several at a vertex.
        """
        over = self.settled(state)
        if over is not None:
            return [over]
        ux, uy = math.cos(angle), math.sin(angle)
        match state:
            case Free(x, y):
                return [self._fly(x, y, ux, uy, reach, frozenset())]
            case OnEdge(edge, distance):
                pressing = self._pressing(edge, ux, uy)
                if abs(pressing) > QUARTER:
                    x, y = self.place(state)
                    return [self._fly(x, y, ux, uy, reach, frozenset((edge,)))]
                if abs(pressing) <= self.friction:
                    return [Outcome.STUCK]
                forward = self._along(edge, ux, uy) > 0.0
                return [self._slide(edge, distance, forward, reach)]
            case AtVertex(vertex):
                return self._from_vertex(vertex, ux, uy, reach)

    def _from_vertex(
        self, vertex: int, ux: float, uy: float, reach: float
    ) -> list[State | Outcome]:
        after, before = vertex, self.previous[vertex]
        (ax, ay), (bx, by) = self.tangent[before], self.tangent[after]
        turn = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
        first = math.atan2(by, bx)
        into = (math.atan2(uy, ux) - first) % math.tau
        flies = 1e-9 < into < math.pi - turn - 1e-9  # along an edge it slides
        found: list[State | Outcome] = []
        if turn > 0.0:  # concave: -v* in the hull of the two friction cones
            middle = math.atan2(ax, -ay) + 0.5 * turn
            off = abs(_wrapped(math.atan2(-uy, -ux) - middle))
            if off <= 0.5 * turn + self.friction:
                return [Outcome.STUCK]
        for edge, away in ((after, True), (before, False)):
            pressing = abs(self._pressing(edge, ux, uy))
            if turn <= 0.0 and pressing <= self.friction:
                found.append(Outcome.STUCK)
            elif self.friction < pressing <= QUARTER:
                forward = self._along(edge, ux, uy) > 0.0
                if forward == away:
                    start = 0.0 if away else self.length[edge]
                    found.append(self._slide(edge, start, forward, reach))
        if flies:
            x, y = self.points[vertex]
            beside = (edge for other in self._at(vertex) for edge in (other, self.previous[other]))
            found.append(self._fly(x, y, ux, uy, reach, frozenset(beside)))
        return found

    def _at(self, vertex: int) -> list[int]:
        """All vertices at one place: more than one where obstacles pinch free space."""
        place = self.points[vertex]
        return [i for i, other in enumerate(self.points) if math.dist(place, other) <= NEAR]

    def _hit(self, vertex: int, ux: float, uy: float) -> State:
        """The vertex at a place that a flight meets: the one whose free wedge it comes through."""
        for other in self._at(vertex):
            (ax, ay), (bx, by) = self.tangent[self.previous[other]], self.tangent[other]
            turn = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
            if (math.atan2(-uy, -ux) - math.atan2(by, bx)) % math.tau < math.pi - turn:
                return AtVertex(other)
        return AtVertex(vertex)

    def _pressing(self, edge: int, ux: float, uy: float) -> float:
        """angle(nu, -v*)."""
        tx, ty = self.tangent[edge]
        nx, ny = -ty, tx
        return math.atan2(nx * -uy - ny * -ux, nx * -ux + ny * -uy)

    def _along(self, edge: int, ux: float, uy: float) -> float:
        tx, ty = self.tangent[edge]
        return ux * tx + uy * ty

    def _slide(self, edge: int, distance: float, forward: bool, reach: float) -> State | Outcome:
        length = self.length[edge]
        goal = min(length, distance + reach) if forward else max(0.0, distance - reach)
        low, high = min(distance, goal), max(distance, goal)
        for begin, end in self.intervals.get(edge, ()):
            if begin <= high and low <= end:
                return Outcome.MET
        if goal >= length - NEAR:
            return AtVertex(self.next[edge])
        if goal <= NEAR:
            return AtVertex(edge)
        return OnEdge(edge, goal)

    def _fly(
        self, x: float, y: float, ux: float, uy: float, reach: float, but: frozenset[int]
    ) -> State | Outcome:
        best, where = reach, None
        for edge, ((ax, ay), (tx, ty), length) in enumerate(
            zip(self.points, self.tangent, self.length, strict=True)
        ):
            towards = ux * ty - uy * tx  # sin of the angle between; below 0: into the edge
            if edge in but or towards <= 1e-12:
                continue
            time = ((ax - x) * ty - (ay - y) * tx) / towards
            along = ((ax - x) * uy - (ay - y) * ux) / towards
            if -NEAR <= along <= length + NEAR and -NEAR < time < best:
                best, where = max(time, 0.0), (edge, along, length)
        gone = (x + best * ux, y + best * uy)
        # contact configurations speak for themselves, so the very ends on contact are left out
        begin = 1e-9 if but else 0.0
        stop = best - 1e-9 if where else best
        if stop > begin:
            path = shapely.LineString(
                [(x + begin * ux, y + begin * uy), (x + stop * ux, y + stop * uy)]
            )
            if shapely.intersects(self.area, path):
                return Outcome.MET
        if where is None:
            return Free(*gone)
        edge, along, length = where
        if along <= NEAR:
            return self._hit(edge, ux, uy)
        if along >= length - NEAR:
            return self._hit(self.next[edge], ux, uy)
        return Outcome.ESCAPED if self.open[edge] else OnEdge(edge, along)


def _wrapped(angle: float) -> float:
    return math.remainder(angle, math.tau)


# --- what nature tries ----------------------------------------------------------------------


def tempting_angles(
    world: World, state: State, direction: float, control: float, rng: Random
) -> list[float]:
    """Actual directions within the cone: extremes, random ones, and those aimed at something.

    Aimed at vertices, at corners and ends of the target, and just beside; and those that press an
    edge under the robot along its normal and along the sides of its friction cone.
    """
    found = [direction - control, direction + control, direction]
    found += [direction + rng.uniform(-control, control) for _ in range(3)]
    aimed: list[float] = []
    x, y = world.place(state)
    marks = rng.sample(world.marks, min(12, len(world.marks)))
    for px, py in marks:
        if math.dist((px, py), (x, y)) > NEAR:
            angle = math.atan2(py - y, px - x)
            aimed += [angle, angle - 1e-4, angle + 1e-4]
    for edge in world.edges_at(state):
        tx, ty = world.tangent[edge]
        press = math.atan2(-tx, ty)
        aimed += [press, press - world.friction, press + world.friction]
    found += [angle for angle in aimed if abs(_wrapped(angle - direction)) <= control]
    return found


def some_states(world: World, space: ConfigurationSpace, rng: Random, count: int) -> list[State]:
    """Random free configurations, one on each contact edge, and all contact vertices."""
    xmin, ymin, xmax, ymax = space.window
    states: list[State] = []
    for _ in range(count):
        x, y = rng.uniform(xmin, xmax), rng.uniform(ymin, ymax)
        if space.free.contains(x, y):
            states.append(Free(x, y))
    for edge in space.contact.edges.tolist():
        states.append(OnEdge(edge, rng.uniform(0.001, 0.999) * world.length[edge]))
    states += [AtVertex(vertex) for vertex in space.contact.vertices.tolist()]
    return states


def neighbours(world: World, space: ConfigurationSpace, state: State, margin: float) -> list[State]:
    """The state and others of its feature around it."""
    match state:
        case Free(x, y):
            around = [(x + i * margin, y + j * margin) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            return [Free(*place) for place in around if space.free.contains(*place)]
        case OnEdge(edge, distance):
            length = world.length[edge]
            return [OnEdge(edge, min(max(distance + i * margin, 0.0), length)) for i in (-1, 0, 1)]
        case AtVertex():
            return [state]


def carry_out(
    world: World, state: State, choose: Callable[[State], tuple[float, float]], rng: Random
) -> tuple[Outcome, list[State]]:
    """One motion under a policy that gives an actual direction and for how long to keep it."""
    trace = [state]
    for _ in range(10_000):
        angle, reach = choose(state)
        found = rng.choice(world.moves(state, angle, reach))
        if isinstance(found, Outcome):
            return found, trace
        state = found
        trace.append(state)
    raise AssertionError("a motion without end")


def escape_route(
    world: World,
    start: State,
    angles: Callable[[State], list[float]],
    stays: Callable[[State], bool],
    rng: Random,
) -> list[State] | None:
    """A motion that avoids the target for good, by moves to states that may `stay` so."""
    trace = [start]
    for _ in range(400):
        state = trace[-1]
        onwards: list[State] = []
        candidates = angles(state)
        rng.shuffle(candidates)
        for angle in candidates:
            for found in world.moves(state, angle, rng.choice((0.01, 0.1, 0.5, 2.0, 30.0, 30.0))):
                over = found if isinstance(found, Outcome) else world.settled(found)
                if over in (Outcome.STUCK, Outcome.ESCAPED):
                    return trace
                if over is None and not isinstance(found, Outcome) and stays(found):
                    onwards.append(found)
        trace = [*trace, rng.choice(onwards)] if onwards else [start]
    return None
