"""Runs in the engine as traces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from preimage.configuration.obstacles import configuration_space
from preimage.execution.program import compiled
from preimage.execution.trace import Outcome
from preimage.physics.scene import scene
from preimage.physics.traces import touched, trace_of
from preimage.physics.trials import plan_trials
from preimage.search.planner import plan
from preimage.task.examples import named_task
from preimage.task.task import SlidingLaw


def test_a_run_becomes_a_trace() -> None:
    pytest.importorskip("mujoco")
    task = replace(named_task("peg-in-hole"), sliding=SlidingLaw.DAMPER)
    stage, strategy = scene(task), plan(task)
    run = next(plan_trials(stage, compiled(strategy), 1, 1))
    trace = trace_of(run, stage, strategy, 3)
    assert trace.outcome is Outcome.SUCCESS
    assert trace.number == 3
    assert tuple(leg.region for leg in trace.legs) == strategy.steps
    assert trace.time == run.times[-1]
    first, second = trace.legs
    assert first.times[-1] == second.times[0]
    free = 2 * len(stage.space.contact)
    assert first.features[0] == free
    contact = stage.space.contact
    assert np.allclose(contact.points[[second.features[-1]]][:, 1], -3.0)
    for leg in trace.legs:
        assert np.all(np.abs(leg.actual - leg.direction) <= task.uncertainty.control)


def test_what_is_touched() -> None:
    contact = configuration_space(named_task("peg-in-hole-point")).contact
    count = len(contact)
    places = np.array([(0.0, 1.0), (-5.0, 0.0), (-1.0, 0.0), (0.999, -2.999), (0.0, -2.99)])
    free, floor, tip, corner, bottom = touched(contact, places, 0.015).tolist()
    assert free == 2 * count
    assert contact.points[floor][1] == contact.ends[floor][1] == 0.0
    assert contact.points[tip - count].tolist() == [-1.0, 0.0]
    assert contact.points[corner - count].tolist() == [1.0, -3.0]
    assert contact.points[bottom].tolist() in ([-1.0, -3.0], [1.0, -3.0])
