"""Conditional strategies: layers to the fixpoint, over directions and scenes."""

from __future__ import annotations

import time

from benchmarks.timing import Row
from preimage.configuration.goals import goal_region
from preimage.configuration.region import Region
from preimage.configuration.start import Start, StartKind
from preimage.preimages.setting import Setting
from preimage.search.conditional import layers
from preimage.search.limits import Limits
from preimage.task.examples import named_task
from preimage.task.options import Method, uniform_directions

SCENES = (("hall-12", 16), ("hall-38", 8), ("hall-38", 16), ("hall-38", 64), ("comb-50", 8))

NOWHERE = Start(StartKind.FREE_POINT, (1e6, 1e6), -1, 0.0, (), Region.empty())
"""No region holds it, so that layers are added up to the fixpoint."""


def fixpoints() -> list[Row]:
    """At most eight layers of a goal, until one adds nothing; once, since that takes seconds."""
    rows: list[Row] = []
    for name, count in SCENES:
        task = named_task(name)
        setting = Setting.of(task)
        goal, edges = goal_region(task, setting.space), len(setting.space.contact.edges)
        begin = time.perf_counter()
        found = layers(
            setting, [goal], NOWHERE, uniform_directions(count), Method.COMBINED, 8,
            Limits(None, 10**6),
        )  # fmt: skip
        spent = time.perf_counter() - begin
        deep = max(known.rank for known in found.regions)
        words = f"{len(found.regions)} regions in {deep} layers, {found.computed} preimages"
        rows.append((f"{name}, {edges} edges, {count} directions", spent, words))
    return rows
