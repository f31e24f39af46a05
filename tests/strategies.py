"""Generators of tasks, degenerate on purpose, shared by the tests of every room."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from random import Random
from typing import NamedTuple

import numpy as np
import shapely
from hypothesis import strategies as st
from shapely.geometry.base import BaseGeometry

from preimage.configuration.boundary import contact_space
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.tolerance import Tolerance
from preimage.task.workspace import Side

HALF = 6
"""Half the width of the window in which scenes are made; lattice points are integers."""

SHORTEST = 1e-6
"""Scenes with shorter edges are made anew: what they are is up to rounding."""

CONTROLS = tuple(math.radians(angle) for angle in (0, 1, 5, 20, 45, 80))
FRICTIONS = tuple(math.radians(angle) for angle in (0, 0, 5, 15, 20, 30, 45, 60, 80))


class Scene(NamedTuple):
    """A space, a target in it, and a commanded motion."""

    space: ConfigurationSpace
    target: Region
    direction: float
    control: float
    friction: float


def space_of(
    obstacles: Sequence[BaseGeometry],
    walls: Sequence[Side] = (),
    window: tuple[float, float, float, float] = (-HALF, -HALF, HALF, HALF),
) -> ConfigurationSpace:
    """The configuration space of a point robot among polygons."""
    tolerance = Tolerance.for_window(*window)
    reach = 0.25 * (window[2] - window[0])
    outer = Area.box(window[0] - reach, window[1] - reach, window[2] + reach, window[3] + reach)
    solid = areas.intersection(
        areas.united_on_grid([Area.of(shape) for shape in obstacles], tolerance.grid), outer
    )
    free = areas.difference_on_grid(Area.box(*window), solid, tolerance.grid)
    contact = contact_space(free, solid, window, walls, tolerance)
    return ConfigurationSpace(window, tolerance, free, solid, contact)


def random_scene(rng: Random) -> Scene:
    """A small scene: up to six obstacles, any target, any motion; half of them on a lattice."""
    lattice = rng.random() < 0.5
    space = random_space(rng, lattice)
    if rng.random() < 0.65:
        direction = math.radians(rng.choice((270, 270, 0, 45, 90, 135, 180, 225, 315)))
    else:
        direction = rng.uniform(0.0, math.tau)
    control, friction = rng.choice(CONTROLS), rng.choice(FRICTIONS)
    target = random_target(rng, space, direction, lattice)
    return Scene(space, target, direction, control, friction)


scenes: st.SearchStrategy[Scene] = st.randoms(use_true_random=False).map(random_scene)
"""The same scenes, drawn and shrunk by Hypothesis."""


# --- spaces -----------------------------------------------------------------------------------


def random_space(rng: Random, lattice: bool) -> ConfigurationSpace:
    """Obstacles that stand apart, touch, overlap, or reach the window's sides."""
    while True:
        shapes: list[BaseGeometry] = []
        for _ in range(rng.randint(1, 6)):
            make = rng.choice(SHAPES)
            shape = make(rng, lattice)
            if not lattice and rng.random() < 0.5:
                shape = _turned(shape, rng.uniform(0.0, math.tau))
            if shapes and rng.random() < 0.3:
                shape = _touching(rng, shape, rng.choice(shapes))
            shapes.append(shape)
        walls = [side for side in Side if rng.random() < 0.25]
        if rng.random() < 0.1:
            walls = list(Side)
        space = space_of(shapes, walls)
        if len(space.contact.edges) and space.contact.length.min() > SHORTEST:
            return space


def _number(rng: Random, low: float, high: float, lattice: bool) -> float:
    if lattice:
        return float(rng.randint(math.ceil(low), math.floor(high)))
    return rng.uniform(low, high)


def _point(rng: Random, lattice: bool, reach: float = HALF) -> tuple[float, float]:
    return _number(rng, -reach, reach, lattice), _number(rng, -reach, reach, lattice)


def _box(rng: Random, lattice: bool) -> BaseGeometry:
    x, y = _point(rng, lattice)
    return shapely.box(x, y, x + _number(rng, 1, 5, lattice), y + _number(rng, 1, 4, lattice))


def _triangle(rng: Random, lattice: bool) -> BaseGeometry:
    return _hull(rng, lattice, 3)


def _slanted(rng: Random, lattice: bool) -> BaseGeometry:
    return _hull(rng, lattice, 6)


def _hull(rng: Random, lattice: bool, count: int) -> BaseGeometry:
    while True:
        x, y = _point(rng, lattice)
        points = [
            (x + _number(rng, -3, 3, lattice), y + _number(rng, -3, 3, lattice))
            for _ in range(count)
        ]
        hull = shapely.MultiPoint(points).convex_hull
        if hull.area > 0.3:
            return hull


def _diamond(rng: Random, lattice: bool) -> BaseGeometry:
    x, y = _point(rng, lattice)
    wide, high = _number(rng, 1, 3, lattice), _number(rng, 1, 3, lattice)
    return shapely.Polygon([(x + wide, y), (x, y + high), (x - wide, y), (x, y - high)])


def _ell(rng: Random, lattice: bool) -> BaseGeometry:
    x, y = _point(rng, lattice, 4)
    long, thick = _number(rng, 3, 5, lattice), _number(rng, 1, 2, lattice)
    upright = shapely.box(x, y, x + thick, y + long)
    lying = shapely.box(x, y, x + long, y + thick)
    shape = shapely.union(upright, lying)
    return shapely.affinity.rotate(shape, 90 * rng.randint(0, 3), origin=(x, y))


def _floor(rng: Random, lattice: bool) -> BaseGeometry:
    """Ground across the whole window, with a hole or a notch, or neither, or a saw of them."""
    top = _number(rng, -4, 0, lattice)
    points = [(-9.0, top)]
    kind = rng.choice(("flat", "hole", "notch", "saw", "steps"))
    x = _number(rng, -4, 1, lattice)
    wide, deep = _number(rng, 1, 3, lattice), _number(rng, 1, 2, lattice)
    if kind == "hole":
        points += [(x, top), (x, top - deep), (x + wide, top - deep), (x + wide, top)]
    elif kind == "notch":
        points += [(x - wide, top), (x, top - deep), (x + wide, top)]
    elif kind == "saw":
        points += [(x + 0.5 * wide * k, top - deep * (k % 2)) for k in range(rng.randint(3, 6))]
    elif kind == "steps":
        points += [(x, top), (x, top - 1), (x + wide, top - 1), (x + wide, top - 2)]
    points += [(9.0, points[-1][1]), (9.0, -9.0), (-9.0, -9.0)]
    shape = shapely.Polygon(points)
    # on a lattice the ground may be any side of the window
    return shapely.affinity.rotate(shape, 90 * rng.choice((0, 0, 0, 1, 2, 3)), origin=(0, 0))


def _room(rng: Random, lattice: bool) -> BaseGeometry:
    """Walls around a room, which may have a door and may be square, round or slanted inside."""
    x, y = _point(rng, lattice, 3)
    half = _number(rng, 2, 3, lattice)
    outer = shapely.box(x - half, y - half, x + half, y + half)
    if rng.random() < 0.5:
        inner = shapely.box(x - half + 1, y - half + 1, x + half - 1, y + half - 1)
    else:
        inner = shapely.Point(x, y).buffer(half - 0.5, quad_segs=rng.choice((1, 2)))
    room = shapely.difference(outer, inner)
    if rng.random() < 0.5:
        room = shapely.difference(room, shapely.box(x, y, x + 1, y + half + 1))
    return room


SHAPES: tuple[Callable[[Random, bool], BaseGeometry], ...] = (
    _box, _box, _triangle, _slanted, _diamond, _ell, _floor, _floor, _room,
)  # fmt: skip


def _turned(shape: BaseGeometry, angle: float) -> BaseGeometry:
    return shapely.affinity.rotate(shape, angle, use_radians=True)


def _touching(rng: Random, shape: BaseGeometry, other: BaseGeometry) -> BaseGeometry:
    """The shape moved so that a vertex of it is one of the other's, or lies on its border."""
    own = rng.choice(shapely.get_coordinates(shape).tolist())
    ring = shapely.get_coordinates(other)
    place = rng.randrange(len(ring) - 1)
    theirs = ring[place]
    if rng.random() < 0.3:
        theirs = 0.5 * (ring[place] + ring[place + 1])
    return shapely.affinity.translate(shape, theirs[0] - own[0], theirs[1] - own[1])


# --- targets ----------------------------------------------------------------------------------


def random_target(
    rng: Random, space: ConfigurationSpace, direction: float, lattice: bool
) -> Region:
    """Edges, parts of edges, vertices, areas that touch contact space or not, and mixes."""
    kinds = rng.choices(("edge", "edge", "part", "vertex", "polygon", "both"), k=rng.randint(1, 3))
    edges: list[tuple[int, float, float]] = []
    vertices: list[int] = []
    area = Area.empty()
    for kind in kinds:
        edge = _aimed_edge(rng, space, direction)
        length = float(space.contact.length[edge])
        if kind == "edge":
            edges.append((edge, 0.0, length))
            for vertex in (edge, int(space.contact.next[edge])):
                if rng.random() < 0.7:
                    vertices.append(vertex)
        elif kind == "part":
            cuts = sorted(_share(rng, lattice) * length for _ in range(2))
            if cuts[1] - cuts[0] > 0.01 * length:
                edges.append((edge, cuts[0], cuts[1]))
        elif kind == "vertex":
            vertices.append(rng.choice((edge, int(space.contact.next[edge]))))
        else:
            about = None if kind == "polygon" else space.contact.points[edge].tolist()
            piece = areas.intersection(_patch(rng, lattice, about), space.free)
            area = piece if area.is_empty else areas.union(area, piece)
            if rng.random() < 0.7:
                inside = contact_in(space, piece)
                edges += inside[0]
                vertices += inside[1]
    return Region(area, _contact_set(space, edges, vertices))


def contact_in(
    space: ConfigurationSpace, area: Area
) -> tuple[list[tuple[int, float, float]], list[int]]:
    """The parts of contact edges in a closed area and on its border, and the vertices."""
    contact, near = space.contact, 4.0 * space.tolerance.length
    grown = area.geometry.buffer(near, join_style="mitre")
    edges = []
    for edge in contact.edges.tolist():
        start, end = contact.points[edge], contact.points[contact.next[edge]]
        inside = shapely.intersection(shapely.LineString([start, end]), grown)
        for part in shapely.get_parts(inside):
            ends = sorted(math.dist(start, point) for point in shapely.get_coordinates(part))
            if len(ends) >= 2 and ends[-1] - ends[0] > 100.0 * near:
                edges.append((edge, ends[0], ends[-1]))
    vertices = [
        vertex
        for vertex in contact.vertices.tolist()
        if grown.intersects(shapely.Point(contact.points[vertex]))
    ]
    return edges, vertices


def _contact_set(
    space: ConfigurationSpace, edges: list[tuple[int, float, float]], vertices: list[int]
) -> ContactSet:
    return ContactSet.of(
        [edge for edge, _, _ in edges],
        [low for _, low, _ in edges],
        [high for _, _, high in edges],
        [vertex for vertex in vertices if vertex in space.contact.vertices],
        space.tolerance.length,
    )


def _aimed_edge(rng: Random, space: ConfigurationSpace, direction: float) -> int:
    """A contact edge, mostly one that a motion along the direction runs into."""
    edges = space.contact.edges
    against = np.cos(space.contact.normal[edges] - direction - math.pi)
    if rng.random() < 0.8:
        facing = edges[against > 0.3]
        edges = facing if len(facing) else edges
    return int(rng.choice(edges.tolist()))


def _share(rng: Random, lattice: bool) -> float:
    return rng.choice((0.0, 0.25, 0.5, 0.75, 1.0)) if lattice else rng.random()


def _patch(rng: Random, lattice: bool, about: Sequence[float] | None) -> Area:
    """A box or a triangle, about a given point or anywhere."""
    x, y = _point(rng, lattice) if about is None else about
    wide, high = _number(rng, 1, 4, lattice), _number(rng, 1, 3, lattice)
    low = _number(rng, 0, 1, lattice)
    if rng.random() < 0.6:
        return Area.box(x - low * wide, y - low * high, x + wide, y + high)
    corners = np.array([(x - wide, y), (x + wide, y), (x, y + high * rng.choice((-1.0, 1.0)))])
    return Area.polygon(corners)
