"""Write the tables of docs/conditions.md: what knowing the start and the end is worth.

Run from anywhere: `python examples/tables/conditions.py [FILE]`. What stands in the page above the
line `<!-- tables -->` is kept.
"""

from __future__ import annotations

import argparse
import math
import textwrap
from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np
from numpy.typing import NDArray

from preimage import Method, Task, named_task, named_tasks, plan
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region, intersection
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import covered, start_region
from preimage.errors import UnsupportedError
from preimage.geometry import area as areas
from preimage.geometry.angles import unit, wrap
from preimage.mechanics.behaviour import Behaviour
from preimage.mechanics.damper import guaranteed_progress
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.preimages.start_search import stateful_preimage
from preimage.preimages.starts import span, start_as_region
from preimage.preimages.state import WIDER, united, visited
from preimage.strategy.strategy import Motion, Status, Strategy
from preimage.task.options import Continuous, Termination, uniform_directions

PAGE = Path(__file__).resolve().parents[2] / "docs" / "conditions.md"

MARK = "<!-- tables -->"

METHODS = (Method.KERNEL, Method.COMBINED)

WORTH = 1e-3
"""Gains below this share are left out."""


def directions(task: Task) -> tuple[float, ...]:
    """The task's directions; eight, if it has all of them."""
    given = task.options.directions
    return uniform_directions(8) if isinstance(given, Continuous) else given


# --- the first preimage ---------------------------------------------------------------------


def largest(task: Task, method: Method, termination: Termination) -> tuple[float, str, bool, float]:
    """Of all directions, the largest preimage of the goal: its size, what it has, and the time.

    The size is the area in bands as wide as the window, and the length of contact. The third
    value says whether one motion from the task's start is enough, for a start that is known.
    """
    setting = Setting.of(task)
    space = setting.space
    goal, start = goal_region(task, space), start_region(task, space)
    known = None if termination is Termination.INSTANTANEOUS else start_as_region(start, space)
    best, words, solved = 0.0, "–", False
    began = process_time()
    made: list[Preimage] = []
    for direction in directions(task):
        found = stateful_preimage(setting, [goal], direction, method, termination)
        if found is not None:
            made.append(found)
    seconds = (process_time() - began) / len(directions(task))
    for one in made:
        area, contact = one.region.area.measure, one.region.contact.total_length
        solved |= covered(start, one.region, space)
        if (size := area / span(space) + contact) > best:
            best, words = size, f"{area:.4g} + {contact:.4g}"
    for direction in directions(task) if known is not None and not solved else ():
        found = stateful_preimage(setting, [goal], direction, method, termination, known)
        solved |= found is not None and covered(start, found.region, space)
    return best, words, solved, 1e3 * seconds


def first_preimages() -> str:
    """The table of first preimages."""
    lines = [
        "| task | method | instantaneous | initial state | final state | one motion | ms |",
        "|---|---|--:|--:|--:|---|--:|",
    ]
    same = []
    for name in named_tasks():
        task = named_task(name)
        for method in METHODS:
            found = [largest(task, method, termination) for termination in Termination]
            plain = found[0][0]
            if all(size <= (1.0 + WORTH) * plain for size, *_ in found):
                same.append(f"`{name}` ({method.value})")
                continue
            gains = [gain(size, plain) for size, *_ in found[1:]]
            solved = [
                termination.value
                for termination, (_, _, one, _) in zip(Termination, found, strict=True)
                if one
            ]
            times = " / ".join(f"{time:.0f}" for *_, time in found)
            cells = [
                f"`{name}`", method.value, found[0][1], *gains,
                "all" if len(solved) == len(Termination) else ", ".join(solved) or "none", times,
            ]  # fmt: skip
            lines.append("| " + " | ".join(cells) + " |")
    rest = textwrap.fill(
        "Nothing is gained in " + ", ".join(same) + ".", 100, break_on_hyphens=False
    )
    return "\n".join([*lines, "", rest])


def gain(size: float, plain: float) -> str:
    """By how much one size exceeds another."""
    if size <= (1.0 + WORTH) * plain:
        return "="
    return "from nothing" if plain == 0.0 else f"+{100.0 * (size / plain - 1.0):.1f} %"


# --- whole plans ----------------------------------------------------------------------------


def motions(task: Task, method: Method, termination: Termination) -> str:
    """How many motions the plan has; “?” if the planner does not know the condition."""
    options = replace(task.options, method=method, termination=termination, time_limit=15.0)
    try:
        strategy = plan(replace(task, options=options))
    except UnsupportedError:
        return "?"
    if strategy.status is Status.SOLVED:
        return str(len(strategy.steps) or max(region.rank for region in strategy.regions))
    return "–" if strategy.status is Status.UNSOLVABLE else "stopped"


def whole_plans() -> str:
    """The table of plans, where the condition makes a difference."""
    lines = [
        "| task | method | instantaneous | initial state | final state |",
        "|---|---|--:|--:|--:|",
    ]
    same = 0
    for name in named_tasks():
        task = named_task(name)
        for method in METHODS:
            counts = [motions(task, method, termination) for termination in Termination]
            if "?" in counts:
                return "The planner does not offer all of the conditions."
            if len(set(counts)) == 1:
                same += 1
            else:
                lines.append("| " + " | ".join([f"`{name}`", method.value, *counts]) + " |")
    return "\n".join([*lines, "", f"The other {same} are the same by all three."])


# --- elapsed time ---------------------------------------------------------------------------


def corners(region: Region, space: ConfigurationSpace) -> NDArray[np.float64]:
    """Points whose hull holds a region."""
    contact = region.contact
    return np.concatenate(
        (
            *region.area.rings,
            space.contact.at(contact.edge, contact.low),
            space.contact.at(contact.edge, contact.high),
            space.contact.points[contact.vertices],
            np.empty((0, 2)),
        )
    )


def ending(setting: Setting, begin: Region, motion: Motion, strategy: Strategy) -> Region:
    """Where a motion from a region may end: what it visits of its goals before its target."""
    near = setting.space.tolerance
    found = visited(setting, begin, setting.command(motion.direction), motion.target)
    wider = areas.shrunk(found.area, -WIDER * near.length)
    goals = united([strategy.region(goal).region for goal in motion.goals], near)
    return intersection(Region(wider, found.contact), goals, near)


def slowest(setting: Setting, region: Region, direction: float) -> float:
    """The guaranteed progress of a motion along v, in the unit of the commanded speed."""
    found = setting.command(direction).sources
    sticks, _ = found.where(Behaviour.MAY_STICK)
    slides, _ = found.where(Behaviour.MAY_SLIDE)
    edges = np.unique(region.contact.edge)
    edges = edges[slides[edges] & ~sticks[edges]]
    beta = wrap(direction + np.pi - setting.space.contact.normal[edges])
    control = setting.uncertainty.control
    return guaranteed_progress(beta, control, setting.friction, setting.sliding)


def clocks() -> str:
    """What the clock tells of the way along v, beside what the position does, motion by motion."""
    lines = [
        "| task | motion | way | least progress | start's depth | clock leaves | position leaves |",
        "|---|--:|--:|--:|--:|--:|--:|",
    ]
    better = count = 0
    for name in named_tasks():
        task = named_task(name)
        strategy = plan(task)
        if strategy.status is not Status.SOLVED:
            continue
        space = strategy.space
        setting = Setting.of(task, space)
        begin = start_as_region(start_region(task, space), space)
        for place, number in enumerate(strategy.steps):
            region = strategy.region(number)
            assert region.motion is not None
            along = np.array(unit(region.motion.direction))
            ends = ending(setting, begin, region.motion, strategy)
            from_, to = (corners(one, space) @ along for one in (begin, ends))
            depth = float(np.ptp(from_))
            way = max(0.0, float(to.max() - from_.min()))
            progress = slowest(setting, region.region, region.motion.direction)
            clock = (1.0 - progress) * way + depth
            position = 4.0 * task.uncertainty.position
            count += 1
            better += clock < position
            cells = [
                f"`{name}`" if place == 0 else "", str(place + 1),
                *(f"{value:.3g}" for value in (way, progress, depth, clock)),
                "∞" if math.isinf(position) else f"{position:.3g}",
            ]  # fmt: skip
            lines.append("| " + " | ".join(cells) + " |")
            begin = ends
    summary = f"The clock leaves less than the position in {better} of {count} motions."
    return "\n".join([*lines, "", summary])


def tables() -> str:
    """All tables."""
    parts = (
        "## The first preimage\n",
        "Of the goal, in the best of the task's directions: area + length of contact; by how much\n"
        "the size (area in bands as wide as the window, and contact) grows; by which conditions\n"
        "one motion from the task's start is enough, the start being known to those with state;\n"
        "milliseconds of one processor for one preimage, of each condition.\n",
        first_preimages(),
        "\n## Whole plans\n",
        "Motions of the linear plan; “–” where there is none.\n",
        whole_plans(),
        "\n## The clock\n",
        "For each motion of the tasks' plans: the way along v, the least progress on it (1 is the\n"
        "commanded speed), how deep along v the region in which it begins, and the spread along\n"
        "v of where the robot may be: as the clock leaves it, `(1 - s) way + depth`, and as one\n"
        "reading of the position does, `4 rho`.\n",
        clocks(),
    )
    return "\n".join(parts) + "\n"


def main() -> None:
    """Write the tables."""
    parser = argparse.ArgumentParser(description="Compare the termination conditions.")
    parser.add_argument("file", nargs="?", type=Path, default=PAGE, help="where to write them")
    file = parser.parse_args().file
    text = file.read_text(encoding="utf-8") if file.exists() else ""
    kept = text.split(MARK)[0]
    file.write_text(f"{kept}{MARK}\n\n{tables()}", encoding="utf-8")


if __name__ == "__main__":
    main()
