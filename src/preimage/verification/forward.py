"""Forward projections, slowly, from their definition: where a motion may get (theory 4)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.verification.features import Features, features_of
from preimage.verification.flights import Flight, Point
from preimage.verification.paths import Stop, Ways
from preimage.verification.slabs import Slabs, cut
from preimage.verification.spreading import Reached, Spreading


@dataclass(frozen=True, eq=False)
class ForwardProjection:
    """All that some admissible trajectory visits before it has met the stop set.

    Parameters
    ----------
    space, start, stop : where, from where, and where it ends.
    slabs, features, reached : free space in slabs, what features do, and all that is reached.
    """

    space: ConfigurationSpace
    start: Region
    stop: Region
    slabs: Slabs
    features: Features
    reached: Reached
    _spreading: Spreading

    @property
    def escapes(self) -> tuple[int, ...]:
        """The open sides, and (as `n + i`) the vertices beside them, by which it may leave."""
        return tuple(sorted(self.reached.escapes))

    @property
    def rests(self) -> tuple[tuple[int, float, float], ...]:
        """Features outside the stop set on which it may stay for ever, and which part of them."""
        found = [
            (edge, low, high)
            for edge, spans in enumerate(self.reached.spans)
            if self.features.keeps[edge]
            for low, high in spans
        ]
        count = len(self.space.contact)
        held = [
            (count + vertex, 0.0, 0.0)
            for vertex in self.vertices
            if self.features.keeps_vertex[vertex]
            and not self.stop.contact.has_vertex(vertex)
            and count + vertex not in self.reached.escapes
        ]
        return (*found, *held)

    @property
    def vertices(self) -> tuple[int, ...]:
        """The vertices reached, those of the stop set too."""
        return tuple(sorted(self.reached.vertices))

    @cached_property
    def ways(self) -> Ways:
        """Ways to what is reached."""
        return Ways(self._spreading)

    @cached_property
    def contact(self) -> ContactSet:
        """The part in contact space, with what is met of the stop set."""
        parts = [
            (edge, low, high)
            for every in (self.reached.spans, self.reached.met)
            for edge, spans in enumerate(every)
            for low, high in spans
        ]
        known = set(self.space.contact.vertices.tolist())
        return ContactSet.of(
            [edge for edge, _, _ in parts],
            [low for _, low, _ in parts],
            [high for _, _, high in parts],
            [vertex for vertex in self.vertices if vertex in known],
            self.space.tolerance.length,
        )

    @cached_property
    def area(self) -> Area:
        """The part in free space, closed; of the stop set only what it starts in."""
        grid = self.space.tolerance.grid
        pieces = [
            areas.snapped(Area.polygon(self.slabs.frame.restored(np.array(corners))), grid)
            for flight in self.reached.flights
            for corners in _corners(flight, self.space.tolerance.length)
        ]
        if not self.start.area.is_empty and not self.stop.area.is_empty:
            pieces.append(areas.intersection(self.start.area, self.stop.area))
        if not pieces:
            return Area.empty()
        united = areas.united_on_grid(pieces, grid)
        return areas.regularised(united, self.space.tolerance.length)

    @cached_property
    def region(self) -> Region:
        """All of it."""
        return Region(self.area, self.contact)

    def restored(self, place: Point) -> Point:
        """A place of the turned plane, in the plane."""
        x, y = self.slabs.frame.restored(np.array([place]))[0].tolist()
        return x, y

    def way_to(self, x: float, y: float) -> tuple[Stop, ...] | None:
        """A way to a place of free space; None if nothing flies there."""
        across, height = self.slabs.frame.turned(np.array([[x, y]]))[0].tolist()
        for flight in self.reached.flights:
            for strip in flight.strips:
                if not strip.bottom <= height <= strip.top:
                    continue
                drop = strip.top - strip.bottom
                part = (strip.top - height) / drop if drop else 0.0
                ends = [side[0] + part * (side[1] - side[0]) for side in (strip.left, strip.right)]
                sides = flight.cell.width_at(height)
                if max(ends[0], sides[0]) <= across <= min(ends[1], sides[1]):
                    return self.ways.to_free(flight, (across, height))
        return None


def forward_projection(
    space: ConfigurationSpace,
    start: Region,
    direction: float,
    control: float,
    friction: float,
    stop: Region | None = None,
) -> ForwardProjection:
    """`FP_v(R)`: all points that some admissible trajectory from `R` visits (theory 4).

    Both slides of an edge, sticking and escaping count; with a stop set, that is met, not crossed.
    Computed in slabs between neighbouring vertices, pass after pass; how: see
    `preimage.verification.spreading`.

    Parameters
    ----------
    start, stop : `R` and the stop set, closed within each feature.
    direction, control, friction : `v`, `theta` in [0, pi/2) and `phi` in [0, pi/2], in radians.

    From a square, downwards, onto the floor of a box: it spreads by the height times `tan(theta)`.

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
    >>> start = Region(Area.box(-1.0, 1.0, 1.0, 2.0), ContactSet.empty())
    >>> found = forward_projection(space, start, -0.5 * math.pi, math.atan(0.5), 1.0)
    >>> found.contact.low.round(9), found.contact.high.round(9), found.escapes
    (array([2.]), array([6.]), ())
    >>> round(found.area.measure, 9)
    6.0
    """
    tolerance = space.tolerance
    stop = Region.empty() if stop is None else stop
    slabs = cut(space, stop, direction, start.area)
    features = features_of(space.contact, direction, control, friction, tolerance.angle)
    spread = math.tan(max(control, tolerance.angle))
    spreading = Spreading(
        space.contact, slabs, features, start.contact, stop.contact, spread, tolerance
    )
    return ForwardProjection(space, start, stop, slabs, features, spreading.run(), spreading)


def _corners(flight: Flight, tolerance: float) -> list[list[Point]]:
    """The corners of what a flight covers, strip by strip, without lines."""
    found: list[list[Point]] = []
    for strip in flight.strips:
        sides = [flight.cell.width_at(h) for h in (strip.top, strip.bottom)]
        parts = {0.0, 1.0}
        lines = [
            strip.left,
            strip.right,
            (sides[0][0], sides[1][0]),
            (sides[0][1], sides[1][1]),
        ]
        for place, one in enumerate(lines):
            for other in lines[place + 1 :]:
                first, last = one[0] - other[0], one[1] - other[1]
                if first * last < 0.0:
                    parts.add(first / (first - last))
        lows: list[Point] = []
        highs: list[Point] = []
        widest = 0.0
        for part in sorted(parts):
            at = [line[0] + part * (line[1] - line[0]) for line in lines]
            low, high = max(at[0], at[2]), min(at[1], at[3])
            if low <= high + tolerance:
                height = strip.top - part * (strip.top - strip.bottom)
                lows.append((low, height))
                highs.append((max(low, high), height))
                widest = max(widest, high - low)
        corners: list[Point] = []
        for corner in lows + highs[::-1]:
            if all(math.dist(corner, other) > tolerance for other in corners):
                corners.append(corner)
        if widest > tolerance and len(corners) > 2:
            found.append(corners)
    return found
