"""Tasks drawn and imported again: the same configuration space, goal and start."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf.filemanagement
import numpy as np
import pytest

from preimage.configuration.goals import goal_region
from preimage.configuration.obstacles import configuration_space
from preimage.configuration.start import start_region
from preimage.exchange.importing import import_task
from preimage.geometry import area as areas
from preimage.task.examples import named_task, named_tasks
from preimage.task.initial import Everywhere, InitialDisc, InitialEdges, InitialPoint
from preimage.task.task import Task
from preimage.task.workspace import ChainObstacle, PolygonObstacle, SolidSide

Part = tuple[str, str, list[list[tuple[float, float]]], dict[str, Any]]


def parts_of(task: Task) -> list[Part]:
    """Role, kind, rings or points, and properties."""
    found: list[Part] = []
    for obstacle in task.workspace.obstacles:
        if isinstance(obstacle, ChainObstacle):
            solid = {"solid": obstacle.solid.value}
            found.append(("obstacle", "line", [list(obstacle.points)], solid))
        else:
            rings = [list(obstacle.exterior), *map(list, obstacle.holes)]
            found.append(("obstacle", "area", rings, {}))
    if task.robot.polygon is not None:
        found.append(("robot", "area", [list(task.robot.polygon)], {}))
        found.append(("reference", "point", [[task.robot.reference]], {}))
    match task.initial:
        case InitialPoint(point=point):
            found.append(("start", "point", [[point]], {}))
        case InitialDisc(center=center, radius=radius):
            found.append(("start", "point", [[center]], {"radius": radius}))
        case InitialEdges(edges=edges):
            found += [("start", "line", [list(edge)], {}) for edge in edges]
        case Everywhere():
            pass
        case polygon:
            found.append(("start", "area", [list(polygon.vertices)], {}))
    found += [("goal", "line", [list(edge)], {}) for edge in task.goal.edges]
    found += [("goal", "area", [list(ring)], {}) for ring in task.goal.polygons]
    found += [("goal", "point", [[point]], {}) for point in task.goal.points]
    return found


def write_geojson(parts: list[Part], path: Path) -> None:
    def geometry(kind: str, rings: list[list[tuple[float, float]]]) -> dict[str, Any]:
        if kind == "point":
            return {"type": "Point", "coordinates": rings[0][0]}
        if kind == "line":
            return {"type": "LineString", "coordinates": rings[0]}
        return {"type": "Polygon", "coordinates": [[*ring, ring[0]] for ring in rings]}

    features = [
        {
            "type": "Feature",
            "properties": {"role": role, **more},
            "geometry": geometry(kind, rings),
        }
        for role, kind, rings, more in parts
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))


def write_wkt(parts: list[Part], path: Path) -> None:
    def listed(points: list[tuple[float, float]]) -> str:
        return "(" + ", ".join(f"{x!r} {y!r}" for x, y in points) + ")"

    lines = []
    for role, kind, rings, _ in parts:
        if kind == "area":
            words = "POLYGON (" + ", ".join(listed([*ring, ring[0]]) for ring in rings) + ")"
        else:
            words = ("POINT " if kind == "point" else "LINESTRING ") + listed(rings[0])
        lines.append(f"{role}: {words}\n")
    path.write_text("".join(lines))


def write_dxf(parts: list[Part], path: Path) -> None:
    document = ezdxf.filemanagement.new("R2010")
    space = document.modelspace()
    for role, kind, rings, more in parts:
        on = {"layer": role.upper()}
        if "radius" in more:
            space.add_circle(rings[0][0], more["radius"], dxfattribs=on)
        elif kind == "point":
            space.add_point(rings[0][0], dxfattribs=on)
        else:
            for ring in rings:
                space.add_lwpolyline(ring, close=kind == "area", dxfattribs=on)
    document.saveas(path)


def write_svg(parts: list[Part], path: Path) -> None:
    def data(points: list[tuple[float, float]], close: str) -> str:
        return "M" + " L".join(f"{x!r},{-y!r}" for x, y in points) + close

    lines = ['<svg xmlns="http://www.w3.org/2000/svg">']
    for role, kind, rings, more in parts:
        if kind == "point":  # a circle of no size
            (x, y), radius = rings[0][0], more.get("radius", 0.0)
            lines.append(f'<circle class="{role}" cx="{x!r}" cy="{-y!r}" r="{radius!r}"/>')
        else:
            close = " Z" if kind == "area" else ""
            words = " ".join(data(ring, close) for ring in rings)
            lines.append(f'<path class="{role}" fill-rule="evenodd" fill="none" d="{words}"/>')
    path.write_text("\n".join([*lines, "</svg>"]))


WRITERS: dict[str, Callable[[list[Part], Path], None]] = {
    "geojson": write_geojson,
    "wkt": write_wkt,
    "dxf": write_dxf,
    "svg": write_svg,
}


def solid_sides(task: Task) -> set[SolidSide]:
    return {one.solid for one in task.workspace.obstacles if isinstance(one, ChainObstacle)}


def can_tell(name: str, ending: str) -> bool:
    """Whether a format has all that there is in a task."""
    task = named_task(name)
    obstacles = task.workspace.obstacles
    holes = any(isinstance(one, PolygonObstacle) and one.holes for one in obstacles)
    if ending != "geojson" and len(solid_sides(task)) > 1:
        return False
    if ending == "wkt" and isinstance(task.initial, InitialDisc):
        return False
    return not (ending == "dxf" and holes)


CASES = [(name, ending) for name in named_tasks() for ending in WRITERS if can_tell(name, ending)]


@pytest.mark.parametrize(("name", "ending"), CASES)
def test_a_task_that_is_drawn_comes_back(tmp_path: Path, name: str, ending: str) -> None:
    task = named_task(name)
    workspace = task.workspace
    path = tmp_path / f"drawing.{ending}"
    WRITERS[ending](parts_of(task), path)
    found = import_task(
        path,
        window=workspace.window.bounds,
        walls=workspace.walls,
        chains=next(iter(solid_sides(task)), None),
        initial=task.initial if isinstance(task.initial, Everywhere) else None,
        friction=math.pi / 4,
    ).task
    before, after = configuration_space(task), configuration_space(found)
    slack = 1e-9 * workspace.window.scale**2
    for a, b in ((before.free, after.free), (after.free, before.free)):
        assert areas.difference(a, b).measure <= slack
    ours, theirs = goal_region(task, before), goal_region(found, after)
    assert theirs.area.measure == pytest.approx(ours.area.measure, abs=slack)
    assert len(theirs.contact.vertices) == len(ours.contact.vertices)
    lengths = [float(np.sum(one.contact.high - one.contact.low)) for one in (ours, theirs)]
    assert lengths[1] == pytest.approx(lengths[0])
    first, second = start_region(task, before), start_region(found, after)
    assert first.kind is second.kind
    assert first.point == second.point
    assert second.region.area.measure == pytest.approx(first.region.area.measure, abs=slack)
    assert found.friction == pytest.approx(math.pi / 4)
