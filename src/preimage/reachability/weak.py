"""Weak backprojections: from where a motion may come to a target, if nature is kind."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import ContactSpace
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry.angles import TAU
from preimage.geometry.tolerance import Tolerance
from preimage.mechanics.behaviour import Codes
from preimage.reachability.forward_projection import APART, flood
from preimage.reachability.passages import QUARTER, Passage, passages


@dataclass(frozen=True, slots=True, eq=False)
class WeakBackprojection:
    """The starts from which some motion along one command meets a target.

    Parameters
    ----------
    space : where.
    target, stop : what is to be met, and the set at which motions end before.
    direction : the commanded direction, radians.
    region : the starts; the target belongs to them.
    """

    space: ConfigurationSpace
    target: Region
    stop: Region
    direction: float
    region: Region


def weakly_backproject(
    space: ConfigurationSpace,
    target: Region,
    direction: float,
    control: float,
    friction: float,
    stop: Region | None = None,
) -> WeakBackprojection:
    """The weak backprojection: all starts from which some admissible trajectory meets `target`.

    `p` belongs iff the forward projection of `{p}` meets `target` (theory 4). It is the forward
    projection of motions turned round: free flight in the same cone about `-v`, each slide the
    other way, leaving for arriving. With a stop set `Z`, the trajectories are those that have not
    met `Z` before; where `Z` and the target meet, the target counts.

    It errs on the larger side, so that from a start outside the target surely is not met; a stop
    set is taken somewhat smaller near the target. With no control uncertainty, what leads to a
    thin target is as thin, and lost; who needs it grows the target.

    Parameters
    ----------
    target, stop : areas, intervals of edges and vertices in any mix; their areas are part of free
        space.
    direction, control, friction : v, theta and phi, radians.

    What may fall on a part of the floor that is one wide:

    >>> from preimage.configuration.contact_set import ContactSet
    >>> from preimage.geometry.area import Area
    >>> window = (-4.0, 0.0, 4.0, 2.0)
    >>> border = ContactSpace(
    ...     points=np.array([(-4.0, 0.0), (4.0, 0.0), (4.0, 2.0), (-4.0, 2.0)]),
    ...     next=np.array([1, 2, 3, 0], dtype=np.int32),
    ...     open=np.array([False, True, True, True]),
    ... )
    >>> free, none = Area.box(*window), Area.empty()
    >>> space = ConfigurationSpace(window, Tolerance.for_window(*window), free, none, border)
    >>> target = Region(none, ContactSet.of([0], [3.5], [4.5], [], space.tolerance.length))
    >>> found = weakly_backproject(space, target, -0.5 * math.pi, math.atan(0.5), 1.0)
    >>> round(found.region.area.measure, 9)  # from 1 wide below to 3 wide above
    4.0
    """
    stop = Region.empty() if stop is None else stop
    code = reversed_passages(space.contact, direction, control, friction, space.tolerance)
    before = _apart(stop, target, space.tolerance)
    found = flood(space, target, direction + math.pi, control, code, before)
    return WeakBackprojection(space, target, stop, direction, found.region)


def weak_closure(
    space: ConfigurationSpace,
    target: Region,
    directions: Sequence[float],
    control: float,
    friction: float,
) -> Region | None:
    """All starts from which commands, changed anywhere, may lead to `target`; errs larger.

    In free space, what a robot can do under several commands is to move along any direction in
    the hull of their control cones, up to zigzags as fine as one likes. Where that hull is less
    than a half-plane, one flood with it follows all motions at once.

    Parameters
    ----------
    directions : v, radians.
    control, friction : theta and phi, radians.

    Returns
    -------
    Region, or None where the hull is a half-plane or more.
    """
    turns = np.sort(np.mod(np.asarray(directions, dtype=np.float64), TAU))
    gaps = np.diff(np.concatenate((turns, turns[:1] + TAU)))
    widest = int(np.argmax(gaps))
    width = TAU - float(gaps[widest])
    half = 0.5 * width + control
    if half >= QUARTER - APART * space.tolerance.angle:
        return None
    middle = float(turns[(widest + 1) % len(turns)]) + 0.5 * width
    codes: Codes = np.zeros(len(space.contact), dtype=np.uint8)
    for direction in turns.tolist():
        codes |= reversed_passages(space.contact, direction, control, friction, space.tolerance)
    return flood(space, target, middle + math.pi, half, codes).region


def reversed_passages(
    contact: ContactSpace, direction: float, control: float, friction: float, tolerance: Tolerance
) -> Codes:
    """How motions along `direction`, run backwards, come to edges and slide on them.

    Run backwards, a motion comes to the edges that it leaves: those that some `-v*` flies to. It
    slides along an edge from its end to its start iff forwards it slides from start to end. What
    leaves the window does not come back, so that an open side is neither come from nor slid on;
    that it ends motions is left out, for a target may lie at its end.

    Parameters
    ----------
    direction, control, friction : v, theta and phi, radians.

    Returns
    -------
    (n,) bits of `Passage`, by edge.
    """
    ahead = passages(contact, direction, control, friction, tolerance)
    behind = passages(contact, direction + math.pi, control, friction, tolerance)
    codes: Codes = behind & np.uint8(Passage.TOUCHES)
    for way, back in (
        (Passage.FORWARD, Passage.BACKWARD),
        (Passage.BACKWARD, Passage.FORWARD),
    ):
        slides = (ahead & np.uint8(way)) != 0
        codes |= slides.view(np.uint8) * np.uint8(back)
    codes[contact.open] = 0
    return codes


def _apart(stop: Region, target: Region, tolerance: Tolerance) -> Region:
    """A stop set without the target: within it, and by a margin beside its area."""
    contact = contact_set.difference(stop.contact, target.contact, tolerance.length)
    area = stop.area
    if not area.is_empty and not target.area.is_empty:
        # the sweep keeps a start by `APART` away from a stop set
        around = areas.shrunk(target.area, -2.0 * APART * tolerance.length)
        area = areas.difference(area, around)
    return Region(area, contact)
