"""Cells of a raster as an area: the squares `[i, i + 1] × [j, j + 1]` of a lattice."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from preimage.geometry.area import Area

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]


def cells_area(solid: Bools) -> Area:
    """The union of the cells that are set, exactly; without vertices where its border is straight.

    Cells that touch at a corner alone touch there as polygons, or as a hole and what is around it.

    Parameters
    ----------
    solid : (rows, columns); cell `[j, i]` is the square with the lower left corner `(i, j)`.

    >>> cells_area(np.array([[True, True], [False, True]])).measure
    3.0
    >>> len(cells_area(np.eye(2, dtype=bool)).parts)
    2
    """
    starts, ends = border_lines(solid)
    if not len(starts):
        return Area.empty()
    lines = shapely.linestrings(np.stack((starts, ends), axis=1).astype(np.float64))
    faces = shapely.get_parts(shapely.polygonize(lines))
    places = shapely.point_on_surface(faces)
    column = np.floor(shapely.get_x(places)).astype(np.int64)
    row = np.floor(shapely.get_y(places)).astype(np.int64)
    faces = faces[solid[row, column]]
    return Area(faces[0] if len(faces) == 1 else shapely.multipolygons(faces))


def border_lines(solid: Bools) -> tuple[Ints, Ints]:
    """The border of the cells that are set, cut where it turns or meets itself.

    Returns
    -------
    `(m, 2)` starts and `(m, 2)` ends, of lines along the lattice.
    """
    rows, columns = solid.shape
    wide = np.zeros((rows + 2, columns + 2), dtype=bool)
    wide[1:-1, 1:-1] = solid
    level = wide[1:, 1:-1] != wide[:-1, 1:-1]  # (rows + 1, columns): below cell j
    upright = wide[1:-1, 1:] != wide[1:-1, :-1]  # (rows, columns + 1): left of cell i
    # Vertices at which lines of the other direction begin or end.
    crossed = np.zeros((rows + 1, columns + 1), dtype=bool)
    crossed[:-1] |= upright
    crossed[1:] |= upright
    flat = _runs(level, crossed)
    crossed[:] = False
    crossed[:, :-1] |= level
    crossed[:, 1:] |= level
    steep = _runs(upright.T, crossed.T)
    starts = np.concatenate((flat[0], steep[0][:, ::-1]))
    ends = np.concatenate((flat[1], steep[1][:, ::-1]))
    return starts, ends


def _runs(edges: Bools, crossed: Bools) -> tuple[Ints, Ints]:
    """Unit edges along the rows, joined up to the next vertex that is crossed: `(x, y)` pairs."""
    left = np.zeros_like(edges)
    left[:, 1:] = edges[:, :-1]
    right = np.zeros_like(edges)
    right[:, :-1] = edges[:, 1:]
    first = edges & (~left | crossed[:, :-1])
    last = edges & (~right | crossed[:, 1:])
    y, x = np.nonzero(first)
    high, far = np.nonzero(last)
    return np.stack((x, y), axis=1), np.stack((far + 1, high), axis=1)
