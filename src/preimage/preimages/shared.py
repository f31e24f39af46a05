"""Aiming at several goals at once: what of each is told, by reading or by rest (theory 7, paper 8).

Once a motion rests, it is known to be on a feature of the target that sticks for sure. Which goal
that is must be read from this alone: of two pieces that may be confused, and that no goal holds
together, one has to go, and dropping it frees the other.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact import Bools
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

MOST_PIECES = 16
"""Of what confuses something else so many pieces, the largest, are tried on their own."""


@dataclass(frozen=True, slots=True, eq=False)
class Shares:
    """What of several goals a motion can be known to have attained.

    Parameters
    ----------
    told : the kernels of the goals, without what had to go.
    dropped : the places, among the goals, of those of which something that sticks had to go.
    target : all of them together, and the vertices that are told by one goal or another.
    """

    told: tuple[Region, ...]
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
) -> Shares:
    """What a motion that aims at all goals at once can be known to have attained.

    Parameters
    ----------
    goals, told : the goals, and their parts of `told_part`.
    """
    space = setting.space
    near = space.tolerance.length
    pool = ContactSet.empty()
    dropped: tuple[int, ...] = ()
    if method is not Method.KERNEL:
        parts = [sticking_features(goal, command).contact for goal in goals]
        pool = resting(setting, goals, union_of(parts, near), command)
        dropped = tuple(
            place for place, part in enumerate(parts) if not contact_set.is_subset(part, pool, near)
        )
        told = [Region(one.area, told_at_rest(one.contact, pool, command)) for one in told]
    areas = [part.area for part in told if not part.area.is_empty]
    core = Region(
        united(areas, space.tolerance.grid) if areas else Area.empty(),
        union_of([part.contact for part in told], near),
    )
    sticking = Region(Area.empty(), pool)
    if len(goals) > 1 and method is not Method.STICKING:
        core = _with_vertices(setting, goals, core, sticking, command, method)
    both = Region(core.area, contact_set.union(core.contact, pool, near))
    return Shares(tuple(told), dropped, Target(both, sticking, core))


def told_at_rest(told: ContactSet, pool: ContactSet, command: Command) -> ContactSet:
    """The contact of a kernel without what sticks for sure but is not in the pool that is kept."""
    near = command.setting.space.tolerance.length
    surely = sticking_features(Region(Area.empty(), told), command).contact
    gone = contact_set.difference(surely, pool, near)
    return told if gone.is_empty else contact_set.difference(told, gone, near)


# --- what holds motions for sure ------------------------------------------------------------


def resting(
    setting: Setting,
    goals: Sequence[Region],
    sticking: ContactSet,
    command: Command,
    kept: ContactSet | None = None,
) -> ContactSet:
    """A large part S of what sticks for sure in which each point tells some goal.

    `S <= U_i kernel(T_i; v, S)`: what cannot be told from all of S outside a goal, for any of its
    goals, goes; then what has gone comes back, piece by piece, the largest first, as far as it
    confuses nothing that is there. What is as thin as the tolerance is told too: for that the
    position error counts as larger by as much.

    Parameters
    ----------
    sticking : what of the goals sticks for sure.
    kept : a part that told some goal before, when the goals held no more; all of it stays.
    """
    near = setting.space.tolerance.length
    kept = ContactSet.empty() if kept is None else kept
    pool = contact_set.union(sticking, kept, near)
    while True:
        doubtful = _untold(setting, goals, pool, command)
        if doubtful.is_empty:
            break
        # what was kept is told, were it not for what is new
        new = contact_set.difference(pool, kept, near)
        lasting = contact_set.intersection(doubtful, kept, near)
        rest = contact_set.difference(new, doubtful, near)
        clear = told_apart(setting.space, command.readings, rest, lasting, setting.blurred)
        smaller = contact_set.union(kept, clear, near)
        if contact_set.is_subset(pool, smaller, near):
            smaller = kept  # no wider than what is taken for nothing
        pool = smaller
        if contact_set.is_subset(pool, kept, near):
            pool = kept
            break
    gone = contact_set.difference(sticking, pool, near)
    for piece in _pieces(gone)[:MOST_PIECES]:
        more = contact_set.union(pool, piece, near)
        doubtful = _untold(setting, goals, more, command)
        if contact_set.is_subset(doubtful, piece, near):
            pool = contact_set.difference(more, doubtful, near)
    return pool


def told_of(setting: Setting, goal: Region, pool: ContactSet, command: Command) -> ContactSet:
    """`kernel(T; v, S)`: what of a pool that holds the robot surely tells a goal."""
    near = setting.space.tolerance.length
    own = contact_set.intersection(pool, goal.contact, near)
    other = contact_set.difference(pool, goal.contact, near)
    return told_apart(setting.space, command.readings, own, other, setting.blurred)


def _untold(
    setting: Setting, goals: Sequence[Region], pool: ContactSet, command: Command
) -> ContactSet:
    """What of a pool tells no goal; a goal that holds much of it is asked first."""
    near = setting.space.tolerance.length
    left = pool
    own = [contact_set.intersection(pool, goal.contact, near) for goal in goals]
    order = sorted(range(len(goals)), key=lambda place: _amount(own[place]), reverse=True)
    for place in order:
        if left.is_empty:
            break
        if contact_set.intersection(left, own[place], near).is_empty:
            continue
        told = told_of(setting, goals[place], pool, command)
        left = contact_set.difference(left, told, near)
    return left


def _pieces(part: ContactSet) -> list[ContactSet]:
    """Intervals and vertices one by one, the longest first."""
    none = np.empty(0)
    pieces = [
        ContactSet(part.edge[one], part.low[one], part.high[one], np.empty(0, np.int32))
        for one in (slice(place, place + 1) for place in range(len(part.edge)))
    ]
    pieces.sort(key=_amount, reverse=True)
    corners = [
        ContactSet(np.empty(0, np.int32), none, none, part.vertices[place : place + 1])
        for place in range(len(part.vertices))
    ]
    return pieces + corners


def _amount(part: ContactSet) -> tuple[float, int]:
    return part.total_length, len(part.vertices)


def union_of(parts: Iterable[ContactSet], near: float) -> ContactSet:
    """The union of parts of contact space."""
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
    known = np.union1d(core.contact.vertices, sticking.contact.vertices)
    inside = np.unique(np.concatenate([goal.contact.vertices for goal in goals]))
    missing = np.setdiff1d(inside[may_be_told(command, method)[inside]], known)
    if not len(missing):
        return core
    found = told_together(setting.space, command.readings, goals, missing, setting.uncertainty)
    contact = core.contact
    vertices = np.union1d(contact.vertices, found).astype(np.int32)
    return Region(core.area, ContactSet(contact.edge, contact.low, contact.high, vertices))


def may_be_told(command: Command, method: Method) -> Bools:
    """The vertices of which it matters whether some goal is told there: those that may hold."""
    _, may_stick = command.sources.where(Behaviour.MAY_STICK)
    matters = may_stick.copy()
    if method is Method.COMBINED:  # what sticks for sure is told at rest
        _, surely = command.sources.where(Behaviour.STICKS_SURELY)
        matters &= ~surely
    matters[command.setting.space.contact.outermost] = False
    return matters
