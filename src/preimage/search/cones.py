"""What holds for an interval of directions: the same setting with another control cone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from preimage.configuration.region import Region
from preimage.preimages.setting import Setting

SLACK = 1024.0
"""Cones are wider, or narrower, by this many tolerances of angles than their interval asks for:
more than what ties are decided by, than a sweep is turned by where rounding spoils it, and than the
slimmest wedge that a single avoidable point takes from above."""


def widened(setting: Setting, half: float, goals: Sequence[Region]) -> Setting | None:
    """A setting whose preimage for v lies in those for all directions within `half` of v.

    The control cone `theta + half` around v contains those of all these directions: features may
    do more, stick for sure less often, are alike more often, and the sweep leaves less (theory 7).
    Arcs of kernels depend on the direction within their tolerance: around a goal that has an area
    the position error is raised by as much.

    Parameters
    ----------
    half : half the interval, radians.

    Returns
    -------
    None where the cone would have a right angle or more: then nothing is known.
    """
    near = setting.space.tolerance
    control = setting.uncertainty.control + half + SLACK * near.angle
    if control >= 0.5 * math.pi - SLACK * near.angle:
        return None
    position = setting.uncertainty.position
    if half > 0.0 and any(not goal.area.is_empty for goal in goals):
        position = max(position, near.length) * (1.0 + setting.arc_tolerance) + near.length
    return _with(setting, control, position)


def narrowed(setting: Setting, half: float, goals: Sequence[Region]) -> Setting | None:
    """A setting whose preimage for v contains those for all directions within `half` of v.

    The control cone `theta - half` around v lies in those of all these directions.

    Returns
    -------
    None where the interval is wider than the control cone: then nothing is known.
    """
    near = setting.space.tolerance
    control = setting.uncertainty.control - half - SLACK * near.angle
    if control < SLACK * near.angle:
        return None
    return _with(setting, control, narrowed_position(setting, goals))


def narrowed_position(setting: Setting, goals: Sequence[Region]) -> float:
    """A position error whose kernels contain those of the setting, whatever their arcs touch."""
    position = setting.uncertainty.position
    if math.isfinite(position) and any(not goal.area.is_empty for goal in goals):
        near = setting.space.tolerance.length
        position = max(position / (1.0 + setting.arc_tolerance) - near, 0.0)
    return position


def alone(setting: Setting) -> Setting:
    """The same setting, which keeps its commands for itself: of a bisection none is met again."""
    return replace(setting, _commands={})


def _with(setting: Setting, control: float, position: float) -> Setting:
    uncertainty = replace(setting.uncertainty, control=control, position=position)
    return replace(setting, uncertainty=uncertainty, _commands={})
