"""What binds a limit: the motion that fails first beyond it, and the feature at which it does."""

from __future__ import annotations

from dataclasses import dataclass

from preimage.analysis.cell import Cell, planned
from preimage.configuration.region import Region
from preimage.configuration.start import Start, covered, start_region
from preimage.errors import InputError
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.search.planner import plan
from preimage.search.reasons import reasons
from preimage.strategy.reason import Reason, shown_reasons
from preimage.strategy.strategy import Motion, Strategy, StrategyRegion
from preimage.task.options import Method, PlannerOptions, StrategyKind, Termination
from preimage.task.task import Task
from preimage.task.template import Template


@dataclass(frozen=True, slots=True)
class Cause:
    """Why there is no plan any more.

    Parameters
    ----------
    motions : the motions of the last plan, by place from 1, of which each alone, with the larger
        error, breaks the plan; none if only all of them together do, or if that is not known.
    of : how many motions the last plan has.
    words : what stands in the way of the first of them, or of any plan.
    reason : the same as data, where there is one.
    """

    motions: tuple[int, ...]
    of: int
    words: str
    reason: Reason | None = None


@dataclass(frozen=True, slots=True, eq=False)
class _Link:
    """One motion of a chain: from where it has to lead, and to what it was planned to."""

    motion: Motion
    begin: Start


def cause_of(template: Template, options: PlannerOptions, inside: Cell, outside: Cell) -> Cause:
    """What binds between a cell that has a plan and one beside it that has none.

    The plan of the cell inside is made anew, motion by motion from the goal, with the same
    directions, one motion at a time under the errors of the cell outside. The first motion of which
    the beginning is not in its region any more is asked why (`search.reasons`). Where no motion
    alone breaks the plan, or the scene itself differs, all that the planner says of the cell
    outside is taken.
    """
    kept = planned(template, options, inside)
    try:
        lost = planned(template, options, outside)
    except InputError as error:
        return Cause((), len(kept.steps), f"there is no such task: {error}")
    linear = options.strategy is StrategyKind.LINEAR and kept.steps
    instantaneous = options.termination is Termination.INSTANTANEOUS
    same_scene = lost.task.workspace == kept.task.workspace and lost.task.robot == kept.task.robot
    if linear and instantaneous and same_scene and lost.task.goal == kept.task.goal:
        found = _broken(kept, lost.task, inside.method)
        if found is not None:
            return found
    if lost.reason:
        return Cause((), len(kept.steps), lost.reason)
    why = plan(lost.task).why
    words = shown_reasons(why)[0] if why else "what stands in the way has not been found"
    return Cause((), len(kept.steps), words, why[0] if why else None)


def _broken(kept: Strategy, changed: Task, method: Method) -> Cause | None:
    """The motions that break the plan, each alone; None if none does."""
    settings = Setting.of(kept.task, kept.space), Setting.of(changed, kept.space)
    start = start_region(kept.task, kept.space)
    links = []
    begin = start
    for number in kept.steps:
        motion = kept.region(number).motion
        assert motion is not None
        links.append(_Link(motion, begin))
        begin = Start.anywhere_in(motion.target)
    alone = []
    first: tuple[str, Reason] | None = None
    for place in range(len(links)):
        found = _followed(kept, links, place, settings, method)
        if found is not None:
            alone.append(place + 1)
            first = first or found
    if first is None:
        return None
    return Cause(tuple(alone), len(links), *first)


def _followed(
    kept: Strategy,
    links: list[_Link],
    changed: int,
    settings: tuple[Setting, Setting],
    method: Method,
) -> tuple[str, Reason] | None:
    """Why the chain breaks with one motion changed; None if it does not."""
    goal = kept.region(0).region
    failed: list[tuple[Setting, _Link, Region]] = []
    for place in reversed(range(len(links))):
        setting, link = settings[place == changed], links[place]
        region = preimage(setting, goal, link.motion.direction, method).region
        if place <= changed and not covered(link.begin, region, kept.space):
            failed.append((setting, link, goal))
        goal = region
    if not covered(links[0].begin, goal, kept.space):
        setting, link, goal = failed[0]
        known = [StrategyRegion(0, 0, goal, None)]
        why = reasons(setting, link.begin, known, (link.motion.direction,), method)
        return (shown_reasons(why)[0], why[0]) if why else None
    return None
