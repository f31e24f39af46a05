"""Solid areas cut into few convex pieces, as a physics engine wants them."""

from __future__ import annotations

import numpy as np

from preimage.geometry.area import Area, Floats
from preimage.geometry.minkowski import convex_parts

Point = tuple[float, float]
Loop = list[Point]


def convex_pieces(area: Area) -> list[Floats]:
    """Convex polygons, `(n, 2)` counter-clockwise, that tile the area.

    The triangles of a constrained triangulation, joined across a side wherever the union stays
    convex (Hertel and Mehlhorn, 1983): at most four times as many as need be. No side of the area
    is cut, so that nothing that slides along it meets a seam before the side's end.

    >>> len(convex_pieces(Area.polygon([(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)])))
    2
    """
    if area.is_empty:
        return []
    loops: dict[int, Loop] = {
        number: [(float(x), float(y)) for x, y in part]
        for number, part in enumerate(convex_parts(area))
    }
    owner = {side: number for number, loop in loops.items() for side in _sides(loop)}
    for side in sorted(owner, key=_longest_first):
        one, other = owner[side], owner.get((side[1], side[0]))
        if other is None or one == other:
            continue
        joined = _joined(loops[one], loops[other], side)
        if joined is None:
            continue
        loops[one] = joined
        for moved in _sides(loops.pop(other)):
            owner[moved] = one
        del owner[side], owner[side[1], side[0]]
        owner[side] = owner[side[1], side[0]] = one
    return [np.array(loop) for loop in loops.values()]


def _sides(loop: Loop) -> list[tuple[Point, Point]]:
    return list(zip(loop, loop[1:] + loop[:1], strict=True))


def _longest_first(side: tuple[Point, Point]) -> tuple[float, Point, Point]:
    (ax, ay), (bx, by) = side
    return -((bx - ax) ** 2 + (by - ay) ** 2), side[0], side[1]


def _joined(one: Loop, other: Loop, side: tuple[Point, Point]) -> Loop | None:
    """Two loops joined across the side `p, q` of the first, if the union is convex."""
    p, q = side
    begin, back = one.index(q), other.index(p)
    first = one[begin:] + one[:begin]  # q ... p
    second = other[back:] + other[:back]  # p ... q
    whole = first + second[1:-1]
    count = len(first)
    at_p = _turns_left(whole[count - 2], p, whole[count % len(whole)])
    at_q = _turns_left(whole[-1], q, whole[1])
    return whole if at_p and at_q else None


def _turns_left(a: Point, b: Point, c: Point) -> bool:
    """Whether the way from `a` by `b` to `c` does not turn right."""
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) >= 0.0
