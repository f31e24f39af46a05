"""Growing by a disc: outside the true sum, straight parts exact, arcs within their bound."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.angles import TAU
from preimage.geometry.area import Area
from preimage.geometry.border import border

RADIUS = 0.75
NONE = np.empty((0, 2))

angles = st.floats(-10.0, 10.0)
bounds = st.sampled_from([0.1, 0.02, 0.005, 1e-4])
fine = st.integers(-(10**9), 10**9).map((2e-9).__mul__)
coordinates = st.one_of(st.integers(-5, 5).map(float), fine)
points = st.tuples(coordinates, coordinates)
segments = st.lists(st.tuples(points, points), min_size=1, max_size=5)


def distances_from(area: Area, shape: shapely.Geometry) -> np.ndarray:
    """Of the vertices of an area's border, and of points along it, from a shape."""
    border_points = shapely.get_coordinates(shapely.segmentize(area.geometry, 0.05))
    return np.asarray(shapely.distance(shapely.points(border_points), shape))


def sectors_of(area: Area, radius: float) -> Area:
    """The area grown, from its pieces."""
    pieces = inflate.outward_pieces(*border(area), radius, inflate.tangent_normals(0.005))
    return Area.of(shapely.union_all([area.geometry, *pieces]))


ELL = Area.polygon(np.array([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], dtype=float))
RING = areas.difference(Area.box(-2, -2, 2, 2), Area.box(-1, -1, 1, 1))
SLANTED = Area.polygon(np.array([(0.1, 0.2), (2.3, 1.7), (0.4, 2.9)]))
TWO = areas.union(Area.box(0, 0, 1, 1), Area.box(1.5, 0.25, 2.5, 2))
SHAPES = {"ell": ELL, "ring": RING, "slanted": SLANTED, "two": TWO}


@given(st.lists(angles, max_size=3), bounds)
def test_tangents_follow_the_circle(touch: list[float], bound: float) -> None:
    normals = inflate.tangent_normals(bound, tuple(touch))
    assert np.all((normals >= 0.0) & (normals < TAU))
    gaps = np.diff(np.append(normals, normals[0] + TAU))
    assert np.all(gaps > 0.0)
    assert np.all(1.0 / np.cos(gaps / 2) <= 1.0 + bound + 1e-12)
    for ray in touch:
        for normal in (ray + math.pi / 2, ray - math.pi / 2):
            assert np.min(np.abs(np.sin((normals - normal) / 2))) < 1e-14


def test_without_rays_axes_are_touched() -> None:
    normals = inflate.tangent_normals(0.005)
    for quarter in range(4):
        assert np.min(np.abs(normals - quarter * math.pi / 2)) < 1e-15


@given(segments, bounds, angles)
def test_stadiums(
    pairs: list[tuple[tuple[float, float], tuple[float, float]]], bound: float, ray: float
) -> None:
    starts = np.array([pair[0] for pair in pairs])
    ends = np.array([pair[1] for pair in pairs])
    grown = inflate.outer_stadiums(starts, ends, RADIUS, bound, (ray,))
    lines = shapely.multilinestrings(list(shapely.linestrings(np.stack((starts, ends), axis=1))))
    off = distances_from(grown, lines)
    assert np.min(off) >= RADIUS - 1e-12
    assert np.max(off) <= RADIUS * (1.0 + bound) + 1e-12
    assert shapely.contains_properly(grown.geometry, lines)


def test_straight_parts_are_exact() -> None:
    start, end = np.array([[0.3, 0.1]]), np.array([[4.1, 2.7]])
    grown = inflate.outer_stadiums(start, end, RADIUS)
    along = (end - start)[0] / np.hypot(*(end - start)[0])
    left = np.array([-along[1], along[0]])
    off = (shapely.get_coordinates(grown.geometry) - start[0]) @ left
    assert np.max(off) == pytest.approx(RADIUS, abs=1e-14)
    assert np.min(off) == pytest.approx(-RADIUS, abs=1e-14)


@given(angles)
def test_rays_touch_the_polyline_where_they_touch_the_arc(ray: float) -> None:
    origin = np.zeros((1, 2))
    corners = shapely.get_coordinates(
        inflate.outer_stadiums(origin, origin, RADIUS, 0.02, (ray,)).geometry
    )
    across = corners @ (-math.sin(ray), math.cos(ray))
    assert np.max(across) == pytest.approx(RADIUS, abs=1e-10)
    assert np.min(across) == pytest.approx(-RADIUS, abs=1e-10)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("radius", [0.1, 0.5, 3.0])
def test_grow(name: str, radius: float) -> None:
    shape = SHAPES[name]
    grown = inflate.grow(shape, radius, 0.005, (0.3,))
    off = distances_from(grown, shape.geometry)
    assert np.min(off) >= radius - 1e-12
    assert np.max(off) <= radius * 1.005 + 1e-12
    fine = shapely.buffer(shape.geometry, radius, quad_segs=200)
    assert shapely.difference(fine, grown.geometry).area < 1e-9


@pytest.mark.parametrize("name", SHAPES)
def test_pieces_need_not_know_the_whole_border(name: str) -> None:
    """Each edge and vertex brings its own; the area's other side does not matter."""
    points, following = border(SHAPES[name])
    normals = inflate.tangent_normals(0.005)
    pieces = []
    chosen = np.arange(len(points)) % 2 == 0
    for half in (chosen, ~chosen):
        sides, wedges = inflate.rectangle_pieces(points, following, 0.5, half)
        pieces += [*sides, *inflate.sector_pieces(wedges, 0.5, normals)]
    whole = shapely.union_all(inflate.outward_pieces(points, following, 0.5, normals))
    assert shapely.symmetric_difference(shapely.union_all(pieces), whole).area < 1e-12


def test_convex_corners_of_what_is_left_are_exact() -> None:
    """A box inside its complement: four rectangles, no arc (theory 5, Figure 16)."""
    window, goal = Area.box(-10, -10, 10, 10), Area.box(-3, -2, 4, 5)
    rest = areas.difference(window, goal)
    pieces = inflate.outward_pieces(*border(rest), 1.0, inflate.tangent_normals(0.005))
    left = inflate.shrunk_by(goal, pieces)
    assert shapely.symmetric_difference(left.geometry, shapely.box(-2, -1, 3, 4)).area < 1e-12


def test_depth_hides_a_border_that_is_slightly_off() -> None:
    window, goal = Area.box(-10, -10, 10, 10), Area.box(-3, -2, 4, 5)
    rest = areas.difference(window, Area.box(-3 + 1e-11, -2, 4, 5 - 1e-11))
    pieces, _ = inflate.rectangle_pieces(*border(rest), 1.0, depth=1e-9)
    left = inflate.without_slivers(inflate.shrunk_by(goal, pieces), 1e-9)
    assert len(left.parts) == 1
    assert left.bounds == pytest.approx((-2, -1, 3, 4), abs=1e-10)


def test_nothing_grows_by_nothing() -> None:
    normals = inflate.tangent_normals(0.005)
    assert inflate.outer_stadiums(NONE, NONE, 1.0).is_empty
    assert inflate.outer_stadiums(np.zeros((1, 2)), np.ones((1, 2)), 0.0).is_empty
    assert inflate.grow(Area.empty(), 1.0).is_empty
    assert inflate.grow(ELL, 0.0) is ELL
    assert not len(inflate.outward_pieces(*border(ELL), 0.0, normals))
    assert not len(inflate.stadium_pieces(NONE, NONE, 1.0, normals))
    assert inflate.shrunk_by(ELL) is ELL
    far = inflate.stadium_pieces(np.full((1, 2), 50.0), np.full((1, 2), 51.0), 1.0, normals)
    assert inflate.shrunk_by(ELL, far) is ELL
    assert inflate.shrunk_by(Area.empty(), far).is_empty


def test_slivers() -> None:
    thin = Area.box(10, 0, 11, 1e-12)
    both = areas.union(ELL, thin)
    assert inflate.without_slivers(both, 1e-9).measure == pytest.approx(ELL.measure)
    assert inflate.without_slivers(ELL, 1e-9) is ELL
    assert inflate.without_slivers(thin, 1e-9).is_empty
    assert inflate.without_slivers(Area.empty(), 1e-9).is_empty
    comb = Area.box(0, 0, 100, 0.001)
    assert not inflate.without_slivers(comb, 1e-9).is_empty


@given(st.integers(0, 2**32 - 1), st.booleans())
def test_box_pairs(seed: int, lattice: bool) -> None:
    rng = np.random.default_rng(seed)

    def boxes(count: int) -> tuple[np.ndarray, np.ndarray]:
        low = rng.uniform(0, 10, (count, 2))
        size = rng.uniform(0, 3, (count, 2))
        return (np.floor(low), np.floor(low + size)) if lattice else (low, low + size)

    one, other = boxes(30), boxes(40)
    few = inflate.box_pairs(*one, *other)
    tree = inflate.box_pairs(*one, *other, few=0)
    assert [pair.tolist() for pair in few] == [pair.tolist() for pair in tree]


@given(st.integers(3, 200), st.floats(0.0, TAU), bounds, st.sampled_from([1e-6, 1e-3, 0.5, 2.0]))
def test_pieces_of_round_shapes_are_valid(
    count: int, turn: float, bound: float, radius: float
) -> None:
    """Slight turns, and edges whose normals are nearly those of the tangents."""
    normals = inflate.tangent_normals(bound, (turn,))
    angles = turn + np.linspace(0.0, TAU, count, endpoint=False)
    shape = Area.polygon(3.0 * np.stack((np.cos(angles), np.sin(angles)), axis=1))
    pieces = inflate.outward_pieces(*border(shape), radius, normals)
    assert np.all(shapely.is_valid(pieces))
    assert np.all(shapely.is_valid(inflate.stadium_pieces(*shape.segments, radius, normals)))
    grown = Area.of(shapely.union_all([shape.geometry, *pieces]))
    assert len(grown.rings) == 1
    off = distances_from(grown, shape.geometry)
    assert np.min(off) >= radius - 1e-12
    assert np.max(off) <= radius * (1.0 + bound) + 1e-12


@pytest.mark.parametrize("fault", ["loses polygons", "fails"])
def test_what_floating_overlays_lose_is_found(fault: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The middle of a union may be lost without a word, or the union refused: then on a grid."""
    area = Area.box(0, 0, 30, 10)
    starts = np.stack((np.arange(2.0, 30.0, 5.0), np.full(6, 4.0)), axis=1)
    pieces = inflate.stadium_pieces(
        starts, np.add(starts, (1.0, 2.0)), 1.0, inflate.tangent_normals(0.005, ())
    )
    right = inflate.shrunk_by(area, pieces)
    sound = shapely.union_all

    def faulty(shapes: object, grid_size: float | None = None) -> object:
        if grid_size is not None:
            return sound(shapes, grid_size=grid_size)
        if fault == "fails":
            raise shapely.GEOSException("side location conflict")
        return sound(shapes[:2])  # type: ignore[index]

    monkeypatch.setattr(shapely, "union_all", faulty)
    again = inflate.shrunk_by(area, pieces)
    assert again.measure == pytest.approx(right.measure, abs=1e-9)
    assert right.measure < 300 - 6 * np.pi
