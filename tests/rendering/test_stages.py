"""Preimages, backprojections and kernels on their own."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.patches import PathPatch, Polygon, Wedge

from preimage.configuration.obstacles import configuration_space
from preimage.errors import InputError
from preimage.reachability.backprojection import backproject
from preimage.reachability.sources import sources
from preimage.rendering import figure, svg
from preimage.task import Method
from tests.rendering.drawn import DOWN, artists, measure, points, preimage_of, task, words
from tests.strategies import random_scene


@pytest.mark.parametrize("method", Method)
def test_a_preimage_is_drawn_with_its_target_and_its_rays(method: Method) -> None:
    posed = task()
    made = preimage_of(posed, method=method)
    drawn = figure(made, task=posed)
    panel = artists(drawn, "preimage")
    assert measure(panel["preimage"]) == pytest.approx(made.region.area.measure)
    stripes = panel["preimage-stripes"]
    assert isinstance(stripes, PathPatch)
    assert stripes.get_hatch()
    assert measure(stripes) < measure(panel["preimage"])
    rays = panel["ray"]
    assert isinstance(rays, LineCollection)
    assert np.array(rays.get_segments()) == pytest.approx(made.backprojection.rays)
    assert ("target" in panel) == (not made.target.kernel.area.is_empty)
    assert ("sticking-contact" in panel) == bool(len(made.target.sticking.contact.edge))
    assert f"method {method.value}" in words(drawn)


def test_a_backprojection_has_the_vertices_of_its_region() -> None:
    posed = task()
    made = preimage_of(posed).backprojection
    panel = artists(figure(made, task=posed), "backprojection")
    corners = {tuple(point) for point in np.round(points(panel["preimage"]), 9).tolist()}
    region = {tuple(p) for ring in made.region.area.rings for p in np.round(ring, 9).tolist()}
    assert corners == region
    assert {"target-contact", "direction", "control-cone"} <= set(panel)


def test_the_control_cone_is_as_wide_as_it_is() -> None:
    posed = task()
    panel = artists(figure(preimage_of(posed), task=posed), "preimage")
    cone = panel["control-cone"]
    assert isinstance(cone, Wedge)
    assert (cone.theta1, cone.theta2) == pytest.approx((258.0, 282.0))
    outline = points_of_arrow(panel)
    assert outline[3] - outline[0] == pytest.approx([0, outline[3, 1] - outline[0, 1]], abs=0.1)
    assert outline[3, 1] < outline[0, 1]  # it points down


def points_of_arrow(panel: dict[str, Artist]) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    arrow = panel["direction"]
    assert isinstance(arrow, Polygon)
    return np.asarray(arrow.get_xy())


def test_exact_control_has_no_cone() -> None:
    force = {"angle": 10, "threshold": 0.05}
    posed = task(uncertainty={"control": 0, "position": 0.5, "force": force})
    panel = artists(figure(preimage_of(posed), task=posed), "preimage")
    assert "direction" in panel
    assert "control-cone" not in panel


def test_without_a_task_a_stage_is_drawn_in_its_space() -> None:
    made = preimage_of(task())
    panel = artists(figure(made.backprojection), "backprojection")
    assert {"preimage", "direction", "c-obstacle"} <= set(panel)
    assert "control-cone" not in panel


def test_kernels_are_regions_in_a_scene() -> None:
    posed = task()
    core = preimage_of(posed, method=Method.KERNEL).target.kernel
    drawn = figure(core, task=posed, direction=DOWN)
    panel = artists(drawn, "kernel")
    assert measure(panel["target"]) == pytest.approx(core.area.measure)
    assert "Kernel for 270° (down)" in words(drawn)
    with pytest.raises(InputError, match="task"):
        figure(core)


def test_an_end_that_does_not_belong_is_hollow() -> None:
    posed = task(
        window=[-10, 0, 10, 8], walls=["left", "right", "bottom"], obstacles=[],
        goal={"edges": [[[-10, 0], [10, 0]]]}, initial={"point": [0, 5]},
    )  # fmt: skip
    made = preimage_of(posed, method=Method.KERNEL)
    space = configuration_space(posed)
    vertices = made.target.kernel.contact.vertices
    corners = {tuple(point) for point in space.contact.points[vertices].tolist()}
    drawn = artists(figure(made, task=posed), "preimage")
    hollow = {tuple(point) for point in points(drawn["target-open-ends"]).tolist()}
    assert hollow == {(-10.0, 0.0), (10.0, 0.0)} - corners
    assert "end not in the target" in words(figure(made, task=posed))


def test_friction_cones_stand_on_the_target() -> None:
    posed = task()
    made = preimage_of(posed)
    panel = artists(figure(made, task=posed, friction_cones=True), "preimage")
    cones = [artist for name, artist in panel.items() if name.startswith("friction-cone")]
    assert cones
    for cone in cones:
        assert isinstance(cone, Wedge)
        assert cone.theta2 - cone.theta1 == pytest.approx(40.0)


def test_an_empty_preimage_is_said_in_words() -> None:
    posed = task(goal={"polygons": [[[-8, 5], [-7.9, 5], [-7.9, 5.1]]]})
    drawn = figure(preimage_of(posed, math.radians(90)), task=posed)
    assert "no part of the goal is recognised" in words(drawn)
    assert "preimage" not in artists(drawn, "preimage")


@settings(max_examples=15)
@given(st.integers(0, 10**6))
def test_any_backprojection_can_be_drawn_within_its_window(seed: int) -> None:
    scene = random_scene(Random(seed))
    space = scene.space
    command = sources(
        space.contact, scene.direction, scene.control, scene.friction, space.tolerance
    )
    made = backproject(space, scene.target, command)
    panel = artists(figure(made, space=space), "backprojection")
    low, high = np.array(space.window[:2]) - 1e-6, np.array(space.window[2:]) + 1e-6
    for name, artist in panel.items():
        if "band" in name or not isinstance(artist, PathPatch | LineCollection):
            continue
        assert np.all(points(artist) >= low)
        assert np.all(points(artist) <= high)
    if not made.region.area.is_empty:
        assert measure(panel["preimage"]) == pytest.approx(made.region.area.measure, abs=1e-9)
    ET.fromstring(svg(made, space=space))
