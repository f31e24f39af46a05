"""Reaction forces of edges and vertices, over all of nature's choices (theory 2, 3).

Directions of forces are given as offsets from the direction of `-v`. No reaction is further than a
quarter turn from `-v*`, so that offsets stay within (-pi, pi) and a set of them has a hull.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from preimage.geometry.angles import wrap

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

QUARTER = 0.5 * np.pi


@dataclass(frozen=True, slots=True, eq=False)
class Reactions:
    """What a force sensor can be given by each of some features, before its error in direction.

    Parameters
    ----------
    weak : (n,) whether some reaction's magnitude is at most the upper threshold.
    low, high : (n,) the hull of the directions of the reactions above the lower threshold, as
        offsets from `-v` in radians; `inf` and `-inf` where there is none.
    """

    weak: Bools
    low: Floats
    high: Floats


def reaction(a: Floats, friction: float) -> tuple[Floats, Floats]:
    """The reaction of an edge to the motion v*, with a = angle(nu, -v*) (theory 2, paper 3.4).

    Parameters
    ----------
    a : (n,) angles in (-pi, pi], radians.
    friction : phi, radians.

    Returns
    -------
    The angle from the normal to the force, and the magnitude of the force: (a, 1) where the motion
    sticks, (sign(a) phi, cos a / cos phi) where it slides, (0, 0) where it leaves.

    >>> turn, magnitude = reaction(np.radians([10.0, -60.0, 100.0]), np.radians(30.0))
    >>> np.degrees(turn).round(9), magnitude.round(9)
    (array([ 10., -30.,   0.]), array([1.        , 0.57735027, 0.        ]))
    """
    off = np.abs(a)
    sticks, leaves = off <= friction, off > QUARTER
    slides = ~sticks & ~leaves
    turn = np.where(leaves, 0.0, np.clip(a, -friction, friction))
    magnitude = np.where(sticks, 1.0, 0.0)
    magnitude[slides] = np.where(
        off[slides] == QUARTER, 0.0, np.cos(off[slides]) / np.cos(friction)
    )
    return turn, magnitude


def edge_reactions(
    normal: Floats,
    direction: float,
    control: float,
    friction: float,
    thresholds: tuple[float, float],
    tolerance: float = 0.0,
) -> Reactions:
    """The reactions of edges over all a in (beta - theta, beta + theta), beta = angle(nu, -v).

    The magnitude falls as |a| grows, and the direction from the normal is a, clipped to the
    friction cone: both sets are known by their ends (theory 3, paper 5.3).

    Parameters
    ----------
    normal : (n,) angles of the outgoing normals, radians.
    direction, control, friction : v, theta and phi, radians.
    thresholds : (w1, w2): a reaction above w1 can be felt, one up to w2 can be missed.
    tolerance : ties nearer than this count as both; radians.

    >>> floor = edge_reactions(np.array([np.pi / 2]), -np.pi / 2, 0.1, 0.3, (0.05, 0.05))
    >>> floor.weak, floor.low, floor.high
    (array([False]), array([-0.1]), array([0.1]))
    """
    beta = wrap(direction + np.pi - normal)
    off = np.abs(beta)
    weak = off + control >= _reach(thresholds[1], friction) - tolerance
    reach = _reach(thresholds[0], friction)
    felt = off - control <= reach + tolerance
    low = np.clip(np.maximum(beta - control, -reach), -friction, friction) - beta
    high = np.clip(np.minimum(beta + control, reach), -friction, friction) - beta
    return Reactions(weak, np.where(felt, low, np.inf), np.where(felt, high, -np.inf))


def holding_reactions(
    normal_in: Floats,
    normal_out: Floats,
    direction: float,
    control: float,
    friction: float,
    thresholds: tuple[float, float],
    tolerance: float = 0.0,
) -> Reactions:
    """The reactions -v*, of magnitude 1, of concave vertices that hold the robot (theory 2, 3).

    A vertex holds iff the angle of -v* lies in [nu1 - phi, nu2 + phi]. Where these v* are not one
    interval, their hull is given.

    Parameters
    ----------
    normal_in, normal_out : (n,) angles of the normals of the edge that ends and of the edge that
        starts at the vertex; the turn from the one to the other is to the left.
    """
    half = 0.5 * np.mod(normal_out - normal_in, 2.0 * np.pi) + friction
    middle = wrap(normal_in + half - friction - direction - np.pi)
    off = np.abs(middle)
    holds = off <= half + control + tolerance
    # seen from the side of -v on which the middle lies; the far side is reached round the back
    round_ = off + half >= 2.0 * np.pi - control - tolerance
    near = np.where(round_, -control, np.maximum(off - half, -control))
    far = np.minimum(off + half, control)
    near = np.minimum(near, control)
    low = np.where(middle >= 0.0, near, -far)
    high = np.where(middle >= 0.0, far, -near)
    felt = holds if thresholds[0] < 1.0 else np.zeros_like(holds)
    weak = holds if thresholds[1] >= 1.0 else np.zeros_like(holds)
    return Reactions(weak, np.where(felt, low, np.inf), np.where(felt, high, -np.inf))


def summed_reactions(
    normal_in: Floats,
    normal_out: Floats,
    direction: float,
    control: float,
    friction: float,
    thresholds: tuple[float, float],
    tolerance: float,
) -> Reactions:
    """The sums of both edges' reactions at vertices, over all of nature's choices (paper 3.4).

    While neither edge changes between sticking, sliding and leaving, the sum is a linear image of
    the unit vector -v*: its direction turns one way with v*, and the square of its magnitude is
    A + B cos(2 t - gamma), with t the offset of -v* from -v. So each such piece of the control
    cone, cut where the magnitude passes the lower threshold, is known by its ends.

    Parameters
    ----------
    normal_in, normal_out : (n,) angles of the normals of a vertex's two edges.
    tolerance : ties nearer than this count as both, and sums smaller have no direction; positive.
    """
    normals = wrap(np.stack((normal_in, normal_out), axis=1) - direction - np.pi)
    changes = np.array([-QUARTER, -friction, friction, QUARTER])
    breaks = wrap(normals[:, :, None] + changes).reshape(len(normals), -1)
    ends = np.concatenate((breaks, np.broadcast_to([-control, control], (len(normals), 2))), axis=1)
    ends = np.sort(np.clip(ends, -control, control), axis=1)
    low, high = ends[:, :-1], ends[:, 1:]
    image = _image(normals[:, None, :], 0.5 * (low + high), friction)

    gram = np.einsum("...ji,...jk->...ik", image, image)
    mean = 0.5 * (gram[..., 0, 0] + gram[..., 1, 1])
    swing = np.hypot(0.5 * (gram[..., 0, 0] - gram[..., 1, 1]), gram[..., 0, 1])
    gamma = np.arctan2(gram[..., 0, 1], 0.5 * (gram[..., 0, 0] - gram[..., 1, 1]))
    least = _times(0.5 * (gamma + np.pi)[..., None], low, high)
    magnitude = np.hypot(*_sum(image, least))
    weak = np.any(magnitude <= thresholds[1] + tolerance, axis=(1, 2))

    if not np.isfinite(thresholds[0]):
        nothing = np.full(len(normals), np.inf)
        return Reactions(weak, nothing, -nothing)
    cosine = (thresholds[0] ** 2 - mean) / np.where(swing > tolerance, swing, np.inf)
    turn = np.arccos(np.clip(cosine, -1.0, 1.0))
    cuts = _times(0.5 * np.stack((gamma - turn, gamma + turn), axis=-1), low, high)
    middle = 0.5 * (cuts[..., :-1] + cuts[..., 1:])
    felt = np.hypot(*_sum(image, middle)) > thresholds[0] - tolerance
    directions = []
    for place in (cuts[..., :-1], middle, cuts[..., 1:]):
        x, y = _sum(image, place)
        strong = felt & (np.hypot(x, y) > tolerance)
        directions.append((strong, np.arctan2(y, x)))
    lowest = [np.min(np.where(s, d, np.inf), axis=(1, 2)) for s, d in directions]
    highest = [np.max(np.where(s, d, -np.inf), axis=(1, 2)) for s, d in directions]
    return Reactions(weak, np.min(lowest, axis=0), np.max(highest, axis=0))


def _reach(threshold: float, friction: float) -> float:
    """The reactions above the threshold are those with |a| below this angle."""
    if threshold >= 1.0:
        return -np.inf
    return max(friction, float(np.arccos(threshold * np.cos(friction))))


def _image(normals: Floats, offset: Floats, friction: float) -> Floats:
    """The linear map from -v* to the sum of the reactions, (n, k, 2, 2), as it is at `offset`."""
    total = np.zeros((*offset.shape, 2, 2))
    for normal in (normals[..., 0], normals[..., 1]):
        a = wrap(offset - normal)
        sticks, slides = np.abs(a) <= friction, np.abs(a) <= QUARTER
        force = normal + np.copysign(friction, a)
        slide = np.stack(
            (
                np.stack((np.cos(force) * np.cos(normal), np.cos(force) * np.sin(normal)), -1),
                np.stack((np.sin(force) * np.cos(normal), np.sin(force) * np.sin(normal)), -1),
            ),
            -2,
        ) / max(np.cos(friction), np.finfo(float).tiny)
        total += np.where(
            sticks[..., None, None], np.eye(2), np.where(slides[..., None, None], slide, 0.0)
        )
    return total


def _sum(image: Floats, offset: Floats) -> tuple[Floats, Floats]:
    """The sum of the reactions, (n, k, j) each component, at (n, k, j) offsets of -v*."""
    x, y = np.cos(offset), np.sin(offset)
    return (
        image[..., 0, 0, None] * x + image[..., 0, 1, None] * y,
        image[..., 1, 0, None] * x + image[..., 1, 1, None] * y,
    )


def _times(offset: Floats, low: Floats, high: Floats) -> Floats:
    """The offsets (n, k, j), up to half turns, within the pieces [low, high]; with both ends."""
    turned = np.concatenate((offset - np.pi, offset, offset + np.pi), axis=-1)
    inner = np.clip(turned, low[..., None], high[..., None])
    both = np.concatenate((low[..., None], inner, high[..., None]), axis=-1)
    return np.sort(both, axis=-1)
