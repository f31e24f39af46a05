"""How fast a generalised damper moves: the two sliding laws, and guaranteed progress (theory 2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from preimage.task.task import SlidingLaw

Floats = NDArray[np.float64]

QUARTER = 0.5 * np.pi


def sliding_speed(a: Floats, friction: float, law: SlidingLaw) -> Floats:
    """The speed of a slide with a = angle(nu, -v*), `phi < |a| <= pi/2` (theory 2).

    Projection: `sin |a|`, the paper's. Damper: `sin(|a| - phi) / cos phi`, with friction taken off.
    Both grow with |a|.

    Parameters
    ----------
    a : (n,) angles, radians.
    friction : phi, radians.

    >>> sliding_speed(np.radians([-90.0, 30.0]), np.radians(30.0), SlidingLaw.DAMPER).round(9)
    array([1., 0.])
    """
    off = np.abs(a)
    if law is SlidingLaw.PROJECTION:
        return np.asarray(np.sin(off))
    if friction >= QUARTER:
        return np.ones_like(off)  # nothing slides but what moves along its edge
    return np.asarray(np.sin(np.maximum(off - friction, 0.0)) / np.cos(friction))


def guaranteed_progress(
    beta: Floats, control: float, friction: float, law: SlidingLaw = SlidingLaw.PROJECTION
) -> float:
    """The least speed along v of a motion that slides on no other edges than these (theory 2).

    In free space `cos theta`; on a slide `(t . v) * speed`, at its least over nature's choices:
    with a in (beta - theta, beta + theta) it goes along v by `sin |beta|`, or against it where a
    and beta are of different sign. An edge that may stick besides is not slowed down by that: who
    calls leaves out the edges on which the motion has ended.

    Parameters
    ----------
    beta : (n,) angle(nu, -v) of the edges that may be slid on, radians.
    control, friction : theta and phi, radians.

    Returns
    -------
    A bound that is attained or approached; not positive if a slide may go back or stand still.

    >>> guaranteed_progress(np.array([]), np.radians(60.0), 0.0)  # in free space
    0.5000000000000001
    >>> guaranteed_progress(np.radians([90.0]), 0.0, np.radians(20.0))
    1.0
    """
    beta = np.abs(np.asarray(beta, dtype=np.float64))
    nearest = beta - control
    slides = nearest < QUARTER if control > 0.0 else beta <= QUARTER
    slides &= (beta + control > friction) | (nearest < -friction)
    along = np.sin(beta)
    onward = along * sliding_speed(np.maximum(nearest, friction), friction, law)
    back = -along * sliding_speed(np.minimum(nearest, 0.0), friction, law)
    least = np.where(nearest < -friction, back, onward)[slides]
    return float(min(np.cos(control), np.min(least, initial=np.inf)))
