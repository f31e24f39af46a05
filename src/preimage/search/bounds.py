"""Regions that no linear strategy gets beyond, to lead a search by."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from preimage.configuration import contact_set
from preimage.configuration.region import Region, is_subset
from preimage.configuration.start import Start, covered
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.tolerance import Tolerance
from preimage.preimages.methods import aim
from preimage.preimages.setting import Setting
from preimage.preimages.sticking import sticking_features
from preimage.reachability.backprojection import backproject
from preimage.search.limits import Limits
from preimage.task.options import Method


class Sensing(Enum):
    """What of the goals is taken to be recognised when it is attained."""

    PERFECT = "perfect"
    """All of it: one sweep for each direction and layer."""
    GIVEN = "given"
    """What the method recognises of each goal by itself: tighter, a kernel for each goal too."""


@dataclass(slots=True, eq=False)
class Bounds:
    """Layers of regions that hold those of all linear strategies (theory 7, paper 9).

    With `G` the goal and `rec_v(R)` the part of a goal `R` that counts as recognised,

        U_v^(k) = B(rec_v(G) | union over u of rec_v(U_u^(k-1)), v).

    A preimage of a sequence of at most `k` motions, the first along `v`, lies in `U_v^(k)`: its
    goal is `G` or lies in some `U_u^(k-1)`; what the method recognises of a goal, kernel or
    sticking features, grows with the goal and lies in `rec_v`; backprojections grow with their
    targets. By the same law the layers grow with `k`. Each is made when it is asked for, none
    after one that adds nothing.

    Parameters
    ----------
    directions : radians.
    limits : of time; asked before each backprojection.
    layers : `layers[k - 1][v]` is `U_v^(k)`; the last stands for all later ones once `settled`.
    made : how many backprojections the layers took.
    settled : whether no further layer would add anything.
    stopped : which limit came first, if one did; the layers are then incomplete.
    """

    setting: Setting
    goal: Region
    directions: tuple[float, ...]
    method: Method
    sensing: Sensing = Sensing.PERFECT
    limits: Limits | None = None
    layers: list[dict[float, Region]] = field(default_factory=list)
    made: int = 0
    settled: bool = False
    stopped: str | None = None
    _union: Region = field(default_factory=Region.empty, repr=False)
    _targets: dict[float, Region] = field(default_factory=dict, repr=False)

    def region(self, motions: int, direction: float) -> Region | None:
        """What holds the preimages of strategies of so many motions that begin along `direction`.

        None if a limit came first.

        Parameters
        ----------
        motions : at least 1.
        """
        while len(self.layers) < motions and not self.settled and not self.stopped:
            self._extend()
        if len(self.layers) < motions and not self.settled:
            return None
        return self.layers[min(motions, len(self.layers)) - 1][direction]

    def first_motions(self, start: Start, motions: int) -> tuple[float, ...]:
        """The directions that a strategy of so many motions from the start may begin with."""
        space = self.setting.space
        regions = ((v, self.region(motions, v)) for v in self.directions)
        return tuple(v for v, region in regions if region and covered(start, region, space))

    def fewest(self, start: Start, most: int) -> int | None:
        """The fewest motions that a strategy from the start must have.

        None if it must have more than `most`, if a limit came first, or if there is none at all:
        then the layers are `settled`, and it does not depend on `most`.
        """
        for motions in range(1, most + 1):
            if self.first_motions(start, motions):
                return motions
            if self.stopped or (self.settled and motions >= len(self.layers)):
                return None
        return None

    def _extend(self) -> None:
        """One more layer, unless it would be the same as the last."""
        before, older = [{}, {}, *self.layers][-1:-3:-1]
        fresh = [region for v, region in before.items() if region is not older.get(v)]
        goals = self._goals(fresh if self.layers else [self.goal])
        layer: dict[float, Region] = {}
        targets = dict(self._targets)
        for direction in self.directions:
            if self.limits is not None:
                self.stopped = self.limits.exceeded(0)
                if self.stopped:
                    return
            target, more = self._target(goals, direction)
            targets[direction] = target
            if not more and direction in before:
                layer[direction] = before[direction]
                continue
            layer[direction] = self._backprojection(target, direction)
            self.made += 1
        self._targets = targets
        self.settled = bool(before) and all(layer[v] is before[v] for v in self.directions)
        if not self.settled:
            self.layers.append(layer)

    def _backprojection(self, target: Region, direction: float) -> Region:
        """What holds all starts from which a target is met; all there is if rounding spoils it."""
        space = self.setting.space
        reached = backproject(space, target, self.setting.command(direction).sources)
        lost = reached.region.is_empty and not target.is_empty
        return space.valid if lost or reached.target is not target else reached.region

    def _goals(self, fresh: list[Region]) -> list[Region]:
        """What has to be aimed at anew, now that these are goals too."""
        if self.sensing is Sensing.GIVEN or self.method is Method.STICKING:
            return fresh  # where a union sticks, its parts do
        tolerance = self.setting.space.tolerance
        known = _united([self._union, *fresh], tolerance)
        if self.layers and is_subset(known, self._union, tolerance):
            return []
        self._union = known
        return [known]

    def _target(self, goals: list[Region], direction: float) -> tuple[Region, bool]:
        """What may be recognised of all goals so far, and whether that is more than before."""
        before = self._targets.get(direction, Region.empty())
        if not goals:
            return before, False
        if self.method is not Method.STICKING and self.sensing is Sensing.PERFECT:
            return goals[0], True
        tolerance = self.setting.space.tolerance
        parts = [self._recognised(goal, direction) for goal in goals]
        target = _united([before, *parts], tolerance)
        return target, not is_subset(target, before, tolerance)

    def _recognised(self, goal: Region, direction: float) -> Region:
        if goal.is_empty or self.method is Method.STICKING:
            return sticking_features(goal, self.setting.command(direction))
        return aim(self.setting, goal, direction, self.method).region


def _united(regions: list[Region], tolerance: Tolerance) -> Region:
    """The union of many regions at once."""
    contact = regions[0].contact
    for region in regions[1:]:
        contact = contact_set.union(contact, region.contact, tolerance.length)
    filled = [region.area for region in regions if not region.area.is_empty]
    return Region(areas.union(*filled) if filled else Area.empty(), contact)
