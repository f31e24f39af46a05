"""What stands in the way where there is no strategy: places with numbers, and words to them."""

from __future__ import annotations

import numpy as np
from matplotlib.lines import Line2D

from preimage.configuration.region import Region
from preimage.rendering.names import draw_name
from preimage.rendering.panel import Panel
from preimage.rendering.style import MARKS, PAPER, Layer
from preimage.strategy.reason import Reason, shown_reasons, told
from preimage.strategy.strategy import Strategy

SIZE = 6.0
"""Points: of a mark."""


def reason_words(strategy: Strategy) -> str:
    """What stands in the way, each with the number of its place in the picture."""
    count = len(told(strategy.why))
    lines = shown_reasons(strategy.why)
    numbered = [f"({index + 1}) {line}" for index, line in enumerate(lines[:count])]
    return "; ".join([*numbered, *lines[count:]])


def draw_reasons(panel: Panel, reasons: tuple[Reason, ...]) -> None:
    """Mark the places of the reasons that are told, with their numbers."""
    shape, color = MARKS[Layer.REASON]
    numbers: dict[tuple[float, float], list[str]] = {}
    for index, reason in enumerate(told(reasons)):
        if reason.place is not None:
            numbers.setdefault(reason.place, []).append(str(index + 1))
    for (x, y), names in numbers.items():
        mark = Line2D(
            [x], [y], color=color, marker=shape, markersize=SIZE, markeredgecolor=PAPER,
            markeredgewidth=0.6, linestyle="none", zorder=9.5, clip_on=False,
        )  # fmt: skip
        panel.add(mark, Layer.REASON, "-".join(names))
        room = (SIZE + 2.0) * panel.unit
        panel.lattice.take(x, y, room, room)
    for point, names in numbers.items():
        draw_name(panel, ", ".join(names), Layer.REASON, Region.empty(), np.array(point))
