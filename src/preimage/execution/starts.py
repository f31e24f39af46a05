"""Where runs begin: anywhere in a region, on its borders and at its vertices too."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from preimage.configuration.contact import Bools, Floats
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind
from preimage.execution.nearest import nearest
from preimage.execution.simulator import Robots
from preimage.geometry.clipping import reaches

RIM = 1e3
"""Starts on a border lie within it by so many tolerances: a border itself is a tie."""


def of_start(space: ConfigurationSpace, start: Start, count: int, rng: Generator) -> Robots:
    """So many robots anywhere in the start of a task."""
    contact = space.contact
    match start.kind:
        case StartKind.REGION:
            return of_region(space, start.region, count, rng)
        case StartKind.VERTEX:
            return Robots.at_vertices(contact, rng.choice(np.array(start.vertices), count))
        case StartKind.EDGE_POINT:
            edge = np.full(count, start.edge, dtype=np.int32)
            return Robots.on_edges(contact, edge, np.full(count, start.distance))
        case StartKind.FREE_POINT:
            return Robots.free(
                contact, np.tile(np.array(start.point, dtype=np.float64), (count, 1))
            )


def of_region(space: ConfigurationSpace, region: Region, count: int, rng: Generator) -> Robots:
    """So many robots in a region: inside its area, just inside its border, on edges, at vertices.

    Of a region that has several of these parts, all get their share.

    Raises
    ------
    ValueError : the region is empty, or too thin for any start.
    """
    groups = [
        found
        for found in (
            _inside(space, region, count, rng),
            _at_border(space, region, count, rng),
            _on_edges(space, region, count, rng),
            _at_vertices(space, region, count, rng),
        )
        if len(found)
    ]
    if not groups:
        raise ValueError("there is no place to start from")
    pick = rng.integers(len(groups), size=count)
    index = [rng.integers(len(group), size=count) for group in groups]
    offset = np.cumsum([0, *(len(group) for group in groups[:-1])])
    return Robots.together(*groups).part(np.choose(pick, index) + offset[pick])


def _inside(space: ConfigurationSpace, region: Region, count: int, rng: Generator) -> Robots:
    if region.area.is_empty:
        return Robots.free(space.contact, np.empty((0, 2)))
    xmin, ymin, xmax, ymax = region.area.bounds
    places = np.empty((0, 2))
    for _ in range(64):  # thin areas fill little of their box
        more = rng.random((4 * count, 2)) * (xmax - xmin, ymax - ymin) + (xmin, ymin)
        places = np.concatenate((places, more[_deep(space, region, more)]))
        if len(places) >= count:
            break
    return Robots.free(space.contact, places[:count])


def _at_border(space: ConfigurationSpace, region: Region, count: int, rng: Generator) -> Robots:
    starts, ends = region.area.segments
    if not len(starts):
        return Robots.free(space.contact, np.empty((0, 2)))
    along = ends - starts
    pick = rng.integers(len(starts), size=4 * count)
    part = rng.random(4 * count)
    part[: 2 * count] = np.round(part[: 2 * count])  # corners
    inward = np.stack((-along[pick, 1], along[pick, 0]), axis=1)
    inward /= np.maximum(np.hypot(inward[:, 0], inward[:, 1]), 1e-300)[:, None]
    # towards the middle of the edge as well, so that corners are not left on another border
    middle = starts[pick] + 0.5 * along[pick]
    places = starts[pick] + part[:, None] * along[pick]
    rim = 2.0 * RIM * space.tolerance.length
    back = middle - places
    reach = np.hypot(back[:, 0], back[:, 1])
    places = places + rim * (inward + back / np.maximum(reach, rim)[:, None])
    places = places[_deep(space, region, places)]
    return Robots.free(space.contact, places[:count])


def _deep(space: ConfigurationSpace, region: Region, places: Floats) -> Bools:
    """Which places are inside the area by more than the rim."""
    inside = region.area.contains_all(places)
    starts, ends = region.area.segments
    rim = RIM * space.tolerance.length
    gap = nearest(places, np.concatenate((starts, ends), axis=1)) - places
    return np.asarray(inside & (np.hypot(gap[:, 0], gap[:, 1]) > 0.5 * rim))


def _on_edges(space: ConfigurationSpace, region: Region, count: int, rng: Generator) -> Robots:
    inside, rim = region.contact, RIM * space.tolerance.length
    long = np.flatnonzero(inside.high - inside.low > 4.0 * rim)
    if not len(long):
        none = np.empty(0, dtype=np.int32)
        return Robots.on_edges(space.contact, none, np.empty(0))
    pick = long[rng.integers(len(long), size=count)]
    low, high = inside.low[pick] + rim, inside.high[pick] - rim
    part = rng.random(count)
    part = np.where(rng.random(count) < 0.25, np.round(part), part)
    return Robots.on_edges(space.contact, inside.edge[pick], low + part * (high - low))


def _at_vertices(space: ConfigurationSpace, region: Region, count: int, rng: Generator) -> Robots:
    vertices = region.contact.vertices
    if not len(vertices):
        return Robots.at_vertices(space.contact, vertices)
    return Robots.at_vertices(space.contact, rng.choice(vertices, count))


def is_in(space: ConfigurationSpace, region: Region, robots: Robots, slack: float) -> Bools:
    """(k,) which robots are in a region, up to some slack within the feature that they touch."""
    n = len(space.contact)
    found = np.zeros(len(robots), dtype=np.bool_)
    free = np.flatnonzero(robots.feature == 2 * n)
    found[free] = reaches(region.area, robots.places[free], slack)
    corner = np.flatnonzero((robots.feature >= n) & (robots.feature < 2 * n))
    found[corner] = np.isin(robots.feature[corner] - n, region.contact.vertices)
    on = np.flatnonzero(robots.feature < n)
    parts = region.contact
    for edge in np.unique(robots.feature[on]).tolist():
        here = on[robots.feature[on] == edge]
        own = parts.edge == edge
        low, high = parts.low[own] - slack, parts.high[own] + slack
        at = robots.along[here][:, None]
        found[here] = np.any((low <= at) & (at <= high), axis=1)
    return found
