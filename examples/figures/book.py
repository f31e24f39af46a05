"""All figures, and the page that shows them."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterable
from pathlib import Path

from examples.figures import backprojections, hill, kernels, knowledge, plans, setting_out
from examples.figures.redrawn import Redrawn
from examples.small_picture import write_small

FIGURES: dict[int, Callable[[], Redrawn]] = {
    1: setting_out.figure_1,
    2: setting_out.figure_2,
    3: setting_out.figure_3,
    4: setting_out.figure_4,
    5: backprojections.figure_5,
    6: backprojections.figure_6,
    7: kernels.figure_7,
    8: kernels.figure_8,
    9: kernels.figure_9,
    10: kernels.figure_10,
    11: plans.figure_11,
    12: plans.figure_12,
    13: plans.figure_13,
    14: plans.figure_14,
    15: plans.figure_15,
    16: knowledge.figure_16,
    17: knowledge.figure_17,
    18: knowledge.figure_18,
    19: knowledge.figure_19,
    20: hill.figure_20,
}

GLUE = "\N{WORD JOINER}"

HEAD = """# The figures of the paper, redrawn

Made by `python examples/figures`, which takes numbers of figures and a folder. The paper is
Latombe, Lazanas and Shekhar, *Robot motion planning with uncertainty in control and sensing*
(Artificial Intelligence 52, 1991). Its text says what its figures show; their coordinates are not
in it. So the scenes are our own, with the properties that the text states, and most of them are
[named tasks](named-tasks.md), some of them in a smaller window. No result is drawn by hand: every
region, ray and way is what the planner computes, and `tests/figures` holds them against closed
forms.

The letters are the paper's. A dashed side of the window is open, and who leaves through it is lost.
What lies on contact is drawn beside the obstacle's edge, the goal innermost.
"""


def picture_of(figure: Redrawn, folder: Path) -> Path:
    """Write a figure into a folder; the file."""
    stem = folder / f"figure-{figure.number:02d}"
    return write_small(figure.views, stem, panel_width=figure.panel_width)


def section(figure: Redrawn, picture: str) -> str:
    """What the page says of a figure."""
    parts = [
        f"## Figure {figure.number}: {figure.caption}",
        f"![{figure.caption}]({picture})",
        _filled(figure.shows),
    ]
    if figure.differs:
        parts.append(_filled(f"*Against the paper.* {figure.differs}"))
    return "\n\n".join(parts) + "\n"


def _filled(text: str) -> str:
    """A paragraph in lines as long as elsewhere, none of which ends within a formula."""
    whole = re.sub(r"`[^`]*`", lambda formula: formula[0].replace(" ", GLUE), text)
    filled = textwrap.fill(whole, 100, break_long_words=False, break_on_hyphens=False)
    return filled.replace(GLUE, " ")


def page(figures: Iterable[tuple[Redrawn, str]]) -> str:
    """The page with all figures, each with where its picture is."""
    return "\n".join([HEAD, *(section(figure, picture) for figure, picture in figures)])
