import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from ezdxf.math import Matrix44
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from preimage.errors import InputError
from preimage.exchange.importing import import_task
from preimage.exchange.options import Nested
from preimage.task.goal import Goal
from preimage.task.initial import Everywhere, InitialDisc, InitialEdges, InitialPoint
from tests.exchange.dxf_drawings import (
    ON,
    WINDOW,
    Draw,
    drawn,
    read,
    read_or_refuse,
    sampled_bulge,
    solids,
    square,
)


def test_lines_are_joined_to_loops(tmp_path: Path) -> None:
    found = read(drawn(tmp_path, square))
    assert solids(found).equals(shapely.box(0, 0, 10, 10))


def test_lines_are_joined_in_any_order_and_direction(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        space.add_line((10, 10), (10, 0), dxfattribs=ON)
        space.add_line((0, 0), (0, 10), dxfattribs=ON)
        space.add_arc((5, 0), 5, 180, 360, dxfattribs=ON)
        space.add_line((10, 10), (0, 10.0000001), dxfattribs=ON)

    found = read(drawn(tmp_path, draw), join=1e-6)
    (area,) = found.task.workspace.obstacles
    true = shapely.union(shapely.box(0, 0, 10, 10), shapely.Point(5, 0).buffer(5, quad_segs=99))
    assert shapely.difference(true, shapely.buffer(solids(found), 1e-6)).is_empty
    assert len(area.exterior) < 60  # type: ignore[union-attr]


@pytest.mark.parametrize(("gap", "near", "joined"), [(0.1, 0.2, True), (0.1, 0.05, False)])
def test_gaps_are_bridged_within_the_tolerance(
    tmp_path: Path, gap: float, near: float, joined: bool
) -> None:
    def draw(space: Any) -> None:
        space.add_lwpolyline([(0, 0), (10, 0), (10, 10), (0, 10), (0, gap)], dxfattribs=ON)

    path = drawn(tmp_path, draw)
    if joined:
        assert solids(read(path, join=near)).area == pytest.approx(100)
    else:
        with pytest.raises(
            InputError, match=r"layer obstacles, LWPOLYLINE .* is open, from \(0, 0\)"
        ):
            read(path, join=near)


bulges = st.floats(-1.2, 1.2).map(lambda bulge: 0.0 if abs(bulge) < 0.05 else bulge)


@settings(max_examples=40)
@given(st.lists(bulges, min_size=3, max_size=6), st.booleans(), st.sampled_from([1.0, 0.05]))
def test_bulges_err_on_the_safe_side(
    tmp_path_factory: pytest.TempPathFactory,
    bulges: list[float],
    clockwise: bool,
    tolerance: float,
) -> None:
    count = len(bulges)
    turn = -1 if clockwise else 1
    corners = [
        (40 * math.cos(turn * math.tau * k / count), 40 * math.sin(turn * math.tau * k / count))
        for k in range(count)
    ]
    rows = [(x, y, 0, 0, bulge) for (x, y), bulge in zip(corners, bulges, strict=True)]
    true = shapely.Polygon(
        [
            spot
            for k in range(count)
            for spot in sampled_bulge(corners[k], corners[(k + 1) % count], bulges[k])
        ]
    )
    assume(true.is_valid)
    folder = tmp_path_factory.mktemp("dxf")

    def draw(layer: str) -> Draw:
        return lambda space: space.add_lwpolyline(rows, close=True, dxfattribs={"layer": layer})

    outer = read_or_refuse(drawn(folder, draw("obstacles")), curves=tolerance)
    inner = read_or_refuse(drawn(folder, draw("goal")), goal=None, curves=tolerance)
    if isinstance(outer, str) or isinstance(inner, str):
        # a border that all but touches itself, or a tip of no angle
        refused = [found for found in (outer, inner) if isinstance(found, str)]
        assert all(re.search(r"too near|crosses itself|turns back", rule) for rule in refused)
        return
    # the samples are 0.02 off the arcs at most, but on them to the last digit
    spots = shapely.points(np.array(true.exterior.coords))
    assert shapely.difference(true, shapely.buffer(solids(outer), 0.02)).is_empty
    assert shapely.distance(solids(outer), spots).max() <= 1e-9
    goal = shapely.union_all([shapely.Polygon(ring) for ring in inner.task.goal.polygons])
    assert shapely.difference(goal, shapely.buffer(true, 0.02)).is_empty
    inside = shapely.contains(goal, spots)
    assert shapely.distance(goal.boundary, spots[inside]).max(initial=0.0) <= 1e-9
    assert shapely.difference(solids(outer), shapely.buffer(goal, 2.1 * tolerance)).area <= 1e-6


def test_splines_and_ellipses_are_enclosed(tmp_path: Path) -> None:
    control = [(0, 0), (4, -9), (20, -3), (13, 5), (18, 15), (3, 12), (0, 0)]
    curves = {}

    def draw(space: Any) -> None:
        curves["spline"] = space.add_spline(dxfattribs=ON)
        curves["spline"].set_open_uniform(control, degree=3)
        curves["ellipse"] = space.add_ellipse((40, 0), (10, 5), 0.3, dxfattribs=ON)

    found = read(drawn(tmp_path, draw), curves=0.5)
    solid = shapely.buffer(solids(found), 1e-9)
    for curve in curves.values():
        spots = np.array([(spot.x, spot.y) for spot in curve.flattening(1e-4)])
        assert shapely.covers(solid, shapely.points(spots)).all()
        true = shapely.Polygon(spots)
        assert shapely.difference(true, solid).area <= 1e-6 * true.area
    assert solid.area < 1.5 * (math.pi * 125 * 0.3 + 300)


def test_blocks_are_taken_apart(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        block = space.doc.blocks.new("PART")
        square(block, layer="0")
        block.add_circle((20, 5), 5, dxfattribs={"layer": "goal"})
        space.add_blockref("PART", (50, 0), dxfattribs={**ON, "rotation": 90})
        space.add_blockref("PART", (-50, 0), dxfattribs={**ON, "xscale": -2, "yscale": 1})

    found = import_task(drawn(tmp_path, draw), initial=Everywhere(), window=WINDOW)
    first, second = solids(found).geoms
    boxes = sorted([first.bounds, second.bounds])
    np.testing.assert_allclose(boxes, [(-70, 0, -50, 10), (40, 0, 50, 10)], atol=1e-9)
    goals = shapely.union_all([shapely.Polygon(ring) for ring in found.task.goal.polygons])
    assert goals.bounds == pytest.approx((-100, 0, 50, 25), abs=0.3)


def test_mirrored_entities_are_where_they_are_seen(tmp_path: Path) -> None:
    rows = [(0, 0, 0, 0, 0.5), (10, 0, 0, 0, -0.3), (10, 10, 0, 0, 0), (0, 10, 0, 0, 0)]

    def plain(space: Any) -> None:
        space.add_lwpolyline(rows, close=True, dxfattribs=ON)
        space.add_circle((40, 5), 3, dxfattribs=ON)
        space.add_arc((60, 5), 3, 20, 200, dxfattribs=ON)
        space.add_line(
            (60 + 3 * math.cos(math.radians(20)), 5 + 3 * math.sin(math.radians(20))),
            (60 + 3 * math.cos(math.radians(200)), 5 + 3 * math.sin(math.radians(200))),
            dxfattribs=ON,
        )

    def mirrored(space: Any) -> None:
        plain(space)
        for entity in space:
            entity.transform(Matrix44.scale(-1, 1, 1))

    first = solids(read(drawn(tmp_path, plain)))
    second = solids(read(drawn(tmp_path, mirrored)))
    assert (
        shapely.symmetric_difference(
            first, shapely.affinity.scale(second, -1, 1, origin=(0, 0))
        ).area
        <= 0.2
    )
    assert second.bounds[2] <= 1.5


@pytest.mark.parametrize("bulge", [1e-4, -1e-4, 9e-5, 1e-6, 1e-12, -1e-300])
def test_bulges_that_are_all_but_straight_count(tmp_path: Path, bulge: float) -> None:
    def draw(space: Any) -> None:
        rows = [(0, 0, 0, 0, bulge), (10, 0, 0, 0, 0), (10, 10, 0, 0, 0), (0, 10, 0, 0, 0)]
        space.add_lwpolyline(rows, close=True, dxfattribs=ON)

    for tolerance in (0.01, 1e-7):
        solid = solids(read(drawn(tmp_path, draw), curves=tolerance))
        # the arc is a parabola to the third order
        t = np.linspace(0, 1, 200)
        arc = np.stack((10 * t, -20 * bulge * t * (1 - t)), axis=1)
        assert shapely.distance(solid, shapely.points(arc)).max() <= 1e-9
        assert solid.area == pytest.approx(100, abs=1e-2)


@pytest.mark.parametrize("up", [1, -1])
def test_arcs_of_ellipses_are_seen_from_above_or_below(tmp_path: Path, up: int) -> None:
    arcs = []

    def draw(space: Any) -> None:
        more = {**ON, "extrusion": (0, 0, up)}
        arc = space.add_ellipse((5, 5), (10, 5), 0.3, 0.5, 2.5, dxfattribs=more)
        space.add_line(arc.start_point, arc.end_point, dxfattribs=ON)
        arcs.append(arc)

    solid = solids(read(drawn(tmp_path, draw)))
    true = shapely.Polygon([(spot.x, spot.y) for spot in arcs[0].flattening(1e-4)])
    assert shapely.difference(true, shapely.buffer(solid, 1e-9)).is_empty
    assert shapely.difference(solid, shapely.buffer(true, 0.05)).is_empty


@pytest.mark.parametrize(
    ("units", "wanted", "size"),
    [(4, "m", 0.01), (1, "mm", 254.0), (6, None, 10.0), (5, "in", 10 / 2.54)],
)
def test_units_are_scaled_on_request(
    tmp_path: Path, units: int, wanted: str | None, size: float
) -> None:
    goal = Goal(polygons=(((-3 * size, 0), (-2 * size, 0), (-2 * size, size)),))
    window = (-4 * size, -4 * size, 4 * size, 4 * size)
    found = read(drawn(tmp_path, square, units), units=wanted, goal=goal, window=window)
    assert solids(found).bounds == pytest.approx((0, 0, size, size))


def test_a_whole_task_is_drawn(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        corners = [(-50, -10), (50, -10), (50, 0), (10, 0), (10, -5), (-10, -5), (-10, 0), (-50, 0)]
        space.add_lwpolyline(corners, close=True, dxfattribs={"layer": "Walls"})
        space.add_line((-9, -4), (9, -4), dxfattribs={"layer": "GOAL"})
        space.add_lwpolyline(
            [(-1, 29), (1, 29), (1, 31), (-1, 31)], close=True, dxfattribs={"layer": "robot"}
        )
        space.add_lwpolyline(
            [(-60, -20), (60, -20), (60, 50), (-60, 50)], close=True, dxfattribs={"layer": "WINDOW"}
        )
        space.add_text("peg", dxfattribs={"layer": "robot"})
        space.add_line((0, 0), (1, 1), dxfattribs={"layer": "dimensions"})

    found = import_task(drawn(tmp_path, draw))
    task = found.task
    assert task.robot.shape == ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    assert task.initial == InitialPoint((0.0, 30.0))
    assert task.goal == Goal(edges=(((-9.0, -4.0), (9.0, -4.0)),))
    assert task.workspace.window.bounds == (-60.0, -20.0, 60.0, 50.0)
    assert "left out: 1 LINE on layer dimensions, 1 TEXT on layer robot" in found.notes


def test_a_start_may_be_a_disc_or_edges(tmp_path: Path) -> None:
    def disc(space: Any) -> None:
        square(space)
        space.add_circle((30, 30), 4, dxfattribs={"layer": "start"})

    def edges(space: Any) -> None:
        square(space)
        space.add_line((0, 10), (5, 10), dxfattribs={"layer": "start"})

    found = read(drawn(tmp_path, disc), initial=None)
    assert found.task.initial == InitialDisc((30.0, 30.0), 4.0)
    found = read(drawn(tmp_path, edges), initial=None)
    assert found.task.initial == InitialEdges((((0.0, 10.0), (5.0, 10.0)),))


def test_nested_outlines_are_solid_unless_said(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        square(space, size=30)
        space.add_circle((15, 15), 10, dxfattribs=ON)

    path = drawn(tmp_path, draw)
    assert solids(read(path)).area == 900
    ring = solids(read(path, nested=Nested.HOLE, curves=0.01))
    assert 900 - 100 * math.pi < ring.area < 900 - 100 * math.pi + 1


def test_around_a_room_all_is_solid(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        square(space, layer="room", size=30)
        space.add_circle((15, 15), 5, dxfattribs=ON)
        space.add_line((0, 0), (30, 0), dxfattribs={"layer": "goal"})
        space.add_point((5, 20), dxfattribs={"layer": "start"})

    found = import_task(drawn(tmp_path, draw))
    free = shapely.difference(shapely.box(*found.task.workspace.window.bounds), solids(found))
    true = shapely.difference(
        shapely.box(0, 0, 30, 30), shapely.Point(15, 15).buffer(5, quad_segs=99)
    )
    assert shapely.difference(free, true.buffer(1e-6)).is_empty
    assert free.area == pytest.approx(true.area, rel=0.01)


def test_goal_edges_snap_onto_contact_space_if_asked(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        square(space)
        space.add_line((1, 10.01), (5, 9.98), dxfattribs={"layer": "goal"})

    path = drawn(tmp_path, draw)
    with pytest.raises(InputError, match="does not lie in contact space"):
        read(path, goal=None)
    found = read(path, goal=None, snap=0.05)
    assert found.task.goal.edges == (((1.0, 10.0), (5.0, 10.0)),)
    assert any("moved onto contact space by up to 0.02" in line for line in found.notes)


def test_layers_that_are_off_are_left_out(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        square(space)
        space.doc.layers.add("start").off()
        space.add_point((50, 50), dxfattribs={"layer": "start"})

    found = read(drawn(tmp_path, draw))
    assert "left out: 1 POINT that cannot be seen" in found.notes
