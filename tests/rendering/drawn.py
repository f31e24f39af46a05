"""Tasks to draw, and a reader of what was drawn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.preimages.methods import preimage
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.strategy.strategy import Motion, Statistics, Status, Strategy, StrategyRegion
from preimage.task import Method, StrategyKind, Task, parse_task

Floats = NDArray[np.float64]

DOWN = math.radians(270)


def task(**changes: Any) -> Task:
    """A box on whose top the goal lies, in a window with two walls, unless changed."""
    data = {
        "version": 1,
        "name": "box",
        "window": [-10, -8, 10, 8],
        "walls": ["left", "bottom"],
        "obstacles": [
            {"polygon": [[-4, -3], [4, -3], [4, 0], [-4, 0]]},
            {"polygon": [[2, -12], [14, -12], [14, 0]]},
        ],
        "uncertainty": {
            "control": 12,
            "position": 0.5,
            "force": {"angle": 10, "threshold": 0.05},
        },
        "friction": 20,
        "initial": {"point": [0, 5]},
        "goal": {"polygons": [[[-3, 0], [3, 0], [3, 3], [-3, 3]]]},
    }
    return parse_task(data | changes)


def preimage_of(given: Task, direction: float = DOWN, method: Method = Method.COMBINED) -> Preimage:
    setting = Setting.of(given)
    return preimage(setting, goal_region(given, setting.space), direction, method)


def strategy(
    given: Task, count: int, status: Status = Status.SOLVED, linear: bool = True
) -> Strategy:
    """A strategy of that many motions, not one that a planner would find."""
    space = configuration_space(given)
    setting, goal = Setting.of(given, space), goal_region(given, space)
    regions = [StrategyRegion(0, 0, goal, None)]
    for number in range(1, count + 1):
        direction = DOWN + math.radians(7 * (number - 1))
        made = preimage(setting, goal, direction, Method.COMBINED)
        motion = Motion(direction, (number - 1,), made.target.region, made.termination)
        regions.append(StrategyRegion(number, number, made.region, motion))
    solved = status is Status.SOLVED
    return Strategy(
        task=given,
        space=space,
        status=status,
        kind=StrategyKind.LINEAR if linear else StrategyKind.CONDITIONAL,
        regions=tuple(regions),
        start=(count,) if solved else (),
        steps=tuple(range(count, 0, -1)) if solved and linear else (),
        statistics=Statistics(),
        reason="the time limit of 1 s came first" if status is Status.STOPPED else "",
    )


def artists(figure: Figure, panel: str) -> dict[str, Artist]:
    """All that is drawn in a panel, by its name without the panel's."""
    axes = next(axes for axes in figure.axes if axes.get_gid() == panel)
    named = {str(artist.get_gid()): artist for artist in axes.get_children() if artist.get_gid()}
    assert all(name.startswith(panel + "-") for name in named)
    return {name.removeprefix(panel + "-"): artist for name, artist in named.items()}


def panels(figure: Figure) -> list[str]:
    return [str(axes.get_gid()) for axes in figure.axes]


def points(artist: Artist) -> Floats:
    """The points that an artist is made of, in the unit of the task."""
    if isinstance(artist, PathPatch):
        return np.asarray(artist.get_path().vertices, dtype=np.float64)
    if isinstance(artist, LineCollection):
        return np.concatenate([np.asarray(line) for line in artist.get_segments()])
    assert isinstance(artist, Line2D)
    return np.asarray(artist.get_xydata(), dtype=np.float64)


def rings(path: Path) -> Iterator[Floats]:
    """The closed rings of a path."""
    vertices, codes = np.asarray(path.vertices), np.asarray(path.codes)
    starts = np.flatnonzero(codes == Path.MOVETO)
    for start, stop in zip(starts, [*starts[1:], len(vertices)], strict=True):
        assert codes[stop - 1] == Path.CLOSEPOLY
        yield vertices[start : stop - 1]


def measure(artist: Artist) -> float:
    """The area that a patch fills, holes left out."""
    assert isinstance(artist, PathPatch)
    total = 0.0
    for ring in rings(artist.get_path()):
        x, y = ring.T
        total += 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    return total


def words(figure: Figure) -> str:
    """All text beside the panels: title, headings, legend."""
    texts = [text.get_text() for text in figure.texts]
    for legend in figure.legends:
        texts += [text.get_text() for text in legend.get_texts()]
    return " ".join(texts)
