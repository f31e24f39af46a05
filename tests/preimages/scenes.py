"""Small scenes and regions written by hand."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area
from preimage.preimages.setting import Setting
from preimage.task.task import SlidingLaw
from preimage.task.uncertainty import Uncertainty

Point = tuple[float, float]

DOWN = math.radians(270)


def edge_between(space: ConfigurationSpace, a: Point, b: Point) -> int:
    """The contact edge with these ends, in either order."""
    ends = np.stack((space.contact.points, space.contact.ends), axis=1)
    for pair in ((a, b), (b, a)):
        found = np.flatnonzero(np.abs(ends - np.array(pair)).max(axis=(1, 2)) < 1e-6)
        if len(found):
            return int(found[0])
    raise AssertionError(f"no edge from {a} to {b}")


def vertex_at(space: ConfigurationSpace, place: Point) -> int:
    """The vertex at a place."""
    off = np.hypot(*(space.contact.points - place).T)
    assert off.min() < 1e-6
    return int(np.argmin(off))


def contact(
    space: ConfigurationSpace,
    edges: Sequence[tuple[Point, Point]] = (),
    vertices: Sequence[Point] = (),
) -> Region:
    """Whole edges, without their ends, and vertices."""
    names = [edge_between(space, *edge) for edge in edges]
    lengths = space.contact.length[names].tolist() if names else []
    corners = [vertex_at(space, place) for place in vertices]
    found = ContactSet.of(names, [0.0] * len(names), lengths, corners, space.tolerance.length)
    return Region(Area.empty(), found)


def setting(
    space: ConfigurationSpace,
    control: float,
    friction: float,
    position: float,
    force: tuple[float, float, float] | None = (10.0, 0.05, 0.05),
    sliding: SlidingLaw = SlidingLaw.PROJECTION,
) -> Setting:
    """Bounds with angles in degrees; the force's are its angle and both thresholds, or None."""
    if force is None:
        senses = Uncertainty(math.radians(control), position)
    else:
        turn, low, high = force
        senses = Uncertainty(math.radians(control), position, math.radians(turn), (low, high))
    return Setting(space, senses, math.radians(friction), sliding, 0.005)
