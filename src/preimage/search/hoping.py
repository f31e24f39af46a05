"""Which of several plans that may know their failure promises most (theory 7)."""

from __future__ import annotations

from dataclasses import replace

from preimage.configuration import region as regions
from preimage.configuration.region import Region
from preimage.configuration.start import Start, StartKind, covered, start_region
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.reachability.weak import weakly_backproject
from preimage.search.failure import MARGIN, certain_starts
from preimage.strategy.strategy import Strategy


def judged(strategy: Strategy) -> Strategy:
    """A plan that may know its failure, with what is certain of it and whether there is hope."""
    return replace(strategy, certain=certain_starts(strategy), hope=may_succeed(strategy))


def promise(strategy: Strategy) -> tuple[float, float, bool]:
    """Sorts judged plans: by the certain part of the start, then by whether there is hope."""
    certain = strategy.certain or Region.empty()
    start = start_region(strategy.task, strategy.space)
    if start.kind is not StartKind.REGION:
        return float(covered(start, certain, strategy.space)), 0.0, strategy.hope
    return certain.area.measure, certain.contact.total_length, strategy.hope


def may_succeed(strategy: Strategy) -> bool:
    """Whether some commands and choices of nature lead through the plan's motions to the goal.

    The sets are too large rather than too small: a plan that has no hope can only fail.
    """
    space, task = strategy.space, strategy.task
    hopeful: dict[int, Region] = {}
    for region in sorted(strategy.regions, key=lambda one: (one.rank, one.id)):
        if region.motion is None:
            hopeful[region.id] = Region.empty() if region.failure else region.region
            continue
        aim = Region.empty()
        for goal in region.motion.goals:
            aim = regions.union(aim, hopeful[goal], space.tolerance)
        hopeful[region.id] = aim
        if not aim.is_empty:
            found = weakly_backproject(
                space, aim, region.motion.direction, task.uncertainty.control, task.friction
            )
            hopeful[region.id] = regions.intersection(region.region, found.region, space.tolerance)
    start = start_region(task, space)
    return any(_may_begin(strategy, start, hopeful[number]) for number in strategy.start)


def _may_begin(strategy: Strategy, start: Start, region: Region) -> bool:
    """Whether some of the start may lie in a region; if in doubt it may."""
    space = strategy.space
    if start.kind is StartKind.REGION:
        return not regions.intersection(start.region, region, space.tolerance).is_empty
    if start.kind is not StartKind.FREE_POINT or start.point is None:
        return not region.is_empty
    (x, y), near = start.point, MARGIN * space.tolerance.length
    around = Area.box(x - near, y - near, x + near, y + near)
    return not areas.intersection(around, region.area).is_empty
