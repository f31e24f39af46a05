"""Why there is no strategy: what stands in the way of a motion, as data."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.tolerance import ANGLE
from preimage.strategy.words import count, direction_words, joined, number, place
from preimage.task.degrees import to_degrees
from preimage.task.workspace import Side

Point = tuple[float, float]

PART = 1e-6
"""Of an edge, this is nothing to people."""


class ReasonKind(Enum):
    """What stands in the way."""

    TRAP = "trap"  # it may stop outside all that is known to lead on
    CONFUSED = "confused"  # it may stop where it should, and what is read there is read elsewhere
    UNSURE = "unsure"  # it may stop where it should, but need not
    ESCAPE = "escape"  # it may leave the window
    NOTHING_RECOGNISED = "nothing recognised"  # there is nothing that the motion could aim at
    SEVERAL = "several"  # it ends where it should, but which region that is varies
    SPLIT = "split"  # each place of the start is in some region, but not all of them in one
    UNEXPLORED = "unexplored"  # nothing stands in the way: a limit came first
    UNKNOWN = "unknown"  # hidden by rounding, or one of too many regions


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a motion from a place of the start is no beginning of a strategy (theory 4, 5).

    Parameters
    ----------
    direction : the commanded direction, radians; None where no motion is meant.
    origin : the place of the start; None where the reason is not about one place.
    words : what stands in the way, with the direction in words.
    feature : where the motion may stop, or the open side by which it may leave; None if it does
        neither. Edge `i` is `i`, vertex `i` is `n + i`, free space is `2 n`.
    place : a place of the feature that the motion may reach.
    other : the feature that `feature` is confused with.
    reading : a force that both may read, as an interval of angles in radians; None if there is
        none, so that it is no force that both may read.
    """

    kind: ReasonKind
    direction: float | None
    origin: Point | None
    words: str
    feature: int | None = None
    place: Point | None = None
    other: int | None = None
    reading: tuple[float, float] | None = None


def told(reasons: Sequence[Reason], most: int = 4) -> list[Reason]:
    """The reasons that are worth telling: all of the first direction, one of each other.

    Of the directions that have nothing to aim at, one stands for all.
    """
    chosen: list[Reason] = []
    for reason in reasons:
        fresh = all(known.direction != reason.direction for known in chosen)
        aimless = reason.kind is ReasonKind.NOTHING_RECOGNISED
        first = not aimless or all(known.kind is not reason.kind for known in chosen)
        if (fresh and first) or reason.direction == reasons[0].direction:
            chosen.append(reason)
    return chosen[:most]


def shown_reasons(reasons: Sequence[Reason], most: int = 4) -> list[str]:
    """What stands in the way, in a few lines."""
    chosen = told(reasons, most)
    origin = next((reason.origin for reason in reasons if reason.origin), None)
    lines = []
    for reason in chosen:
        elsewhere = reason.origin is not None and reason.origin != origin
        lead = f"from {place(reason.origin)} " if elsewhere and reason.origin else ""
        lines.append(f"{lead}{reason.words}")
    shown = {reason.direction for reason in chosen}
    rest = {one.direction for one in reasons} - shown
    if rest:
        along = count(len(rest), "other direction")
        aimless = all(
            one.kind is ReasonKind.NOTHING_RECOGNISED for one in reasons if one.direction in rest
        )
        lines.append(f"{along}: nothing to aim at" if aimless else f"and something for {along}")
    return lines


# --- in words -------------------------------------------------------------------------------


def feature_words(feature: int, space: ConfigurationSpace) -> str:
    """A feature with its place."""
    contact, count = space.contact, len(space.contact)
    if feature >= 2 * count:
        return "free space"
    if feature >= count:
        vertex = feature - count
        kind = "corner" if contact.concave[vertex] else "tip"
        return f"the {kind} {place(contact.points[vertex])}"
    return f"the edge {place(contact.points[feature])} to {place(contact.ends[feature])}"


def force_words(reading: tuple[float, float] | None, both_zero: bool) -> str:
    """What can be read at two features.

    >>> force_words((1.5, 1.5), True)
    'no force, or a force of 85.9437°'
    """
    words = ["no force"] if both_zero else []
    if reading is not None:
        low, high = reading
        turn = high - low
        if turn >= 2.0 * math.pi - ANGLE:
            words.append("a force of any direction")
        elif turn <= ANGLE:
            words.append(f"a force of {_around(low)}")
        else:
            words.append(f"a force of {_around(low)} to {_around(high)}")
    return ", or ".join(words)


def _around(radians: float) -> str:
    """A direction in [0, 360) degrees."""
    turn = to_degrees(radians) % 360.0
    return f"{number(0.0 if number(turn) == '360' else turn)}°"


def _stops(
    space: ConfigurationSpace, direction: float, feature: int, low: float, high: float
) -> str:
    """That a motion may stop on a part of an edge, or at a vertex."""
    contact, name = space.contact, feature_words(feature, space)
    lead = f"{direction_words(direction)}: may stop"
    if feature >= len(contact):
        return f"{lead} {'in' if contact.concave[feature - len(contact)] else 'on'} {name}"
    slack = PART * float(contact.length[feature])
    if low <= slack and high >= float(contact.length[feature]) - slack:
        return f"{lead} on {name}"
    first, last = contact.at(np.array([feature] * 2), np.array([low, high]))
    if place(first) == place(last):
        return f"{lead} at {place(first)} on {name}"
    return f"{lead} between {place(first)} and {place(last)} on {name}"


def region_name(number: int) -> str:
    """The goal, or the number of a region."""
    return "the goal" if number == 0 else f"region {number}"


def trap(
    space: ConfigurationSpace,
    direction: float,
    feature: int,
    low: float,
    high: float,
    several: bool,
) -> str:
    """It may stop outside all regions."""
    where = _stops(space, direction, feature, low, high)
    return f"{where}, which is in no region that leads on" if several else f"{where}, off the goal"


def unsure(
    space: ConfigurationSpace, direction: float, feature: int, low: float, high: float, region: int
) -> str:
    """It may stop in a region, but need not."""
    where = _stops(space, direction, feature, low, high)
    return f"{where}, in {region_name(region)}, but is not sure to stop there"


def confused(
    space: ConfigurationSpace,
    direction: float,
    feature: int,
    low: float,
    high: float,
    region: int,
    other: int,
    reading: tuple[float, float] | None,
    both_zero: bool,
) -> str:
    """It may stop in a region, and not know it."""
    where = _stops(space, direction, feature, low, high)
    name = "the rest of that edge" if other == feature else feature_words(other, space)
    alike = force_words(reading, both_zero)
    return f"{where}, in {region_name(region)}, which reads like {name}: {alike}"


def escape(direction: float, sides: Sequence[Side]) -> str:
    """It may leave the window.

    >>> escape(math.pi, [Side.LEFT, Side.TOP])
    'left (180°): may leave through the left or top side of the window'
    """
    names = joined([side.value for side in sides], "or")
    return f"{direction_words(direction)}: may leave through the {names} side of the window"


def nothing(
    space: ConfigurationSpace,
    direction: float,
    sticking: bool,
    several: bool,
    feature: int,
    other: int | None,
    reading: tuple[float, float] | None,
    both_zero: bool,
) -> str:
    """No part of any region is recognised.

    Parameters
    ----------
    sticking : only what holds the motion for sure would be.
    """
    where = "the goal or another known region" if several else "the goal"
    lead = direction_words(direction)
    if sticking:
        return f"{lead}: nothing in {where} is sure to hold it"
    words = f"{lead}: nothing in {where} is recognised"
    if other is None:
        return words
    name = feature_words(feature, space)
    rest = "the rest of it" if other == feature else feature_words(other, space)
    return f"{words}; {name} reads like {rest}: {force_words(reading, both_zero)}"


def several(direction: float) -> str:
    """It ends in one of several regions."""
    return (
        f"{direction_words(direction)}: ends in one of several regions, which a linear strategy"
        " cannot tell beforehand"
    )


def unexplored(direction: float) -> str:
    """Nothing stands in the way."""
    return f"{direction_words(direction)}: nothing stands in the way of one more motion"


def unknown(direction: float) -> str:
    """What stands in the way was not found."""
    return f"{direction_words(direction)}: what stands in the way has not been found"


def at_the_border(region: int, direction: float | None) -> str:
    """A region holds the start but for rounding."""
    return f"{_leading(direction)}the start reaches to the very border of {region_name(region)}"


def split(
    point: Point, region: int, direction: float | None, other: int | None, turn: float | None
) -> str:
    """Each place of the start is in some region, but no region holds all of it."""
    words = f"{_leading(direction)}begins in {region_name(region)}, which holds a part of the start"
    if other is None:
        return f"{words}, but not {place(point)}"
    begins = "" if turn is None else f", where {direction_words(turn)} is commanded"
    return f"{words}; {place(point)} is in {region_name(other)}{begins}"


def _leading(direction: float | None) -> str:
    return "" if direction is None else f"{direction_words(direction)}: "
