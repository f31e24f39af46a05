"""Why there is no strategy: which feature traps, which two are confused, which side escapes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Ints
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, is_subset
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind, covered, distance_to
from preimage.geometry.area import Area
from preimage.geometry.overlay import united
from preimage.mechanics.behaviour import Behaviour
from preimage.preimages.methods import aim
from preimage.preimages.setting import Setting
from preimage.preimages.shared import share_out, told_part
from preimage.preimages.starts import start_as_region
from preimage.reachability.backprojection import backproject
from preimage.reachability.forward_projection import ForwardProjection, forward_project
from preimage.search.lost import (
    Stop,
    all_contact,
    confused_with,
    ends_at,
    largest_part,
    lost_start,
    on_features,
    side_of,
    stops_on,
    where_met,
)
from preimage.strategy import reason as say
from preimage.strategy.reason import Reason, ReasonKind
from preimage.strategy.strategy import StrategyRegion
from preimage.task.options import Method, StrategyKind

MOST_DIRECTIONS = 16
"""Of more directions so many are looked at, evenly chosen."""

MOST_AIMS = 240
"""Of more regions, each in no other one, the goal and the largest are aimed at: so often in all."""

MOST_CAUSES = 2
"""So much is said of one direction at most."""

TIED = 4.0
"""Slopes that are no steeper than the friction by so many tolerances more are slid on by a tie."""

THICK = 1024.0
"""Stretches of contact no longer than so many tolerances may be what rounding adds."""


@dataclass(frozen=True, slots=True, eq=False)
class _Case:
    """What is the same for all directions.

    Parameters
    ----------
    aimed, ids : the regions that motions are aimed at, the goal first, and their numbers.
    known : contact of all regions.
    whole, start, spot : all of the start, a place of it in no region, and the place's surroundings.
    """

    setting: Setting
    method: Method
    kind: StrategyKind
    aimed: tuple[Region, ...]
    ids: tuple[int, ...]
    known: ContactSet
    whole: Start
    start: Start
    spot: Region
    several: bool

    @property
    def origin(self) -> tuple[float, float]:
        """The place of the start."""
        assert self.start.point is not None
        return self.start.point


def reasons(
    setting: Setting,
    start: Start,
    regions: Sequence[StrategyRegion],
    directions: Sequence[float],
    method: Method,
    kind: StrategyKind = StrategyKind.LINEAR,
) -> tuple[Reason, ...]:
    """What stands in the way of every motion from a place of the start that no region holds.

    For each direction the motion is followed from there until it meets what of the regions it can
    be known to have attained. By theory 4 it then may stop outside that, or leave the window, or
    one more motion would do: each of these is a reason, with the feature and a place. Where it may
    stop in a region and not know it, the nearest feature outside the region with a reading in
    common is named (theory 5).

    Parameters
    ----------
    start : all that the plan may count on; no region of a linear strategy holds it.
    regions : all that were found, the goal first.
    directions : radians; of very many some are looked at.

    Returns
    -------
    At least one reason for each direction that was looked at; the direction whose backprojection
    is nearest to the start comes first, those that can aim at nothing last. One reason alone if
    each place of the start is in some region. Along a direction that serves the place, they are
    of another place of the start that it does not serve.

    It takes a forward projection and a backprojection for each direction, and no more than
    `MOST_AIMS` aims. Where the regions are too many for that, a motion is followed past what only
    the smaller ones would tell.
    """
    space = setting.space
    every = [region.region for region in regions]
    place = lost_start(start, every, space)
    if place is None:
        return (_split(setting, start, regions),)
    chosen = _chosen(directions)
    aimed = _aimed(regions, space, MOST_AIMS // max(1, len(chosen)))
    case = _Case(
        setting=setting,
        method=method,
        kind=kind,
        aimed=tuple(region.region for region in aimed),
        ids=tuple(region.id for region in aimed),
        known=all_contact(every, space),
        whole=start,
        start=place,
        spot=start_as_region(place, space),
        several=len(regions) > 1,
    )
    aims = _aims(case, chosen)
    found = [_along(case, direction, parts) for direction, parts in aims.items()]
    found.sort(key=lambda one: one[0])
    return tuple(reason for _, causes in found for reason in causes)


def _chosen(directions: Sequence[float]) -> list[float]:
    count = len(directions)
    if count <= MOST_DIRECTIONS:
        return list(directions)
    return [directions[place * count // MOST_DIRECTIONS] for place in range(MOST_DIRECTIONS)]


def _aimed(
    regions: Sequence[StrategyRegion], space: ConfigurationSpace, most: int
) -> list[StrategyRegion]:
    """The goal, and the largest of the other regions: what of one in another is told there too."""

    def size(one: StrategyRegion) -> tuple[float, float, int]:
        return -one.region.area.measure, -one.region.contact.total_length, one.id

    kept = [regions[0]]
    for one in sorted(regions[1:], key=size):
        if len(kept) == most:
            break
        if not any(is_subset(one.region, known.region, space.tolerance) for known in kept):
            kept.append(one)
    return sorted(kept, key=lambda one: (one.rank, one.id))


def _split(setting: Setting, start: Start, regions: Sequence[StrategyRegion]) -> Reason:
    """Each place of the start is in some region: no one of them holds all of it."""
    nearest = min(
        regions[1:] or regions,
        key=lambda one: (distance_to(start, one.region, setting.space), one.id),
    )
    direction = None if nearest.motion is None else nearest.motion.direction
    rest = lost_start(start, [nearest.region], setting.space)
    if rest is None or rest.point is None:
        words = say.at_the_border(nearest.id, direction)
        return Reason(ReasonKind.SPLIT, direction, None, words)
    holders = (one for one in regions if covered(rest, one.region, setting.space))
    other = next(holders, None)
    turn = None if other is None or other.motion is None else other.motion.direction
    words = say.split(rest.point, nearest.id, direction, None if other is None else other.id, turn)
    return Reason(ReasonKind.SPLIT, direction, rest.point, words)


# --- one direction --------------------------------------------------------------------------

_Rank = tuple[int, float, int]


def _along(case: _Case, direction: float, parts: list[Region]) -> tuple[_Rank, list[Reason]]:
    """What stands in the way along one direction, and how far from a solution it is."""
    setting, space = case.setting, case.setting.space
    command = setting.command(direction)
    target = _target(case, direction, parts)
    if target.is_empty:
        return (1, math.inf, 0), [_nothing(case, direction)]
    reached = backproject(space, target, command.sources).region
    apart = distance_to(case.whole, reached, space)
    causes = _causes_from(case, direction, target)
    if not causes and case.whole.kind is StartKind.REGION:
        other = lost_start(case.whole, [reached], space)
        if other is not None:  # then not all of the start
            spot = start_as_region(other, space)
            causes = _causes_from(replace(case, start=other, spot=spot), direction, target)
    if not causes:
        causes = [_no_cause(case, direction, reached, parts)]
    return (0, apart, len(causes)), causes[:MOST_CAUSES]


def _causes_from(case: _Case, direction: float, target: Region) -> list[Reason]:
    """What a motion from the place may do but meet its target.

    What only a tie lets slide is told where there is nothing else.
    """
    setting, space = case.setting, case.setting.space
    for friction in (setting.friction + TIED * space.tolerance.angle, setting.friction):
        projection = forward_project(
            space, case.spot, direction, setting.uncertainty.control, friction, target
        )
        causes = list(_causes(case, projection, target)) if projection.sweeps else []
        if causes:
            return causes
    return []


def _aims(case: _Case, directions: Sequence[float]) -> dict[float, list[Region]]:
    """What of each region is recognised when it alone is aimed at, for each direction."""
    aims: dict[float, list[Region]] = {direction: [] for direction in directions}
    for region in case.aimed:  # for all directions at once, as what lies around it is kept
        for direction, parts in aims.items():
            parts.append(aim(case.setting, region, direction, case.method).region)
    return aims


def _target(case: _Case, direction: float, parts: list[Region]) -> Region:
    """What of all regions a strategy of this kind may count on, at the very most."""
    if case.kind is StrategyKind.CONDITIONAL:
        command = case.setting.command(direction)
        told = [told_part(case.setting, one, command, case.method) for one in case.aimed]
        return share_out(case.setting, case.aimed, told, command, case.method).target.region
    tolerance = case.setting.space.tolerance
    areas = [part.area for part in parts if not part.area.is_empty]
    area = united(areas, tolerance.grid) if areas else Area.empty()
    contact = reduce(
        lambda one, other: contact_set.union(one, other, tolerance.length),
        (part.contact for part in parts),
    )
    return Region(area, contact)


def _no_cause(case: _Case, direction: float, reached: Region, parts: list[Region]) -> Reason:
    """The motion surely ends in what is aimed at; at least nothing else was seen."""
    setting, space = case.setting, case.setting.space
    kind, words = ReasonKind.UNKNOWN, say.unknown(direction)
    if covered(case.start, reached, space):
        sources = setting.command(direction).sources
        alone = case.kind is StrategyKind.LINEAR and not any(
            covered(case.start, backproject(space, part, sources).region, space)
            for part in parts
            if not part.is_empty
        )
        if alone:
            kind, words = ReasonKind.SEVERAL, say.several(direction)
        else:
            kind, words = ReasonKind.UNEXPLORED, say.unexplored(direction)
    return Reason(kind, direction, case.origin, words)


def _nothing(case: _Case, direction: float) -> Reason:
    """There is nothing to aim at: why, for the largest part of the goal."""
    goal, contact = case.aimed[0], case.setting.space.contact
    stop = largest_part(goal, case.setting.space)
    found = None
    if case.method is not Method.STICKING and stop is not None:
        free = 2 * len(contact)
        every = np.ones(free + 1, dtype=np.bool_)
        readings = case.setting.command(direction).readings
        found = confused_with(case.setting, readings, stop.feature, stop.place, goal, every)
    other, reading, both_zero = found if found else (None, None, False)
    words = say.nothing(
        case.setting.space, direction, case.method is Method.STICKING, case.several,
        2 * len(case.setting.space.contact) if stop is None else stop.feature,
        other, reading, both_zero,
    )  # fmt: skip
    return Reason(
        ReasonKind.NOTHING_RECOGNISED,
        direction,
        case.origin,
        words,
        feature=None if stop is None or found is None else stop.feature,
        place=None if stop is None or found is None else stop.place,
        other=other,
        reading=reading,
    )


# --- causes ---------------------------------------------------------------------------------


def _causes(case: _Case, projection: ForwardProjection, target: Region) -> Iterator[Reason]:
    """What a motion may do but meet its target, the plainest first."""
    setting, space = case.setting, case.setting.space
    contact, near = space.contact, space.tolerance.length
    sources = setting.command(projection.direction).sources
    visited = projection.region.contact
    edges, vertices = sources.where(Behaviour.MAY_STICK)
    met = contact_set.difference(visited, target.contact, near)
    left = contact_set.without_outermost(met, contact)
    may_stop = on_features(left, edges, vertices)
    trapped = stops_on(contact_set.difference(may_stop, case.known, near), space)
    mine = all_contact(case.aimed, space)
    unknown = stops_on(contact_set.intersection(may_stop, mine, near), space)
    lost = np.setdiff1d(met.vertices, left.vertices)
    long = THICK * near
    for stop in trapped:
        if stop.high - stop.low > long:
            yield _trap(case, projection.direction, stop)
            break
    for stop in unknown:
        reason = _unaware(case, projection.direction, stop)
        if reason is not None:
            yield reason
            break
    yield from _escapes(case, projection, lost)
    for stop in trapped:  # corners, and what is as short as rounding
        if stop.high - stop.low <= long and not ends_at(stop, trapped, space, long):
            yield _trap(case, projection.direction, stop)


def _trap(case: _Case, direction: float, stop: Stop) -> Reason:
    words = say.trap(case.setting.space, direction, stop.feature, stop.low, stop.high, case.several)
    return Reason(
        ReasonKind.TRAP, direction, case.origin, words, feature=stop.feature, place=stop.place
    )


def _unaware(case: _Case, direction: float, stop: Stop) -> Reason | None:
    """It may stop in a region and not know it: what reads alike, or that it need not stop."""
    setting, space = case.setting, case.setting.space
    count, near = len(space.contact), space.tolerance.length
    command = setting.command(direction)
    edges, vertices = command.sources.where(Behaviour.STICKS_SURELY)
    surely = np.concatenate((edges, vertices, (False,)))
    held = bool(surely[stop.feature]) and case.method is not Method.KERNEL
    among = surely if held else np.ones(2 * count + 1, dtype=np.bool_)
    for number, region in zip(case.ids, case.aimed, strict=True):
        if stop.feature < count:
            middle = 0.5 * (stop.low + stop.high)
            inside = region.contact.contains(stop.feature, middle, near)
        else:
            inside = region.contact.has_vertex(stop.feature - count)
        if not inside:
            continue
        where = (space, direction, stop.feature, stop.low, stop.high, number)
        if case.method is Method.STICKING and not held:
            words = say.unsure(*where)
            return Reason(
                ReasonKind.UNSURE, direction, case.origin, words,
                feature=stop.feature, place=stop.place,
            )  # fmt: skip
        found = confused_with(setting, command.readings, stop.feature, stop.place, region, among)
        if found is None:
            continue
        other, reading, both_zero = found
        words = say.confused(*where, other, reading, both_zero)
        return Reason(
            ReasonKind.CONFUSED, direction, case.origin, words,
            feature=stop.feature, place=stop.place, other=other, reading=reading,
        )  # fmt: skip
    return None


def _escapes(case: _Case, projection: ForwardProjection, corners: Ints) -> Iterator[Reason]:
    """The open sides of the window that the motion may reach."""
    space, direction = case.setting.space, projection.direction
    contact = space.contact
    open_edges = projection.open_sides.tolist()
    beside = [
        vertex if contact.open[vertex] else int(contact.previous[vertex])
        for vertex in corners.tolist()
    ]
    edges = list(dict.fromkeys([*open_edges, *beside]))
    if not edges:
        return
    sides = list(dict.fromkeys(side_of(space, edge) for edge in edges))
    words = say.escape(direction, sides)
    place = where_met(space, projection.region, edges[0], corners)
    yield Reason(ReasonKind.ESCAPE, direction, case.origin, words, feature=edges[0], place=place)
