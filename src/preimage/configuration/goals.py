"""The goal of a task as a region of valid space."""

from __future__ import annotations

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import ContactSpace, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.location import along_segment, inside_area, vertices_at
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import TaskError
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.overlay import common, united
from preimage.task.task import Task

Point = tuple[float, float]


def goal_region(task: Task, space: ConfigurationSpace) -> Region:
    """The goal: edges with their end vertices, polygons with the contact in them, vertices.

    A polygon is clipped to free space; the contact edges and vertices inside it and on its border
    belong too (paper 5.4). What belongs by its place belongs at a pinch to all wedges there.

    Raises
    ------
    TaskError : an edge does not lie in contact space, nothing is left of a polygon in valid
        space, or a point is no contact vertex.
    """
    near = space.tolerance.length
    contact = ContactSet.empty()
    for place, (start, end) in enumerate(task.goal.edges):
        key = f"goal.edges[{place}]"
        found = along_segment(space.contact, start, end, near, key)
        contact = contact_set.union(contact, found, near)
    parts: list[Area] = []
    for place, vertices in enumerate(task.goal.polygons):
        area, found = clipped(Area.polygon(np.asarray(vertices, dtype=np.float64)), space)
        if area.is_empty and found.is_empty:
            raise TaskError(f"goal.polygons[{place}]", "nothing of it is left in valid space")
        contact = contact_set.union(contact, found, near)
        parts.append(area)
    for place, point in enumerate(task.goal.points):
        corner = _vertices(space.contact, point, near, f"goal.points[{place}]")
        found = ContactSet.of([], [], [], corner, near)
        contact = contact_set.union(contact, found, near)
    return Region(united(parts, space.tolerance.grid), contact)


def clipped(area: Area, space: ConfigurationSpace) -> tuple[Area, ContactSet]:
    """The part of an area in free space, and all of contact space in it and on its border."""
    near = space.tolerance.length
    inside = areas.regularised(common(area, space.free, space.tolerance.grid), near)
    return inside, inside_area(space.contact, area, near)


def _vertices(contact: ContactSpace, point: Point, near: float, key: str) -> Ints:
    """The contact vertices at a point that must be one."""
    found = vertices_at(contact, point, near)
    if len(found):
        return found
    if not len(contact.vertices):
        raise TaskError(key, "is no contact vertex: there is none")
    places = contact.points[contact.vertices]
    apart = np.hypot(*(places - np.asarray(point, dtype=np.float64)).T)
    best = int(np.argmin(apart))
    x, y = places[best]
    raise TaskError(
        key, f"is no contact vertex: the nearest, ({x:.6g}, {y:.6g}), is {apart[best]:.3g} away"
    )
