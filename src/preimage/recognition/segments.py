"""Segments that are parts of features, and distances from them, pair by pair, in closed form."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import Bools, ContactSpace, Floats, Ints

Box = tuple[float, float, float, float]
Indices = NDArray[np.integer[Any]]


@dataclass(frozen=True, slots=True, eq=False)
class Segments:
    """Segments, or points, each with the feature of which it is a part.

    Parameters
    ----------
    starts, ends : (k, 2).
    feature : (k,) see `Readings`.
    """

    starts: Floats
    ends: Floats
    feature: Ints

    def __len__(self) -> int:
        return len(self.feature)

    def part(self, which: Bools | Indices | slice) -> Segments:
        """Some of the segments."""
        return Segments(self.starts[which], self.ends[which], self.feature[which])

    def is_near(self, box: Box, distance: float) -> Bools:
        """(k,) which segments have boxes no further than `distance` from a box, in x and in y."""
        low, high = np.minimum(self.starts, self.ends), np.maximum(self.starts, self.ends)
        meets: Bools = np.all(low <= np.array(box[2:]) + distance, axis=1)
        meets &= np.all(high >= np.array(box[:2]) - distance, axis=1)
        return meets

    def near(self, box: Box, distance: float) -> Segments:
        """Those segments."""
        return self.part(self.is_near(box, distance))

    def within(self, box: Box, margin: float) -> Segments:
        """What lies in a box, closed and grown by the margin; of segments only what has length."""
        along = self.ends - self.starts
        length = np.hypot(along[:, 0], along[:, 1])
        low, high = np.zeros(len(self)), np.ones(len(self))
        for axis in (0, 1):
            near, far = where_between(
                along[:, axis], self.starts[:, axis], box[axis] - margin, box[axis + 2] + margin
            )
            low, high = np.maximum(low, near), np.minimum(high, far)
        high = np.maximum(high, -1.0)  # not infinite: nothing is left there all the same
        low = np.minimum(low, 2.0)
        keep = (low < high) & (((high - low) * length > 4.0 * margin) | (length == 0.0))
        start, along = self.starts[keep], along[keep]
        return Segments(
            start + low[keep, None] * along, start + high[keep, None] * along, self.feature[keep]
        )


def together(first: Segments, second: Segments) -> Segments:
    """The segments of both."""
    if not len(second):
        return first
    return Segments(
        np.concatenate((first.starts, second.starts)),
        np.concatenate((first.ends, second.ends)),
        np.concatenate((first.feature, second.feature)),
    )


def stretches(
    contact: ContactSpace, edge: Ints, source: Segments, radius: float
) -> tuple[Floats, Floats]:
    """Where the lines of edges come nearer than `radius` to segments, pair by pair.

    A disc moved along a segment is convex, so that it is one open interval: the hull of what the
    discs around both ends and the strip between them take from the line.

    Returns
    -------
    Both ends, as distances from the start of the edge; `inf` and `-inf` if there is none.
    """
    tangent = contact.tangent[edge]
    ends = []
    for point in (source.starts, source.ends):
        off = point - contact.points[edge]
        ends.append((_dot(off, tangent), _cross(tangent, off)))
    (x, y), (x2, y2) = ends
    near, far = np.full(len(edge), np.inf), np.full(len(edge), -np.inf)
    for along, off in ends:
        half = np.sqrt(np.maximum((radius - off) * (radius + off), 0.0))
        met = np.abs(off) < radius
        near = np.where(met, np.minimum(near, along - half), near)
        far = np.where(met, np.maximum(far, along + half), far)
    length = np.hypot(x2 - x, y2 - y)
    long = length > 0.0
    scale = np.where(long, length, 1.0)
    cos, sin = (x2 - x) / scale, (y2 - y) / scale
    # of the point s on the line: distance (s - x) sin + y cos off the segment, and
    # (s - x) cos - y sin along it
    strip = where_between(sin, y * cos - x * sin, -radius, radius)
    along_it = where_between(cos, -y * sin - x * cos, 0.0, length)
    low = np.maximum(strip[0], along_it[0])
    high = np.minimum(strip[1], along_it[1])
    met = long & (low < high)
    return (
        np.where(met, np.minimum(near, low), near),
        np.where(met, np.maximum(far, high), far),
    )


def where_between(
    slope: Floats, value: Floats, low: float, high: float | Floats
) -> tuple[Floats, Floats]:
    """The interval of s in which `low < slope * s + value < high`; `inf` and `-inf` if empty."""
    flat = slope == 0.0
    steep = np.where(flat, 1.0, slope)
    first, second = (low - value) / steep, (high - value) / steep
    inside = (low < value) & (value < high)
    return (
        np.where(flat, np.where(inside, -np.inf, np.inf), np.minimum(first, second)),
        np.where(flat, np.where(inside, np.inf, -np.inf), np.maximum(first, second)),
    )


def distances(points: Floats, segments: Segments) -> Floats:
    """Distances of points from segments, pair by pair."""
    along = segments.ends - segments.starts
    off = points - segments.starts
    square = _dot(along, along)
    place = np.clip(_dot(off, along) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    gap = off - place[:, None] * along
    return np.asarray(np.hypot(gap[:, 0], gap[:, 1]))


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1])


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
