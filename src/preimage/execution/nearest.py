"""The nearest points of many segments to many points."""

from __future__ import annotations

import numpy as np

from preimage import _native
from preimage.configuration.contact import ContactSpace, Floats
from preimage.configuration.region import Region


def nearest(points: Floats, segments: Floats) -> Floats:
    """(k, 2) of the segments (s, 4), from and to, the point nearest to each of (k, 2) points.

    NaN where there are no segments.

    >>> nearest(np.array([[1.0, 2.0]]), np.array([[0.0, 0.0, 4.0, 0.0]])).tolist()
    [[1.0, 0.0]]
    """
    found: Floats = _native.nearest(
        np.ascontiguousarray(points, dtype=np.float64).ravel(),
        np.ascontiguousarray(segments, dtype=np.float64).ravel(),
    )
    return found.reshape(-1, 2)


def outline(contact: ContactSpace, region: Region) -> Floats:
    """(s, 4) the border of a region's area, its intervals and its vertices, as segments."""
    inside = region.contact
    corners = contact.points[inside.vertices]
    return np.concatenate(
        (
            np.concatenate(region.area.segments, axis=1),
            np.concatenate(
                (contact.at(inside.edge, inside.low), contact.at(inside.edge, inside.high)), axis=1
            ),
            np.concatenate((corners, corners), axis=1),
        )
    )
