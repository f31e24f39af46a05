"""Budgets and maps as JSON: the same bytes for the same answers, however long they took.

A budget: `version`, `task` (its name), `method`, `given` (an outcome), `bounds`, `cells` (how
often the planner was asked). Each of `bounds`: `key` (its place in the task file), `unit`, `given`,
`step`, `monotone`, `spacing` (of samples; null where nothing can be missed), `slack` (null
without a plan as given), `unbounded`, `stretches` (`from`, `to`, and an outcome) and `limits`
(`inside`, `outside`, `motions`, `of`, `cause`).

A map: `version`, `task`, `given`, `x` and `y` (`key`, `unit`, `given`, `values`), `layers`, `cells`
and `all_cells`. Each of `layers`: `method`, and `motions`, a list for each value of x of the
motions at each value of y; null without a plan, `"unknown"` without an answer.

An outcome: `answer` and, where there are any, `motions` and `words`. Numbers are in the units of
the task file; what is infinite is `"inf"`.
"""

from __future__ import annotations

import json
import math
from typing import Any

from preimage.analysis.axis import Axis
from preimage.analysis.budget import AxisBudget, Budget
from preimage.analysis.cell import Outcome
from preimage.analysis.grid import NONE, UNKNOWN
from preimage.analysis.map import ErrorMap

VERSION = 1


def format_budget(budget: Budget) -> str:
    """The text of a budget's file."""
    return _text(
        {
            "version": VERSION,
            "task": budget.name,
            "method": budget.method.value,
            "given": _outcome(budget.given),
            "bounds": [_bound(axis) for axis in budget.axes],
            "cells": budget.cells,
        }
    )


def format_map(found: ErrorMap) -> str:
    """The text of a map's file."""
    return _text(
        {
            "version": VERSION,
            "task": found.name,
            "given": _outcome(found.given),
            "x": {**_axis(found.x), "values": list(found.x.values)},
            "y": {**_axis(found.y), "values": list(found.y.values)},
            "layers": [
                {
                    "method": layer.method.value,
                    "motions": [
                        [_motions(value) for value in row] for row in layer.motions.tolist()
                    ],
                }
                for layer in found.layers
            ],
            "cells": found.looked_at,
            "all_cells": found.size,
        }
    )


def _bound(axis: AxisBudget) -> dict[str, Any]:
    return {
        **_axis(axis.axis),
        "step": axis.axis.step,
        "monotone": axis.axis.monotone,
        "spacing": axis.spacing,
        "slack": None if axis.slack is None else _number(axis.slack),
        "unbounded": axis.unbounded,
        "stretches": [
            {"from": one.low, "to": one.high, **_outcome(one.outcome)} for one in axis.stretches
        ],
        "limits": [
            {
                "inside": one.inside,
                "outside": one.outside,
                "motions": list(one.cause.motions),
                "of": one.cause.of,
                "cause": one.cause.words,
            }
            for one in axis.limits
        ],
    }


def _axis(axis: Axis) -> dict[str, Any]:
    return {"key": axis.key, "unit": axis.unit, "given": _number(axis.given)}


def _outcome(outcome: Outcome) -> dict[str, Any]:
    found: dict[str, Any] = {"answer": outcome.answer.value}
    if outcome.motions is not None:
        found["motions"] = outcome.motions
    if outcome.words:
        found["words"] = outcome.words
    return found


def _motions(value: int) -> int | str | None:
    return None if value == NONE else "unknown" if value == UNKNOWN else value


def _number(value: float) -> float | str:
    return "inf" if math.isinf(value) else value


def _text(content: dict[str, Any]) -> str:
    return json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
