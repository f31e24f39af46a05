"""Which of several goals a reading tells: what confuses them, and where together they are told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.angles import TAU
from preimage.recognition.outside import Domain, contact_segments, outside
from preimage.recognition.readings import Readings, alike, alike_pairs
from preimage.recognition.surroundings import Meetings, meetings, surroundings
from preimage.task.uncertainty import Uncertainty

Forces = list[tuple[float, float]]
"""Disjoint closed intervals of angles, ascending; relative to one that is fixed."""


def confusion_radius(space: ConfigurationSpace, uncertainty: Uncertainty) -> float:
    """What is further apart than this is told apart by position; see `kernel`."""
    near = space.tolerance.length
    return 2.0 * max(uncertainty.position, near) + near


def told_apart(
    space: ConfigurationSpace,
    readings: Readings,
    part: ContactSet,
    others: ContactSet,
    uncertainty: Uncertainty,
) -> ContactSet:
    """What of a part of contact space no reading confuses with any of some others (theory 5, 7).

    `part - U_{Y alike X} (others Y (+) D(2 rho))`, feature by feature, as a kernel.
    """
    if part.is_empty or others.is_empty:
        return part
    n = readings.size
    if np.isinf(uncertainty.position):
        features = np.concatenate((others.edge, n + others.vertices))
        edge, corner = np.ones(len(part.edge), np.bool_), np.ones(len(part.vertices), np.bool_)
        for other in np.unique(features).tolist():
            edge &= ~alike(readings, other, part.edge)
            corner &= ~alike(readings, other, n + part.vertices)
        return ContactSet(part.edge[edge], part.low[edge], part.high[edge], part.vertices[corner])
    segments = contact_segments(space.contact, others)
    near = meetings(space, part, segments, confusion_radius(space, uncertainty))
    met = alike_pairs(readings, near.edge, near.edge_other)
    confused = alike_pairs(readings, n + near.vertex, near.vertex_other)
    cut = ContactSet(
        near.edge[met], near.near[met], near.far[met], np.unique(near.vertex[confused])
    )
    return contact_set.difference(part, cut, space.tolerance.length)


def told_together(
    space: ConfigurationSpace,
    readings: Readings,
    goals: Sequence[Region],
    vertices: Ints,
    uncertainty: Uncertainty,
    domain: Domain = None,
) -> Ints:
    """The vertices at which every reading tells some goal, though not all the same one.

    A vertex pushes back like either of its edges; what is read there may be mistaken for the one
    edge or for the other. Where one goal holds the one, and another goal the other, each force
    that can be read leaves a goal that holds all that is consistent with it, wherever the position
    is read. On the hill of Figure 20 the top's corners are told in this way alone (paper 8).

    Parameters
    ----------
    vertices : candidates.
    """
    doubts = Doubts.at(readings, vertices)
    for goal in goals:
        if not np.isinf(uncertainty.position) and len(doubts.among(goal)):
            near = surroundings(space, goal, confusion_radius(space, uncertainty), domain).meetings
            doubts.narrow(space, readings, goal, near, domain)
        else:
            doubts.narrow(space, readings, goal, None, domain)
    return doubts.settled


@dataclass(slots=True, eq=False)
class Doubts:
    """What can be read at vertices that tells none of the goals seen so far.

    Parameters
    ----------
    left : for each vertex whether 0 is such a reading, and which forces are; angles relative to
        the middle of what can be read there.
    """

    left: dict[int, tuple[bool, Forces]]

    @classmethod
    def at(cls, readings: Readings, vertices: Ints) -> Doubts:
        """All that can be read at vertices."""
        return cls({int(vertex): _all_forces(readings, int(vertex)) for vertex in vertices})

    @property
    def settled(self) -> Ints:
        """The vertices at which every reading tells some goal."""
        told = [vertex for vertex, (zero, forces) in self.left.items() if not zero and not forces]
        return np.array(sorted(told), dtype=np.int32)

    def among(self, goal: Region) -> list[int]:
        """The vertices in doubt that a goal holds."""
        open_ = (vertex for vertex, (zero, forces) in self.left.items() if zero or forces)
        return [vertex for vertex in open_ if goal.contact.has_vertex(vertex)]

    def narrow(
        self,
        space: ConfigurationSpace,
        readings: Readings,
        goal: Region,
        near: Meetings | None,
        domain: Domain = None,
    ) -> None:
        """Take away the readings that tell one more goal.

        Parameters
        ----------
        near : what is near to the goal's contact outside it; None without a position sensor: then
            all is near.
        """
        inside = self.among(goal)
        every = _outside(space, readings, goal, domain) if near is None and inside else None
        for vertex in inside:
            if near is not None:
                others = near.vertex_other[near.vertex == vertex]
            else:
                assert every is not None
                others = every
            zero, forces = self.left[vertex]
            here = _in_common(readings, vertex, others)
            self.left[vertex] = zero and here[0], _both(forces, here[1])


def _outside(space: ConfigurationSpace, readings: Readings, goal: Region, domain: Domain) -> Ints:
    """All features that have a part outside a goal."""
    rest = outside(space, goal, domain)
    others = [rest.contact.edge, readings.size + rest.contact.vertices]
    if not rest.area.is_empty:
        others.append(np.array([readings.free], dtype=np.int32))
    return np.unique(np.concatenate(others)).astype(np.int32)


def _all_forces(readings: Readings, vertex: int) -> tuple[bool, Forces]:
    """All that can be read at a vertex; angles relative to the middle of its interval."""
    feature = readings.size + vertex
    half = float(readings.half[feature])
    return bool(readings.zero[feature]), [(-half, half)] if half >= 0.0 else []


def _in_common(readings: Readings, vertex: int, others: Ints) -> tuple[bool, Forces]:
    """What can be read at a vertex and at some of the other features too."""
    feature = readings.size + vertex
    zero = bool(readings.zero[feature]) and bool(np.any(readings.zero[others]))
    center, half = float(readings.center[feature]), float(readings.half[feature])
    if half < 0.0:
        return zero, []
    shared: Forces = []
    for other in np.unique(others[readings.half[others] >= 0.0]).tolist():
        reach = float(readings.half[other]) + readings.tolerance
        off = (float(readings.center[other]) - center + np.pi) % TAU - np.pi
        for turn in (-TAU, 0.0, TAU):
            low, high = max(-half, off + turn - reach), min(half, off + turn + reach)
            if low <= high:
                shared.append((low, high))
    return zero, _joined(shared)


def _joined(intervals: Forces) -> Forces:
    """The union of intervals, disjoint and ascending."""
    found: Forces = []
    for low, high in sorted(intervals):
        if found and low <= found[-1][1]:
            found[-1] = found[-1][0], max(found[-1][1], high)
        else:
            found.append((low, high))
    return found


def _both(first: Forces, second: Forces) -> Forces:
    """The intersection of two unions of intervals."""
    return [(max(a, c), min(b, d)) for a, b in first for c, d in second if max(a, c) <= min(b, d)]
