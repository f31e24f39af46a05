"""DXF drawings (AutoCAD): layers say what is what, curves stay curves."""

from __future__ import annotations

import logging
import math
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from preimage.errors import InputError, one_line
from preimage.exchange.drawing import (
    MAX_FIGURES,
    NAMES,
    Drawing,
    Figure,
    Line,
    Role,
    Shape,
    Spot,
    check_figures,
    hull_of,
    role_named,
    scaled,
)
from preimage.exchange.joining import Piece, joined
from preimage.exchange.options import JOIN, ImportOptions
from preimage.exchange.reading import bytes_of
from preimage.exchange.units import METRES, factor
from preimage.geometry.curves import Arc, Bezier, Curve
from preimage.task.checks import Point

Entity = Any
"""Of ezdxf."""

UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m", 7: "km", 10: "yd", 13: "um", 14: "dm"}
"""$INSUNITS, as far as they are known."""

NOTES = (
    *("TEXT", "MTEXT", "ATTRIB", "ATTDEF", "DIMENSION", "LEADER", "MULTILEADER", "TOLERANCE"),
    *("HATCH", "IMAGE", "WIPEOUT", "VIEWPORT", "XLINE", "RAY"),
)
"""Kinds that say something about a drawing, or fill outlines of it; they are left out."""

MAX_DEPTH = 16
"""Blocks in blocks."""

FULL = 1e-9
"""An ellipse that is so near to a full turn, in radians, is one."""

SPLINE_FRAME = 16
"""Flag of a vertex that only bends a polyline."""

FLAT = 1e-4
"""Bulges below this are all but straight."""


@dataclass(slots=True)
class _Found:
    """What has been read so far: figures, and by layer what is still open."""

    names: dict[str, Role]
    figures: list[Figure] = field(default_factory=list)
    open: dict[tuple[Role, str], list[Piece]] = field(default_factory=dict)
    ignored: Counter[str] = field(default_factory=Counter)
    count: int = 0


def read_dxf(path: Path, options: ImportOptions) -> Drawing:
    """The drawing of a DXF file: its model space, blocks taken apart.

    Lines, polylines with bulges, arcs, circles, ellipses, splines that are not rational, solids and
    points. Open ones of a layer are joined where their ends meet.

    Raises
    ------
    InputError : with the layer, the kind of entity and its handle.
    """
    document, says_units = _document(path)
    off = {layer.dxf.name.casefold() for layer in document.layers if _is_off(layer)}
    found = _Found({**NAMES, **options.layers})
    for entity in document.modelspace():
        _read(entity, _layer(entity), off, found, 0)
    pieces = [piece for layer in found.open.values() for piece in layer]
    everything = [*found.figures, *(Line(Role.GOAL, piece.place, piece.curves) for piece in pieces)]
    if not everything:
        known = ", ".join(sorted(found.names))
        raise InputError("", f"no layer has a role: the names that are known are {known}")
    check_figures(everything)
    extent = float(np.ptp(hull_of(everything), axis=0).max())
    unit = UNITS.get(document.units, "") if says_units else ""
    by = factor(unit, options.units)
    near = JOIN * extent if options.join is None else options.join / by
    for (role, layer), own in found.open.items():
        try:
            found.figures += joined(own, role, near, extent)
        except InputError as error:
            if role not in (Role.GOAL, Role.START):  # of edges, three may meet
                raise InputError(f"layer {one_line(layer)}", error.rule) from None
            found.figures += [Line(role, piece.place, piece.curves) for piece in own]
    name = METRES[options.units or unit].name if options.units or unit else ""
    return Drawing("DXF", scaled(found.figures, by), unit=name, ignored=found.ignored)


def _document(path: Path) -> tuple[Any, bool]:
    """The file, and whether it says its units, which ezdxf makes up if not."""
    try:
        ezdxf: Any = import_module("ezdxf")
    except ModuleNotFoundError:
        raise InputError(str(path), "needs ezdxf: pip install 'preimage[exchange]'") from None
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # what it says is no output
    content = bytes_of(path)  # refused if it is no file, or too large
    try:
        return ezdxf.readfile(path), b"$INSUNITS" in content
    except Exception as error:  # on damaged files it fails in many ways
        words = one_line(str(error)) or type(error).__name__
        raise InputError(str(path), f"is no DXF that can be read: {words}") from None


def _is_off(layer: Any) -> bool:
    return bool(layer.is_off() or layer.is_frozen())


def _read(entity: Entity, layer: str, off: set[str], found: _Found, depth: int) -> None:
    """Add an entity, blocks opened."""
    found.count += 1
    if found.count > MAX_FIGURES:
        raise InputError("", f"must have {MAX_FIGURES} entities or fewer, blocks taken apart")
    kind = entity.dxftype()
    if not entity.is_supported_dxf_attrib("layer"):
        found.ignored["entities of unknown kinds"] += 1
        return
    if layer.casefold() in off or entity.dxf.get("invisible", 0):
        found.ignored[f"{kind} that cannot be seen"] += 1
        return
    if kind == "INSERT":
        if depth >= MAX_DEPTH:
            raise InputError(_place(entity, layer), f"blocks must be {MAX_DEPTH} deep or less")
        for inner in _opened(entity, layer):
            own = _layer(inner)
            _read(inner, layer if own == "0" else own, off, found, depth + 1)
        return
    role = role_named(layer, found.names)
    if role is None:
        found.ignored[f"{kind} on layer {one_line(layer[:40])}"] += 1
    else:
        _add(entity, kind, role, layer, found)


def _add(entity: Entity, kind: str, role: Role, layer: str, found: _Found) -> None:
    """Add an entity that has a role."""
    place = _place(entity, layer)
    if kind == "POINT":
        found.figures.append(Spot(role, place, _flat(entity.dxf.location)))
    elif kind == "CIRCLE":
        center = _to_world(entity, entity.dxf.center)
        found.figures.append(Spot(role, place, center, abs(entity.dxf.radius)))
    elif kind in NOTES:
        found.ignored[f"{kind} on layer {one_line(layer[:40])}"] += 1
    elif kind not in _KINDS:  # which may be solid
        raise InputError(place, "is of a kind that is not understood: turn it to lines")
    else:
        curves, closed = _curves(entity, kind, place)
        if closed:
            found.figures.append(Shape(role, place, (curves,)))
        elif curves:
            found.open.setdefault((role, layer), []).append(Piece(place, curves))


def _layer(entity: Entity) -> str:
    """The layer; nothing for entities of kinds that are not known."""
    return str(entity.dxf.layer) if entity.is_supported_dxf_attrib("layer") else ""


def _place(entity: Entity, layer: str) -> str:
    handle = entity.dxf.get("handle") or ""
    return one_line(f"layer {layer}, {entity.dxftype()} {handle}".rstrip())


def _opened(insert: Entity, layer: str) -> Iterator[Entity]:
    try:
        if insert.mcount > MAX_FIGURES:
            raise InputError(_place(insert, layer), f"stands for {insert.mcount} blocks")
        several = insert.multi_insert() if insert.mcount > 1 else [insert]
        for one in several:
            yield from one.virtual_entities()
    except InputError:
        raise
    except Exception as error:  # a block that is not there, or cannot be scaled so
        words = one_line(str(error)) or type(error).__name__
        raise InputError(_place(insert, layer), f"cannot be taken apart: {words}") from None


# --- curves -------------------------------------------------------------------------------------


def _curves(entity: Entity, kind: str, place: str) -> tuple[tuple[Curve, ...], bool]:
    """The curves of an entity, and whether they close."""
    try:
        return _KINDS[kind](entity)
    except InputError as error:
        raise InputError(place, error.rule) from None
    except (ValueError, TypeError, ZeroDivisionError, IndexError, AttributeError) as error:
        raise InputError(place, f"cannot be read: {one_line(str(error))}") from None


def _flat(point: Any) -> Point:
    x, y, *_ = point
    return float(x), float(y)


def _to_world(entity: Entity, point: Any) -> Point:
    """A point of the entity's own coordinates, which may be mirrored, not tilted."""
    _check_plane(entity)
    x, y, *_ = point
    return _flat(entity.ocs().to_wcs((x, y, 0.0)))


def _check_plane(entity: Entity) -> None:
    x, y, z = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    if not math.hypot(x, y) <= 1e-9 * abs(z):
        raise InputError(_place(entity, _layer(entity)), "is not in the plane")


def _line(entity: Entity) -> tuple[tuple[Curve, ...], bool]:
    a, b = _flat(entity.dxf.start), _flat(entity.dxf.end)
    return (() if a == b else (Bezier.segment(a, b),)), False


def _arc(entity: Entity) -> tuple[tuple[Curve, ...], bool]:
    begin = math.radians(entity.dxf.start_angle)
    sweep = math.radians((entity.dxf.end_angle - entity.dxf.start_angle) % 360.0)
    radius = abs(entity.dxf.radius)
    origin, x_axis, y_axis = (
        np.array(_to_world(entity, place)) for place in ((0, 0), (radius, 0), (0, radius))
    )
    center = np.array(_to_world(entity, entity.dxf.center))
    arc = Arc(center, x_axis - origin, y_axis - origin, begin, sweep or math.tau)
    return (arc,), sweep == 0.0


def _ellipse(entity: Entity) -> tuple[tuple[Curve, ...], bool]:
    _check_plane(entity)
    center, major = np.array(_flat(entity.dxf.center)), np.array(_flat(entity.dxf.major_axis))
    up = math.copysign(1.0, entity.dxf.extrusion.z)
    minor = up * entity.dxf.ratio * np.array([-major[1], major[0]])
    begin = float(entity.dxf.start_param)
    sweep = (float(entity.dxf.end_param) - begin) % math.tau
    full = min(sweep, math.tau - sweep) <= FULL
    return (Arc(center, major, minor, begin, math.tau if full else sweep),), full


def _polyline(entity: Entity) -> tuple[tuple[Curve, ...], bool]:
    if entity.dxftype() == "LWPOLYLINE":
        rows = [(x, y, bulge, wide or end) for x, y, wide, end, bulge in entity.get_points("xyseb")]
        common = entity.dxf.get("const_width", 0.0)
        closed = bool(entity.closed)
    else:
        if not (entity.is_2d_polyline or entity.is_3d_polyline):
            raise InputError("", "is a mesh, not a line")
        rows = [_vertex(vertex.dxf) for vertex in entity.vertices if not _only_bends(vertex)]
        common = entity.dxf.get("default_start_width", 0.0)
        common = common or entity.dxf.get("default_end_width", 0.0)
        closed = bool(entity.is_closed)
    rows = [(x, y, bulge, width or common) for x, y, bulge, width in rows]
    if any(width for *_, width in rows):
        raise InputError("", "has a width: draw its outline")
    flat = entity.dxftype() == "LWPOLYLINE" or entity.is_2d_polyline
    mirrored = flat and tuple(entity.dxf.get("extrusion", (0.0, 0.0, 1.0)))[2] < 0.0
    sign = -1.0 if mirrored else 1.0
    places = [(_to_world(entity, (x, y)) if flat else (x, y), sign * b) for x, y, b, _ in rows]
    if closed and places:
        places.append(places[0])
    curves = [_bulged(a, b, bulge) for (a, bulge), (b, _) in pairwise(places) if a != b]
    ends = len(places) > 2 and places[0][0] == places[-1][0]
    return tuple(curves), bool(curves) and (closed or ends)


def _vertex(attributes: Any) -> tuple[float, float, float, float]:
    x, y = _flat(attributes.location)
    width = attributes.get("start_width", 0.0) or attributes.get("end_width", 0.0)
    return x, y, attributes.get("bulge", 0.0), width


def _only_bends(vertex: Entity) -> bool:
    return bool(vertex.dxf.get("flags", 0) & SPLINE_FRAME)


def _bulged(start: Point, end: Point, bulge: float) -> Curve:
    if bulge == 0.0:
        return Bezier.segment(start, end)
    if abs(bulge) >= FLAT:
        return Arc.bulged(start, end, bulge)
    # Its middle is far away; in the triangle of its tangents a parabola is as good.
    (ax, ay), (bx, by) = start, end
    rise = bulge / (1.0 - bulge * bulge)
    apex = (0.5 * (ax + bx) + rise * (by - ay), 0.5 * (ay + by) - rise * (bx - ax))
    return Bezier(np.array([start, apex, end]))


def _spline(entity: Entity) -> tuple[tuple[Curve, ...], bool]:
    if not entity.control_point_count():
        raise InputError(
            "", "has fit points only, so that its course is not said: turn it to lines"
        )
    spline = entity.construction_tool()
    if spline.is_rational:
        raise InputError("", "is a rational spline: turn it to lines")
    if not spline.is_clamped:
        raise InputError("", "is a periodic spline: turn it to lines")
    parts = [
        Bezier(np.array([_flat(point) for point in points]))
        for points in spline.bezier_decomposition()
    ]
    closed = bool(np.all(parts[0].start == parts[-1].end))
    return tuple(parts), closed


def _solid(entity: Entity) -> tuple[tuple[Curve, ...], bool]:
    """Three corners or four; the last two the wrong way round, as DXF has it."""
    corners = [_flat(corner) for corner in entity.wcs_vertices()]
    corners = [a for a, b in zip(corners, [*corners[1:], corners[0]], strict=True) if a != b]
    return tuple(
        Bezier.segment(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)
    ), True


_KINDS: dict[str, Callable[[Entity], tuple[tuple[Curve, ...], bool]]] = {
    "LINE": _line,
    "ARC": _arc,
    "ELLIPSE": _ellipse,
    "LWPOLYLINE": _polyline,
    "POLYLINE": _polyline,
    "SPLINE": _spline,
    "SOLID": _solid,
    "TRACE": _solid,
}
