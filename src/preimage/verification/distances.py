"""Distances between segments, and what a disc moved along a segment takes from a line."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Point = tuple[float, float]

PARALLEL = 2.0**-30
"""Where segments turn by less, their ends are as near to each other as anything of them."""


def apart(first: tuple[Floats, Floats], second: tuple[Floats, Floats]) -> Floats:
    """(a, b) distances of each segment of one family from each of another; 0 where they cross.

    Parameters
    ----------
    first, second : starts and ends, (a, 2) and (b, 2); a segment may be a point.

    >>> one = np.array([(0.0, 0.0)]), np.array([(2.0, 0.0)])
    >>> apart(one, (np.array([(1.0, 3.0), (1.0, -1.0)]), np.array([(5.0, 1.0), (1.0, 1.0)])))
    array([[2.23606798, 0.        ]])
    """
    found = np.minimum(_points(first[0], second), _points(first[1], second))
    found = np.minimum(found, _points(second[0], first).T)
    found = np.minimum(found, _points(second[1], first).T)
    along = (first[1] - first[0])[:, None, :]
    other = (second[1] - second[0])[None, :, :]
    gap = second[0][None, :, :] - first[0][:, None, :]
    turn = _cross(along, other)
    with np.errstate(divide="ignore", invalid="ignore"):
        here, there = _cross(gap, other) / turn, _cross(gap, along) / turn
        meet = (np.abs(here - 0.5) <= 0.5) & (np.abs(there - 0.5) <= 0.5)
    size = np.hypot(along[..., 0], along[..., 1]) * np.hypot(other[..., 0], other[..., 1])
    meet &= np.abs(turn) > PARALLEL * size
    return np.where(meet, 0.0, found)


def closest(first: tuple[Point, Point], second: tuple[Point, Point]) -> tuple[Point, Point]:
    """The points of two segments that are nearest to each other."""
    pairs = [(point, _foot(point, second)) for point in first]
    pairs += [(_foot(point, first), point) for point in second]
    return min(pairs, key=lambda pair: math.dist(*pair))


def taken(
    origin: Point, tangent: Point, start: Point, end: Point, radius: float
) -> tuple[float, float] | None:
    """Where on a line it is nearer than `radius` to a segment; None if nowhere.

    Parameters
    ----------
    origin, tangent : a point of the line and its unit vector.

    >>> taken((0.0, 0.0), (1.0, 0.0), (0.0, 3.0), (0.0, 4.0), 5.0)
    (-4.0, 4.0)
    """
    along = [
        ((at[0] - origin[0]) * tangent[0] + (at[1] - origin[1]) * tangent[1]) for at in (start, end)
    ]
    off = [
        (tangent[0] * (at[1] - origin[1]) - tangent[1] * (at[0] - origin[0])) for at in (start, end)
    ]
    found: list[float] = []
    for x, y in zip(along, off, strict=True):
        if abs(y) < radius:
            half = math.sqrt((radius - y) * (radius + y))
            found += [x - half, x + half]
    length = math.dist(start, end)
    if length > 0.0:
        cos, sin = (along[1] - along[0]) / length, (off[1] - off[0]) / length
        # the sides of the strip, at `radius` on either side: those places whose foot is inside
        for side in (-radius, radius):
            if sin != 0.0:
                at = along[0] + (side - off[0] * cos) / sin
                foot = (at - along[0]) * cos - off[0] * sin
                if 0.0 <= foot <= length:
                    found.append(at)
    return (min(found), max(found)) if len(found) > 1 else None


def _points(points: Floats, segments: tuple[Floats, Floats]) -> Floats:
    """(a, b) distances of points from segments."""
    start, along = segments[0][None, :, :], (segments[1] - segments[0])[None, :, :]
    off = points[:, None, :] - start
    square = np.sum(along * along, axis=2)
    part = np.clip(np.sum(off * along, axis=2) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    gap = off - part[:, :, None] * along
    found: Floats = np.hypot(gap[..., 0], gap[..., 1])
    return found


def _cross(a: Floats, b: Floats) -> Floats:
    found: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return found


def _foot(point: Point, segment: tuple[Point, Point]) -> Point:
    start, end = segment
    along = end[0] - start[0], end[1] - start[1]
    square = along[0] ** 2 + along[1] ** 2
    off = (point[0] - start[0]) * along[0] + (point[1] - start[1]) * along[1]
    part = min(max(off / square, 0.0), 1.0) if square > 0.0 else 0.0
    return start[0] + part * along[0], start[1] + part * along[1]
