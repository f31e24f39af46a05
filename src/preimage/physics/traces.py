"""A run in the engine as a trace, to be drawn like any other."""

from __future__ import annotations

import numpy as np

from preimage.configuration.contact import ContactSpace, Floats, Ints
from preimage.execution.trace import Leg, Trace
from preimage.physics.drive import Drive
from preimage.physics.scene import Scene
from preimage.strategy.strategy import Strategy

TOUCHING = 0.05
"""What is nearer than so many lengths to a feature touches it: contact is soft."""


def trace_of(run: Drive, stage: Scene, strategy: Strategy, number: int = 0) -> Trace:
    """What happened in a run of a plan: a leg for each motion, an instant for each look.

    Parameters
    ----------
    number : which of the runs it was.
    """
    legs = []
    features = touched(stage.space.contact, run.places, TOUCHING * stage.length)
    cuts = np.flatnonzero(np.diff(run.regions)) + 1
    starts, ends = [0, *cuts.tolist()], [*cuts.tolist(), len(run.times) - 1]
    for start, end in zip(starts, ends, strict=True):
        if end <= start:
            continue
        # The look that ends a motion belongs to it, and to the next one.
        part = slice(start, end + 1)
        actual = run.actual[part].copy()
        actual[-1] = actual[-2]
        legs.append(
            Leg(
                int(run.regions[start]),
                float(run.commands[start]),
                run.times[part],
                run.places[part],
                features[part],
                actual,
                run.measured[part],
                run.forces[part],
            )
        )
    return Trace(strategy, tuple(legs), run.outcome, "MuJoCo", "MuJoCo", number, run.words)


def touched(contact: ContactSpace, places: Floats, near: float) -> Ints:
    """(k,) what is touched at (k, 2) places: edge i is i, vertex i is n + i, free space is 2 n."""
    count = len(contact)
    found = np.full(len(places), 2 * count, dtype=np.int32)
    place, edge, along = contact.index.near_points(places, near)
    real = ~contact.open[edge]
    place, edge, along = place[real], edge[real], along[real]
    found[place] = edge
    for corner, close in (
        (edge, along <= near),
        (contact.next[edge], along >= contact.length[edge] - near),
    ):
        found[place[close]] = count + corner[close]
    return found
