"""What commands are known to attain, layer by layer: kept, and added to (theory 7)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from preimage.configuration import contact_set
from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, union
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.geometry.overlay import united
from preimage.preimages.preimage import Target
from preimage.preimages.setting import Command, Setting
from preimage.preimages.shared import may_be_told, resting, told_at_rest, union_of
from preimage.preimages.sticking import sticking_features
from preimage.recognition.confusion import Doubts
from preimage.recognition.kernel import Core, core_of
from preimage.recognition.outside import contact_segments
from preimage.recognition.readings import Readings
from preimage.task.options import Method

FEW_RAYS = 64
"""With no more sides of control cones, what replaces arcs touches them along all of these."""


@dataclass(frozen=True, slots=True, eq=False)
class Goal:
    """A region to aim at, and what all its kernels have in common; None if it has none."""

    region: Region
    core: Core | None


@dataclass(slots=True, eq=False)
class Field:
    """All that is aimed at, for every command.

    Parameters
    ----------
    goals : in the order in which they came to be known.
    area : the areas of all cores, united.
    held : contact that is in some goal.
    """

    setting: Setting
    method: Method
    directions: tuple[float, ...]
    goals: list[Goal] = field(default_factory=list)
    area: Area = field(default_factory=Area.empty)
    held: ContactSet = field(default_factory=ContactSet.empty)

    def add(self, regions: Iterable[Region]) -> None:
        """Aim at more regions."""
        fresh = [Goal(region, self._core(region)) for region in regions]
        self.goals += fresh
        space = self.setting.space
        parts = [goal.core.area for goal in fresh if goal.core and not goal.core.area.is_empty]
        if parts:
            self.area = united([self.area, *parts], space.tolerance.grid)
        near = space.tolerance.length
        self.held = union_of([self.held, *(goal.region.contact for goal in fresh)], near)

    def _core(self, region: Region) -> Core | None:
        if self.method is Method.STICKING:
            return None
        setting, control = self.setting, self.setting.uncertainty.control
        rays = [turn + side for turn in self.directions for side in (-control, control)]
        return core_of(
            setting.space, region, setting.uncertainty, rays if len(rays) <= FEW_RAYS else (),
            arc_tolerance=setting.arc_tolerance,
        )  # fmt: skip

    def told_area(self, readings: Readings) -> Area:
        """The areas of all kernels for one command, united.

        Where contact that reads 0 lies beside free space of a goal, but outside it, each core
        loses what is near to that: contact in no goal at all takes it from all of them at once.
        """
        setting, near = self.setting, self.setting.space.tolerance.length
        cores = [goal.core for goal in self.goals if goal.core is not None]
        if np.isinf(setting.uncertainty.position):
            return self._united([core.kernel(readings).area for core in cores])
        if self.area.is_empty:
            return self.area
        hidden = [core.hidden(readings) for core in cores]
        if not any(map(len, hidden)):
            return self.area
        contact = setting.space.contact
        nowhere = contact_segments(contact, contact_set.complement(self.held, contact, near))
        base = cores[0].without(self.area, nowhere.part(readings.zero[nowhere.feature]))
        elsewhere = np.concatenate((self.held.edge, len(contact) + self.held.vertices))
        doubtful = [part.part(np.isin(part.feature, elsewhere)) for part in hidden]
        if not any(map(len, doubtful)):
            return base
        # near to what one goal holds and another does not, core by core
        around = cores[0].around_all(doubtful)
        rest, found = areas.intersection(base, around), [areas.difference(base, around)]
        order = sorted(range(len(cores)), key=lambda place: len(doubtful[place]))
        for place in order:
            own = areas.intersection(cores[place].area, rest)
            if len(hidden[place]) and not own.is_empty:
                own = cores[place].without(own, hidden[place])
            if own.is_empty:
                continue
            found.append(own)
            rest = areas.difference(rest, own)
            if rest.is_empty:
                break
        return self._united(found)

    def _united(self, parts: Sequence[Area]) -> Area:
        parts = [part for part in parts if not part.is_empty]
        return united(parts, self.setting.space.tolerance.grid) if parts else Area.empty()


@dataclass(slots=True, eq=False)
class Aim:
    """What one command is known to attain so far.

    Parameters
    ----------
    seen : of how many of the field's goals that is.
    told : contact in their kernels.
    kept : what sticks for sure and tells some goal at rest; see `preimages.shared`.
    lost : the places of the newest goals of which something that sticks had to go.
    doubts : at vertices; see `recognition.confusion`.
    target : all of it.
    reached : the last preimage of it.
    """

    command: Command
    seen: int = 0
    told: ContactSet = field(default_factory=ContactSet.empty)
    kept: ContactSet = field(default_factory=ContactSet.empty)
    lost: tuple[int, ...] = ()
    doubts: Doubts | None = None
    reached: Region = field(default_factory=Region.empty)
    target: Target = field(default_factory=lambda: Target.of_kernel(Region.empty()))

    def further(self, aimed: Field) -> None:
        """See the goals that are new in the field."""
        near = aimed.setting.space.tolerance.length
        fresh = range(self.seen, len(aimed.goals))
        self.seen = len(aimed.goals)
        self.told = union_of([self.told, *(self._told(aimed.goals[one]) for one in fresh)], near)
        if aimed.method is not Method.KERNEL:
            regions = [goal.region for goal in aimed.goals]
            every = self._surely(aimed.held)
            if not contact_set.is_subset(every, self.kept, near):
                self.kept = resting(aimed.setting, regions, every, self.command, self.kept)
            parts = ((one, self._surely(regions[one].contact)) for one in fresh)
            lost = (one for one, part in parts if not contact_set.is_subset(part, self.kept, near))
            self.lost = tuple(lost)
        self._settle(aimed, fresh)
        self.target = self._aimed_at(aimed)

    def alone(self, aimed: Field, place: int) -> Target:
        """The target of one goal alone: nothing needs to go."""
        goal, tolerance = aimed.goals[place], aimed.setting.space.tolerance
        sticking = sticking_features(goal.region, self.command)
        core = goal.core.kernel(self.command.readings) if goal.core else Region.empty()
        return Target(union(sticking, core, tolerance), sticking, core)

    def _aimed_at(self, aimed: Field) -> Target:
        near, told = aimed.setting.space.tolerance.length, self.told
        if aimed.method is not Method.KERNEL:
            told = told_at_rest(told, self.kept, self.command)
        if self.doubts is not None:
            vertices = np.union1d(told.vertices, self.doubts.settled).astype(np.int32)
            told = ContactSet(told.edge, told.low, told.high, vertices)
        area = aimed.told_area(self.command.readings)
        both = contact_set.union(told, self.kept, near)
        return Target(Region(area, both), Region(Area.empty(), self.kept), Region(area, told))

    def _told(self, goal: Goal) -> ContactSet:
        """The contact in a goal's kernel."""
        if goal.core is None:
            return ContactSet.empty()
        if goal.core.around is None:
            return goal.core.kernel(self.command.readings).contact
        return goal.core.contact(self.command.readings)

    def _surely(self, part: ContactSet) -> ContactSet:
        return sticking_features(Region(Area.empty(), part), self.command).contact

    def _settle(self, aimed: Field, fresh: range) -> None:
        """Which vertices are told by one goal or another."""
        if aimed.method is Method.STICKING:
            return
        space, readings = aimed.setting.space, self.command.readings
        if self.doubts is None:
            matters = np.flatnonzero(may_be_told(self.command, aimed.method))
            self.doubts = Doubts.at(readings, matters.astype(np.int32))
        for place in fresh:
            core = aimed.goals[place].core
            assert core is not None
            near = core.around.meetings if core.around is not None else None
            self.doubts.narrow(space, readings, core.target, near)
