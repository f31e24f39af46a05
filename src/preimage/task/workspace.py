"""The workspace: a window, its walls, and the obstacles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import Enum

from preimage.errors import TaskError, shown
from preimage.geometry.tolerance import Tolerance
from preimage.task import checks, limits
from preimage.task.rings import (
    Ring,
    check_chain,
    check_crowds,
    check_distance,
    check_holes,
    check_thickness,
    reverse,
    turned,
)


class Side(Enum):
    """A side of the window."""

    LEFT = "left"
    RIGHT = "right"
    BOTTOM = "bottom"
    TOP = "top"


class SolidSide(Enum):
    """The side of a chain, seen in its direction of travel, that is solid."""

    LEFT = "left"
    RIGHT = "right"


@dataclass(frozen=True, slots=True)
class Window:
    """The box in which everything happens.

    Parameters
    ----------
    xmin, ymin, xmax, ymax : its sides, in the task's unit of length.

    Raises
    ------
    TaskError : if it is empty, or too small to be resolved.
    """

    xmin: float
    ymin: float
    xmax: float
    ymax: float

    def __post_init__(self) -> None:
        """Refuse what is no window."""
        for index, name in enumerate(("xmin", "ymin", "xmax", "ymax")):
            value = checks.number(getattr(self, name), f"window[{index}]", limits.COORDINATE)
            object.__setattr__(self, name, value)
        for low, high, names in (
            (self.xmin, self.xmax, "xmin must be below xmax"),
            (self.ymin, self.ymax, "ymin must be below ymax"),
        ):
            if not low < high:
                raise TaskError("window", f"{names}, but {low:.9g} is not below {high:.9g}")
        side = min(self.xmax - self.xmin, self.ymax - self.ymin)
        least = max(limits.MIN_WINDOW, limits.RESOLUTION * self.scale)
        if side < least:
            raise TaskError("window", f"sides must be {least:.3g} or longer, not {side:.3g}")

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """`xmin, ymin, xmax, ymax`."""
        return self.xmin, self.ymin, self.xmax, self.ymax

    @property
    def scale(self) -> float:
        """The largest of its coordinates and sides."""
        width, height = self.xmax - self.xmin, self.ymax - self.ymin
        return max(*(abs(bound) for bound in self.bounds), width, height)

    @property
    def tolerance(self) -> Tolerance:
        """What counts as equal in this window."""
        return Tolerance.for_window(*self.bounds)


@dataclass(frozen=True, slots=True)
class PolygonObstacle:
    """A polygon, solid but for its holes.

    In a `Workspace` it is simple, its exterior counter-clockwise and its holes clockwise: they
    are turned there. Collinear vertices are kept.
    """

    exterior: Ring
    holes: tuple[Ring, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what is not made of points."""
        object.__setattr__(self, "exterior", checks.points(self.exterior, "polygon"))
        holes = tuple(
            checks.points(hole, f"holes[{index}]")
            for index, hole in enumerate(checks.items(self.holes, "holes"))
        )
        object.__setattr__(self, "holes", holes)

    @property
    def rings(self) -> Iterator[tuple[str, Ring]]:
        """Exterior and holes, each with its key."""
        yield "polygon", self.exterior
        for index, hole in enumerate(self.holes):
            yield f"holes[{index}]", hole


@dataclass(frozen=True, slots=True)
class ChainObstacle:
    """A half-plane bounded by a simple chain, whose end edges run on for ever.

    Parameters
    ----------
    points : two points or more, in the direction of travel.
    solid : the side of the chain that is solid.
    """

    points: Ring
    solid: SolidSide

    def __post_init__(self) -> None:
        """Refuse what is not made of points."""
        object.__setattr__(self, "points", checks.points(self.points, "chain"))
        object.__setattr__(self, "solid", checks.choice(self.solid, "solid", SolidSide))

    @property
    def rings(self) -> Iterator[tuple[str, Ring]]:
        """The chain, with its key."""
        yield "chain", self.points


Obstacle = PolygonObstacle | ChainObstacle


@dataclass(frozen=True, slots=True)
class Workspace:
    """A window with obstacles, which may overlap each other and reach beyond the window.

    Parameters
    ----------
    window : bounds the reference point of the robot.
    walls : the sides of the window that are walls; the others are open.
    obstacles : polygons and chains.

    Raises
    ------
    TaskError : if an obstacle is not simple, or not resolved by the window.
    """

    window: Window
    walls: frozenset[Side] = frozenset()
    obstacles: tuple[Obstacle, ...] = ()

    def __post_init__(self) -> None:
        """Refuse obstacles that are not simple, and turn the others."""
        if not isinstance(self.window, Window):
            raise TaskError("window", f"must be a window, not {shown(self.window)}")
        walls = frozenset(checks.choice(wall, "walls", Side) for wall in self.walls)
        object.__setattr__(self, "walls", walls)
        for index, obstacle in enumerate(self.obstacles):
            if not isinstance(obstacle, PolygonObstacle | ChainObstacle):
                raise TaskError(f"obstacles[{index}]", f"is {shown(obstacle)}")
        total = sum(len(ring) for obstacle in self.obstacles for _, ring in obstacle.rings)
        limits.check_count(total, "obstacles")
        object.__setattr__(self, "obstacles", tuple(_turn_obstacles(self.obstacles)))
        _check_resolution(self)


def _turn_obstacles(obstacles: tuple[Obstacle, ...]) -> Iterator[Obstacle]:
    """The obstacles, polygons turned; refused if they are not simple."""
    groups = [[ring for _, ring in obstacle.rings] for obstacle in obstacles]
    check_crowds(groups, [f"obstacles[{index}]" for index in range(len(obstacles))])
    keys, rings = _rings(obstacles, PolygonObstacle)
    upright = iter(turned(rings, keys))
    for index, obstacle in enumerate(obstacles):
        key = f"obstacles[{index}]"
        if isinstance(obstacle, ChainObstacle):
            check_chain(obstacle.points, f"{key}.chain")
            yield obstacle
            continue
        exterior = next(upright)
        holes = tuple(reverse(next(upright)) for _ in obstacle.holes)
        if holes:
            check_holes(obstacle.exterior, obstacle.holes, key)
        if (exterior, holes) == (obstacle.exterior, obstacle.holes):
            yield obstacle
        else:
            yield replace(obstacle, exterior=exterior, holes=holes)


def _check_resolution(workspace: Workspace) -> None:
    window = workspace.window
    for kind in (PolygonObstacle, ChainObstacle):
        keys, rings = _rings(workspace.obstacles, kind)
        check_distance(rings, keys, window.scale / limits.RESOLUTION)
        check_thickness(rings, keys, window.tolerance.length, kind is PolygonObstacle)


def _rings(obstacles: tuple[Obstacle, ...], kind: type[Obstacle]) -> tuple[list[str], list[Ring]]:
    keys: list[str] = []
    rings: list[Ring] = []
    for index, obstacle in enumerate(obstacles):
        if isinstance(obstacle, kind):
            for key, ring in obstacle.rings:
                keys.append(f"obstacles[{index}].{key}")
                rings.append(ring)
    return keys, rings
