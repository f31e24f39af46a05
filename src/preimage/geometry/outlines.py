"""What closed curves enclose, as an area on the safe side: none of it missing, or none too much."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from preimage.errors import InputError
from preimage.geometry import simplicity
from preimage.geometry.area import Area
from preimage.geometry.curves import Curve, Floats, Hand, beside

FINER = (1.0, 0.125, 0.015625)
"""Fractions of the tolerance that are tried where borders come too near to each other."""

Outline = Sequence[Curve]
"""Curves that follow each other, the last back to the start of the first."""


class Fill(Enum):
    """Which points nested outlines enclose."""

    EVEN_ODD = "even-odd"
    """Those inside an odd number of outlines."""
    NONZERO = "nonzero"
    """Those that the outlines, in their directions, do not wind around 0 times in all."""


class Errs(Enum):
    """On which side an area errs."""

    OUTER = "outer"
    """Nothing is missing."""
    INNER = "inner"
    """Nothing is too much."""


class Filled(NamedTuple):
    """An area, and how far its border is from the curves, at most."""

    area: Area
    off: float


def filled(outlines: Sequence[Outline], fill: Fill, errs: Errs, tolerance: float) -> Filled:
    """What outlines enclose, on one side.

    Parameters
    ----------
    outlines : each closed. They may nest and touch, not cross. Of two that are the same one counts.
    tolerance : how far the border may be from the curves, a length above 0.

    Raises
    ------
    InputError : an outline crosses itself or another one, or encloses nothing.

    >>> from preimage.geometry.curves import Arc
    >>> circle = [Arc.circle((0, 0), 1.0)]
    >>> small, large = (filled([circle], Fill.EVEN_ODD, errs, 0.01).area.measure for errs in
    ...     (Errs.INNER, Errs.OUTER))
    >>> bool(small < np.pi < large < small + 0.1)
    True
    """
    for part in FINER:
        chords = [beside(outline, Hand.LEFT, part * tolerance, closed=True) for outline in outlines]
        rings = [chord.points for chord in chords]
        fault = _fault(rings)
        if fault is not None:
            continue
        directed = _directed([shapely.Polygon(ring) for ring in rings], outlines, fill)
        hand = Hand.RIGHT if errs is Errs.OUTER else Hand.LEFT
        borders = [beside(outline, hand, part * tolerance, closed=True) for outline, _ in directed]
        geometry = _nested([border.points for border in borders], [depth for _, depth in directed])
        if geometry is not None:
            return Filled(Area.of(geometry), max(border.off for border in borders))
        fault = "its borders come too near to each other"
    raise InputError("", str(fault))


def _fault(rings: list[Floats]) -> str | None:
    """Why rings bound no area."""
    offsets = np.concatenate([[0], np.cumsum([len(ring) for ring in rings])]).astype(np.int64)
    found = simplicity.ring_fault(np.concatenate(rings), offsets)
    if found is not None:
        ring = rings[found.ring]
        if len(ring) < 3:
            return "encloses nothing"
        x, y = ring[0]
        return f"the outline from ({x:.6g}, {y:.6g}) crosses itself: {found.rule}"
    polygons = np.array([shapely.Polygon(ring) for ring in rings], dtype=object)
    one, other = shapely.STRtree(polygons).query(polygons, predicate="overlaps")
    if len(one):
        (x, y), (a, b) = rings[int(one[0])][0], rings[int(other[0])][0]
        return f"the outlines from ({x:.6g}, {y:.6g}) and ({a:.6g}, {b:.6g}) cross"
    return None


def _directed(
    polygons: list[BaseGeometry], outlines: Sequence[Outline], fill: Fill
) -> list[tuple[Outline, int]]:
    """The outlines that bound the area, with it on their left, and in how many others each is.

    Even depths are shells, odd ones holes.
    """
    kept = _distinct(polygons)
    shapes = np.array([polygons[k] for k in kept], dtype=object)
    around: list[list[int]] = [[] for _ in kept]
    inner, outer = shapely.STRtree(shapes).query(shapes, predicate="within")
    for i, j in zip(inner.tolist(), outer.tolist(), strict=True):
        if i != j:
            around[i].append(j)
    turns = [1 if shape.exterior.is_ccw else -1 for shape in shapes]
    directed = []
    winding = {k: sum(turns[j] for j in around[k]) for k in range(len(kept))}
    bounds = [
        fill is Fill.EVEN_ODD or (winding[k] == 0) != (winding[k] + turns[k] == 0)
        for k in range(len(kept))
    ]
    for k, number in enumerate(kept):
        if bounds[k]:
            depth = sum(bounds[j] for j in around[k])
            outline = outlines[number]
            if (turns[k] > 0) == (depth % 2 == 1):
                outline = [curve.reverse() for curve in reversed(outline)]
            directed.append((outline, depth))
    return directed


def _distinct(polygons: list[BaseGeometry]) -> list[int]:
    """The numbers of the polygons that are not the same as one before."""
    seen: set[bytes] = set()
    kept = []
    for number, polygon in enumerate(polygons):
        form = shapely.to_wkb(shapely.normalize(polygon))
        if form not in seen:
            kept.append(number)
        seen.add(form)
    return kept


def _nested(rings: list[Floats], depths: list[int]) -> BaseGeometry | None:
    """The area of shells, with even depths, and holes; nothing if they are no valid polygons."""
    if any(len(ring) < 3 for ring in rings):
        return None
    polygons = [shapely.Polygon(ring) for ring in rings]
    if not shapely.is_valid(polygons).all():
        return None
    shells = [k for k, depth in enumerate(depths) if depth % 2 == 0]
    holes: dict[int, list[Floats]] = {k: [] for k in shells}
    for k, depth in enumerate(depths):
        if depth % 2:
            owner = [
                j for j in shells if depths[j] == depth - 1 and polygons[j].covers(polygons[k])
            ]
            if not owner:
                return None
            holes[owner[0]].append(rings[k])
    parts = [shapely.Polygon(rings[k], holes[k]) for k in shells]
    geometry = parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)
    return geometry if shapely.is_valid(geometry) else None


# --- areas as task files hold them ------------------------------------------------------------


def polygons_of(area: Area) -> list[tuple[Floats, list[Floats]]]:
    """Exterior and holes of each polygon: `(n, 2)` arrays, not closed, in order of their places."""
    found = []
    for polygon in shapely.get_parts(area.geometry):
        exterior = shapely.get_coordinates(polygon.exterior)[:-1]
        holes = [shapely.get_coordinates(ring)[:-1] for ring in polygon.interiors]
        found.append((exterior, holes))
    return sorted(found, key=lambda part: tuple(part[0].min(axis=0).tolist()))


def without_holes(area: Area) -> Area:
    """The area with its holes filled.

    >>> ring = Area.polygon(np.array([[0, 0], [3, 0], [3, 3], [0, 3]]), [np.array([[1, 1], [2, 1],
    ...     [2, 2]])])
    >>> without_holes(ring).measure
    9.0
    """
    parts = [shapely.Polygon(part.exterior) for part in shapely.get_parts(area.geometry)]
    return Area.of(shapely.union_all(parts))


def cut_open(area: Area) -> list[Floats]:
    """Simple polygons, `(n, 2)`, that are the area together; those with holes are cut upright.

    >>> ring = Area.polygon(np.array([[0, 0], [4, 0], [4, 4], [0, 4]]), [np.array([[1, 1], [3, 1],
    ...     [3, 3], [1, 3]])])
    >>> sum(Area.polygon(piece).measure for piece in cut_open(ring))
    12.0
    """
    waiting = list(shapely.get_parts(area.geometry))
    pieces: list[Floats] = []
    while waiting:
        polygon = waiting.pop()
        if not len(polygon.interiors):
            pieces.append(shapely.get_coordinates(polygon.exterior)[:-1])
            continue
        xmin, ymin, xmax, ymax = polygon.bounds
        left, _, right, _ = polygon.interiors[0].bounds
        x = 0.5 * (left + right)
        for low, high in ((xmin, x), (x, xmax)):
            half = shapely.intersection(polygon, shapely.box(low, ymin, high, ymax))
            waiting += shapely.get_parts(Area.of(half).geometry).tolist()
    return sorted(pieces, key=lambda piece: tuple(piece.min(axis=0).tolist()))


def hull_box(points: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """The least upright box around `(n, 2)` points: `xmin, ymin, xmax, ymax`."""
    (xmin, ymin), (xmax, ymax) = points.min(axis=0), points.max(axis=0)
    return float(xmin), float(ymin), float(xmax), float(ymax)
