"""The task: what the planner is given, whole."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum

from preimage.display import Shown
from preimage.errors import TaskError, shown
from preimage.task import checks, limits
from preimage.task.goal import Goal
from preimage.task.initial import (
    Everywhere,
    Initial,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
)
from preimage.task.options import PlannerOptions
from preimage.task.rings import Ring, check_distance, check_thickness
from preimage.task.robot import Robot
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import Workspace


class SlidingLaw(Enum):
    """How fast the robot slides (theory 2): only the time bounds of a plan differ."""

    PROJECTION = "projection"
    DAMPER = "damper"


@dataclass(frozen=True, slots=True, kw_only=True)
class Task(Shown):
    """A motion planning problem with uncertainty (theory 1 to 3). Angles are radians.

    Parameters
    ----------
    name : a word or two for people.
    workspace : window, walls and obstacles.
    robot : a point or a translating polygon.
    uncertainty : the errors of control and sensing.
    friction : half-angle φ of the friction cone, in `[0, π/2]`.
    sliding : the law of sliding.
    initial : where the robot may start.
    goal : where it should end.
    options : what the planner may do.

    Raises
    ------
    TaskError : if the window does not resolve the robot, the start or the goal.
    """

    name: str = "task"
    workspace: Workspace
    robot: Robot = field(default_factory=Robot)
    uncertainty: Uncertainty
    friction: float = 0.0
    sliding: SlidingLaw = SlidingLaw.PROJECTION
    initial: Initial
    goal: Goal
    options: PlannerOptions = field(default_factory=PlannerOptions)

    def __post_init__(self) -> None:
        """Refuse parts that do not go together."""
        object.__setattr__(self, "name", checks.text(self.name, "name", limits.MAX_NAME))
        for key, kind in (
            ("workspace", Workspace),
            ("robot", Robot),
            ("uncertainty", Uncertainty),
            ("initial", Initial),
            ("goal", Goal),
            ("options", PlannerOptions),
        ):
            if not isinstance(getattr(self, key), kind):
                raise TaskError(key, f"is {shown(getattr(self, key))}")
        friction = checks.angle(self.friction, "friction", limits.FRICTION)
        object.__setattr__(self, "friction", friction)
        sliding = checks.choice(self.sliding, "sliding", SlidingLaw)
        object.__setattr__(self, "sliding", sliding)
        window = self.workspace.window
        for closed in (True, False):
            parts = [(key, ring) for key, ring, ends in _rings(self) if ends == closed]
            keys, rings = [key for key, _ in parts], [ring for _, ring in parts]
            check_distance(rings, keys, window.scale / limits.RESOLUTION)
            check_thickness(rings, keys, window.tolerance.length, closed)
        if isinstance(self.initial, InitialDisc):
            least = limits.Range(window.tolerance.length, limits.MAX_COORDINATE, low_open=True)
            checks.number(self.initial.radius, "initial.disc.radius", least)


def _rings(task: Task) -> Iterator[tuple[str, Ring, bool]]:
    """Robot, start and goal: polygons, edges and points by key, and whether they are closed."""
    if task.robot.polygon is not None:
        yield "robot.polygon", task.robot.shape, True
    if isinstance(task.initial, InitialPoint):
        yield "initial.point", (task.initial.point,), False
    elif isinstance(task.initial, InitialDisc):
        yield "initial.disc.center", (task.initial.center,), False
        yield "initial.disc.radius", ((task.initial.radius, 0.0),), False
    elif isinstance(task.initial, InitialPolygon):
        yield "initial.polygon", task.initial.vertices, True
    elif isinstance(task.initial, InitialEdges):
        for index, edge in enumerate(task.initial.edges):
            yield f"initial.edges[{index}]", edge, False
    for index, edge in enumerate(task.goal.edges):
        yield f"goal.edges[{index}]", edge, False
    for index, polygon in enumerate(task.goal.polygons):
        yield f"goal.polygons[{index}]", polygon, True
    for index, point in enumerate(task.goal.points):
        yield f"goal.points[{index}]", (point,), False


__all__ = [
    "Everywhere",
    "Goal",
    "Initial",
    "InitialDisc",
    "InitialEdges",
    "InitialPoint",
    "InitialPolygon",
    "SlidingLaw",
    "Task",
]
