"""What nature tries (theory 8): actual directions within the cone, readings within the errors."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from random import Random

import shapely

from preimage.configuration.region import Region
from preimage.task.uncertainty import Uncertainty
from tests.laws.world import AtVertex, Free, Move, OnEdge, State, World, turned

INSIDE = 1.0 - 1e-9
"""The errors' bounds are open: nature stays this far within them."""


@dataclass(frozen=True, slots=True)
class Motion:
    """What nature knows of the motion that she disturbs.

    Parameters
    ----------
    direction, control : v and theta, radians.
    preimage : from where the motion is claimed to end well.
    """

    world: World
    direction: float
    control: float
    preimage: Region

    def within(self, angle: float) -> float:
        """The direction of the cone nearest to an angle."""
        reach = self.control * INSIDE
        off = turned(angle - self.direction)
        return self.direction + min(max(off, -reach), reach)

    def allows(self, angle: float) -> bool:
        """Whether an angle is in the cone."""
        return abs(turned(angle - self.direction)) <= self.control * INSIDE


Choice = tuple[float, float]
"""An actual direction, and how long nature means to keep it."""

Control = Callable[[Motion, State, int, Random], Choice]
"""Nature's hand on the controls; the number counts the moves made so far."""


def _constant(share: float) -> Control:
    def choose(motion: Motion, _state: State, _count: int, _rng: Random) -> Choice:
        return motion.within(motion.direction + share * motion.control), math.inf

    return choose


def switching(motion: Motion, _state: State, count: int, _rng: Random) -> Choice:
    """One side of the cone until something is met, then the other."""
    side = 1.0 if count % 2 else -1.0
    return motion.within(motion.direction + side * motion.control), math.inf


def drifting(motion: Motion, _state: State, count: int, rng: Random) -> Choice:
    """Along one side of the cone for a while, then along the other."""
    side = 1.0 if (count // 3) % 2 else -1.0
    return motion.within(motion.direction + side * motion.control), rng.uniform(0.05, 1.5)


def restless(motion: Motion, _state: State, _count: int, rng: Random) -> Choice:
    """Any direction, for a short time."""
    share = rng.choice((-1.0, 1.0, rng.uniform(-1.0, 1.0)))
    angle = motion.within(motion.direction + share * motion.control)
    return angle, rng.choice((0.03, 0.3, 3.0))


def clinging(motion: Motion, state: State, _count: int, rng: Random) -> Choice:
    """Sticks whenever it can, and presses against what it touches."""
    edges: tuple[int, ...] = ()
    match state:
        case OnEdge(edge, _):
            edges = (edge,)
        case AtVertex(vertex):
            edges = (vertex, motion.world.previous[vertex])
        case Free():
            pass
    world = motion.world
    for edge in edges:
        press = float(world.angle_of_normal[edge]) + math.pi
        for tilt in (0.0, world.friction * INSIDE, -world.friction * INSIDE):
            angle = motion.within(press + tilt)
            if abs(world.pressing(edge, angle)) <= world.friction:
                return angle, 0.1
    if edges:
        return motion.within(float(world.angle_of_normal[edges[0]]) + math.pi), math.inf
    return motion.within(motion.direction + rng.uniform(-1.0, 1.0) * motion.control), math.inf


def hunting(motion: Motion, state: State, _count: int, rng: Random) -> Choice:
    """Aims at the nearest hazard: the closest point of the complement of the preimage."""
    place = shapely.Point(motion.world.place(state))
    area = motion.preimage.area.geometry
    if area.is_empty:
        return restless(motion, state, 0, rng)
    nearest = shapely.get_coordinates(shapely.shortest_line(place, area.boundary))
    (x, y), (tx, ty) = nearest.tolist()
    gap = math.hypot(tx - x, ty - y)
    if gap < 1e-6:
        return restless(motion, state, 0, rng)
    angle = motion.within(math.atan2(ty - y, tx - x))
    return angle, rng.choice((0.5 * gap, gap, math.inf))


def aiming(motion: Motion, state: State, _count: int, rng: Random) -> Choice:
    """Aims at corners of obstacles, and just beside them."""
    x, y = motion.world.place(state)
    aims = []
    for px, py in motion.world.points.tolist():
        if math.hypot(px - x, py - y) > 1e-6:
            angle = math.atan2(py - y, px - x)
            aims += [angle - 1e-5, angle, angle + 1e-5]
    aims = [angle for angle in aims if motion.allows(angle)]
    if not aims:
        return restless(motion, state, 0, rng)
    return rng.choice(aims), math.inf


CONTROLS: dict[str, Control] = {
    "to the right": _constant(-1.0),
    "straight": _constant(0.0),
    "to the left": _constant(1.0),
    "switching": switching,
    "drifting": drifting,
    "restless": restless,
    "clinging": clinging,
    "hunting": hunting,
    "aiming": aiming,
}


def pick(name: str, moves: list[Move], rng: Random) -> Move:
    """Which of several moves nature makes of a vertex: who clings sticks."""
    if name == "clinging":
        return max(moves, key=lambda move: move.time)
    return rng.choice(moves)


# --- readings -----------------------------------------------------------------------------

Reading = tuple[tuple[float, float], float | None]
"""A measured position, and the angle of the measured force; None if the force reads 0."""


def positions(
    place: tuple[float, float], rho: float, marks: list[float], rng: Random
) -> list[tuple[float, float]]:
    """Worst offsets: none, along given angles, and some at random."""
    x, y = place
    if rho == 0.0:
        return [place]
    if math.isinf(rho):
        return [(rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0))]
    angles = [*marks, *(rng.uniform(0.0, math.tau) for _ in range(3))]
    reach = rho * INSIDE
    found = [(x + reach * math.cos(angle), y + reach * math.sin(angle)) for angle in angles]
    inner = reach * math.sqrt(rng.random())
    turn = rng.uniform(0.0, math.tau)
    return [*found, place, (x + inner * math.cos(turn), y + inner * math.sin(turn))]


def forces(
    world: World, state: State, angle: float, senses: Uncertainty, rng: Random
) -> list[float | None]:
    """All kinds of force readings in a state: 0 wherever it may be read, ends of the cone."""
    low, high = senses.force_thresholds
    found: list[float | None] = []
    for force in world.forces(state, angle):
        if force.magnitude <= high:
            found.append(None)
        if force.magnitude > low:
            reach = senses.force_angle * INSIDE
            found += [force.angle + turn for turn in (0.0, reach, -reach)]
            found.append(force.angle + rng.uniform(-reach, reach))
    return list(dict.fromkeys(found))
