"""Where a motion is known to have ended because it does not move any more."""

from __future__ import annotations

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry.angles import unit, wrap
from preimage.geometry.area import Area
from preimage.mechanics.behaviour import Behaviour
from preimage.mechanics.damper import guaranteed_progress
from preimage.preimages.setting import Command, Setting
from preimage.recognition.termination import Condition, sticking_condition


def sticking_features(goal: Region, command: Command) -> Region:
    """The part of a goal at which motions stick for sure: `T & sticks-for-sure`.

    Edges whose friction cone holds the inverted control cone, and vertices: concave ones by the
    hull of their edges' friction cones, which hold without friction too, and convex ones beside
    two such edges (theory 6, paper 5.2).
    """
    edges, vertices = command.sources.where(Behaviour.STICKS_SURELY)
    contact = goal.contact
    on = edges[contact.edge]
    held = contact.vertices[vertices[contact.vertices]]
    found = ContactSet(contact.edge[on], contact.low[on], contact.high[on], held)
    space = command.setting.space
    return Region(Area.empty(), contact_set.without_outermost(found, space.contact))


def sticking_termination(setting: Setting, command: Command, preimage: Region) -> Condition | None:
    """The condition that a motion from `preimage` has stuck; None without a bound on its time.

    Outside its target the motion never sticks, so it makes progress along v, at the least on the
    edges of the preimage that it may slide on. What has hardly moved for long enough has therefore
    arrived. Without a position sensor the clock alone tells: the way along v is no longer than the
    preimage is deep (theory 6).
    """
    space = setting.space
    may_stick, _ = command.sources.where(Behaviour.MAY_STICK)
    may_slide, _ = command.sources.where(Behaviour.MAY_SLIDE)
    edges = np.unique(preimage.contact.edge)
    edges = edges[may_slide[edges] & ~may_stick[edges]]
    beta = wrap(command.direction + np.pi - space.contact.normal[edges])
    progress = guaranteed_progress(
        beta, setting.uncertainty.control, setting.friction, setting.sliding
    )
    if progress <= 0.0:
        return None
    return sticking_condition(
        progress,
        setting.uncertainty.position,
        extent=_depth(setting, preimage, command.direction),
        resolution=space.tolerance.length,
    )


def _depth(setting: Setting, region: Region, direction: float) -> float:
    """How far a region extends along a direction."""
    contact = setting.space.contact
    inside = region.contact
    points = np.concatenate(
        (
            *region.area.rings,
            contact.at(inside.edge, inside.low),
            contact.at(inside.edge, inside.high),
            contact.points[inside.vertices],
        )
    )
    if not len(points):
        return 0.0
    along = points @ np.array(unit(direction))
    return float(along.max() - along.min())
