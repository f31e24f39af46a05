"""Forces that tell something: the ends of reading sets, what is between, and both in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from preimage.configuration.region import Region
from preimage.geometry.angles import TAU
from preimage.geometry.tolerance import ANGLE
from preimage.recognition.readings import Readings
from preimage.strategy.words import degrees


@dataclass(frozen=True, slots=True)
class Force:
    """No force, one direction at the end of a reading set, or the open interval between two ends.

    Parameters
    ----------
    angle : radians; None for no force.
    beyond : how far the open interval goes to either side of it; 0 for an end.
    """

    angle: float | None
    beyond: float = 0.0


def force_samples(sets: Readings, share: Region) -> list[Force]:
    """No force, and directions of forces: each end of a reading set, and one between any two.

    Only such as can be read in the share of a goal; by ascending angle, in [0, 2 pi).
    """
    contact, n = share.contact, sets.size
    inside = np.zeros(2 * n + 1, dtype=np.bool_)
    inside[contact.edge] = True
    inside[n + contact.vertices] = True
    inside[sets.free] = not share.area.is_empty
    found = [Force(None)] if bool(np.any(sets.zero & inside)) else []
    felt = sets.half >= 0.0
    ends = np.concatenate((sets.center - sets.half, sets.center + sets.half))
    ends = np.unique(np.round(np.mod(ends[np.tile(felt, 2)], TAU) / sets.tolerance))
    ends = np.unique(np.mod(ends * sets.tolerance, TAU))
    if not len(ends):
        return found
    gaps = np.mod(np.roll(ends, -1) - ends, TAU)
    gaps[gaps == 0.0] = TAU
    middles = np.mod(ends + 0.5 * gaps, TAU)
    every = [Force(end) for end in ends.tolist()]
    every += [Force(a, b) for a, b in zip(middles.tolist(), (0.5 * gaps).tolist(), strict=True)]
    every.sort(key=_angle)
    return found + [force for force in every if bool(np.any(sets.can_read(force.angle) & inside))]


def _angle(force: Force) -> float:
    return 0.0 if force.angle is None else force.angle


def force_words(chosen: list[tuple[Force, int]]) -> Iterator[str]:
    """Forces in words: none, and the intervals of directions."""
    felt = [(force, place) for force, place in chosen if force.angle is not None]
    if len(felt) < len(chosen):
        yield "none"
    runs: list[list[tuple[Force, int]]] = []
    for pair in felt:
        if runs and _follows(runs[-1][-1][0], pair[0]):
            runs[-1].append(pair)
        else:
            runs.append([pair])
    if len(runs) > 1 and _follows(runs[-1][-1][0], runs[0][0][0]):
        runs[0] = runs.pop() + runs[0]
    for run in runs:
        yield _interval(run[0][0], run[-1][0])


def _follows(one: Force, other: Force) -> bool:
    """Whether there is no force between the two: an end beside an open interval that has it."""
    if (one.beyond == 0.0) == (other.beyond == 0.0):
        return False
    gap = np.mod(_angle(other) - _angle(one), TAU)
    return bool(abs(gap - one.beyond - other.beyond) <= ANGLE)


def _interval(first: Force, last: Force) -> str:
    """An interval of directions, without the ends that do not belong.

    >>> _interval(Force(1.0, 0.5), Force(1.0, 0.5))
    'of more than 28.6479° and less than 85.9437°'
    """
    low, high = degrees(_angle(first) - first.beyond), degrees(_angle(last) + last.beyond)
    if first is last and first.beyond == 0.0:
        return f"of {low}"
    begin = f"from {low}" if first.beyond == 0.0 else f"of more than {low}"
    if first.beyond == 0.0:
        return f"{begin} to {'' if last.beyond == 0.0 else 'less than '}{high}"
    return f"{begin} and {'at most' if last.beyond == 0.0 else 'less than'} {high}"
