"""C-obstacles: chains, robots, what is clipped and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from preimage.configuration.components import components
from preimage.configuration.obstacles import configuration_space, polygon_of_chain
from preimage.errors import TaskError
from preimage.task.robot import Robot
from preimage.task.workspace import ChainObstacle, PolygonObstacle, Side, SolidSide
from tests.configuration import spaces
from tests.configuration.spaces import WINDOW, box, obstacle, task_of

LEFT, RIGHT = SolidSide.LEFT, SolidSide.RIGHT


@st.composite
def mountains(draw: st.DrawFn) -> list[tuple[float, float]]:
    """A chain across the window, from left to right."""
    count = draw(st.integers(2, 6))
    heights = draw(st.lists(st.floats(1.0, 7.0), min_size=count, max_size=count))
    return [(8.0 * k / (count - 1), height) for k, height in enumerate(heights)]


@given(mountains(), st.booleans(), st.sampled_from(list(SolidSide)))
def test_chains_are_the_polygons_that_they_are_in_the_window(
    chain: list[tuple[float, float]], back: bool, solid: SolidSide
) -> None:
    below = (solid is RIGHT) != back
    side = -1.0 if below else 9.0
    polygon = shapely.Polygon([*chain, (8.0, side), (0.0, side)])
    points = tuple(reversed(chain)) if back else tuple(chain)
    found = configuration_space(task_of([ChainObstacle(points, solid)]))
    expected = shapely.box(*WINDOW) - polygon
    assert shapely.symmetric_difference(found.free.geometry, expected).area < 1e-9
    assert found.contact.open.sum() >= 3


@given(
    st.floats(0.0, math.tau),
    st.floats(0.0, 3.0),
    st.floats(0.1, 5.0),
    st.sampled_from(list(SolidSide)),
)
def test_a_chain_of_one_edge_is_a_half_plane(
    angle: float, off: float, length: float, solid: SolidSide
) -> None:
    along = np.array([math.cos(angle), math.sin(angle)])
    left = np.array([-along[1], along[0]])
    start = np.array([4.0, 4.0]) + off * left
    chain = ChainObstacle((tuple(start), tuple(start + length * along)), solid)
    found = polygon_of_chain(chain, WINDOW)
    rng = np.random.default_rng(0)
    for point in rng.uniform(0.0, 8.0, (50, 2)):
        beside = float((point - start) @ left)
        if abs(beside) > 1e-9:
            assert found.contains(*point) == ((beside > 0.0) == (solid is LEFT))


def test_a_wedge_with_both_ends_through_one_side() -> None:
    """Solid between two rays that leave upwards, and everywhere else if turned inside out."""
    chain = ((2.0, 6.0), (4.0, 1.0), (6.0, 6.0))
    inside = configuration_space(task_of([ChainObstacle(chain, LEFT)])).free
    outside = configuration_space(task_of([ChainObstacle(chain, RIGHT)])).free
    wedge = 0.5 * 7 * (2 * 7 * 2 / 5)
    assert outside.measure == pytest.approx(wedge)
    assert inside.measure == pytest.approx(64.0 - wedge)


def test_the_end_vertices_of_a_chain_are_no_vertices() -> None:
    chain = ChainObstacle(((3.0, 2.0), (4.0, 2.0), (4.0, 3.0), (5.0, 3.0)), RIGHT)
    contact = configuration_space(task_of([chain])).contact
    assert len(contact) == 6
    assert np.sort(contact.length[contact.edges]) == pytest.approx([1.0, 4.0, 4.0])


def test_a_chain_beyond_the_window_and_a_far_one() -> None:
    far = ChainObstacle(((-1e6, -1.0), (1e6, -1.0)), RIGHT)
    assert configuration_space(task_of([far])).contact.open.all()
    flush = ChainObstacle(((-1e6, 0.0), (1e6, 0.0)), RIGHT)
    contact = configuration_space(task_of([flush])).contact
    assert contact.length[contact.edges] == pytest.approx([8.0])


# --- robots ---------------------------------------------------------------------------------------


def robots() -> list[Robot]:
    ell = ((0.0, 0.0), (1.5, 0.0), (1.5, 0.5), (0.5, 0.5), (0.5, 1.0), (0.0, 1.0))
    return [
        Robot(((0.0, 0.0), (1.0, 0.0), (0.3, 0.7)), (0.4, 0.2)),
        Robot(ell, (0.0, 0.0)),
        Robot(ell, (5.0, -3.0)),
        Robot(tuple((0.6 * math.cos(k), 0.4 * math.sin(k)) for k in range(6)), (0.0, 0.0)),
    ]


@pytest.mark.parametrize("robot", robots())
@given(scene=st.lists(spaces.shapes, min_size=1, max_size=4), seed=st.integers(0, 1000))
def test_free_iff_the_robot_there_does_not_overlap_the_obstacles(
    robot: Robot, scene: list[shapely.Geometry], seed: int
) -> None:
    try:
        space = configuration_space(task_of([obstacle(shape) for shape in scene], robot=robot))
    except TaskError:
        return
    solid = shapely.union_all(scene, grid_size=2.0**-36)
    shape = shapely.Polygon(robot.shape)
    edge = space.free.geometry.boundary
    for x, y in np.random.default_rng(seed).uniform(0.0, 8.0, (40, 2)):
        if edge.distance(shapely.Point(x, y)) > 1e-7:
            there = shapely.affinity.translate(shape, x, y)
            assert space.free.contains(x, y) == (not there.intersects(solid))


def test_peg_in_hole() -> None:
    """A peg one wide in a hole three wide is a point in a hole two wide (paper, Figure 3)."""
    floor = ChainObstacle(
        ((-2.0, 0.0), (-1.5, 0.0), (-1.5, -3.0), (1.5, -3.0), (1.5, 0.0), (2.0, 0.0)), RIGHT
    )
    peg = Robot(((-0.5, 0.0), (0.5, 0.0), (0.5, 2.0), (-0.5, 2.0)), (0.0, 0.0))
    contact = configuration_space(task_of([floor], (-10, -6, 10, 10), robot=peg)).contact
    where = set(map(tuple, contact.points[contact.vertices].tolist()))
    hole = {(-1.0, 0.0), (-1.0, -3.0), (1.0, -3.0), (1.0, 0.0)}
    assert where == hole | {(-10.0, 0.0), (10.0, 0.0)}
    assert set(contact.points[contact.vertices][contact.concave[contact.vertices]][:, 1]) == {
        -3.0,
        0.0,
    }


def test_a_peg_as_wide_as_the_hole_does_not_go_in() -> None:
    floor = ChainObstacle(((-2, 0), (-0.5, 0), (-0.5, -3), (0.5, -3), (0.5, 0), (2, 0)), RIGHT)
    peg = Robot(((-0.5, 0.0), (0.5, 0.0), (0.5, 2.0), (-0.5, 2.0)), (0.0, 0.0))
    contact = configuration_space(task_of([floor], (-10, -6, 10, 10), robot=peg)).contact
    assert contact.length[contact.edges] == pytest.approx([20.0])


def test_walls_bound_the_reference_point() -> None:
    robot = Robot(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)), (0.0, 0.0))
    space = configuration_space(task_of([box(20, 20)], sides=frozenset(Side), robot=robot))
    assert space.free.bounds == WINDOW
    assert not space.contact.open.any()


def test_an_obstacle_outside_the_window_counts_where_the_robot_reaches_it() -> None:
    robot = Robot(((0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (0.0, 1.0)), (0.0, 0.0))
    space = configuration_space(task_of([box(9, 3)], robot=robot))
    assert space.free.measure == pytest.approx(64.0 - 2.0 * 2.0)


def test_rooms_are_components() -> None:
    room = PolygonObstacle(
        ((1, 1), (7, 1), (7, 7), (1, 7)),
        (((2, 2), (2, 6), (3, 6), (3, 2)), ((4, 4), (4, 6), (6, 6))),
    )
    assert len(components(configuration_space(task_of([room])))) == 3
    pinched = configuration_space(task_of([box(0, 0, 4, 4), box(4, 4, 4, 4)]))
    assert len(components(pinched)) == 2


def test_no_free_space_is_refused() -> None:
    with pytest.raises(TaskError) as refusal:
        configuration_space(task_of([box(-1, -1, 10, 10)]))
    assert refusal.value.key == "obstacles"
