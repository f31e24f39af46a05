"""What pushes back on robots: reactions of the features that they touch (theory 2, 3)."""

from __future__ import annotations

import numpy as np

from preimage.configuration.contact import Floats, Ints
from preimage.execution.simulator import Robots, Simulator
from preimage.geometry.angles import wrap

QUARTER = 0.5 * np.pi


def contact_forces(
    simulator: Simulator, robots: Robots, angle: Floats, chance: Floats
) -> tuple[Floats, Floats]:
    """The force on each robot under an actual direction.

    On an edge that of Coulomb's law. At a vertex, by chance, that of either of its edges, or their
    sum, or, where it is concave and holds the robot, the opposite of the actual direction.

    Parameters
    ----------
    angle : (k,) actual directions, radians.
    chance : (k,) in [0, 1).

    Returns
    -------
    direction, magnitude : (k,) radians, and 1 where the robot is held; 0 in free space.

    """
    contact = simulator.space.contact
    n = len(contact)
    direction, magnitude = np.zeros(len(robots)), np.zeros(len(robots))
    edge = np.flatnonzero(robots.feature < n)
    direction[edge], magnitude[edge] = _edge_force(simulator, robots.feature[edge], angle[edge])
    corner = np.flatnonzero((robots.feature >= n) & (robots.feature < 2 * n))
    if not len(corner):
        return direction, magnitude
    vertex, v, pick = robots.feature[corner] - n, angle[corner], (4.0 * chance[corner]).astype(int)
    before = contact.previous[vertex]
    # beside an open side, a vertex pushes as its one contact edge
    one_sided = contact.open[vertex] | contact.open[before]
    first = _edge_force(simulator, np.where(contact.open[before], vertex, before), v)
    second = _edge_force(simulator, np.where(contact.open[vertex], before, vertex), v)
    x, y = (first[1] * turn(first[0]) + second[1] * turn(second[0]) for turn in (np.cos, np.sin))
    held = contact.concave[vertex] & _held(simulator, vertex, v)
    pick = np.where(one_sided | ((pick == 3) & ~held), 0, pick)
    cases = [pick == 0, pick == 1, pick == 2]
    direction[corner] = np.select(cases, [first[0], second[0], np.arctan2(y, x)], v + np.pi)
    magnitude[corner] = np.select(cases, [first[1], second[1], np.hypot(x, y)], 1.0)
    return direction, magnitude


def _edge_force(simulator: Simulator, edge: Ints, angle: Floats) -> tuple[Floats, Floats]:
    """Coulomb's law on edges; nothing pushes on an open side."""
    contact, phi = simulator.space.contact, simulator.friction
    a = wrap(angle + np.pi - contact.normal[edge])
    off = np.abs(a)
    sticks = off <= phi
    slope = np.cos(phi) if phi < QUARTER else 1.0
    sliding = np.maximum(np.cos(a), 0.0) / slope
    direction = np.where(sticks, angle + np.pi, contact.normal[edge] + np.sign(a) * phi)
    magnitude = np.where(sticks, 1.0, np.where(off <= QUARTER, sliding, 0.0))
    return direction, np.where(contact.open[edge], 0.0, magnitude)


def _held(
    simulator: Simulator, vertex: Ints, angle: Floats
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """-v* in the hull of both friction cones, at concave vertices."""
    contact, phi = simulator.space.contact, simulator.friction
    first = contact.normal[contact.previous[vertex]]
    turn = np.mod(contact.normal[vertex] - first, 2.0 * np.pi)
    return np.asarray(np.mod(angle + np.pi - first + phi, 2.0 * np.pi) <= turn + 2.0 * phi)
