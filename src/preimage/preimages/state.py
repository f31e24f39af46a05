"""What is recognised by who knows where the motion began, and where it ends (theory 5, paper 7)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce

from preimage.configuration import contact_set
from preimage.configuration.region import Region, is_subset, union
from preimage.geometry import area as areas
from preimage.geometry.tolerance import Tolerance
from preimage.preimages.preimage import Target
from preimage.preimages.setting import Command, Setting
from preimage.preimages.shared import share_out
from preimage.preimages.sticking import sticking_features
from preimage.reachability.forward_projection import forward_project
from preimage.recognition.kernel import kernel
from preimage.task.options import Method, Termination

SPREAD = 1000.0
"""Motions spread by so many angle tolerances at least: what is thinner has no area."""

THIN = 1e5
"""With a control of fewer angle tolerances, what motions visit is as thin as a line for long."""

WIDER = 32.0
"""What is as thin as a line is taken to be so many tolerances wide to both sides."""

DESCENT = 6
"""So often the greatest fixpoint is approached from above, and the least one from below."""

BEYOND = 2.0
"""From above, radii are larger by so many times what arcs may be off."""


@dataclass(frozen=True, slots=True, eq=False)
class StatefulTarget:
    """What of some goals is recognised by motions that begin in `start` (theory 5).

    Parameters
    ----------
    start : R.
    target : what sticks for sure and is told by that, and chi; `target.kernel` is chi.
    reached : where motions from R get until the condition is true.
    domain : Delta, which holds that, and what is as thin as a line of it as a band.
    shares : of each goal, in their order, the part of chi that is recognised as that goal's.
    """

    start: Region
    target: Target
    reached: Region
    domain: Region
    shares: tuple[Region, ...]


def stateful_target(
    setting: Setting,
    goals: Sequence[Region],
    start: Region,
    direction: float,
    method: Method,
    termination: Termination,
) -> StatefulTarget:
    """What of the goals is recognised by who knows that the motion begins in `start`.

    With the initial state `Delta = FP_v(R)` and `chi = kernel(T; v, Delta)` (paper 7.2). With the
    final state, too, `Delta = FP_v(R)` stopped at chi, for a chi that lies in
    `F(chi) = kernel(T; v, FP_v(R) stopped at chi)` (paper 7.3): then the condition is true all
    over chi, so that nothing gets past it. `F` is monotone. From above, `T, F(T), F(F(T)), ...`,
    with radii a little larger, the first term that lies in its own image is taken, and that image
    with it. If there is none soon, the terms from below, which all are sound: they begin with the
    initial state's. What holds every motion for sure stops them, too.

    Several goals are told apart: chi is the union of what is recognised as one of them. Sticking
    is recognised without any state, see `share_out`.

    Parameters
    ----------
    start : R. Where its border is nature's line, as that of a backprojection is, motions from it
        leak past the target along that line: it should be pulled in, see `starts.pulled_in`.
    direction : radians.
    """
    command, near = setting.command(direction), setting.space.tolerance
    if method is Method.STICKING:
        found, raw = setting.space.valid, tuple(Region.empty() for _ in goals)
    else:
        found, raw = _Search(setting, command, tuple(goals), start).answer(termination)
    shared = share_out(setting, goals, raw, command, method)
    domain = widened(found, setting)
    if len(raw) == 1:  # what begins in chi has ended: it may as well belong
        found, domain = union(found, raw[0], near), union(domain, raw[0], near)
    return StatefulTarget(start, shared.target, found, domain, shared.told)


@dataclass(frozen=True, slots=True, eq=False)
class _Search:
    """The question that `stateful_target` answers."""

    setting: Setting
    command: Command
    goals: tuple[Region, ...]
    start: Region

    def answer(self, termination: Termination) -> tuple[Region, tuple[Region, ...]]:
        """Where motions get, and what is recognised of each goal."""
        match termination:
            case Termination.INSTANTANEOUS:
                return self.setting.space.valid, self.told(None)
            case Termination.INITIAL_STATE:
                found = self.reached(Region.empty())
                return found, self.told(found)
            case Termination.FINAL_STATE:
                return self.from_above() or self.from_below()

    def reached(self, stop: Region) -> Region:
        """`FP_v(R)`, stopped there and where every motion is held for sure."""
        near = self.setting.space.tolerance
        held = united([sticking_features(goal, self.command) for goal in self.goals], near)
        return visited(self.setting, self.start, self.command, union(stop, held, near))

    def told(self, found: Region | None, larger: float = 1.0) -> tuple[Region, ...]:
        """The kernel of each goal among what is reached, or anywhere.

        Parameters
        ----------
        larger : the position error is so many times larger.
        """
        setting = self.setting
        domain = None if found is None else widened(found, setting)
        error = setting.uncertainty
        if larger > 1.0:
            least = setting.space.tolerance.length
            error = replace(error, position=larger * max(error.position, least))
        return tuple(
            kernel(
                setting.space, self.command.readings, goal, error, domain,
                arc_tolerance=setting.arc_tolerance,
            )
            for goal in self.goals
        )  # fmt: skip

    def from_above(self) -> tuple[Region, tuple[Region, ...]] | None:
        """A chi that lies in `F(chi)`; None if the terms do not get there soon."""
        near = self.setting.space.tolerance
        larger = 1.0 + BEYOND * self.setting.arc_tolerance
        term = united(self.goals, near)
        for _ in range(DESCENT):
            found = self.reached(term)
            lower = united(self.told(found, larger), near)
            if is_subset(term, lower, near):
                shares = self.told(found)
                return (found, shares) if is_subset(term, united(shares, near), near) else None
            term = lower
        return None

    def from_below(self) -> tuple[Region, tuple[Region, ...]]:
        """The terms from below, as long as they grow."""
        near = self.setting.space.tolerance
        found = self.reached(Region.empty())
        shares = self.told(found)
        for _ in range(DESCENT):
            term = united(shares, near)
            if term.is_empty:
                break
            found = self.reached(term)
            shares = self.told(found)
            if is_subset(united(shares, near), term, near):
                break
        return found, shares


def visited(setting: Setting, start: Region, command: Command, stop: Region) -> Region:
    """What motions from `start` that end at `stop` visit, or more.

    With perfect control motions visit lines. Those get an area: the cone is opened by so many angle
    tolerances as `SPREAD` says.
    """
    space, control = setting.space, setting.uncertainty.control
    least = SPREAD * space.tolerance.angle
    found = forward_project(
        space, start, command.direction, max(control, least), setting.friction, stop
    ).region
    return Region(found.area, contact_set.without_outermost(found.contact, space.contact))


def widened(found: Region, setting: Setting) -> Region:
    """A domain that holds what motions visit: lines are bands, `WIDER` tolerances to both sides."""
    space = setting.space
    if setting.uncertainty.control > THIN * space.tolerance.angle or found.area.is_empty:
        return found
    wider = areas.shrunk(found.area, -WIDER * space.tolerance.length)
    return Region(areas.intersection(wider, space.free), found.contact)


def united(regions: Sequence[Region], tolerance: Tolerance) -> Region:
    """All configurations of any of the regions."""
    return reduce(lambda a, b: union(a, b, tolerance), regions, Region.empty())
