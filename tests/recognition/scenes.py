"""Scenes and kernels by hand."""

import math
from collections.abc import Sequence

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.recognition.kernel import kernel
from preimage.recognition.readings import readings
from preimage.task.uncertainty import Uncertainty
from tests.strategies import contact_in
from tests.strategies import space_of as small_space_of

DOWN = -math.pi / 2
SENSES = Uncertainty(math.radians(10), 0.5, math.radians(10), (0.05, 0.05))
FRICTION = math.radians(20)
EXACT = 1e-8  # the windows are 20 wide: 1e-9 of the scene and less

Interval = tuple[int, float, float]


def space_of(obstacles: Sequence[BaseGeometry]) -> ConfigurationSpace:
    return small_space_of(obstacles, window=(-10, -10, 10, 10))


def goal(space: ConfigurationSpace, *polygons: Area) -> Region:
    """Polygons, with the contact on their border (paper 5.4)."""
    area = areas.intersection(areas.union(*polygons), space.free)
    edges, vertices = contact_in(space, area)
    return Region(area, contact(space, edges, vertices))


def contact(
    space: ConfigurationSpace, edges: Sequence[Interval], vertices: Sequence[int] = ()
) -> ContactSet:
    return ContactSet.of(
        [edge for edge, _, _ in edges],
        [low for _, low, _ in edges],
        [high for _, _, high in edges],
        list(vertices),
        space.tolerance.length,
    )


def kernel_of(
    space: ConfigurationSpace,
    target: Region,
    senses: Uncertainty = SENSES,
    domain: Region | None = None,
    direction: float = DOWN,
    friction: float = FRICTION,
) -> Region:
    sets = readings(space.contact, direction, senses, friction, space.tolerance)
    return kernel(space, sets, target, senses, domain)


def edge_at(space: ConfigurationSpace, x: float, y: float) -> int:
    """The contact edge through a point."""
    starts, ends = space.contact.points, space.contact.ends
    lines = shapely.linestrings(np.stack((starts, ends), axis=1))
    off = shapely.distance(lines, shapely.Point(x, y))
    off[space.contact.open] = np.inf
    assert np.min(off) < 1e-9
    return int(np.argmin(off))


def vertex_at(space: ConfigurationSpace, x: float, y: float) -> int:
    off = np.hypot(*(space.contact.points - (x, y)).T)
    assert np.min(off) < 1e-9
    return int(np.argmin(off))


def stretch(space: ConfigurationSpace, part: ContactSet, edge: int) -> list[list[float]]:
    """What of an edge belongs, as pairs of points."""
    on = part.edge == edge
    ends = [space.contact.at(part.edge[on], end[on]) for end in (part.low, part.high)]
    pairs = [sorted((low.tolist(), high.tolist())) for low, high in zip(*ends, strict=True)]
    return [[*first, *second] for first, second in pairs]


def assert_same_area(got: Area, expected: BaseGeometry, near: float = EXACT) -> None:
    shape = got.geometry
    thick = shapely.buffer(shapely.symmetric_difference(shape, expected), -near)
    assert thick.is_empty, shape.wkt


def disc(x: float, y: float, radius: float) -> BaseGeometry:
    return shapely.buffer(shapely.Point(x, y), radius, quad_segs=256)


BLOCK = shapely.box(-5, -6, 5, 0)
ROOM = shapely.difference(shapely.box(-10, -10, 10, 10), shapely.box(-4, 0, 4, 6))
CORNERS = [(-4.0, 0.0), (4.0, 0.0)]
