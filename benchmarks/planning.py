"""Small scenes, stages and whole plans: what a user waits for."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace
from functools import partial

from benchmarks.backprojection import command, region
from benchmarks.halls import hall
from benchmarks.timing import Row, best
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.preimages.methods import preimage
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.search.planner import plan
from preimage.task.examples import named_task, named_tasks
from preimage.task.options import Method


def small_scenes() -> list[Row]:
    """One backprojection with its region, and one preimage, warm."""
    rows: list[Row] = []
    task = named_task("peg-in-hole")
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    down = command(setting.space)
    rows.append(
        (
            "peg in hole: backprojection and region",
            best(partial(region, setting.space, goal, down)),
            "0.2 ms or less",
        )
    )
    for polygons, bound in ((12, "1 ms or less"), (250, "5 ms or less")):
        space, floor = hall(4 * polygons)
        turned = command(space)
        spent = best(partial(region, space, floor, turned))
        rows.append((f"{polygons} polygons: backprojection and region", spent, bound))
    task = named_task("hall-9")
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    edges = len(setting.space.contact)
    for degrees in (270, 300, 0):
        first = partial(anew, setting, goal, math.radians(degrees))
        second = partial(anew, setting, first().region, math.radians(degrees + 90))
        for name, stage in (
            (f"preimage at {degrees}°", first),
            ("preimage of that at 90°", second),
        ):
            rows.append((f"{edges} edges: {name}, combined", best(stage), "2 ms or less"))
    return rows


def anew(setting: Setting, goal: Region, direction: float) -> Preimage:
    """The combined method's preimage of a goal that was never seen: nothing of it is kept."""
    return preimage(setting, replace(goal), direction, Method.COMBINED)


def whole_plans() -> list[Row]:
    """Every named task by its own options, warm, in-process."""
    rows: list[Row] = []
    for name in named_tasks():
        task = named_task(name)
        strategy = plan(task)
        spent = best(partial(plan, task), seconds=0.3)
        found = f"{strategy.status.value}, {len(strategy.steps)} motions"
        rows.append((f"plan {name}", spent, found))
    return rows


def processes() -> list[Row]:
    """Whole processes, from their start to their end."""

    def run(*arguments: str) -> float:
        line = [sys.executable, *arguments]
        return best(partial(subprocess.run, line, check=True, capture_output=True))

    call = "from preimage.cli.main import main; main({!r})"
    return [
        ("process: python", run("-c", "pass"), ""),
        ("process: preimage --version", run("-c", call.format(["--version"])), ""),
        (
            "process: preimage plan --example peg-in-hole",
            run("-c", call.format(["plan", "--example", "peg-in-hole"])),
            "0.5 s or less",
        ),
    ]
