"""Commands and cones: what has a direction rather than a place."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.patches import Circle, Polygon, Wedge
from numpy.typing import NDArray

from preimage.configuration.region import Region
from preimage.geometry.angles import unit
from preimage.rendering.panel import Panel
from preimage.rendering.scene import Scene, clip_to_window
from preimage.rendering.style import BLUE, GREEN, INK, Layer

Floats = NDArray[np.float64]

COMPASS = 18.0
"""Points: the radius of the disc in which a commanded direction is drawn."""

HEAD = (6.5, 2.3)
"""Points: length and half the width of an arrow's head."""

MOST_CONES = 24
"""No more friction cones than this are drawn."""


def arrow(tail: Floats, tip: Floats, head: tuple[float, float], shaft: float) -> Floats:
    """(7, 2) the outline of an arrow; lengths as those of its ends."""
    along = (tip - tail) / np.hypot(*(tip - tail))
    left = np.array((-along[1], along[0]))
    neck = tip - head[0] * along
    half = 0.5 * shaft * left
    side = head[1] * left
    return np.array(
        (tail + half, neck + half, neck + side, tip, neck - side, neck - half, tail - half)
    )


def draw_direction(panel: Panel, direction: float, control: float | None) -> None:
    """Draw a commanded direction with its cone of control uncertainty, where there is room.

    Parameters
    ----------
    direction : v, radians.
    control : theta, radians; None if it is not known.
    """
    points = panel.unit
    radius = COMPASS * points
    side = 2.0 * radius + 3.0 * points
    panel_size = panel.lattice.cost.size
    corners = 0.02 * panel_size * panel.lattice.from_corners() ** 2
    place = panel.lattice.clearest(side, side, corners)
    if place is None:
        xmin, ymin, xmax, ymax = panel.lattice.box
        place = 0.5 * (xmin + xmax), 0.5 * (ymin + ymax)
        radius = min(radius, 0.45 * min(xmax - xmin, ymax - ymin))
        points = radius / COMPASS
    panel.lattice.take(*place, side, side)
    middle, along = np.array(place), np.array(unit(direction))
    ground = Circle(
        place, radius, facecolor=(1.0, 1.0, 1.0, 0.88), edgecolor=INK, linewidth=0.5, zorder=8.0
    )
    panel.add(ground, Layer.DIRECTION, "ground")
    tail, tip = middle - 0.72 * radius * along, middle + 0.82 * radius * along
    if control is not None and control > 0.0:
        turn, half = math.degrees(direction), math.degrees(control)
        cone = Wedge(
            tuple(tail.tolist()), 1.36 * radius, turn - half, turn + half,
            facecolor=to_rgba(BLUE, 0.28), edgecolor=BLUE, linewidth=0.7, zorder=8.1,
        )  # fmt: skip
        cone.set_clip_path(ground)
        panel.add(cone, Layer.CONTROL_CONE)
    head = (HEAD[0] * points, HEAD[1] * points)
    outline = arrow(tail, tip, head, 1.3 * points)
    panel.add(Polygon(outline, facecolor=INK, linewidth=0.0, zorder=8.2), Layer.DIRECTION)


def draw_friction_cones(panel: Panel, scene: Scene, target: Region) -> None:
    """Draw the friction cone at the middle of each interval of a target."""
    if scene.task is None or target.contact.is_empty or not len(target.contact.edge):
        return
    contact, phi = scene.space.contact, math.degrees(scene.task.friction)
    edges, part = target.contact.edge[:MOST_CONES], target.contact
    middles = contact.at(edges, 0.5 * (part.low + part.high)[:MOST_CONES])
    for edge, (x, y) in zip(edges.tolist(), middles.tolist(), strict=True):
        turn = math.degrees(contact.normal[edge])
        cone = Wedge(
            (x, y), 24.0 * panel.unit, turn - phi, turn + phi,
            facecolor=to_rgba(GREEN, 0.12), edgecolor=GREEN, linewidth=0.7, zorder=7.5,
        )  # fmt: skip
        panel.add(cone, Layer.FRICTION_CONE, str(edge))
        clip_to_window(panel, cone)
