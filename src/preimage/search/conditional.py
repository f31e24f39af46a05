"""Conditional strategies: layers of preimages that aim at all regions known (theory 7, paper 8)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.region import Region, is_subset
from preimage.configuration.start import Start, covered, distance_to
from preimage.geometry.area import Floats
from preimage.geometry.tolerance import Tolerance
from preimage.preimages.methods import reach_any
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.preimages.start_search import stateful_preimage
from preimage.preimages.starts import start_as_region
from preimage.search.aims import Aim, Field
from preimage.search.branching import Branching
from preimage.search.limits import Limits, Progress, too_long
from preimage.task.options import Method, Termination

PROBES = 64
"""Points in the box of a region, of which those inside are looked for in others."""


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """A region of the policy: a goal, or where one knows what to command.

    Parameters
    ----------
    rank : the layer that it was made in: so many motions may remain.
    preimage : None for a goal.
    goals : what its motion aims at: regions of lower rank.
    """

    id: int
    rank: int
    region: Region
    preimage: Preimage | None = None
    goals: tuple[Known, ...] = ()


@dataclass(slots=True, eq=False)
class Layers:
    """What a search found.

    Parameters
    ----------
    regions : all regions known, by id; ids grow with the rank.
    aimed : what was aimed at.
    start : the regions that may be chosen at the start; empty if it is not covered.
    others : regions of the same layer any of which would do as well.
    stopped : which limit came first; None if the start was covered or a layer added nothing.
    computed, pruned : how many preimages were computed, and how many of them said nothing new.
    """

    regions: list[Known]
    aimed: Field
    start: tuple[Known, ...] = ()
    others: tuple[Known, ...] = ()
    stopped: str | None = None
    computed: int = 0
    pruned: int = 0

    @property
    def goals(self) -> tuple[Known, ...]:
        """The regions of rank 0."""
        return tuple(known for known in self.regions if known.preimage is None)


def layers(
    setting: Setting,
    goals: Sequence[Region],
    start: Start,
    directions: tuple[float, ...],
    method: Method,
    max_steps: int,
    limits: Limits,
    progress: Callable[[Progress], None] | None = None,
    termination: Termination = Termination.INSTANTANEOUS,
) -> Layers:
    """Add layer to layer until the start is covered, or a layer adds nothing (theory 7).

    In each layer every direction gets the preimage of all regions that are known by then: the
    preimage of a set of goals grows with the set. Knowing to be in it is all that is needed to
    command its direction, so one region a direction and layer suffices; but where parts that stick
    for sure had to go, since they would be confused, each goal that lost one is aimed at alone too.
    So every linear strategy's regions lie in regions of the same rank, and none is shorter.

    Parameters
    ----------
    goals : of rank 0; the goal first.
    directions : radians.
    max_steps : the most layers.
    termination : what conditions know. With state, each new region is aimed at alone besides:
        such a condition depends on where its motion may begin, and is looked for goal by goal.
    """
    aimed = Field(setting, method, directions)
    found = Layers([Known(number, 0, goal) for number, goal in enumerate(goals)], aimed)
    branching: Branching[Known] = Branching(setting, start)
    found.start = branching.further(found.regions)
    if found.start:
        return found
    aims = [Aim(setting.command(direction)) for direction in directions]
    fresh = list(found.regions)
    known = list(fresh)
    nearest = math.inf
    for rank in range(1, max_steps + 1):
        found.stopped = limits.exceeded(len(found.regions))
        if found.stopped:
            return found
        aimed.add(one.region for one in fresh)
        added: list[Known] = []
        for aim in aims:
            found.stopped = limits.exceeded(len(found.regions))
            if found.stopped:
                return found
            made = _made(aimed, aim, tuple(known), rank, found, start)
            if termination is not Termination.INSTANTANEOUS:
                made += _with_state(aimed, aim, fresh, rank, found, made, start, termination)
            found.regions += made
            added += made
            if progress is not None:
                far = (distance_to(start, one.region, setting.space) for one in made)
                nearest = min(nearest, *far, math.inf)
                best = "" if math.isinf(nearest) else f"{nearest:.4g} from the start"
                progress(Progress(len(found.regions), rank, best, limits.seconds))
        if not added:
            return found
        found.start = branching.further(added)
        if found.start:
            found.others = tuple(branching.whole[1:])
            return found
        fresh = sorted(added, key=lambda one: -one.region.area.measure)
        known += fresh
    found.stopped = too_long(max_steps)
    return found


def _made(
    aimed: Field, aim: Aim, goals: tuple[Known, ...], rank: int, found: Layers, start: Start
) -> list[Known]:
    """The new regions of one direction in one layer."""
    setting, tolerance = aimed.setting, aimed.setting.space.tolerance
    before = aim.target
    aim.further(aimed)
    targets = (
        [] if _is_no_more(aim.target.region, before.region, tolerance) else [(aim.target, goals)]
    )
    targets += [(aim.alone(aimed, place), (goals[place],)) for place in aim.lost]
    made: list[Known] = []
    for target, ends in targets:
        regions = tuple(goal.region for goal in ends)
        direction = aim.command.direction
        preimage = reach_any(setting, regions, direction, aimed.method, target)
        found.computed += 1
        if target is aim.target:
            grown = not _is_no_more(preimage.region, aim.reached, tolerance)
            aim.reached = preimage.region
        else:
            grown = True
        probed = _Probed.of(preimage.region)
        # of plans that may end in one goal or another, those that are as short are compared
        apart = len(found.goals) > 1 and covered(start, preimage.region, setting.space)
        if not grown or (
            not apart
            and any(probed.lies_in(one.region, tolerance) for one in (*found.regions, *made))
        ):
            found.pruned += 1
            continue
        number = len(found.regions) + len(made)
        made.append(Known(number, rank, preimage.region, preimage, ends))
    return made


def _with_state(
    aimed: Field,
    aim: Aim,
    goals: Sequence[Known],
    rank: int,
    found: Layers,
    made: Sequence[Known],
    start: Start,
    termination: Termination,
) -> list[Known]:
    """The regions from which one new goal alone is recognised by conditions with state."""
    setting, direction = aimed.setting, aim.command.direction
    more: list[Known] = []
    for goal in goals:
        for begin in (None, start_as_region(start, setting.space)):
            arguments = setting, [goal.region], direction, aimed.method, termination
            preimage = stateful_preimage(*arguments, begin)
            found.computed += 1
            if preimage is None or preimage.region.is_empty:
                continue
            if begin is not None and not covered(start, preimage.region, setting.space):
                continue
            probed = _Probed.of(preimage.region)
            if any(
                probed.lies_in(one.region, setting.space.tolerance)
                for one in (*found.regions, *made, *more)
            ):
                found.pruned += 1
                continue
            number = len(found.regions) + len(made) + len(more)
            more.append(Known(number, rank, preimage.region, preimage, (goal,)))
    return more


def _is_no_more(region: Region, before: Region, tolerance: Tolerance) -> bool:
    """Whether what can only have grown has not."""
    slack = 2.0 * tolerance.length * region.area.perimeter
    return region.area.measure <= before.area.measure + slack and contact_set.is_subset(
        region.contact, before.contact, tolerance.length
    )


@dataclass(slots=True, eq=False)
class _Probed:
    """A region, with some points inside by which most others are told not to hold it."""

    region: Region
    points: Floats

    @classmethod
    def of(cls, region: Region, seed: int = 1) -> _Probed:
        """Points all over the region's area."""
        if region.area.is_empty:
            return cls(region, np.empty((0, 2)))
        xmin, ymin, xmax, ymax = region.area.bounds
        some = np.random.default_rng(seed).uniform((xmin, ymin), (xmax, ymax), (PROBES, 2))
        return cls(region, some[region.area.contains_all(some)])

    def lies_in(self, other: Region, tolerance: Tolerance) -> bool:
        """Whether the region lies in another one."""
        own = self.region
        slack = 2.0 * tolerance.length * own.area.perimeter
        if own.area.measure > other.area.measure + slack:
            return False
        if own.contact.total_length > other.contact.total_length + slack + tolerance.length:
            return False
        if len(self.points) and not np.all(other.area.contains_all(self.points)):
            return False
        return is_subset(own, other, tolerance)
