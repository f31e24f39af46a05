"""What nature makes the sensors read (theory 3, 8): positions and forces within their errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from preimage.configuration.contact import Floats
from preimage.execution.contact_forces import contact_forces
from preimage.execution.nearest import nearest
from preimage.execution.situation import Situation
from preimage.geometry.angles import wrap

INSIDE = 1.0 - 1e-9
"""The errors' bounds are open: nature stays this far within them."""

Offset = Callable[[Situation], Floats]
"""(k, 2) where the measured position is off, in units of the position error."""

Tilt = Callable[[Situation], Floats]
"""(k,) how the force's direction is off, in units of the force's error, from -1 to 1."""


@dataclass(frozen=True, slots=True)
class Sensing:
    """An adversary for sensing: an error of position, one of force, and what counts as none.

    Parameters
    ----------
    offset, tilt : the errors.
    zero : whether 0 is read wherever it may be; else only where it must.
    still : how much of twice the position error a displacement seems smaller than it is: 1 where
        the error may turn round at will, 0 where it persists, -1 where displacements seem larger.
    """

    offset: Offset
    tilt: Tilt
    zero: bool = False
    still: float = 0.0


def exact(now: Situation) -> Floats:
    """No error."""
    return np.zeros((len(now), 2))


def persistent(now: Situation) -> Floats:
    """An offset of its own for each robot, kept through the run: the whole error, or less."""
    turn = 2.0 * np.pi * now.lots[:, 2]
    reach = np.minimum(1.0, 1.5 * now.lots[:, 3])
    return np.asarray(reach[:, None] * np.stack((np.cos(turn), np.sin(turn)), axis=1))


def scattered(now: Situation) -> Floats:
    """Anywhere in the disc, each time anew."""
    turn, reach = 2.0 * np.pi * now.chance(), np.sqrt(now.chance())
    return np.asarray(reach[:, None] * np.stack((np.cos(turn), np.sin(turn)), axis=1))


def _along(sign: float) -> Offset:
    def offset(now: Situation) -> Floats:
        # the goal's border half of the time, else that of the target, which lies within it
        goal = now.chance() < 0.5
        found = np.where(
            goal[:, None],
            nearest(now.robots.places, now.motion.goal),
            nearest(now.robots.places, now.motion.target_outline),
        )
        gap = found - now.robots.places
        length = np.hypot(gap[:, 0], gap[:, 1])
        known = length > now.motion.simulator.space.tolerance.length
        there = sign * gap / np.where(known, length, 1.0)[:, None]
        return np.where(known[:, None], there, scattered(now))

    return offset


towards, away = _along(1.0), _along(-1.0)


def straight(now: Situation) -> Floats:
    """The force's own direction."""
    return np.zeros(len(now))


def turned(share: float) -> Tilt:
    """So much of the error to the left."""

    def tilt(now: Situation) -> Floats:
        return np.full(len(now), share)

    return tilt


def either_end(now: Situation) -> Floats:
    """One end of the error's cone or the other."""
    return np.where(now.chance() < 0.5, 1.0, -1.0)


def anyhow(now: Situation) -> Floats:
    """Any direction within the error."""
    return 2.0 * now.chance() - 1.0


def read(sensing: Sensing, now: Situation, angle: Floats) -> tuple[Floats, Floats]:
    """What both sensors read of robots under actual directions.

    Parameters
    ----------
    angle : (k,) actual directions, radians.

    Returns
    -------
    positions : (k, 2), NaN without a position sensor.
    forces : (k,) angles, NaN where 0 is read.
    """
    senses = now.motion.uncertainty
    if senses.has_position_sensor:
        offset = sensing.offset(now)
        size = np.hypot(offset[:, 0], offset[:, 1])
        offset = offset / np.maximum(size, 1.0)[:, None]
        positions = now.robots.places + INSIDE * senses.position * offset
    else:
        positions = np.full((len(now), 2), np.nan)
    direction, magnitude = contact_forces(now.motion.simulator, now.robots, angle, now.chance())
    low, high = senses.force_thresholds
    felt = magnitude > (high if sensing.zero else low)
    tilt = np.clip(sensing.tilt(now), -1.0, 1.0)
    measured = wrap(direction + INSIDE * senses.force_angle * tilt)
    forces = np.where(felt, measured, np.nan)
    return positions, forces


SENSINGS: dict[str, Sensing] = {
    "true": Sensing(exact, straight),
    "towards": Sensing(towards, either_end, still=1.0),
    "away": Sensing(away, either_end, still=-1.0),
    "persistent": Sensing(persistent, anyhow),
    "turned-left": Sensing(towards, turned(1.0), still=1.0),
    "turned-right": Sensing(towards, turned(-1.0), still=1.0),
    "zero": Sensing(towards, either_end, zero=True, still=1.0),
    "noise": Sensing(scattered, anyhow, still=0.5),
}
"""The adversaries for sensing, by name."""
