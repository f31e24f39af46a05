"""Which way nature may take a motion at each edge under one command (theory 2)."""

from __future__ import annotations

from enum import IntFlag

import numpy as np

from preimage.configuration.contact import Bools, ContactSpace, Floats
from preimage.geometry.angles import wrap
from preimage.geometry.tolerance import Tolerance
from preimage.mechanics.behaviour import Codes

QUARTER = 0.5 * np.pi


class Passage(IntFlag):
    """What a motion may make of an edge; the native sweep reads these bits."""

    TOUCHES = 1
    FORWARD = 2
    BACKWARD = 4
    OPEN = 16


def passages(
    contact: ContactSpace, direction: float, control: float, friction: float, tolerance: Tolerance
) -> Codes:
    """How motions along `direction` come to edges and slide on them, ties for nature.

    With `b = angle(nu, -v)`, some `v*` flies to the edge iff `|b| - theta < pi/2`; some `v*` slides
    along it from its start to its end iff an `a` with `|a - b| < theta` has `phi < a <= pi/2`, and
    from its end to its start iff `-a` does (theory 2). An edge that can be slid on both ways,
    where `|b| < theta - phi`, takes the robot back.

    Parameters
    ----------
    direction, control, friction : v, theta and phi, radians.

    Returns
    -------
    (n,) bits of `Passage`, by edge; open sides of the window can only be come to.

    A floor and a wall in a box, moved to along the diagonal, then against it:

    >>> box = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    >>> sides = np.array([False, True, True, False])
    >>> contact = ContactSpace(box, np.array([1, 2, 3, 0], dtype=np.int32), sides)
    >>> tolerance = Tolerance.for_window(0, 0, 1, 1)
    >>> passages(contact, -0.75 * np.pi, 0.1, 0.2, tolerance).tolist()
    [5, 16, 16, 3]
    """
    off = wrap(direction + np.pi - contact.normal)
    slack = control + tolerance.angle
    exact = control == 0.0
    contacts = ~contact.open
    codes = _may_press(np.abs(off), slack, exact).view(np.uint8) * np.uint8(Passage.TOUCHES)
    for ahead, way in ((off, Passage.FORWARD), (-off, Passage.BACKWARD)):
        slides = contacts & (ahead + slack > friction) & _may_press(ahead, slack, exact)
        codes |= slides.view(np.uint8) * np.uint8(way)
    codes |= contact.open.view(np.uint8) * np.uint8(Passage.OPEN)
    return codes


def _may_press(off: Floats, slack: float, exact: bool) -> Bools:
    """Whether some direction near `off` is no further than a quarter turn from the normal."""
    pressing: Bools = off - slack <= QUARTER if exact else off - slack < QUARTER
    return pressing
