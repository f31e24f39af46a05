"""Figures 1, 3, 4 and 10 of the paper, by what their text says of them."""

from __future__ import annotations

import dataclasses
import math

import pytest
import shapely

from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.recognition.kernel import kernel
from preimage.search.planner import plan
from preimage.task.examples import named_task
from preimage.task.options import Method

DOWN = math.radians(270)


@pytest.mark.parametrize("name", ["peg-in-hole", "peg-in-hole-point"])
@pytest.mark.parametrize("control", [1.0, 5.0, 8.0])
def test_figure_3_the_hole_and_what_cannot_miss_it(name: str, control: float) -> None:
    """The hole, its walls, and the wedge above that narrows by the cone.

    The goal's corners are not in its kernel, since they may be read as the walls, which the paper
    does not look at: there the motion is known to have stuck.
    """
    task = named_task(name)
    uncertainty = dataclasses.replace(task.uncertainty, control=math.radians(control))
    task = dataclasses.replace(task, uncertainty=uncertainty)
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    found = preimage(setting, goal, DOWN, Method.COMBINED)
    assert not len(found.target.kernel.contact.vertices)
    half, depth, top = 1.0, 3.0, 10.0
    slope = math.tan(math.radians(control))
    height = min(top, half / slope)
    exact = 2 * half * depth + height * (2 * half - height * slope)
    assert found.region.area.measure == pytest.approx(exact, abs=1e-9)
    contact = found.region.contact
    assert contact.total_length == pytest.approx(2 * half + 2 * depth, abs=1e-9)
    # the floor is told from its walls, and from the ground at both sides of the hole
    assert found.target.region.contact.total_length == pytest.approx(2 * half, abs=1e-9)


def test_figure_4_the_landmark_is_an_edge() -> None:
    """The first motion ends on an edge that force sensing recognises, the second in the goal."""
    strategy = plan(named_task("landmark-edge"))
    assert strategy.status.value == "solved"
    assert len(strategy.steps) == 2
    first = strategy.region(strategy.steps[0]).motion
    assert first is not None
    assert first.target.contact.total_length > 0.0


def test_figure_10_the_kernel_goes_around_the_corner_of_the_box() -> None:
    """Straight parts to 1e-9, the arc on the safe side within its tolerance (paper 5.4.2)."""
    task = named_task("figure-10")
    setting = Setting.of(task)
    goal = goal_region(task, setting.space)
    readings = setting.command(DOWN).readings
    found: Region = kernel(setting.space, readings, goal, task.uncertainty)
    reach = 2 * task.uncertainty.position
    assert reach == 1.0
    corner = shapely.Point(1, 0).buffer(reach, quad_segs=4096)
    exact = shapely.box(-2, 0, 4, 3) - shapely.box(1, -1, 9, reach) - corner
    got = shapely.MultiPolygon([shapely.Polygon(ring) for ring in found.area.rings])
    assert shapely.difference(got, exact.buffer(1e-9)).area == pytest.approx(0.0, abs=1e-6)
    arc = 0.5 * math.pi * reach
    lost = 2 * task.options.arc_tolerance * reach * arc  # a chord's height along the arc
    assert exact.area - lost <= got.area <= exact.area + 1e-6
    slack = 2 * setting.space.tolerance.length
    assert got.bounds == pytest.approx((-2.0, 0.0, 4.0, 3.0), abs=slack)
    left = shapely.intersection(got, shapely.box(-9, 0, 0, 9))
    assert left.area == pytest.approx(2.0 * 3.0, abs=10.0 * slack)
    ((low, high),) = zip(found.contact.low, found.contact.high, strict=True)
    assert (low, high) == pytest.approx((4.0, 7.0), abs=slack)
