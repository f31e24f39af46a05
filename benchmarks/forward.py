"""Forward projections in halls of growing size, with slides that go back and without."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from benchmarks.halls import hall
from benchmarks.timing import Row, best
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area
from preimage.reachability.forward_projection import ForwardProjection, forward_project

DOWN = math.radians(270)
BOUNDS = {"one sweep": (5.0, 20.0), "slides go back": (20.0, 5.0)}
"""Control uncertainty and friction, in degrees."""


def projected(space: ConfigurationSpace, start: Region, *degrees: float) -> ForwardProjection:
    """A forward projection downwards."""
    control, friction = (math.radians(angle) for angle in degrees)
    return forward_project(space, start, DOWN, control, friction)


def region(space: ConfigurationSpace, start: Region, *degrees: float) -> Region:
    """The same, down to its polygons."""
    return projected(space, start, *degrees).region


def forward_growth() -> list[Row]:
    """Time, over sizes, from all of the space above the boxes."""
    rows: list[Row] = []
    times: dict[tuple[str, int], float] = {}
    sizes = (10**2, 10**3, 10**4, 10**5)
    for edges in sizes:
        space, _ = hall(edges)
        xmin, _, xmax, ymax = space.window
        start = Region(Area.box(xmin, ymax - 0.5, xmax, ymax), ContactSet.empty())
        _ = space.contact.place, space.contact.previous, space.contact.index
        for name, bounds in BOUNDS.items():
            found = projected(space, start, *bounds)
            spent = times[name, edges] = best(partial(projected, space, start, *bounds))
            met = f"{found.sweeps} sweeps, {len(np.unique(found.region.contact.edge)):,} edges met"
            rows.append((f"hall of {edges:,} edges: {name}", spent, met))
        whole = best(partial(region, space, start, *BOUNDS["one sweep"]))
        rows.append((f"hall of {edges:,} edges: one sweep and region", whole, ""))
    for name in BOUNDS:
        exponent = math.log(times[name, sizes[-1]] / times[name, sizes[1]]) / math.log(100)
        rows.append((f"growth exponent from 1,000 to 100,000: {name}", math.nan, f"{exponent:.2f}"))
    return rows
