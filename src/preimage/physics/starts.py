"""Where runs begin: places drawn from a task's start."""

from __future__ import annotations

import numpy as np

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start
from preimage.geometry.area import Area

Point = tuple[float, float]

ON_CONTACT = 0.5
"""The share of runs that begin in contact, where a start has free space and contact."""


def draw_start(start: Start, space: ConfigurationSpace, generator: np.random.Generator) -> Point:
    """A place where a robot may be at the start.

    A point is itself. Of a region, free space is drawn from evenly, and edges by their length.
    """
    if start.point is not None:
        return start.point
    area, contact = start.region.area, start.region.contact
    touching = area.is_empty or (not contact.is_empty and float(generator.uniform()) < ON_CONTACT)
    if touching:
        return _on_contact(contact, space, generator)
    return _inside(area, generator)


def _inside(area: Area, generator: np.random.Generator) -> Point:
    xmin, ymin, xmax, ymax = area.bounds
    while True:
        x, y = generator.uniform(xmin, xmax), generator.uniform(ymin, ymax)
        if area.contains(x, y):
            return x, y


def _on_contact(
    contact: ContactSet, space: ConfigurationSpace, generator: np.random.Generator
) -> Point:
    lengths = contact.high - contact.low
    whole = float(np.sum(lengths))
    if whole <= 0.0:
        x, y = space.contact.points[generator.choice(contact.vertices)]
        return float(x), float(y)
    at = generator.uniform(0.0, whole)
    ends = np.cumsum(lengths)
    which = min(int(np.searchsorted(ends, at)), len(ends) - 1)
    along = contact.high[which] - min(ends[which] - at, lengths[which])
    x, y = space.contact.at(contact.edge[[which]], np.array([along]))[0]
    return float(x), float(y)
