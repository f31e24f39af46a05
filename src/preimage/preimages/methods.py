"""The three methods of computing preimages, as one table (theory 6, paper 5.2, 5.3, 5.5)."""

from __future__ import annotations

from collections.abc import Callable

from preimage.configuration import contact_set
from preimage.configuration.region import Region, union
from preimage.preimages.preimage import Preimage, Target
from preimage.preimages.setting import Command, Setting
from preimage.preimages.sticking import sticking_features, sticking_termination
from preimage.reachability.backprojection import backproject
from preimage.recognition.kernel import kernel
from preimage.recognition.termination import Condition, ReadingCondition
from preimage.task.options import Method


def _sticking(setting: Setting, goal: Region, command: Command) -> Target:
    """Method 1: backprojection from sticking edges (paper 5.2)."""
    sticking = sticking_features(goal, command)
    return Target(sticking, sticking, Region.empty())


def _kernel(setting: Setting, goal: Region, command: Command) -> Target:
    """Method 2: backprojection from the goal's kernel (paper 5.3)."""
    core = kernel(
        setting.space, command.readings, goal, setting.uncertainty,
        arc_tolerance=setting.arc_tolerance,
    )  # fmt: skip
    return Target.of_kernel(core)


def _combined(setting: Setting, goal: Region, command: Command) -> Target:
    """Method 3: backprojection from both at once (paper 5.5)."""
    sticking = _sticking(setting, goal, command).sticking
    core = _kernel(setting, goal, command).kernel
    return Target(union(sticking, core, setting.space.tolerance), sticking, core)


METHODS: dict[Method, Callable[[Setting, Region, Command], Target]] = {
    Method.STICKING: _sticking,
    Method.KERNEL: _kernel,
    Method.COMBINED: _combined,
}


def preimage(setting: Setting, goal: Region, direction: float, method: Method) -> Preimage:
    """The preimage of a goal for a motion along `direction`, by one of the methods.

    The backprojection of the part of the goal that is recognised when it is attained: where the
    motion sticks for sure, or what no reading confuses with a configuration outside the goal, or
    both. It may be empty. The third method's contains those of the others, and may exceed their
    union (theory 6).

    Parameters
    ----------
    direction : radians.
    """
    return reach(setting, goal, direction, method, aim(setting, goal, direction, method))


def aim(setting: Setting, goal: Region, direction: float, method: Method) -> Target:
    """The part of a goal that a motion along `direction` can be known to have attained."""
    return METHODS[method](setting, goal, setting.command(direction))


def reach(
    setting: Setting, goal: Region, direction: float, method: Method, target: Target
) -> Preimage:
    """The preimage that aims at this part of the goal, and the conditions that end its motion."""
    return reach_any(setting, (goal,), direction, method, target)


def reach_any(
    setting: Setting,
    goals: tuple[Region, ...],
    direction: float,
    method: Method,
    target: Target,
) -> Preimage:
    """The preimage of several goals that aims at this part of them (theory 7, paper 8)."""
    command = setting.command(direction)
    reached = backproject(setting.space, target.region, command.sources)
    found, contact = reached.region, setting.space.contact
    region = Region(found.area, contact_set.without_outermost(found.contact, contact))
    conditions: list[Condition] = []
    if not target.sticking.is_empty:
        stuck = sticking_termination(setting, command, region)
        if stuck is None:  # no bound on the time that the motion takes
            return reach_any(setting, goals, direction, method, Target.of_kernel(target.kernel))
        conditions.append(stuck)
    if not target.kernel.is_empty:
        conditions.append(ReadingCondition(domain=None))
    return Preimage(
        region=region,
        direction=direction,
        goals=goals,
        method=method,
        target=target,
        termination=tuple(conditions),
        backprojection=reached,
    )
