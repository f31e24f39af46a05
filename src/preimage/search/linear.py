"""Linear strategies: the graph whose root is the goal and whose arcs are commanded directions."""

from __future__ import annotations

import hashlib
import heapq
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import count

from preimage.configuration.region import Region, is_subset
from preimage.configuration.start import Start, covered, distance_to
from preimage.preimages.methods import aim, reach
from preimage.preimages.preimage import Preimage, Target
from preimage.preimages.setting import Setting
from preimage.preimages.start_search import stateful_preimage
from preimage.preimages.starts import start_as_region
from preimage.search.limits import Limits, Progress, too_long
from preimage.task.options import Method, SearchOrder, Termination


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """A region of the graph: the goal, or a preimage of its parent's region."""

    id: int
    rank: int  # motions that remain
    region: Region
    parent: Node | None
    preimage: Preimage | None
    margin: float | None = None  # radians; any direction that near to the preimage's will do

    @property
    def chain(self) -> tuple[Node, ...]:
        """The node, and what its motions lead to, down to the goal."""
        return (self, *self.parent.chain) if self.parent else (self,)


@dataclass(slots=True, eq=False)
class Outcome:
    """What a search found.

    Parameters
    ----------
    nodes : all regions made, by id.
    solution : the node whose region holds the start, if one was found.
    stopped : which limit came first; None if the graph was exhausted or the start covered.
    computed, pruned : how many preimages were computed, and how many of them were left out since
        they lie in a region known at no greater depth.
    """

    nodes: list[Node]
    solution: Node | None = None
    stopped: str | None = None
    computed: int = 0
    pruned: int = 0
    _seen: dict[tuple[float, bytes], int] = field(default_factory=dict, repr=False)


def breadth_first(node: Node, _distance: float) -> tuple[float, ...]:
    """Fewest motions first: the first solution is a shortest one (paper 6)."""
    return (node.rank,)


def best_first(node: Node, distance: float) -> tuple[float, ...]:
    """Nearest to the start first, of those the fewest motions."""
    return (distance, node.rank)


ORDERS: dict[SearchOrder, Callable[[Node, float], tuple[float, ...]]] = {
    SearchOrder.BREADTH_FIRST: breadth_first,
    SearchOrder.BEST_FIRST: best_first,
}


def search(
    setting: Setting,
    goal: Region,
    start: Start,
    directions: tuple[float, ...],
    method: Method,
    order: SearchOrder,
    max_steps: int,
    limits: Limits,
    progress: Callable[[Progress], None] | None = None,
    termination: Termination = Termination.INSTANTANEOUS,
) -> Outcome:
    """Backchain from the goal until a preimage holds the start (paper 4, 6).

    Breadth-first, the first solution has the fewest motions that these directions and this method
    allow. A preimage inside a region that is known at no greater depth is left out: whatever it
    is a goal for, that region is too, since preimages grow with their goals. Targets that were
    aimed at before, along the same direction, are not backprojected again.

    Parameters
    ----------
    directions : radians; tried in this order.
    max_steps : the most motions that a strategy may have.
    termination : what conditions know. With state, a preimage depends on where its motion may
        begin: besides large ones, one for the start itself is looked for.
    """
    names = count()
    root = Node(next(names), 0, goal, None, None)
    outcome = Outcome([root])
    if covered(start, goal, setting.space):
        outcome.solution = root
        return outcome
    priority = ORDERS[order]
    nearest = distance_to(start, goal, setting.space)
    queue = [(priority(root, nearest), root.id, root)]
    cut = False
    while queue:
        _, _, node = heapq.heappop(queue)
        if node.rank >= max_steps:
            cut = True
            continue
        for direction in directions:
            outcome.stopped = limits.exceeded(len(outcome.nodes))
            if outcome.stopped:
                return outcome
            if termination is Termination.INSTANTANEOUS:
                more = _expand(setting, node, direction, method, outcome)
            else:
                more = _with_state(setting, node, direction, method, termination, start, outcome)
            for made in more:
                child = Node(next(names), node.rank + 1, made.region, node, made)
                outcome.nodes.append(child)
                if covered(start, child.region, setting.space):
                    outcome.solution = child
                    return outcome
                distance = distance_to(start, child.region, setting.space)
                nearest = min(nearest, distance)
                heapq.heappush(queue, (priority(child, distance), child.id, child))
            if progress is not None:
                best = "" if math.isinf(nearest) else f"{nearest:.4g} from the start"
                progress(Progress(len(outcome.nodes), node.rank + 1, best, limits.seconds))
    if cut:
        outcome.stopped = too_long(max_steps)
    return outcome


def _expand(
    setting: Setting, node: Node, direction: float, method: Method, outcome: Outcome
) -> Iterator[Preimage]:
    """The preimage of a node's region along a direction, if it is new."""
    target = aim(setting, node.region, direction, method)
    if target.region.is_empty:
        return
    key = direction, digest_of(target)
    if outcome._seen.get(key, math.inf) <= node.rank + 1:
        outcome.pruned += 1
        return
    outcome._seen[key] = node.rank + 1
    outcome.computed += 1
    made = reach(setting, node.region, direction, method, target)
    if _is_known(setting, made, node.rank + 1, outcome):
        outcome.pruned += 1
        return
    yield made


def _with_state(
    setting: Setting,
    node: Node,
    direction: float,
    method: Method,
    termination: Termination,
    start: Start,
    outcome: Outcome,
) -> Iterator[Preimage]:
    """A large preimage of a node's region by conditions with state, and one for the start."""
    goals = [node.region]
    made = stateful_preimage(setting, goals, direction, method, termination)
    outcome.computed += 1
    if made is None or not covered(start, made.region, setting.space):
        begin = start_as_region(start, setting.space)
        other = stateful_preimage(setting, goals, direction, method, termination, begin)
        outcome.computed += 1
        if other is not None and covered(start, other.region, setting.space):
            made = other
    if made is None or _is_known(setting, made, node.rank + 1, outcome):
        outcome.pruned += 1
        return
    yield made


def _is_known(setting: Setting, made: Preimage, rank: int, outcome: Outcome) -> bool:
    """Whether a preimage is nothing, or lies in a region known at no greater depth."""
    return made.region.is_empty or any(
        known.rank <= rank and is_subset(made.region, known.region, setting.space.tolerance)
        for known in outcome.nodes
    )


def digest_of(target: Target) -> bytes:
    """What tells targets apart: the region, and by what it is recognised."""
    digest = hashlib.blake2b(digest_size=16)
    for region in (target.sticking, target.kernel):
        contact = region.contact
        for array in (contact.edge, contact.low, contact.high, contact.vertices):
            digest.update(array.tobytes())
            digest.update(b"|")
        for ring in region.area.rings:
            digest.update(ring.tobytes())
            digest.update(b"/")
    return digest.digest()
