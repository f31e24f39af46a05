"""The avoidable set N of theory 4, slab by slab from below.

Derivation. Turn the plane so that `v` points down, and let `t = tan(theta)`. Outside `N` the robot
only descends: free flight descends, and an edge on which it could slide up may also stick. So what
happens at a height depends on what lies below, and one pass upwards through the slabs settles it.

*A cell outside the target.* Cells are convex, so a point at height `h` flies to a place `p` at
height `g < h` of its cell iff `|x - p| <= t (h - g)`. A side of which all points are in `N` is
reached from where its lowest point is reached, and from all that lies beyond the ray from that
point. Hence, with `S` the places of the cell's floor that are in `N`, widened to minus or plus
infinity where the left or right side is in `N`, the cell's part of `N` at height `h` is
`S + [-t, t] (h - floor)`, clipped to the cell.

*A side's points.* Those in `T` are not in `N`. An edge that keeps is in `N`. If an edge can be slid
on and its foot is in `N`, all of it is. Else it is in `N` where it can be left for the cell's part
of `N`, and, if it can be slid on, above the first such point. Such points add nothing to the
cell's part: an edge that can be both slid on and left falls within the cone, so that what flies to
it can fly past it.

*A floor's places.* Above free space they are as the cell below says; above the target, not in `N`.
A level floor may stick: all of it is in `N`, but for `T`. Vertices follow theory 2: in `T`, not in
`N`; may stick or escape, in `N`; else in `N` iff an edge that falls from it and can be slid on is,
or a place can be flown to that is.

All intervals are closed, and ties within the tolerance are nature's. That settles what the theory
leaves open: where `theta = 0` the cone is as wide as the tolerance; a ray that just meets a corner
of the target or of an obstacle passes it; a level edge with free space above may stick, however
short, and one with free space below is left. A vertex in `T` beside an open side is in `T`: the
motion has met `T` when it escapes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from preimage.configuration.contact import ContactSpace
from preimage.configuration.contact_set import ContactSet
from preimage.geometry.tolerance import Tolerance
from preimage.verification.features import Features
from preimage.verification.levels import Levels, Marked, near, where_positive
from preimage.verification.slabs import BORDER, Cell, Slabs, Span


@dataclass(frozen=True, slots=True)
class Avoidable:
    """The starts from which nature can avoid the target.

    Parameters
    ----------
    spread : how far `N` grows sideways for each unit of height, `tan(theta)`.
    sources : for each slab and each of its cells, the places of its floor from which `N` grows,
        ascending and disjoint; infinite where all beyond belongs to a side in `N`.
    edges : for each edge of contact space the parts in `N`, as distances from its start.
    vertices : for each vertex whether it is in `N`.
    """

    spread: float
    sources: tuple[tuple[tuple[Span, ...], ...], ...]
    edges: tuple[tuple[Span, ...], ...]
    vertices: tuple[bool, ...]


@dataclass(frozen=True, slots=True)
class _Below:
    """What is known at the top of a slab.

    Parameters
    ----------
    cells, reached : the slab's cells, and for each the places of its ceiling that are in `N`.
    edges : for each edge that crosses the slab whether its points at the top are in `N`.
    """

    cells: tuple[Cell, ...]
    reached: tuple[tuple[Span, ...], ...]
    edges: dict[int, bool]


def avoidable_set(
    contact: ContactSpace,
    slabs: Slabs,
    features: Features,
    target: ContactSet,
    control: float,
    tolerance: Tolerance,
) -> Avoidable:
    """The least set `N` of theory 4, for free space in slabs.

    Parameters
    ----------
    slabs : cut for the target's area, the ends of its intervals, and the commanded direction.
    features : for the same motion.
    target : the target's contact part; its area is in the slabs.
    control : `theta`, in radians.
    """
    spread = math.tan(max(control, tolerance.angle))
    chosen = Marked(target, tolerance.length)
    return _Propagation(contact, slabs, features, chosen, spread, tolerance.length).run()


class _Propagation:
    """One pass upwards through the slabs; `run` gives the avoidable set."""

    def __init__(
        self,
        contact: ContactSpace,
        slabs: Slabs,
        features: Features,
        target: Marked,
        spread: float,
        tolerance: float,
    ) -> None:
        self.slabs, self.target = slabs, target
        self.spread, self.tolerance = spread, tolerance
        self.levels = Levels(contact, slabs, tolerance)
        self.next, self.previous = self.levels.next, self.levels.previous
        self.length = self.levels.length
        self.open: list[bool] = contact.open.tolist()
        self.keeps: list[bool] = features.keeps.tolist()
        self.slides: list[bool] = features.slides.tolist()
        self.leaves: list[bool] = features.leaves.tolist()
        self.keeps_vertex: list[bool] = features.keeps_vertex.tolist()
        self.edges: list[list[Span]] = [[] for _ in self.next]
        self.vertices: list[bool] = [False for _ in self.next]

    def run(self) -> Avoidable:
        """Settle level by level, slab by slab."""
        below = _Below((), (), {})
        sources: list[tuple[tuple[Span, ...], ...]] = []
        for level in range(len(self.slabs.heights)):
            floors = self._level_edges(level, below)
            for vertex in self.levels.at_level[level]:
                self.vertices[vertex] = self._vertex(vertex, below)
            if level < len(self.slabs.cells):
                below, grown = self._slab(level, below, floors)
                sources.append(grown)
        return Avoidable(
            spread=self.spread,
            sources=tuple(sources),
            edges=tuple(merged(parts) for parts in self.edges),
            vertices=tuple(self.vertices),
        )

    def _level_edges(self, level: int, below: _Below) -> list[Span]:
        """Settle the level edges; the places of those with free space above that are in `N`."""
        floors: list[Span] = []
        for edge in self.levels.level_edges[level]:
            start, end = self.slabs.x[edge], self.slabs.x[self.next[edge]]
            if end >= start:  # free space above: it keeps all but the target
                whole = ((0.0, self.length[edge]),)
                gaps = whole if self.open[edge] else self.target.gaps(edge, self.length[edge])
                self.edges[edge].extend(gaps)
                floors.extend((start + low, start + high) for low, high in gaps)
            else:
                for cell, reached in zip(below.cells, below.reached, strict=True):
                    view = (max(end, cell.ceiling[0]), min(start, cell.ceiling[1]))
                    self.edges[edge].extend(
                        (start - high, start - low) for low, high in self._clipped(reached, view)
                    )
        return floors

    def _vertex(self, vertex: int, below: _Below) -> bool:
        """Whether a vertex is in `N` (theory 2)."""
        if self.target.has_vertex(vertex):
            return False
        if self.keeps_vertex[vertex]:
            return True
        for edge in (vertex, self.previous[vertex]):
            if self.slides[edge] and below.edges.get(edge, False):
                return True
        x = self.slabs.x[vertex]
        return any(
            near(x, low, high, self.tolerance)
            for cell, reached in zip(below.cells, below.reached, strict=True)
            if reached and self.levels.sees(vertex, cell, upwards=False)
            for low, high in reached
        )

    def _slab(
        self, level: int, below: _Below, floors: list[Span]
    ) -> tuple[_Below, tuple[tuple[Span, ...], ...]]:
        """Settle the slab above a level: its sources, and what is known at its top."""
        sources: list[tuple[Span, ...]] = []
        reached: list[tuple[Span, ...]] = []
        edges: dict[int, bool] = {}
        for cell in self.slabs.cells[level]:
            feet = [self._foot(level, side, below) for side in (cell.left, cell.right)]
            grown = () if cell.in_target else self._sources(level, cell, feet, below, floors)
            for side, foot in zip((cell.left, cell.right), feet, strict=True):
                if side != BORDER:
                    edges[side] = self._side(side, cell, foot, grown)
            sources.append(grown)
            reached.append(self._ceiling(cell, grown))
        return _Below(self.slabs.cells[level], tuple(reached), edges), tuple(sources)

    def _foot(self, level: int, edge: int, below: _Below) -> bool:
        """Whether the lowest point of an edge in the slab above a level is in `N`."""
        if edge == BORDER:
            return False
        for vertex in (edge, self.next[edge]):
            if self.slabs.level[vertex] == level:
                return self.vertices[vertex]
        return below.edges[edge]  # also where an interval of the target ends at the level

    def _sources(
        self, level: int, cell: Cell, feet: list[bool], below: _Below, floors: list[Span]
    ) -> tuple[Span, ...]:
        """The places of a cell's floor in `N`, widened where a side is."""
        # an edge ends before its end vertex, which speaks for itself: no touching in a point
        places = [
            (low, high)
            for low, high in self._clipped(floors, cell.floor)
            if high - low > self.tolerance
        ]
        for lower, reached in zip(below.cells, below.reached, strict=True):
            view = (max(lower.ceiling[0], cell.floor[0]), min(lower.ceiling[1], cell.floor[1]))
            places.extend(self._clipped(reached, view))
        for vertex in self.levels.at_level[level]:
            if self.vertices[vertex] and self.levels.sees(vertex, cell, upwards=True):
                x = min(max(self.slabs.x[vertex], cell.floor[0]), cell.floor[1])
                places.append((x, x))
        if self._feeds(cell.left, cell, feet[0]):
            places.append((-math.inf, cell.floor[0]))
        if self._feeds(cell.right, cell, feet[1]):
            places.append((cell.floor[1], math.inf))
        return merged(places)

    def _feeds(self, edge: int, cell: Cell, foot: bool) -> bool:
        """Whether all of a side is in `N`, by itself or because its foot is."""
        if edge == BORDER or self._in_target(edge, cell):
            return False
        return self.keeps[edge] or (self.slides[edge] and foot)

    def _side(self, edge: int, cell: Cell, foot: bool, sources: tuple[Span, ...]) -> bool:
        """Settle the part of an edge beside a cell; whether its top is in `N`."""
        if self._in_target(edge, cell):
            return False
        bottom, top = cell.bottom, cell.top
        parts: list[Span] = []
        if self._feeds(edge, cell, foot):
            parts = [(bottom, top)]
        elif self.leaves[edge]:
            parts = self._left_for(sources, cell, 0 if edge == cell.left else 1)
            if parts and self.slides[edge]:
                parts = [(min(low for low, _ in parts), top)]
        for low, high in parts:
            ends = (self.levels.distance(edge, low), self.levels.distance(edge, high))
            self.edges[edge].append((min(ends), max(ends)))
        return any(high >= top - self.tolerance for _, high in parts)

    def _left_for(self, sources: tuple[Span, ...], cell: Cell, side: int) -> list[Span]:
        """The heights at which a side's points fly to a source within the cell."""
        height = cell.top - cell.bottom
        reach = self.spread * height
        start, end = cell.floor[side], cell.ceiling[side]
        parts: list[Span] = []
        for low, high in sources:
            after = where_positive(start - low, end - low + reach, self.tolerance)
            before = where_positive(high - start, high - end + reach, self.tolerance)
            begin, stop = max(after[0], before[0]), min(after[1], before[1])
            if begin <= stop:
                parts.append((cell.bottom + begin * height, cell.bottom + stop * height))
        return parts

    def _ceiling(self, cell: Cell, sources: tuple[Span, ...]) -> tuple[Span, ...]:
        """The places of a cell's ceiling in `N`."""
        reach = self.spread * (cell.top - cell.bottom)
        grown = [(low - reach, high + reach) for low, high in sources]
        return merged(self._clipped(grown, cell.ceiling, touching=True))

    def _clipped(self, spans: Iterable[Span], view: Span, touching: bool = False) -> list[Span]:
        """What lies in the view, which must have some width unless `touching`."""
        if not touching and view[1] - view[0] <= self.tolerance:
            return []
        parts = ((max(low, view[0]), min(high, view[1])) for low, high in spans)
        return [
            (min(low, high), max(low, high)) for low, high in parts if low <= high + self.tolerance
        ]

    def _in_target(self, edge: int, cell: Cell) -> bool:
        middle = 0.5 * (cell.bottom + cell.top)
        return not self.open[edge] and self.target.has(edge, self.levels.distance(edge, middle))


def merged(spans: Iterable[Span]) -> tuple[Span, ...]:
    """The union of intervals, ascending and disjoint."""
    union: list[Span] = []
    for low, high in sorted(spans):
        if union and low <= union[-1][1]:
            union[-1] = (union[-1][0], max(union[-1][1], high))
        else:
            union.append((low, high))
    return tuple(union)
