"""Which region the first reading of the position tells, before anything moves (theory 7)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.start import Start, StartKind, covered
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.preimages.setting import Setting
from preimage.recognition.outside import contact_segments, outside


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


def choices(setting: Setting, start: Start, regions: Sequence[Choice]) -> tuple[Choice, ...]:
    """The regions of which the first reading surely tells one; none if it does not.

    One that holds the whole start is enough, the one with the fewest motions. Else the position
    is read once: the start I is solved iff every reading q leaves `I & D(q, rho)` inside one
    region, that is, iff no q is in `(I - P) (+) D(rho)` for all regions P (theory 7, paper 8).

    Parameters
    ----------
    regions : by rank.
    """
    space = setting.space
    for known in sorted(regions, key=lambda one: one.rank):
        if covered(start, known.region, space):
            return (known,)
    position = setting.uncertainty.position
    if start.kind is not StartKind.REGION or np.isinf(position):
        return ()
    radius = max(position, space.tolerance.length) + space.tolerance.length
    left = sorted(
        ((known, _blind(setting, start, known.region, radius)) for known in regions),
        key=lambda one: one[1].measure,
    )[:MOST]
    chosen: list[tuple[Choice, Area]] = []
    doubtful: Area | None = None
    for known, blind in left:
        rest = blind if doubtful is None else areas.intersection(doubtful, blind)
        if doubtful is not None and rest.measure >= doubtful.measure:
            continue
        chosen.append((known, blind))
        doubtful = rest
        if doubtful.is_empty:
            return _without_idle(chosen)
    return ()


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
