"""Linear strategies by a search that bounds lead: as short as breadth-first's."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable
from dataclasses import dataclass, field

from preimage.configuration.region import Region, is_subset
from preimage.configuration.start import Start, covered, distance_to
from preimage.preimages.methods import aim, reach
from preimage.preimages.preimage import Preimage
from preimage.preimages.setting import Setting
from preimage.search.bounds import Bounds, Sensing
from preimage.search.limits import Limits, Progress, too_long
from preimage.search.linear import Node, Outcome, digest_of
from preimage.task.options import Method


def search(
    setting: Setting,
    goal: Region,
    start: Start,
    directions: tuple[float, ...],
    method: Method,
    max_steps: int,
    limits: Limits,
    progress: Callable[[Progress], None] | None = None,
    sensing: Sensing = Sensing.PERFECT,
) -> Outcome:
    """Backchain from the goal, no deeper than the bounds say one must (paper 4, 9).

    Iterative deepening. The layers of `Bounds` give the fewest motions that a strategy must have;
    for that many, and then for one more at a time, the graph is searched nearest region first. As
    a strategy's first motion only those are tried that the bounds let it begin with: the last
    layer, the largest, is made for these alone, and its regions are compared with others only if
    the search goes deeper. All shorter strategies have been ruled out by then, so a solution has
    the fewest motions that these directions and this method allow. Where even the bounds' last
    layer leaves out the start there is none, however many motions and whatever the sensors.

    Parameters
    ----------
    directions : radians.
    max_steps : the most motions that a strategy may have.
    sensing : what the bounds take to be recognised.

    Returns
    -------
    Outcome
        As from the other searches; backprojections for the bounds count as preimages computed.
    """
    root = Node(0, 0, goal, None, None)
    outcome = Outcome([root])
    if covered(start, goal, setting.space):
        outcome.solution = root
        return outcome
    bounds = Bounds(setting, goal, directions, method, sensing, limits)
    graph = _Graph(setting, start, directions, method, limits, progress, outcome)
    fewest = bounds.fewest(start, max_steps)
    enough = too_long(max_steps)
    if fewest is None:
        outcome.stopped = bounds.stopped or (None if bounds.settled else enough)
    else:
        for motions in range(fewest, max_steps + 1):
            first = bounds.first_motions(start, motions)
            outcome.stopped = bounds.stopped
            if outcome.stopped or graph.finish(motions, first) or graph.exhausted():
                break
        else:
            cut = graph.goes_on(max_steps)
            outcome.stopped = outcome.stopped or (enough if cut else None)
    outcome.computed += bounds.made
    return outcome


@dataclass(slots=True, eq=False)
class _Graph:
    """The regions made so far, and which motions to each of them have been tried."""

    setting: Setting
    start: Start
    directions: tuple[float, ...]
    method: Method
    limits: Limits
    progress: Callable[[Progress], None] | None
    outcome: Outcome
    _deep: list[tuple[Node, Preimage]] = field(default_factory=list)  # not yet compared
    _distance: dict[int, float] = field(default_factory=dict)  # from the start, by node
    _tried: dict[int, set[float]] = field(default_factory=dict)  # by node
    _seen: dict[tuple[float, bytes], int] = field(default_factory=dict)  # targets, by rank

    def finish(self, motions: int, first: tuple[float, ...]) -> bool:
        """Try what is left of strategies of so many motions.

        True if one was found or a limit came first.

        Parameters
        ----------
        first : the directions that these may begin with.
        """
        outcome = self.outcome
        queue = [self._entry(node) for node in outcome.nodes if node.rank < motions]
        heapq.heapify(queue)
        while queue:
            node = heapq.heappop(queue)[-1]
            tried = self._tried.setdefault(node.id, set())
            last = node.rank + 1 == motions
            for direction in first if last else self.directions:
                if direction in tried:
                    continue
                outcome.stopped = self.limits.exceeded(len(outcome.nodes) + len(self._deep))
                if outcome.stopped:
                    self.exhausted()  # what is there is kept
                    return True
                tried.add(direction)
                made = self._preimage(node, direction)
                if made is not None:
                    if covered(self.start, made.region, self.setting.space):
                        outcome.solution = self._child(node, made)
                        return True
                    if last:
                        self._deep.append((node, made))
                    elif self._is_new(made, node):
                        heapq.heappush(queue, self._entry(self._child(node, made)))
                self._report(motions)
        return False

    def exhausted(self) -> bool:
        """Whether all motions to all regions have been tried."""
        for node, made in self._deep:
            if self._is_new(made, node):
                self._child(node, made)
        self._deep.clear()
        whole = len(self.directions)
        return all(len(self._tried.get(node.id, ())) == whole for node in self.outcome.nodes)

    def goes_on(self, motions: int) -> bool:
        """Whether some region takes so many motions, the bounds aside."""
        if any(node.rank == motions for node in self.outcome.nodes):
            return True
        return not self.finish(motions, self.directions) and not self.exhausted()

    def _entry(self, node: Node) -> tuple[float, int, int, Node]:
        """Nearest to the start first, of those the deepest."""
        if node.id not in self._distance:
            self._distance[node.id] = distance_to(self.start, node.region, self.setting.space)
        return self._distance[node.id], -node.rank, node.id, node

    def _child(self, node: Node, made: Preimage) -> Node:
        child = Node(len(self.outcome.nodes), node.rank + 1, made.region, node, made)
        self.outcome.nodes.append(child)
        return child

    def _preimage(self, node: Node, direction: float) -> Preimage | None:
        """The preimage of a node's region, unless its target was aimed at before."""
        target = aim(self.setting, node.region, direction, self.method)
        if target.region.is_empty:
            return None
        key = direction, digest_of(target)
        if self._seen.get(key, math.inf) <= node.rank + 1:
            self.outcome.pruned += 1
            return None
        self._seen[key] = node.rank + 1
        self.outcome.computed += 1
        made = reach(self.setting, node.region, direction, self.method, target)
        return None if made.region.is_empty else made

    def _is_new(self, made: Preimage, node: Node) -> bool:
        """Whether a preimage of a node's region lies in none known at no greater depth."""
        tolerance = self.setting.space.tolerance
        if any(
            known.rank <= node.rank + 1 and is_subset(made.region, known.region, tolerance)
            for known in self.outcome.nodes
        ):
            self.outcome.pruned += 1
            return False
        return True

    def _report(self, motions: int) -> None:
        if self.progress is None:
            return
        nearest = min(self._distance.values())
        best = "" if math.isinf(nearest) else f"{nearest:.4g} from the start"
        regions = len(self.outcome.nodes)
        self.progress(Progress(regions, motions, best, self.limits.seconds))
