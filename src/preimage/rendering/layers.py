"""Regions as layers of a panel: areas, intervals of contact edges beside them, vertices."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.border import border
from preimage.rendering.panel import Panel
from preimage.rendering.placing import TAKEN
from preimage.rendering.style import INK, LEAST_SIZE, PAPER, REGIONS, SOLID, Layer, RegionStyle

Floats = NDArray[np.float64]

OPEN_ENDS = "open-ends"
"""The part of a layer that marks ends of intervals that do not belong."""

STRIPE_WIDTH = 5.5
"""Points: how wide the stripes along a contour are."""

MOST_STRIPED = 20_000
"""Contours with more vertices are hatched all over: at such a size stripes are not told apart."""

RINGED = (Layer.GOAL, Layer.START, Layer.TARGET)
MOST_RINGS = 200
"""Each small part of these layers gets a ring, if there are no more parts than that."""

FINE = (Layer.PREIMAGE, Layer.FOUND, Layer.SUBGOAL)
FINER_BELOW = 14.0
"""Points: where edges are usually shorter, these layers are drawn with finer lines."""

OUTLINE_COST = 2.0
"""What it costs to cover a cell of an area's outline."""


def area_path(area: Area) -> Path:
    """All rings of an area as one path, exteriors and holes in opposite directions."""
    points, following = border(area)
    if not len(points):
        return Path(np.empty((0, 2)))
    closing = np.flatnonzero(following <= np.arange(len(points)))
    vertices = np.insert(points, closing + 1, points[following[closing]], axis=0)
    codes = np.full(len(vertices), Path.LINETO, dtype=np.uint8)
    ends = closing + 1 + np.arange(len(closing))
    codes[ends] = Path.CLOSEPOLY
    codes[np.concatenate(([0], ends[:-1] + 1))] = Path.MOVETO
    return Path(vertices, codes)


def draw_region(
    panel: Panel,
    layer: Layer,
    region: Region,
    *,
    number: int | None = None,
    plain: Area | None = None,
) -> None:
    """Draw a region in the style of its layer.

    Its area is filled and hatched, its intervals of contact edges run beside the obstacle, its
    vertices are marked; what is too small to be seen gets a ring.

    Parameters
    ----------
    number : of the region in the plan.
    plain : where its area is not hatched, since something else is.
    """
    if region.is_empty:
        return
    style = _scaled(panel, layer)
    if not region.area.is_empty:
        _draw_area(panel, layer, region.area, style, number, plain)
        panel.lattice.cost += style.cost * panel.lattice.inside(region.area)
        panel.lattice.cost += OUTLINE_COST * panel.lattice.along(*region.area.segments)
    if len(region.contact.edge):
        _draw_intervals(panel, layer, region.contact, style, number)
    if len(region.contact.vertices):
        points = panel.space.contact.points[region.contact.vertices]
        draw_markers(panel, layer, points, style, "vertices", number)
    if layer in (Layer.TARGET, Layer.STICKING):
        _draw_open_ends(panel, layer, region.contact, style)
    _draw_rings(panel, layer, region, style)


def _scaled(panel: Panel, layer: Layer) -> RegionStyle:
    """The style of a layer, with finer lines among short edges for what need not stand out."""
    style, contact = REGIONS[layer], panel.space.contact
    if layer not in FINE or not len(contact.edges):
        return style
    usual = panel.points(float(np.median(contact.length[contact.edges])))
    finer = min(max(usual / FINER_BELOW, 0.3), 1.0)
    return replace(style, contact=finer * style.contact, size=finer * style.size)


def _draw_area(
    panel: Panel,
    layer: Layer,
    area: Area,
    style: RegionStyle,
    number: int | None,
    plain: Area | None,
) -> None:
    path = area_path(area)
    fill = PathPatch(
        path,
        facecolor=to_rgba(style.color, style.tint),
        edgecolor=style.color,
        linewidth=style.outline,
        linestyle=style.dashes,
        joinstyle="round",
        zorder=style.order,
    )
    panel.add(fill, layer, "", number)
    if not style.hatch:
        return
    part = "hatch"
    if style.stripes and np.size(path.vertices) <= 2 * MOST_STRIPED:
        part = "stripes"
        core = areas.shrunk(area, STRIPE_WIDTH * panel.unit)
        band = area if core.is_empty else areas.difference(area, core)
        if plain is not None and not plain.is_empty:
            band = areas.difference(band, plain)
        path = area_path(band)
    hatch = PathPatch(
        path,
        facecolor="none",
        edgecolor=style.color,
        linewidth=0.0,
        hatch=style.hatch,
        zorder=style.order - 0.01,
    )
    panel.add(hatch, layer, part, number)


def _draw_intervals(
    panel: Panel, layer: Layer, contact: ContactSet, style: RegionStyle, number: int | None
) -> None:
    window = np.array(panel.space.window).reshape(2, 2)
    lines = np.clip(panel.lanes.lines(contact, style.contact, panel.unit), *window)
    draw_lines(
        panel, layer, lines, "contact", style.color, style.contact, style.contact_dashes,
        style.order + 1.0, number, PAPER if style.contact_dashes[1] else None,
    )  # fmt: skip
    panel.lattice.cost += TAKEN * panel.lattice.along(lines[:, 0], lines[:, 1])


def draw_lines(
    panel: Panel,
    layer: Layer,
    lines: Floats,
    part: str,
    color: str,
    width: float,
    dashes: tuple[float, tuple[float, ...]] = SOLID,
    order: float = 6.0,
    number: int | None = None,
    gap: str | None = None,
) -> None:
    """Draw (k, 2, 2) line segments as one artist, with a colour between its dashes or none."""
    collection = LineCollection(
        list(lines), colors=[color], linewidths=[width], linestyles=[dashes], zorder=order
    )
    if gap is not None:
        collection.set_gapcolor(gap)
    panel.add(collection, layer, part, number)


def draw_markers(
    panel: Panel,
    layer: Layer,
    points: Floats,
    style: RegionStyle,
    part: str,
    number: int | None = None,
    filled: bool = True,
) -> None:
    """Draw a marker at each of (k, 2) points, hollow if it is not `filled`."""
    markers = marker(points[:, 0].tolist(), points[:, 1].tolist(), style, filled)
    panel.add(markers, layer, part, number)
    panel.lattice.cost += TAKEN * panel.lattice.along(points, points)


def marker(x: list[float], y: list[float], style: RegionStyle, filled: bool = True) -> Line2D:
    """The markers of vertices; hollow ones are round."""
    return Line2D(
        x,
        y,
        linestyle="none",
        marker=style.marker if filled else "o",
        markersize=style.size if filled else 0.85 * style.size,
        markerfacecolor=style.color if filled else PAPER,
        markeredgecolor=PAPER if filled else style.color,
        markeredgewidth=0.6 if filled else 1.0,
        clip_on=False,
        zorder=style.order + 2.0,
    )


def open_ends(space: ConfigurationSpace, contact: ContactSet) -> Floats:
    """(k, 2) the vertices at which intervals end that reach them, and that do not belong.

    Floor and corner may be told apart (theory 5): an edge is then in a kernel without its end.
    """
    features, near = space.contact, space.tolerance.length
    first = contact.edge[contact.low <= near]
    last = features.next[contact.edge[contact.high >= features.length[contact.edge] - near]]
    ends = np.unique(np.concatenate((first, last)))
    return features.points[ends[~np.isin(ends, contact.vertices)]]


def _draw_open_ends(panel: Panel, layer: Layer, contact: ContactSet, style: RegionStyle) -> None:
    ends = open_ends(panel.space, contact)
    if len(ends):
        draw_markers(panel, layer, ends, style, OPEN_ENDS, filled=False)


def extent(space: ConfigurationSpace, region: Region) -> tuple[Floats, Floats]:
    """The lower left and the upper right corner of a region's box."""
    contact = region.contact
    points = np.concatenate(
        (
            space.contact.at(contact.edge, contact.low),
            space.contact.at(contact.edge, contact.high),
            space.contact.points[contact.vertices],
        )
    )
    if not region.area.is_empty:
        points = np.concatenate((points, np.reshape(region.area.bounds, (2, 2))))
    return points.min(axis=0), points.max(axis=0)


def _draw_rings(panel: Panel, layer: Layer, region: Region, style: RegionStyle) -> None:
    """Draw rings around what is too small to be seen, but for slivers of larger areas."""
    low, high = extent(panel.space, region)
    middles: list[Floats] = []
    if panel.points(float(np.max(high - low))) < LEAST_SIZE:
        if len(region.contact.edge) or not region.area.is_empty:  # vertices have their markers
            middles.append(0.5 * (low + high))
    elif layer in RINGED and len(region.area.parts) <= MOST_RINGS:
        for part in region.area.parts:
            box = np.reshape(part.bounds, (2, 2))
            if panel.points(float(np.max(box[1] - box[0]))) < LEAST_SIZE:
                middles.append(box.mean(axis=0))
    if not middles:
        return
    points = np.array(middles)
    rings = Line2D(
        points[:, 0].tolist(),
        points[:, 1].tolist(),
        linestyle="none",
        marker="o",
        markersize=style.size + 7.0,
        markerfacecolor="none",
        markeredgecolor=style.color,
        markeredgewidth=1.2,
        clip_on=False,
        zorder=style.order + 2.0,
    )
    panel.add(rings, layer, "ring")
    side = (style.size + 7.0) * panel.unit
    for x, y in points.tolist():
        panel.lattice.take(x, y, side, side)


def draw_rays(panel: Panel, rays: Floats) -> None:
    """Draw the rays that bound a backprojection: (r, 2, 2), thin and dashed."""
    if len(rays):
        dashes = (0.0, (4.0, 3.0))
        draw_lines(panel, Layer.RAY, rays, "", INK, 1.1, dashes, 5.5, gap=PAPER)
