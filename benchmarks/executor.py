"""The executor: making a plan ready, and what one reading takes, by the number of edges."""

from __future__ import annotations

from functools import partial

import numpy as np

from benchmarks.timing import Row, best
from preimage.configuration.contact import Floats
from preimage.execution.cells import ReadingCells
from preimage.execution.executor import Doing, Executor
from preimage.execution.program import Program, compiled
from preimage.recognition.interpretation import Interpretation, contained
from preimage.recognition.outside import outside
from preimage.search.planner import plan
from preimage.task.examples import named_task

READINGS = 1_000
"""So that milliseconds in the table are microseconds a reading."""

HALLS = (2, 18, 180, 1_800)


def followed(program: Program, x: float, y: float) -> None:
    """A stream of readings from about the start, none of which ends the motion."""
    executor = Executor(program)
    executor.start(0.0, x, y)
    for number in range(1, READINGS + 1):
        answer = executor.read(1e-6 * number, x, y, None)
    assert answer.doing is Doing.MOVING


def near_contact(program: Program, number: int) -> list[tuple[float, float, float | None]]:
    """Readings around contact, half of them of a push that something there can give."""
    strategy, rng = program.strategy, np.random.default_rng(0)
    contact, motion = strategy.space.contact, program.motions[number]
    edge = rng.choice(contact.edges, READINGS)
    places: Floats = contact.at(edge, rng.random(READINGS) * contact.length[edge])
    places = places + strategy.task.uncertainty.position * rng.normal(size=(READINGS, 2))
    push = motion.readings.center[edge] + rng.normal(size=READINGS)
    return [
        (x, y, None if count % 2 else force)
        for count, ((x, y), force) in enumerate(zip(places.tolist(), push.tolist(), strict=True))
    ]


def asked(cells: ReadingCells, readings: list[tuple[float, float, float | None]]) -> None:
    """One question after the other."""
    for reading in readings:
        cells.misses(*reading)


def plainly(
    program: Program, number: int, readings: list[tuple[float, float, float | None]]
) -> None:
    """The same questions, by the plain definition."""
    space, motion = program.strategy.space, program.motions[number]
    rest = outside(space, program.strategy.region(motion.by_reading[0].goal).region)
    radius = program.strategy.task.uncertainty.position
    for x, y, force in readings:
        features = motion.readings.can_read(force)
        contained(space, motion.readings, Interpretation((x, y), radius, features), rest)


def executors() -> list[Row]:
    """Halls of four sizes: the plan made ready, a thousand readings, a thousand conditions."""
    rows: list[Row] = []
    for pillars in HALLS:
        strategy = plan(named_task(f"hall-{pillars}"))
        edges, number = len(strategy.space.contact), strategy.steps[0]
        program = compiled(strategy)
        motion, start = program.motions[number], program.beginning.point
        assert start is not None
        rows.append((f"{edges} edges: plan made ready", best(partial(compiled, strategy)), ""))
        spent = best(partial(followed, program, *start))
        remark = f"{1e6 * spent / READINGS:.2g} µs each, 20 µs or less"
        rows.append((f"{edges} edges: {READINGS:,} readings carried out", spent, remark))
        readings, cells = near_contact(program, number), motion.by_reading[0].cells
        assert cells is not None
        remark = f"{cells.leaves:,} cells, {cells.memory / 1e6:.2g} MB"
        spent = best(partial(asked, cells, readings))
        rows.append((f"{edges} edges: {READINGS:,} conditions near contact", spent, remark))
        few = readings[:100]
        spent = best(partial(plainly, program, number, few), 0.2) * READINGS / len(few)
        rows.append((f"{edges} edges: the same by the plain definition", spent, ""))
    return rows
