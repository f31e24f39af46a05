"""Aiming at several goals at once: what of each is told, by reading or by rest (theory 7, paper 8).

Once a motion rests, it is known to be on a feature of the target that sticks for sure. Which goal
that is must be read from this alone: of two pieces that may be confused, and of which no goal
holds both, one has to go, and dropping it frees the other.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry.area import Area
from preimage.geometry.overlay import united
from preimage.mechanics.behaviour import Behaviour
from preimage.preimages.preimage import Target
from preimage.preimages.setting import Command, Setting
from preimage.preimages.sticking import sticking_features
from preimage.recognition.confusion import told_apart, told_together
from preimage.recognition.kernel import kernel
from preimage.task.options import Method


@dataclass(frozen=True, slots=True, eq=False)
class Shares:
    """What of several goals a motion can be known to have attained, goal by goal.

    Parameters
    ----------
    told : the kernels of the goals, without what had to go.
    held : what of the goals sticks for sure, and is told from all the rest of it: disjoint.
    dropped : the places, among the goals, of those that lost a part to another goal.
    target : all of them together, and the vertices that are told by one goal or another.
    """

    told: tuple[Region, ...]
    held: tuple[ContactSet, ...]
    dropped: tuple[int, ...]
    target: Target


def told_part(setting: Setting, goal: Region, command: Command, method: Method) -> Region:
    """What of a goal readings alone tell; nothing where the method does not ask them."""
    if method is Method.STICKING:
        return Region.empty()
    return kernel(
        setting.space, command.readings, goal, setting.uncertainty,
        arc_tolerance=setting.arc_tolerance,
    )  # fmt: skip


def share_out(
    setting: Setting,
    goals: Sequence[Region],
    told: Sequence[Region],
    command: Command,
    method: Method,
    kept: Sequence[ContactSet] = (),
    first: int | None = None,
) -> Shares:
    """What a motion that aims at all goals at once can be known to have attained.

    Parameters
    ----------
    goals, told : the goals, the dearest first, and their parts of `told_part`.
    kept : what the first of the goals were allotted before, none of which is dropped.
    first : the place of a goal whose parts come before all others, those that were kept too.
    """
    space = setting.space
    near = space.tolerance.length
    held: tuple[ContactSet, ...] = tuple(ContactSet.empty() for _ in goals)
    dropped: tuple[int, ...] = ()
    surely = _surely(told, command)
    if method is not Method.KERNEL:
        held, dropped = _allotted(setting, goals, surely, command, kept, first)
        rest = _union(held, near)
        told = [_without(part, sure, rest, near) for part, sure in zip(told, surely, strict=True)]
    areas = [part.area for part in told if not part.area.is_empty]
    core = Region(
        united(areas, space.tolerance.grid) if areas else Area.empty(),
        _union([part.contact for part in told], near),
    )
    sticking = Region(Area.empty(), _union(held, near))
    if len(goals) > 1 and method is not Method.STICKING:
        core = _with_vertices(setting, goals, core, sticking, command, method)
    both = Region(core.area, contact_set.union(core.contact, sticking.contact, near))
    return Shares(tuple(told), held, dropped, Target(both, sticking, core))


def _surely(told: Sequence[Region], command: Command) -> list[ContactSet]:
    return [sticking_features(part, command).contact for part in told]


def _without(part: Region, sure: ContactSet, rest: ContactSet, near: float) -> Region:
    """A kernel without what holds motions for sure but is not told from the rest of that."""
    gone = contact_set.difference(sure, rest, near)
    if gone.is_empty:
        return part
    return Region(part.area, contact_set.difference(part.contact, gone, near))


# --- what holds motions for sure ------------------------------------------------------------

Allotment = tuple[tuple[ContactSet, ...], tuple[int, ...]]


def _allotted(
    setting: Setting,
    goals: Sequence[Region],
    surely: Sequence[ContactSet],
    command: Command,
    kept: Sequence[ContactSet],
    first: int | None,
) -> Allotment:
    """Which parts of the goals that stick for sure are kept, and for which goal.

    Where two goals' parts must not both stay, it is tried which of the goals is served first, and
    the least of all losses is taken.
    """
    every = [sticking_features(goal, command).contact for goal in goals]
    order = list(range(len(goals)))
    if first is not None:
        order.remove(first)
        turns = [[(first, every[first])]]
        kept = ()
    else:
        turns = [[]]
    best = _in_turn(setting, goals, surely, every, command, kept, turns[0], order)
    if first is not None:
        return best
    for goal in best[1]:
        others = [one for one in order if one != goal]
        favoured = [(goal, every[goal])]
        other = _in_turn(setting, goals, surely, every, command, kept, favoured, others)
        if _amount(other[0]) > _amount(best[0]):
            best = other
    return best


def _in_turn(
    setting: Setting,
    goals: Sequence[Region],
    surely: Sequence[ContactSet],
    every: Sequence[ContactSet],
    command: Command,
    kept: Sequence[ContactSet],
    favoured: list[tuple[int, ContactSet]],
    order: list[int],
) -> Allotment:
    """Parts are added one after the other, as far as they confuse nothing that is there."""
    near = setting.space.tolerance.length
    held = [*kept, *(ContactSet.empty() for _ in range(len(goals) - len(kept)))]
    pool = _union(held, near)
    dropped: dict[int, None] = {}
    # what readings tell comes first: it confuses the others least
    candidates = [*favoured, *((one, surely[one]) for one in order)]
    candidates += [(one, every[one]) for one in order]
    for place, candidate in candidates:
        new = contact_set.difference(candidate, pool, near)
        if new.is_empty:
            continue
        fitting = _fitting(setting, goals, held, pool, command, place, new)
        if not contact_set.difference(new, fitting, near).is_empty:
            dropped[place] = None
        held[place] = contact_set.union(held[place], fitting, near)
        pool = contact_set.union(pool, fitting, near)
    lost = (place for place in dropped if not contact_set.is_subset(every[place], pool, near))
    return tuple(held), tuple(lost)


def _fitting(
    setting: Setting,
    goals: Sequence[Region],
    held: Sequence[ContactSet],
    pool: ContactSet,
    command: Command,
    place: int,
    new: ContactSet,
) -> ContactSet:
    """What of a part of a goal may be added to what is held: neither confuses the other."""
    near, readings = setting.space.tolerance.length, command.readings
    arguments = setting.space, readings
    foreign = contact_set.difference(pool, goals[place].contact, near)
    new = told_apart(*arguments, new, foreign, setting.uncertainty)
    for other, part in enumerate(held):
        if other == place or part.is_empty or new.is_empty:
            continue
        alien = contact_set.difference(new, goals[other].contact, near)
        apart = told_apart(*arguments, alien, part, setting.uncertainty)
        new = contact_set.difference(new, contact_set.difference(alien, apart, near), near)
    return new


def _amount(held: Iterable[ContactSet]) -> tuple[float, int]:
    parts = list(held)
    return sum(one.total_length for one in parts), sum(len(one.vertices) for one in parts)


def _union(parts: Iterable[ContactSet], near: float) -> ContactSet:
    return reduce(
        lambda one, other: contact_set.union(one, other, near),
        (part for part in parts if not part.is_empty),
        ContactSet.empty(),
    )


# --- vertices that are told by one goal or another ------------------------------------------


def _with_vertices(
    setting: Setting,
    goals: Sequence[Region],
    core: Region,
    sticking: Region,
    command: Command,
    method: Method,
) -> Region:
    """Kernels together with the vertices at which every reading tells some goal.

    Only those are looked for that may hold the motion: past others it goes.
    """
    _, may_stick = command.sources.where(Behaviour.MAY_STICK)
    if method is Method.COMBINED:  # what sticks for sure has been allotted
        _, surely = command.sources.where(Behaviour.STICKS_SURELY)
        may_stick = may_stick & ~surely
    known = np.union1d(core.contact.vertices, sticking.contact.vertices)
    inside = np.unique(np.concatenate([goal.contact.vertices for goal in goals]))
    missing = np.setdiff1d(inside[may_stick[inside]], known)
    missing = np.setdiff1d(missing, setting.space.contact.outermost)
    if not len(missing):
        return core
    found = told_together(setting.space, command.readings, goals, missing, setting.uncertainty)
    contact = core.contact
    vertices = np.union1d(contact.vertices, found).astype(np.int32)
    return Region(core.area, ContactSet(contact.edge, contact.low, contact.high, vertices))
