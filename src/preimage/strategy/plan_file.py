"""Plan files: a strategy as JSON, and back (files.md)."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from typing import Any

from preimage.configuration.space import ConfigurationSpace
from preimage.errors import PlanFileError, TaskError
from preimage.recognition.termination import (
    Condition,
    ElapsedCondition,
    ReadingCondition,
    StickingCondition,
)
from preimage.strategy.margins import Margins
from preimage.strategy.plan_parse import VERSION, parse_plan
from preimage.strategy.region_geojson import region_to_geojson
from preimage.strategy.strategy import Strategy, StrategyRegion
from preimage.task.degrees import representable, to_degrees
from preimage.task.documents import read_document
from preimage.task.files import dump_task
from preimage.whole_file import write_whole

Data = dict[str, Any]


def plan_to_dict(strategy: Strategy) -> Data:
    """The data of a plan file, with its keys in order: plain numbers, words, lists and mappings."""
    data: Data = {
        "version": VERSION,
        "task": dump_task(strategy.task),
        "status": strategy.status.value,
        "strategy": strategy.kind.value,
        "regions": [_region(region, strategy.space) for region in strategy.regions],
        "start": [int(number) for number in strategy.start],
        "steps": [int(number) for number in strategy.steps],
        "statistics": {
            "regions": int(strategy.statistics.regions),
            "seconds": round(float(strategy.statistics.seconds), 6),
        },
    }
    if strategy.margins is not None:
        data["margins"] = _margins(strategy.margins)
    return data


def format_plan(strategy: Strategy) -> str:
    """The text of a plan file: the same for equal strategies but for `statistics.seconds`."""
    data = plan_to_dict(strategy)
    lines = ["{"]
    for word, value in data.items():
        if word == "task":
            inner = [f"    {_entry(key, item)}" for key, item in value.items()]
            lines += ['  "task": {', *_separated(inner), "  },"]
        elif word == "regions":
            lines += ['  "regions": [', *_separated([_block(item) for item in value]), "  ],"]
        else:
            lines.append(f"  {_entry(word, value)},")
    lines[-1] = lines[-1].rstrip(",")
    return "\n".join([*lines, "}"]) + "\n"


def write_plan(strategy: Strategy, path: str | os.PathLike[str]) -> None:
    """Write a strategy to a plan file, whole or not at all.

    Raises
    ------
    OSError : if it cannot be written.
    """
    write_whole(path, format_plan(strategy))


def read_plan(source: str | os.PathLike[str] | Mapping[str, Any]) -> Strategy:
    """The strategy of a plan file, or of its data; also of a file that another program wrote.

    Configuration space is made anew from the task. That the plan keeps its promises is not
    looked at here.

    Raises
    ------
    PlanFileError : if the file cannot be read or the plan is refused.
    """
    if isinstance(source, Mapping):
        return parse_plan(source)
    try:
        data = read_document(source)
    except TaskError as error:
        raise PlanFileError(error.key, error.rule) from None
    return parse_plan(data)


def _region(region: StrategyRegion, space: ConfigurationSpace) -> Data:
    data: Data = {"id": int(region.id), "rank": int(region.rank)}
    if region.failure:
        data["failure"] = True
    motion = region.motion
    if motion is not None:
        data["direction"] = float(to_degrees(representable(motion.direction)))
        if motion.margin is not None:
            data["margin"] = float(to_degrees(motion.margin))
    data["geometry"] = region_to_geojson(region.region, space)
    if motion is not None:
        data["goals"] = [int(goal) for goal in motion.goals]
        data["target"] = region_to_geojson(motion.target, space)
        data["termination"] = [condition_to_dict(one, space) for one in motion.termination]
    return data


def _margins(margins: Margins) -> Data:
    """What is known of them; infinity is the word `inf`, so that JSON can hold it."""
    known = {
        "start": margins.start,
        "reading": margins.reading,
        "force": _to_degrees(margins.force),
        "direction": _to_degrees(margins.direction),
    }
    return {
        word: "inf" if math.isinf(value) else float(value)
        for word, value in known.items()
        if value is not None
    }


def _to_degrees(radians: float | None) -> float | None:
    """An angle in degrees; infinity stays."""
    if radians is None or math.isinf(radians):
        return radians
    return to_degrees(representable(radians))


def condition_to_dict(condition: Condition, space: ConfigurationSpace) -> Data:
    """The data of a termination condition."""
    match condition:
        case StickingCondition(period=period, distance=distance):
            return {"kind": "sticking", "period": float(period), "distance": float(distance)}
        case ElapsedCondition(period=period):
            return {"kind": "elapsed", "period": float(period)}
        case ReadingCondition(domain=domain):
            place = "valid" if domain is None else region_to_geojson(domain, space)
            return {"kind": "reading", "domain": place}


def _block(region: Data) -> str:
    """A region, as a group of lines."""
    geometry = list(region).index("geometry")
    head = ", ".join(_entry(word, region[word]) for word in list(region)[:geometry])
    rest = [_entry(word, region[word]) for word in list(region)[geometry:]]
    return "    {" + ",\n     ".join([head, *rest]) + "}"


def _separated(blocks: list[str]) -> list[str]:
    return [f"{block}," for block in blocks[:-1]] + blocks[-1:]


def _entry(word: str, value: object) -> str:
    return f"{json.dumps(word)}: {json.dumps(value, ensure_ascii=False, allow_nan=False)}"
