"""The generalized damper carried out: many robots at once, event by event (theory 2)."""

from __future__ import annotations

from dataclasses import dataclass, fields
from enum import IntEnum
from typing import Self

import numpy as np
from numpy.typing import NDArray

from preimage import _native
from preimage.configuration.contact import Bools, ContactSpace, Floats, Ints
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.task.task import SlidingLaw

Bytes = NDArray[np.uint8]


class Wish(IntEnum):
    """What nature does where a convex vertex leaves her several choices."""

    ANY = 0  # one of them by chance
    REST = 1
    SLIDE = 2
    LEAVE = 3


class Manner(IntEnum):
    """How a robot moved."""

    FLIES = 0
    SLIDES = 1
    RESTS = 2
    ESCAPES = 3  # flew out through an open side


@dataclass(frozen=True, slots=True, eq=False)
class Robots:
    """Where robots are.

    Parameters
    ----------
    x, y : (k,) positions of the reference point.
    feature : (k,) what each touches: edge i is i, vertex i is n + i, free space is 2 n.
    along : (k,) on an edge, the distance from its start.
    """

    x: Floats
    y: Floats
    feature: Ints
    along: Floats

    def __len__(self) -> int:
        return len(self.feature)

    @property
    def places(self) -> Floats:
        """(k, 2) positions."""
        return np.stack((self.x, self.y), axis=1)

    def part(self, which: Bools | NDArray[np.intp]) -> Robots:
        """Some of them, as copies."""
        return Robots(self.x[which], self.y[which], self.feature[which], self.along[which])

    def put(self, which: NDArray[np.intp], robots: Robots) -> None:
        """Move some of them."""
        for field in fields(self):
            getattr(self, field.name)[which] = getattr(robots, field.name)

    @classmethod
    def together(cls, *groups: Robots) -> Robots:
        """All robots of several groups."""
        columns = (
            np.concatenate([getattr(g, field.name) for g in groups]) for field in fields(cls)
        )
        return cls(*columns)

    @classmethod
    def free(cls, contact: ContactSpace, places: Floats) -> Robots:
        """Robots in free space, at (k, 2) places."""
        count = len(places)
        feature = np.full(count, 2 * len(contact), dtype=np.int32)
        return cls(places[:, 0].copy(), places[:, 1].copy(), feature, np.zeros(count))

    @classmethod
    def on_edges(cls, contact: ContactSpace, edge: Ints, along: Floats) -> Robots:
        """Robots inside edges, at distances from their starts."""
        places = contact.at(edge, along)
        return cls(places[:, 0], places[:, 1], edge.astype(np.int32), np.asarray(along, np.float64))

    @classmethod
    def at_vertices(cls, contact: ContactSpace, vertex: Ints) -> Robots:
        """Robots at vertices."""
        places = contact.points[vertex]
        feature = (len(contact) + vertex).astype(np.int32)
        return cls(places[:, 0].copy(), places[:, 1].copy(), feature, np.zeros(len(vertex)))


@dataclass(frozen=True, slots=True, eq=False)
class Choices:
    """What nature chooses for each robot.

    Parameters
    ----------
    angle : (k,) the actual direction, radians.
    duration : (k,) how long she keeps it unless something is met, in units of length.
    wish : (k,) `Wish`, for convex vertices.
    chance : (k,) in [0, 1): which of the choices that the wish leaves.
    """

    angle: Floats
    duration: Floats
    wish: Bytes
    chance: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Moves:
    """What came of it.

    Parameters
    ----------
    robots : where they are now.
    time : (k,) how long it took, in units of length.
    between : (k,) the feature on the way: an edge that is slid on, free space, or where one rests.
    manner : (k,) `Manner`.
    """

    robots: Robots
    time: Floats
    between: Ints
    manner: Bytes


@dataclass(frozen=True, slots=True, eq=False)
class Simulator:
    """A scene in which robots move, ready for the compiled loop.

    Parameters
    ----------
    friction : phi, radians.
    gates : (4 g,) segments, from and to, just behind which a flight is interrupted: borders of
        what is to be looked at.
    mark_start, marks : (n + 1,), (m,) places on edges, by edge and ascending, just behind which a
        slide is interrupted.
    """

    space: ConfigurationSpace
    friction: float
    sliding: SlidingLaw
    gates: Floats
    mark_start: Ints
    marks: Floats
    _walls: tuple[Floats, Floats, Floats, Ints, Ints, Bytes, Bytes]

    @classmethod
    def of(
        cls,
        space: ConfigurationSpace,
        friction: float,
        sliding: SlidingLaw = SlidingLaw.PROJECTION,
        watched: Region | None = None,
    ) -> Self:
        """The simulator of a scene.

        Parameters
        ----------
        watched : moves are interrupted where they cross this region's border.
        """
        contact = space.contact
        watched = Region.empty() if watched is None else watched
        gates = np.concatenate(watched.area.segments, axis=1).ravel()
        edge = np.concatenate((watched.contact.edge, watched.contact.edge))
        place = np.concatenate((watched.contact.low, watched.contact.high))
        order = np.lexsort((place, edge))
        start = np.searchsorted(edge[order], np.arange(len(contact) + 1)).astype(np.int32)
        walls = (
            np.ascontiguousarray(contact.points, dtype=np.float64).ravel(),
            np.ascontiguousarray(contact.tangent, dtype=np.float64).ravel(),
            contact.length,
            contact.next,
            contact.previous,
            contact.open.view(np.uint8),
            contact.concave.view(np.uint8),
        )
        return cls(
            space, friction, sliding, np.ascontiguousarray(gates), start, place[order], walls
        )


def advance(simulator: Simulator, robots: Robots, choices: Choices) -> Moves:
    """Move every robot along its actual direction until something is met, or its time is over.

    Exact: a flight ends where it meets the first edge or vertex, a slide at the end of its edge,
    either just behind a gate or a mark; no step size is involved. What is nearer than the
    tolerance has met; directions within the tolerance of a friction cone stick. At a pinch a
    flight arrives at the vertex of the wedge that it came through.

    Returns
    -------
    One move each, under one actual direction.
    """
    tolerance = simulator.space.tolerance
    found = _native.advance(
        *simulator._walls,
        simulator.gates,
        simulator.mark_start,
        simulator.marks,
        simulator.friction,
        simulator.sliding is SlidingLaw.DAMPER,
        tolerance.length,
        tolerance.angle,
        robots.x,
        robots.y,
        robots.along,
        robots.feature,
        choices.angle,
        choices.duration,
        choices.chance,
        choices.wish,
    )
    x, y, along, feature, between, time, manner = found
    return Moves(Robots(x, y, feature, along), time, between, manner)
