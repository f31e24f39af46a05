"""Nature on the complement of a backprojection: a motion that keeps away from the target."""

from __future__ import annotations

import math
from random import Random

import shapely

from preimage.configuration.region import Region
from tests.laws.adversaries import INSIDE
from tests.laws.passage import on_the_way
from tests.laws.world import AtVertex, Doing, Free, Lost, Move, OnEdge, State, World, turned

BESIDE = 1e-5
"""How far beside what she aims at nature passes it, in radians."""

TRIES = 150


def avoiding_motion(
    world: World,
    start: State,
    target: Region,
    claimed: Region,
    direction: float,
    control: float,
    rng: Random,
) -> list[State] | None:
    """An admissible motion that never meets the target: it sticks elsewhere, or escapes.

    Nature keeps to states outside the claimed backprojection; from each there should be a way on.
    """
    track = [start]
    for _ in range(TRIES):
        onwards: list[State] = []
        angles = [
            (angle, time)
            for angle, time in _angles(world, track[-1], target, rng)
            if abs(turned(angle - direction)) <= control * INSIDE
        ]
        sides = (-control * INSIDE, 0.0, control * INSIDE, rng.uniform(-control, control))
        angles += [(direction + side, math.inf) for side in sides]
        for angle, time in angles:
            for move in world.moves(track[-1], angle, time):
                if _meets(world, move, target):
                    continue
                if isinstance(move.end, Lost) or world.escaped(move.end):
                    return track
                if move.doing is Doing.STICKS:
                    return track
                if not world.is_in(claimed, move.end, world.near):
                    onwards.append(move.end)
        track = [*track, rng.choice(onwards)] if onwards else [start]
    return None


def _meets(world: World, move: Move, target: Region) -> bool:
    """Whether a move meets the target, on its way or at its end."""
    if any(True for _ in on_the_way(move, target, 0.0)):
        return True
    if isinstance(move.end, Lost):
        return False
    return world.is_in(target, move.end, world.near)


def _angles(world: World, state: State, target: Region, rng: Random) -> list[tuple[float, float]]:
    """Directions at corners and just beside them, and how far it is; those that press."""
    x, y = world.place(state)
    marks = world.points.tolist() + shapely.get_coordinates(target.area.geometry).tolist()
    contact = target.contact
    for ends in (contact.low, contact.high):
        marks += world.space.contact.at(contact.edge, ends).tolist()
    found: list[tuple[float, float]] = []
    for px, py in marks:
        gap = math.hypot(px - x, py - y)
        if gap <= 1e-6:
            continue
        towards = math.atan2(py - y, px - x)
        for turn in (-BESIDE, 0.0, BESIDE):
            found += [(towards + turn, gap), (towards + turn, math.inf)]
    edges: tuple[int, ...] = ()
    match state:
        case OnEdge(edge, _):
            edges = (edge,)
        case AtVertex(vertex):
            edges = (vertex, world.previous[vertex])
        case Free():
            pass
    for edge in edges:
        press = float(world.angle_of_normal[edge]) + math.pi
        found += [(press + turn * world.friction, math.inf) for turn in (-INSIDE, 0.0, INSIDE)]
    return found


def around(world: World, state: State, margin: float) -> list[State]:
    """The state, and others of its feature that near."""
    match state:
        case Free(x, y):
            free = world.space.free
            places = [(x + i * margin, y + j * margin) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            return [Free(*place) for place in places if free.contains(*place)]
        case OnEdge(edge, along):
            length = float(world.length[edge])
            return [OnEdge(edge, min(max(along + i * margin, 0.0), length)) for i in (-1, 0, 1)]
        case AtVertex():
            return [state]
