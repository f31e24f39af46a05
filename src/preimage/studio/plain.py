"""Areas, regions, traces and plans as plain lists and mappings: lengths as they are, degrees."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.configuration.region import Region
from preimage.execution.trace import Trace
from preimage.geometry.area import Area
from preimage.task.degrees import to_degrees

Plain = dict[str, Any]
Floats = NDArray[np.float64]

DIGITS = 9
"""What a page draws is rounded to so many digits after the point of the window's scale."""


def points_of(points: Floats | Sequence[tuple[float, float]]) -> list[list[float]]:
    """Points as pairs."""
    rounded: list[list[float]] = np.round(np.asarray(points, dtype=np.float64), DIGITS).tolist()
    return rounded


def area_of(area: Area) -> list[list[list[list[float]]]]:
    """Polygons, each a list of rings that are not closed: the outer one, and the holes."""
    return [[points_of(ring) for ring in part.rings] for part in area.parts if not part.is_empty]


def region_of(region: Region, contact: ContactSpace) -> Plain:
    """A region: its area, its stretches of edges, its vertices."""
    held = region.contact
    ends = contact.at(held.edge, held.low), contact.at(held.edge, held.high)
    return {
        "area": area_of(region.area),
        "edges": points_of(np.concatenate(ends, axis=1)) if len(held.edge) else [],
        "vertices": points_of(contact.points[held.vertices]) if len(held.vertices) else [],
    }


def degrees_of(radians: float | None) -> float | None:
    """An angle in degrees; None where there is none."""
    if radians is None or not math.isfinite(radians):
        return None
    return round(to_degrees(radians), DIGITS)


def finite(value: float | None) -> float | None:
    """A number, or None where it is not finite."""
    return None if value is None or not math.isfinite(value) else float(value)


def readings_of(measured: Floats) -> list[list[float] | None]:
    """Positions as measured; None where there was no sensor."""
    return [
        points_of(place[None])[0] if known else None
        for place, known in zip(measured, np.all(np.isfinite(measured), axis=1), strict=True)
    ]


def features_of(features: Iterable[int], count: int) -> list[str]:
    """What is touched, in a word."""
    names = ("edge", "vertex", "free")
    return [names[min(int(feature) // max(count, 1), 2)] for feature in features]


def trace_of(trace: Trace) -> Plain:
    """A run, motion by motion."""
    count = len(trace.strategy.space.contact)
    return {
        "outcome": trace.outcome.name.lower(),
        "good": trace.outcome.as_planned,
        "words": trace.outcome.value,
        "time": trace.time,
        "legs": [
            {
                "region": leg.region,
                "direction": degrees_of(leg.direction),
                "times": [round(float(time), DIGITS) for time in leg.times],
                "places": points_of(leg.places),
                "features": features_of(leg.features, count),
                "actual": [degrees_of(float(angle)) for angle in leg.actual],
                "measured": readings_of(leg.measured),
                "forces": [degrees_of(float(force)) for force in leg.forces],
                "ended_by": leg.ended_by,
            }
            for leg in trace.legs
        ],
    }
