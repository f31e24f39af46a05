"""A place of the start that misses all that directions of an interval can be known to reach.

Where an interval is wider than the control cone, no narrower cone is left to prove it useless with
(theory 7): at theta = 0 that is every interval. But a motion solves only if every place of the
start leads to what is recognised as the goal. So it is enough that one place cannot get there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, union
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind
from preimage.geometry import area as areas
from preimage.geometry.angles import wrap
from preimage.geometry.area import Area
from preimage.mechanics.behaviour import Behaviour
from preimage.mechanics.reaction import edge_reactions
from preimage.preimages.setting import Setting
from preimage.reachability.forward_projection import forward_project
from preimage.reachability.sources import sources
from preimage.recognition.kernel import kernel
from preimage.recognition.readings import Readings
from preimage.search.cones import SLACK, narrowed_position, widened
from preimage.task.options import Method

PLACE = 32.0
"""A place is so many tolerances wide to either side: wide enough for a sweep to begin on it."""


def misses(
    setting: Setting,
    goal: Region,
    start: Start,
    method: Method,
    middle: float,
    half: float,
    preimage: Region,
) -> bool:
    """Whether some place of the start surely misses the goal in every direction of an interval.

    Errs on one side: True is a proof that none of the directions solves.

    Parameters
    ----------
    middle, half : the interval, radians.
    preimage : of the goal for `middle`; a place is looked for outside it.
    """
    wide = widened(setting, half, ())
    if wide is None:
        return False
    target = possible_target(setting, goal, method, middle, half)
    if target.is_empty:
        return True
    space, control = wide.space, wide.uncertainty.control
    near = space.tolerance.length
    for place in _places(start, preimage, space):
        visited = forward_project(space, place, middle, control, wide.friction).region
        if (
            contact_set.intersection(visited.contact, target.contact, near).is_empty
            and areas.intersection(visited.area, target.area).is_empty
        ):
            return True
    return False


def possible_target(
    setting: Setting, goal: Region, method: Method, middle: float, half: float
) -> Region:
    """A region that contains what motions in any direction of an interval can aim at in a goal.

    What sticks for sure in some direction of it, and what no reading confuses that is possible in
    all of them: both follow from a control of `theta - half`, which may be negative.
    """
    space = setting.space
    control = setting.uncertainty.control - half - SLACK * space.tolerance.angle
    found = Region.empty()
    if method is not Method.KERNEL:
        commanded = sources(space.contact, middle, control, setting.friction, space.tolerance)
        edges, vertices = commanded.where(Behaviour.STICKS_SURELY)
        contact = goal.contact
        on = edges[contact.edge]
        held = contact.vertices[vertices[contact.vertices]]
        sticking = ContactSet(contact.edge[on], contact.low[on], contact.high[on], held)
        found = Region(Area.empty(), sticking)
    if method is not Method.STICKING:
        senses = replace(setting.uncertainty, position=narrowed_position(setting, (goal,)))
        core = kernel(
            space, _sure_readings(setting, middle, control), goal, senses,
            arc_tolerance=setting.arc_tolerance,
        )  # fmt: skip
        found = union(found, core, space.tolerance)
    return found


def _sure_readings(setting: Setting, middle: float, control: float) -> Readings:
    """Of each feature's reading set what is in it for every direction of an interval, or less.

    Parameters
    ----------
    control : `theta - half`, negative.
    """
    space, senses = setting.space.contact, setting.uncertainty
    slack = setting.space.tolerance.angle
    before = space.previous
    edges = edge_reactions(
        space.normal, middle, control, setting.friction, senses.force_thresholds, slack
    )
    zero = edges.weak & ~space.open
    low, high = edges.low - senses.force_angle, edges.high + senses.force_angle
    felt = (low <= high) & ~space.open
    low, high = np.where(felt, low, np.inf), np.where(felt, high, -np.inf)
    zero = np.concatenate((zero, zero | zero[before], (True,)))
    low = np.concatenate((low, np.minimum(low, low[before]), (np.inf,)))
    high = np.concatenate((high, np.maximum(high, high[before]), (-np.inf,)))
    felt = low <= high
    low, high = np.where(felt, low, 0.0), np.where(felt, high, 0.0)
    half = np.where(felt, np.minimum(0.5 * (high - low), np.pi), -np.inf)
    center = wrap(0.5 * (high + low) + middle + np.pi)
    return Readings(middle, zero, center, half, slack)


def _places(start: Start, preimage: Region, space: ConfigurationSpace) -> Iterator[Region]:
    """Small parts of a start, of a start that is a region outside a preimage."""
    near = PLACE * space.tolerance.length
    match start.kind:
        case StartKind.FREE_POINT:
            assert start.point is not None
            yield _box(*start.point, near, space)
        case StartKind.EDGE_POINT:
            yield _interval(start.edge, start.distance, near, space)
        case StartKind.VERTEX:
            for vertex in start.vertices:
                yield Region(Area.empty(), ContactSet.of([], [], [], [vertex], 0.0))
        case StartKind.REGION:
            yield from _left_out(start.region, preimage, near, space)


def _left_out(
    region: Region, preimage: Region, near: float, space: ConfigurationSpace
) -> Iterator[Region]:
    contact = contact_set.difference(region.contact, preimage.contact, space.tolerance.length)
    if len(contact.edge):
        longest = int(np.argmax(contact.high - contact.low))
        middle = 0.5 * (contact.low[longest] + contact.high[longest])
        yield _interval(int(contact.edge[longest]), float(middle), near, space)
    if len(contact.vertices):
        first = contact.vertices[:1].tolist()
        yield Region(Area.empty(), ContactSet.of([], [], [], first, 0.0))
    if not region.area.is_empty:
        rest = areas.difference(region.area, preimage.area)
        if not rest.is_empty:
            x, y = rest.inner_point
            yield _box(x, y, near, space)


def _box(x: float, y: float, near: float, space: ConfigurationSpace) -> Region:
    box = Area.box(x - near, y - near, x + near, y + near)
    return Region(areas.intersection(box, space.free), ContactSet.empty())


def _interval(edge: int, distance: float, near: float, space: ConfigurationSpace) -> Region:
    low = max(distance - near, 0.0)
    high = min(distance + near, float(space.contact.length[edge]))
    return Region(Area.empty(), ContactSet.of([edge], [low], [high], [], 0.0))
