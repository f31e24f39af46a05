"""A task as a page shows it, and the steps of one motion."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import c_obstacles, configuration_space
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, StartKind, start_region
from preimage.errors import InputError, shown
from preimage.mechanics.behaviour import Behaviour
from preimage.preimages.methods import preimage
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Command, Setting
from preimage.strategy.words import count, direction_words, number, region_words
from preimage.studio.plain import DIGITS, area_of, degrees_of, points_of, region_of
from preimage.studio.questions import Body, Tell
from preimage.studio.requests import angle, drawable, needed, strategy_of, task_of, word
from preimage.task.degrees import to_degrees
from preimage.task.files import dump_task
from preimage.task.options import Method
from preimage.task.robot import Robot
from preimage.task.task import Everywhere, InitialDisc, InitialEdges, InitialPoint, Task

Plain = dict[str, Any]

CIRCLE = 48
"""Sides of a disc as it is drawn."""


def space(body: Body, tell: Tell) -> Body:
    """A task's configuration space, its goal and its start."""
    task = task_of(body)
    made = drawable(configuration_space(task))
    contact = made.contact
    start = start_region(task, made)
    kept = ~contact.open
    vertices = contact.vertices
    return {
        "task": dump_task(task),
        "window": list(made.window),
        "free": area_of(made.free),
        "obstacles": area_of(made.obstacles),
        "solid": area_of(c_obstacles(task.workspace, Robot(), made.window, made.tolerance)),
        "robot": None if task.robot.polygon is None else _robot(task),
        "goal": region_of(goal_region(task, made), contact),
        "start": {**_start(start, made), **_initial(task)},
        "features": [
            {"id": int(edge), "from": ends[:2], "to": ends[2:], "normal": degrees_of(normal)}
            for edge, ends, normal in zip(
                np.flatnonzero(kept),
                points_of(np.concatenate((contact.points, contact.ends), axis=1)[kept]),
                contact.normal[kept].tolist(),
                strict=True,
            )
        ],
        "vertices": [
            {"id": int(vertex), "at": place, "concave": bool(contact.concave[vertex])}
            for vertex, place in zip(vertices, points_of(contact.points[vertices]), strict=True)
        ],
        "open": points_of(np.concatenate((contact.points, contact.ends), axis=1)[contact.open]),
    }


def _robot(task: Task) -> list[list[float]]:
    """The robot's outline about its reference point."""
    assert task.robot.polygon is not None
    return points_of(np.asarray(task.robot.polygon) - np.asarray(task.robot.reference))


def _start(start: Start, made: ConfigurationSpace) -> Plain:
    if start.kind is StartKind.REGION:
        return region_of(start.region, made.contact)
    assert start.point is not None
    return {"area": [], "edges": [], "vertices": points_of([start.point])}


def _initial(task: Task) -> Plain:
    """What kind of start it is, as the task says, and its outline."""
    match task.initial:
        case InitialPoint():
            return {"kind": "point", "outline": None}
        case InitialDisc(center=(x, y), radius=radius):
            turns = np.linspace(0.0, 2.0 * math.pi, CIRCLE, endpoint=False)
            ring = np.stack((x + radius * np.cos(turns), y + radius * np.sin(turns)), axis=1)
            return {"kind": "disc", "outline": points_of(ring)}
        case InitialEdges():
            return {"kind": "edges", "outline": None}
        case Everywhere():
            return {"kind": "everywhere", "outline": None}
        case polygon:
            return {"kind": "polygon", "outline": points_of(polygon.vertices)}


def stage(body: Body, tell: Tell) -> Body:
    """One motion towards a goal, step by step.

    What features do, what is read there, what is aimed at, the backprojection and the sweep that
    finds it, the preimage.
    """
    task, goal, made = _aim(body)
    direction = angle(needed(body, "direction"), "direction")
    method = Method(word(body, "method", [one.value for one in Method], task.options.method.value))
    setting = Setting.of(task, made)
    found = preimage(setting, goal, direction, method)
    contact, command = made.contact, setting.command(direction)
    target = found.target
    return {
        "direction": degrees_of(direction),
        "method": method.value,
        **_features(made, command),
        "kernel": region_of(target.kernel, contact),
        "sticking": region_of(target.sticking, contact),
        "target": region_of(target.region, contact),
        "backprojection": region_of(found.backprojection.region, contact),
        "preimage": region_of(found.region, contact),
        "rays": points_of(found.backprojection.rays.reshape(-1, 4)),
        "sweep": _sweep(made, found),
        "words": _words(found, task.uncertainty.control),
    }


def _aim(body: Body) -> tuple[Task, Any, ConfigurationSpace]:
    """The task, the region that is aimed at, and the space of both."""
    if body.get("plan") is None:
        task = task_of(body)
        made = drawable(configuration_space(task))
        return task, goal_region(task, made), made
    strategy = strategy_of(body)
    made = drawable(strategy.space)
    wanted = body.get("goal", 0)
    for region in strategy.regions:
        if region.id == wanted and not isinstance(wanted, bool):
            return strategy.task, region.region, made
    raise InputError("goal", f"must be a region of the plan, not {shown(wanted)}")


def _features(made: ConfigurationSpace, command: Command) -> Plain:
    """What each feature does to the motion, and what is read there."""
    contact, sources, readings = made.contact, command.sources, command.readings
    count = len(contact)
    against = command.direction + math.pi

    def told(feature: int, code: int, off: float | None) -> Plain:
        half = float(readings.half[feature])
        felt = half >= 0.0
        return {
            "id": feature % count,
            "role": _role(code),
            "off": off,
            "reads": {
                "zero": bool(readings.zero[feature]),
                "from": degrees_of(readings.center[feature] - half) if felt else None,
                "to": degrees_of(readings.center[feature] + half) if felt else None,
            },
        }

    edges = np.flatnonzero(~contact.open)
    turns = np.mod(against - contact.normal + math.pi, 2.0 * math.pi) - math.pi
    return {
        "features": [
            told(edge, int(sources.edges[edge]), degrees_of(turns[edge])) for edge in edges.tolist()
        ],
        "vertices": [
            told(count + vertex, int(sources.vertices[vertex]), None)
            for vertex in contact.vertices.tolist()
        ],
    }


def _role(code: int) -> str:
    """What a feature does, in a word."""
    if code & Behaviour.STICKS_SURELY:
        return "sticks"
    if code & Behaviour.MAY_STICK:
        return "may stick"
    if code & Behaviour.MAY_SLIDE:
        return "slides off" if code & Behaviour.MAY_LEAVE else "slides"
    return "leaves"


def _sweep(made: ConfigurationSpace, found: Preimage) -> list[Plain]:
    """The places at which the sweep decides something, in its order: against the motion."""
    contact, rays = made.contact, found.backprojection.rays
    ahead = np.array([math.cos(found.direction), math.sin(found.direction)])
    events: list[tuple[float, str, list[float]]] = []
    for place in points_of(contact.points[contact.vertices]):
        events.append((-float(ahead @ place), "a vertex of contact space", place))
    for ring in found.target.region.area.rings:
        for place in points_of(ring):
            events.append((-float(ahead @ place), "a corner of the target", place))
    for begin, end in rays.tolist():
        pair = sorted((begin, end), key=lambda place: -float(ahead @ place))
        events.append((-float(ahead @ pair[0]), "a ray begins", pair[0]))
        events.append((-float(ahead @ pair[1]), "a ray ends", pair[1]))
    events.sort(key=lambda event: (round(event[0], DIGITS), event[1], event[2]))
    return [
        {"height": round(height, DIGITS), "words": words, "at": place}
        for height, words, place in events
    ]


def _words(found: Preimage, control: float) -> list[str]:
    """What the stage shows, in sentences."""
    target, back = found.target, found.backprojection.region
    if target.region.is_empty:
        return [
            f"Under {direction_words(found.direction)} no part of the goal is recognised: there is "
            "nothing to aim at."
        ]
    rays = len(found.backprojection.rays)
    return [
        f"The motion {direction_words(found.direction)} aims at {region_words(target.region)}.",
        f"All motions within the control cone reach that from {region_words(back)}.",
        f"The border of that is {count(rays, 'ray')} at ±{number(to_degrees(control))}° from the "
        "motion, and obstacles.",
    ]
