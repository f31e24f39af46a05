"""Where the robot should end."""

from __future__ import annotations

from dataclasses import dataclass

from preimage.errors import TaskError
from preimage.task import checks, limits
from preimage.task.checks import Point, Segment
from preimage.task.rings import Ring, turned


@dataclass(frozen=True, slots=True)
class Goal:
    """A set of configurations, of one or many components.

    Parameters
    ----------
    edges : parts of contact space, with their end vertices.
    polygons : simple, counter-clockwise; with the contact space inside and on the border.
    points : contact vertices.

    Raises
    ------
    TaskError : if there is no component, or a polygon is not simple.
    """

    edges: tuple[Segment, ...] = ()
    polygons: tuple[Ring, ...] = ()
    points: tuple[Point, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what is no goal, and turn its polygons."""
        edges = checks.segments(self.edges, "goal.edges")
        given = checks.items(self.polygons, "goal.polygons")
        keys = [f"goal.polygons[{index}]" for index in range(len(given))]
        polygons = [checks.points(ring, key) for ring, key in zip(given, keys, strict=True)]
        points = checks.points(self.points, "goal.points")
        if not edges and not polygons and not points:
            raise TaskError("goal", "must have an edge, a polygon or a point")
        limits.check_count(2 * len(edges) + sum(map(len, polygons)) + len(points), "goal")
        object.__setattr__(self, "edges", edges)
        object.__setattr__(self, "polygons", turned(polygons, keys))
        object.__setattr__(self, "points", points)
