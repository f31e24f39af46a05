"""Forward projections: where a motion may go, by sweeps along the commanded direction."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from preimage import _native
from preimage.configuration import contact_set
from preimage.configuration.contact import Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.angles import unit
from preimage.geometry.area import Area
from preimage.geometry.inflate import without_slivers
from preimage.mechanics.behaviour import Codes
from preimage.reachability.assembly import Attachment, attach
from preimage.reachability.backprojection import FINER, TURN
from preimage.reachability.passages import QUARTER, Passage, passages

Floats = NDArray[np.float64]

APART = 4.0
"""The area of a start is kept so many tolerances away from that of a stop set."""


@dataclass(frozen=True, eq=False)
class ForwardProjection:
    """The points that motions along one command may visit, until they are stopped (theory 4).

    Parameters
    ----------
    space : where.
    start, stop : the region that motions start from, and the set at which they end.
    direction : the commanded direction, radians.
    open_sides : the open sides of the window that are met, as edges: there the robot has escaped.
    sweeps : how often the plane was swept.
    """

    space: ConfigurationSpace
    start: Region
    stop: Region
    direction: float
    open_sides: Ints
    sweeps: int
    _rings: tuple[Floats, Ints, Ints]
    _contact: tuple[Ints, Floats, Floats, NDArray[np.uint8]]
    _more: Area

    @property
    def escapes(self) -> bool:
        """Whether some motion leaves the window."""
        return len(self.open_sides) > 0

    @cached_property
    def region(self) -> Region:
        """What is visited, as a region: its area is closed; contact belongs as its features say."""
        edge, low, high, vertex = self._contact
        contact = self.space.contact
        vertices = np.intersect1d(np.flatnonzero(vertex), contact.vertices).astype(np.int32)
        area = Area.from_rings(*_without_cracks(*self._rings, self.space.tolerance.length))
        if not self._more.is_empty:
            area = areas.union(area, self._more)
        return Region(area, ContactSet(edge, low, high, vertices))


@dataclass(frozen=True, slots=True, eq=False)
class _Given:
    """A start or a stop set as the sweep takes it."""

    contact: ContactSet
    attachment: Attachment
    whole: bool
    """All of the area is there."""

    def arrays(self) -> tuple[Ints | Floats, ...]:
        contact, border = self.contact, self.attachment
        return (
            contact.edge,
            contact.low,
            contact.high,
            contact.vertices,
            border.beside_edge,
            border.beside_low,
            border.beside_high,
            border.nodes.reshape(-1),
            border.node_vertex,
            border.node_edge,
            border.node_distance,
            border.segment_from,
            border.segment_to,
        )


def forward_project(
    space: ConfigurationSpace,
    start: Region,
    direction: float,
    control: float,
    friction: float,
    stop: Region | None = None,
) -> ForwardProjection:
    """The forward projection `FP_v(R)`, with a stop set `Z` if one is given.

    It holds all points that some admissible trajectory from `R` visits: free flight in the control
    cone, leaving an edge, and every slide that some `v*` makes, the slides that go back among them
    (where `theta > phi`). With `Z`, it holds the points visited by trajectories that have not met
    `Z` before; `Z` is met, not crossed: its points at which they arrive belong, and so do those of
    `R` (theory 4). A sweep along `v` follows all motions but the slides that go back; those are
    followed along contact space, and the plane is swept anew until nothing is added. That is
    O(k (n + m) log(n + m)) for `n` contact edges, `m` edges of `R` and `Z`, and `k` sweeps; one
    where `theta <= phi`.

    The answer errs on the larger side: ties (a ray through a vertex, an edge along a side of the
    control cone) are nature's, so that a start should be pulled in by a few tolerances where its
    border is nature's line, as that of a backprojection is. With no control uncertainty the cone
    has the half-angle of the angle tolerance: what falls from a wall is thinner than any area that
    others see; who needs one allows for a control of 1e-7. Where rounding spoils the order of what
    the sweep meets, in planes turned by a little too, the answer is all of valid space.

    Parameters
    ----------
    start, stop : areas, intervals of edges and vertices in any mix; their areas are part of free
        space.
    direction, control, friction : v, theta and phi, radians.

    From a square, downwards, onto a floor that sticks: it spreads by the height times `tan(theta)`.

    >>> from preimage.configuration.contact import ContactSpace
    >>> from preimage.geometry.tolerance import Tolerance
    >>> window = (-4.0, 0.0, 4.0, 4.0)
    >>> border = ContactSpace(
    ...     points=np.array([(-4.0, 0.0), (4.0, 0.0), (4.0, 4.0), (-4.0, 4.0)]),
    ...     next=np.array([1, 2, 3, 0], dtype=np.int32),
    ...     open=np.array([False, True, True, True]),
    ... )
    >>> free, none = Area.box(*window), Area.empty()
    >>> space = ConfigurationSpace(window, Tolerance.for_window(*window), free, none, border)
    >>> start = Region(Area.box(-1.0, 1.0, 1.0, 2.0), ContactSet.empty())
    >>> found = forward_project(space, start, -0.5 * math.pi, math.atan(0.5), 1.0)
    >>> found.region.contact.low.round(9), found.region.contact.high.round(9), found.escapes
    (array([2.]), array([6.]), False)
    >>> round(found.region.area.measure, 9)
    6.0
    """
    code = passages(space.contact, direction, control, friction, space.tolerance)
    return flood(space, start, direction, control, code, stop)


def flood(
    space: ConfigurationSpace,
    start: Region,
    direction: float,
    control: float,
    code: Codes,
    stop: Region | None = None,
) -> ForwardProjection:
    """The forward projection of motions whose passage at each edge is given.

    Parameters
    ----------
    code : (n,) bits of `Passage`, by edge.
    """
    stop = Region.empty() if stop is None else stop
    if start.is_empty:
        return _nowhere(space, start, stop, direction)
    least = space.tolerance.angle
    spread = min(max(control, least), QUARTER - TURN - least)
    # where a border crosses contact space by more than rounding, what is well inside does not
    for margin in (0.0, APART * space.tolerance.length):
        given = _begin(space, start, stop, code, margin), _until(space, stop, margin)
        for turn in (0.0, TURN, -TURN):
            found = _sweep(space, given, code, direction + turn, spread + abs(turn))
            if found is not None:
                more = Area.empty() if given[0].whole else start.area
                return ForwardProjection(space, start, stop, direction, *found, more)
    return _everywhere(space, start, stop, direction)


_Found = tuple[Ints, int, tuple[Floats, Ints, Ints], tuple[Ints, Floats, Floats, NDArray[np.uint8]]]


def _sweep(
    space: ConfigurationSpace,
    given: tuple[_Given, _Given],
    code: Codes,
    direction: float,
    spread: float,
) -> _Found | None:
    """The sweeps in one plane; None where rounding spoils the order of what they meet."""
    contact, tolerance = space.contact, space.tolerance
    vx, vy = unit(direction)
    consistent, points, ring, shell, edge, low, high, vertex, escapes, sweeps = (
        _native.forward_project(
            contact.points.reshape(-1),
            contact.next,
            contact.place,
            code,
            given[0].arrays(),
            given[1].arrays(),
            vx,
            vy,
            tolerance.grid / FINER,
            math.tan(spread),
            tolerance.length,
        )
    )
    if not consistent:
        return None
    met = np.flatnonzero(escapes).astype(np.int32)
    return met, sweeps, (points.reshape(-1, 2), ring, shell), (edge, low, high, vertex)


def _until(space: ConfigurationSpace, stop: Region, margin: float) -> _Given:
    """A stop set, its area shrunk by a margin: that stops less."""
    area = areas.shrunk(stop.area, margin) if margin > 0.0 else stop.area
    return _Given(stop.contact, attach(area, space), whole=True)


def _begin(
    space: ConfigurationSpace, start: Region, stop: Region, code: Codes, margin: float
) -> _Given:
    """A start, its area kept away from that of the stop set, and shrunk by a margin.

    Edges to which motions come straight from what this leaves out are part of the start.
    """
    tolerance, grid = space.tolerance.length, space.tolerance.grid
    apart = APART * tolerance
    meet = _near(start.area, stop.area, apart)
    if not meet and margin == 0.0:
        return _Given(start.contact, attach(start.area, space), whole=True)
    rest = inner = start.area
    if meet:
        rest = _without(start.area, stop.area, grid, tolerance)
        inner = _without(start.area, areas.shrunk(stop.area, -apart), grid, tolerance)
    if margin > 0.0:
        inner = areas.shrunk(inner, margin)
    border, beside = attach(inner, space), attach(rest, space)
    touched = (code[beside.beside_edge] & Passage.TOUCHES) != 0
    touched &= (code[beside.beside_edge] & Passage.OPEN) == 0
    edge, low, high = (
        part[touched] for part in (beside.beside_edge, beside.beside_low, beside.beside_high)
    )
    vertices = _ends(space, edge, low, high, border)
    met = ContactSet.of(edge, low, high, vertices, tolerance)
    return _Given(contact_set.union(start.contact, met, tolerance), border, whole=False)


def _ends(
    space: ConfigurationSpace, edge: Ints, low: Floats, high: Floats, inner: Attachment
) -> Ints:
    """The vertices at which stretches of edges end, but for those beside an area inside."""
    contact, near = space.contact, space.tolerance.length

    def ends(edge: Ints, low: Floats, high: Floats) -> Ints:
        first = edge[low <= near]
        last = contact.next[edge[high >= contact.length[edge] - near]]
        return np.concatenate((first, last)).astype(np.int32)

    inside = ends(inner.beside_edge, inner.beside_low, inner.beside_high)
    found = np.intersect1d(ends(edge, low, high), contact.vertices)
    return np.setdiff1d(found, inside).astype(np.int32)


def _without_cracks(
    points: Floats, start: Ints, shell: Ints, tolerance: float
) -> tuple[Floats, Ints, Ints]:
    """Rings without the holes that are in no shell and thinner than the tolerance.

    Those are what rounding leaves between borders that coincide.
    """
    if not np.any(shell < 0):
        return points, start, shell
    size = np.diff(start)
    ring = np.repeat(np.arange(len(size)), size)
    following = np.arange(1, len(points) + 1)
    following[start[1:] - 1] = start[:-1]
    first, offset = points[start[ring]], points
    along = points[following] - points
    twice = np.bincount(
        ring,
        (offset[:, 0] - first[:, 0]) * along[:, 1] - (offset[:, 1] - first[:, 1]) * along[:, 0],
    )
    length = np.bincount(ring, np.hypot(along[:, 0], along[:, 1]))
    kept = (shell >= 0) | (np.abs(twice) > tolerance * length)
    number = (np.cumsum(kept) - 1).astype(np.int32)
    ends = np.concatenate(([0], np.cumsum(size[kept]))).astype(np.int32)
    owner = np.where(shell >= 0, number[shell], -1).astype(np.int32)
    return points[kept[ring]], ends, owner[kept]


def _near(a: Area, b: Area, margin: float) -> bool:
    """Whether the boxes of two areas are nearer to each other than the margin."""
    if a.is_empty or b.is_empty:
        return False
    first, second = a.bounds, b.bounds
    return all(
        first[axis] - margin <= second[axis + 2] and second[axis] - margin <= first[axis + 2]
        for axis in (0, 1)
    )


def _without(a: Area, b: Area, grid: float, tolerance: float) -> Area:
    return without_slivers(areas.difference_on_grid(a, b, grid), tolerance)


def _nowhere(
    space: ConfigurationSpace, start: Region, stop: Region, direction: float
) -> ForwardProjection:
    empty = np.empty(0)
    none = np.empty(0, dtype=np.int32)
    nothing = np.zeros(len(space.contact), dtype=np.uint8)
    rings = (np.empty((0, 2)), np.zeros(1, dtype=np.int32), none)
    contact = (none, empty, empty, nothing)
    return ForwardProjection(space, start, stop, direction, none, 0, rings, contact, Area.empty())


def _everywhere(
    space: ConfigurationSpace, start: Region, stop: Region, direction: float
) -> ForwardProjection:
    nowhere = _nowhere(space, start, stop, direction)
    whole = ContactSet.whole(space.contact)
    vertex = np.zeros(len(space.contact), dtype=np.uint8)
    vertex[whole.vertices] = 1
    return ForwardProjection(
        space=space,
        start=start,
        stop=stop,
        direction=direction,
        open_sides=np.flatnonzero(space.contact.open).astype(np.int32),
        sweeps=0,
        _rings=nowhere._rings,
        _contact=(whole.edge, whole.low, whole.high, vertex),
        _more=space.free,
    )
