"""From plain data, as read from a file, to a task. Degrees become radians here.

What a value must be is refused by the constructors; here only what a key must be.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from preimage.errors import TaskError, one_line, shown
from preimage.task import checks, limits, parameters
from preimage.task.degrees import representable, to_radians
from preimage.task.goal import Goal
from preimage.task.initial import (
    Everywhere,
    Initial,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
)
from preimage.task.options import Continuous, Directions, PlannerOptions, uniform_directions
from preimage.task.parameters import CONTINUOUS, INFINITY, NONE
from preimage.task.robot import Robot
from preimage.task.task import SlidingLaw, Task
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import (
    ChainObstacle,
    Obstacle,
    PolygonObstacle,
    Side,
    SolidSide,
    Window,
    Workspace,
)

VERSION = 1
"""Of the task file."""

REQUIRED = ("version", "uncertainty", "initial", "goal")
OPTIONAL = (
    "name",
    "window",
    "walls",
    "robot",
    "obstacles",
    "friction",
    "sliding",
    "planner",
)
INITIAL = ("point", "disc", "polygon", "edges")
GOAL = ("edges", "polygons", "points")
PLANNER = (
    "directions",
    "method",
    "strategy",
    "termination",
    "max_steps",
    "search",
    "time_limit",
    "max_regions",
    "arc_tolerance",
    "resolution",
    "or_fail",
    "prefer",
)


def parse_task(data: object, *, name: str = "task") -> Task:
    """The task that the data describes; see `files.md` for its keys.

    Parameters
    ----------
    data : mappings, lists, numbers and words, as a file has them; angles in degrees. With
        `parameters`, formulas of them too: they get the values that are given there.
    name : the task's name if the data has none.

    Raises
    ------
    TaskError : with the key, the value and the rule.

    >>> task = parse_task({
    ...     "version": 1, "window": [-5, -5, 5, 5],
    ...     "uncertainty": {"control": 5, "position": 0.1},
    ...     "initial": "everywhere", "goal": {"polygons": [[[0, 0], [1, 0], [0, 1]]]},
    ... })
    >>> task.workspace.window.xmax
    5.0
    """
    if isinstance(data, Mapping) and parameters.KEY in data:
        return parse_with(*parameters.split(data), name=name)
    return _task(data, name)


def parse_with(
    document: Mapping[str, Any], values: Mapping[str, float], *, name: str = "task"
) -> Task:
    """The task of a document whose parameters have these values.

    Raises
    ------
    TaskError : with the formula too, where one gave the value.
    """
    if not values:
        return _task(document, name)
    data = parameters.evaluated(document, values)
    try:
        return _task(data, name)
    except TaskError as error:
        raise parameters.explained(error, document, values) from None


def _task(data: object, name: str) -> Task:
    top = fields(data, "", REQUIRED, (*OPTIONAL, parameters.KEY))
    if parameters.KEY in top:
        raise TaskError(parameters.KEY, "must be split from the document")
    if checks.number(top["version"], "version") != VERSION:
        raise TaskError("version", f"must be {VERSION}, not {shown(top['version'])}")
    robot = _robot(top.get("robot", "point"))
    goal = _goal(top["goal"])
    initial = _initial(top["initial"])
    obstacles = tuple(
        _obstacle(item, f"obstacles[{index}]")
        for index, item in enumerate(checks.items(top.get("obstacles", []), "obstacles"))
    )
    if "window" in top:
        window = _window(top["window"])
    elif obstacles:
        window = default_window(obstacles, robot, initial, goal)
    else:
        raise TaskError("window", "is missing, and there are no obstacles to make one around")
    return Task(
        name=top.get("name", name),
        workspace=Workspace(window, _walls(top.get("walls", [])), obstacles),
        robot=robot,
        uncertainty=_uncertainty(top["uncertainty"]),
        friction=_friction(top.get("friction", 0.0)),
        sliding=checks.choice(top.get("sliding", "projection"), "sliding", SlidingLaw),
        initial=initial,
        goal=goal,
        options=_options(top.get("planner", {})),
    )


def fields(
    value: object, key: str, required: tuple[str, ...] = (), optional: tuple[str, ...] = ()
) -> Mapping[str, Any]:
    """A mapping with these keys and no others."""
    if not isinstance(value, Mapping):
        raise TaskError(key or "task", f"must be a mapping, not {shown(value)}")
    known = (*required, *optional)
    dot = f"{key}." if key else ""
    for word in value:
        if not isinstance(word, str):
            raise TaskError(key or "task", f"keys must be words, not {shown(word)}")
        if word not in known:
            near = checks.suggestion(word, known) or f": must be {checks.one_of(known)}"
            place = one_line(word) if len(word) <= 40 else f"{one_line(word[:39])}…"
            raise TaskError(f"{dot}{place}", f"unknown key{near}")
    for word in required:
        if word not in value:
            raise TaskError(f"{dot}{word}", "is missing")
    return value


def one_field(value: object, key: str, known: tuple[str, ...]) -> tuple[str, Any]:
    """The one key of a mapping that must have one of these, and its value."""
    mapping = fields(value, key, (), known)
    if len(mapping) != 1:
        found = " and ".join(mapping) or "none"
        raise TaskError(key, f"must have one key of {', '.join(known)}, not {found}")
    ((word, inner),) = mapping.items()
    return word, inner


def default_window(
    obstacles: tuple[Obstacle, ...], robot: Robot, initial: Initial, goal: Goal
) -> Window:
    """The window of a task that has none.

    The box around all coordinates of obstacles, start and goal, with a margin of half its larger
    side, and the robot's largest distance from its reference point; rounded outward to whole
    multiples of a power of ten between a twentieth and a half of the margin.
    """
    points = [point for obstacle in obstacles for _, ring in obstacle.rings for point in ring]
    points += [point for edge in goal.edges for point in edge]
    points += [point for polygon in goal.polygons for point in polygon]
    points += goal.points
    match initial:
        case InitialPoint():
            points.append(initial.point)
        case InitialDisc():
            (x, y), r = initial.center, initial.radius
            points += [(x - r, y - r), (x + r, y + r)]
        case InitialPolygon():
            points += initial.vertices
        case InitialEdges():
            points += [point for edge in initial.edges for point in edge]
        case Everywhere():
            pass
    sides = [(min(values), max(values)) for values in zip(*points, strict=True)]
    margin = 0.5 * max(high - low for low, high in sides)
    if margin == 0.0:
        raise TaskError("window", "is missing, and all coordinates are one point")
    margin += max(math.hypot(x, y) for x, y in robot.shape)
    exponent = math.floor(math.log10(max(0.5 * margin, limits.MIN_WINDOW)))
    (xmin, xmax), (ymin, ymax) = sides
    return Window(
        _rounded(xmin - margin, exponent, math.floor),
        _rounded(ymin - margin, exponent, math.floor),
        _rounded(xmax + margin, exponent, math.ceil),
        _rounded(ymax + margin, exponent, math.ceil),
    )


def _rounded(value: float, exponent: int, to_whole: Callable[[float], int]) -> float:
    """A multiple of `10**exponent`, as the decimal that is nearest to it."""
    return float(f"{to_whole(value / 10.0**exponent)}e{exponent}")


def _window(value: object) -> Window:
    bounds = checks.items(value, "window")
    if len(bounds) != 4:
        raise TaskError("window", f"must be [xmin, ymin, xmax, ymax], not {len(bounds)} numbers")
    return Window(*bounds)  # type: ignore[arg-type]  # which the constructor checks


def _walls(value: object) -> frozenset[Side]:
    sides = [
        checks.choice(side, f"walls[{index}]", Side)
        for index, side in enumerate(checks.items(value, "walls"))
    ]
    for index, side in enumerate(sides):
        if side in sides[:index]:
            raise TaskError(f"walls[{index}]", f"names {side.value} again")
    return frozenset(sides)


def _robot(value: object) -> Robot:
    if value == "point":
        return Robot()
    if isinstance(value, Mapping):
        mapping = fields(value, "robot", ("polygon", "reference"))
        polygon = checks.points(mapping["polygon"], "robot.polygon")
        return Robot(polygon, mapping["reference"])
    raise TaskError("robot", f"must be point or a mapping, not {shown(value)}")


def _obstacle(value: object, key: str) -> Obstacle:
    mapping = fields(value, key, (), ("polygon", "holes", "chain", "solid"))
    if ("polygon" in mapping) == ("chain" in mapping):
        raise TaskError(key, "must have a polygon or a chain, one of the two")
    if "chain" in mapping:
        fields(value, key, ("chain", "solid"))
        return _deeper(key, lambda: ChainObstacle(mapping["chain"], _solid(mapping["solid"])))
    fields(value, key, ("polygon",), ("holes",))
    return _deeper(key, lambda: PolygonObstacle(mapping["polygon"], mapping.get("holes", ())))


def _solid(value: object) -> SolidSide:
    return checks.choice(value, "solid", SolidSide)


def _deeper(key: str, build: Callable[[], Obstacle]) -> Obstacle:
    try:
        return build()
    except TaskError as error:
        raise error.under(key) from None


def _uncertainty(value: object) -> Uncertainty:
    mapping = fields(value, "uncertainty", ("control", "position"), ("force",))
    position = mapping["position"]
    if isinstance(position, str) and position in INFINITY:
        position = math.inf
    control = _degrees(mapping["control"], "uncertainty.control")
    force = mapping.get("force", NONE)
    if force == NONE:
        return Uncertainty(control, position)
    if not isinstance(force, Mapping):
        raise TaskError("uncertainty.force", f"must be none or a mapping, not {shown(force)}")
    inner = fields(force, "uncertainty.force", ("angle", "threshold"))
    threshold = inner["threshold"]
    if not isinstance(threshold, list | tuple):
        key = "uncertainty.force.threshold"
        threshold = (checks.number(threshold, key, limits.THRESHOLD),) * 2
    elif math.inf in threshold:
        raise TaskError("uncertainty.force.threshold", "must be finite (no sensor is force: none)")
    angle = _degrees(inner["angle"], "uncertainty.force.angle")
    return Uncertainty(control, position, angle, threshold)


def _degrees(value: object, key: str) -> float:
    return to_radians(checks.number(value, key))


def _friction(value: object) -> float:
    if not isinstance(value, Mapping):
        return _degrees(value, "friction")
    coefficient = fields(value, "friction", ("coefficient",))["coefficient"]
    key = "friction.coefficient"
    return representable(math.atan(checks.number(coefficient, key, limits.COEFFICIENT)))


def _initial(value: object) -> Initial:
    if value == "everywhere":
        return Everywhere()
    if not isinstance(value, Mapping):
        raise TaskError("initial", f"must be everywhere or a mapping, not {shown(value)}")
    kind, inner = one_field(value, "initial", INITIAL)
    if kind == "disc":
        disc = fields(inner, "initial.disc", ("center", "radius"))
        return InitialDisc(disc["center"], disc["radius"])
    if kind == "point":
        return InitialPoint(inner)
    return InitialPolygon(inner) if kind == "polygon" else InitialEdges(inner)


def _goal(value: object) -> Goal:
    mapping = fields(value, "goal", (), GOAL)
    return Goal(**mapping)


def _options(value: object) -> PlannerOptions:
    mapping = dict(fields(value, "planner", (), PLANNER))
    if "directions" in mapping:
        mapping["directions"] = _directions(mapping["directions"])
    if mapping.get("time_limit") == NONE:
        mapping["time_limit"] = None
    elif "time_limit" in mapping:
        checks.number(mapping["time_limit"], "planner.time_limit", limits.TIME_LIMIT)
    if "resolution" in mapping:
        mapping["resolution"] = _degrees(mapping["resolution"], "planner.resolution")
    return PlannerOptions(**mapping)


def _directions(value: object) -> Directions:
    key = "planner.directions"
    if value == CONTINUOUS:
        return Continuous()
    if isinstance(value, list | tuple):
        return tuple(
            _degrees(direction, f"{key}[{index}]") for index, direction in enumerate(value)
        )
    if not checks.is_number(value):
        rule = f"must be an even number, a list of degrees or continuous, not {shown(value)}"
        raise TaskError(key, rule)
    count = checks.integer(value, key, limits.DIRECTIONS)
    if count % 2:
        raise TaskError(key, f"must be even, not {count}")
    return uniform_directions(count)
