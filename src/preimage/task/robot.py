"""The robot: a point, or a polygon that translates."""

from __future__ import annotations

from dataclasses import dataclass

from preimage.errors import TaskError
from preimage.task import checks, limits
from preimage.task.checks import Point
from preimage.task.rings import Ring, turned


@dataclass(frozen=True, slots=True)
class Robot:
    """A simple polygon `A` with a reference point, or a point.

    Parameters
    ----------
    polygon : the vertices, turned counter-clockwise; `None` for a point.
    reference : the point whose position is the robot's configuration; it may lie outside. A point
        robot is its own.

    Raises
    ------
    TaskError : if the polygon is not simple.

    >>> Robot(((0, 0), (0, 2), (2, 2), (2, 0)), (1, 1)).shape
    ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    """

    polygon: Ring | None = None
    reference: Point = (0.0, 0.0)

    def __post_init__(self) -> None:
        """Refuse what is not simple, and turn the rest."""
        object.__setattr__(self, "reference", checks.point(self.reference, "robot.reference"))
        if self.polygon is None:
            object.__setattr__(self, "reference", (0.0, 0.0))
            return
        polygon = checks.points(self.polygon, "robot.polygon")
        if len(polygon) > limits.MAX_ROBOT_VERTICES:
            most = limits.MAX_ROBOT_VERTICES
            rule = f"must have {most} vertices or fewer, not {len(polygon)}"
            raise TaskError("robot.polygon", rule)
        object.__setattr__(self, "polygon", turned([polygon], ["robot.polygon"])[0])

    @property
    def is_point(self) -> bool:
        """Whether it has no extent."""
        return self.polygon is None

    @property
    def shape(self) -> Ring:
        """Its vertices with the reference point moved to the origin; one vertex for a point."""
        if self.polygon is None:
            return ((0.0, 0.0),)
        x, y = self.reference
        return tuple((px - x, py - y) for px, py in self.polygon)
