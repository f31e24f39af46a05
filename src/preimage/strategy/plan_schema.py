"""The JSON Schema of plan files: what can be said of them without geometry.

It is published as `docs/plan.schema.json`, for editors and other programs.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import Any

from preimage.geometry.geojson import MAX_COORDINATE
from preimage.strategy.plan_parse import (
    ANGLES,
    CONDITIONS,
    DISTANCE,
    LENGTHS,
    MARGIN,
    MOTION,
    NUMBER,
    OPTIONAL,
    OPTIONAL_OF_MOTION,
    PERIOD,
    REQUIRED,
    SECONDS,
    STATISTICS,
    VERSION,
)
from preimage.strategy.strategy import Status
from preimage.task import limits
from preimage.task.limits import Range
from preimage.task.options import StrategyKind
from preimage.task.parameters import INFINITY
from preimage.task.schema import DIALECT, whole_schema

Schema = dict[str, Any]


def plan_schema() -> Schema:
    """The schema of plan files, version 1, as a mapping.

    >>> plan_schema()["required"]
    ['version', 'task', 'status', 'strategy', 'regions', 'start']
    """
    task = {word: value for word, value in whole_schema().items() if word != "$schema"}
    definitions = {**task.pop("$defs"), "task": task, **_geometries()}
    definitions["region"] = _region()
    definitions["condition"] = {"oneOf": [_condition(kind) for kind in CONDITIONS]}
    top: Schema = {
        "version": {"const": VERSION, "description": "of the file's format"},
        "task": {"$ref": "#/$defs/task"},
        "status": _choice(Status),
        "strategy": _choice(StrategyKind),
        "regions": {"type": "array", "items": {"$ref": "#/$defs/region"}, "minItems": 1},
        "start": {**_ids(), "description": "the regions that may be chosen at the start"},
        "steps": {**_ids(), "description": "of a linear plan, in the order of execution"},
        "statistics": {
            "type": "object",
            "properties": dict(
                zip(STATISTICS, (_number(NUMBER, "integer"), _number(SECONDS)), strict=True)
            ),
            "additionalProperties": False,
        },
        "margins": _margins(),
    }
    return {
        "$schema": DIALECT,
        "title": "Plan of preimage",
        "description": "Lengths in the task's unit, angles in degrees, counter-clockwise from +x.",
        "type": "object",
        "properties": {word: top[word] for word in (*REQUIRED, *OPTIONAL)},
        "required": list(REQUIRED),
        "additionalProperties": False,
        "$defs": definitions,
    }


def _region() -> Schema:
    """The goal, a region of known failure, or a preimage with all that belongs to its motion."""
    geometry: Schema = {"$ref": "#/$defs/geometry"}
    common: Schema = {"id": _number(NUMBER, "integer"), "rank": _number(NUMBER, "integer")}
    goal = {**common, "id": {"const": 0}, "rank": {"const": 0}, "geometry": geometry}
    motion: Schema = {
        "direction": _number(limits.DIRECTION),
        "goals": {**_ids(), "minItems": 1},
        "target": geometry,
        "termination": {
            "type": "array",
            "items": {"$ref": "#/$defs/condition"},
            "minItems": 1,
        },
    }
    above = {word: {**rule, "minimum": 1} for word, rule in common.items()}
    preimage = {**above, "geometry": geometry, **{word: motion[word] for word in MOTION}}
    margin = {**_number(MARGIN), "description": "how far off direction may be"}
    failure = {**goal, "id": above["id"], "failure": {"const": True}}
    moving = _record(preimage, dict.fromkeys(OPTIONAL_OF_MOTION, margin))
    return {"oneOf": [_record(goal), moving, _record(failure)]}


def _margins() -> Schema:
    """How far each assumption may be off; what is missing is not known."""
    length, angle = (
        {"anyOf": [_number(DISTANCE), {"enum": list(INFINITY)}]},
        {"anyOf": [_number(MARGIN), {"enum": list(INFINITY)}]},
    )
    kinds = {**dict.fromkeys(LENGTHS, length), **dict.fromkeys(ANGLES, angle)}
    return {
        **_record({}, kinds),
        "description": "how far off the start, the sensors and all directions may be",
    }


def _condition(kind: str) -> Schema:
    values: Schema = {
        "period": _number(PERIOD),
        "distance": _number(DISTANCE),
        "domain": {"oneOf": [{"const": "valid"}, {"$ref": "#/$defs/geometry"}]},
    }
    return _record({"kind": {"const": kind}, **{word: values[word] for word in CONDITIONS[kind]}})


def _geometries() -> Schema:
    """GeoJSON geometries of the plane, RFC 7946."""
    coordinate = {"type": "number", "minimum": -MAX_COORDINATE, "maximum": MAX_COORDINATE}
    position: Schema = {"$ref": "#/$defs/position"}
    line = _list(position, 2)
    polygon = _list(_list(position, 4), 1)
    kinds = {"Point": position, "LineString": line, "Polygon": polygon}
    kinds |= {f"Multi{kind}": _list(inner) for kind, inner in kinds.items()}
    several = _list({"$ref": "#/$defs/geometry"})
    return {
        "position": {**_list(coordinate, 2), "maxItems": 2},
        "geometry": {
            "oneOf": [
                *(
                    _record({"type": {"const": kind}, "coordinates": inner})
                    for kind, inner in kinds.items()
                ),
                _record({"type": {"const": "GeometryCollection"}, "geometries": several}),
            ]
        },
    }


def _record(properties: Schema, optional: Schema | None = None) -> Schema:
    return {
        "type": "object",
        "properties": {**properties, **(optional or {})},
        "required": list(properties),
        "additionalProperties": False,
    }


def _ids() -> Schema:
    return {"type": "array", "items": _number(NUMBER, "integer"), "uniqueItems": True}


def _list(item: Schema, least: int = 0) -> Schema:
    return {"type": "array", "items": item, **({"minItems": least} if least else {})}


def _choice(kind: type[Enum]) -> Schema:
    return {"enum": [member.value for member in kind]}


def _number(within: Range, kind: str = "number") -> Schema:
    schema: Schema = {"type": kind}
    if math.isfinite(within.low):
        schema["exclusiveMinimum" if within.low_open else "minimum"] = within.low
    if math.isfinite(within.high):
        schema["exclusiveMaximum" if within.high_open else "maximum"] = within.high
    return schema
