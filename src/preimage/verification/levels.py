"""Contact space among the levels of slabs: which features are where, and what they touch."""

from __future__ import annotations

import math

from preimage.configuration.contact import ContactSpace
from preimage.configuration.contact_set import ContactSet
from preimage.verification.slabs import Cell, Slabs, Span


class Levels:
    """One contact space in one set of slabs.

    Parameters
    ----------
    tolerance : what is no further away touches, in the unit of length.
    """

    def __init__(self, contact: ContactSpace, slabs: Slabs, tolerance: float) -> None:
        self.slabs, self.tolerance = slabs, tolerance
        self.next: list[int] = contact.next.tolist()
        self.previous: list[int] = contact.previous.tolist()
        self.length: list[float] = contact.length.tolist()
        count = len(slabs.heights)
        self.at_level: list[list[int]] = [[] for _ in range(count)]
        self.level_edges: list[list[int]] = [[] for _ in range(count)]
        for vertex, level in enumerate(slabs.level):
            self.at_level[level].append(vertex)
            if slabs.level[self.next[vertex]] == level:
                self.level_edges[level].append(vertex)

    def is_level(self, edge: int) -> bool:
        """Whether both ends of an edge are on one level."""
        return self.slabs.level[edge] == self.slabs.level[self.next[edge]]

    def is_floor(self, edge: int) -> bool:
        """Whether a level edge has free space above it."""
        return self.slabs.x[self.next[edge]] >= self.slabs.x[edge]

    def distance(self, edge: int, height: float) -> float:
        """How far along an edge that is not level it is at a height."""
        heights, level = self.slabs.heights, self.slabs.level
        start, end = heights[level[edge]], heights[level[self.next[edge]]]
        return self.length[edge] * (height - start) / (end - start)

    def place(self, edge: int, distance: float) -> tuple[float, float]:
        """The point of an edge at a distance from its start, in the turned plane."""
        slabs, end = self.slabs, self.next[edge]
        part = distance / self.length[edge]
        low, high = slabs.heights[slabs.level[edge]], slabs.heights[slabs.level[end]]
        return slabs.x[edge] + part * (slabs.x[end] - slabs.x[edge]), low + part * (high - low)

    def corner(self, vertex: int) -> tuple[float, float]:
        """Where a vertex is, in the turned plane."""
        return self.slabs.x[vertex], self.slabs.heights[self.slabs.level[vertex]]

    def sees(self, vertex: int, cell: Cell, upwards: bool) -> bool:
        """Whether a cell above or below a vertex lies in its wedge of free space, touching it."""
        here = cell.floor if upwards else cell.ceiling
        x = self.slabs.x[vertex]
        if not near(x, *here, self.tolerance):
            return False
        middle = 0.25 * (sum(cell.floor) + sum(cell.ceiling))
        rise = 0.5 * (cell.top - cell.bottom)
        towards = math.atan2(rise if upwards else -rise, middle - x)
        first = self._angle(vertex, self.next[vertex])
        span = (self._angle(vertex, self.previous[vertex]) - first) % math.tau
        return (towards - first) % math.tau < span

    def _angle(self, vertex: int, other: int) -> float:
        """The angle at which one vertex sees another, in the turned plane."""
        slabs = self.slabs
        return math.atan2(
            slabs.heights[slabs.level[other]] - slabs.heights[slabs.level[vertex]],
            slabs.x[other] - slabs.x[vertex],
        )


class Marked:
    """Membership in a contact set."""

    def __init__(self, contact: ContactSet, tolerance: float) -> None:
        self._intervals: dict[int, list[Span]] = {}
        ends = zip(contact.edge.tolist(), contact.low.tolist(), contact.high.tolist(), strict=True)
        for edge, low, high in ends:
            self._intervals.setdefault(edge, []).append((low, high))
        self._vertices = frozenset(contact.vertices.tolist())
        self._tolerance = tolerance

    def has(self, edge: int, distance: float) -> bool:
        """Whether the point at `distance` from the start of `edge` is in the set."""
        slack = self._tolerance
        return any(
            low - slack <= distance <= high + slack for low, high in self._intervals.get(edge, ())
        )

    def has_vertex(self, vertex: int) -> bool:
        """Whether the vertex is in the set."""
        return vertex in self._vertices

    def intervals(self, edge: int) -> tuple[Span, ...]:
        """The parts of the edge that are in the set."""
        return tuple(self._intervals.get(edge, ()))

    def gaps(self, edge: int, length: float) -> tuple[Span, ...]:
        """The parts of the edge that are not in the set."""
        gaps: list[Span] = []
        begin = 0.0
        for low, high in sorted(self._intervals.get(edge, ())):
            gaps.append((begin, low))
            begin = high
        gaps.append((begin, length))
        return tuple(gap for gap in gaps if gap[1] - gap[0] > self._tolerance)


def near(x: float, low: float, high: float, tolerance: float) -> bool:
    """Whether `x` lies in an interval, ties included."""
    return low - tolerance <= x <= high + tolerance


def where_positive(first: float, last: float, tolerance: float) -> Span:
    """Where on [0, 1] the linear function with these values at its ends is not negative."""
    first = 0.0 if abs(first) <= tolerance else first
    last = 0.0 if abs(last) <= tolerance else last
    if first >= 0.0:
        return (0.0, 1.0 if last >= 0.0 else first / (first - last))
    return (1.0, 0.0) if last < 0.0 else (first / (first - last), 1.0)
