"""What `--target` names: the goal or a part of it, a GeoJSON file, or places that are typed."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from preimage.cli.arguments import Source, text_of
from preimage.cli.output import RefusalError, about
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.errors import InputError, shown
from preimage.preimages.methods import aim
from preimage.preimages.setting import Setting
from preimage.strategy.region_geojson import region_from_geojson
from preimage.task.documents import Format, parse_document
from preimage.task.goal import Goal
from preimage.task.options import Method

GOAL = "goal"
"""The whole goal."""

OPTION = "--target"

_PLACE = re.compile(r"(edge|polygon|point)\s*:\s*(.*)")


def goal_of(source: Source, setting: Setting) -> Region:
    """The task's goal."""
    with about(source.name):
        return goal_region(source.task, setting.space)


def target_of(text: str, source: Source, setting: Setting, direction: float) -> Region:
    """The region that a target names."""
    text = text.strip()
    if text == GOAL:
        return goal_of(source, setting)
    if text in {method.value for method in Method}:
        return aim(setting, goal_of(source, setting), direction, Method(text)).region
    if _PLACE.match(text):
        with about(OPTION):
            return goal_region(replace(source.task, goal=_places(text)), setting.space)
    with about(OPTION if text.startswith("{") else text):
        region = region_from_geojson(_geometry(text), setting.space, "geometry")
    if region.is_empty:
        raise RefusalError(f"{OPTION}: is empty")
    return region


def _geometry(text: str) -> object:
    """The geometry of GeoJSON: a text, or the file that it names; a feature means its geometry."""
    if text.startswith("{"):
        data = parse_document(text, Format.JSON, OPTION)
    elif Path(text).suffix.lower() in (".json", ".geojson") or Path(text).exists():
        data = parse_document(text_of(text), Format.JSON, text)
    else:
        words = ", ".join((GOAL, *(method.value for method in Method)))
        rule = f"{shown(text)} is none of {words}, no GeoJSON file, and no places such as"
        raise RefusalError(f"{OPTION}: {rule} edge:0,0,1,0")
    if isinstance(data, Mapping) and data.get("type") == "FeatureCollection":
        features = data.get("features")
        if not isinstance(features, list) or len(features) != 1:
            raise InputError("features", "must be one")
        data = features[0]
    if isinstance(data, Mapping) and data.get("type") == "Feature":
        return data.get("geometry")
    return data


def _places(text: str) -> Goal:
    """Edges, polygons and points: `edge:0,0,1,0; point:2,1`."""
    found: dict[str, list[tuple[tuple[float, float], ...]]] = {
        "edge": [],
        "polygon": [],
        "point": [],
    }
    for part in filter(None, (part.strip() for part in text.split(";"))):
        match = _PLACE.fullmatch(part)
        if match is None:
            raise RefusalError(f"{OPTION}: {shown(part)} is no edge:, polygon: or point:")
        found[match[1]].append(_points(match[1], match[2]))
    return Goal(
        edges=tuple((edge[0], edge[1]) for edge in found["edge"]),
        polygons=tuple(found["polygon"]),
        points=tuple(point[0] for point in found["point"]),
    )


def _points(kind: str, text: str) -> tuple[tuple[float, float], ...]:
    try:
        numbers = [float(part) for part in re.split(r"[,\s]+", text.strip())]
    except ValueError:
        raise RefusalError(f"{OPTION}: {shown(text)} are not numbers") from None
    points = tuple(zip(numbers[::2], numbers[1::2], strict=False))
    least, most = {"edge": (2, 2), "polygon": (3, len(points)), "point": (1, 1)}[kind]
    if len(numbers) % 2 or not least <= len(points) <= max(least, most):
        rule = f"{2 * least} numbers{' or more, two a point' if kind == 'polygon' else ''}"
        raise RefusalError(f"{OPTION}: {kind} must have {rule}, not {len(numbers)}")
    return points
