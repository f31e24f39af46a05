"""Forward projections against closed forms, in degenerate places, and with stop sets."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shapely import Polygon, box

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area
from preimage.reachability import forward_projection
from preimage.reachability.forward_projection import ForwardProjection, forward_project
from preimage.task.workspace import Side
from tests.strategies import space_of

DOWN = 270.0
FLOOR = box(-9, -9, 9, 0)


def projected(
    space: ConfigurationSpace, start: Region, *degrees: float, stop: Region | None = None
) -> ForwardProjection:
    """The forward projection, given direction, control and friction in degrees."""
    direction, control, friction = (math.radians(angle) for angle in degrees)
    return forward_project(space, start, direction, control, friction, stop)


def free(*bounds: float) -> Region:
    """A box of free space."""
    return Region(Area.box(*bounds), ContactSet.empty())


def edge_from(space: ConfigurationSpace, x: float, y: float) -> int:
    """The edge that starts at a place."""
    return int(np.argmin(np.hypot(*(space.contact.points - (x, y)).T)))


def on_edge(space: ConfigurationSpace, edge: int, low: float, high: float) -> Region:
    """A stretch of one edge."""
    return Region(Area.empty(), ContactSet.of([edge], [low], [high], [], space.tolerance.length))


def at_vertex(vertex: int) -> Region:
    """A single vertex."""
    return Region(Area.empty(), ContactSet.of([], [], [], [vertex], 1e-9))


def spans(found: ForwardProjection) -> dict[int, list[tuple[float, float]]]:
    """The intervals of edges, rounded."""
    contact = found.region.contact
    result: dict[int, list[tuple[float, float]]] = {}
    for edge, low, high in zip(
        contact.edge.tolist(), contact.low.tolist(), contact.high.tolist(), strict=True
    ):
        result.setdefault(edge, []).append((round(low, 6), round(high, 6)))
    return result


def reached_vertices(found: ForwardProjection) -> set[tuple[float, float]]:
    """The places of the vertices reached."""
    points = found.space.contact.points[found.region.contact.vertices]
    return {(round(x, 6), round(y, 6)) for x, y in points.tolist()}


@pytest.mark.parametrize("control", [1.0, 5.0, 20.0, 45.0])
def test_a_square_spreads_to_a_trapezoid(control: float) -> None:
    space = space_of([FLOOR])
    found = projected(space, free(-0.5, 1, 0.5, 2), DOWN, control, control + 1)
    slope = math.tan(math.radians(control))
    assert found.region.area.measure == pytest.approx(2.0 * (1.0 + 2.0 * slope), abs=1e-9)
    ((low, high),) = spans(found)[edge_from(space, -6, 0)]
    assert (low, high) == pytest.approx((5.5 - 2 * slope, 6.5 + 2 * slope), abs=1e-6)
    assert not found.escapes
    assert not len(found.region.contact.vertices)
    assert found.sweeps == 1


def test_with_perfect_control_it_falls_straight() -> None:
    space = space_of([FLOOR])
    found = projected(space, free(-0.5, 1, 0.5, 2), DOWN, 0.0, 20.0)
    assert found.region.area.measure == pytest.approx(2.0, abs=1e-8)
    assert spans(found) == {edge_from(space, -6, 0): [(5.5, 6.5)]}


def test_what_is_stuck_stays() -> None:
    space = space_of([FLOOR])
    start = on_edge(space, edge_from(space, -6, 0), 5, 7)
    found = projected(space, start, DOWN, 5.0, 20.0)
    assert found.region.area.is_empty
    assert spans(found) == {edge_from(space, -6, 0): [(5.0, 7.0)]}


def test_a_floor_is_slid_on_both_ways_where_control_beats_friction() -> None:
    mesa = box(-2, -9, 2, 0)
    space = space_of([mesa])
    top = edge_from(space, -2, 0)
    start = on_edge(space, top, 2, 2.5)
    still = projected(space, start, DOWN, 20.0, 20.1)
    assert spans(still) == {top: [(2.0, 2.5)]}
    found = projected(space, start, DOWN, 20.0, 19.9)
    assert spans(found)[top] == [(0.0, 4.0)]
    assert {(-2.0, 0.0), (2.0, 0.0)} <= reached_vertices(found)
    # over both ends, down both walls, and out below
    assert set(spans(found)) == {top, edge_from(space, 2, 0), edge_from(space, -2, -6)}
    assert len(found.open_sides) == 2
    wing = 0.5 * 6.0 * 6.0 * math.tan(math.radians(20.0))
    assert found.region.area.measure == pytest.approx(2 * wing, rel=1e-9)


def test_slides_go_back_over_ridges_and_fall_beyond() -> None:
    """Each battlement is climbed by a slide that goes back, and ends in a fall onto the next."""
    steps = []
    for k in range(3):
        left, top = 4.0 - 2.2 * k, 3.0 - 1.5 * k
        steps.append(Polygon([(left, -9), (left, top), (left + 2, top - 0.1), (left + 2, -9)]))
    space = space_of([*steps, box(-9, -9, 9, -5)], [Side.BOTTOM])
    start = on_edge(space, edge_from(space, 4, 3), 1.0, 1.1)
    found = projected(space, start, DOWN, 20.0, 5.0)
    tops = [edge_from(space, 4.0 - 2.2 * k, 3.0 - 1.5 * k) for k in range(3)]
    length = math.hypot(2, 0.1)
    for top in tops[1:]:
        assert spans(found)[top] == [(0.0, round(length, 6))]
    assert found.sweeps == 1 + len(tops)
    # with more friction than control uncertainty only what slides down is left
    held = projected(space, start, DOWN, 5.0, 20.0)
    assert list(spans(held)) == [tops[0]]


def test_a_slope_leads_to_its_foot_and_over_it() -> None:
    ramp = Polygon([(-3, 0), (3, 3), (3, -9), (-3, -9)])
    space = space_of([ramp])
    face = edge_from(space, -3, 0)
    found = projected(space, on_edge(space, face, 3, 4), DOWN, 1.0, 10.0)
    assert spans(found)[face] == [(0.0, 4.0)]
    assert (-3.0, 0.0) in reached_vertices(found)
    assert (3.0, 3.0) not in reached_vertices(found)
    assert spans(found)[edge_from(space, -3, -6)] == [(0.0, 6.0)]


def test_a_corner_is_left_into_its_wedge_only() -> None:
    """From a tip both flanks are slid on; from the foot of an overhang nothing is."""
    tip = Polygon([(-2, -2), (0, 1), (2, -2)])
    space = space_of([tip])
    found = projected(space, at_vertex(edge_from(space, 0, 1)), DOWN, 5.0, 10.0)
    assert set(spans(found)) == {edge_from(space, -2, -2), edge_from(space, 0, 1)}
    assert (0.0, 1.0) in reached_vertices(found)
    under = projected(space, at_vertex(edge_from(space, -2, -2)), DOWN, 5.0, 10.0)
    assert not spans(under)
    slope = math.tan(math.radians(5.0))
    assert under.region.area.measure == pytest.approx(4 * 4 * slope, rel=1e-9)


def test_a_notch_lets_nothing_out() -> None:
    notch = Polygon([(-9, 2), (-2, 2), (0, -1), (2, 2), (9, 2), (9, -9), (-9, -9)])
    space = space_of([notch])
    found = projected(space, free(-0.1, 1, 0.1, 1.2), DOWN, 10.0, 15.0)
    assert (0.0, -1.0) in reached_vertices(found)
    assert len(reached_vertices(found)) == 1
    assert not found.escapes


def test_a_pinch_is_solid() -> None:
    one, two = Polygon([(0, 0), (-4, 3), (-4, 0)]), Polygon([(0, 0), (4, 3), (4, 0)])
    space = space_of([one, two])
    found = projected(space, free(-0.1, 1, 0.1, 1.2), DOWN, 10.0, 5.0)
    assert found.region.area.bounds[1] == pytest.approx(0.0, abs=1e-9)
    assert not found.escapes
    above, below = found.space.contact.vertices, found.region.contact.vertices
    pinched = [v for v in above.tolist() if np.allclose(space.contact.points[v], 0.0)]
    assert len(pinched) == 2
    assert len(set(pinched) & set(below.tolist())) == 1


def test_an_area_does_not_touch_what_it_flies_away_from() -> None:
    ceiling = box(-9, 2, 9, 9)
    space = space_of([ceiling, FLOOR])
    found = projected(space, free(-1, 1, 1, 2), DOWN, 10.0, 30.0)
    assert set(spans(found)) == {edge_from(space, -6, 0)}


def test_an_overhang_is_left() -> None:
    """Contact that can only be left sends the robot off, and is not slid along."""
    space = space_of([box(-9, 2, 9, 9), FLOOR])
    ceiling = edge_from(space, 6, 2)
    found = projected(space, on_edge(space, ceiling, 5, 7), DOWN, 10.0, 30.0)
    slope = math.tan(math.radians(10.0))
    assert spans(found)[ceiling] == [(5.0, 7.0)]
    ((low, high),) = spans(found)[edge_from(space, -6, 0)]
    assert high - low == pytest.approx(2 + 4 * slope, abs=1e-6)


# --- stop sets --------------------------------------------------------------------------------


def test_a_stop_area_casts_a_shadow() -> None:
    space = space_of([FLOOR])
    stop = free(-1, 1, 1, 2)
    found = projected(space, free(-3, 4, 3, 5), DOWN, 10.0, 30.0, stop=stop)
    floor = edge_from(space, -6, 0)
    slope = math.tan(math.radians(10.0))
    # on both sides the flow leans into the shadow below the stop set
    inner = 1.0 - slope
    (first, second) = spans(found)[floor]
    assert first == pytest.approx((6 - 3 - 5 * slope, 6 - inner), abs=1e-6)
    assert second == pytest.approx((6 + inner, 6 + 3 + 5 * slope), abs=1e-6)
    assert not found.region.area.contains(0, 1.5)
    assert found.region.area.contains(0, 2.0)


def test_a_stop_interval_is_met_and_not_crossed() -> None:
    ramp = Polygon([(-3, 0), (3, 3), (3, -9), (-3, -9)])
    space = space_of([ramp])
    face = edge_from(space, -3, 0)
    stop = on_edge(space, face, 1.5, 2.0)
    found = projected(space, on_edge(space, face, 3, 4), DOWN, 1.0, 10.0, stop=stop)
    assert spans(found) == {face: [(2.0, 4.0)]}
    assert found.region.area.is_empty
    # what flies to it belongs
    flown = projected(space, free(-1.2, 2, -1.1, 2.1), DOWN, 1.0, 10.0, stop=stop)
    assert 1.5 < spans(flown)[face][0][0] < 2.0
    inside = projected(space, on_edge(space, face, 1.6, 1.7), DOWN, 1.0, 10.0, stop=stop)
    assert spans(inside) == {face: [(1.6, 1.7)]}


def test_a_stop_vertex_stops_a_slide() -> None:
    ramp = Polygon([(-3, 0), (3, 3), (3, -9), (-3, -9)])
    space = space_of([ramp])
    face = foot = edge_from(space, -3, 0)
    found = projected(space, on_edge(space, face, 3, 4), DOWN, 1.0, 10.0, stop=at_vertex(foot))
    assert list(spans(found)) == [face]
    assert reached_vertices(found) == {(-3.0, 0.0)}
    assert not found.escapes


@pytest.mark.parametrize("overlap", [0.0, 0.5, 1.0])
def test_a_start_in_the_stop_set_stays_and_the_rest_goes(overlap: float) -> None:
    space = space_of([FLOOR])
    start, stop = free(-1, 2, 1, 4), free(-2, 2, -1 + 2 * overlap, 4)
    found = projected(space, start, DOWN, 0.0, 30.0, stop=stop)
    assert found.region.area.measure == pytest.approx(4 + 4 * (1 - overlap), abs=1e-6)
    floor = edge_from(space, -6, 0)
    if overlap < 1.0:
        assert spans(found)[floor][0] == pytest.approx((5.0 + 2.0 * overlap, 7.0), abs=1e-6)
    else:
        assert not spans(found)


def test_a_start_around_a_stop_set() -> None:
    """The start's area goes on below the stop set, and beside the contact that it lies along."""
    space = space_of([FLOOR])
    start, stop = free(-3, 0, 3, 4), free(-1, 0, 1, 2)
    found = projected(space, start, DOWN, 5.0, 30.0, stop=stop)
    slope = math.tan(math.radians(5.0))
    floor = edge_from(space, -6, 0)
    assert spans(found)[floor] == [
        pytest.approx((3 - 4 * slope, 5.0), abs=1e-6),
        pytest.approx((7.0, 9 + 4 * slope), abs=1e-6),
    ]
    assert found.region.area.measure == pytest.approx(24 + 16 * slope, abs=1e-6)


def test_whoever_is_stopped_beside_an_open_side_has_not_escaped() -> None:
    space = space_of([FLOOR])
    floor = edge_from(space, -6, 0)
    end = floor
    start = on_edge(space, floor, 2, 3)
    assert projected(space, start, 200.0, 5.0, 10.0).escapes
    stopped = projected(space, start, 200.0, 5.0, 10.0, stop=at_vertex(end))
    assert not stopped.escapes
    assert end in stopped.region.contact.vertices


# --- degenerate input -------------------------------------------------------------------------


def test_nothing_goes_nowhere() -> None:
    found = projected(space_of([FLOOR]), Region.empty(), DOWN, 5.0, 5.0)
    assert found.region.is_empty
    assert not found.escapes


def test_an_area_that_crosses_obstacles_is_no_disaster() -> None:
    """Not a region of valid space; the answer is then all that the rest of it may reach, or all."""
    space = space_of([FLOOR, box(-1, 1, 1, 2)])
    start = free(-2, -1, 2, 3)
    found = projected(space, start, DOWN, 5.0, 30.0)
    assert found.region.area.contains(-1.5, 0.5)
    assert found.region.area.contains(1.5, 0.5)


def test_where_no_sweep_works_out_it_is_everywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(forward_projection, "_sweep", lambda *_: None)
    space = space_of([FLOOR])
    found = projected(space, free(-1, 1, 1, 2), DOWN, 5.0, 30.0)
    assert found.region.area.measure == pytest.approx(space.free.measure)
    assert found.region.contact.total_length == pytest.approx(
        ContactSet.whole(space.contact).total_length
    )
    assert found.escapes


@pytest.mark.parametrize("control", [0.0, 45.0, 89.9999])
@pytest.mark.parametrize("friction", [0.0, 45.0, 90.0])
@pytest.mark.parametrize("direction", [0.0, 45.0, 90.0, 225.0, 270.0])
def test_extreme_bounds_in_an_axis_parallel_scene(
    direction: float, control: float, friction: float
) -> None:
    space = space_of([box(-2, -2, 2, 2), box(2, -2, 3, 6), FLOOR])
    start = Region(
        Area.box(-4, 0, -2, 3), ContactSet.of([0], [0.0], [1.0], [0], space.tolerance.length)
    )
    found = projected(space, start, direction, control, friction)
    assert found.sweeps > 0
    assert found.region.area.measure >= 6.0 - 1e-6
