"""Of the plans with the fewest motions, the one with the largest smallest margin (theory 7)."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from preimage.configuration.depth import depth_of_start
from preimage.configuration.region import Region, is_subset
from preimage.configuration.start import Start, covered
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.search.limits import Limits, Progress
from preimage.search.linear import Node
from preimage.search.margins import FIRST, HALVINGS, RELATIVE, Again, has_slack, margins, slack
from preimage.strategy.margins import Margins
from preimage.strategy.strategy import Strategy
from preimage.task.options import Continuous
from preimage.task.task import Task

LEAST = FIRST * 0.5**HALVINGS
"""Margins below so many units are found to be 0."""


@dataclass(frozen=True, slots=True, eq=False)
class Preferred:
    """The chain that was chosen.

    Parameters
    ----------
    solution : its first region; ids are the ranks, unless it is the one that was known.
    compared : how many plans were looked at.
    stopped : which limit came before all of them were; None if none did.
    """

    solution: Node
    margins: Margins
    compared: int
    made: int
    stopped: str | None

    @property
    def words(self) -> str:
        """What was compared; nothing if there was no choice."""
        return compared_words(self.compared, self.stopped)


def compared_words(compared: int, stopped: str | None = None) -> str:
    """How many plans were compared; nothing if there was no choice.

    >>> compared_words(3)
    '3 were compared by their smallest margin'
    """
    if compared < 2 and not stopped:
        return ""
    verb = "was compared by its" if compared == 1 else "were compared by their"
    end = f"; {stopped}" if stopped else ""
    return f"{compared} {verb} smallest margin{end}"


def roomiest(
    setting: Setting,
    start: Start,
    task: Task,
    solution: Node,
    limits: Limits,
    progress: Callable[[Progress], None] | None = None,
) -> Preferred:
    """Of the linear plans as short as a shortest one, that with the largest smallest margin.

    All sequences of the task's directions are looked at: a region that lies in another one, which
    the search leaves out, may have the larger margins. What is left out is what lies in a region
    from which no sequence that short leads on to the start: none does from it either, since
    preimages grow with their goals. Margins are compared to 5 %; of equal ones the known plan is
    kept, or else the first one that is found.

    Parameters
    ----------
    solution : the first region of a shortest plan, of at least one motion.
    limits : on time, and on the regions made here; once one is reached the best so far is returned.
    """
    search = _Sequences(setting, start, task, solution.rank, limits, progress)
    root = solution.chain[-1]
    best = search.margins_of(solution)
    level, chosen = best.smallest(task), solution
    for node in search.chains(Node(0, 0, root.region, None, None)):
        plan, depth = search.plan(node), depth_of_start(start, node.region, setting.space)
        if not has_slack(plan, depth, task, max(level * (1.0 + RELATIVE), LEAST)):
            continue
        found = slack(plan, depth, task)
        if found.smallest(task) > level:
            level, best, chosen = found.smallest(task), found, node
        if math.isinf(level):
            break
    return Preferred(chosen, best, max(search.found, 1), search.made, search.stopped)


def roomiest_policy(plans: Sequence[Strategy], limits: Limits) -> Strategy:
    """Of equally short strategies that with the largest smallest margin, the first of equal ones.

    Parameters
    ----------
    plans : solved, at least one.
    """
    measured = [margins(plan, limits) for plan in plans]
    return max(measured, key=lambda plan: plan.margins.smallest(plan.task) if plan.margins else 0.0)


@dataclass(slots=True, eq=False)
class _Sequences:
    """All chains of preimages of one length that lead from the start.

    Parameters
    ----------
    made, found : how many preimages were made, and how many chains lead from the start.
    barren : by the motions that are left, regions before which no chain begins in the start.
    """

    setting: Setting
    start: Start
    task: Task
    length: int
    limits: Limits
    progress: Callable[[Progress], None] | None = None
    made: int = 0
    found: int = 0
    stopped: str | None = None
    barren: dict[int, list[Region]] = field(default_factory=lambda: defaultdict(list))

    def chains(self, node: Node) -> Iterator[Node]:
        """The first regions of all chains that end with this one, in the search's order."""
        space, left = self.setting.space, self.length - node.rank
        if left == 0:
            if covered(self.start, node.region, space):
                self.found += 1
                yield node
            return
        if any(is_subset(node.region, known, space.tolerance) for known in self.barren[left]):
            return
        directions = self.task.options.directions
        assert not isinstance(directions, Continuous)
        leads = False
        for direction in directions:
            stopped = self.limits.exceeded(self.made)
            if stopped:
                self.stopped = stopped
                return
            self.made, rank = self.made + 1, node.rank + 1
            found = preimage(self.setting, node.region, direction, self.task.options.method)
            if self.progress is not None:
                best = f"{self.found} plans compared"
                self.progress(Progress(self.made, rank, best, self.limits.seconds))
            if found.region.is_empty:
                continue
            for first in self.chains(Node(rank, rank, found.region, node, found)):
                leads = True
                yield first
            if self.stopped:
                return
        if not leads:
            self.barren[left].append(node.region)

    def plan(self, node: Node) -> Again:
        """A chain, to be made anew with larger errors."""
        chain = node.chain
        return Again(
            setting=self.setting,
            goal=chain[-1].region,
            start=self.start,
            options=self.task.options,
            directions=tuple(one.preimage.direction for one in chain if one.preimage is not None),
            chained=True,
            most=node.rank,
            limits=self.limits,
        )

    def margins_of(self, node: Node) -> Margins:
        """The margins of a chain."""
        depth = depth_of_start(self.start, node.region, self.setting.space)
        return slack(self.plan(node), depth, self.task)
