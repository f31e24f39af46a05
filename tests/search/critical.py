"""Critical directions, by enumeration: between two of them the answer of one motion is constant.

For the sticking method, whose target is a part of contact space that changes with features alone
(theory 7; Donald 1987, Briggs 1989). Critical are the directions in which a feature changes what
it does, a side of the control cone through one vertex meets another or the start, or two sides
meet on an edge. Slow: O(n^3). Sides of cones that begin where another side ends on an edge, and
end so themselves, are left out.
"""

from __future__ import annotations

import math
from itertools import combinations, permutations

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.region import Region
from preimage.configuration.start import Start
from preimage.geometry.angles import TAU, wrap
from preimage.preimages.setting import Setting

Floats = NDArray[np.float64]


def critical_directions(setting: Setting, goal: Region, start: Start) -> list[float]:
    """All critical directions, ascending in [0, 2 pi), radians."""
    found = [*_of_features(setting), *_of_rays(setting, goal, start)]
    turned = sorted({round(math.fmod(wrap(one) + TAU, TAU), 12) for one in found})
    return [one for one in turned if one < TAU]


def _of_features(setting: Setting) -> list[float]:
    contact, control = setting.space.contact, setting.uncertainty.control
    friction = setting.friction
    offsets = [
        sign * (base + side * control)
        for base in (friction, 0.5 * math.pi)
        for side in (-1.0, 1.0)
        for sign in (-1.0, 1.0)
    ]
    found = [
        float(contact.normal[edge]) + math.pi + off for edge in contact.edges for off in offsets
    ]
    for vertex in contact.vertices.tolist():
        if contact.concave[vertex]:
            before, after = contact.normal[contact.previous[vertex]], contact.normal[vertex]
            for side in (-control, control):
                found += [before - friction + math.pi + side, after + friction + math.pi + side]
    return [float(one) for one in found]


def _of_rays(setting: Setting, goal: Region, start: Start) -> list[float]:
    contact, control = setting.space.contact, setting.uncertainty.control
    inside = goal.contact
    ends = [contact.at(inside.edge, inside.low), contact.at(inside.edge, inside.high)]
    points = np.concatenate((contact.points, *ends))
    if start.point is not None:
        points = np.concatenate((points, [start.point]))
    points = np.unique(points.round(9), axis=0)
    found = []
    for one, other in permutations(points, 2):
        along = math.atan2(*(other - one)[::-1])
        found += [along - control, along + control]
    if control > 0.0:
        for one, other in combinations(points, 2):
            for meeting in _seen_under(one, other, 2.0 * control, contact.points, contact.ends):
                first = math.atan2(*(one - meeting)[::-1])
                second = math.atan2(*(other - meeting)[::-1])
                found.append(first + 0.5 * wrap(second - first))
    return found


def _seen_under(
    one: Floats, other: Floats, angle: float, starts: Floats, ends: Floats
) -> list[Floats]:
    """The points of edges from which two points are seen under an angle."""
    chord = other - one
    length = float(np.hypot(*chord))
    radius = 0.5 * length / math.sin(angle)
    across = np.array((-chord[1], chord[0])) / length
    found: list[Floats] = []
    for side in (-1.0, 1.0):
        center = 0.5 * (one + other) + side * radius * math.cos(angle) * across
        off, along = starts - center, ends - starts
        a, b = np.sum(along**2, axis=1), np.sum(off * along, axis=1)
        root = b**2 - a * (np.sum(off**2, axis=1) - radius**2)
        for edge in np.flatnonzero(root >= 0.0):
            for sign in (-1.0, 1.0):
                share = (-b[edge] + sign * math.sqrt(root[edge])) / a[edge]
                if -1e-9 <= share <= 1.0 + 1e-9:
                    found.append(starts[edge] + share * along[edge])
    return [point for point in found if min(math.dist(point, one), math.dist(point, other)) > 1e-9]
