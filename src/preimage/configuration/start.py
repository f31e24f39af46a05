"""Where the robot may be at the start of a plan."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import partial

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import ContactSpace, Floats
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.goals import clipped
from preimage.configuration.location import along_segment, edges_at, vertices_at
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import TaskError
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.geometry.border import border
from preimage.geometry.clipping import distances
from preimage.task.task import (
    Everywhere,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
    Task,
)

Point = tuple[float, float]

DISC_SIDES = 64
"""A disc becomes a polygon of so many sides around it, 0.12 % of its radius too far at most."""

ROUNDING = 4.0
"""Slivers so many spacings of the grid thick are what rounding leaves of equal areas."""

AWAY = 8.0
"""Anywhere is no nearer to an open side than so many tolerances: the robot has not escaped yet, nor
will it along such a side with perfect control, where the cone is as wide as the tolerance."""

PROBES = 64
"""The distance of a start from a region is taken at so many of its points at most."""


class StartKind(Enum):
    """What a start is."""

    FREE_POINT = "free point"
    EDGE_POINT = "point of an edge"
    VERTEX = "vertex"
    REGION = "region"


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """All that the plan may count on before the first motion (theory 5, 7).

    Parameters
    ----------
    kind : which of the other fields speak.
    point : where the robot is, unless it is somewhere in a region.
    edge, distance : the contact edge that holds an `EDGE_POINT`, and how far along it; else -1, 0.
    vertices : the contact vertices at a `VERTEX`, several at a pinch.
    region : where the robot may be, for a `REGION`; else empty.
    """

    kind: StartKind
    point: Point | None
    edge: int
    distance: float
    vertices: tuple[int, ...]
    region: Region

    @classmethod
    def anywhere_in(cls, region: Region) -> Start:
        """Somewhere in a region."""
        return cls(StartKind.REGION, None, -1, 0.0, (), region)


def start_region(task: Task, space: ConfigurationSpace) -> Start:
    """The start of a task.

    An area means its free space, its edges and the concave vertices in it: a robot is not put
    on a tip, unless the tip is named as a point. An edge means the open edge and its concave ends.
    A disc is replaced by a polygon that contains it. Anywhere is anywhere but on an open side of
    the window, where the robot would have escaped.

    Raises
    ------
    TaskError : a point inside an obstacle, outside the window or on an open side of it; an edge
        that does not lie in contact space; an area of which nothing is left in valid space.
    """
    match task.initial:
        case InitialPoint(point=point):
            return _point(point, space)
        case InitialDisc(center=center, radius=radius):
            return _area(_around_disc(center, radius), space, "initial.disc")
        case InitialPolygon(vertices=vertices):
            polygon = Area.polygon(np.asarray(vertices, dtype=np.float64))
            return _area(polygon, space, "initial.polygon")
        case InitialEdges(edges=edges):
            return _edges(edges, space)
        case Everywhere():
            whole = Region(_off_open_sides(space), contact_set.inner(space.contact))
            return Start.anywhere_in(
                Region(whole.area, _without_tips(whole.contact, space.contact))
            )


def covered(start: Start, region: Region, space: ConfigurationSpace) -> bool:
    """Whether the robot is in the region, wherever in the start it is.

    Without slack: what the region leaves out may be as thin as the line above a tip. Free
    configurations must be inside by more than the tolerance: with perfect control, a border may be
    a line along which nature leads astray.
    """
    near = space.tolerance.length
    if start.kind is StartKind.REGION:
        inside = start.region
        area, slivers = inside.area, ROUNDING * space.tolerance.grid
        if not contact_set.is_subset(inside.contact, region.contact, near):
            return False
        if area.is_empty:
            return True
        if not areas.is_subset(area, region.area, slivers):  # the quicker test
            return False
        grown = areas.intersection(inflate.grow(area, near), space.free)
        return areas.is_subset(grown, region.area, slivers)
    if start.kind is StartKind.EDGE_POINT:
        return region.contact.contains(start.edge, start.distance, 0.0)
    if start.kind is StartKind.VERTEX:
        return all(region.contact.has_vertex(vertex) for vertex in start.vertices)
    assert start.point is not None
    return region.area.contains(*start.point) and region.area.depth(*start.point) > near


def _point(point: Point, space: ConfigurationSpace) -> Start:
    key = "initial.point"
    near = space.tolerance.length
    x, y = point
    xmin, ymin, xmax, ymax = space.window
    if not (xmin - near <= x <= xmax + near and ymin - near <= y <= ymax + near):
        raise TaskError(key, f"({x:.6g}, {y:.6g}) is outside the window")
    at = partial(Start, point=point, region=Region.empty())
    vertices = vertices_at(space.contact, point, near)
    if np.any(np.isin(vertices, space.contact.outermost)):
        raise TaskError(key, f"({x:.6g}, {y:.6g}) is on an open side of the window")
    if len(vertices):
        corner = tuple(vertices.tolist())
        return at(StartKind.VERTEX, edge=-1, distance=0.0, vertices=corner)
    edges, along = edges_at(space.contact, point, near)
    if np.any(space.contact.open[edges]):
        raise TaskError(key, f"({x:.6g}, {y:.6g}) is on an open side of the window")
    if len(edges):
        return at(StartKind.EDGE_POINT, edge=int(edges[0]), distance=float(along[0]), vertices=())
    if not space.free.contains(x, y):
        raise TaskError(key, f"({x:.6g}, {y:.6g}) is inside an obstacle")
    return at(StartKind.FREE_POINT, edge=-1, distance=0.0, vertices=())


def _off_open_sides(space: ConfigurationSpace) -> Area:
    """Free space but for what is all but on an open side of the window."""
    contact = space.contact
    sides = np.flatnonzero(contact.open)
    pieces = inflate.stadium_pieces(
        contact.points[sides],
        contact.ends[sides],
        AWAY * space.tolerance.length,
        inflate.tangent_normals(inflate.ARC_TOLERANCE),
    )
    return areas.regularised(inflate.shrunk_by(space.free, pieces), space.tolerance.length)


def _area(area: Area, space: ConfigurationSpace, key: str) -> Start:
    inside, contact = clipped(area, space)
    contact = _without_tips(contact, space.contact)
    if inside.is_empty and contact.is_empty:
        raise TaskError(key, "nothing of it is left in valid space")
    return Start.anywhere_in(Region(inside, contact))


def _edges(edges: tuple[tuple[Point, Point], ...], space: ConfigurationSpace) -> Start:
    near = space.tolerance.length
    contact = ContactSet.empty()
    for place, (begin, end) in enumerate(edges):
        found = along_segment(space.contact, begin, end, near, f"initial.edges[{place}]")
        contact = contact_set.union(contact, found, near)
    return Start.anywhere_in(Region(Area.empty(), _without_tips(contact, space.contact)))


def _without_tips(contact: ContactSet, space: ContactSpace) -> ContactSet:
    """A contact set without its convex vertices."""
    vertices = contact.vertices
    return ContactSet(contact.edge, contact.low, contact.high, vertices[space.concave[vertices]])


def _around_disc(center: Point, radius: float) -> Area:
    """A regular polygon around a disc."""
    turn = 2.0 * np.pi * (np.arange(DISC_SIDES) + 0.5) / DISC_SIDES
    reach = radius / np.cos(np.pi / DISC_SIDES)
    circle = np.stack((np.cos(turn), np.sin(turn)), axis=1)
    return Area.polygon(np.asarray(center, dtype=np.float64) + reach * circle)


def distance_to(start: Start, region: Region, space: ConfigurationSpace) -> float:
    """How far the robot may be from a region at the start: 0 within, infinite from nothing.

    For a start that is a region, the largest distance of some of its corners: a measure to rank
    regions by, not a bound.
    """
    contact = region.contact
    low, high = (space.contact.at(contact.edge, at) for at in (contact.low, contact.high))
    corners = space.contact.points[contact.vertices]
    apart = distances(
        _probes(start, space.contact),
        region.area,
        np.concatenate((low, corners)),
        np.concatenate((high, corners)),
    )
    return float(np.max(apart))


def _probes(start: Start, contact: ContactSpace) -> Floats:
    """Points of a start that stand for it."""
    if start.point is not None:
        return np.array([start.point], dtype=np.float64)
    found = start.region.contact
    points = np.concatenate(
        (
            border(start.region.area)[0],
            contact.at(found.edge, found.low),
            contact.at(found.edge, found.high),
            contact.points[found.vertices],
        )
    )
    return points[:: max(1, -(-len(points) // PROBES))]
