"""A plan that ends in the goal or knows that it has failed: three notches, one of them the goal."""

from __future__ import annotations

import math
from functools import cache

from preimage.configuration import region as regions
from preimage.configuration.goals import goal_region
from preimage.preimages.methods import aim, reach_any
from preimage.preimages.setting import Setting
from preimage.search.failure import hopeless
from preimage.strategy.strategy import Motion, Statistics, Status, Strategy, StrategyRegion
from preimage.task.initial import Initial, InitialPolygon
from preimage.task.options import Method, PlannerOptions, StrategyKind
from preimage.task.robot import Robot
from preimage.task.task import Goal, SlidingLaw, Task
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import PolygonObstacle, Side, Window, Workspace

DOWN = 1.5 * math.pi
DEPTH = 3.0


def three_notches(half: float = 4.0, control: float = 5.0) -> Task:
    """Downwards is all that is commanded; the start is two high and `2 half` wide."""
    saw = [(x, 0.0 if x % 4 else -DEPTH) for x in (-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0)]
    low, high = 2.0, 4.0
    start: Initial = InitialPolygon(((-half, low), (half, low), (half, high), (-half, high)))
    return Task(
        name="three-notches",
        workspace=Workspace(
            Window(-6.0, -5.0, 6.0, 6.0),
            frozenset((Side.LEFT, Side.RIGHT)),
            (PolygonObstacle(((-6.0, -5.0), (6.0, -5.0), *reversed(saw))),),
        ),
        robot=Robot(),
        uncertainty=Uncertainty(math.radians(control), 0.1, math.radians(10.0), (0.05, 0.05)),
        friction=math.radians(20.0),
        sliding=SlidingLaw.PROJECTION,
        initial=start,
        goal=Goal(points=((0.0, -DEPTH),)),
        options=PlannerOptions(directions=(DOWN,), strategy=StrategyKind.CONDITIONAL, or_fail=True),
    )


@cache
def or_fail(half: float = 4.0, control: float = 5.0) -> Strategy:
    """One motion downwards, into the goal or into one of the other notches."""
    task = three_notches(half, control)
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    lost = hopeless(setting, goal, (DOWN,))
    both = regions.union(goal, lost, setting.space.tolerance)
    target = aim(setting, both, DOWN, Method.STICKING)
    made = reach_any(setting, (goal, lost), DOWN, Method.STICKING, target)
    motion = Motion(DOWN, (0, 2), made.target.region, made.termination)
    found = (
        StrategyRegion(0, 0, goal, None),
        StrategyRegion(1, 1, made.region, motion),
        StrategyRegion(2, 0, lost, None, failure=True),
    )
    return Strategy(
        task, setting.space, Status.SOLVED, StrategyKind.CONDITIONAL, found, (1,), (), Statistics()
    )
