"""Whether polygons and chains are simple, and if not, which two edges are to blame.

Edges and vertices are numbered from 0, edge `i` starting at vertex `i`. Many rings are checked at
once: `points` holds their vertices one after the other, not closed, and ring `k` is
`points[offsets[k]:offsets[k + 1]]`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

MAX_NEIGHBOURS = 10**9
"""Pairs of edges whose boxes may overlap: GEOS looks at each in some 15 ns."""

_SURELY_CHEAP = 1000
"""Edges of a group that are never too many."""

_CHUNK = 16
"""Edges looked up at a time: each may cross all others, and all these pairs are held at once."""

_ROUNDING = 1e-14
"""Relative error of the place that GEOS names."""

_PARALLEL = 1e-12
"""Sine of the angle up to which two rays of a chain count as parallel."""


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong with ring number `ring`, in words that follow the ring's name."""

    ring: int
    rule: str


def counterclockwise(points: Floats, offsets: Integers) -> NDArray[np.bool_]:
    """For each simple ring, whether it runs counter-clockwise.

    >>> square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    >>> bool(counterclockwise(square, np.array([0, 4]))[0])
    True
    """
    turns: NDArray[np.bool_] = shapely.is_ccw(_linear_rings(points, offsets))
    return turns


def ring_fault(points: Floats, offsets: Integers) -> Fault | None:
    """The first ring that is no simple polygon; `None` if all are.

    Simple: at least three vertices, no vertex repeated, no two edges that share more than the
    vertex between them. Collinear vertices are legal, turning back is not. Decided exactly.

    >>> bowtie = np.array([[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]])
    >>> ring_fault(bowtie, np.array([0, 4]))
    Fault(ring=0, rule='edges 0 and 2 cross')
    """
    counts = np.diff(offsets)
    if (few := np.flatnonzero(counts < 3)).size:
        return Fault(int(few[0]), f"must have 3 vertices or more, not {counts[few[0]]}")
    if not points.size:
        return None
    last = offsets[1:] - 1
    closing = np.all(points[offsets[:-1]] == points[last], axis=1)
    if closing.any():
        ring = int(np.argmax(closing))
        return Fault(ring, "the last vertex repeats the first one: leave it out")
    same = np.all(points[1:] == points[:-1], axis=1)
    same[last[:-1]] = False
    if same.any():
        ring, vertex = _place(int(np.argmax(same)), offsets)
        return Fault(ring, f"vertices {vertex} and {vertex + 1} are the same")
    simple = shapely.is_simple(_linear_rings(points, offsets))
    if simple.all():
        return None
    ring = int(np.argmin(simple))
    return Fault(ring, _crossing(points[offsets[ring] : offsets[ring + 1]], closed=True))


def hole_fault(exterior: Floats, holes: list[Floats]) -> Fault | None:
    """The first hole that is not inside the exterior and beside the others.

    Rings may touch each other at single points, as long as the polygon stays in one piece.
    `exterior` and `holes` are simple rings. The fault's ring is the number of the hole.

    >>> outer = np.array([[0.0, 0.0], [9.0, 0.0], [0.0, 9.0]])
    >>> hole_fault(outer, [outer + 1.0])
    Fault(ring=0, rule='edge 0 crosses edge 1 of the polygon')
    """
    if shapely.is_valid(shapely.Polygon(exterior, holes)):
        return None
    filled = [shapely.Polygon(hole) for hole in holes]
    tree = shapely.STRtree(filled)
    shell = shapely.Polygon(exterior)
    reason = shapely.is_valid_reason(shapely.Polygon(exterior, holes))
    for number in _holes_at(reason, tree):
        names = {"the polygon": exterior} | {f"holes[{k}]": holes[k] for k in range(number)}
        for name, other in names.items():
            if (rule := _meeting(holes[number], other, name)) is not None:
                return Fault(number, rule)
    shapely.prepare(shell)
    inside = shapely.covers(shell, filled)
    if not inside.all():
        return Fault(int(np.argmin(inside)), "is not inside the polygon")
    for number, hole in enumerate(filled):
        others = tree.query(hole, predicate="intersects")
        for other in sorted(others[others > number].tolist()):
            if not shapely.touches(hole, filled[other]):
                return Fault(other, f"overlaps holes[{number}]")
    return Fault(len(holes) - 1, "the holes cut the polygon into separate parts")


def chain_fault(points: Floats) -> str | None:
    """Why an unbounded chain is not simple; `None` if it is. Its end edges run on for ever.

    >>> chain_fault(np.array([[0.0, 2.0], [0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0]]))
    'edge 0 and the ray after the last vertex cross'
    """
    if len(points) < 2:
        return f"must have 2 points or more, not {len(points)}"
    same = np.all(points[1:] == points[:-1], axis=1)
    if same.any():
        vertex = int(np.argmax(same))
        return f"points {vertex} and {vertex + 1} are the same"
    before, after = points[0] - points[1], points[-1] - points[-2]
    reach = 4.0 * (1.0 + np.hypot(*np.ptp(points, axis=0)))
    line = np.vstack([points[0] + _far(before, reach), points, points[-1] + _far(after, reach)])
    if not shapely.is_simple(shapely.LineString(line)):
        return _crossing(line, closed=False)
    if _rays_meet(points[0], before, points[-1], after):
        return "the ray before the first vertex and the ray after the last vertex cross"
    return None


def thin_fault(
    points: Floats, offsets: Integers, length: float, closed: bool = True
) -> Fault | None:
    """The first ring, or chain, with an edge or a needle no longer or wider than `length`.

    >>> thin = np.array([[0.0, 0.0], [4.0, 0.0], [8.0, 1e-12]])
    >>> thin_fault(thin, np.array([0, 3]), 1e-9)
    Fault(ring=0, rule='turns back at (8, 1e-12)')
    """
    if not len(points):
        return None
    last = offsets[1:] - 1
    following = _following(offsets, len(points))
    edges = points[following] - points
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    if not closed:
        lengths[last] = np.inf
    if (short := np.flatnonzero(lengths <= length)).size:
        ring, x, y = _where(points, offsets, int(short[0]))
        rule = f"is {lengths[short[0]]:.3g} long, too short for the window to resolve"
        return Fault(ring, f"the edge at ({x}, {y}) {rule}")
    onward = edges[following]
    cross = edges[:, 0] * onward[:, 1] - edges[:, 1] * onward[:, 0]
    back = np.einsum("ij,ij->i", edges, onward) < 0.0
    longer = np.maximum(lengths, lengths[following])
    needle = back & (np.abs(cross) <= length * longer)
    if not closed:
        needle[last] = False
        needle[last - 1] = False
    if needle.any():
        ring, x, y = _where(points, offsets, int(following[np.argmax(needle)]))
        return Fault(ring, f"turns back at ({x}, {y})")
    return None


def crowd_fault(points: Floats, offsets: Integers, groups: Integers) -> Fault | None:
    """The group of rings with which the pairs of edges to be looked at become too many.

    Long edges side by side, aslant, would make the checks of GEOS quadratic, so this check comes
    before the others. Group `g` is the rings `groups[g]` to `groups[g + 1] - 1`; only edges of
    one group are compared. The fault's ring is the number of the group.
    """
    ends = points[_following(offsets, len(points))]
    bounds = offsets[groups]
    total = 0.0
    for group in np.flatnonzero(np.diff(bounds) > _SURELY_CHEAP):
        edges = slice(bounds[group], bounds[group + 1])
        total += _overlapping_boxes(points[edges], ends[edges])
        if total > MAX_NEIGHBOURS:
            return Fault(int(group), "too many edges lie side by side to be checked")
    return None


def _following(offsets: Integers, count: int) -> Integers:
    """For each vertex the next one of its ring."""
    following = np.arange(1, count + 1)
    filled = np.diff(offsets) > 0
    following[offsets[1:][filled] - 1] = offsets[:-1][filled]
    return following


def _overlapping_boxes(starts: Floats, ends: Floats) -> float:
    """About how many pairs of edges have boxes that overlap: an upper bound if that is small."""
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    count = len(starts)
    bound = min(
        float(np.searchsorted(np.sort(low[:, axis]), high[:, axis], side="right").sum())
        - count * (count + 1) / 2
        for axis in (0, 1)
    )
    if bound <= MAX_NEIGHBOURS:
        return bound
    # Few large boxes may overlap all others: sampled by rank of size, from the largest on.
    order = np.argsort(-(high - low).sum(axis=1))
    estimate, rank = 0.0, 0
    while rank < count:
        upper = min(count, 2 * rank + 8)
        sample = order[np.linspace(rank, upper - 1, 8).astype(np.int64)]
        hits = [
            np.count_nonzero(np.all((low <= high[edge]) & (high >= low[edge]), axis=1))
            for edge in sample
        ]
        estimate += (upper - rank) * float(np.mean(hits)) / 2
        rank = upper
    return estimate


def _linear_rings(points: Floats, offsets: Integers) -> NDArray[np.object_]:
    numbers = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    rings: NDArray[np.object_] = shapely.linearrings(points, indices=numbers)
    return rings


def _place(vertex: int, offsets: Integers) -> tuple[int, int]:
    ring = int(np.searchsorted(offsets, vertex, side="right")) - 1
    return ring, int(vertex - offsets[ring])


def _where(points: Floats, offsets: Integers, vertex: int) -> tuple[int, str, str]:
    ring, _ = _place(vertex, offsets)
    return ring, f"{points[vertex, 0]:.9g}", f"{points[vertex, 1]:.9g}"


def _segments(points: Floats, closed: bool) -> NDArray[np.object_]:
    ends = np.roll(points, -1, axis=0) if closed else points[1:]
    segments: NDArray[np.object_] = shapely.linestrings(
        np.stack([points[: len(ends)], ends], axis=1)
    )
    return segments


def _crossing(points: Floats, closed: bool) -> str:
    """The first edge that meets a later one other than in the vertex between them, and that one.

    An open chain has been lengthened by its two rays, so its edges are numbered from the second.
    """
    edges = _segments(points, closed)
    tree = shapely.STRtree(edges)
    last = len(edges) - 1

    def name(edge: int) -> str:
        if closed:
            return str(edge)
        return {
            0: "the ray before the first vertex",
            last: "the ray after the last vertex",
        }.get(edge, f"edge {edge - 1}")

    for start in range(0, len(edges), _CHUNK):
        found = tree.query(edges[start : start + _CHUNK], predicate="intersects")
        first, second = found[0] + start, found[1]
        first, second = first[first < second], second[first < second]
        for place in np.lexsort((second, first)):
            i, j = int(first[place]), int(second[place])
            verb = _meets(points, edges, i, j, closed)
            if verb is None:
                continue
            if closed:
                return f"edges {i} and {j} {verb}"
            return f"{name(i)} and {name(j)} {verb}"
    return "is not simple"


def _meets(points: Floats, edges: NDArray[np.object_], i: int, j: int, closed: bool) -> str | None:
    """What edges `i < j`, which share points, do to each other; `None` if that is legal."""
    count = len(points)
    if j == i + 1:
        outer_i, outer_j = points[i], points[(j + 1) % count]
    elif closed and i == 0 and j == count - 1:
        outer_i, outer_j = points[1], points[j]
    else:
        return _verb(edges[i], edges[j])
    on_j = shapely.intersects(shapely.Point(outer_i), edges[j])
    on_i = shapely.intersects(shapely.Point(outer_j), edges[i])
    return "turn back on each other" if on_j or on_i else None


def _verb(a: object, b: object) -> str:
    if shapely.crosses(a, b):
        return "cross"
    return "overlap" if shapely.relate_pattern(a, b, "1********") else "touch"


def _holes_at(reason: str, tree: shapely.STRtree) -> list[int]:
    """The holes at the place that GEOS names in `Self-intersection[x y]`, the last one first."""
    place = re.search(r"\[(\S+) (\S+)\]", reason)
    if place is None:
        return []
    x, y = float(place[1]), float(place[2])
    radius = _ROUNDING * (1.0 + abs(x) + abs(y))
    near = tree.query(shapely.Point(x, y), predicate="dwithin", distance=radius)
    return sorted(near.tolist(), reverse=True)


def _meeting(ring: Floats, other: Floats, name: str) -> str | None:
    """The first edge of `ring` that crosses or overlaps one of `other`, in words."""
    edges, others = _segments(ring, closed=True), _segments(other, closed=True)
    border = shapely.LinearRing(other)
    shapely.prepare(border)
    for edge in np.flatnonzero(shapely.intersects(border, edges)):
        for place in np.flatnonzero(shapely.intersects(edges[edge], others)):
            verb = _verb(edges[edge], others[place])
            if verb != "touch":
                return (
                    f"edge {edge} {verb}{'es' if verb == 'cross' else 's'} edge {place} of {name}"
                )
    return None


def _far(direction: Floats, reach: float) -> Floats:
    """The direction times a power of two, so that it stays exact: as long as `reach`, or more."""
    _, exponent = np.frexp(np.hypot(*direction))
    _, wanted = np.frexp(reach)
    far: Floats = np.ldexp(direction, wanted - exponent + 1)
    return far


def _rays_meet(start: Floats, forward: Floats, other: Floats, ahead: Floats) -> bool:
    """Whether two rays meet; far away counts, unless they are all but parallel."""
    forward, ahead = forward / np.hypot(*forward), ahead / np.hypot(*ahead)
    sine = float(forward[0] * ahead[1] - forward[1] * ahead[0])
    if abs(sine) <= _PARALLEL:
        return False
    gap = other - start
    along = float(gap[0] * ahead[1] - gap[1] * ahead[0]) / sine
    beyond = float(gap[0] * forward[1] - gap[1] * forward[0]) / sine
    return along >= 0.0 and beyond >= 0.0
