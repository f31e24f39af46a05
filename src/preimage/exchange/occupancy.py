"""Occupancy maps of ROS: YAML of map_server and its image, as obstacles that hold all cells."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preimage.errors import InputError, shown
from preimage.exchange.drawing import Drawing, Figure, Patch, Role
from preimage.exchange.options import ImportOptions, Unknown
from preimage.exchange.raster import Raster, read_raster
from preimage.exchange.reading import beside, text_of
from preimage.geometry.area import Area
from preimage.geometry.cells import cells_area
from preimage.geometry.outer_simplify import simplified_outward
from preimage.geometry.outlines import hull_box, polygons_of
from preimage.task import checks, limits
from preimage.task.documents import Format, parse_document

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]

GRID = 2.0**-32
"""Where simplified borders cross, the crossing is rounded to this part of a cell."""

KEYS = ("image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")


class Mode(Enum):
    """What grey levels mean."""

    TRINARY = "trinary"
    SCALE = "scale"
    RAW = "raw"


@dataclass(frozen=True, slots=True)
class MapInfo:
    """The YAML file of a map.

    Parameters
    ----------
    image : its file, seen from the YAML file.
    resolution : side of a cell, metres.
    origin : the lower left corner of the lower left cell, metres, and by how much the map is
        turned about it, radians.
    negate : white is occupied, not black.
    occupied, free : a cell is occupied if it is darker than the first, free if lighter than the
        second; 0 white, 1 black.
    mode : what the levels between mean.
    """

    image: str
    resolution: float
    origin: tuple[float, float, float]
    negate: bool
    occupied: float
    free: float
    mode: Mode


def read_map(path: Path, options: ImportOptions) -> Drawing:
    """The drawing of a map: occupied cells as polygons that hold them, and where the map ends.

    Raises
    ------
    InputError : with the key of the YAML file, or the image's path.
    """
    if options.units not in (None, "m"):
        raise InputError("units", "maps are in metres: leave this out")
    data = parse_document(text_of(path), Format.YAML, str(path))
    info = map_info(data)
    raster = read_raster(beside(path, info.image))
    solid, unknown = classified(raster, info)
    if options.unknown is Unknown.OCCUPIED:
        solid |= unknown
    solid = solid[::-1]
    simplify = info.resolution if options.simplify is None else options.simplify
    area = cells_area(solid)
    simple = simplified_outward(area, simplify / info.resolution, GRID)
    figures: list[Figure] = [
        Patch(Role.OBSTACLES, f"cells {number}", _placed(part, info))
        for number, part in enumerate(simple)
    ]
    rows, columns = solid.shape
    corners = _metres(np.array([[0, 0], [columns, 0], [columns, rows], [0, rows]]), info)
    box = hull_box(corners)
    if info.origin[2] and options.unknown is Unknown.OCCUPIED:
        figures += _beyond(corners, box)
    words = {Unknown.OCCUPIED: "solid", Unknown.FREE: "free"}
    count = int(np.count_nonzero(unknown))
    approximated = [f"obstacles outward by up to {simplify:g}, at the borders of cells"]
    if count:
        approximated.append(f"{count} cells that nobody has seen are {words[options.unknown]}")
    assert isinstance(data, Mapping)
    ignored = Counter(f"key {str(key)[:40]}" for key in data if key not in (*KEYS, "mode"))
    kind = f"map of {columns} × {rows} cells of {info.resolution:g}"
    return Drawing(kind, tuple(figures), box, "metres", tuple(approximated), ignored)


def map_info(data: object) -> MapInfo:
    """What the YAML file says; keys that map_server does not know are left out.

    Raises
    ------
    InputError : with the key and the rule.
    """
    if not isinstance(data, Mapping) or not {"image", "resolution"} & data.keys():
        raise InputError("", "is no map: it has neither image nor resolution")
    for key in KEYS:
        if key not in data:
            raise InputError(key, "is missing")
    image = checks.text(data["image"], "image", 1000)
    resolution = checks.number(data["resolution"], "resolution", limits.RADIUS)
    origin = checks.items(data["origin"], "origin")
    if len(origin) != 3:
        raise InputError("origin", f"must be [x, y, yaw], not {len(origin)} numbers")
    x, y = (checks.number(origin[k], f"origin[{k}]", limits.COORDINATE) for k in (0, 1))
    yaw = checks.number(origin[2], "origin[2]", limits.Range(-100.0, 100.0))
    share = limits.Range(0.0, 1.0)
    occupied = checks.number(data["occupied_thresh"], "occupied_thresh", share)
    free = checks.number(data["free_thresh"], "free_thresh", share)
    if free > occupied:
        raise InputError("free_thresh", f"must be at most occupied_thresh, {occupied:g}")
    mode = checks.choice(data.get("mode", "trinary"), "mode", Mode)
    if data["negate"] not in (0, 1):
        raise InputError("negate", f"must be 0 or 1, not {shown(data['negate'])}")
    negate = bool(data["negate"])
    if negate and mode is Mode.RAW:
        raise InputError("negate", "must be 0 in the mode raw, of which map servers differ")
    return MapInfo(image, resolution, (x, y, yaw), negate, occupied, free, mode)


def classified(raster: Raster, info: MapInfo) -> tuple[Bools, Bools]:
    """The cells that are occupied, perhaps or surely, and those that nobody has seen.

    As map_server has it; a cell that is not opaque was never seen, unless it is occupied. Where
    that averages the alpha into the colours (trinary images), both means must call a cell free.
    """
    levels, most = raster.levels, raster.most
    if info.mode is Mode.RAW:
        values = np.rint(levels / most * 255.0)
        solid, unknown = (values > 0) & (values <= 100), values > 100
    elif levels.dtype.kind == "u":  # a table spares a number for each cell
        solid, unknown = (
            found[levels] for found in _by_threshold(np.arange(most + 1) / most, info)
        )
    else:
        solid, unknown = _by_threshold(levels / most, info)
    if raster.opaque is not None:
        if info.mode is Mode.TRINARY:
            mean = (levels * float(raster.colours) + most) / (raster.colours + 1.0)
            also, perhaps = _by_threshold(mean / most, info)
            solid, unknown = solid | also, unknown | perhaps
        unknown = (unknown | ~raster.opaque) & ~solid
    return solid, unknown


def _by_threshold(shade: Floats, info: MapInfo) -> tuple[Bools, Bools]:
    """What shades mean, from 0 for black to 1 for white."""
    dark = shade if info.negate else 1.0 - shade
    solid = dark > info.occupied
    between = ~solid & ~(dark < info.free)
    if info.mode is Mode.SCALE:  # a probability between: not surely free
        return solid | between, np.zeros_like(between)
    return solid, between


# --- from cells to metres -----------------------------------------------------------------------


def _metres(cells: NDArray[Any], info: MapInfo) -> Floats:
    """`(n, 2)` corners of cells, in metres: as decimals, unless the map is turned."""
    x, y, yaw = info.origin
    size = np.asarray(cells, dtype=np.float64) * info.resolution
    if yaw == 0.0:
        size = size + np.array([x, y])
        return np.array([float(f"{value:.15g}") for value in size.ravel()]).reshape(size.shape)
    cosine, sine = math.cos(yaw), math.sin(yaw)
    turned: Floats = size @ np.array([[cosine, sine], [-sine, cosine]]) + np.array([x, y])
    return turned


def _placed(part: Area, info: MapInfo) -> Area:
    ((exterior, holes),) = polygons_of(part)
    return Area.polygon(_metres(exterior, info), [_metres(hole, info) for hole in holes])


def _beyond(corners: Floats, box: tuple[float, float, float, float]) -> Iterator[Figure]:
    """What of the window lies beyond a turned map: up to four triangles."""
    xmin, ymin, xmax, ymax = box
    for corner in ((xmin, ymin), (xmax, ymin), (xmax, ymax), (xmin, ymax)):
        place = np.array(corner)
        for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            along, off = b - a, place - a
            cross = along[0] * off[1] - along[1] * off[0]
            length = float(np.hypot(*along))
            within = 0.0 < float(along @ off) < length**2
            if within and cross < -1e-9 * length * length:
                yield Patch(Role.OBSTACLES, "beyond the map", Area.polygon(np.stack((a, place, b))))
