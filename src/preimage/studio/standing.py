"""A robot put somewhere by hand."""

from __future__ import annotations

from dataclasses import replace

from preimage.configuration.start import Start, StartKind, covered, start_region
from preimage.errors import InputError, TaskError
from preimage.strategy.strategy import Strategy
from preimage.studio.requests import Point
from preimage.task.initial import InitialPoint


def start_at(strategy: Strategy, place: Point) -> Start:
    """A start at a place that the plan is for.

    The place lies in the task's start, or in the one region that the plan begins with: what the
    plan promises, it promises from there too.

    Raises
    ------
    InputError : it is no place for a robot, or in neither.
    """
    space = strategy.space
    try:
        found = start_region(replace(strategy.task, initial=InitialPoint(place)), space)
    except TaskError as error:
        raise InputError("start", error.rule) from None
    given = start_region(strategy.task, space)
    if given.kind is StartKind.REGION:
        if covered(found, given.region, space):
            return found
    elif given.point == place:
        return given
    if len(strategy.start) == 1 and covered(
        found, strategy.region(strategy.start[0]).region, space
    ):
        return found
    x, y = place
    raise InputError("start", f"({x:.6g}, {y:.6g}) is not where the plan begins")


def begun_at(strategy: Strategy, place: Point) -> tuple[Strategy, Start]:
    """The same, with the plan told where it begins, where its task does not say so."""
    found = start_at(strategy, place)
    given = start_region(strategy.task, strategy.space)
    within = given.kind is StartKind.REGION and covered(found, given.region, strategy.space)
    if within or given.point == place:
        return strategy, found
    task = replace(strategy.task, initial=InitialPoint(place))
    return replace(strategy, task=task), found
