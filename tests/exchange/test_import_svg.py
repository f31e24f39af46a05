import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import svgelements  # type: ignore[import-untyped]
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from preimage.errors import InputError
from preimage.exchange.importing import Imported, import_task
from preimage.exchange.svg_path import courses, matrix_of
from preimage.task.goal import Goal
from preimage.task.initial import Everywhere, InitialDisc, InitialPoint

GOAL = Goal(polygons=(((-990, -990), (-980, -990), (-980, -980)),))
WINDOW = (-1000.0, -1000.0, 1000.0, 1000.0)
NAMES = (
    'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
)


def write(folder: Path, inside: str, head: str = 'viewBox="0 0 100 50"') -> Path:
    path = folder / "drawing.svg"
    path.write_text(f'<?xml version="1.0"?>\n<svg {NAMES} {head}>{inside}</svg>')
    return path


def read(path: Path, **options: Any) -> Imported:
    given = {"initial": Everywhere(), "goal": GOAL, "window": WINDOW, **options}
    return import_task(path, **given)


def solids(found: Imported) -> shapely.Geometry:
    return shapely.union_all(
        [shapely.Polygon(one.exterior, one.holes) for one in found.task.workspace.obstacles]  # type: ignore[union-attr]
    )


# --- path data: svgelements is the oracle --------------------------------------------------

numbers = st.integers(-9, 9)
steps = st.one_of(
    st.tuples(st.sampled_from("LlTtMm"), st.tuples(numbers, numbers)),
    st.tuples(st.sampled_from("HhVv"), st.tuples(numbers)),
    st.tuples(st.sampled_from("QqSs"), st.tuples(*[numbers] * 4)),
    st.tuples(st.sampled_from("Cc"), st.tuples(*[numbers] * 6)),
    st.tuples(
        st.sampled_from("Aa"),
        st.tuples(
            st.integers(1, 9), st.integers(1, 9), numbers, st.integers(0, 1), st.integers(0, 1),
            numbers, numbers,
        ),
    ),
    st.just(("z", ())),
)  # fmt: skip


@settings(max_examples=200)
@given(st.lists(steps, min_size=1, max_size=6))
def test_path_data_means_what_another_reader_says(path: list[tuple[str, tuple[int, ...]]]) -> None:
    # after a curve of the other degree it mirrors a handle, which the standard does not
    words = "".join(word.upper() for word, _ in path)
    assume(not re.search("[QT]S|[CS]T", words))
    data = "M 1 2" + "".join(f"{word}{' '.join(map(str, values))}" for word, values in path)
    ours = [curve for course in courses(data) for curve in course.curves]
    theirs = [
        segment
        for segment in svgelements.Path(data)
        if not isinstance(segment, svgelements.Move) and segment.length(error=1e-3) > 1e-12
    ]
    ours = [curve for curve in ours if np.ptp(curve.hull, axis=0).max() > 0]
    assert len(ours) == len(theirs)
    for curve, segment in zip(ours, theirs, strict=True):
        for t in (0.0, 0.3, 0.5, 1.0):
            spot = segment.point(t)
            np.testing.assert_allclose(curve.at(np.array([t]))[0], (spot.x, spot.y), atol=1e-6)


@given(
    st.lists(
        st.one_of(
            st.tuples(st.just("translate"), st.tuples(numbers, numbers)),
            st.tuples(st.just("scale"), st.tuples(st.integers(1, 5))),
            st.tuples(st.just("scale"), st.tuples(st.integers(1, 5), st.integers(-5, -1))),
            st.tuples(st.just("rotate"), st.tuples(numbers)),
            st.tuples(st.just("rotate"), st.tuples(numbers, numbers, numbers)),
            st.tuples(st.sampled_from(["skewX", "skewY"]), st.tuples(numbers)),
            st.tuples(st.just("matrix"), st.tuples(*[numbers] * 6)),
        ),
        max_size=4,
    )
)
def test_transforms_mean_what_another_reader_says(
    transforms: list[tuple[str, tuple[int, ...]]],
) -> None:
    text = " ".join(f"{word}({','.join(map(str, values))})" for word, values in transforms)
    matrix, theirs = matrix_of(text), svgelements.Matrix(text)
    expected = [[theirs.a, theirs.c, theirs.e], [theirs.b, theirs.d, theirs.f]]
    np.testing.assert_allclose(matrix, expected, atol=1e-9)


@pytest.mark.parametrize(
    "data",
    [
        "L 1 1",
        "M 1",
        "M 1 1 L 2",
        "M 1 1 X 3",
        "M0 0 1,,2",
        "M 0 0 A 1 1 0 2 0 3 3",
        "M 0 0 L nan 1",
        "M0 0L1 1 foo",
    ],
)
def test_what_is_no_path_data_is_refused(data: str) -> None:
    with pytest.raises(InputError, match="d: "):
        courses(data)


def test_flags_need_no_gap() -> None:
    (close,), (apart,) = courses("M0 0a25 25-30 0150-25"), courses("M0 0 a 25 25 -30 0 1 50 -25")
    np.testing.assert_array_equal(close.curves[0].end, apart.curves[0].end)


# --- drawings ------------------------------------------------------------------------------

SHAPES = [
    '<rect x="10" y="10" width="30" height="20"/>',
    '<rect x="10" y="10" width="30" height="20" rx="4"/>',
    '<rect x="10" y="10" width="30" height="20" rx="40" ry="3"/>',
    '<circle cx="40" cy="20" r="12"/>',
    '<ellipse cx="40" cy="20" rx="12" ry="5"/>',
    '<polygon points="10,10 40,12 20,30"/>',
    '<path d="M10 20 C 10 5 40 5 40 20 S 10 40 10 20 z"/>',
    '<path d="M10 20 Q 25 0 40 20 T 70 20 L 70 40 H 10 Z"/>',
    '<path d="M10 20 A 30 20 30 0 1 50 25 L 30 40 z"/>',
]
TRANSFORMS = ["", "translate(3 4)", "rotate(30)", "scale(2 0.5)", "scale(-1 1) skewX(20)"]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("transform", TRANSFORMS)
def test_shapes_are_enclosed(tmp_path: Path, shape: str, transform: str) -> None:
    inside = f'<g id="obstacles" transform="{transform}">{shape}</g>'
    path = write(tmp_path, inside)
    spots = sampled(path)
    true = shapely.Polygon(spots)
    outer = solids(read(path, curves=0.5))
    assert shapely.distance(outer, shapely.points(spots)).max() <= 1e-4
    assert shapely.difference(true, shapely.buffer(outer, 1e-2)).is_empty
    assert shapely.difference(outer, shapely.buffer(true, 0.51)).is_empty
    goal = write(tmp_path, inside.replace("obstacles", "goal"))
    inner = import_task(goal, initial=Everywhere(), window=WINDOW, curves=0.5).task.goal
    area = shapely.union_all([shapely.Polygon(ring) for ring in inner.polygons])
    within = shapely.contains(area, shapely.points(spots))
    depth = shapely.distance(area.boundary, shapely.points(spots)[within])
    assert depth.max(initial=0.0) <= 1e-4
    assert shapely.difference(true, shapely.buffer(area, 0.51)).is_empty


def sampled(path: Path) -> np.ndarray[Any, Any]:
    """Points of the border of the one shape of a file, by svgelements."""
    (shape,) = (
        one
        for one in svgelements.SVG.parse(path, reify=False).elements()
        if isinstance(one, svgelements.Shape)
    )
    # moved point by point, since it does not skew arcs rightly
    spots = [
        shape.transform.point_in_matrix_space(segment.point(t))
        for segment in svgelements.Path(shape, transform=None).segments(transformed=False)
        if not isinstance(segment, svgelements.Move)
        for t in np.linspace(0, 1, 200)
    ]
    return np.array([(spot.x, 50.0 - spot.y) for spot in spots])


def test_y_is_up_in_the_view_box(tmp_path: Path) -> None:
    path = write(
        tmp_path, '<rect id="wall" x="10" y="-5" width="1" height="2"/>', 'viewBox="0 -10 50 30"'
    )
    assert solids(read(path)).bounds == (10, 13, 11, 15)


@pytest.mark.parametrize(
    ("head", "units", "size"),
    [
        ('width="200mm" height="100mm" viewBox="0 0 200 100"', "m", 0.03),
        ('width="200mm" height="100mm" viewBox="0 0 2000 1000"', "mm", 3.0),
        ('width="10in" height="5in" viewBox="0 0 100 50"', "cm", 7.62),
        ('width="200" height="100" viewBox="0 0 200 100"', None, 30.0),
    ],
)
def test_units_are_those_of_the_page(
    tmp_path: Path, head: str, units: str | None, size: float
) -> None:
    path = write(tmp_path, '<rect class="obstacle" width="30" height="30"/>', head)
    goal = Goal(polygons=(((-3 * size, 0), (-2 * size, 0), (-2 * size, size)),))
    found = read(path, units=units, goal=goal, window=(-9 * size, -9 * size, 9 * size, 9 * size))
    xmin, ymin, xmax, ymax = solids(found).bounds
    assert (xmax - xmin, ymax - ymin) == pytest.approx((size, size))


def test_layers_ids_and_classes_name_what_is_drawn(tmp_path: Path) -> None:
    inside = """
    <g inkscape:label="Obstacles" id="layer1">
      <path d="M0,40 H40 V45 H60 V40 H100 V50 H0 Z"/>
      <text>notes</text>
    </g>
    <line class="bold goal" x1="40" y1="45" x2="60" y2="45"/>
    <circle id="start-1" cx="50" cy="20" r="2"/>
    <rect inkscape:label="window" width="100" height="50"/>
    <rect id="decoration" width="1" height="1"/>
    <defs><rect id="robot" width="1" height="1"/></defs>
    <g id="robot" style="display:none"><rect width="1" height="1"/></g>
    """
    found = import_task(write(tmp_path, inside))
    task = found.task
    assert (task.goal, task.initial) == (
        Goal(edges=(((40.0, 5.0), (60.0, 5.0)),)),
        InitialDisc((50.0, 30.0), 2.0),
    )
    assert task.workspace.window.bounds == (0.0, 0.0, 100.0, 50.0)
    assert task.robot.is_point
    assert (
        found.notes[-1]
        == "left out: 1 g that cannot be seen, 1 rect without a role, 1 text in Obstacles"
    )


def test_a_robot_stands_where_it_is_drawn(tmp_path: Path) -> None:
    inside = """
    <rect id="wall" y="40" width="100" height="10"/>
    <g id="robot"><path d="m 48 10 h 4 v 4 h -4 z"/></g>
    <path id="goal" d="M 10 38 H 20"/>
    """
    task = import_task(write(tmp_path, inside)).task
    assert task.initial == InitialPoint((50.0, 38.0))
    assert sorted(task.robot.shape) == [(-2, -2), (-2, 2), (2, -2), (2, 2)]
    assert task.goal.edges == (((10.0, 12.0), (20.0, 12.0)),)


def test_open_paths_that_are_filled_are_closed(tmp_path: Path) -> None:
    triangle = '<path id="obstacle" d="M 0 0 L 10 0 L 0 10"{}/>'
    assert solids(read(write(tmp_path, triangle.format("")))).area == 50
    with pytest.raises(InputError, match="obstacle, path obstacle: is open"):
        read(write(tmp_path, triangle.format(' fill="none"')))
    styled = "<style>path {fill: none}</style>" + triangle.format("")
    with pytest.raises(InputError, match="is open: close it, or say fill by an attribute"):
        read(write(tmp_path, styled))


@pytest.mark.parametrize(("rule", "area"), [("nonzero", 100), ("evenodd", 100 - 36)])
def test_holes_are_those_of_the_fill_rule(tmp_path: Path, rule: str, area: float) -> None:
    data = "M0 0h10v10h-10z M2 2h6v6h-6z"
    path = write(tmp_path, f'<path id="obstacle" d="{data}" style="fill-rule:{rule}"/>')
    assert solids(read(path)).area == area


def test_clones_are_followed(tmp_path: Path) -> None:
    inside = """
    <defs><rect id="block" width="10" height="10"/></defs>
    <g id="obstacles"><use href="#block" x="20"/>
    <use xlink:href="#block" transform="translate(40 0) scale(2)"/></g>
    """
    found = solids(read(write(tmp_path, inside)))
    assert found.equals(
        shapely.MultiPolygon([shapely.box(20, 40, 30, 50), shapely.box(40, 30, 60, 50)])
    )


DANGEROUS = [
    ('<!DOCTYPE svg [<!ENTITY a "aaaa">]><svg>&a;</svg>', "must not declare entities"),
    (
        '<!DOCTYPE svg [<!ENTITY a "aa"><!ENTITY b "&a;&a;&a;&a;">]><svg>&b;</svg>',
        "must not declare entities",
    ),
    ('<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]><svg>&x;</svg>', "must not declare"),
    ("<svg>" + "<g>" * 200 + "</g>" * 200 + "</svg>", "must be nested 100 deep or less"),
    ("<svg>" + "<g/>" * 100_001 + "</svg>", "must have 100000 elements or fewer"),
    ("<svg><g></svg>", "is no XML at line 1, column 11: mismatched tag"),
    ("", "is no XML at line 1, column 1: no element found"),
    ("<html/>", "is no SVG: its root is 'html'"),
    ('<?xml version="1.0" encoding="klingon"?><svg/>', "is no XML"),
]


@pytest.mark.parametrize(("text", "rule"), DANGEROUS)
def test_dangerous_xml_is_refused(tmp_path: Path, text: str, rule: str) -> None:
    path = tmp_path / "drawing.svg"
    path.write_text(text)
    with pytest.raises(InputError, match=rule):
        read(path)


def test_a_doctype_alone_is_no_danger(tmp_path: Path) -> None:
    path = write(tmp_path, '<rect id="wall" width="1" height="1"/>')
    doctype = '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/svg11.dtd">'
    path.write_text(path.read_text().replace("?>\n", f"?>\n{doctype}\n"))
    assert solids(read(path)).area == 1


@pytest.mark.slow
def test_a_bomb_of_clones_is_refused(tmp_path: Path) -> None:
    groups = '<rect id="g0" width="1" height="1"/>' + "".join(
        f'<g id="g{k}">' + f'<use href="#g{k - 1}"/>' * 10 + "</g>" for k in range(1, 9)
    )
    with pytest.raises(InputError, match="must have 100000 elements or fewer, and 100 levels"):
        read(write(tmp_path, f'<defs>{groups}</defs><use id="obstacle" href="#g8"/>'))


REFUSED = [
    ('<rect id="wall" width="10%" height="1"/>', "wall, rect wall.width: must be a length"),
    ('<rect id="wall" width="-1" height="1"/>', "wall, rect wall.width: must be 0 or more"),
    ('<rect id="wall" width="nan" height="1"/>', "must be a length in user units"),
    ('<rect id="wall" width="1e999" height="1"/>', "wall, rect wall.width: must be a length"),
    ('<path id="wall" d="M 0 0 L 1e999 0 L 0 1 z"/>', "coordinates must be finite"),
    ('<circle id="wall" r="-3"/>', "wall, circle wall.r: must be 0 or more, not -3"),
    ('<circle id="wall" r="0"/>', "is a point|encloses nothing|one point"),
    ('<g id="wall" clip-path="url(#a)"><rect width="1" height="1"/></g>', "has a clip-path"),
    ('<rect id="wall" width="9" height="9" mask="url(#a)"/>', "has a mask: cut it first"),
    ('<rect id="wall" width="9" height="9" style="transform:scale(2)"/>', "is moved by CSS"),
    ('<rect id="wall" width="9" height="9" transform="warp(2)"/>', "wall.transform: is none at"),
    ('<rect id="wall" width="9" height="9" transform="rotate(1e999)"/>', "is too large"),
    ('<rect id="wall" width="9" height="9" x:y="1"/>', "is no XML: unbound prefix"),
    ('<use id="wall" href="other.svg#x"/>', "must refer to an element of this file"),
    ('<use id="wall" href="#wall"/>', "clones must be 16 deep or less"),
    ('<svg id="wall"/>', "is an SVG inside another one"),
    ('<style>#wall {display: none}</style><rect id="wall"/>', "style: rules of CSS that move"),
    ('<polygon id="wall" points="1,2,3"/>', "wall, polygon wall.points: must be pairs"),
    ('<path id="wall" d="M0 0 L 2 2 L 2 0 L 0 2 z"/>', "wall, path wall: .* crosses itself"),
    ('<rect id="nothing" width="3" height="3"/>', "no label, id or class has a role"),
]


@pytest.mark.parametrize(("inside", "rule"), REFUSED)
def test_drawings_are_refused_by_place(tmp_path: Path, inside: str, rule: str) -> None:
    with pytest.raises(InputError, match=rule):
        read(write(tmp_path, inside))


@pytest.mark.parametrize("head", ['viewBox="0 0 0 5"', 'viewBox="1 2 3"', 'viewBox="a b c d"'])
def test_a_view_box_must_be_one(tmp_path: Path, head: str) -> None:
    with pytest.raises(InputError, match=r"viewBox|points"):
        read(write(tmp_path, '<rect id="wall" width="3" height="3"/>', head))
