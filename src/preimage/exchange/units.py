"""Units of length of drawings."""

from __future__ import annotations

from typing import NamedTuple

from preimage.errors import InputError, shown


class Unit(NamedTuple):
    """A unit: what people call many of it, and how many of it are `per` metres."""

    name: str
    metres: float


METRES: dict[str, Unit] = {
    "m": Unit("metres", 1.0),
    "dm": Unit("decimetres", 0.1),
    "cm": Unit("centimetres", 0.01),
    "mm": Unit("millimetres", 0.001),
    "um": Unit("micrometres", 1e-6),
    "km": Unit("kilometres", 1000.0),
    "in": Unit("inches", 0.0254),
    "ft": Unit("feet", 0.3048),
    "yd": Unit("yards", 0.9144),
}
"""By their signs."""


def factor(unit: str, wanted: str | None) -> float:
    """By what to multiply lengths in a unit, to have them in the wanted one; 1 if none is.

    >>> factor("mm", "m"), factor("in", "mm"), factor("", None)
    (0.001, 25.4, 1.0)
    """
    if wanted is None:
        return 1.0
    if wanted not in METRES:
        raise InputError("units", f"must be one of {', '.join(METRES)}, not {shown(wanted)}")
    if not unit:
        raise InputError("units", "the drawing does not say what its own are")
    return float(f"{METRES[unit].metres / METRES[wanted].metres:.15g}")
