"""Known failure: the places from which the goal can no longer be reached (theory 7)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration import region as regions
from preimage.configuration.components import components
from preimage.configuration.contact import Bools, ContactSpace, Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import StartKind, start_region
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.angles import TAU
from preimage.geometry.area import Area
from preimage.preimages.setting import Setting
from preimage.reachability.weak import weak_closure, weakly_backproject
from preimage.search.limits import Limits
from preimage.strategy.strategy import Strategy, StrategyRegion
from preimage.task.options import Continuous, Directions

MARGIN = 16.0
"""Hopeless places keep so many tolerances away from all others."""

FINE = 1e4
"""With cones of so many tolerances or less, what leads to a point is too thin to be seen."""

THICK = 64.0
"""Points are then taken to be so many tolerances wide."""

MOST_ROUNDS = 200
"""After so many rounds it is given up; each follows all directions once."""


def hopeless(
    setting: Setting, goal: Region, directions: Directions, limits: Limits | None = None
) -> Region:
    """The places from which no commands lead to the goal, however kind nature is (theory 7).

    `H = valid - W`, where `W` is the least set with `W = goal | weak_v(W)` for all directions `v`:
    from `W`, some commands and some of nature's choices lead to the goal, a command being changed
    anywhere. What is left out of `W` keeps a margin from it, so that no motion whatever leads from
    `H` to the goal; motions from `H` stay in `H`, or leave the window.

    With directions all round, nothing in free space is out of reach but the components without the
    goal; then `H` may still hold corners and crevices that hold the robot against all commands.
    With continuous directions those are not looked for. Where a limit comes first, nor is anything
    else: `H` is then the components of free space without the goal.

    Parameters
    ----------
    directions : all that may be commanded, radians.
    limits : asked before every sweep.

    Returns
    -------
    Region, empty if nowhere is surely hopeless.

    From all places something leads to the hole, but not if one may go upwards alone:

    >>> from math import pi
    >>> from preimage.configuration.goals import goal_region
    >>> from preimage.task import named_task
    >>> task = named_task("peg-in-hole")
    >>> setting = Setting.of(task)
    >>> goal = goal_region(task, setting.space)
    >>> hopeless(setting, goal, task.options.directions).is_empty
    True
    >>> hopeless(setting, goal, (0.5 * pi,)).is_empty  # upwards alone
    False
    """
    space, control, friction = setting.space, setting.uncertainty.control, setting.friction
    apart = _without(space, _components_of(space, goal))
    if isinstance(directions, Continuous) or goal.is_empty:
        return apart
    slack = 0.5 * MARGIN * space.tolerance.length
    reach = _thickened(space, goal, goal.contact, control)
    around = _all_round(setting, directions)
    if not around:
        begun = weak_closure(space, reach, directions, control, friction)
        reach = reach if begun is None else regions.union(reach, begun, space.tolerance)
    settled = 0
    for turn in range(MOST_ROUNDS * len(directions)):
        if settled == len(directions):
            return _without(space, reach)
        if limits is not None and limits.exceeded(0) is not None:
            return apart
        direction = directions[turn % len(directions)]
        found = weakly_backproject(space, reach, direction, control, friction).region
        settled += 1
        if not _lies_in(found, reach, slack):
            corners = ContactSet.of([], [], [], found.contact.vertices, space.tolerance.length)
            found = _thickened(space, found, corners, control)
            reach, settled = regions.union(reach, found, space.tolerance), 0
            reach = _filled(space, reach) if around else reach
    return apart


def certain_starts(strategy: Strategy) -> Region:
    """The starts from which a plan surely ends in the goal, and not in known failure (theory 7).

    From the plan's end backwards: `m(H) = H`, `m(goal)` is empty, and of a region `R` with a
    motion along `v` those starts may fail from which some admissible motion meets `m` of a goal of
    the motion, before it meets what of its target is in none of these. The sets `m` are too large
    rather than too small. Targets are believed: that a plan of unknown origin is proven does not
    say that its targets are where its motions end.

    Returns
    -------
    Region : the certain part of the task's start; for a start at a point, of all the regions that
        may be chosen there (see `start.covered`).
    """
    space, task = strategy.space, strategy.task
    may_fail: dict[int, Region] = {}
    for region in sorted(strategy.regions, key=lambda one: (one.rank, one.id)):
        may_fail[region.id] = _may_fail(strategy, region, may_fail)
    start = start_region(task, space)
    chosen = [strategy.region(number).region for number in strategy.start]
    inside = start.region if start.kind is StartKind.REGION else _joined(space, chosen)
    bad = _joined(space, [may_fail[number] for number in strategy.start])
    return regions.intersection(inside, _without(space, bad), space.tolerance)


def _may_fail(strategy: Strategy, region: StrategyRegion, known: dict[int, Region]) -> Region:
    """The part of a region from which known failure is possible."""
    if region.failure:
        return region.region
    motion = region.motion
    if motion is None:
        return Region.empty()
    space, task = strategy.space, strategy.task
    bad = _joined(space, [known[goal] for goal in motion.goals])
    if bad.is_empty:
        return bad
    control = task.uncertainty.control
    good = _beside(space, motion.target, bad)
    bad = _thickened(space, bad, bad.contact, control)
    found = weakly_backproject(space, bad, motion.direction, control, task.friction, stop=good)
    return regions.intersection(region.region, found.region, space.tolerance)


# --- sets -----------------------------------------------------------------------------------


def _joined(space: ConfigurationSpace, parts: Sequence[Region]) -> Region:
    joined = Region.empty()
    for part in parts:
        joined = regions.union(joined, part, space.tolerance)
    return joined


def _without(space: ConfigurationSpace, taken: Region) -> Region:
    """Valid space without a set, and without what is as near to it as the margin."""
    return _beside(space, space.valid, taken)


def _beside(space: ConfigurationSpace, region: Region, taken: Region) -> Region:
    """A region without a set, and without what is as near to it as the margin."""
    margin = MARGIN * space.tolerance.length
    area = region.area
    if not area.is_empty and not taken.area.is_empty:
        area = areas.difference(area, areas.shrunk(taken.area, -margin))
        area = areas.regularised(area, margin)
    around = _grown(space.contact, taken.contact, margin)
    return Region(area, contact_set.difference(region.contact, around, space.tolerance.length))


def _grown(contact: ContactSpace, part: ContactSet, margin: float) -> ContactSet:
    """A part of contact space with what of edges is as near to it as the margin."""
    corner = part.vertices
    before = contact.previous[corner]
    length = contact.length
    return ContactSet.of(
        np.concatenate((part.edge, corner, before)),
        np.concatenate(
            (
                np.maximum(part.low - margin, 0.0),
                np.zeros(len(corner)),
                np.maximum(length[before] - margin, 0.0),
            )
        ),
        np.concatenate(
            (
                np.minimum(part.high + margin, length[part.edge]),
                np.minimum(margin, length[corner]),
                length[before],
            )
        ),
        corner,
        0.0,
    )


def _lies_in(a: Region, b: Region, slack: float) -> bool:
    return contact_set.is_subset(a.contact, b.contact, slack) and areas.is_subset(
        a.area, b.area, slack
    )


def _thickened(
    space: ConfigurationSpace, region: Region, thin: ContactSet, control: float
) -> Region:
    """A set, with the free space around a part of it, if control is so good that one may miss it.

    What leads to a point is then a line, which no area shows.
    """
    if control > FINE * space.tolerance.angle or thin.is_empty:
        return region
    contact, radius = space.contact, THICK * space.tolerance.length
    corners = contact.points[thin.vertices]
    low = np.concatenate((contact.at(thin.edge, thin.low), corners))
    high = np.concatenate((contact.at(thin.edge, thin.high), corners))
    around = areas.intersection(inflate.outer_stadiums(low, high, radius), space.free)
    area = around if region.area.is_empty else areas.union(region.area, around)
    return Region(area, region.contact)


# --- all round ------------------------------------------------------------------------------


def _all_round(setting: Setting, directions: Sequence[float]) -> bool:
    """Whether nature and commands together can push towards every side of every line."""
    turns = np.sort(np.asarray(directions, dtype=np.float64))
    gaps = np.diff(np.concatenate((turns, turns[:1] + TAU)))
    widest = float(gaps.max()) - 2.0 * setting.uncertainty.control
    return widest < np.pi - setting.space.tolerance.angle


def _filled(space: ConfigurationSpace, reach: Region) -> Region:
    """A set, and all the free space that is connected with free space in it.

    With directions all round one may follow any way through free space, as near as one likes.
    """
    least = space.tolerance.length
    parts = [
        part
        for part in components(space)
        if not areas.regularised(areas.intersection(part, reach.area), least).is_empty
    ]
    return Region(areas.union(reach.area, *parts) if parts else reach.area, reach.contact)


def _components_of(space: ConfigurationSpace, goal: Region) -> Region:
    """The components of valid space that hold something of a set, whole."""
    contact = space.contact
    parts, own = _owners(space)
    held = np.zeros(len(parts), dtype=np.bool_)
    held[own[goal.contact.edge]] = True
    held[own[goal.contact.vertices]] = True
    for place, part in enumerate(parts):
        if not goal.area.is_empty and not areas.intersection(part, goal.area).is_empty:
            held[place] = True
    kept = [part for part, keep in zip(parts, held.tolist(), strict=True) if keep]
    mine: Bools = held[own]
    whole = ContactSet.whole(contact)
    on = mine[whole.edge]
    inside = ContactSet(
        whole.edge[on], whole.low[on], whole.high[on], whole.vertices[mine[whole.vertices]]
    )
    return Region(areas.union(*kept) if kept else Area.empty(), inside)


def _owners(space: ConfigurationSpace) -> tuple[tuple[Area, ...], Ints]:
    """The components of free space, and (n,) the one that each edge and vertex borders."""
    contact, parts = space.contact, components(space)
    own = np.full(len(contact), -1, dtype=np.int32)
    for first in range(len(contact)):
        if own[first] >= 0:
            continue
        loop = [first]
        while (following := int(contact.next[loop[-1]])) != first:
            loop.append(following)
        # a loop borders one component; the middle of its longest edge is far from pinches
        longest = max(loop, key=lambda edge: float(contact.length[edge]))
        x, y = 0.5 * (contact.points[longest] + contact.ends[longest])
        gaps = [_gap(part, float(x), float(y)) for part in parts]
        own[loop] = int(np.argmin(gaps))
    return parts, own


def _gap(part: Area, x: float, y: float) -> float:
    """How far a point is from the nearest of a component's border."""
    starts, ends = part.segments
    along = ends - starts
    share = np.sum((np.array((x, y)) - starts) * along, axis=1) / np.sum(along**2, axis=1)
    near = starts + np.clip(share, 0.0, 1.0)[:, None] * along
    return float(np.hypot(x - near[:, 0], y - near[:, 1]).min())
