"""The redrawn figures: what each shows, by closed forms and by the paper's text."""

from __future__ import annotations

import math

import numpy as np
import pytest

from examples.figures import knowledge
from examples.figures.backprojections import marked
from examples.figures.redrawn import DOWN, by_method, seen
from preimage import Method, Setting, Status, named_task, preimage
from preimage.configuration.goals import goal_region
from preimage.configuration.region import is_subset
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import covered, start_region
from preimage.execution.runs import RunOptions, trace_of
from preimage.geometry import area as areas
from preimage.rendering.style import Layer
from preimage.task import Termination
from tests.figures.drawn import figure

# --- 1 to 4 -----------------------------------------------------------------------------------


def test_figure_1_the_way_straight_at_the_goal_is_not_safe() -> None:
    task = figure(1).views.views[0].task
    setting = Setting.of(task)
    goal, start = goal_region(task, setting.space), start_region(task, setting.space)

    def solves(degrees: float, method: Method) -> bool:
        region = preimage(setting, goal, math.radians(degrees), method).region
        return covered(start, region, setting.space)

    straight = math.degrees(math.atan2(1.25 - 7.0, -5.25 - 6.0)) % 360.0
    for method in Method:
        assert not any(solves(turn, method) for turn in (straight, 0.0, 90.0, 180.0, 270.0))
    found = [turn for turn in range(200, 260) if solves(turn, Method.COMBINED)]
    assert found == list(range(218, 239))


def test_figure_2_the_depression_is_narrower_by_the_peg() -> None:
    workspace, space = (view.space for view in figure(2).views.views)
    assert workspace is not None
    assert space is not None
    task = named_task("peg-in-hole")
    length = goal_region(task, space).contact.total_length
    assert length == pytest.approx(figure(2).numbers["width"])
    grown = areas.difference(space.obstacles, workspace.obstacles).measure
    assert grown == pytest.approx((3.0 - 2.0) * 3.0, rel=1e-6)  # the depression's sides alone
    assert areas.difference(workspace.obstacles, space.obstacles).measure < 1e-6


def test_figure_3_a_triangle_by_readings_and_the_hole_by_both() -> None:
    numbers = figure(3).numbers
    slope, half, depth, top = math.tan(math.radians(5.0)), 1.0, 3.0, 10.0
    triangle = half**2 / slope
    assert numbers["kernel"] == pytest.approx(triangle, rel=1e-6)
    assert numbers["frictionless"] == pytest.approx(triangle, rel=1e-6)
    assert numbers["combined"] == pytest.approx(
        2 * half * depth + top * (2 * half - top * slope), rel=1e-6
    )
    assert half / slope > top  # cut by the window
    assert not len(figure(3).views.views[0].parts[0].region.contact.vertices)
    assert len(figure(3).views.views[1].parts[1].region.contact.vertices) == 2


def test_figure_4_the_second_preimage_holds_the_start_and_aims_at_an_edge_of_the_first() -> None:
    one, two = (figure(4).region(place, rf"$\mathcal{{P}}_{{{place + 1}}}$") for place in (0, 1))
    view = figure(4).views.views[1]
    assert view.space is not None
    start = start_region(view.task, view.space)
    assert not covered(start, one, view.space)
    assert covered(start, two, view.space)
    landmark = figure(4).region(1, "$E$")
    assert landmark.contact.total_length > 10.0
    assert is_subset(landmark, one, view.space.tolerance)


# --- 5 and 6 ----------------------------------------------------------------------------------


def test_figure_5_rays_rise_from_marked_vertices_along_the_cone() -> None:
    view = figure(5).views.views[0]
    assert view.space is not None
    setting = Setting.of(view.task, view.space)
    goal = goal_region(view.task, view.space)
    vertices = marked(view.space.contact, goal, setting.command(DOWN).sources)
    points = view.space.contact.points[vertices]
    assert {tuple(point) for point in points.tolist()} == {place.at for place in view.places}
    assert {(-4.0, 0.0), (5.0, 0.0)} < {place.at for place in view.places}
    for line in view.lines:
        begin, end = line.points
        assert np.min(np.hypot(*(points - begin).T)) < 1e-9
        turn = math.atan2(end[0] - begin[0], end[1] - begin[1])
        assert abs(turn) == pytest.approx(view.task.uncertainty.control, abs=1e-6)


def test_figure_6_the_mark_costs_the_wedge_above_it() -> None:
    numbers = figure(6).numbers
    wedge = (14.0 - 6.0) ** 2 * math.tan(math.radians(5.0))
    assert numbers["maximal"] - numbers["marked"] == pytest.approx(wedge, rel=1e-6)
    name = r"$\mathcal{B}$"
    simple, multiple = (figure(6).region(place, name).area for place in (0, 1))
    tip = (0.0, 6.0)
    touching = [tip in map(tuple, ring.tolist()) for ring in simple.rings]
    assert touching == [True, True]  # the hole is not one: it meets the outer border at X
    assert [tip in map(tuple, ring.tolist()) for ring in multiple.rings] == [False, True]


# --- 7 to 10 ----------------------------------------------------------------------------------


def test_figure_7_moves_in_by_twice_rho() -> None:
    reach = 2.0 * 0.4
    assert figure(7).numbers["length"] == pytest.approx(6.0 - 2 * reach, abs=1e-6)
    assert figure(7).numbers["area"] == pytest.approx((6 - 2 * reach) * (4 - reach), abs=1e-6)


def test_figure_8_has_an_edge_and_a_polygon() -> None:
    area, edge = (part.region for part in figure(8).views.views[0].parts)
    assert edge.contact.total_length == pytest.approx(6.0)
    assert edge.area.is_empty
    assert area.area.measure == pytest.approx(24.0)
    assert area.contact.is_empty


def test_figure_9_what_is_behind_the_wall_counts() -> None:
    sizes = {"a": 3.0 * 4.0, "b": (4.0 - 1.0 - 0.6) * 4.0, "c": 2.0 * 3.0 * 4.0}
    for part, size in sizes.items():
        assert figure(9).numbers[part] == pytest.approx(size, abs=1e-6)


def test_figure_10_the_kernel_is_what_the_steps_leave() -> None:
    cut, found = figure(10).numbers["cut"], figure(10).numbers["kernel"]
    assert cut == pytest.approx(6.0 * 3.0 - 3.0 * 1.0 - 0.25 * math.pi, abs=1e-4)
    assert 0.0 < cut - found < 0.005
    goal, core = figure(10).region(2, "$T'_2$").area, figure(10).region(1, "$S'$").area
    assert areas.difference(goal, core).measure < 1e-4


# --- 11 to 15 ---------------------------------------------------------------------------------

LENGTHS = {
    11: {"sticking": 5, "kernel": 1},
    12: {"sticking": 2, "kernel": 3},
    13: {"sticking": 3},
    14: {"sticking": 0, "kernel": 2},
    15: {"sticking": 5, "kernel": 3, "combined": 2},
}


def _edges_at(space: ConfigurationSpace, point: tuple[float, float]) -> list[int]:
    """The edge that starts at a point."""
    return np.flatnonzero(np.all(space.contact.points == point, axis=1)).tolist()


@pytest.mark.parametrize("number", LENGTHS)
def test_figures_11_to_15_have_as_many_motions_as_the_paper_says(number: int) -> None:
    assert figure(number).numbers == LENGTHS[number]
    drawn = [len(view.lines) for view in figure(number).views.views]
    assert drawn == [length for length in LENGTHS[number].values() if length]


@pytest.mark.parametrize("number", LENGTHS)
def test_figures_11_to_15_ways_begin_at_the_start_and_end_in_the_goal(number: int) -> None:
    for view in figure(number).views.views:
        assert view.space is not None
        start, goal = start_region(view.task, view.space), goal_region(view.task, view.space)
        assert tuple(view.lines[0].points[0]) == start.point
        for first, second in zip(view.lines, view.lines[1:], strict=False):
            assert first.points[-1] == pytest.approx(second.points[0])
        end = tuple(view.lines[-1].points[-1].tolist())
        contact = view.space.contact
        gaps = [
            float(np.hypot(*(contact.at(goal.contact.edge, at) - end).T).min())
            for at in np.linspace(goal.contact.low, goal.contact.high, 2001)
        ]
        assert goal.area.contains(*end) or min(gaps) < 0.01


def test_figure_11_the_motions_stick_in_what_is_drawn() -> None:
    parts = figure(11).views.views[0].parts
    assert len(parts) == 5
    assert all(part.region.area.is_empty and part.layer is Layer.TARGET for part in parts)


def test_figure_12_the_two_regions_on_the_way_do_not_hold_the_start() -> None:
    view = figure(12).views.views[1]
    assert view.space is not None
    start = start_region(view.task, view.space)
    assert len(view.parts) == 2
    assert not any(covered(start, part.region, view.space) for part in view.parts)
    strategy = by_method("example-2", Method.KERNEL)
    assert covered(start, strategy.region(strategy.steps[0]).region, view.space)
    # of the face, 4.5 long, P_1 has the lower half, and the next motion aims at 2 rho less
    last, middle = (strategy.region(strategy.steps[place]) for place in (2, 1))
    assert middle.motion is not None
    (face,) = set(last.region.contact.edge) & set(_edges_at(view.space, (1.5, 4.5)))
    lengths = [
        float((part.high - part.low)[part.edge == face].sum())
        for part in (last.region.contact, middle.motion.target.contact)
    ]
    assert 0.4 * 4.5 < lengths[0] < 0.5 * 4.5
    assert lengths[1] == pytest.approx(lengths[0] - 2 * 0.3, abs=1e-6)


def test_figure_14_has_no_strategy_by_sticking() -> None:
    assert by_method("example-4", Method.STICKING).status is Status.UNSOLVABLE


def test_figure_15_the_last_motion_aims_at_more_than_readings_tell() -> None:
    strategy = by_method("example-5", Method.COMBINED)
    trace = trace_of(strategy, ("exact", "true"), options=RunOptions(runs=1))
    first, second = (strategy.region(number).motion for number in strategy.steps)
    assert first is not None
    assert second is not None
    assert not first.target.area.is_empty
    assert second.target.area.is_empty
    assert trace.legs[0].ended_by == "reading"
    setting = Setting.of(strategy.task, strategy.space)
    goal = goal_region(strategy.task, strategy.space)
    told = preimage(setting, goal, DOWN, Method.KERNEL).target.region
    assert told.contact.total_length == pytest.approx(4.0, abs=1e-6)
    assert second.target.contact.total_length == pytest.approx(6.0, abs=1e-6)


# --- 16 to 19 ---------------------------------------------------------------------------------

STATES = {
    16: Termination.INSTANTANEOUS,
    17: Termination.INITIAL_STATE,
    19: Termination.FINAL_STATE,
}


def test_figure_16_moves_in_on_all_sides() -> None:
    numbers, slope = figure(16).numbers, math.tan(math.radians(10.0))
    assert numbers["kernel"] == pytest.approx(6.0 * 2.0, abs=1e-6)
    assert numbers["readings"] == pytest.approx(7.0 * 3.0, abs=1e-6)
    height = 9.0 - 1.0
    exact = 6.0 * 2.0 + height * (6.0 - height * slope)
    assert numbers["preimage"] == pytest.approx(exact, rel=1e-4)


def test_figure_17_the_letters_lie_on_the_border_of_the_kernel() -> None:
    made, points = figure(17), knowledge.points_of_17()
    kernel = made.region(0, knowledge.KERNEL).area
    for name in "ABCDEFGH":
        assert kernel.depth(*points[name]) < 0.02, name
    for first, second in (("P", "P'"), ("Q", "Q'")):
        assert math.dist(points[first], points[second]) == pytest.approx(4 * 0.5)
    for name in "PQ":
        assert math.dist(points[name], points["B" if name == "P" else "C"]) == pytest.approx(1.0)
    assert made.numbers["preimage"] > 1.2 * made.numbers["before"]
    assert made.numbers["before"] == figure(16).numbers["preimage"]


def test_figure_18_two_triangles() -> None:
    slope, numbers = math.tan(math.radians(10.0)), figure(18).numbers
    assert numbers["kernel"] == pytest.approx(4.0 - 4 * 0.1, abs=1e-6)
    assert numbers["b"] == pytest.approx((4.0 - 4 * 0.1) ** 2 / (4 * slope), rel=1e-5)
    assert numbers["c"] == pytest.approx(4.0**2 / (4 * slope), rel=1e-5)


def test_figure_19_the_lower_part_of_the_rectangle() -> None:
    made, theta = figure(19), math.radians(10.0)
    level = 2.0 - math.cos(theta)
    height = 9.0 - level
    exact = 8.0 * (level + 2.0) + height * (8.0 - height * math.tan(theta))
    assert 0.99 * exact < made.numbers["preimage"] < 1.001 * exact
    points = knowledge.points_of_19()
    assert math.dist(points["R"], points["R'"]) == pytest.approx(2 * 0.5)
    (behind,) = (part.region.area for part in made.views.views[0].parts if part.layer is Layer.LOST)
    assert behind.measure == made.numbers["behind"] > 0.05
    domain = knowledge.domain(knowledge.RECTANGLE, Termination.FINAL_STATE)
    assert domain is not None
    assert areas.intersection(behind, domain.area).measure < 1e-3
    assert made.numbers["before"] == figure(17).numbers["preimage"]


@pytest.mark.parametrize("number", STATES)
def test_readings_that_end_the_motion_by_their_definition(number: int) -> None:
    setting, goal = knowledge.posed(knowledge.RECTANGLE)
    stops = knowledge.stops(knowledge.RECTANGLE, STATES[number]).area
    domain = knowledge.domain(knowledge.RECTANGLE, STATES[number])
    rho = setting.uncertainty.position
    held = setting.space.free if domain is None else domain.area
    good, bad = areas.intersection(held, goal.area), areas.difference(held, goal.area)
    agreed = 0
    for q in np.random.default_rng(number).uniform((-5, -3), (5, 3), (2000, 2)):
        if stops.depth(*q) < 0.01:
            continue  # arcs are tangents
        told = good.distance(*q) < rho <= bad.distance(*q)
        assert stops.contains(*q) == told
        agreed += told
    assert agreed > 300


def test_a_smaller_window_changes_nothing_but_what_is_seen() -> None:
    task, whole = seen("figure-7", (-8.0, -5.0, 8.0, 9.0)), named_task("figure-7")
    assert task.goal == whole.goal
    assert task.uncertainty == whole.uncertainty
    assert task.workspace.obstacles == whole.workspace.obstacles


# --- 20 ---------------------------------------------------------------------------------------


def test_figure_20_from_anywhere_and_each_flank_in_its_preimage() -> None:
    made = figure(20)
    assert made.numbers["area"] == pytest.approx(made.numbers["free"], rel=1e-9)
    assert made.numbers["regions"] == 4
    for place, side in ((1, -1.0), (2, 1.0)):
        view = made.views.views[place]
        assert view.space is not None
        region = made.region(place, rf"$\mathcal{{P}}_{{{place}}}$")
        contact, part = view.space.contact, region.contact
        middles = contact.at(part.edge, 0.5 * (part.low + part.high))
        on_flank = middles[:, 1] < -0.1
        lengths = (part.high - part.low)[on_flank & (side * middles[:, 0] > 2.0)]
        assert lengths.sum() == pytest.approx(math.hypot(6.0, 2.0), rel=1e-6)
        assert math.cos(view.direction or 0.0) * side < 0.0
