"""Halls of turned boxes, at most one a cell of a lattice, made without uniting anything."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area
from preimage.geometry.tolerance import Tolerance

Floats = NDArray[np.float64]


def boxes(count: int, seed: int = 0) -> Floats:
    """`(count, 4, 2)` corners, clockwise: boxes of any size and angle, apart from each other."""
    random = np.random.default_rng(seed)
    side = math.ceil(math.sqrt(count))
    cell = np.arange(count)
    center = np.stack((cell % side, cell // side), axis=1) + random.uniform(0.4, 0.6, (count, 2))
    half = random.uniform(0.07, 0.25, (count, 2))
    angle = random.uniform(0.0, math.pi, count)
    corner = np.array([[-1, -1], [-1, 1], [1, 1], [1, -1]]) * half[:, None]
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    turned = np.stack(
        (corner[..., 0] * cos - corner[..., 1] * sin, corner[..., 0] * sin + corner[..., 1] * cos),
        axis=-1,
    )
    return turned + center[:, None]


def hall(edges: int) -> tuple[ConfigurationSpace, Region]:
    """A hall with about so many contact edges, and its floor as the goal."""
    corners = boxes(edges // 4)
    side = float(math.ceil(math.sqrt(len(corners))))
    window = (0.0, -1.0, side, side + 1.0)
    outline = [(0.0, -1.0), (side, -1.0), (side, side + 1.0), (0.0, side + 1.0)]
    points = np.concatenate((outline, corners.reshape(-1, 2)))
    loop = np.arange(0, len(points), 4)[:, None] + np.array([1, 2, 3, 0])
    is_open = np.zeros(len(points), dtype=np.bool_)
    is_open[1:4] = True  # the floor is a wall
    contact = ContactSpace(points, loop.reshape(-1).astype(np.int32), is_open)
    tolerance = Tolerance.for_window(*window)
    space = ConfigurationSpace(window, tolerance, Area.empty(), Area.empty(), contact)
    floor = ContactSet.of([0], [0.0], [side], [], tolerance.length)
    return space, Region(Area.empty(), floor)


def united_by_geos(edges: int) -> None:
    """What GEOS does with the same boxes: unite them."""
    shapely.union_all(shapely.polygons(boxes(edges // 4)))
