"""Plans of one motion, made by hand, and what is wrong with them."""

from __future__ import annotations

from collections.abc import Sequence

from preimage.configuration.region import Region
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.strategy.strategy import Motion, Statistics, Status, Strategy, StrategyRegion
from preimage.task.options import StrategyKind
from preimage.task.task import Task
from preimage.verification.verdict import Fault, Finding
from preimage.verification.verify import verify


def one_motion(
    task: Task, setting: Setting, goals: Sequence[Region], made: Preimage, *, near: int = 0
) -> Strategy:
    """The plan to make this motion, which ends in one of the goals.

    Parameters
    ----------
    near : which of the goals is the plan's.
    """
    names = [0 if number == near else number + 2 for number in range(len(goals))]
    motion = Motion(made.direction, tuple(names), made.target.region, made.termination)
    ends = [
        StrategyRegion(name, 0 if name == 0 else 1, goal, None if name == 0 else motion)
        for name, goal in zip(names, goals, strict=True)
    ]
    first = StrategyRegion(1, 2, made.region, motion)
    regions = sorted((*ends, first), key=lambda region: region.id)
    linear = len(goals) == 1
    return Strategy(
        task,
        setting.space,
        Status.SOLVED,
        StrategyKind.LINEAR if linear else StrategyKind.CONDITIONAL,
        tuple(regions),
        (1,),
        (1,) if linear else (),
        Statistics(),
    )


def broken(strategy: Strategy, runs: int = 2) -> list[Finding]:
    """What is wrong with the first motion, and with runs, wherever start and goal are."""
    if strategy.steps:
        found = verify(strategy, runs=runs)
        return [one for one in found.every if one.fault not in (Fault.START, Fault.GOAL)]
    motions = verify(strategy, runs=0).motions
    return [one for motion in motions if motion.region == 1 for one in motion.findings]
