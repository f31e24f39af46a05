"""Pictures of compass roses: which directions lead to the goal, and from where (theory 7)."""

from __future__ import annotations

import math

from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Wedge

from preimage.geometry.angles import unit
from preimage.rendering.options import PictureOptions
from preimage.rendering.panel import Panel
from preimage.rendering.scene import Scene, draw_scene
from preimage.rendering.sheet import Plate, compose
from preimage.rendering.style import BLUE, FADED, INK, ORANGE, PAPER, SMALL_SIZE, Layer
from preimage.search.compass import Compass, Rose
from preimage.search.directions import Arc, Verdict
from preimage.task.degrees import to_degrees

LARGE, SMALL = 30.0, 9.0
"""Points: the radius of a rose that matters, and the largest radius of one of a grid."""

NARROWEST = 1.2
"""Degrees: what is narrower is drawn as a line."""


def compass_figure(compass: Compass, options: PictureOptions) -> Figure:
    """The figure of roses in the scene of their task."""
    scene = Scene.of(compass.task, compass.space)

    def paint(panel: Panel) -> None:
        draw_scene(panel, scene)
        radius = _small(compass, panel)
        room = LARGE * panel.unit + radius
        for number, rose in enumerate(compass.grid):
            if all(math.dist(rose.point, other.point) > room for other in compass.roses):
                _draw_rose(panel, rose, radius, number)
        for number, rose in enumerate(compass.roses):
            _draw_rose(panel, rose, LARGE * panel.unit, len(compass.grid) + number)
            _mark_widest(panel, rose, options.names and len(compass.roses) > 1)

    plate = Plate("compass", "Directions that solve in one motion", _detail(compass), paint)
    title = compass.task.name.replace("$", r"\$")
    return compose(scene, [plate], title, options, command=True)


def _detail(compass: Compass) -> str:
    """What the roses say, in a few words."""
    if len(compass.roses) != 1:
        return ""
    arcs = compass.roses[0].solving
    if not arcs:
        return "no direction is known to"
    return f"the widest: {_words(arcs[0])}"


def _words(arc: Arc) -> str:
    return f"{to_degrees(arc.widest):.4g}° ± {to_degrees(arc.margin):.3g}°"


def _small(compass: Compass, panel: Panel) -> float:
    """The radius of a grid's roses, which do not touch, in the unit of length."""
    radius = SMALL * panel.unit
    points = [rose.point for rose in compass.grid]
    if len(points) > 1:
        nearest = min(
            math.dist(one, other) for place, one in enumerate(points) for other in points[:place]
        )
        radius = min(radius, 0.42 * nearest)
    return radius


def _draw_rose(panel: Panel, rose: Rose, radius: float, number: int) -> None:
    """A disc whose sectors are coloured by what is known of their directions."""
    if not rose.solving and all(arc.verdict is Verdict.FAILS for arc in rose.arcs):
        dot = Circle(rose.point, 0.22 * radius, facecolor=PAPER, edgecolor=FADED, linewidth=0.6)
        dot.set_zorder(7.0)
        panel.add(dot, Layer.ROSE, "none", number)
        return
    ground = Circle(
        rose.point, radius, facecolor=to_rgba(PAPER, 0.3), edgecolor=INK, linewidth=0.5, zorder=7.0
    )
    panel.add(ground, Layer.ROSE, "ground", number)
    for arc in rose.arcs:
        if arc.verdict is Verdict.FAILS:
            continue
        solves = arc.verdict is Verdict.SOLVES
        layer = Layer.SOLVES if solves else Layer.UNPROVEN
        color = BLUE if solves else ORANGE
        low, high = to_degrees(arc.low), to_degrees(arc.high)
        if high - low < NARROWEST:
            if solves:
                panel.add(_line(rose, arc, radius, 0.9, color), layer, "line", number)
            continue
        sector = Wedge(
            rose.point, radius, low, high, facecolor=to_rgba(color, 0.45), edgecolor=color,
            linewidth=0.5, hatch=None if solves else "xxxx", zorder=7.1,
        )  # fmt: skip
        panel.add(sector, layer, "", number)


def _mark_widest(panel: Panel, rose: Rose, named: bool) -> None:
    """The middle of the widest arc, and its margin."""
    if not rose.solving:
        return
    arc = rose.solving[0]
    radius = 1.12 * LARGE * panel.unit
    panel.add(_line(rose, arc, radius, 1.6, INK), Layer.SOLVES, "widest")
    if not named:
        return
    x, y = unit(arc.widest)
    # beside the end of the mark, and not across the rose
    place = rose.point[0] + 1.1 * radius * x, rose.point[1] + 1.1 * radius * y
    panel.axes.annotate(
        _words(arc), place, fontsize=SMALL_SIZE, color=INK, zorder=9.0,
        ha="left" if x > 0.3 else "right" if x < -0.3 else "center",
        va="bottom" if y > 0.3 else "top" if y < -0.3 else "center",
        bbox={"facecolor": PAPER, "alpha": 0.8, "linewidth": 0.0, "pad": 0.8},
    )  # fmt: skip


def _line(rose: Rose, arc: Arc, radius: float, width: float, color: str) -> Line2D:
    x, y = rose.point
    ahead, up = unit(arc.widest)
    ends = [x, x + radius * ahead], [y, y + radius * up]
    return Line2D(*ends, color=color, linewidth=width, zorder=7.2, solid_capstyle="round")
