"""Plans and their data, for the tests of this room."""

from __future__ import annotations

import copy
import json
from functools import cache
from typing import Any

from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict
from preimage.strategy.strategy import Strategy
from preimage.task.examples import named_task


@cache
def planned(name: str) -> Strategy:
    """The plan of a named task."""
    return plan(named_task(name))


@cache
def _data(name: str) -> str:
    return json.dumps(plan_to_dict(planned(name)))


def plan_data(name: str = "peg-in-hole-point") -> dict[str, Any]:
    """The data of a named task's plan, to be changed at will."""
    data: dict[str, Any] = json.loads(_data(name))
    return copy.deepcopy(data)
