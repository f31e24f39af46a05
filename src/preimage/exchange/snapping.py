"""A task looked at in configuration space: goal edges moved onto it, the rest refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from preimage.configuration.contact import ContactSpace, Floats
from preimage.configuration.goals import goal_region
from preimage.configuration.location import along_segment, vertices_at
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.start import start_region
from preimage.errors import TaskError
from preimage.task.goal import Goal
from preimage.task.task import Task

Point = tuple[float, float]
Segment = tuple[Point, Point]


def snapped(task: Task, reach: float) -> tuple[Task, float]:
    """The task with its goal edges and points on contact space, and how far they were moved.

    Parameters
    ----------
    reach : how far an end may be moved, a length; at 0 none is. What lies on contact space stays.

    Raises
    ------
    TaskError : goal or start do not lie in valid space.
    """
    space = configuration_space(task)
    moved = 0.0
    if reach > 0.0:
        near = space.tolerance.length
        edges = [_edge(edge, space.contact, near, reach) for edge in task.goal.edges]
        points = [_vertex(point, space.contact, near, reach) for point in task.goal.points]
        goal = Goal(
            tuple(edge for edge, _ in edges),
            task.goal.polygons,
            tuple(point for point, _ in points),
        )
        moved = max([off for _, off in (*edges, *points)], default=0.0)
        task = replace(task, goal=goal)
    goal_region(task, space)
    start_region(task, space)
    return task, moved


def _edge(edge: Segment, contact: ContactSpace, near: float, reach: float) -> tuple[Segment, float]:
    """The nearest part of one contact edge, if that is in reach."""
    try:
        along_segment(contact, *edge, near, "")
    except TaskError:
        pass
    else:
        return edge, 0.0
    edges = contact.edges
    if not len(edges):
        return edge, 0.0
    feet = [_feet(contact, np.array(end, dtype=np.float64)) for end in edge]
    apart = np.maximum(
        *(np.hypot(*(foot - np.array(end)).T) for foot, end in zip(feet, edge, strict=True))
    )
    best = int(np.argmin(apart))
    a, b = (foot[best] for foot in feet)
    if apart[best] > reach or np.hypot(*(b - a)) <= near:
        return edge, 0.0
    return (_point(a), _point(b)), float(apart[best])


def _feet(contact: ContactSpace, point: Floats) -> Floats:
    """`(m, 2)` of each contact edge the point that is nearest."""
    starts, ends = contact.points[contact.edges], contact.ends[contact.edges]
    tangents, lengths = contact.tangent[contact.edges], contact.length[contact.edges]
    along = np.einsum("ij,ij->i", point - starts, tangents)
    feet: Floats = starts + np.clip(along, 0.0, lengths)[:, None] * tangents
    # exactly the ends, where those are nearest
    feet = np.where((along <= 0.0)[:, None], starts, feet)
    return np.where((along >= lengths)[:, None], ends, feet)


def _vertex(point: Point, contact: ContactSpace, near: float, reach: float) -> tuple[Point, float]:
    """The nearest contact vertex, if that is in reach."""
    if not len(contact.vertices) or len(vertices_at(contact, point, near)):
        return point, 0.0
    places = contact.points[contact.vertices]
    apart = np.hypot(*(places - np.array(point, dtype=np.float64)).T)
    best = int(np.argmin(apart))
    return (_point(places[best]), float(apart[best])) if apart[best] <= reach else (point, 0.0)


def _point(place: Floats) -> Point:
    return float(place[0]), float(place[1])
