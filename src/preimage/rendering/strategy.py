"""Strategies as rows of panels, one a motion in the order of execution (paper, Figure 15)."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry.area import Area
from preimage.recognition.termination import Condition, ElapsedCondition, StickingCondition
from preimage.rendering.glyphs import draw_direction, draw_friction_cones
from preimage.rendering.layers import draw_region
from preimage.rendering.names import draw_edge_numbers, draw_name, draw_start_name
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import Panel
from preimage.rendering.reasons import draw_reasons, reason_words
from preimage.rendering.scene import Scene, draw_scene
from preimage.rendering.sheet import Plate, compose
from preimage.rendering.style import Layer
from preimage.strategy.strategy import Motion, Status, Strategy, StrategyRegion
from preimage.task.uncertainty import Uncertainty

MOST_FOUND = 40
"""So many of the regions that were found are drawn where there is no strategy."""

GOAL = r"$\mathcal{G}$"

COMPASS_WORDS = {
    0.0: "right", 45.0: "up and right", 90.0: "up", 135.0: "up and left", 180.0: "left",
    225.0: "down and left", 270.0: "down", 315.0: "down and right",
}  # fmt: skip


def strategy_figure(strategy: Strategy, options: PictureOptions) -> Figure:
    """The figure of a strategy: its motions, or what was found where there is none."""
    scene = Scene.of(strategy.task, strategy.space)
    motions = in_order(strategy)
    if strategy.status is not Status.SOLVED or not motions:
        plates = [_found_plate(strategy, scene, options)]
    else:
        shown = motions[: options.max_panels]
        names = _names(strategy, motions)
        plates = [
            _motion_plate(strategy, scene, motions, place, names, options)
            for place in range(len(shown))
        ]
    return compose(scene, plates, title(strategy, options), options, command=True)


def in_order(strategy: Strategy) -> list[StrategyRegion]:
    """The regions with a motion in the order of execution; without one, the farthest first."""
    if strategy.steps:
        return [strategy.region(number) for number in strategy.steps]
    moving = [region for region in strategy.regions if region.motion is not None]
    return sorted(moving, key=lambda region: (-region.rank, region.id))


def title(strategy: Strategy, options: PictureOptions) -> str:
    """One line on the whole strategy."""
    count = sum(region.motion is not None for region in strategy.regions)
    name = strategy.task.name.replace("$", r"\$")
    if strategy.status is Status.SOLVED:
        number = len(strategy.steps) or count
        words = "already there" if not number else f"solved in {_count(number, 'motion')}"
        if not strategy.steps and number:
            most = max((strategy.region(start).rank for start in strategy.start), default=0)
            words = f"{_count(most, 'motion')} at most, with {_count(number, 'region')}"
            if not strategy.failures:
                words = f"solved in {words}"
            elif strategy.can_succeed:
                words = f"ends in the goal, or knows that it has failed, in {words}"
            else:
                words = f"can only fail, and knows it, in {words}"
        if number > options.max_panels:
            words += f", {options.max_panels} of them shown"
        return f"{name}: {words}"
    if strategy.status is Status.STOPPED:
        reason = f", {strategy.reason}" if strategy.reason else ""
        return f"{name}: stopped{reason}"
    return f"{name}: no strategy for these directions and this method"


def degrees(direction: float) -> str:
    """A direction in degrees, and in words where there are some.

    >>> degrees(1.5 * math.pi), degrees(0.1)
    ('270° (down)', '5.73°')
    """
    turn = round(math.degrees(direction) % 360.0, 9)
    word = COMPASS_WORDS.get(turn)
    return f"{turn:.4g}°" + (f" ({word})" if word else "")


def target_words(region: Region) -> str:
    """What a target is made of.

    >>> target_words(Region.empty())
    'nothing'
    """
    contact, parts = region.contact, []
    if not region.area.is_empty:
        parts.append(f"an area of {region.area.measure:.3g}")
    if len(contact.edge):
        parts.append(f"contact of length {contact.total_length:.3g}")
    if len(contact.vertices):
        parts.append(_count(len(contact.vertices), "vertex", "vertices"))
    return _listed(parts) or "nothing"


def stop_words(condition: Condition, goal: str) -> str:
    """When a motion stops, in words.

    >>> stop_words(StickingCondition(2.5, 0.25), "the goal")
    'stuck (0.25 or less moved in 2.5)'
    """
    if isinstance(condition, StickingCondition):
        return f"stuck ({condition.distance:.3g} or less moved in {condition.period:.3g})"
    if isinstance(condition, ElapsedCondition):
        return f"a time of {condition.period:.3g} is over"
    return f"only {goal} fits what is read"


def detail(motion: Motion, goal: str) -> str:
    """What a motion aims at, and when it stops."""
    stops = [stop_words(condition, goal) for condition in motion.termination]
    words = f"aims at {target_words(motion.target)} in {goal}"
    return f"{words}; stops when {' or '.join(stops)}" if stops else words


def _names(strategy: Strategy, motions: list[StrategyRegion]) -> dict[int, str]:
    """The letters of regions: numbered by motion, or by their ids where there is a choice."""
    names = {0: GOAL} | {one.id: rf"$\mathcal{{F}}_{{{one.id}}}$" for one in strategy.failures}
    for place, region in enumerate(motions):
        number = place + 1 if strategy.steps else region.id
        names[region.id] = rf"$\mathcal{{P}}_{{{number}}}$"
    return names


def _motion_plate(
    strategy: Strategy,
    scene: Scene,
    motions: list[StrategyRegion],
    place: int,
    names: dict[int, str],
    options: PictureOptions,
) -> Plate:
    region = motions[place]
    motion = region.motion
    assert motion is not None
    goals = [strategy.region(number) for number in motion.goals]
    goal = " or ".join(names.get(number, GOAL) for number in motion.goals[:4])
    if len(motion.goals) > 4:
        goal = f"one of {len(motion.goals)} regions"
    heading = f"Motion {place + 1} of {len(motions)}: {degrees(motion.direction)}"
    if not strategy.steps:
        heading = f"Region {region.id}, rank {region.rank}: {degrees(motion.direction)}"
    starts_here = region.id in strategy.start

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene, start=starts_here)
        for subgoal in goals:
            if subgoal.id != 0:
                outline = without_contact(subgoal.region)
                layer = Layer.LOST if subgoal.failure else Layer.SUBGOAL
                draw_region(panel, layer, outline, number=subgoal.id)
        if starts_here and strategy.certain is not None and not strategy.certain.is_empty:
            draw_region(panel, Layer.CERTAIN, strategy.certain)
        draw_region(panel, Layer.TARGET, motion.target)
        plain = motion.target.area
        draw_region(panel, Layer.PREIMAGE, region.region, number=region.id, plain=plain)
        draw_command(panel, scene, motion.direction, motion.target, options)
        if not options.names:
            return
        if starts_here:
            draw_start_name(panel, scene)
        if scene.goal is not None:
            draw_name(panel, GOAL, Layer.GOAL, scene.goal)
        draw_name(panel, names[region.id], Layer.PREIMAGE, region.region)
        for subgoal in goals[:3]:
            if subgoal.id != 0:
                draw_name(panel, names.get(subgoal.id, ""), Layer.SUBGOAL, subgoal.region)

    name = f"motion-{place + 1}" if strategy.steps else f"region-{region.id}"
    return Plate(name, heading, detail(motion, goal), paint, compass=True)


def without_contact(region: Region) -> Region:
    """The area of a region, if it has one: its contact is in the next panel."""
    return region if region.area.is_empty else Region(region.area, ContactSet.empty())


def draw_command(
    panel: Panel,
    scene: Scene,
    direction: float,
    target: Region,
    options: PictureOptions,
) -> None:
    """Draw a command, and what the options add to it."""
    bounds: Uncertainty | None = None if scene.task is None else scene.task.uncertainty
    if options.friction_cones:
        draw_friction_cones(panel, scene, target)
    if options.edge_numbers:
        draw_edge_numbers(panel)
    draw_direction(panel, direction, None if bounds is None else bounds.control)


def _found_plate(strategy: Strategy, scene: Scene, options: PictureOptions) -> Plate:
    """What was found where there is no strategy: the largest regions, through each other."""
    found = [region for region in strategy.regions if region.motion is not None]
    found.sort(key=lambda part: (-part.region.area.measure, part.id))
    shown = sorted(found[:MOST_FOUND], key=lambda part: part.id)
    if strategy.status is Status.SOLVED:
        heading, words = "Nothing to do", "the start lies in the goal"
    else:
        heading = f"{_count(len(found), 'region')} found"
        longest = max((region.rank for region in found), default=0)
        words = f"from them the goal is reached in {_count(longest, 'motion')}"
        words += " or fewer" if longest > 1 else ""
        words = words if found else "no motion is known to reach the goal"
        words += f"; the {MOST_FOUND} largest are shown" if len(found) > MOST_FOUND else ""
        words += f". {reason_words(strategy)}" if strategy.why else ""

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene)
        for region in shown:
            area = Region(region.region.area, ContactSet.empty())
            draw_region(panel, Layer.FOUND, area, number=region.id)
        draw_region(panel, Layer.FOUND, Region(Area.empty(), _contact_of(shown, scene)))
        if options.edge_numbers:
            draw_edge_numbers(panel)
        if options.names:
            draw_scene_names(panel, scene)
        draw_reasons(panel, strategy.why)

    return Plate("found", heading, words, paint)


def _contact_of(regions: list[StrategyRegion], scene: Scene) -> ContactSet:
    """The contact of all regions together."""
    parts = [region.region.contact for region in regions] or [ContactSet.empty()]
    return ContactSet.of(
        np.concatenate([part.edge for part in parts]),
        np.concatenate([part.low for part in parts]),
        np.concatenate([part.high for part in parts]),
        np.concatenate([part.vertices for part in parts]),
        scene.space.tolerance.length,
    )


def draw_scene_names(panel: Panel, scene: Scene) -> None:
    """Write the letters of start and goal."""
    draw_start_name(panel, scene)
    if scene.goal is not None:
        draw_name(panel, GOAL, Layer.GOAL, scene.goal)


def _count(number: int, one: str, many: str | None = None) -> str:
    return f"{number} {one if number == 1 else many or one + 's'}"


def _listed(parts: list[str]) -> str:
    return " and ".join([", ".join(parts[:-1]), parts[-1]] if len(parts) > 1 else parts)
