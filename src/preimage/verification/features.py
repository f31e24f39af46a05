"""What nature may do to a motion at each feature, straight from theory 2."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.geometry.angles import unit

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Features:
    """Nature's choices on the edges and vertices of one contact space, for one motion.

    Parameters
    ----------
    keeps : (n,) whoever is on edge `i` may be kept there for ever: it may stick, or it is an open
        side, where the robot has escaped.
    slides : (n,) some `v*` slides along edge `i`; downhill, where the edge does not keep.
    leaves : (n,) some `v*` leaves edge `i`.
    keeps_vertex : (n,) the same as `keeps` for vertex `i`.
    forward, backward : (n,) some `v*` slides along edge `i` to its end, to its start.
    surely, surely_vertex : (n,) edge `i`, vertex `i` holds every `v*`.
    slope : (n,) angle(nu, -v) of edge `i`, radians.
    """

    keeps: Bools
    slides: Bools
    leaves: Bools
    keeps_vertex: Bools
    forward: Bools
    backward: Bools
    surely: Bools
    surely_vertex: Bools
    slope: Floats


def features_of(
    contact: ContactSpace, direction: float, control: float, friction: float, tolerance: float
) -> Features:
    """What a motion commanded along `direction` may do at each feature (theory 2).

    With `b = |angle(nu, -v)|`: an edge may stick iff `b <= phi + theta`; if it may not, it may
    slide iff `b < pi/2 + theta`, and may leave iff `b > pi/2 - theta`. A concave vertex may stick
    iff `-v*` can lie in the hull of its edges' friction cones, a convex one iff an edge of it may.
    Where an open side begins or ends, the robot has escaped. With `b` signed, some `v*` slides to
    the end of the edge iff `[b - theta, b + theta]` meets `[phi, pi/2]`, to its start iff it meets
    `[-pi/2, -phi]`: free space is on the left.

    Parameters
    ----------
    direction, control, friction : `v`, `theta`, `phi`, in radians.
    tolerance : ties nearer than this are nature's; in radians.
    """
    along = contact.points[contact.next] - contact.points
    down = unit(direction)
    # the normal is the edge turned left, so angle(-v, normal) is that from -v turned right to it
    rise = -(down[0] * along[:, 0] + down[1] * along[:, 1])
    run = -down[1] * along[:, 0] + down[0] * along[:, 1]
    tilt = np.arctan2(rise, run)
    before = np.empty_like(contact.next)
    before[contact.next] = np.arange(len(contact))

    slack = control + tolerance
    sticks = ~contact.open & (np.abs(tilt) <= friction + slack)
    keeps = sticks | contact.open
    turn = _wrapped(tilt - tilt[before])  # to the left where the vertex is concave
    middle = _wrapped(tilt[before] + 0.5 * turn)
    caught = (turn > 0.0) & (np.abs(middle) <= 0.5 * turn + friction + slack)
    beta = -tilt
    held = ~contact.open & (np.abs(tilt) <= friction - control - tolerance)
    hull = (turn > 0.0) & (np.abs(middle) <= 0.5 * turn + friction - control - tolerance)
    hull &= ~(contact.open | contact.open[before])
    return Features(
        forward=~contact.open & (beta + slack > friction) & (beta - slack < 0.5 * math.pi),
        backward=~contact.open & (-beta + slack > friction) & (-beta - slack < 0.5 * math.pi),
        surely=held,
        surely_vertex=hull | (held & held[before]),
        slope=beta,
        keeps=keeps,
        slides=np.abs(tilt) < 0.5 * math.pi + slack,
        leaves=np.abs(tilt) > 0.5 * math.pi - slack,
        keeps_vertex=caught | keeps | keeps[before],
    )


def _wrapped(angle: Floats) -> Floats:
    """The same angles in [-pi, pi)."""
    return np.mod(angle + math.pi, 2.0 * math.pi) - math.pi
