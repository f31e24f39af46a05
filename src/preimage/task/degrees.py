"""Degrees in files, radians inside, and back again to the same digits."""

from __future__ import annotations

import math

_DIGITS = 17
"""Decimal digits that tell any two doubles apart."""


def to_radians(degrees: float) -> float:
    """An angle of a file.

    >>> to_radians(90) == math.pi / 2
    True
    """
    return math.radians(degrees)


def to_degrees(radians: float) -> float:
    """The shortest decimal number of degrees that `to_radians` takes to this angle.

    Some angles have none; then the nearest one.

    >>> to_degrees(to_radians(0.1))
    0.1
    """
    degrees = math.degrees(radians)
    for digits in range(1, _DIGITS + 1):
        decimal = float(f"{degrees:.{digits}g}")
        if math.radians(decimal) == radians:
            return decimal
    for toward in (-math.inf, math.inf):
        neighbour = degrees
        for _ in range(2):
            neighbour = math.nextafter(neighbour, toward)
            if math.radians(neighbour) == radians:
                return neighbour
    return degrees


def representable(radians: float) -> float:
    """The angle, or one beside it that has a number of degrees, so that files keep it exactly."""
    return to_radians(to_degrees(radians))
