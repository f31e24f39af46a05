"""How motions spread: the reached set, slab by slab from above, until nothing new is reached.

Derivation. What flies in a cell (see `preimage.verification.flights`) leaves it through the floor,
or touches a side. A side that can be slid on carries it on, up to the stop set or to a vertex; if
it can be slid up as well, up too, which is why one pass downwards may not be enough. There are
finitely many vertices, and gaps of edges between parts of the stop set, and a further pass is
needed only when one of them is newly reached from below. In a cell, what takes off from a side that
was touched from within the cell stays within the flight that touched it: such a side falls within
the cone.

Ties within the tolerance are nature's: what is touched up to the tolerance is touched.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass

from preimage.configuration.contact import ContactSpace
from preimage.configuration.contact_set import ContactSet
from preimage.geometry.tolerance import Tolerance
from preimage.verification.features import Features
from preimage.verification.flights import (
    Entry,
    Flight,
    FromAbove,
    FromEdge,
    FromVertex,
    from_ceiling,
    from_segment,
    from_start,
    leaving,
    together,
    touched,
    within,
)
from preimage.verification.levels import Levels, Marked, near
from preimage.verification.slabs import BORDER, Cell, Slabs, Span

Row = list[tuple[Cell, list[Entry]]]
"""The cells of a slab, and what leaves each through its floor."""


@dataclass(frozen=True, slots=True, eq=False)
class Touch:
    """An edge or a vertex is reached.

    Parameters
    ----------
    low, high : which part of the edge.
    time : touches are numbered, so that each comes from earlier ones.
    origin : the flight, the vertex or the edge from which it is reached; None at the start.
    """

    low: float
    high: float
    time: int
    origin: Flight | FromVertex | FromEdge | None


@dataclass(slots=True, eq=False)
class Reached:
    """All that is reached, and how.

    Parameters
    ----------
    touches : for each edge how it was touched outside the stop set.
    spans : for each edge what is reached outside the stop set, slides included.
    met : for each edge what of the stop set is reached.
    vertices : how each vertex was reached first, the stop set's too.
    flights : all flights, of the last pass.
    escapes : open sides and their ends that are reached: feature, distance, and the way.
    """

    touches: list[list[Touch]]
    spans: list[tuple[Span, ...]]
    met: list[tuple[Span, ...]]
    vertices: dict[int, Touch]
    flights: list[Flight]
    escapes: dict[int, Touch]


class Spreading:
    """The propagation of one motion; `run` gives what is reached.

    Parameters
    ----------
    start, stop : contact parts of the start and of the stop set; their areas are in the slabs.
    spread : `tan(theta)`.
    """

    def __init__(
        self,
        contact: ContactSpace,
        slabs: Slabs,
        features: Features,
        start: ContactSet,
        stop: ContactSet,
        spread: float,
        tolerance: Tolerance,
    ) -> None:
        self.slabs, self.spread = slabs, spread
        self.tolerance, self.point = tolerance.length, tolerance.grid
        self.levels = Levels(contact, slabs, self.tolerance)
        self.start, self.stop = start, Marked(stop, self.tolerance)
        self.open: list[bool] = contact.open.tolist()
        self.forward: list[bool] = features.forward.tolist()
        self.backward: list[bool] = features.backward.tolist()
        self.leaves: list[bool] = features.leaves.tolist()
        self.hit: list[bool] = features.slides.tolist()  # some v* leads onto the edge
        count = len(contact)
        self.gaps = [self.stop.gaps(edge, self.levels.length[edge]) for edge in range(count)]
        self.reached = Reached(
            touches=[[] for _ in range(count)],
            spans=[() for _ in range(count)],
            met=[() for _ in range(count)],
            vertices={},
            flights=[],
            escapes={},
        )
        self.time = 0
        self.pending: deque[tuple[int, FromVertex | FromEdge]] = deque()

    def run(self) -> Reached:
        """Pass after pass, until nothing is new."""
        contact = self.start
        ends = zip(contact.edge.tolist(), contact.low.tolist(), contact.high.tolist(), strict=True)
        for edge, low, high in ends:
            self._touch_edge(edge, low, high, None)
        for vertex in contact.vertices.tolist():
            self._touch_vertex(vertex, None)
        before = -1
        while before != self.time:
            before = self.time
            self.reached.flights = []
            self._pass()
        return self.reached

    # --- contact --------------------------------------------------------------------------------

    def _touch_edge(
        self, edge: int, low: float, high: float, origin: Flight | FromVertex | None
    ) -> None:
        """Someone is on this part of an edge: he may slide on."""
        reached, end = self.reached, self.levels.length[edge] - self.tolerance
        at_end = high - low <= self.point and (high <= self.tolerance or low >= end)
        if at_end and isinstance(origin, Flight):
            return  # that is the vertex, which speaks for itself
        if self.open[edge]:
            if edge not in reached.escapes:
                self.time += 1
                reached.escapes[edge] = Touch(low, high, self.time, origin)
            return
        for begin, end in self.stop.intervals(edge):
            if low <= end + self.tolerance and high >= begin - self.tolerance:
                part = (min(max(low, begin), end), max(min(high, end), begin))
                reached.met[edge] = joined((*reached.met[edge], part))
        for begin, end in self.gaps[edge]:
            first, last = max(low, begin), min(high, end)
            # who starts where the stop set ends has met it
            if first <= last + (self.tolerance if origin is not None else -self.tolerance):
                self._slide(edge, (begin, end), min(first, last), max(first, last), origin)
        self._settle()

    def _slide(
        self, edge: int, gap: Span, low: float, high: float, origin: Flight | FromVertex | None
    ) -> None:
        """The same in one gap between parts of the stop set."""
        reached = self.reached
        first = gap[0] if self.backward[edge] else low
        last = gap[1] if self.forward[edge] else high
        slack = self.tolerance
        if any(a - slack <= first and last <= b + slack for a, b in reached.spans[edge]):
            return
        self.time += 1
        reached.touches[edge].append(Touch(low, high, self.time, origin))
        reached.spans[edge] = joined((*reached.spans[edge], (first, last)))
        onward = FromEdge(edge, self.time + 1)
        if self.forward[edge]:
            if gap[1] >= self.levels.length[edge]:
                self.pending.append((self.levels.next[edge], onward))
            else:
                reached.met[edge] = joined((*reached.met[edge], (gap[1], gap[1])))
        if self.backward[edge]:
            if gap[0] <= 0.0:
                self.pending.append((edge, onward))
            else:
                reached.met[edge] = joined((*reached.met[edge], (gap[0], gap[0])))

    def _touch_vertex(self, vertex: int, origin: Flight | FromEdge | None) -> None:
        """Someone is at a vertex: he may slide onto its edges."""
        reached = self.reached
        if vertex in reached.vertices:
            return
        self.time += 1
        touch = Touch(0.0, 0.0, self.time, origin)
        reached.vertices[vertex] = touch
        if self.stop.has_vertex(vertex):
            return
        before = self.levels.previous[vertex]
        if self.open[vertex] or self.open[before]:
            reached.escapes.setdefault(len(self.open) + vertex, touch)
            return
        if self.forward[vertex]:
            self._touch_edge(vertex, 0.0, 0.0, FromVertex(vertex))
        if self.backward[before]:
            length = self.levels.length[before]
            self._touch_edge(before, length, length, FromVertex(vertex))

    def _settle(self) -> None:
        """Go on from the vertices at which slides have ended."""
        while self.pending:
            vertex, origin = self.pending.popleft()
            if isinstance(origin, FromEdge):
                self._touch_vertex(vertex, origin)

    def _passes(self, vertex: int) -> bool:
        """Whether someone is at a vertex who may fly off."""
        before = self.levels.previous[vertex]
        return (
            vertex in self.reached.vertices
            and not self.stop.has_vertex(vertex)
            and not self.open[vertex]
            and not self.open[before]
        )

    # --- free space -----------------------------------------------------------------------------

    def _pass(self) -> None:
        above: Row = []
        for level in reversed(range(len(self.slabs.heights))):
            self._arrive(level, above)
            if level == 0:
                return
            below: Row = []
            for cell in self.slabs.cells[level - 1]:
                if not cell.in_target:
                    flights = list(self._flying_in(level, cell, above))
                    flights.extend(self._taking_off(level, cell))
                    self.reached.flights.extend(flights)
                    below.append((cell, [way for one in flights for way in self._spread(one)]))
            above = below

    def _arrive(self, level: int, above: Row) -> None:
        """Settle the level edges and the vertices of a level."""
        slack = self.tolerance
        for cell, exits in above:
            if not exits:
                continue
            for edge in self.levels.level_edges[level]:
                # the view of an edge with free space below has no width
                start, end = self.slabs.x[edge], self.slabs.x[self.levels.next[edge]]
                view = (max(start, cell.floor[0]), min(end, cell.floor[1]))
                for low, high, flight in within(exits, view, slack):
                    self._touch_edge(edge, low - start, high - start, flight)
            for vertex in self.levels.at_level[level]:
                if vertex in self.reached.vertices or not self.levels.sees(vertex, cell, True):
                    continue
                x = self.slabs.x[vertex]
                ways = [flight for low, high, flight in exits if near(x, low, high, slack)]
                if ways:
                    self._touch_vertex(vertex, ways[0])

    def _flying_in(self, level: int, cell: Cell, above: Row) -> Iterator[Flight]:
        """What comes through the ceiling of a cell below a level."""
        entries: list[Entry] = []
        for upper, exits in above:
            view = (max(upper.floor[0], cell.ceiling[0]), min(upper.floor[1], cell.ceiling[1]))
            entries.extend(within(exits, view, self.tolerance))
        for group in together(entries):
            span = (group[0][0], max(high for _, high, _ in group))
            yield from_ceiling(cell, span, self.spread, FromAbove(tuple(group)))

    def _taking_off(self, level: int, cell: Cell) -> Iterator[Flight]:
        """What begins to fly in a cell below a level."""
        left, right = cell.ceiling
        for edge in self.levels.level_edges[level]:
            if self.levels.is_floor(edge) or right - left <= self.tolerance:
                continue
            start = self.slabs.x[edge]
            for low, high in self.reached.spans[edge]:
                span = max(start - high, left), min(start - low, right)
                if span[0] <= span[1]:
                    yield from_ceiling(cell, span, self.spread, FromEdge(edge, self.time + 1))
        for vertex in self.levels.at_level[level]:
            if self._passes(vertex) and self.levels.sees(vertex, cell, upwards=False):
                x = min(max(self.slabs.x[vertex], left), right)
                yield from_ceiling(cell, (x, x), self.spread, FromVertex(vertex))
        for side in (0, 1):
            yield from self._from_side(cell, side)
        for part in self.slabs.starts[level - 1]:
            flight = from_start(cell, part, self.spread, self.tolerance)
            if flight is not None:
                yield flight

    def _from_side(self, cell: Cell, side: int) -> Iterator[Flight]:
        edge = (cell.left, cell.right)[side]
        if edge == BORDER or not self.leaves[edge] or self.open[edge]:
            return
        ends = [self.levels.distance(edge, height) for height in (cell.bottom, cell.top)]
        for low, high in self.reached.spans[edge]:
            first, last = max(low, min(ends)), min(high, max(ends))
            if first > last:
                continue
            parts = sorted((at - ends[0]) / (ends[1] - ends[0]) for at in (first, last))
            points = [
                (
                    cell.floor[side] + part * (cell.ceiling[side] - cell.floor[side]),
                    cell.bottom + part * (cell.top - cell.bottom),
                )
                for part in parts
            ]
            origin = FromEdge(edge, self.time + 1)
            yield from_segment(cell, points[1], points[0], self.spread, origin)

    def _spread(self, flight: Flight) -> Iterator[Entry]:
        """Touch the sides of the cell; where the flight leaves it through the floor."""
        for side, edge in enumerate((flight.cell.left, flight.cell.right)):
            if edge == BORDER or not self.hit[edge]:
                continue
            for low, high in touched(flight, side, self.tolerance):
                ends = self.levels.distance(edge, low), self.levels.distance(edge, high)
                self._touch_edge(edge, min(ends), max(ends), flight)
        yield from leaving(flight, self.tolerance)


def joined(spans: tuple[Span, ...]) -> tuple[Span, ...]:
    """The union of intervals, ascending and disjoint."""
    union: list[Span] = []
    for low, high in sorted(spans):
        if union and low <= union[-1][1]:
            union[-1] = (union[-1][0], max(union[-1][1], high))
        else:
            union.append((low, high))
    return tuple(union)
