"""The shapes of SVG as curves (SVG 1.1, 9)."""

from __future__ import annotations

import xml.etree.ElementTree as Tree
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from preimage.errors import InputError
from preimage.exchange.svg_path import Course, courses, length_of, points_of
from preimage.geometry.curves import Arc, Bezier, Curve, Floats

SIMILAR = 1e-12
"""A circle whose axes differ by less than this part is still one."""


def tag_of(element: Tree.Element) -> str:
    """The name without its namespace; nothing for comments."""
    tag: object = element.tag  # of a comment a function, whatever its stub says
    return tag.rpartition("}")[2] if isinstance(tag, str) else ""


def closed_up(curves: tuple[Curve, ...]) -> tuple[Curve, ...]:
    """Curves that follow each other, and back to where they begin."""
    start, end = curves[0].start, curves[-1].end
    if np.all(start == end):
        return curves
    gap = float(np.hypot(*(end - start)))
    size = float(max(np.abs(curve.hull).max() for curve in curves))
    return curves if gap <= 1e-12 * size else (*curves, Bezier(np.stack((end, start))))


def disc_of(element: Tree.Element, matrix: Floats) -> tuple[tuple[float, float], float] | None:
    """Middle and radius, unless the circle is stretched."""
    linear = matrix[:, :2]
    u, v = linear[:, 0], linear[:, 1]
    size = float(np.hypot(*u))
    if abs(float(u @ v)) > SIMILAR * size**2 or abs(float(np.hypot(*v)) - size) > SIMILAR * size:
        return None
    x, y = linear @ [size_of(element, "cx"), size_of(element, "cy")] + matrix[:, 2]
    return (float(x), float(y)), size * _extent(element, "r")


def size_of(element: Tree.Element, key: str) -> float:
    """A length among the attributes, in user units; 0 if it is not there."""
    return length_of(element.get(key, "0"), key)


def _extent(element: Tree.Element, key: str) -> float:
    value = size_of(element, key)
    if value < 0.0:
        raise InputError(key, f"must be 0 or more, not {value:g}")
    return value


def _path(element: Tree.Element) -> list[Course]:
    return courses(element.get("d", ""))


def _rect(element: Tree.Element) -> list[Course]:
    x, y = size_of(element, "x"), size_of(element, "y")
    width, height = _extent(element, "width"), _extent(element, "height")
    given = [element.get("rx"), element.get("ry")]
    radii = [length_of(text, "rx") for text in given if text and text != "auto"]
    if not radii or min(radii) <= 0.0:
        return courses(f"M{x!r},{y!r}h{width!r}v{height!r}h{-width!r}z")
    rx, ry = min(radii[0], 0.5 * width), min(radii[-1], 0.5 * height)
    arc = f"a{rx!r},{ry!r},0,0,1,"
    across, down = width - 2.0 * rx, height - 2.0 * ry
    return courses(
        f"M{x + rx!r},{y!r}h{across!r}{arc}{rx!r},{ry!r}v{down!r}{arc}{-rx!r},{ry!r}"
        f"h{-across!r}{arc}{-rx!r},{-ry!r}v{-down!r}{arc}{rx!r},{-ry!r}z"
    )


def _ellipse(element: Tree.Element) -> list[Course]:
    circle = tag_of(element) == "circle"
    rx, ry = (_extent(element, "r" if circle else key) for key in ("rx", "ry"))
    center = np.array([size_of(element, "cx"), size_of(element, "cy")])
    arc = Arc(center, np.array([rx, 0.0]), np.array([0.0, ry]), 0.0, 2.0 * np.pi)
    return [Course((arc,), True)]


def _straight(element: Tree.Element) -> list[Course]:
    if tag_of(element) == "line":
        x1, y1, x2, y2 = (size_of(element, key) for key in ("x1", "y1", "x2", "y2"))
        points = np.array([[x1, y1], [x2, y2]])
    else:
        points = points_of(element.get("points", ""))
    closed = tag_of(element) == "polygon"
    if closed and len(points):
        points = np.concatenate((points, points[:1]))
    curves = [Bezier(np.stack((a, b))) for a, b in pairwise(points) if np.any(a != b)]
    return [Course(tuple(curves), closed)] if curves else []


OUTLINES: dict[str, Callable[[Tree.Element], list[Course]]] = {
    "path": _path,
    "rect": _rect,
    "circle": _ellipse,
    "ellipse": _ellipse,
    "line": _straight,
    "polyline": _straight,
    "polygon": _straight,
}
"""The shapes, and what each is made of, before it is moved."""
