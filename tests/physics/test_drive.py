"""Runs: plans succeed, and every other end is told apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from preimage.execution.executor import Answer, Doing
from preimage.execution.program import Program, compiled
from preimage.execution.trace import Outcome
from preimage.physics.drive import Drive
from preimage.physics.plant import Plant
from preimage.physics.scene import Scene, scene
from preimage.physics.trials import plan_trials, trials
from preimage.search.planner import plan
from preimage.task.examples import named_task
from preimage.task.task import SlidingLaw

pytest.importorskip("mujoco")


def prepared(name: str, plant: Plant | None = None) -> tuple[Scene, Program]:
    task = replace(named_task(name), sliding=SlidingLaw.DAMPER)
    return scene(task, plant), compiled(plan(task))


@dataclass
class Always:
    """Commands one direction until it is fed up."""

    command: float
    until: float = math.inf
    end: Doing = Doing.DONE

    def start(self, time: float, x: float, y: float) -> Answer:
        return self.read(time, x, y, None)

    def read(self, time: float, x: float, y: float, force: float | None) -> Answer:
        if time >= self.until:
            return Answer(self.end, None, 0, None, "fed up")
        return Answer(Doing.MOVING, self.command, 1, None, "")


def one_run(name: str, controller: Always, patience: float) -> Drive:
    stage = scene(named_task(name))
    make: Callable[[np.random.Generator], Always] = lambda _: controller  # noqa: E731
    return next(trials(stage, make, 1, 1, patience))


@pytest.mark.parametrize(
    "name", ["peg-in-hole", "peg-in-hole-point", "example-1", "example-2", "example-4", "cradle"]
)
def test_plans_succeed(name: str) -> None:
    stage, program = prepared(name)
    for run in plan_trials(stage, program, 6, 1):
        assert run.outcome is Outcome.SUCCESS, run.words
        assert run.gap <= stage.plant.slack * stage.length
        assert run.rest <= stage.plant.slack * stage.length
        assert run.depth <= 0.05 * stage.length
        assert run.withheld < 0.2 * len(run.times)


def test_what_is_measured_is_within_bounds() -> None:
    stage, program = prepared("example-3")
    for run in plan_trials(stage, program, 6, 2):
        error = np.hypot(*(run.measured - run.places).T)
        assert np.all(error < stage.task.uncertainty.position)
        assert np.all(np.diff(run.times) > 0.0)
        assert np.isnan(run.commands[-1])
        moves = np.hypot(*np.diff(run.places, axis=0).T) / np.diff(run.times)
        assert np.all(moves <= 1.0 + 1e-6)


def test_a_run_does_not_depend_on_the_others() -> None:
    stage, program = prepared("peg-in-hole")
    many = list(plan_trials(stage, program, 4, 7))
    *_, again = plan_trials(stage, program, 3, 7)
    assert np.array_equal(many[2].places, again.places)
    assert np.array_equal(many[2].measured, again.measured, equal_nan=True)
    other = next(plan_trials(stage, program, 1, 8))
    assert not np.array_equal(many[0].measured[:5], other.measured[:5])


@pytest.mark.parametrize(
    ("controller", "patience", "outcome"),
    [
        (Always(0.0, 2.0), 50.0, Outcome.WRONG),
        (Always(0.0, 2.0, Doing.BROKEN), 50.0, Outcome.BROKEN),
        (Always(math.pi / 2.0), 50.0, Outcome.ESCAPED),
        (Always(0.0), 2.0, Outcome.ENDLESS),
        # The goal of example 1 is straight ahead.
        (Always(0.0, 14.0), 50.0, Outcome.SUCCESS),
        (Always(0.0), 14.0, Outcome.UNKNOWN),
    ],
)
def test_ends_are_told_apart(controller: Always, patience: float, outcome: Outcome) -> None:
    assert one_run("example-1", controller, patience).outcome is outcome


def test_errors_beyond_their_bounds_are_noticed_or_harmless() -> None:
    """Twice the position error that the plan counts on: nobody says it is there who is not."""
    stage, program = prepared("peg-in-hole", Plant(reserve=-1.0))
    ends = [run.outcome for run in plan_trials(stage, program, 12, 1)]
    assert Outcome.BROKEN in ends
    assert Outcome.WRONG not in ends


def test_nobody_is_kept_blind() -> None:
    """Where no force ever settles, readings come all the same, now and then."""
    stage, program = prepared("peg-in-hole", Plant(settled=-1.0))
    run = next(plan_trials(stage, program, 1, 1))
    assert run.outcome is Outcome.SUCCESS
    assert run.withheld > len(run.times)
    gaps = np.diff(run.times)
    plant = stage.plant
    longest = plant.longest + plant.pause + 2.0 * plant.every * plant.step
    assert np.all(gaps <= longest * stage.length)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rails", "connector", "example-3", "example-5", "blind-corner"])
def test_more_plans_succeed(name: str) -> None:
    stage, program = prepared(name)
    ends = [run.outcome for run in plan_trials(stage, program, 18, 1)]
    assert ends == [Outcome.SUCCESS] * len(ends)
