"""The maximal backprojection, slowly, from its definition: the judge of the fast one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.verification.avoidable import Avoidable, avoidable_set
from preimage.verification.features import features_of
from preimage.verification.levels import near
from preimage.verification.slabs import Cell, Slabs, Span, cut

SLIVER = 8.0
"""Pieces of `N` thinner than so many tolerances count as lines: `B` is regular (theory 4)."""


@dataclass(frozen=True, eq=False)
class ReferenceBackprojection:
    """The starts from which every admissible trajectory meets the target (theory 4).

    Parameters
    ----------
    space, target : what it is the backprojection in, and of.
    slabs, avoidable : free space in slabs, and the avoidable set: the starts that do not belong.
    """

    space: ConfigurationSpace
    target: Region
    slabs: Slabs
    avoidable: Avoidable

    def holds_free(self, x: float, y: float) -> bool:
        """Whether a point of free space belongs; on a border line of `B` it does not.

        A point that is not in free space does not belong either.
        """
        if self.target.area.contains(x, y):
            return True
        across, height = self.slabs.frame.turned(np.array([[x, y]]))[0].tolist()
        slack = self.space.tolerance.length
        found = False
        for cells, sources in zip(self.slabs.cells, self.avoidable.sources, strict=True):
            if not cells or not near(height, cells[0].bottom, cells[0].top, slack):
                continue
            for cell, places in zip(cells, sources, strict=True):
                if not near(across, *cell.width_at(height), slack):
                    continue
                found = True
                reach = self.avoidable.spread * max(0.0, height - cell.bottom) + slack
                if any(low - reach <= across <= high + reach for low, high in places):
                    return False
        return found

    def holds_edge(self, edge: int, distance: float) -> bool:
        """Whether the point at `distance` from the start of a contact edge belongs."""
        slack = self.space.tolerance.length
        if self.space.contact.open[edge]:
            return False
        if self.target.contact.contains(edge, distance, slack):
            return True
        return not any(
            low - slack <= distance <= high + slack for low, high in self.avoidable.edges[edge]
        )

    def holds_vertex(self, vertex: int) -> bool:
        """Whether a contact vertex belongs."""
        return not self.avoidable.vertices[vertex]

    @cached_property
    def region(self) -> Region:
        """All of it: free space without the avoidable set, closed, and the contact part."""
        return Region(self.area, self.contact)

    @cached_property
    def area(self) -> Area:
        """The part in free space, closed; without slivers on either side of its border."""
        grid, tolerance = self.space.tolerance.grid, self.space.tolerance.length
        pieces = [
            Area.polygon(self.slabs.frame.restored(np.array(corners)))
            for cells, sources in zip(self.slabs.cells, self.avoidable.sources, strict=True)
            for cell, places in zip(cells, sources, strict=True)
            for place in places
            if (corners := self._piece(cell, place)) is not None
        ]
        # the pieces share borders up to rounding; without a grid the union may lose some of them
        avoided = areas.united_on_grid(pieces, grid) if pieces else Area.empty()
        rest = areas.difference_on_grid(self.space.free, avoided, grid)
        if areas.is_subset(rest, Area.empty(), tolerance):
            return Area.empty()
        return areas.regularised(rest, tolerance)

    @cached_property
    def contact(self) -> ContactSet:
        """The part in contact space."""
        contact, tolerance = self.space.contact, self.space.tolerance.length
        parts = [
            (edge, low, high)
            for edge in contact.edges.tolist()
            for low, high in self.avoidable.edges[edge]
        ]
        avoided = ContactSet.of(
            [edge for edge, _, _ in parts],
            [low for _, low, _ in parts],
            [high for _, _, high in parts],
            [vertex for vertex in contact.vertices.tolist() if self.avoidable.vertices[vertex]],
            tolerance,
        )
        rest = contact_set.complement(avoided, contact, tolerance)
        return contact_set.union(rest, self.target.contact, tolerance)

    def _piece(self, cell: Cell, place: Span) -> list[Span] | None:
        """The corners of what grows from one source in a cell, unless that is a line."""
        height = cell.top - cell.bottom
        reach = self.avoidable.spread * height
        left = (cell.floor[0], cell.ceiling[0], place[0], place[0] - reach)
        right = (cell.floor[1], cell.ceiling[1], place[1], place[1] + reach)
        parts = {0.0, 1.0}
        for a, b in (
            (left[:2], left[2:]),
            (right[:2], right[2:]),
            (left[:2], right[2:]),
            (left[2:], right[:2]),
        ):
            parts.update(_meeting(a, b))
        lows: list[Span] = []
        highs: list[Span] = []
        widest = 0.0
        for part in sorted(parts):
            low = max(_at(left[0], left[1], part), _at(left[2], left[3], part))
            high = min(_at(right[0], right[1], part), _at(right[2], right[3], part))
            if low <= high + self.space.tolerance.length:
                h = cell.bottom + part * height
                lows.append((low, h))
                highs.append((max(low, high), h))
                widest = max(widest, high - low)
        if widest <= SLIVER * self.space.tolerance.length:
            return None
        slack = self.space.tolerance.length
        corners: list[Span] = []
        for corner in lows + highs[::-1]:
            if all(math.dist(corner, other) > slack for other in corners):
                corners.append(corner)
        return corners if len(corners) > 2 else None


def reference_backprojection(
    space: ConfigurationSpace,
    target: Region,
    direction: float,
    control: float,
    friction: float,
) -> ReferenceBackprojection:
    """The maximal backprojection `B(T, v)`, as the complement of the avoidable set `N`.

    `N` is the least set that holds every point outside `T` of a feature that may stick, the open
    sides of the window, and every start from which some admissible motion reaches `N` without
    meeting `T` (theory 4, paper 5.2). Computed in slabs between neighbouring vertices, everything
    anew in each, in O(n^2); how, and how ties are decided: see `preimage.verification.avoidable`.

    Parameters
    ----------
    target : `T`, closed within each feature.
    direction, control, friction : `v`, `theta` in [0, pi/2) and `phi` in [0, pi/2], in radians.

    A goal of length 2 on the floor of an open box, `v` downwards: a triangle of height
    `1 / tan(theta)` above it.

    >>> from preimage.configuration.contact import ContactSpace
    >>> from preimage.geometry.tolerance import Tolerance
    >>> window = (-4.0, 0.0, 4.0, 4.0)
    >>> border = ContactSpace(
    ...     points=np.array([(-4.0, 0.0), (4.0, 0.0), (4.0, 4.0), (-4.0, 4.0)]),
    ...     next=np.array([1, 2, 3, 0], dtype=np.int32),
    ...     open=np.array([False, True, True, True]),
    ... )
    >>> box, none = Area.box(*window), Area.empty()
    >>> space = ConfigurationSpace(window, Tolerance.for_window(*window), box, none, border)
    >>> goal = Region(none, ContactSet.of([0], [3.0], [5.0], [], space.tolerance.length))
    >>> found = reference_backprojection(space, goal, -0.5 * math.pi, math.atan(0.5), 1.0)
    >>> found.holds_free(0.0, 1.9), found.holds_free(0.0, 2.1), found.holds_edge(0, 5.1)
    (True, False, False)
    >>> round(found.area.measure, 9)
    2.0
    """
    tolerance = space.tolerance
    slabs = cut(space, target, direction)
    features = features_of(space.contact, direction, control, friction, tolerance.angle)
    avoidable = avoidable_set(space.contact, slabs, features, target.contact, control, tolerance)
    return ReferenceBackprojection(space, target, slabs, avoidable)


def _at(first: float, last: float, part: float) -> float:
    return first + part * (last - first) if math.isfinite(first) else first


def _meeting(a: tuple[float, float], b: tuple[float, float]) -> list[float]:
    """Where on [0, 1] two linear functions meet, given by their values at its ends."""
    first, last = a[0] - b[0], a[1] - b[1]
    if not math.isfinite(first) or first * last >= 0.0:
        return []
    return [first / (first - last)]
