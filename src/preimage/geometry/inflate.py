"""Areas and segments (+) a disc: straight parts exact, arcs replaced on the outer side.

An arc becomes a polyline of tangents to it, so that what is grown contains the true sum, what is
shrunk lies inside the true difference, and neither is further off than `arc_tolerance` times the
radius (theory 5). Tangents parallel to given rays are always among them: where a cone ray touches
the true arc, it touches the polyline too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import cos, sin

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.angles import TAU
from preimage.geometry.area import Area, grid_of
from preimage.geometry.border import border
from preimage.geometry.subtraction import subtracted
from preimage.geometry.tolerance import ANGLE

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]
Pieces = NDArray[np.object_]
"""Convex polygons of shapely's, to be united; only the room `geometry` looks into them."""

_NONE: Pieces = np.empty(0, dtype=np.object_)

ARC_TOLERANCE = 0.005

FEW_PIECES = 1000
"""Up to so many pieces are taken from an area at once, faster than crowd by crowd."""

FEW_PAIRS = 250_000
"""Up to so many pairs of boxes are compared one by one, faster than a tree is built."""


@lru_cache(maxsize=4096)
def tangent_normals(arc_tolerance: float, touch: tuple[float, ...] = ()) -> Floats:
    """The angles of the normals of tangents to a circle that follow it all around.

    Parameters
    ----------
    arc_tolerance : how far the corners of the polygon of tangents may be from the circle, as a
        fraction of its radius; positive.
    touch : angles of rays: a tangent is parallel to each, on either side of the circle; radians.

    Returns
    -------
    (k,) ascending, in [0, 2 pi), radians; not to be written to.

    >>> len(tangent_normals(0.005)), len(tangent_normals(0.005, (0.1,)))
    (32, 32)
    """
    widest = 2.0 * np.arccos(1.0 / (1.0 + arc_tolerance))
    quarter = 0.5 * np.pi
    fixed = np.array([turn for ray in touch for turn in (ray - quarter, ray + quarter)] or [0.0])
    fixed = np.sort(np.mod(fixed, TAU))
    rounding = 4 * np.finfo(float).eps * TAU
    apart = np.append(np.diff(fixed), fixed[0] + TAU - fixed[-1])
    if len(fixed) > 1:  # rays that are the same up to rounding
        fixed = fixed[apart > rounding]
        apart = np.append(np.diff(fixed), fixed[0] + TAU - fixed[-1])
    parts = np.maximum(np.ceil((apart - rounding) / widest), 1.0).astype(np.intp)
    within = np.arange(np.sum(parts)) - np.repeat(np.cumsum(parts) - parts, parts)
    angles = np.repeat(fixed, parts) + np.repeat(apart / parts, parts) * within
    angles = np.sort(np.mod(angles, TAU))
    angles.flags.writeable = False
    return angles


def outer_stadiums(
    starts: Floats,
    ends: Floats,
    radius: float,
    arc_tolerance: float = ARC_TOLERANCE,
    touch: Sequence[float] = (),
) -> Area:
    """The segments (+) D(radius), from outside: the union of one convex polygon a segment.

    Parameters
    ----------
    starts, ends : (m, 2); a segment may be a point.
    radius : at 0, or without segments, the sum has no area.
    arc_tolerance, touch : see `tangent_normals`; tangents parallel to each segment are added, so
        that the straight parts are exact.

    >>> capsule = outer_stadiums(np.array([[0.0, 0.0]]), np.array([[3.0, 0.0]]), 1.0)
    >>> np.round(capsule.bounds, 9).tolist(), bool(6 + np.pi < capsule.measure < 6.02 + np.pi)
    ([-1.0, -1.0, 4.0, 1.0], True)
    """
    return united_pieces(
        stadium_pieces(starts, ends, radius, tangent_normals(arc_tolerance, tuple(touch)))
    )


def united_pieces(pieces: Pieces) -> Area:
    """The union of pieces."""
    return Area.of(shapely.union_all(pieces)) if len(pieces) else Area.empty()


def grow(
    area: Area,
    radius: float,
    arc_tolerance: float = ARC_TOLERANCE,
    touch: Sequence[float] = (),
) -> Area:
    """The area (+) D(radius), from outside; the area itself at radius 0.

    >>> bool(8 + np.pi < grow(Area.box(0, 0, 1, 3), 1.0).measure - 3.0 < 8.02 + np.pi)
    True
    """
    points, following = border(area)
    normals = tangent_normals(arc_tolerance, tuple(touch))
    pieces = outward_pieces(points, following, radius, normals)
    if not len(pieces):
        return area
    return Area.of(shapely.union_all(np.append(pieces, area.geometry)))


def shrunk_by(area: Area, *pieces: Pieces) -> Area:
    """The area without the interiors of the pieces; those that miss it cost little.

    Overlays in floating arithmetic may fail, or lose polygons, where borders nearly coincide. So
    points of every piece are looked for in the answer; if one is there, all is done again on a
    grid, which is slower.
    """
    together = np.concatenate(pieces) if pieces else _NONE
    if not len(together) or area.is_empty:
        return area
    shapely.prepare(area.geometry)
    together = together[shapely.intersects(area.geometry, together)]
    if not len(together):
        return area
    try:
        rest = subtracted(area, together) if len(together) > FEW_PIECES else None
        if rest is None:
            rest = Area.of(shapely.difference(area.geometry, shapely.union_all(together)))
    except shapely.GEOSException:
        rest = None
    if rest is None or _survives(together, rest):
        grid = grid_of(area)
        gone = shapely.union_all(together, grid_size=grid)
        rest = Area.of(shapely.difference(area.geometry, gone, grid_size=grid))
    return rest


def _survives(pieces: Pieces, rest: Area) -> bool:
    """Whether something of a convex piece is still there: its middle, or near a corner."""
    if rest.is_empty:
        return False
    shapely.prepare(rest.geometry)
    corners, piece = shapely.get_coordinates(pieces, return_index=True)
    middle = shapely.get_coordinates(shapely.centroid(pieces))
    spokes = corners - middle[piece]
    for part in (0.5, 0.98):
        x, y = (middle[piece] + part * spokes).T
        if np.any(shapely.contains_xy(rest.geometry, x, y)):
            return True
    return bool(np.any(shapely.contains_xy(rest.geometry, *middle.T)))


@dataclass(frozen=True, slots=True, eq=False)
class Wedges:
    """The convex corners of an area, outside of which it grows by sectors of discs.

    Parameters
    ----------
    points : (k, 2).
    first, second : (k, 2) the outward normals of the edges that end and that start there, unit
        vectors; the turn from the one to the other is to the left.
    """

    points: Floats
    first: Floats
    second: Floats

    @classmethod
    def none(cls) -> Wedges:
        """No corners."""
        return cls(np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2)))

    def __len__(self) -> int:
        return len(self.points)

    def near(self, area: Area, distance: float) -> Wedges:
        """Those that are not much further than `distance` from an area."""
        if not len(self) or area.is_empty:
            return Wedges.none()
        shapely.prepare(area.geometry)
        # further than any corner of a polyline around a disc
        near = shapely.dwithin(area.geometry, shapely.points(self.points), 2.0 * distance)
        return Wedges(self.points[near], self.first[near], self.second[near])


def outward_pieces(points: Floats, following: Ints, radius: float, normals: Floats) -> Pieces:
    """What an area gains by (+) D(radius), in convex pieces: rectangles on its edges, and sectors.

    A point outside the area is nearest either to the inside of an edge, and lies in the rectangle
    on that edge's outer side, or to a vertex where the area is convex, and lies in the sector
    between the normals of the two edges. Where the area is reflex the rectangles overlap.

    Parameters
    ----------
    points, following : the border of the area, which is on the left (see `border`).
    normals : of the tangents that replace arcs (see `tangent_normals`).
    """
    rectangles, wedges = rectangle_pieces(points, following, radius)
    return np.concatenate((rectangles, sector_pieces(wedges, radius, normals)))


def rectangle_pieces(
    points: Floats,
    following: Ints,
    radius: float,
    chosen: Bools | None = None,
    depth: float = 0.0,
) -> tuple[Pieces, Wedges]:
    """The rectangles of an area (+) D(radius), and the corners at which sectors are missing.

    Parameters
    ----------
    chosen : (n,) the edges, and vertices at their starts, that are wanted; all by default.
    depth : how far the rectangles reach into the area, to hide what rounding did to its border.
    """
    if not len(points) or radius <= 0.0:
        return _NONE, Wedges.none()
    along = points[following] - points
    along /= np.hypot(along[:, 0], along[:, 1])[:, None]
    outward = along[:, ::-1] * (1.0, -1.0)
    before = np.empty(len(points), dtype=np.intp)
    before[following] = np.arange(len(points))
    edges = np.arange(len(points)) if chosen is None else np.flatnonzero(chosen)

    start, end, side = points[edges], points[following[edges]], outward[edges]
    corners = np.empty((len(edges), 4, 2))
    corners[:, 0], corners[:, 1] = start - depth * side, end - depth * side
    corners[:, 2], corners[:, 3] = end + radius * side, start + radius * side
    first = outward[before[edges]]
    turn = first[:, 0] * side[:, 1] - first[:, 1] * side[:, 0]
    ahead = np.sum(first * side, axis=1) > 0.0
    # a turn too slight for a sector: the rectangles meet in one corner
    slight = np.flatnonzero(ahead & (np.abs(turn) <= _slack(points, radius)))
    meeting = start[slight] + radius * side[slight]
    place = np.full(len(points), -1)
    place[edges] = np.arange(len(edges))
    earlier = place[before[edges[slight]]]
    corners[earlier[earlier >= 0], 2] = meeting[earlier >= 0]
    convex = turn > 0.0
    convex[slight] = False
    rectangles = np.asarray(shapely.polygons(corners), dtype=np.object_)
    return rectangles, Wedges(start[convex], first[convex], side[convex])


def sector_pieces(wedges: Wedges, radius: float, normals: Floats) -> Pieces:
    """Sectors of discs, from outside, one at each corner."""
    if not len(wedges) or radius <= 0.0:
        return _NONE
    base, turn, turns = _turns(wedges.first, wedges.second, normals)
    slack = _slack(wedges.points, radius)
    inner = (turns > slack) & (turns < turn[:, None] - slack)
    angles = base[:, None] + turns
    rings: list[tuple[float, float]] = []
    which: list[int] = []
    parts = zip(wedges.points.tolist(), wedges.first.tolist(), wedges.second.tolist(), strict=True)
    for place, ((x, y), one, other) in enumerate(parts):
        between = np.sort(angles[place, inner[place]]).tolist()
        sides = [one, *((cos(angle), sin(angle)) for angle in between), other]
        ring = [(x, y), (x + radius * one[0], y + radius * one[1])]
        for (ux, uy), (vx, vy) in pairwise(sides):
            scale = radius / (1.0 + ux * vx + uy * vy)
            ring.append((x + scale * (ux + vx), y + scale * (uy + vy)))
        ring.append((x + radius * other[0], y + radius * other[1]))
        rings.extend(ring)
        which.extend([place] * len(ring))
    return np.asarray(shapely.polygons(shapely.linearrings(rings, indices=which)), np.object_)


def stadium_pieces(starts: Floats, ends: Floats, radius: float, normals: Floats) -> Pieces:
    """One convex polygon around each segment (+) D(radius), a segment's own tangents included."""
    if not len(starts) or radius <= 0.0:
        return _NONE
    along = ends - starts
    length = np.hypot(along[:, 0], along[:, 1])
    long = length > np.finfo(float).tiny
    # a point has no tangents of its own: those that it gets are among the others
    along = np.where(long[:, None], along, (-sin(normals[0]), cos(normals[0])))
    along /= np.where(long, length, 1.0)[:, None]
    right = np.stack((along[:, 1], -along[:, 0]), axis=1)
    # the normals from the right side of the segment around its end to the left side, and back
    base, _, turns = _turns(right, right, normals)
    slack = _slack(np.concatenate((starts, ends)), radius)
    for exact in (0.0, np.pi, TAU):
        turns[np.abs(turns - exact) <= slack] = exact
    own = np.broadcast_to((0.0, np.pi), (len(starts), 2))
    turns = np.sort(np.concatenate((own, turns), axis=1), axis=1)
    angles = base[:, None] + turns
    vectors = np.stack((np.cos(angles), np.sin(angles)), axis=2)
    vectors = np.where(((turns == 0.0) | (turns == TAU))[..., None], right[:, None, :], vectors)
    vectors = np.where((turns == np.pi)[..., None], -right[:, None, :], vectors)
    following = np.roll(vectors, -1, axis=1)
    centers = np.where((turns < np.pi)[..., None], ends[:, None, :], starts[:, None, :])
    polygons = shapely.polygons(centers + radius * _corners(vectors, following))
    return np.asarray(polygons, dtype=np.object_)


def _turns(first: Floats, second: Floats, normals: Floats) -> tuple[Floats, Floats, Floats]:
    """Angles of unit vectors, and from there to others and to all normals, counter-clockwise."""
    base = np.arctan2(first[:, 1], first[:, 0])
    turn = np.mod(np.arctan2(second[:, 1], second[:, 0]) - base, TAU)
    return base, turn, np.mod(normals[None, :] - base[:, None], TAU)


def _slack(points: Floats, radius: float) -> float:
    """Tangents that differ by less have corners that rounding cannot tell apart; radians."""
    return max(ANGLE, float(64.0 * np.finfo(float).eps * np.max(np.abs(points)) / radius))


def _corners(first: Floats, second: Floats) -> Floats:
    """Where the tangents with these normals to the unit circle meet, (..., 2)."""
    towards = first + second
    cosine: Floats = np.sum(first * second, axis=-1)
    corner: Floats = towards / (1.0 + cosine)[..., None]
    return corner


def without_slivers(area: Area, tolerance: float) -> Area:
    """The area without its polygons that are slivers, no thicker than twice the tolerance.

    What lies within the tolerance of a border of length l has no more area than l times the
    tolerance: most polygons are thick by that alone.
    """
    polygons = shapely.get_parts(area.geometry)
    thick = shapely.area(polygons) > tolerance * shapely.length(polygons)
    if np.all(thick):
        return area
    thin = np.flatnonzero(~thick)
    thick[thin] = ~shapely.is_empty(shapely.buffer(polygons[thin], -tolerance, quad_segs=1))
    return Area.of(shapely.multipolygons(polygons[thick])) if np.any(thick) else Area.empty()


def box_pairs(
    low: Floats, high: Floats, other_low: Floats, other_high: Floats, few: int = FEW_PAIRS
) -> tuple[Indices, Indices]:
    """The pairs of boxes, one of each kind, that meet; touching counts.

    Parameters
    ----------
    low, high, other_low, other_high : (k, 2) and (j, 2) corners of the boxes.
    few : how many pairs are compared one by one before a tree is built.

    Returns
    -------
    Two arrays of equal length, sorted by the first.
    """
    if len(low) * len(other_low) <= few:
        meets = (
            (low[:, None, 0] <= other_high[None, :, 0])
            & (low[:, None, 1] <= other_high[None, :, 1])
            & (high[:, None, 0] >= other_low[None, :, 0])
            & (high[:, None, 1] >= other_low[None, :, 1])
        )
        first, second = np.nonzero(meets)
        return first, second
    tree = shapely.STRtree(shapely.box(*other_low.T, *other_high.T))
    pairs = tree.query(shapely.box(*low.T, *high.T))
    order = np.lexsort((pairs[1], pairs[0]))
    return pairs[0][order], pairs[1][order]
