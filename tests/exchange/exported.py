"""What an exported plan does, reading by reading, beside the executor and beside runs."""

from __future__ import annotations

import importlib.util
import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any
from xml.etree import ElementTree

from preimage import Strategy
from preimage.exchange.python_module import module_text, readings_of
from preimage.execution.trace import Trace

Reading = tuple[float, float, float, float | None]


def loaded(strategy: Strategy, folder: Path, name: str) -> ModuleType:
    """The module of a plan."""
    path = folder / f"{name}.py"
    path.write_text(module_text(strategy), "utf-8")
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def rows(trace: Trace) -> Iterator[Reading]:
    """What is read in a run, and, as the robot then stands, for as long again."""
    last: Reading = (0.0, math.nan, math.nan, None)
    for time, (x, y), force in readings_of(trace):
        last = (time, x, y, None if math.isnan(force) else force)
        yield last
    for step in range(1, 60):
        yield (last[0] + step * trace.time / 20.0, *last[1:])


class Tree:
    """A small interpreter of the nodes that exported trees have; leaves are the module's.

    `tick` takes a reading and gives the commanded direction, degrees, or None once it has ended.
    """

    def __init__(self, text: str, module: ModuleType) -> None:
        self._root = ElementTree.fromstring(text)
        assert self._root.get("BTCPP_format") == "4"
        self._trees = {tree.get("ID"): tree[0] for tree in self._root.iter("BehaviorTree")}
        self._module = module
        self._board: dict[str, int] = {}
        self._plan: dict[str, Any] = {}
        self.succeeded: bool | None = None
        self._steps = self._run(self._trees[self._root.get("main_tree_to_execute")])
        self._reading: Reading = (0.0, math.nan, math.nan, None)

    def tick(self, reading: Reading) -> float | None:
        self._reading = reading
        try:
            direction: float = next(self._steps)
        except StopIteration as end:
            self.succeeded = end.value
            return None
        return direction

    def _run(self, node: ElementTree.Element) -> Any:
        run: Callable[[ElementTree.Element], Any] = getattr(self, f"_{node.tag.lower()}")
        return run(node)

    def _sequence(self, node: ElementTree.Element) -> Any:
        for child in node:
            if not (yield from self._run(child)):
                return False
        return True

    def _fallback(self, node: ElementTree.Element) -> Any:
        for child in node:
            if (yield from self._run(child)):
                return True
        return False

    def _subtree(self, node: ElementTree.Element) -> Any:
        return (yield from self._run(self._trees[node.get("ID")]))

    def _scriptcondition(self, node: ElementTree.Element) -> Any:
        name, sign, value = (node.get("code") or "").split()
        assert sign == "=="
        yield from ()
        return self._board[name] == int(value)

    def _alwayssuccess(self, node: ElementTree.Element) -> Any:
        yield from ()
        return True

    def _alwaysfailure(self, node: ElementTree.Element) -> Any:
        yield from ()
        return False

    def _beginplan(self, node: ElementTree.Element) -> Any:
        self._plan = {**json.loads(node.get("tables") or ""), "motions": []}
        told = self._module._told(
            self._module._conditions(self._plan["choices"], self._plan), *self._reading[1:3], None
        )
        if told is None:
            return False
        self._board["reached"] = told
        yield from ()
        return True

    def _guardedmove(self, node: ElementTree.Element) -> Any:
        """One motion: an executor whose plan is that motion alone."""
        table = json.loads(node.get("tables") or "")
        goals = {goal for told in ("by_reading", "by_rest") for goal, _ in table[told]}
        ends = [[goal, False] for goal in goals]
        single = {**self._plan, "motions": [table], "ends": ends}
        single["choices"] = [[table["region"], None]]
        single["initial"], single["point"] = None, [*self._reading[1:3]]
        executor = self._module.Executor(single)
        answer = executor.start(*self._reading[:3])
        while answer.command is not None:
            told = math.degrees(answer.command) - float(node.get("direction") or "")
            assert abs(told) < 1e-9
            yield float(node.get("direction") or "")
            answer = executor.read(*self._reading)
        self._board["reached"] = answer.region if answer.doing == "done" else -1
        return answer.doing == "done"
