"""Well-known text: polygons, lines and points of the plane (OGC Simple Features)."""

from __future__ import annotations

from collections.abc import Iterator

import shapely
from shapely.geometry import mapping
from shapely.geometry.base import BaseGeometry

from preimage.errors import InputError, one_line
from preimage.geometry.geojson import Shapes, from_geojson

MAX_NESTING = 20
"""Levels of brackets: a multipolygon in a collection has four."""


def from_wkt(text: str, key: str = "") -> Shapes:
    """The shapes of a geometry; polygons that overlap are united.

    Raises
    ------
    InputError : if it is no WKT, not of the plane, not finite, or a polygon is not simple.

    >>> from_wkt("POLYGON ((0 0, 2 0, 2 1, 0 1, 0 0))").area.measure
    2.0
    """
    depth = deepest = 0
    for character in text:
        depth += (character == "(") - (character == ")")
        deepest = max(deepest, depth)
    if deepest > MAX_NESTING:
        raise InputError(key, f"must be nested {MAX_NESTING} deep or less")
    try:
        geometry = shapely.from_wkt(text)
    except shapely.errors.GEOSException as error:
        words = one_line(str(error)).removeprefix("ParseException: ")
        raise InputError(key, f"is no WKT: {words}") from None
    parts = [mapping(part) for part in _parts(geometry)]
    return from_geojson({"type": "GeometryCollection", "geometries": parts}, key)


def _parts(geometry: BaseGeometry) -> Iterator[BaseGeometry]:
    """The geometries of collections, those that are empty left out."""
    if geometry.is_empty:
        return
    if hasattr(geometry, "geoms"):
        for part in geometry.geoms:
            yield from _parts(part)
    else:
        yield geometry
