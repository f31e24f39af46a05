"""The JSON Schema of task files: what can be said of them without geometry.

It is published as `docs/task.schema.json`, for editors and other programs.
"""

from __future__ import annotations

import math
from enum import Enum
from typing import Any

from preimage.task import formula, limits
from preimage.task.limits import Range
from preimage.task.options import Method, Preference, SearchOrder, StrategyKind, Termination
from preimage.task.parameters import (
    INFINITY,
    KEY,
    MAX_NAME,
    MAX_PARAMETERS,
    NONE,
    RESERVED,
    WORDS,
)
from preimage.task.parse import GOAL, INITIAL, OPTIONAL, PLANNER, REQUIRED, VERSION
from preimage.task.task import SlidingLaw
from preimage.task.workspace import Side, SolidSide

Schema = dict[str, Any]

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def task_schema() -> Schema:
    """The schema of task files, version 1, as a mapping.

    With `parameters`, a number may be a formula; without, the file is a whole task.

    >>> task_schema()["if"]
    {'required': ['parameters']}
    """
    task = whole_schema()
    head = {word: task.pop(word) for word in ("$schema", "title", "description")}
    points = task.pop("$defs")
    template = _with_formulas(task)
    template["properties"][KEY] = _PARAMETERS
    template["required"] = [*REQUIRED, KEY]
    return {
        **head,
        "type": "object",
        "if": {"required": [KEY]},
        "then": {"$ref": "#/$defs/template"},
        "else": {"$ref": "#/$defs/task"},
        "$defs": {
            **points,
            **{f"{word}{_OPEN}": _with_formulas(schema) for word, schema in points.items()},
            "formula": _FORMULA,
            "task": task,
            "template": template,
        },
    }


def whole_schema() -> Schema:
    """The schema of a task without parameters, such as a plan file has.

    >>> whole_schema()["required"]
    ['version', 'uncertainty', 'initial', 'goal']
    """
    top: Schema = {
        "version": {"const": VERSION, "description": "of the file's format"},
        "name": {"type": "string", "minLength": 1, "maxLength": limits.MAX_NAME},
        "window": {
            **_list(_number(limits.COORDINATE), 4, 4),
            "description": "xmin, ymin, xmax, ymax; around everything if it is missing",
        },
        "walls": {**_list(_choice(Side)), "uniqueItems": True, "default": []},
        "robot": {
            "oneOf": [{"const": "point"}, _mapping(polygon=_RING, reference=_POINT)],
            "default": "point",
        },
        "obstacles": _list({"oneOf": [_POLYGON, _CHAIN]}),
        "uncertainty": _UNCERTAINTY,
        "friction": {
            "oneOf": [
                _number(limits.FRICTION),
                _mapping(coefficient=_number(limits.COEFFICIENT)),
            ],
            "default": 0,
        },
        "sliding": {**_choice(SlidingLaw), "default": "projection"},
        "initial": {"oneOf": [{"const": "everywhere"}, _one_of(_INITIAL)]},
        "goal": {
            **_optional(_GOAL),
            "anyOf": [{"required": [word], "properties": {word: {"minItems": 1}}} for word in GOAL],
        },
        "planner": {**_optional(_PLANNER), "default": {}},
    }
    return {
        "$schema": DIALECT,
        "title": "Task of preimage",
        "description": "Lengths in any unit, angles in degrees, counter-clockwise from +x.",
        "type": "object",
        "properties": {word: top[word] for word in (*REQUIRED, *OPTIONAL)},
        "required": list(REQUIRED),
        "anyOf": [
            {"required": ["window"]},
            {"required": ["obstacles"], "properties": {"obstacles": {"minItems": 1}}},
        ],
        "additionalProperties": False,
        "$defs": {"point": _list(_number(limits.COORDINATE), 2, 2)},
    }


def _with_formulas(schema: Any) -> Any:
    """The schema with a formula allowed wherever a number is."""
    if isinstance(schema, list):
        return [_with_formulas(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    if schema.get("type") in ("number", "integer"):
        return {"anyOf": [schema, {"$ref": "#/$defs/formula"}]}
    if "$ref" in schema:
        return {"$ref": f"{schema['$ref']}{_OPEN}"}
    return {word: _with_formulas(item) for word, item in schema.items()}


def _number(within: Range, kind: str = "number") -> Schema:
    schema: Schema = {"type": kind}
    if math.isfinite(within.low):
        schema["exclusiveMinimum" if within.low_open else "minimum"] = within.low
    if math.isfinite(within.high):
        schema["exclusiveMaximum" if within.high_open else "maximum"] = within.high
    if within.unit:
        schema["description"] = within.unit
    return schema


def _list(item: Schema, least: int = 0, most: int | None = None) -> Schema:
    schema: Schema = {"type": "array", "items": item}
    if least:
        schema["minItems"] = least
    if most is not None:
        schema["maxItems"] = most
    return schema


def _choice(kind: type[Enum]) -> Schema:
    return {"enum": [member.value for member in kind]}


def _optional(properties: Schema) -> Schema:
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _mapping(**properties: Schema) -> Schema:
    return {**_optional(properties), "required": list(properties)}


def _one_of(properties: Schema) -> Schema:
    return {**_optional(properties), "minProperties": 1, "maxProperties": 1}


_OPEN = "-with-formulas"
_FORMULA: Schema = {
    "type": "string",
    "maxLength": formula.MAX_LENGTH,
    # By its characters only, and no word that stands for itself: nesting is beyond a pattern.
    "pattern": rf"^(?!\.?({'|'.join(word for word in WORDS if word.isalpha())})$)"
    r"[A-Za-z0-9_.+\-*/(), \t]+$",
    "description": "arithmetic over the names of `parameters`; see docs/parameters.md",
}
_PARAMETERS: Schema = {
    "type": "object",
    "propertyNames": {
        "pattern": f"^{formula.NAME}$",
        "maxLength": MAX_NAME,
        "not": {"enum": sorted(RESERVED)},
    },
    "additionalProperties": {"type": "number"},
    "maxProperties": MAX_PARAMETERS,
    "description": "named numbers, each used by a formula",
}
_POINT: Schema = {"$ref": "#/$defs/point"}
_RING = _list(_POINT, 3)
_EDGE = _list(_POINT, 2, 2)
_POLYGON: Schema = {
    **_optional({"polygon": _RING, "holes": _list(_RING)}),
    "required": ["polygon"],
}
_CHAIN = _mapping(chain=_list(_POINT, 2), solid=_choice(SolidSide))
_FORCE = _mapping(
    angle=_number(limits.FORCE_ANGLE),
    threshold={
        "oneOf": [_number(limits.THRESHOLD), _list(_number(limits.THRESHOLD), 2, 2)],
        "description": "one, or a lower and an upper one",
    },
)
_UNCERTAINTY: Schema = {
    **_optional(
        {
            "control": _number(limits.CONTROL),
            "position": {
                # No maximum: a file read from YAML may hold infinity itself.
                "oneOf": [{"type": "number", "minimum": 0}, {"enum": list(INFINITY)}],
                "description": "radius; infinite without a position sensor",
            },
            "force": {"oneOf": [{"const": NONE}, _FORCE], "default": NONE},
        }
    ),
    "required": ["control", "position"],
}
_INITIAL: Schema = dict(
    zip(
        INITIAL,
        (
            _POINT,
            _mapping(center=_POINT, radius=_number(limits.RADIUS)),
            _RING,
            _list(_EDGE, 1),
        ),
        strict=True,
    )
)
_GOAL: Schema = dict(zip(GOAL, (_list(_EDGE), _list(_RING), _list(_POINT)), strict=True))
_DIRECTIONS: Schema = {
    "oneOf": [
        {**_number(limits.DIRECTIONS, "integer"), "multipleOf": 2},
        _list(_number(limits.DIRECTION), 1, limits.MAX_DIRECTIONS),
        {"const": "continuous"},
    ],
    "default": 8,
}
_PLANNER: Schema = dict(
    zip(
        PLANNER,
        (
            _DIRECTIONS,
            {**_choice(Method), "default": "combined"},
            {**_choice(StrategyKind), "default": "linear"},
            {**_choice(Termination), "default": "instantaneous"},
            {**_number(limits.STEPS, "integer"), "default": 8},
            {**_choice(SearchOrder), "default": "breadth-first"},
            {"oneOf": [{"const": NONE}, _number(limits.TIME_LIMIT)], "default": NONE},
            {**_number(limits.REGIONS, "integer"), "default": 10_000},
            {**_number(limits.ARC_TOLERANCE), "default": 0.005},
            {**_number(limits.DIRECTION_RESOLUTION), "default": 0.1},
            {"type": "boolean", "default": False},
            {**_choice(Preference), "default": "shortest"},
        ),
        strict=True,
    )
)
