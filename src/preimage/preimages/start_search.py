"""Preimages by conditions with state: start regions that are worth knowing.

A condition that knows the start recognises the more, the less of a start there is; and from what
it recognises, its preimage follows. So each start region R has a preimage, what of
`B(chi(R), v)` motions from R visit, and a large one is searched (theory 5, paper 7).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from preimage.configuration.region import Region, intersection, union
from preimage.preimages.methods import reach_any
from preimage.preimages.preimage import Preimage, Target
from preimage.preimages.setting import Setting
from preimage.preimages.starts import pulled_in, span
from preimage.preimages.state import SPREAD, stateful_target, united
from preimage.preimages.sticking import sticking_features
from preimage.reachability.backprojection import backproject
from preimage.recognition.kernel import kernel
from preimage.recognition.termination import Condition, ReadingCondition
from preimage.task.options import Method, Termination

SHARES = (0.0, 0.2, 0.5)
"""Of twice the position error, by so much the goals are made smaller for a first start region."""

HALVINGS = 3
"""So often the least share that is worth it is looked for between two of those, for one goal."""

ROUNDS = 2
"""So often a start region is replaced by one that follows from it."""

MORE = 1e-3
"""A preimage that is larger by less, of its size, is not worth another round."""


def stateful_preimage(
    setting: Setting,
    goals: Sequence[Region],
    direction: float,
    method: Method,
    termination: Termination,
    start: Region | None = None,
) -> Preimage | None:
    """A preimage of one or several goals, by a condition that knows where its motion began.

    With a start R: what of `B(chi(R), v)` the motions from R visit. If R lies in it, R is a
    preimage. Without one, of all R that were tried the largest such region; it holds the preimage
    of an instantaneous condition, but for a few tolerances along its border, and it is that one if
    no other is larger.

    Parameters
    ----------
    direction : radians.
    start : R, if it is known; a point must be made a region first, see `start_as_region`.

    Returns
    -------
    None where nothing of the goals is recognised, or all that is is far from R. The domain of its
    reading condition holds every motion from its region.
    """
    question = _Question(setting, tuple(goals), direction, method, termination)
    if start is not None:
        found = question.answer(start)
    else:
        found = question.instantaneous()
        if termination is not Termination.INSTANTANEOUS and method is not Method.STICKING:
            found = _largest(question, found)
    return None if found.region.is_empty else found


@dataclass(frozen=True, slots=True, eq=False)
class _Question:
    """What `stateful_preimage` is asked."""

    setting: Setting
    goals: tuple[Region, ...]
    direction: float
    method: Method
    termination: Termination

    def instantaneous(self) -> Preimage:
        """The preimage of the condition without state."""
        none = Region.empty()
        aimed = stateful_target(
            self.setting, self.goals, none, self.direction, self.method, Termination.INSTANTANEOUS
        )
        return self._reach(aimed.target)

    def answer(self, start: Region) -> Preimage:
        """The preimage that follows from a start region."""
        near = self.setting.space.tolerance
        aimed = stateful_target(
            self.setting, self.goals, start, self.direction, self.method, self.termination
        )
        found = self._reach(aimed.target)
        if aimed.target.kernel.is_empty or self.termination is Termination.INSTANTANEOUS:
            return found  # no reading is asked, or none that assumes anything
        conditions: tuple[Condition, ...] = tuple(
            ReadingCondition(aimed.domain) if isinstance(one, ReadingCondition) else one
            for one in found.termination
        )
        region = intersection(found.region, aimed.reached, near)
        return replace(found, region=region, termination=conditions)

    def inside(self, region: Region) -> Preimage:
        """The preimage that follows from what is well inside a region."""
        control, angle = self.setting.uncertainty.control, self.setting.space.tolerance.angle
        cone = (self.direction - control, self.direction + control)
        least = SPREAD * angle
        # with perfect control motions are taken to spread: keep them off the border meanwhile
        more = 2.0 * least * span(self.setting.space) if control < least else 0.0
        return self.answer(pulled_in(region, self.setting.space, cone, more))

    def around(self, share: float) -> Region:
        """`B(kernel, v)` with the position error made smaller: where to begin the search."""
        setting, near = self.setting, self.setting.space.tolerance
        command = setting.command(self.direction)
        target = united(self.goals, near)
        if share > 0.0:
            error = setting.uncertainty
            error = replace(error, position=share * error.position)
            parts = [
                kernel(setting.space, command.readings, goal, error,
                       arc_tolerance=setting.arc_tolerance)
                for goal in self.goals
            ]  # fmt: skip
            target = united(parts, near)
            if self.method is not Method.KERNEL:
                held = united([sticking_features(goal, command) for goal in self.goals], near)
                target = union(target, held, near)
        return backproject(setting.space, target, command.sources).region

    def size(self, region: Region) -> float:
        """The area, in bands as wide as the window, and the length of contact."""
        return region.area.measure / span(self.setting.space) + region.contact.total_length

    def _reach(self, target: Target) -> Preimage:
        return reach_any(self.setting, self.goals, self.direction, self.method, target)


def _largest(question: _Question, first: Preimage) -> Preimage:
    """The largest preimage that is found, from the instantaneous one upwards."""
    size = question.size
    best, least = first, size(first.region)
    bound = size(question.around(0.0))  # whatever is recognised is a part of the goals

    def better(found: Preimage) -> bool:
        nonlocal best, least
        if size(found.region) <= (1.0 + MORE) * least:
            return False
        best, least = found, size(found.region)
        return True

    if bound <= (1.0 + MORE) * least:
        return best
    better(question.inside(first.backprojection.region))
    position = question.setting.uncertainty.position
    shares = SHARES if 0.0 < position < math.inf else SHARES[:1]
    chosen: float | None = None
    for share in shares:
        if better(question.inside(question.around(share))):
            chosen = share
    if chosen is not None and chosen > 0.0:
        high, low = chosen, max(share for share in shares if share < chosen)
        for _ in range(HALVINGS // len(question.goals)):  # each goal has a kernel of its own
            middle = 0.5 * (low + high)
            if better(question.inside(question.around(middle))):
                high = middle
            else:
                low = middle
    if best is first:
        return first
    for _ in range(ROUNDS if len(question.goals) == 1 else 1):
        known = best
        grown = better(question.inside(known.backprojection.region))
        if not better(question.inside(known.region)) and not grown:
            break
    return best
