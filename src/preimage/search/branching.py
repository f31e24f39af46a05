"""Which region the first reading of the position tells, before anything moves (theory 7)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Generic, Protocol, TypeVar

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.start import Start, StartKind, covered
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.preimages.setting import Setting
from preimage.recognition.outside import Outside, contact_segments, outside


class Ranked(Protocol):
    """A region with the number of motions that remain from it."""

    @property
    def rank(self) -> int:
        """The most motions that remain."""

    @property
    def region(self) -> Region:
        """From where."""


Choice = TypeVar("Choice", bound=Ranked)

MOST = 64
"""So many regions, the ones that leave least of the start out, are tried together."""


@dataclass(slots=True, eq=False)
class Branching(Generic[Choice]):
    """Whether a start is solved by the regions known so far, and which ones it may choose from.

    Parameters
    ----------
    known : all regions that were seen.
    rest : the part of the start, if that is a region, in none of them.
    whole : those among the last ones that hold the whole start.
    """

    setting: Setting
    start: Start
    known: list[Choice] = field(default_factory=list)
    rest: Outside | None = None
    whole: list[Choice] = field(default_factory=list)

    def further(self, regions: Sequence[Choice]) -> tuple[Choice, ...]:
        """See more regions; the ones to choose from, or none while the start is not solved."""
        space, start = self.setting.space, self.start
        self.known += regions
        ranked = sorted(regions, key=lambda one: one.rank)
        self.whole = [known for known in ranked if covered(start, known.region, space)]
        if self.whole:
            return (self.whole[0],)
        if start.kind is not StartKind.REGION or np.isinf(self.setting.uncertainty.position):
            return ()
        for known in regions:
            left = start.region if self.rest is None else Region(self.rest.area, self.rest.contact)
            if left.is_empty:
                break
            self.rest = outside(space, known.region, left)
        if self.rest is None or not self.rest.is_empty:
            return ()
        return choices(self.setting, start, self.known)


def choices(setting: Setting, start: Start, regions: Sequence[Choice]) -> tuple[Choice, ...]:
    """The regions of which the first reading surely tells one; none if it does not.

    One that holds the whole start is enough, the one with the fewest motions. Else the position
    is read once: the start I is solved iff every reading q leaves `I & D(q, rho)` inside one
    region, that is, iff no q is in `(I - P) (+) D(rho)` for all regions P (theory 7, paper 8).
    """
    space = setting.space
    for known in sorted(regions, key=lambda one: one.rank):
        if covered(start, known.region, space):
            return (known,)
    position = setting.uncertainty.position
    if start.kind is not StartKind.REGION or np.isinf(position):
        return ()
    radius = max(position, space.tolerance.length) + space.tolerance.length
    chosen: list[tuple[Choice, Area]] = []
    doubtful: Area | None = None
    for known in sorted(regions, key=lambda one: _left(setting, start, one.region))[:MOST]:
        blind = _blind(setting, start, known.region, radius)
        both = blind if doubtful is None else areas.intersection(doubtful, blind)
        if doubtful is not None and both.measure >= doubtful.measure:
            continue
        chosen.append((known, blind))
        doubtful = both
        if doubtful.is_empty:
            return _without_idle(chosen)
    return ()


def _left(setting: Setting, start: Start, region: Region) -> float:
    """How much of a start lies outside a region; its contact counts by the tolerance alone."""
    rest = outside(setting.space, region, start.region)
    return rest.area.measure + setting.space.tolerance.length * rest.contact.total_length


def _blind(setting: Setting, start: Start, region: Region, radius: float) -> Area:
    """The readings that leave a start outside a region possible: `(I - P) (+) D(rho)`, and more."""
    space = setting.space
    rest = outside(space, region, start.region)
    contact = contact_segments(space.contact, rest.contact)
    around = inflate.outer_stadiums(contact.starts, contact.ends, radius, setting.arc_tolerance)
    if rest.area.is_empty:
        return around
    return areas.union(inflate.grow(rest.area, radius, setting.arc_tolerance), around)


def _without_idle(chosen: list[tuple[Choice, Area]]) -> tuple[Choice, ...]:
    """Those without which some reading would tell nothing; of equal use the longest go first."""
    kept = list(chosen)
    for one in sorted(chosen, key=lambda pair: -pair[0].rank):
        others = [blind for known, blind in kept if known is not one[0]]
        if others and _common(others).is_empty:
            kept = [pair for pair in kept if pair is not one]
    return tuple(known for known, _ in kept)


def _common(blind: list[Area]) -> Area:
    rest = blind[0]
    for area in blind[1:]:
        rest = areas.intersection(rest, area)
    return rest
