"""Polygons and chains at the door: what is simple is turned counter-clockwise, the rest refused."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from preimage.errors import TaskError
from preimage.geometry import simplicity
from preimage.task.checks import Point

Ring = tuple[Point, ...]


def coordinates(points: Sequence[Point]) -> NDArray[np.float64]:
    """The points as an array of shape `(n, 2)`."""
    return np.array(points, dtype=np.float64).reshape(-1, 2)


def stacked(rings: Sequence[Ring]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The vertices of all rings, one ring after the other, and where each ring starts."""
    offsets = np.concatenate([[0], np.cumsum([len(ring) for ring in rings])]).astype(np.int64)
    return coordinates([point for ring in rings for point in ring]), offsets


def turned(rings: Sequence[Ring], keys: Sequence[str]) -> tuple[Ring, ...]:
    """The rings, each counter-clockwise from its own first vertex; refused by key if not simple."""
    check_crowds([(ring,) for ring in rings], keys)
    points, offsets = stacked(rings)
    fault = simplicity.ring_fault(points, offsets)
    if fault is not None:
        raise TaskError(keys[fault.ring], fault.rule)
    right = simplicity.counterclockwise(points, offsets)
    return tuple(ring if keep else reverse(ring) for ring, keep in zip(rings, right, strict=True))


def reverse(ring: Ring) -> Ring:
    """The ring the other way round, from the same first vertex.

    >>> reverse(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)))
    ((0.0, 0.0), (1.0, 1.0), (1.0, 0.0))
    """
    return (ring[0], *ring[:0:-1])


def check_crowds(groups: Sequence[Sequence[Ring]], keys: Sequence[str]) -> None:
    """Refuse groups of rings whose edges are too many, and too near each other, to be compared."""
    points, offsets = stacked([ring for group in groups for ring in group])
    starts = np.concatenate([[0], np.cumsum([len(group) for group in groups])]).astype(np.int64)
    fault = simplicity.crowd_fault(points, offsets, starts)
    if fault is not None:
        raise TaskError(keys[fault.ring], fault.rule)


def check_chain(points: Ring, key: str) -> None:
    """Refuse a chain that meets itself or its end rays."""
    rule = simplicity.chain_fault(coordinates(points))
    if rule is not None:
        raise TaskError(key, rule)


def check_holes(exterior: Ring, holes: Sequence[Ring], key: str) -> None:
    """Refuse holes that are not inside the exterior and beside each other."""
    fault = simplicity.hole_fault(coordinates(exterior), [coordinates(hole) for hole in holes])
    if fault is not None:
        raise TaskError(f"{key}.holes[{fault.ring}]", fault.rule)


def check_thickness(
    rings: Sequence[Ring], keys: Sequence[str], length: float, closed: bool = True
) -> None:
    """Refuse edges and needles up to `length`, which the window does not resolve."""
    fault = simplicity.thin_fault(*stacked(rings), length, closed)
    if fault is not None:
        raise TaskError(keys[fault.ring], fault.rule)


def check_distance(rings: Sequence[Ring], keys: Sequence[str], farthest: float) -> None:
    """Refuse coordinates above `farthest`, beyond which numbers are coarser than the window."""
    points, offsets = stacked(rings)
    sizes = np.abs(points).max(axis=1, initial=0.0)
    if (far := np.flatnonzero(sizes > farthest)).size:
        ring = int(np.searchsorted(offsets, far[0], side="right")) - 1
        rule = f"must be at most {farthest:.3g} in this window, not {sizes[far[0]]:.9g}"
        raise TaskError(keys[ring], f"coordinates {rule}")
