"""What the sensors tell: `K_v(q, f)`, and whether that lies in a target (theory 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from preimage.configuration.contact import Bools, ContactSpace
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.space import ConfigurationSpace
from preimage.recognition.outside import Outside, contact_segments
from preimage.recognition.readings import Readings
from preimage.recognition.segments import Segments, distances, stretches
from preimage.task.uncertainty import Uncertainty

Point = tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Interpretation:
    """`K_v(q, f)`: the configurations that are consistent with a reading of both sensors.

    Parameters
    ----------
    position : q.
    radius : rho: what is consistent lies in the open disc of this radius around q; 0 counts as the
        tolerance.
    features : (2n+1,) which features can read f, numbered as in `Readings`.
    """

    position: Point
    radius: float
    features: Bools

    @property
    def free(self) -> bool:
        """Whether free space in the disc is consistent."""
        return bool(self.features[-1])

    def contact(self, contact: ContactSpace) -> ContactSet:
        """The part of contact space that is consistent, closed on each edge; for pictures."""
        n = len(contact)
        edge = np.flatnonzero(self.features[:n]).astype(np.int32)
        corner = np.flatnonzero(self.features[n:-1]).astype(np.int32)
        q = np.array([self.position])
        low, high = np.zeros(len(edge)), contact.length[edge]
        if np.isfinite(self.radius):
            ends = np.broadcast_to(q, (len(edge), 2))
            near, far = stretches(contact, edge, Segments(ends, ends, edge), self.radius)
            low, high = np.maximum(low, near), np.minimum(high, far)
            off = contact.points[corner] - q
            corner = corner[np.hypot(off[:, 0], off[:, 1]) < self.radius]
        met = low < high
        return ContactSet(edge[met], low[met], high[met], corner)


def interpretation(
    readings: Readings, position: Point, force: float | None, uncertainty: Uncertainty
) -> Interpretation:
    """`K_v(q, f)` (theory 3, paper 5.3).

    Parameters
    ----------
    position : q, as measured.
    force : the angle of the measured force, radians; None if f = 0.
    """
    return Interpretation(position, uncertainty.position, readings.can_read(force))


def contained(
    space: ConfigurationSpace, readings: Readings, told: Interpretation, rest: Outside
) -> bool:
    """The termination condition `K_v(q, f) & Delta <= T`, as `K_v(q, f)` misses `Delta - T`.

    True for every reading that a configuration of the kernel can give: the kernel is further than
    twice rho from all of `rest` that is alike, by a whole tolerance. Half of that is kept here, so
    that rounding of what is outside the target does not end a motion too early.

    Parameters
    ----------
    rest : `outside(space, T, Delta)`.
    """
    segments = contact_segments(space.contact, rest.contact)
    segments = segments.part(told.features[segments.feature])
    if np.isinf(told.radius):
        return not len(segments) and not (told.free and not rest.area.is_empty)
    q = np.array([told.position])
    reach = max(told.radius, space.tolerance.length) + 0.5 * space.tolerance.length
    if not np.all(distances(np.repeat(q, len(segments), axis=0), segments) >= reach):
        return False  # also where q is not a number
    return not told.free or rest.area.distance(*told.position) >= reach
