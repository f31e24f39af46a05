"""Linear strategies with any direction: a search from coarse directions to finer ones."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from preimage.configuration.contact import Floats
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, covered, distance_to
from preimage.geometry.angles import TAU, wrap
from preimage.geometry.border import border
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.search.directions import Verdict, solving_directions
from preimage.search.limits import Limits, Progress
from preimage.search.linear import ORDERS, Node, Outcome, search
from preimage.search.tolerance import tolerant
from preimage.task.degrees import to_degrees
from preimage.task.options import PlannerOptions, SearchOrder, uniform_directions

UNIFORM = 16
"""Directions evenly spread that a search begins with."""

ACROSS = 24
"""Besides those, the directions straight onto so many edges at most, the longest ones."""

FIRST_BUDGET = 200
"""Regions that the first round may make; each later round has `GROWTH` times as many."""

GROWTH = 4

NEAREST = 8
"""After each round, all directions are looked at from so many of the regions near the start."""

COARSE = 10.0
"""Directions are told apart to so many resolutions: a plan that is found is widened later."""


def search_continuous(
    setting: Setting,
    goal: Region,
    start: Start,
    options: PlannerOptions,
    limits: Limits,
    progress: Callable[[Progress], None] | None = None,
) -> Outcome:
    """Backchain from the goal, with whatever directions it takes, until a preimage holds the start.

    First all directions of a single motion are looked at (theory 7). Then the graph of regions is
    searched with directions of which each round has more, between those that lead to different
    regions first; after each round, all directions of the first motion are looked at from the
    regions nearest to the start. The plan that is found gets its most tolerant directions.

    Parameters
    ----------
    options : its method, its search order, `max_steps`, and the `resolution` to which directions
        are told apart; its directions are not looked at.

    Returns
    -------
    What the last round found. Without a solution `stopped` always says why: of a region no
    direction in between is ever proved useless.
    """
    root = Node(0, 0, goal, None, None)
    outcome = Outcome([root])
    if covered(start, goal, setting.space):
        outcome.solution = root
        return outcome
    if options.max_steps > 0 and _first_motion(setting, [root], outcome, start, options, limits):
        return _widened(setting, outcome, start, options, limits)
    order = options.search if options.search in ORDERS else SearchOrder.BREADTH_FIRST
    directions = first_directions(setting.space, goal, start)
    budget = FIRST_BUDGET
    while not limits.exceeded(0):
        allowed = replace(limits, max_regions=min(budget, limits.max_regions))
        outcome = search(
            setting,
            goal,
            start,
            directions,
            options.method,
            order,
            options.max_steps,
            allowed,
            progress,
        )
        nodes = _nearest(outcome, start, setting.space, options.max_steps)
        if outcome.solution or _first_motion(setting, nodes, outcome, start, options, limits):
            return _widened(setting, outcome, start, options, limits)
        if limits.exceeded(len(outcome.nodes)):
            break
        finer = refined(directions, outcome, COARSE * options.resolution)
        if len(finer) == len(directions) and len(outcome.nodes) < budget:
            break  # more of the same would find the same
        directions, budget = finer, GROWTH * budget
    finest = to_degrees(COARSE * options.resolution)
    reason = limits.exceeded(len(outcome.nodes)) or outcome.stopped
    outcome.stopped = reason or f"directions were told apart to {finest:.3g} degrees only"
    return outcome


def first_directions(space: ConfigurationSpace, goal: Region, start: Start) -> tuple[float, ...]:
    """Directions to begin with: evenly spread, straight onto edges, and towards the goal; radians.

    >>> from preimage.configuration.goals import goal_region
    >>> from preimage.configuration.start import start_region
    >>> from preimage.task.examples import named_task
    >>> task = named_task("flat-floor")
    >>> space = Setting.of(task).space
    >>> len(first_directions(space, goal_region(task, space), start_region(task, space)))
    16
    """
    contact = space.contact
    edges = contact.edges
    longest = edges[np.argsort(-contact.length[edges], kind="stable")][:ACROSS]
    onto = (contact.normal[longest] + math.pi).tolist()
    begin = _middle(start.region, space) if start.point is None else np.array(start.point)
    x, y = (_middle(goal, space) - begin).tolist()
    towards = [math.atan2(y, x)] if math.hypot(x, y) > space.tolerance.length else []
    return _apart((*uniform_directions(UNIFORM), *onto, *towards), space.tolerance.angle)


def refined(
    directions: tuple[float, ...], outcome: Outcome, resolution: float
) -> tuple[float, ...]:
    """More directions: halfway between neighbours that led to different regions.

    Where all neighbours led to the same, halfway between all. Neighbours nearer to each other than
    the resolution are left alone.

    Parameters
    ----------
    directions : radians, at least two.
    outcome : of a search with them.
    """
    ordered = sorted(directions)
    gaps = [
        (one, other)
        for one, other in zip(ordered, [*ordered[1:], ordered[0] + TAU], strict=True)
        if other - one > resolution
    ]
    led = _led_to(outcome)
    none: frozenset[int] = frozenset()
    differ = [
        (one, other)
        for one, other in gaps
        if led.get(one, none) != led.get(math.fmod(other, TAU) if other >= TAU else other, none)
    ]
    between = (math.fmod(0.5 * (one + other), TAU) for one, other in differ or gaps)
    return tuple(sorted({*directions, *between}))


def _led_to(outcome: Outcome) -> dict[float, frozenset[int]]:
    """From which regions a new one was made, by direction."""
    led: dict[float, set[int]] = {}
    for node in outcome.nodes:
        if node.preimage is not None and node.parent is not None:
            led.setdefault(node.preimage.direction, set()).add(node.parent.id)
    return {direction: frozenset(parents) for direction, parents in led.items()}


def _nearest(
    outcome: Outcome, start: Start, space: ConfigurationSpace, max_steps: int
) -> list[Node]:
    """The regions nearest to the start that may have a motion before them; the goal was first."""
    able = [node for node in outcome.nodes if 0 < node.rank < max_steps]
    return sorted(
        able, key=lambda node: (distance_to(start, node.region, space), node.rank, node.id)
    )[:NEAREST]


def _first_motion(
    setting: Setting,
    nodes: Iterable[Node],
    outcome: Outcome,
    start: Start,
    options: PlannerOptions,
    limits: Limits,
) -> bool:
    """Whether some direction leads from the start to one of these regions; the widest is taken."""
    coarse = COARSE * options.resolution
    for node in nodes:
        arcs = solving_directions(setting, [node.region], start, options.method, coarse, limits)
        solving = [arc for arc in arcs if arc.verdict is Verdict.SOLVES]
        if not solving:
            continue
        best = max(solving, key=lambda arc: arc.margin)
        made = preimage(setting, node.region, best.widest, options.method)
        outcome.computed += 1
        if not covered(start, made.region, setting.space):
            continue
        child = Node(len(outcome.nodes), node.rank + 1, made.region, node, made)
        outcome.nodes.append(child)
        outcome.solution, outcome.stopped = child, None
        return True
    return False


def _widened(
    setting: Setting, outcome: Outcome, start: Start, options: PlannerOptions, limits: Limits
) -> Outcome:
    """The same solution with its most tolerant directions."""
    assert outcome.solution is not None
    arguments = start, options.method, options.resolution, limits
    chain = tolerant(setting, outcome.solution.chain, *arguments)
    changed = {node.id: node for node in chain}
    outcome.nodes = [changed.get(node.id, node) for node in outcome.nodes]
    outcome.solution = chain[0]
    return outcome


def _apart(directions: Iterable[float], tolerance: float) -> tuple[float, ...]:
    """The directions in [0, 2 pi), ascending, of those that are the same only the first."""
    found: list[float] = []
    for direction in directions:
        turned = direction if 0.0 <= direction < TAU else math.fmod(direction + TAU, TAU)
        if all(abs(wrap(turned - other)) > 4.0 * tolerance for other in found):
            found.append(turned)
    return tuple(sorted(found))


def _middle(region: Region, space: ConfigurationSpace) -> Floats:
    """The middle of the box around a region."""
    contact, inside = space.contact, region.contact
    points = np.concatenate(
        (
            border(region.area)[0],
            contact.at(inside.edge, inside.low),
            contact.at(inside.edge, inside.high),
            contact.points[inside.vertices],
        )
    )
    middle: Floats = 0.5 * (np.min(points, axis=0) + np.max(points, axis=0))
    return middle
