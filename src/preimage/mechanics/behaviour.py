"""What edges and vertices can do to a motion, over all of nature's choices (theory 2)."""

from __future__ import annotations

from enum import IntFlag

import numpy as np
from numpy.typing import NDArray

from preimage.geometry.angles import wrap

Floats = NDArray[np.float64]
Codes = NDArray[np.uint8]


class Behaviour(IntFlag):
    """What nature may make of a motion at a feature; the native sweep reads these bits."""

    MAY_STICK = 1
    MAY_SLIDE = 2
    MAY_LEAVE = 4
    STICKS_SURELY = 8


def edge_behaviour(
    normal: Floats, direction: float, control: float, friction: float, tolerance: float = 0.0
) -> Codes:
    """What edges with outgoing `normal` may do to a motion commanded along `direction`.

    With beta = angle(normal, -direction): may stick iff |beta| <= phi + theta; sticks for sure iff
    |beta| <= phi - theta; may slide iff some a with |a - beta| < theta has phi < |a| <= pi/2; may
    leave iff |beta| + theta > pi/2 (theory 2, paper 3.2, 3.3). An edge slides for sure iff it may
    slide and neither stick nor leave.

    Parameters
    ----------
    normal : (n,) angles of the outgoing normals, radians.
    direction, control, friction : v, theta and phi, radians.
    tolerance : ties nearer than this are decided for nature; radians.

    Returns
    -------
    (n,) bits of `Behaviour`.

    >>> floor, wall = np.pi / 2, 0.0
    >>> [Behaviour(int(b)) for b in edge_behaviour(np.array([floor, wall]), -np.pi / 2, 0.1, 0.3)]
    [<Behaviour.MAY_STICK|STICKS_SURELY: 9>, <Behaviour.MAY_SLIDE|MAY_LEAVE: 6>]
    """
    beta = np.abs(wrap(direction + np.pi - normal))
    exact = control == 0.0
    sticks = beta <= friction + control + tolerance
    surely = beta <= friction - control - tolerance
    upper = beta + control + tolerance
    lower = beta - control - tolerance
    slides = (upper > friction) & ((lower <= np.pi / 2) if exact else (lower < np.pi / 2))
    return _codes(
        (sticks, Behaviour.MAY_STICK),
        (surely, Behaviour.STICKS_SURELY),
        (slides, Behaviour.MAY_SLIDE),
        (upper > np.pi / 2, Behaviour.MAY_LEAVE),
    )


def concave_vertex_behaviour(
    normal_in: Floats,
    normal_out: Floats,
    direction: float,
    control: float,
    friction: float,
    tolerance: float = 0.0,
) -> Codes:
    """Whether concave vertices may hold, or surely hold, a motion commanded along `direction`.

    A concave vertex holds the robot against v* iff the angle of -v* lies in the hull of its edges'
    friction cones, [nu1 - phi, nu2 + phi] (theory 2).

    Parameters
    ----------
    normal_in, normal_out : (n,) angles of the normals of the edge that ends and of the edge that
        starts at the vertex, free space on their left; the turn between them is to the left.

    Returns
    -------
    (n,) bits of `Behaviour`, `MAY_STICK` and `STICKS_SURELY` alone.
    """
    turn = np.mod(normal_out - normal_in, 2.0 * np.pi)
    half = 0.5 * turn + friction
    off = np.abs(wrap(direction + np.pi - (normal_in + 0.5 * turn)))
    return _codes(
        (off <= half + control + tolerance, Behaviour.MAY_STICK),
        (off <= half - control - tolerance, Behaviour.STICKS_SURELY),
    )


def convex_vertex_behaviour(edge_in: Codes, edge_out: Codes) -> Codes:
    """Whether convex vertices may, or surely, stick: as either of their edges, nature choosing.

    It may stick if either edge may, and sticks for sure if both do (theory 2, paper 3.2).

    Parameters
    ----------
    edge_in, edge_out : (n,) codes of `edge_behaviour`.
    """
    may = (edge_in | edge_out) & np.uint8(Behaviour.MAY_STICK)
    surely = edge_in & edge_out & np.uint8(Behaviour.STICKS_SURELY)
    return may | surely


def _codes(*parts: tuple[NDArray[np.bool_], Behaviour]) -> Codes:
    codes = np.zeros(parts[0][0].shape, dtype=np.uint8)
    for holds, bit in parts:
        codes |= holds.view(np.uint8) * np.uint8(bit)
    return codes
