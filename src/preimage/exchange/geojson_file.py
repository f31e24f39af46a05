"""GeoJSON with roles: features of the plane, whose `role`, `name` or `id` says what is what."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from preimage.errors import InputError, one_line, shown
from preimage.exchange.drawing import NAMES, Drawing, Figure, Line, Patch, Role, Spot, role_named
from preimage.exchange.options import ImportOptions
from preimage.exchange.reading import text_of
from preimage.geometry.curves import Bezier
from preimage.geometry.geojson import Shapes, from_geojson
from preimage.task.documents import Format, parse_document
from preimage.task.workspace import SolidSide

WORDS = ("role", "name", "id")
"""Properties that may say the role; the first that is there does."""


def read_geojson(path: Path, options: ImportOptions) -> Drawing:
    """The drawing of a GeoJSON file; positions are plain coordinates, not degrees.

    A point may have a property `radius`, an obstacle that is a line `solid`, left or right.

    Raises
    ------
    InputError : with the number of the feature.
    """
    if options.units is not None:
        raise InputError("units", "GeoJSON has none: leave this out")
    data = parse_document(text_of(path), Format.JSON, str(path))
    names = {**NAMES, **options.layers}
    figures: list[Figure] = []
    ignored: Counter[str] = Counter()
    for feature, place in _features(data):
        properties = _mapping(feature.get("properties") or {}, f"{place}.properties")
        name = _name(feature, properties)
        role = role_named(name, names) if name else Role.OBSTACLES
        if role is None:
            ignored[f"features named {one_line(name[:40])}"] += 1
            continue
        place = f"{place} ({one_line(name[:40])})" if name else place
        shapes = from_geojson(feature.get("geometry"), place)
        figures += figures_of(shapes, role, place, properties)
    return Drawing("GeoJSON", tuple(figures), ignored=ignored)


def figures_of(
    shapes: Shapes, role: Role, place: str, properties: Mapping[str, Any] | None = None
) -> Iterator[Figure]:
    """The figures of polygons, lines and points."""
    properties = properties or {}
    for part in shapes.area.parts:
        if not part.is_empty:
            yield Patch(role, place, part)
    for line in shapes.lines:
        curves = tuple(Bezier.segment(a, b) for a, b in pairwise(line))
        yield Line(role, place, curves, _solid(properties, place))
    for x, y in shapes.points.tolist():
        yield Spot(role, place, (x, y), _radius(properties, place))


def _features(data: object) -> Iterator[tuple[Mapping[str, Any], str]]:
    """The features, each with its key; a geometry alone is one obstacle."""
    top = _mapping(data, "")
    kind = top.get("type")
    if kind == "FeatureCollection":
        features = top.get("features")
        if not isinstance(features, list):
            raise InputError("features", f"must be a list, not {shown(features)}")
        for index, feature in enumerate(features):
            inner = _mapping(feature, f"features[{index}]")
            if inner.get("type") != "Feature":
                rule = f"must be Feature, not {shown(inner.get('type'))}"
                raise InputError(f"features[{index}].type", rule)
            yield inner, f"features[{index}]"
    elif kind == "Feature":
        yield top, "feature"
    else:
        yield {"geometry": data}, "geometry"


def _name(feature: Mapping[str, Any], properties: Mapping[str, Any]) -> str:
    for word in WORDS:
        value = properties.get(word, feature.get(word) if word == "id" else None)
        if isinstance(value, str) and value.strip():
            return value
    return ""


def _mapping(value: object, key: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise InputError(key, f"must be a mapping, not {shown(value)}")
    return value


def _solid(properties: Mapping[str, Any], place: str) -> SolidSide | None:
    value = properties.get("solid")
    if value is None:
        return None
    if value not in [side.value for side in SolidSide]:
        raise InputError(f"{place}.solid", f"must be left or right, not {shown(value)}")
    return SolidSide(value)


def _radius(properties: Mapping[str, Any], place: str) -> float:
    value = properties.get("radius", 0.0)
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not 0.0 <= value <= 1e9:
        raise InputError(f"{place}.radius", f"must be a length, not {shown(value)}")
    return float(value)
