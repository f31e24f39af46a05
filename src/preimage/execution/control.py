"""What nature does to the command (theory 2, 8): actual directions within the control cone.

An adversary is a function of a `Situation` that returns `Choices`; one of your own looks like this:

>>> def swinging(now):
...     '''From side to side, every half a unit of length.'''
...     side = np.where(np.floor(2.0 * now.time) % 2 == 0, 1.0, -1.0)
...     return now.choices(side * now.cone, duration=0.5)

and is handed to `run(strategy, control={"swinging": swinging})`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from preimage.configuration.contact import Floats
from preimage.execution.nearest import nearest
from preimage.execution.simulator import Choices, Wish
from preimage.execution.situation import Situation
from preimage.geometry.angles import wrap

Control = Callable[[Situation], Choices]


def constant(share: float) -> Control:
    """The same direction throughout, so much of the cone to the left."""

    def choose(now: Situation) -> Choices:
        return now.choices(share * now.cone)

    return choose


def bias(now: Situation) -> Choices:
    """A direction of its own for each robot, kept through the run."""
    return now.choices((2.0 * now.lots[:, 0] - 1.0) * now.cone)


def switching(now: Situation) -> Choices:
    """One side of the cone until something is met, then the other."""
    return now.choices(np.where((now.met + (now.lots[:, 0] < 0.5)) % 2 == 0, 1.0, -1.0) * now.cone)


def drifting(now: Situation) -> Choices:
    """Along one side of the cone for a while, then along the other."""
    side = np.where(now.chance() < 0.5, 1.0, -1.0)
    return now.choices(side * now.cone, _whiles(now))


def restless(now: Situation) -> Choices:
    """Any direction, for a short or a long while."""
    return now.choices((2.0 * now.chance() - 1.0) * now.cone, _whiles(now))


def hunting(now: Situation) -> Choices:
    """Towards the nearest place at which the robot may get stuck outside the target, or escape."""
    return _towards(now, now.motion.hazards)


def fleeing(now: Situation) -> Choices:
    """Away from the target, as far as the cone allows."""
    gap = nearest(now.robots.places, now.motion.target_outline) - now.robots.places
    turn = now.turn_to(np.arctan2(gap[:, 1], gap[:, 0]) + np.pi)
    known = np.isfinite(turn) & (np.abs(turn) < np.pi)
    return now.choices(np.where(known, turn, 0.0), _whiles(now), Wish.LEAVE)


def sticking(now: Situation) -> Choices:
    """Presses against what is touched, so that it sticks whenever it can."""
    contact, feature = now.motion.simulator.space.contact, now.robots.feature
    n = len(contact)
    edge = np.where(feature < n, feature, np.where(feature < 2 * n, feature - n, 0))
    other = np.where(feature < n, edge, contact.previous[edge])
    turns = [now.turn_to(contact.normal[side] + np.pi) for side in (edge, other)]
    # of a vertex's edges, the one that can be pressed against more squarely
    turn = np.where(np.abs(turns[0]) <= np.abs(turns[1]), *turns)
    tilt = now.motion.simulator.friction * np.sign(turn)
    squarely = now.lots[:, 1] < 0.5  # the others at the rim of the friction cone
    turn = np.where(squarely | (np.abs(turn) < np.abs(tilt)), turn, turn - tilt)
    free = (2.0 * now.lots[:, 0] - 1.0) * now.cone
    return now.choices(np.where(now.touching, turn, free), _whiles(now), Wish.REST)


def _towards(now: Situation, segments: Floats) -> Choices:
    """Towards the nearest of some segments; just there is any direction."""
    gap = nearest(now.robots.places, segments) - now.robots.places
    reach = np.hypot(gap[:, 0], gap[:, 1])
    turn = now.turn_to(np.arctan2(gap[:, 1], gap[:, 0]))
    at = ~(reach > now.motion.simulator.space.tolerance.length)
    turn = np.where(at, (2.0 * now.chance() - 1.0) * now.cone, wrap(turn))
    return now.choices(turn, np.where(at, np.inf, reach))


def _whiles(now: Situation) -> Floats:
    """Durations of very different lengths."""
    return np.asarray(now.scale * 10.0 ** (-2.0 * now.chance()))


def mixed(*adversaries: Control) -> Control:
    """One of several adversaries by chance, at every choice anew."""

    def choose(now: Situation) -> Choices:
        return _one_of(now, adversaries, np.floor(now.chance() * len(adversaries)).astype(int))

    return choose


def by_contact(free: Control, touching: Control) -> Control:
    """One adversary in free space, another one in contact."""

    def choose(now: Situation) -> Choices:
        return _one_of(now, (free, touching), now.touching.astype(int))

    return choose


def _one_of(
    now: Situation,
    adversaries: tuple[Control, ...],
    pick: np.ndarray[tuple[int], np.dtype[np.int_]],
) -> Choices:
    made = now.choices(0.0)
    for number, adversary in enumerate(adversaries):
        which = pick == number
        if np.any(which):
            chosen = adversary(now.part(which))
            for name in ("angle", "duration", "wish", "chance"):
                getattr(made, name)[which] = getattr(chosen, name)
    return made


CONTROLS: dict[str, Control] = {
    "exact": constant(0.0),
    "left": constant(1.0),
    "right": constant(-1.0),
    "bias": bias,
    "switching": switching,
    "drifting": drifting,
    "random": restless,
    "hunting": hunting,
    "fleeing": fleeing,
    "sticking": sticking,
    "mixed": mixed(switching, drifting, hunting, sticking),
}
"""The adversaries for control, by name."""
