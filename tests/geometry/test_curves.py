import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from preimage.errors import InputError
from preimage.geometry.curves import Arc, Bezier, Curve, Floats, Hand, beside
from preimage.geometry.outlines import Errs, Fill, cut_open, filled, without_holes

ROUNDING = 1e-9

near = st.integers(-8, 8).map(float)
points = st.tuples(near, near)
tolerances = st.sampled_from([0.5, 0.1, 0.01])


@st.composite
def beziers(draw: st.DrawFn) -> Bezier:
    return Bezier(np.array(draw(st.lists(points, min_size=2, max_size=5)), dtype=np.float64))


@st.composite
def arcs(draw: st.DrawFn) -> Arc:
    u, v = np.array(draw(points)), np.array(draw(points))
    assume(abs(u[0] * v[1] - u[1] * v[0]) > 0.5)
    begin = draw(st.floats(-7, 7))
    sweep = draw(st.floats(0.01, math.tau)) * draw(st.sampled_from([1, -1]))
    return Arc(np.array(draw(points)), u, v, begin, sweep)


def sampled(curve: Curve, count: int = 400) -> Floats:
    return curve.at(np.linspace(0.0, 1.0, count))


@given(beziers() | arcs(), tolerances, st.sampled_from(Hand))
def test_a_polyline_stays_within_the_tolerance_of_the_curve(
    curve: Curve, tolerance: float, hand: Hand
) -> None:
    points, off = beside([curve], hand, tolerance)
    assert off <= tolerance + ROUNDING
    true = shapely.LineString(sampled(curve))
    if len(points) < 2:
        assert true.length <= ROUNDING
        return
    line = shapely.LineString(points)
    sag = true.length / 100
    assert shapely.hausdorff_distance(true, line) <= off + sag
    np.testing.assert_allclose(points[[0, -1]], [curve.start, curve.end], atol=ROUNDING)


@given(beziers() | arcs(), tolerances)
def test_the_curve_lies_between_its_left_and_its_right(curve: Curve, tolerance: float) -> None:
    # Between the two polylines, winding numbers of the loop right - left are never negative, and
    # whatever is off the curve on the right of it is never wound around by right - curve.
    for hand in Hand:
        points = beside([curve], hand, tolerance).points
        loop = np.concatenate((points, sampled(curve, 2000)[::-1]))
        spots = np.random.default_rng(1).uniform(-16, 16, (60, 2))
        sag = 1e-2
        apart = shapely.distance(shapely.LineString(loop), shapely.points(spots))
        for spot in spots[apart > sag]:
            turns = winding(loop, spot) * hand.value
            assert turns in (0, -1)


def winding(loop: Floats, spot: Floats) -> int:
    angles = np.unwrap(np.arctan2(*(np.vstack((loop, loop[:1])) - spot).T[::-1]))
    return round(float(angles[-1] - angles[0]) / math.tau)


@st.composite
def blobs(draw: st.DrawFn) -> list[Curve]:
    """A closed border around the origin, of lines, bulges and Bézier curves, star-shaped or not."""
    count = draw(st.integers(3, 7))
    radii = draw(st.lists(st.floats(2, 6), min_size=count, max_size=count))
    corners = [
        (r * math.cos(math.tau * k / count), r * math.sin(math.tau * k / count))
        for k, r in enumerate(radii)
    ]
    border: list[Curve] = []
    for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
        kind = draw(st.integers(0, 2))
        if kind == 0:
            border.append(Bezier.segment(a, b))
        elif kind == 1:
            bulge = draw(st.floats(0.05, 0.5)) * draw(st.sampled_from([1, -1]))
            border.append(Arc.bulged(a, b, bulge))
        else:
            moves = draw(
                st.lists(st.tuples(st.floats(-1, 1), st.floats(-1, 1)), min_size=2, max_size=2)
            )
            third = (np.array(b) - np.array(a)) / 3
            inner = [np.array(a) + third + moves[0], np.array(b) - third + moves[1]]
            border.append(Bezier(np.array([a, *inner, b])))
    if draw(st.booleans()):
        border = [curve.reverse() for curve in reversed(border)]
    return border


@given(blobs(), tolerances)
def test_outer_areas_hold_the_true_ones_and_inner_areas_lie_in_them(
    border: list[Curve], tolerance: float
) -> None:
    true = shapely.Polygon(np.concatenate([sampled(curve, 800)[:-1] for curve in border]))
    assume(true.is_valid)
    sag = 1e-3
    for errs in Errs:
        try:
            area, off = filled([border], Fill.EVEN_ODD, errs, tolerance)
        except InputError:
            assume(False)
        assert area.geometry.is_valid
        assert off <= tolerance + ROUNDING
        inside, outside = (area.geometry, true) if errs is Errs.INNER else (true, area.geometry)
        assert shapely.difference(inside, shapely.buffer(outside, sag)).is_empty
        # and not by the sampling alone: no sampled point of the border is on the wrong side
        spots = shapely.points(np.concatenate([sampled(curve, 200) for curve in border]))
        if errs is Errs.OUTER:
            assert shapely.distance(area.geometry, spots).max() <= ROUNDING
        else:
            within = shapely.contains(area.geometry, spots)
            depth = shapely.distance(area.geometry.boundary, spots[within])
            assert depth.max(initial=0.0) <= ROUNDING
        edge = shapely.LineString(true.exterior.coords)
        assert shapely.hausdorff_distance(area.geometry.boundary, edge) <= off + 0.1


def test_a_circle_is_circumscribed_and_inscribed() -> None:
    for tolerance in (0.3, 0.01, 1e-4):
        for radius in (0.1, 1.0, 50.0):
            circle = [Arc.circle((3, -2), radius)]
            outer, off = filled([circle], Fill.EVEN_ODD, Errs.OUTER, tolerance)
            n = outer.corners
            assert outer.measure == pytest.approx(n * radius**2 * math.tan(math.pi / n))
            inner, _ = filled([circle], Fill.EVEN_ODD, Errs.INNER, tolerance)
            assert inner.corners == n
            assert inner.measure == pytest.approx(n / 2 * radius**2 * math.sin(math.tau / n))
            assert off == pytest.approx(radius * (1 / math.cos(math.pi / n) - 1))
            assert off <= tolerance


@given(points, points, st.floats(-3, 3).filter(lambda bulge: abs(bulge) > 0.01))
def test_a_bulge_is_the_tangent_of_a_quarter_of_the_angle(
    a: tuple[float, float], b: tuple[float, float], bulge: float
) -> None:
    assume(a != b)
    arc = Arc.bulged(a, b, bulge)
    np.testing.assert_allclose(arc.start, a, atol=1e-9)
    np.testing.assert_allclose(arc.end, b, atol=1e-9)
    half = math.dist(a, b) / 2
    middle = arc.at(np.array([0.5]))[0]
    right = np.array([b[1] - a[1], a[0] - b[0]]) / (2 * half)
    np.testing.assert_allclose(middle, (np.array(a) + b) / 2 + bulge * half * right, atol=1e-9)


def test_straight_borders_stay_as_they_are() -> None:
    corners = [(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 3.0)]
    border = [
        Bezier.segment(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)
    ]
    for errs in Errs:
        area, off = filled([border], Fill.EVEN_ODD, errs, 0.1)
        assert area.rings[0].tolist() == [list(corner) for corner in corners]
        assert off == 0.0


def ring(radius: float, way: int = 1) -> list[Curve]:
    return [Arc.circle((0, 0), radius, 0.0, way * math.tau)]


@pytest.mark.parametrize(
    ("fill", "ways", "measure"),
    [
        (Fill.EVEN_ODD, (1, 1, 1), 9 - 4 + 1),
        (Fill.EVEN_ODD, (1, -1, 1), 9 - 4 + 1),
        (Fill.NONZERO, (1, 1, 1), 9),
        (Fill.NONZERO, (1, -1, 1), 9 - 4 + 1),
        (Fill.NONZERO, (1, -1, -1), 9 - 4 + 1),
        (Fill.NONZERO, (-1, -1, 1), 9),
    ],
)
def test_nested_outlines_fill_by_the_rule(
    fill: Fill, ways: tuple[int, int, int], measure: float
) -> None:
    outlines = [ring(radius, way) for radius, way in zip((3, 2, 1), ways, strict=True)]
    small = filled(outlines, fill, Errs.INNER, 1e-3).area.measure
    large = filled(outlines, fill, Errs.OUTER, 1e-3).area.measure
    assert small < measure * math.pi < large < small + 0.1


def test_of_two_outlines_that_are_the_same_one_counts() -> None:
    twice = filled([ring(1), ring(1)], Fill.EVEN_ODD, Errs.OUTER, 1e-2)
    assert twice.area.measure >= math.pi


def bowtie() -> list[Curve]:
    corners = [(0, 0), (2, 2), (2, 0), (0, 2)]
    return [Bezier.segment(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]


@pytest.mark.parametrize(
    ("outlines", "rule"),
    [
        ([bowtie()], "crosses itself: edges 0 and 2 cross"),
        ([ring(1), [Arc.circle((1, 0), 1)]], "cross"),
        ([[Bezier.segment((0, 0), (1, 0)), Bezier.segment((1, 0), (0, 0))]], "encloses nothing"),
        ([[Arc.circle((0, 0), 0.0)]], "encloses nothing"),
    ],
)
def test_outlines_that_bound_nothing_are_refused(outlines: list[list[Curve]], rule: str) -> None:
    with pytest.raises(InputError, match=rule):
        filled(outlines, Fill.EVEN_ODD, Errs.OUTER, 0.01)


def test_too_fine_a_tolerance_is_refused() -> None:
    with pytest.raises(InputError, match="takes more than 100000 edges"):
        beside([Arc.circle((0, 0), 1e6)], Hand.LEFT, 1e-9)


def test_a_cusp_and_a_loop_come_to_an_end() -> None:
    cusp = Bezier(np.array([[0, 0], [4, 4], [0, 4], [4, 0]], dtype=float))
    back = Bezier(np.array([[0, 0], [3, 0], [-1, 0]], dtype=float))
    for curve in (cusp, back):
        for hand in Hand:
            assert len(beside([curve], hand, 0.01).points) < 500


@given(st.lists(st.tuples(near, near, st.integers(1, 3)), min_size=1, max_size=4))
def test_areas_with_holes_are_cut_into_simple_polygons(
    holes: list[tuple[float, float, int]],
) -> None:
    from preimage.geometry import area as areas
    from preimage.geometry.area import Area

    whole = Area.box(-12, -12, 12, 12)
    for x, y, r in holes:
        whole = areas.difference(whole, Area.box(x - r, y - r, x + r, y + r))
    pieces = cut_open(whole)
    assert all(shapely.Polygon(piece).is_valid for piece in pieces)
    assert sum(shapely.Polygon(piece).area for piece in pieces) == pytest.approx(whole.measure)
    together = shapely.union_all([shapely.Polygon(piece) for piece in pieces])
    assert shapely.symmetric_difference(together, whole.geometry).area <= 1e-6
    assert without_holes(whole).measure >= whole.measure
