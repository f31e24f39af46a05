"""Letters beside regions, as in the paper's figures, and numbers of contact edges."""

from __future__ import annotations

import math
import re

import numpy as np
from matplotlib.text import Text
from numpy.typing import NDArray

from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.rendering.panel import Panel
from preimage.rendering.placing import depth, distance
from preimage.rendering.scene import Scene, inner_point
from preimage.rendering.style import FADED, INK, PAPER, REGIONS, Layer

Floats = NDArray[np.float64]

SIZE = (15.0, 12.0)
"""Points: the room that a letter needs."""

CLOSE = 11.0
"""Points: a letter is no farther from what it names, if there is room."""

INSIDE, OUTSIDE, BESIDE = 20.0, 70.0, 4.0
"""What it costs, in covered cells, that a letter lies nearer to the border of its area by a cell
than it is large; that it lies outside; that it is a point farther away than close."""

MOST_EDGE_NUMBERS = 400
"""Spaces with more contact edges get no numbers: nobody could read them."""


def draw_name(
    panel: Panel, words: str, layer: Layer, region: Region, point: Floats | None = None
) -> None:
    """Write a letter inside an area where there is room, else beside it.

    Parameters
    ----------
    point : beside which it is written, for what is a point.
    """
    if region.is_empty and point is None:
        return
    wide, high = SIZE[0] * panel.unit, SIZE[1] * panel.unit
    lattice = panel.lattice
    penalty = np.zeros(lattice.cost.shape)
    anchor = point
    if anchor is None and region.area.is_empty:
        anchor = _middle_of_contact(panel.space, region)
    elif anchor is None:
        inside = lattice.inside(region.area)
        lattice.cost -= REGIONS[layer].cost * inside
        lack = np.maximum(np.ceil(0.5 * max(wide, high) / lattice.cell) - depth(inside), 0.0)
        away = distance(inside) * lattice.cell / panel.unit
        middle = lattice.from_point(*inner_point(region.area)) / panel.unit
        penalty = 0.2 * middle + np.where(
            inside, INSIDE * lack, OUTSIDE + BESIDE * np.maximum(away - CLOSE, 0.0)
        )
    if anchor is not None:
        away = lattice.from_point(*anchor.tolist()) / panel.unit
        penalty = BESIDE * np.maximum(away - CLOSE, 0.0)
    place = lattice.clearest(wide, high, penalty)
    if place is None:
        return
    text = Text(*place, words, fontsize=9.5, color=INK, ha="center", va="center", zorder=10.0)
    text.set_bbox(
        {"facecolor": PAPER, "alpha": 0.78, "edgecolor": "none", "boxstyle": "round,pad=0.08"}
    )
    panel.add(text, Layer.NAME, re.sub(r"[^A-Z0-9]", "", words.replace("mathcal", "")))
    lattice.take(*place, wide, high)


def _middle_of_contact(space: ConfigurationSpace, region: Region) -> Floats:
    contact = region.contact
    if not len(contact.edge):
        corner: Floats = space.contact.points[contact.vertices[0]]
        return corner
    longest = int(np.argmax(contact.high - contact.low))
    middle = 0.5 * (contact.low + contact.high)
    place: Floats = space.contact.at(contact.edge, middle)[longest]
    return place


def draw_edge_numbers(panel: Panel) -> None:
    """Number the contact edges, in free space beside their middles."""
    contact = panel.space.contact
    if len(contact.edges) > MOST_EDGE_NUMBERS:
        return
    for edge in contact.edges.tolist():
        turn = contact.normal[edge]
        away = (6.5 + panel.lanes.outermost(edge)) * panel.unit
        middle = 0.5 * (contact.points[edge] + contact.ends[edge])
        x, y = (middle + away * np.array((math.cos(turn), math.sin(turn)))).tolist()
        text = Text(
            x, y, str(edge), fontsize=5.5, color=FADED, ha="center", va="center", zorder=9.0
        )
        panel.add(text, Layer.EDGE_NUMBER, str(edge))
        panel.lattice.take(x, y, 7.0 * panel.unit, 6.0 * panel.unit)


def draw_start_name(panel: Panel, scene: Scene) -> None:
    """Write the letter of the start, unless it is anywhere."""
    start = scene.start
    if start is None or scene.starts_anywhere:
        return
    point = None if start.point is None else np.array(start.point)
    draw_name(panel, r"$\mathcal{I}$", Layer.START, start.region, point)
