"""Conditional strategies: layers of preimages that aim at all regions known (theory 7, paper 8)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, is_subset
from preimage.configuration.start import Start, distance_to
from preimage.preimages.methods import reach_any
from preimage.preimages.preimage import Preimage, Target
from preimage.preimages.setting import Command, Setting
from preimage.preimages.shared import Shares, share_out, told_part
from preimage.search.branching import choices
from preimage.search.limits import Limits, Progress
from preimage.task.options import Method


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """A region of the policy: a goal, or where one knows what to command.

    Parameters
    ----------
    rank : the layer that it was made in: so many motions may remain.
    preimage : None for a goal.
    goals : what its motion aims at: regions of lower rank.
    shares : what of them its motion is known to attain; None for a goal.
    """

    id: int
    rank: int
    region: Region
    preimage: Preimage | None = None
    goals: tuple[Known, ...] = ()
    shares: Shares | None = None


@dataclass(slots=True, eq=False)
class Layers:
    """What a search found.

    Parameters
    ----------
    regions : all regions known, by id; ids grow with the rank.
    start : the regions that may be chosen at the start; empty if it is not covered.
    stopped : which limit came first; None if the start was covered or a layer added nothing.
    computed, pruned : how many preimages were computed, and how many of them said nothing new.
    """

    regions: list[Known]
    start: tuple[Known, ...] = ()
    stopped: str | None = None
    computed: int = 0
    pruned: int = 0


@dataclass(slots=True, eq=False)
class _Aim:
    """What one command is known to attain so far.

    Parameters
    ----------
    goals, told : all regions that it may end in, and their kernels.
    kept : what sticks for sure and has been allotted to them.
    region : of the last preimage.
    """

    command: Command
    goals: list[Known] = field(default_factory=list)
    told: list[Region] = field(default_factory=list)
    kept: tuple[ContactSet, ...] = ()
    target: Target | None = None


def layers(
    setting: Setting,
    goals: Sequence[Region],
    start: Start,
    directions: tuple[float, ...],
    method: Method,
    max_steps: int,
    limits: Limits,
    progress: Callable[[Progress], None] | None = None,
) -> Layers:
    """Add layer to layer until the start is covered, or a layer adds nothing (theory 7).

    In each layer every direction gets the preimage of all regions that are known by then: the
    preimage of a set of goals grows with the set. Knowing to be in it is all that is needed to
    command its direction, so one region a direction and layer suffices; but where parts that stick
    for sure had to go, since they would be confused, each goal that lost one is also served first,
    in a region of its own. So every linear strategy's regions lie in regions of the same rank, and
    none is shorter.

    Parameters
    ----------
    goals : of rank 0; the goal first.
    directions : radians.
    max_steps : the most layers.
    """
    found = Layers([Known(number, 0, goal) for number, goal in enumerate(goals)])
    found.start = choices(setting, start, found.regions)
    if found.start:
        return found
    aims = [_Aim(setting.command(direction)) for direction in directions]
    fresh = list(found.regions)
    nearest = min(distance_to(start, goal, setting.space) for goal in goals)
    for rank in range(1, max_steps + 1):
        cores = _cores(setting, aims, fresh, method)
        added: list[Known] = []
        for aim, told in zip(aims, cores, strict=True):
            found.stopped = limits.exceeded(len(found.regions))
            if found.stopped:
                return found
            aim.goals += fresh
            aim.told += told
            for known in _made(setting, aim, method, rank, found):
                found.regions.append(known)
                added.append(known)
                nearest = min(nearest, distance_to(start, known.region, setting.space))
            if progress is not None:
                best = "" if math.isinf(nearest) else f"{nearest:.4g} from the start"
                progress(Progress(len(found.regions), rank, best, limits.seconds))
        if not added:
            return found
        found.start = choices(setting, start, found.regions)
        if found.start:
            return found
        fresh = sorted(added, key=lambda known: -known.region.area.measure)
    found.stopped = f"the limit of {max_steps} motions came first"
    return found


def _cores(
    setting: Setting, aims: list[_Aim], fresh: list[Known], method: Method
) -> list[list[Region]]:
    """For each direction the kernels of new regions; what is around a region is looked at once."""
    cores: list[list[Region]] = [[] for _ in aims]
    for known in fresh:
        for place, aim in enumerate(aims):
            cores[place].append(told_part(setting, known.region, aim.command, method))
    return cores


def _made(setting: Setting, aim: _Aim, method: Method, rank: int, found: Layers) -> list[Known]:
    """The new regions of one direction in one layer."""
    regions = [known.region for known in aim.goals]
    shares = share_out(setting, regions, aim.told, aim.command, method, aim.kept)
    aim.kept = shares.held
    made: list[Known] = []
    every = [shares]
    every += [
        share_out(setting, regions, aim.told, aim.command, method, first=place)
        for place in shares.dropped
    ]
    for one in every:
        target, tolerance = one.target, setting.space.tolerance
        if target.region.is_empty:
            continue
        if one is shares:
            if aim.target is not None and is_subset(target.region, aim.target.region, tolerance):
                found.pruned += 1
                continue
            aim.target = target
        preimage = reach_any(setting, tuple(regions), aim.command.direction, method, target)
        found.computed += 1
        if preimage.region.is_empty or any(
            is_subset(preimage.region, known.region, tolerance) for known in (*found.regions, *made)
        ):
            found.pruned += 1
            continue
        number = len(found.regions) + len(made)
        made.append(Known(number, rank, preimage.region, preimage, tuple(aim.goals), one))
    return made
