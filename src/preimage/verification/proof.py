"""The proof of one motion: forward from its region, it ends in its goals and is known to.

Let `Z` be the part of the claimed target that is certain: what the reading conditions tell from
everything outside a goal, and what holds every motion for sure, if a condition waits for that. Let
`D` be the forward projection of the region, stopped at `Z`. Then the motion keeps its promise if
`D` reaches no open side and no place outside `Z` at which it may rest; each reading condition's
domain holds `D`, so that it is true nowhere outside its goal; and what waits for the motion to
stick waits long enough.

The region's border is drawn up to rounding, and its ties are nature's. So the proof is of the
region shrunk by `MARGIN` tolerances: 1.6e-9 of the window.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.strategy.strategy import Motion, Strategy, StrategyRegion
from preimage.verification.certain import Aim, aim_of
from preimage.verification.features import Features, features_of
from preimage.verification.flights import leaving
from preimage.verification.forward import ForwardProjection, forward_projection
from preimage.verification.reading_sets import ReadingSets, reading_sets
from preimage.verification.recognised import Confusion
from preimage.verification.slabs import BORDER
from preimage.verification.trajectory import sliding_angles, sliding_speed

MARGIN = 16.0
"""Regions are shrunk by so many tolerances before they are looked at."""

FLAT = 256.0
"""On edges that are all but parallel to a side of the cone, by so many times more at most."""


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """One motion, and all that its proof needs.

    Parameters
    ----------
    stop : `Z`.
    projection : `D`.
    """

    strategy: Strategy
    region: StrategyRegion
    motion: Motion
    features: Features
    sets: ReadingSets
    aim: Aim
    stop: Region
    projection: ForwardProjection

    @property
    def uncertain(self) -> tuple[Confusion, ...]:
        """Why parts of the target are not certain, unless another goal or condition has them."""
        every = {c: None for one in (*self.aim.told, *self.aim.held) for c in one.confusions}
        return tuple(every) if self._lacks_something() else ()

    def _lacks_something(self) -> bool:
        space, target = self.strategy.space, self.motion.target
        return not contact_set.is_subset(
            target.contact, self.stop.contact, 2.0 * MARGIN * space.tolerance.length
        ) or not areas.is_subset(target.area, self.stop.area, MARGIN * space.tolerance.length)


def case_of(strategy: Strategy, region: StrategyRegion) -> Case:
    """Work out what is certain of a motion's target, and where the motion may get."""
    task, space, motion = strategy.task, strategy.space, region.motion
    assert motion is not None
    slack, control = space.tolerance.angle, task.uncertainty.control
    features = features_of(space.contact, motion.direction, control, task.friction, slack)
    sets = reading_sets(space.contact, motion.direction, task.uncertainty, task.friction, slack)
    aim = aim_of(strategy, motion, features, sets)
    projection = forward_projection(
        space,
        shrunk(region.region, space, (motion.direction - control, motion.direction + control)),
        motion.direction,
        control,
        task.friction,
        aim.region,
    )
    return Case(strategy, region, motion, features, sets, aim, aim.region, projection)


def shrunk(region: Region, space: ConfigurationSpace, cone: tuple[float, float]) -> Region:
    """A region without what is as near to its borders as `MARGIN` tolerances, vertices kept.

    On edges that is measured across the sides of the control cone: that far, flights pass by.

    Parameters
    ----------
    cone : the angles of its sides, radians.
    """
    margin = MARGIN * space.tolerance.length
    area = region.area if region.area.is_empty else areas.shrunk(region.area, margin)
    contact = region.contact
    along = space.contact.normal[contact.edge] - 0.5 * math.pi
    across = np.min(np.abs(np.sin(along[:, None] - np.array(cone))), axis=1)
    off = margin / np.maximum(across, 1.0 / FLAT)
    low, high = contact.low + off, contact.high - off
    keep = high - low > 4.0 * margin
    return Region(area, ContactSet(contact.edge[keep], low[keep], high[keep], contact.vertices))


def least_progress(case: Case) -> tuple[float, int]:
    """The least speed along `v` anywhere in `D`, and the edge with it; -1 for free space.

    In free space `cos theta`; on an edge that is slid on and does not keep, `sin |b|` times the
    speed of the slide that is driven least (theory 2).
    """
    task = case.strategy.task
    control, friction = task.uncertainty.control, task.friction
    best = math.cos(control), -1
    for edge, spans in enumerate(case.projection.reached.spans):
        slope = abs(float(case.features.slope[edge]))
        slides = case.features.forward[edge] or case.features.backward[edge]
        if not spans or case.features.keeps[edge] or not slides:
            continue
        low, _ = sliding_angles(slope, True, control, friction)
        speed = math.sin(slope) * sliding_speed(low, friction, task.sliding)
        best = min(best, (speed, edge))
    return best


def depth(case: Case) -> float:
    """How far the motion may get along `v` in all."""
    heights = []
    frame = case.projection.slabs.frame
    region = case.region.region
    contact = case.strategy.space.contact
    for points in (
        *region.area.rings,
        contact.at(region.contact.edge, region.contact.low),
        contact.at(region.contact.edge, region.contact.high),
        contact.points[region.contact.vertices],
    ):
        if len(points):
            heights.append(float(np.max(frame.turned(points)[:, 1])))
    reached = case.projection.contact
    lows = [
        flight.cell.bottom
        for flight in case.projection.reached.flights
        if any(leaving(flight, case.strategy.space.tolerance.length))
        or BORDER in (flight.cell.left, flight.cell.right)
    ]
    for points in (
        contact.at(reached.edge, reached.low),
        contact.at(reached.edge, reached.high),
        contact.points[reached.vertices],
    ):
        if len(points):
            lows.append(float(np.min(frame.turned(points)[:, 1])))
    return max(heights) - min(lows) if heights and lows else 0.0
