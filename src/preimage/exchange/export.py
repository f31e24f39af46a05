"""Plans as other programs' files, and as words."""

from __future__ import annotations

import os
from collections.abc import Callable
from enum import Enum
from pathlib import Path

from preimage.errors import InputError, shown
from preimage.exchange.behaviour_tree import behaviour_tree
from preimage.exchange.python_module import module_text
from preimage.execution.runs import trace_of
from preimage.strategy.decisions import decision_list
from preimage.strategy.strategy import Status, Strategy
from preimage.whole_file import write_whole


class ExportFormat(Enum):
    """What a plan is exported as, by the ending of its file."""

    BEHAVIOUR_TREE = "xml"
    WORDS = "txt"
    PYTHON = "py"
    SVG = "svg"
    PNG = "png"
    PDF = "pdf"
    GIF = "gif"
    PAGE = "html"

    @classmethod
    def of(cls, path: str | os.PathLike[str]) -> ExportFormat:
        """The format of a file, by its ending.

        Raises
        ------
        InputError : it is unknown.
        """
        ending = Path(path).suffix.lower().removeprefix(".")
        for one in cls:
            if one.value == ending:
                return one
        known = ", ".join(f".{one.value}" for one in cls)
        raise InputError(str(path), f"must end in one of {known}, not in {shown(ending)}")


TEXTS: dict[ExportFormat, Callable[[Strategy], str]] = {
    ExportFormat.BEHAVIOUR_TREE: behaviour_tree,
    ExportFormat.WORDS: lambda strategy: f"{strategy.task.name}\n\n{decision_list(strategy)}\n",
    ExportFormat.PYTHON: module_text,
}
"""The formats that are texts."""

PICTURES = (ExportFormat.SVG, ExportFormat.PNG, ExportFormat.PDF)

FILMED = ("hunting", "towards")
"""Under whom the run is made that a film shows."""


def export(
    strategy: Strategy, path: str | os.PathLike[str], kind: ExportFormat | None = None
) -> None:
    """Write a plan as another program's file, a picture or a film: the whole file or nothing.

    Parameters
    ----------
    kind : by the path's ending if it is not given; pictures and films need that ending.

    Raises
    ------
    InputError : an unknown ending, or a plan that is not solved.
    UnsupportedError : matplotlib is not installed, which pictures and films need.
    OSError : the file cannot be written.

    >>> import preimage, tempfile
    >>> strategy = preimage.plan(preimage.named_task("peg-in-hole"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     export(strategy, f"{folder}/plan.txt")
    ...     print(Path(folder, "plan.txt").read_text("utf-8").splitlines()[2])
    begin with 2
    """
    kind = ExportFormat.of(path) if kind is None else kind
    if strategy.status is not Status.SOLVED:
        rule = f"the plan is {strategy.status.value}: only a solved one can be exported"
        raise InputError("status", rule)
    if kind in TEXTS:
        write_whole(path, TEXTS[kind](strategy))
    elif kind in PICTURES:
        from preimage.rendering import draw

        draw(strategy, path)
    else:
        from preimage.rendering import animate

        animate(trace_of(strategy, FILMED), path)
