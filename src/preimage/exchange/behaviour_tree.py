"""A plan as a tree of guarded moves for BehaviorTree.CPP 4."""

from __future__ import annotations

import json
from typing import Any
from xml.etree import ElementTree

from preimage.exchange.python_module import tables
from preimage.execution.program import compiled
from preimage.strategy.describe import describe_condition
from preimage.strategy.strategy import Strategy, StrategyRegion
from preimage.task.degrees import to_degrees

Plain = dict[str, Any]

PORTS: dict[str, dict[str, tuple[str, str, str]]] = {
    "BeginPlan": {
        "tables": ("input_port", "std::string", "what holds for the whole plan, as JSON"),
        "reached": ("output_port", "int", "the region that the plan begins with"),
    },
    "GuardedMove": {
        "region": ("input_port", "int", "the region that the robot is in"),
        "direction": ("input_port", "double", "to command: degrees, counter-clockwise from +x"),
        "until": ("input_port", "std::string", "when the motion ends, for people"),
        "tables": ("input_port", "std::string", "the same for the node, as JSON"),
        "reached": ("output_port", "int", "where the motion ended; -1 if it failed"),
    },
}
"""The nodes that the receiving side provides: port, direction, type, meaning."""


def behaviour_tree(strategy: Strategy) -> str:
    """The XML of a plan: a subtree for each region, and leaves that move and recognise.

    A subtree moves, and goes on with the subtree of the region in which the motion ended. Ranks
    fall along the way, so it comes to the goal, which succeeds, or to known failure, which fails.
    A motion whose readings contradict the model fails.

    Raises
    ------
    PlanFileError : the plan is not solved.
    """
    told = tables(compiled(strategy))
    root = ElementTree.Element("root", BTCPP_format="4", main_tree_to_execute="plan")
    root.append(ElementTree.Comment(f" {strategy.task.name}, planned by preimage "))
    main = _sequence(root, "plan")
    common = {key: value for key, value in told.items() if key != "motions"}
    begin = {"name": "begin", "tables": _json(common), "reached": "{reached}"}
    ElementTree.SubElement(main, "BeginPlan", begin)
    _go_on(main, [goal for goal, _ in told["choices"]])
    motions = {motion["region"]: motion for motion in told["motions"]}
    for region in sorted(strategy.regions, key=lambda one: (-one.rank, one.id)):
        body = _sequence(root, f"region_{region.id}")
        if region.motion is None:
            end = "AlwaysFailure" if region.failure else "AlwaysSuccess"
            name = "known to have failed" if region.failure else "in the goal"
            ElementTree.SubElement(body, end, name=name)
            continue
        ElementTree.SubElement(body, "GuardedMove", _move(region, motions[region.id]))
        _go_on(body, sorted(region.motion.goals))
    _describe_nodes(root)
    ElementTree.indent(root)
    text: str = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _sequence(root: ElementTree.Element, name: str) -> ElementTree.Element:
    tree = ElementTree.SubElement(root, "BehaviorTree", ID=name)
    return ElementTree.SubElement(tree, "Sequence")


def _move(region: StrategyRegion, motion: Plain) -> dict[str, str]:
    assert region.motion is not None
    until = " or ".join(
        describe_condition(condition, region.motion.goals)
        for condition in region.motion.termination
    )
    return {
        "name": f"region {region.id}",
        "region": str(region.id),
        "direction": f"{to_degrees(region.motion.direction):.12g}",
        "until": until,
        "tables": _json(motion),
        "reached": "{reached}",
    }


def _go_on(body: ElementTree.Element, regions: list[int]) -> None:
    """Go on with the region that was reached."""
    if len(regions) == 1:
        _subtree(body, regions[0])
        return
    choice = ElementTree.SubElement(body, "Fallback")
    for region in regions:
        case = ElementTree.SubElement(choice, "Sequence")
        ElementTree.SubElement(case, "ScriptCondition", code=f"reached == {region}")
        _subtree(case, region)


def _subtree(body: ElementTree.Element, region: int) -> None:
    ElementTree.SubElement(body, "SubTree", ID=f"region_{region}", _autoremap="true")


def _describe_nodes(root: ElementTree.Element) -> None:
    model = ElementTree.SubElement(root, "TreeNodesModel")
    for node, ports in PORTS.items():
        action = ElementTree.SubElement(model, "Action", ID=node)
        for name, (kind, type_, words) in ports.items():
            ElementTree.SubElement(action, kind, name=name, type=type_).text = words


def _json(data: Plain) -> str:
    return json.dumps(data, allow_nan=False, separators=(",", ":"))
