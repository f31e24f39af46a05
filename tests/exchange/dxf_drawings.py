"""DXF drawings made by ezdxf, and what is read of them; shared by the tests of this format."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf.filemanagement
import shapely

from preimage.errors import InputError
from preimage.exchange.importing import Imported, import_task
from preimage.task.goal import Goal
from preimage.task.initial import Everywhere

GOAL = Goal(polygons=(((-90, -90), (-80, -90), (-80, -80), (-90, -80)),))
ABOVE = Goal(polygons=(((-5, 80), (5, 80), (5, 90)),))
BELOW = Goal(polygons=(((-5, -90), (5, -90), (5, -80)),))
WINDOW = (-100.0, -100.0, 100.0, 100.0)

Draw = Callable[[Any], object]


def drawn(folder: Path, draw: Draw, units: int = 0) -> Path:
    document = ezdxf.filemanagement.new("R2010")
    document.units = units
    draw(document.modelspace())
    path = folder / "drawing.dxf"
    document.saveas(path)
    return path


def read(path: Path, **options: Any) -> Imported:
    given = {"initial": Everywhere(), "goal": GOAL, "window": WINDOW, **options}
    return import_task(path, **given)


def read_or_refuse(path: Path, **options: Any) -> Imported | str:
    try:
        return read(path, **options)
    except InputError as error:
        return str(error)


def solids(found: Imported) -> shapely.Geometry:
    return shapely.union_all(
        [shapely.Polygon(one.exterior, one.holes) for one in found.task.workspace.obstacles]  # type: ignore[union-attr]
    )


ON = {"layer": "obstacles"}


def square(space: Any, layer: str = "obstacles", size: float = 10.0, **more: Any) -> object:
    corners = [(0, 0), (size, 0), (size, size), (0, size)]
    for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
        space.add_line(a, b, dxfattribs={"layer": layer, **more})
    return space


def sampled_bulge(
    a: tuple[float, float], b: tuple[float, float], bulge: float
) -> list[tuple[float, float]]:
    """Points of a bulge by the angle at its ends: the oracle, independent of `Arc`."""
    if bulge == 0.0:
        return [a]
    chord = complex(b[0] - a[0], b[1] - a[1])
    angle = 4 * math.atan(bulge)
    spots = []
    for k in range(100):
        part = angle * k / 100
        # the chord from the start to the point after `part` of the angle
        at = (
            chord
            * math.sin(part / 2)
            / math.sin(angle / 2)
            * complex(math.cos((part - angle) / 2), math.sin((part - angle) / 2))
        )
        spots.append((a[0] + at.real, a[1] + at.imag))
    return spots
