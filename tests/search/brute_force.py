"""Linear strategies by trying every sequence of directions: no pruning, nothing remembered."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from preimage.configuration.region import Region
from preimage.configuration.start import Start, covered
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.task.options import Method


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """What a sequence of directions, the last motion's last, leads to the goal from."""

    directions: tuple[float, ...]
    region: Region


def chains(
    setting: Setting,
    goal: Region,
    directions: tuple[float, ...],
    method: Method,
    max_steps: int,
) -> Iterator[Chain]:
    """All sequences with a preimage, shorter ones first."""
    layer = [Chain((), goal)]
    for _ in range(max_steps):
        longer = []
        for chain in layer:
            for direction in directions:
                region = preimage(setting, chain.region, direction, method).region
                if not region.is_empty:
                    longer.append(Chain((direction, *chain.directions), region))
        yield from longer
        layer = longer


def shortest(
    setting: Setting,
    goal: Region,
    start: Start,
    directions: tuple[float, ...],
    method: Method,
    max_steps: int,
) -> int | None:
    """The length of a shortest strategy; None if there is none that short."""
    if covered(start, goal, setting.space):
        return 0
    for chain in chains(setting, goal, directions, method, max_steps):
        if covered(start, chain.region, setting.space):
            return len(chain.directions)
    return None
