"""What stays the same while one task is planned, and what depends on the command alone."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

from preimage.configuration.obstacles import configuration_space
from preimage.configuration.space import ConfigurationSpace
from preimage.reachability.sources import Sources, sources
from preimage.recognition.readings import Readings, readings
from preimage.task.task import SlidingLaw, Task
from preimage.task.uncertainty import Uncertainty


@dataclass(frozen=True, eq=False)
class Setting:
    """Configuration space and the bounds on all errors.

    Parameters
    ----------
    friction : phi, radians.
    sliding : the law by which a slide's speed bounds a sticking condition's period.
    arc_tolerance : how far arcs of kernels may be off, on the safe side, relative to the position
        error.
    """

    space: ConfigurationSpace
    uncertainty: Uncertainty
    friction: float
    sliding: SlidingLaw
    arc_tolerance: float
    _commands: dict[float, Command] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, task: Task, space: ConfigurationSpace | None = None) -> Setting:
        """The setting of a task."""
        return cls(
            space=configuration_space(task) if space is None else space,
            uncertainty=task.uncertainty,
            friction=task.friction,
            sliding=task.sliding,
            arc_tolerance=task.options.arc_tolerance,
        )

    @cached_property
    def blurred(self) -> Uncertainty:
        """The bounds, with a position error that is larger by the tolerance."""
        position = self.uncertainty.position + self.space.tolerance.length
        return replace(self.uncertainty, position=position)

    def command(self, direction: float) -> Command:
        """The command along `direction`, radians; always the same object for the same number."""
        found = self._commands.get(direction)
        if found is None:  # of threads that come at once, all get the first one's
            found = self._commands.setdefault(direction, Command(self, direction))
        return found


@dataclass(frozen=True, eq=False)
class Command:
    """One commanded direction: what features do to it, and what is read at them meanwhile."""

    setting: Setting
    direction: float

    @cached_property
    def sources(self) -> Sources:
        """What every feature may do to the motion."""
        space = self.setting.space
        return sources(
            space.contact,
            self.direction,
            self.setting.uncertainty.control,
            self.setting.friction,
            space.tolerance,
        )

    @cached_property
    def readings(self) -> Readings:
        """What the force sensor may read at every feature."""
        space = self.setting.space
        return readings(
            space.contact,
            self.direction,
            self.setting.uncertainty,
            self.setting.friction,
            space.tolerance,
        )
