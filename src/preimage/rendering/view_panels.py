"""Views as figures: each becomes a panel, on the ground that its task's scene gives."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.text import Text

from preimage.configuration.region import Region
from preimage.rendering.glyphs import HEAD, arrow, draw_direction, draw_friction_cones
from preimage.rendering.lanes import Lanes
from preimage.rendering.layers import draw_lines, draw_rays, draw_region
from preimage.rendering.legend import WAYS
from preimage.rendering.names import SIZE, draw_edge_numbers, draw_name, draw_start_name
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import Panel
from preimage.rendering.scene import Scene, draw_scene
from preimage.rendering.sheet import Plate, compose
from preimage.rendering.style import INK, MARKS, PAPER, SOLID, Layer
from preimage.rendering.views import Line, Place, View, Views

NOTE_SIZE, MARK_SIZE = 3.6, 6.5
"""Points: dots of places, and the markers of those whose layer has one."""

LINE_COST = 6.0
"""What it costs to write over a cell of a line."""


def views_figure(subject: Views, options: PictureOptions) -> Figure:
    """The figure of composed views: a panel for each."""
    scenes = [Scene.of(view.task, view.space) for view in subject.views]
    plates = [
        Plate(
            f"view-{number + 1}", view.heading, view.detail,
            partial(_paint, view=view, scene=scene, options=options),
            compass=view.direction is not None,
        )
        for number, (view, scene) in enumerate(zip(subject.views, scenes, strict=True))
    ][: options.max_panels]  # fmt: skip
    words = dict(subject.words)
    return compose(scenes[0], plates, subject.title, options, words=words, command=subject.command)


def _paint(panel: Panel, view: View, scene: Scene, options: PictureOptions) -> None:
    lanes = Lanes(scene.space.contact, scene.space.tolerance.length)
    panel = replace(panel, space=scene.space, lanes=lanes)  # the sheet's is that of the first view
    drawn = scene if view.goal else Scene(scene.space, scene.task, None, scene.start)
    draw_scene(panel, drawn, start=view.start)
    for part in view.parts:
        draw_region(panel, part.layer, part.region, plain=part.plain)
        if options.friction_cones and part.layer is Layer.TARGET:
            draw_friction_cones(panel, scene, part.region)
    for line in view.lines:
        _draw_line(panel, line)
    for place in view.places:
        _draw_place(panel, place)
    if options.edge_numbers:
        draw_edge_numbers(panel)
    if options.names:
        _write_names(panel, view, drawn)
    if view.direction is not None:
        draw_direction(panel, view.direction, view.task.uncertainty.control)


def _draw_line(panel: Panel, line: Line) -> None:
    points = line.points
    pieces = np.stack((points[:-1], points[1:]), axis=1)
    if line.layer is Layer.RAY:
        draw_rays(panel, pieces)
    elif line.layer is Layer.NAME:
        draw_lines(panel, Layer.NAME, pieces, "line", INK, 0.7, SOLID, 7.9)
    else:
        color, width = WAYS.get(line.layer, (INK, 1.0))
        draw_lines(panel, line.layer, pieces, "", color, max(width, 1.2), SOLID, 7.9)
    panel.lattice.cost += LINE_COST * panel.lattice.along(pieces[:, 0], pieces[:, 1])
    if line.arrow:
        _draw_head(panel, line)


def _draw_head(panel: Panel, line: Line) -> None:
    """An arrow's head at the end, as the line comes in over the head's length."""
    head = (HEAD[0] * panel.unit, HEAD[1] * panel.unit)
    tip = line.points[-1]
    far = np.flatnonzero(np.hypot(*(line.points - tip).T) >= head[0])
    if not len(far):
        return
    outline = arrow(line.points[far[-1]], tip, head, panel.unit)[1:-1]  # the head alone
    color = WAYS.get(line.layer, (INK, 1.0))[0]
    panel.add(Polygon(outline, facecolor=color, linewidth=0.0, zorder=7.95), line.layer, "head")


def _draw_place(panel: Panel, place: Place) -> None:
    if place.layer is Layer.NAME:
        return
    shape, color = MARKS.get(place.layer, ("o", INK)) if place.layer else ("o", INK)
    marked = place.layer in MARKS
    x, y = place.at
    dot = Line2D(
        [x], [y], linestyle="none", marker=shape, color=color, markeredgecolor=PAPER,
        markersize=MARK_SIZE if marked else NOTE_SIZE, markeredgewidth=0.5, zorder=9.0,
        clip_on=False,
    )  # fmt: skip
    panel.add(dot, place.layer or Layer.NAME, "place")
    side = (MARK_SIZE if marked else NOTE_SIZE) * panel.unit
    panel.lattice.take(x, y, side, side)


def _write_names(panel: Panel, view: View, scene: Scene) -> None:
    """All letters, those of points first: they have the least choice of where to stand."""
    if view.start:
        draw_start_name(panel, scene)
    for place in view.places:
        if place.name:
            _write(panel, place.name, place.at, on=place.layer is Layer.NAME)
    for line in view.lines:
        if line.name:
            gaps = np.hypot(*np.diff(line.points, axis=0).T)
            first = int(np.argmax(gaps))
            middle = 0.5 * (line.points[first] + line.points[first + 1])
            _write(panel, line.name, (float(middle[0]), float(middle[1])))
    if view.goal_name and scene.goal is not None:
        draw_name(panel, view.goal_name, Layer.GOAL, scene.goal)
    for part in view.parts:
        if part.name:
            draw_name(panel, part.name, part.layer, part.region)


def _write(panel: Panel, words: str, at: tuple[float, float], *, on: bool = False) -> None:
    """Write a letter beside a point, or on it if that is where it should stand."""
    if not on:
        draw_name(panel, words, Layer.GOAL, Region.empty(), np.array(at))
        return
    text = Text(*at, words, fontsize=9.5, color=INK, ha="center", va="center", zorder=10.0)
    text.set_bbox({"facecolor": PAPER, "alpha": 0.78, "edgecolor": "none", "pad": 1.0})
    panel.add(text, Layer.NAME, "label")
    panel.lattice.take(*at, SIZE[0] * panel.unit, SIZE[1] * panel.unit)
