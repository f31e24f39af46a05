"""Pictures that somebody composes: panels with chosen regions, letters and lines in a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.errors import InputError, shown
from preimage.geometry.area import Area
from preimage.rendering.style import REGIONS, Layer
from preimage.task.task import Task

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A region in a view.

    Parameters
    ----------
    layer : whose style it is drawn in.
    name : a letter written in or beside it; may be empty.
    plain : where its area is not hatched, since something else is.
    """

    layer: Layer
    region: Region
    name: str = ""
    plain: Area | None = None

    def __post_init__(self) -> None:
        """Refuse layers in which no region is drawn."""
        if self.layer not in REGIONS:
            raise InputError("view.layer", f"must be that of a region, not {self.layer.value}")


@dataclass(frozen=True, slots=True)
class Place:
    """A point of note: a dot, and a letter beside it.

    Parameters
    ----------
    name : the letter; may be empty.
    layer : one that has a marker, which is drawn for the dot; NAME for the letter alone.
    """

    at: tuple[float, float]
    name: str = ""
    layer: Layer | None = None

    def __post_init__(self) -> None:
        """Refuse what is nowhere."""
        if np.shape(self.at) != (2,) or not np.isfinite(self.at).all():
            raise InputError("view.place", f"must be two finite numbers, not {shown(self.at)}")


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A line of note.

    Parameters
    ----------
    points : (n, 2).
    name : a letter written beside the middle of its longest piece.
    layer : RAY, RUN or another that is a line; NAME for a thin one that is not in the legend.
    arrow : whether its last piece ends in an arrow's head.
    """

    points: Floats
    name: str = ""
    layer: Layer = Layer.RAY
    arrow: bool = False

    def __post_init__(self) -> None:
        """Refuse what is no line."""
        points = np.asarray(self.points, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2:
            raise InputError("view.points", f"must be at least two points, not {shown(points)}")
        if not np.isfinite(points).all():
            raise InputError("view.points", "must be finite numbers")
        object.__setattr__(self, "points", points)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class View:
    """What one panel shows.

    Parameters
    ----------
    task : whose scene is drawn, in its own window.
    space : its configuration space, if it is known already, or another that is to be seen.
    heading, detail : the panel's title, and what is said below it.
    goal : whether the task's goal is drawn.
    goal_name : the letter of the goal; may be empty.
    start : whether the start is drawn, with its letter.
    parts, places, lines : what is drawn besides, in this order.
    direction : a commanded direction, radians, drawn with its cone; None for none.
    """

    task: Task
    space: ConfigurationSpace | None = None
    heading: str = ""
    detail: str = ""
    goal: bool = True
    goal_name: str = r"$\mathcal{G}$"
    start: bool = False
    parts: tuple[Part, ...] = ()
    places: tuple[Place, ...] = ()
    lines: tuple[Line, ...] = ()
    direction: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Views:
    """Panels beside each other, with one legend.

    All are drawn to the scale of the first, whose window should hold what is to be seen of the
    others.

    Parameters
    ----------
    title : of the whole picture; may be empty.
    words : names for layers that are not the usual ones.
    command : whether the bounds on all errors go into the legend.

    Raises
    ------
    InputError : if there is no view.

    >>> from preimage import named_task
    >>> from preimage.rendering import svg
    >>> picture = Views((View(task=named_task("flat-floor"), start=True),), "The task")
    >>> "<title>The task</title>" in svg(picture)
    True
    """

    views: tuple[View, ...]
    title: str = ""
    words: Mapping[Layer, str] = field(default_factory=dict)
    command: bool = False

    def __post_init__(self) -> None:
        """Refuse a picture of nothing."""
        if not self.views:
            raise InputError("picture", "there is no view to draw")
