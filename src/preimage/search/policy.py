"""From layers of regions to a strategy: what is used of them, and of each motion's goals."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration import region as regions
from preimage.configuration.region import Region
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.preimages.shared import told_of
from preimage.recognition.confusion import told_together
from preimage.search.aims import Field
from preimage.search.conditional import Known, Layers
from preimage.strategy.strategy import Motion, StrategyRegion

ROUNDING = 4.0
"""Slivers so many spacings of the grid thick are what rounding leaves of equal areas."""


@dataclass(slots=True)
class _Used:
    """A region of the policy, and the goals that its motion cannot do without."""

    known: Known
    goals: tuple[Known, ...]
    rank: int


def policy(
    aimed: Field, start: Iterable[Known], goals: tuple[Known, ...]
) -> tuple[StrategyRegion, ...]:
    """The regions that may be come to from those at the start, and the goals; by id.

    Of the goals that a motion may end in, those are left out of which all that is known to be
    attained is known of goals of no greater rank too. So after each motion the robot goes on with
    as few as possible, and ranks are as small as they can be.
    """
    used: dict[int, _Used] = {known.id: _Used(known, (), 0) for known in goals}

    def use(known: Known) -> _Used:
        if known.id not in used:
            needed = _needed(aimed, known)
            most = max(use(goal).rank for goal in needed)
            used[known.id] = _Used(known, needed, most + 1)
        return used[known.id]

    for known in start:
        use(known)
    return tuple(_region(one) for _, one in sorted(used.items()))


def found_so_far(found: Layers) -> tuple[StrategyRegion, ...]:
    """All regions of a search that did not come to its end, by id."""
    return tuple(_region(_Used(known, known.goals, known.rank)) for known in found.regions)


def _needed(aimed: Field, known: Known) -> tuple[Known, ...]:
    """The goals without which something of the target would not be told, by rank."""
    assert known.preimage is not None
    setting, space = aimed.setting, aimed.setting.space
    slack = ROUNDING * space.tolerance.grid
    command = setting.command(known.preimage.direction)
    readings, pool = command.readings, known.preimage.target.sticking.contact
    if len(known.goals) == 1:
        return known.goals
    order = sorted(
        range(len(known.goals)),
        key=lambda place: (known.goals[place].rank, -known.goals[place].region.area.measure),
    )
    sofar = Region.empty()
    kept: list[int] = []
    for place in order:
        core = aimed.goals[place].core
        share = core.kernel(readings) if core is not None else Region.empty()
        if not pool.is_empty:
            held = told_of(setting, known.goals[place].region, pool, command)
            share = regions.union(share, Region(Area.empty(), held), space.tolerance)
        if contact_set.is_subset(share.contact, sofar.contact, slack) and areas.is_subset(
            share.area, sofar.area, slack
        ):
            continue
        kept.append(place)
        sofar = regions.union(sofar, share, space.tolerance)
    lone = np.setdiff1d(known.preimage.target.region.contact.vertices, sofar.contact.vertices)
    rest = [place for place in order if place not in kept]
    while len(lone):
        among = [known.goals[place].region for place in kept]
        told = told_together(space, readings, among, lone, setting.uncertainty)
        lone = np.setdiff1d(lone, told)
        if not len(lone) or not rest:
            break
        kept.append(rest.pop(0))
    return tuple(known.goals[place] for place in sorted(kept, key=order.index))


def _region(used: _Used) -> StrategyRegion:
    known = used.known
    motion = None
    if known.preimage is not None:
        motion = Motion(
            direction=known.preimage.direction,
            goals=tuple(goal.id for goal in used.goals),
            target=known.preimage.target.region,
            termination=known.preimage.termination,
        )
    failure = motion is None and known.id != 0
    return StrategyRegion(known.id, used.rank, known.region, motion, failure)
