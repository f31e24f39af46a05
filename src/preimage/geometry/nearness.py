"""How near two families of segments come to each other."""

from __future__ import annotations

import numpy as np
import shapely

from preimage.geometry.area import Floats


def gap(first: tuple[Floats, Floats], second: tuple[Floats, Floats]) -> float:
    """The least distance of any segment of one family from any of another; 0 where they meet.

    Parameters
    ----------
    first, second : starts and ends, (a, 2) and (b, 2), in the unit of length; a segment may be a
        point. Infinite if one family is empty.

    >>> import numpy as np
    >>> point = np.array([(0.0, 3.0)])
    >>> gap((point, point), (np.array([(-1.0, 0.0)]), np.array([(1.0, 0.0)])))
    3.0
    """
    if not len(first[0]) or not len(second[0]):
        return float("inf")
    one, other = _lines(first), _lines(second)
    shapely.prepare(one)
    return float(shapely.distance(one, other))


def _lines(segments: tuple[Floats, Floats]) -> shapely.Geometry:
    starts, ends = segments
    same = np.all(starts == ends, axis=1)
    pairs = np.stack((starts, ends), axis=1)
    parts = [*shapely.linestrings(pairs[~same]), *shapely.points(starts[same])]
    return parts[0] if len(parts) == 1 else shapely.GeometryCollection(parts)
