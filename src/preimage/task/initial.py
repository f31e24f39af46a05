"""Where the robot may start."""

from __future__ import annotations

from dataclasses import dataclass

from preimage.task import checks, limits
from preimage.task.checks import Point, Segment
from preimage.task.rings import Ring, turned


@dataclass(frozen=True, slots=True)
class InitialPoint:
    """One configuration: free, or in contact."""

    point: Point

    def __post_init__(self) -> None:
        """Refuse what is no point."""
        object.__setattr__(self, "point", checks.point(self.point, "initial.point"))


@dataclass(frozen=True, slots=True)
class InitialDisc:
    """The valid configurations in a closed disc.

    Parameters
    ----------
    center : its middle.
    radius : above 0, in the unit of length.
    """

    center: Point
    radius: float

    def __post_init__(self) -> None:
        """Refuse what is no disc."""
        object.__setattr__(self, "center", checks.point(self.center, "initial.disc.center"))
        radius = checks.number(self.radius, "initial.disc.radius", limits.RADIUS)
        object.__setattr__(self, "radius", radius)


@dataclass(frozen=True, slots=True)
class InitialPolygon:
    """The valid configurations in a simple polygon, counter-clockwise."""

    vertices: Ring

    def __post_init__(self) -> None:
        """Refuse what is not simple, and turn the rest."""
        key = "initial.polygon"
        vertices = checks.points(self.vertices, key)
        limits.check_count(len(vertices), key)
        object.__setattr__(self, "vertices", turned([vertices], [key])[0])


@dataclass(frozen=True, slots=True)
class InitialEdges:
    """Parts of contact space: edges, each between two points."""

    edges: tuple[Segment, ...]

    def __post_init__(self) -> None:
        """Refuse what is not made of edges."""
        edges = checks.segments(self.edges, "initial.edges", least=1)
        limits.check_count(2 * len(edges), "initial.edges")
        object.__setattr__(self, "edges", edges)


@dataclass(frozen=True, slots=True)
class Everywhere:
    """All valid configurations."""


Initial = InitialPoint | InitialDisc | InitialPolygon | InitialEdges | Everywhere
