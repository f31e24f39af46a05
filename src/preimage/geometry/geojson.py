"""GeoJSON geometries (RFC 7946): polygons, lines and points, alone or mixed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from preimage.errors import InputError, one_line, shown
from preimage.geometry.area import Area

Floats = NDArray[np.float64]
Geometry = dict[str, Any]
Position = tuple[float, float]

MAX_COORDINATE = 1e9
"""Coordinates are at most this, either way, as in task files."""


def _no_points() -> Floats:
    return np.empty((0, 2))


@dataclass(frozen=True, slots=True, eq=False)
class Shapes:
    """What a geometry is made of.

    Parameters
    ----------
    area : its polygons.
    lines : each `(k, 2)`, with two points or more.
    points : `(m, 2)`.
    """

    area: Area = field(default_factory=Area.empty)
    lines: tuple[Floats, ...] = ()
    points: Floats = field(default_factory=_no_points)

    @property
    def is_empty(self) -> bool:
        """Nothing at all."""
        return self.area.is_empty and not self.lines and not len(self.points)


# --- writing --------------------------------------------------------------------------------


def to_geojson(shapes: Shapes) -> Geometry:
    """The geometry of shapes: one of its kind alone, else a `GeometryCollection`.

    Exteriors are counter-clockwise and holes clockwise, every ring begins at its least vertex, and
    parts are in ascending order, so that equal shapes are written alike.

    >>> to_geojson(Shapes(Area.box(0, 0, 2, 1)))["coordinates"]
    [[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [0.0, 0.0]]]
    >>> to_geojson(Shapes())
    {'type': 'GeometryCollection', 'geometries': []}
    """
    polygons = sorted(
        _rings_of(polygon)
        for polygon in shapely.get_parts(shapes.area.geometry)
        if not polygon.is_empty
    )
    lines = sorted(_listed(line) for line in shapes.lines)
    points = sorted(_listed(shapes.points))
    parts = [
        {"type": kind, "coordinates": found[0]}
        if len(found) == 1
        else {"type": f"Multi{kind}", "coordinates": found}
        for kind, found in (("Polygon", polygons), ("LineString", lines), ("Point", points))
        if found
    ]
    if len(parts) == 1:
        return parts[0]
    return {"type": "GeometryCollection", "geometries": parts}


def _rings_of(polygon: Any) -> list[list[list[float]]]:
    """Exterior and holes of a polygon, each closed."""
    exterior = _ring(polygon.exterior, counterclockwise=True)
    holes = sorted(_ring(hole, counterclockwise=False) for hole in polygon.interiors)
    return [exterior, *holes]


def _ring(ring: Any, counterclockwise: bool) -> list[list[float]]:
    points = shapely.get_coordinates(ring)[:-1]
    if ring.is_ccw != counterclockwise:
        points = points[::-1]
    first = int(np.lexsort((points[:, 1], points[:, 0]))[0])
    return _listed(np.concatenate((points[first:], points[: first + 1])))


def _listed(points: Floats) -> list[list[float]]:
    listed: list[list[float]] = (points + 0.0).tolist()  # -0 becomes 0
    return listed


# --- reading --------------------------------------------------------------------------------


def from_geojson(data: object, key: str = "") -> Shapes:
    """The shapes of a geometry; polygons that overlap are united.

    Parameters
    ----------
    data : a mapping, as JSON has it.
    key : names the geometry in refusals.

    Raises
    ------
    InputError : if it is no geometry of the plane, a coordinate is not finite, a polygon not
        simple.

    >>> from_geojson({"type": "Point", "coordinates": [1, 2]}).points.tolist()
    [[1.0, 2.0]]
    """
    parts = _Parts()
    _gather(data, key, parts)
    return Shapes(
        area=_together(parts.polygons),
        lines=tuple(parts.lines),
        points=np.array(parts.points, dtype=np.float64).reshape(-1, 2),
    )


@dataclass(slots=True)
class _Parts:
    """What has been read so far."""

    polygons: list[BaseGeometry] = field(default_factory=list)
    lines: list[Floats] = field(default_factory=list)
    points: list[Position] = field(default_factory=list)


def _gather(data: object, key: str, parts: _Parts) -> None:
    """Read a geometry, however deep it lies."""
    waiting = [(data, key)]
    while waiting:
        data, key = waiting.pop()
        if not isinstance(data, Mapping):
            raise InputError(key, f"must be a GeoJSON geometry, not {shown(data)}")
        if "type" not in data:
            raise InputError(_inner(key, "type"), "is missing")
        kind = data["type"]
        collection = kind == "GeometryCollection"
        if not collection and (not isinstance(kind, str) or kind not in _READERS):
            known = ", ".join((*_READERS, "GeometryCollection"))
            raise InputError(_inner(key, "type"), f"must be one of {known}, not {shown(kind)}")
        content = "geometries" if collection else "coordinates"
        for word in data:
            if word not in ("type", content):
                place = one_line(str(word)[:40])
                raise InputError(_inner(key, place), f"unknown key: must be type or {content}")
        if content not in data:
            raise InputError(_inner(key, content), "is missing")
        place = _inner(key, content)
        if collection:
            waiting += reversed(list(_items(data[content], place)))
        else:
            _READERS[kind](data[content], place, parts)


def _inner(key: str, word: str) -> str:
    return f"{key}.{word}" if key else word


def _items(value: object, key: str) -> Iterator[tuple[object, str]]:
    """The items of a list, each with its key."""
    if not isinstance(value, list | tuple):
        raise InputError(key, f"must be a list, not {shown(value)}")
    return ((item, f"{key}[{index}]") for index, item in enumerate(value))


def _polygon(value: object, key: str, parts: _Parts) -> None:
    rings = []
    for item, place in _items(value, key):
        ring = _positions(item, place)
        if len(ring) < 4:
            raise InputError(place, f"must have 4 positions or more, not {len(ring)}")
        if ring[0] != ring[-1]:
            raise InputError(place, "must end where it begins")
        rings.append(ring)
    if not rings:
        raise InputError(key, "must have a ring")
    polygon = shapely.Polygon(rings[0], rings[1:])
    if not shapely.is_valid(polygon):
        raise InputError(key, f"is no simple polygon: {_fault(polygon)}")
    parts.polygons.append(polygon)


def _fault(polygon: BaseGeometry) -> str:
    """What is wrong with a polygon: `self-intersection at (1, 2)`."""
    reason, _, where = shapely.is_valid_reason(polygon).partition("[")
    place = ", ".join(f"{float(number):.6g}" for number in where.rstrip("]").split())
    return f"{reason.lower()} at ({place})" if place else str(reason.lower())


def _line(value: object, key: str, parts: _Parts) -> None:
    line = _positions(value, key)
    if len(line) < 2:
        raise InputError(key, f"must have 2 positions or more, not {len(line)}")
    parts.lines.append(np.array(line, dtype=np.float64))


def _point(value: object, key: str, parts: _Parts) -> None:
    parts.points.append(_position(value, key))


_Reader = Callable[[object, str, _Parts], None]


def _many(read: _Reader) -> _Reader:
    def read_all(value: object, key: str, parts: _Parts) -> None:
        for item, place in _items(value, key):
            read(item, place, parts)

    return read_all


_READERS: dict[str, _Reader] = {
    "Polygon": _polygon,
    "LineString": _line,
    "Point": _point,
    "MultiPolygon": _many(_polygon),
    "MultiLineString": _many(_line),
    "MultiPoint": _many(_point),
}


def _positions(value: object, key: str) -> list[Position]:
    return [_position(item, place) for item, place in _items(value, key)]


def _position(value: object, key: str) -> Position:
    if not isinstance(value, list | tuple):
        raise InputError(key, f"must be a position [x, y], not {shown(value)}")
    if len(value) != 2:
        raise InputError(key, f"must be a position [x, y], not {len(value)} numbers")
    x, y = value
    return _coordinate(x, key, 0), _coordinate(y, key, 1)


def _coordinate(value: object, key: str, axis: int) -> float:
    if type(value) is float and -MAX_COORDINATE <= value <= MAX_COORDINATE:
        return value + 0.0
    place = f"{key}[{axis}]"
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(place, f"must be a number, not {shown(value)}")
    if isinstance(value, float) and not math.isfinite(value):
        raise InputError(place, f"must be a finite number, not {shown(value)}")
    if not -MAX_COORDINATE <= value <= MAX_COORDINATE:
        rule = f"must be at least -1e+09 and at most 1e+09, not {shown(value)}"
        raise InputError(place, rule)
    return float(value)


def _together(polygons: list[BaseGeometry]) -> Area:
    """The area of valid polygons, which may overlap."""
    if len(polygons) == 1:
        return Area.of(polygons[0])
    if not polygons:
        return Area.empty()
    several = shapely.multipolygons(polygons)
    return Area.of(several if shapely.is_valid(several) else shapely.union_all(polygons))
