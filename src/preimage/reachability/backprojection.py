"""Maximal backprojections, by one sweep against the commanded direction."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from preimage import _native
from preimage.configuration.contact import Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.display import Shown
from preimage.geometry import area as areas
from preimage.geometry.angles import unit
from preimage.geometry.area import Area
from preimage.geometry.tolerance import ANGLE
from preimage.reachability.assembly import Attachment, attach
from preimage.reachability.sources import Sources

Floats = NDArray[np.float64]

OPEN = np.uint8(16)
"""The sweep's own bit beside those of `Behaviour`: an open side of the window."""

FINER = 16.0
"""Heights in the sweep are multiples of the grid over this: level up to rounding is level."""

TURN = 8.0 * ANGLE
"""By how much a sweep is turned, radians, that rounding has spoiled."""


@dataclass(frozen=True, eq=False)
class Backprojection(Shown):
    """The starts from which every motion along one command meets a target (theory 4).

    Parameters
    ----------
    space : where.
    target : the region that is met.
    direction : the commanded direction, radians.
    rays : (r, 2, 2) the rays that bound it inside free space, from the feature where nature can
        hold the robot up, or lead it astray, to where they end.
    events : how many points the sweep stopped at.
    """

    space: ConfigurationSpace
    target: Region
    direction: float
    rays: Floats
    events: int
    _rings: tuple[Floats, Ints, Ints]
    _contact: tuple[Ints, Floats, Floats, NDArray[np.uint8]]

    @cached_property
    def region(self) -> Region:
        """The starts, as a region: its area is closed; contact belongs as its features say."""
        edge, low, high, vertex = self._contact
        vertices = np.flatnonzero(vertex).astype(np.int32)
        return Region(Area.from_rings(*self._rings), ContactSet(edge, low, high, vertices))


def backproject(space: ConfigurationSpace, target: Region, command: Sources) -> Backprojection:
    """The maximal backprojection `B(T, v)` of a target.

    `B` holds the starts from which every admissible trajectory meets `T`. Its complement is the
    least set that contains what may stick outside `T` and the open sides of the window, and every
    start from which some motion reaches that set without meeting `T` (theory 4, paper 5.2). One
    sweep against `v` finds it, for every friction and every control uncertainty below a right
    angle, in O((n + m) log(n + m)) for `n` contact edges and `m` edges of the target; after
    Donald (1987), who needed friction larger than the control uncertainty.

    Ties (a ray through a vertex, an edge along a side of the control cone) are decided for nature.
    With no control uncertainty the cone has the half-angle of the angle tolerance.

    Parameters
    ----------
    target : areas, intervals of edges and vertices in any mix; its area is part of free space.
    command : from `sources`, of the same contact space.
    """
    if target.is_empty:
        return _nowhere(space, target, command)
    attachment = attach(target.area, space)
    for turn in (0.0, TURN, -TURN):
        result = _sweep(space, target, attachment, command, turn)
        if result is not None:
            return result
    # the border of the target's area crosses contact space by more than rounding: what is well
    # inside the area attaches to nothing
    core = areas.shrunk(target.area, 4.0 * space.tolerance.length)
    smaller = Region(core, target.contact)
    result = _sweep(space, smaller, attach(core, space), command, TURN)
    return result if result is not None else _nowhere(space, target, command)


def _sweep(
    space: ConfigurationSpace,
    target: Region,
    attachment: Attachment,
    command: Sources,
    turn: float = 0.0,
) -> Backprojection | None:
    """One run of the sweep; None where rounding spoils the order of what it meets.

    Turned by a little, with a control cone that is wider by as much, the plane is free of the
    coincidences that cause this, and the backprojection only smaller.
    """
    contact, tolerance = space.contact, space.tolerance
    vx, vy = unit(command.direction + turn)
    spread = math.tan(max(command.control, tolerance.angle) + abs(turn))
    consistent, points, start, shell, edge, low, high, vertex, rays, events = _native.backproject(
        contact.points.reshape(-1),
        contact.next,
        contact.place,
        command.edges | (contact.open * OPEN),
        command.vertices,
        target.contact.edge,
        target.contact.low,
        target.contact.high,
        target.contact.vertices,
        attachment.beside_edge,
        attachment.beside_low,
        attachment.beside_high,
        attachment.nodes.reshape(-1),
        attachment.node_vertex,
        attachment.node_edge,
        attachment.node_distance,
        attachment.segment_from,
        attachment.segment_to,
        vx,
        vy,
        tolerance.grid / FINER,
        spread,
        tolerance.length,
    )
    if not consistent:
        return None
    return Backprojection(
        target=target,
        direction=command.direction,
        rays=rays.reshape(-1, 2, 2),
        events=events,
        space=space,
        _rings=(points.reshape(-1, 2), start, shell),
        _contact=(edge, low, high, vertex),
    )


def _nowhere(space: ConfigurationSpace, target: Region, command: Sources) -> Backprojection:
    empty = np.empty(0)
    none = np.empty(0, dtype=np.int32)
    return Backprojection(
        target=target,
        direction=command.direction,
        rays=np.empty((0, 2, 2)),
        events=0,
        space=space,
        _rings=(np.empty((0, 2)), np.zeros(1, dtype=np.int32), none),
        _contact=(none, empty, empty, np.zeros(len(space.contact), dtype=np.uint8)),
    )
