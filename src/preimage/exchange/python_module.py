"""A plan as a Python module of its own: the executor and its tables, without dependencies."""

from __future__ import annotations

import math
from importlib import resources
from pprint import pformat
from typing import Any

from preimage.execution.cells import Part, ReadingCells
from preimage.execution.executor import Doing, Executor
from preimage.execution.program import CompiledMotion, Program, Recognition, compiled
from preimage.execution.runs import RunOptions, run
from preimage.execution.trace import Trace
from preimage.strategy.strategy import Strategy

Plain = dict[str, Any]

MARK = "PLAN: dict = {}  # the tables: filled in when a plan is exported\n"

EXAMPLES = (("hunting", "towards"), ("random", "noise"), ("fleeing", "away"))
"""Runs that are recorded in the module, so that it can check itself."""


def module_text(strategy: Strategy) -> str:
    """The text of a module that carries a plan out (execution.executor, table by table).

    Raises
    ------
    PlanFileError : the plan is not solved.
    """
    program = compiled(strategy)
    template = (resources.files("preimage.exchange") / "standalone.py").read_text("utf-8")
    head, tail = template.split(MARK)
    plan = {**tables(program), "examples": _examples(program)}
    name = strategy.task.name.replace("\\", " ").replace('"', " ")
    head = head.replace(
        '"""A plan that carries itself out:', f'"""The plan of {name}, which carries itself out:'
    )
    return f"{head}PLAN = {pformat(plan, width=100, sort_dicts=False)}\n{tail}"


def tables(program: Program) -> Plain:
    """All that an executor looks up, as plain numbers, lists and mappings."""
    strategy = program.strategy
    senses, beginning = strategy.task.uncertainty, program.beginning
    radius, slack = senses.position, strategy.space.tolerance.length
    return {
        "name": strategy.task.name,
        "slack": slack,
        "position": radius if senses.has_position_sensor else 0.0,
        "reach": max(radius, slack) + 0.5 * slack if senses.has_position_sensor else None,
        "threshold": senses.force_thresholds[1] if senses.has_force_sensor else 0.0,
        "senses_position": senses.has_position_sensor,
        "senses_force": senses.has_force_sensor,
        "point": None if beginning.point is None else list(beginning.point),
        "initial": None if beginning.initial is None else _table(beginning.initial),
        "choices": _recognitions(beginning.choices),
        "ends": [[one.id, one.failure] for one in strategy.regions if one.motion is None],
        "motions": [_motion(program.motions[number]) for number in sorted(program.motions)],
    }


def _motion(motion: CompiledMotion) -> Plain:
    sticking, elapsed = motion.sticking, motion.elapsed
    return {
        "region": motion.region.id,
        "direction": motion.direction,
        "longest": motion.longest if math.isfinite(motion.longest) else None,
        "sticking": None if sticking is None else [sticking.period, sticking.distance],
        "elapsed": None if elapsed is None else elapsed.period,
        "by_reading": _recognitions(motion.by_reading),
        "by_rest": _recognitions(motion.by_rest),
        "possible": _table(motion.possible),
        "domains": [_table(domain) for domain in motion.domains],
        "resting": None if motion.resting is None else _table(motion.resting),
    }


def _recognitions(recognitions: tuple[Recognition, ...]) -> list[list[Any]]:
    return [[one.goal, None if one.cells is None else _table(one.cells)] for one in recognitions]


def _table(cells: ReadingCells) -> Plain:
    """A reading condition: kinds of reading sets, and the segments that have them."""
    table = cells.table
    kinds = zip(table.zero.tolist(), table.center.tolist(), table.half.tolist(), strict=True)
    borders = (table.parts == Part.BORDER).tolist()
    segments = zip(table.segments.tolist(), table.kind.tolist(), borders, strict=True)
    return {
        "kinds": [list(kind) for kind in kinds],
        "segments": [[*ends, kind, border] for ends, kind, border in segments],
    }


def _examples(program: Program) -> list[list[list[Any]]]:
    """Some runs, reading by reading, with the executor's answers."""
    found = []
    for control, sensing in EXAMPLES:
        options = RunOptions(runs=1)
        report = run(program.strategy, control=control, sensing=sensing, options=options)
        found += [_recorded(program, trace) for trace in report.samples[:1]]
    return found


def _recorded(program: Program, trace: Trace) -> list[list[Any]]:
    executor = Executor(program)
    rows: list[list[Any]] = []
    for time, (x, y), force in readings_of(trace):
        told = None if math.isnan(force) else force
        answer = executor.read(time, x, y, told) if rows else executor.start(time, x, y)
        place = [None if math.isnan(value) else value for value in (x, y)]
        rows.append([time, *place, told, _doing(answer.doing), answer.region])
        if answer.command is None:
            break
    return rows


def readings_of(trace: Trace) -> list[tuple[float, tuple[float, float], float]]:
    """What was read in a run: times, positions, and angles of forces, NaN where 0 was read.

    Where a motion was ended by standing still, nothing was looked at.
    """
    senses = trace.strategy.task.uncertainty.has_position_sensor
    rows: list[tuple[float, tuple[float, float], float]] = []
    for leg in trace.legs:
        for time, (x, y), force in zip(
            leg.times.tolist(), leg.measured.tolist(), leg.forces.tolist(), strict=True
        ):
            if senses and math.isnan(x):
                continue
            if not rows:
                rows.append((time, (x, y), math.nan))
            elif time > rows[-1][0]:
                rows.append((time, (x, y), force))
    return rows


def _doing(doing: Doing) -> str:
    return doing.name.lower()
