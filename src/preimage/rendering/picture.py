"""Pictures of anything that can be drawn: as a figure, as a file, as text."""

from __future__ import annotations

import io
import os
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any

from preimage.errors import InputError, UnsupportedError, shown
from preimage.whole_file import write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from preimage.analysis.budget import Budget
    from preimage.analysis.explanation import Explanation
    from preimage.analysis.map import ErrorMap
    from preimage.configuration.region import Region
    from preimage.configuration.space import ConfigurationSpace
    from preimage.execution.report import Report
    from preimage.execution.trace import Trace
    from preimage.preimages.preimage import Preimage
    from preimage.reachability.backprojection import Backprojection
    from preimage.rendering.options import PictureOptions
    from preimage.rendering.scene import Scene
    from preimage.rendering.views import Views
    from preimage.search.compass import Compass
    from preimage.strategy.strategy import Strategy
    from preimage.task.task import Task

    Stage = Preimage | Backprojection | Region
    Analysis = Budget | ErrorMap | Explanation
    Subject = (
        Task | ConfigurationSpace | Strategy | Stage | Trace | Report | Compass | Analysis | Views
    )


class Format(Enum):
    """What a picture is written as, by the ending of its file."""

    SVG = "svg"
    PNG = "png"
    PDF = "pdf"


_DRAWING = threading.RLock()
"""matplotlib's settings are global: one picture is drawn at a time."""


def format_of(path: str | os.PathLike[str]) -> Format:
    """The format of a picture, by its file's ending; needs no matplotlib.

    Raises
    ------
    InputError : if no picture has this ending.

    >>> format_of("plan.SVG")
    <Format.SVG: 'svg'>
    """
    ending = Path(path).suffix
    try:
        return Format(ending.lower().removeprefix("."))
    except ValueError:
        rule = f"must end in .svg, .png or .pdf, not in {shown(ending) if ending else 'nothing'}"
        raise InputError(str(path), rule) from None


def figure(
    subject: Subject,
    *,
    task: Task | None = None,
    space: ConfigurationSpace | None = None,
    direction: float | None = None,
    **options: Any,
) -> Figure:
    """A matplotlib figure of a task, a space, a strategy, a stage of planning, or of runs.

    A strategy becomes a row of panels, one a motion; what has no strategy, a panel of what was
    found; `views.Views` are panels that the caller has composed. It belongs to no window and leaves
    matplotlib's settings as they were.

    Parameters
    ----------
    task : the task of a stage: its goal, bounds and walls are drawn too.
    space : its configuration space, if it is known already.
    direction : the command that a region belongs to, as a kernel does; radians.
    options : fields of `PictureOptions`.

    Raises
    ------
    InputError : an option is out of its range, or a region comes without a task and a space.
    UnsupportedError : matplotlib is not installed.
    """
    with settings():
        return _figure(subject, task, space, direction, options)


def draw(
    subject: Subject,
    path: str | os.PathLike[str],
    *,
    task: Task | None = None,
    space: ConfigurationSpace | None = None,
    direction: float | None = None,
    **options: Any,
) -> None:
    """Write a picture to a file, as SVG, PNG or PDF by its ending; the whole file or nothing.

    The same subject gives the same bytes. Parameters as of `figure`.

    Raises
    ------
    InputError, UnsupportedError : as `figure`, and for an unknown ending.
    OSError : the file cannot be written.
    """
    kind = format_of(path)
    with settings():
        made = _figure(subject, task, space, direction, options)
        content = _rendered(made, kind, options.get("dpi"))
    write_whole(Path(path), content)


def svg(
    subject: Subject,
    *,
    task: Task | None = None,
    space: ConfigurationSpace | None = None,
    direction: float | None = None,
    **options: Any,
) -> str:
    """A picture as the text of an SVG, as notebooks show it. Parameters as of `figure`."""
    with settings():
        made = _figure(subject, task, space, direction, options)
        return _rendered(made, Format.SVG, None).decode("utf-8")


@contextmanager
def settings() -> Iterator[None]:
    """Our settings for matplotlib and nobody else's."""
    try:
        import matplotlib.style
    except ImportError as error:
        rule = "needs matplotlib, which is not installed: pip install 'preimage[draw]'"
        raise UnsupportedError("picture", rule) from error
    from preimage.rendering.style import PARAMETERS

    with _DRAWING, matplotlib.style.context(["default", PARAMETERS]), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")  # of names in rare scripts
        yield


def _figure(
    subject: Subject,
    task: Task | None,
    space: ConfigurationSpace | None,
    direction: float | None,
    options: dict[str, Any],
) -> Figure:
    from preimage.analysis.budget import Budget
    from preimage.analysis.explanation import Explanation
    from preimage.analysis.map import ErrorMap
    from preimage.configuration.region import Region
    from preimage.configuration.space import ConfigurationSpace
    from preimage.execution.report import Report
    from preimage.execution.trace import Trace
    from preimage.preimages.preimage import Preimage
    from preimage.reachability.backprojection import Backprojection
    from preimage.rendering import stages
    from preimage.rendering.compass import compass_figure
    from preimage.rendering.graph import graph_figure
    from preimage.rendering.options import PictureOptions
    from preimage.rendering.scene import Scene
    from preimage.rendering.strategy import strategy_figure
    from preimage.rendering.trace import report_figure, trace_figure
    from preimage.rendering.views import Views
    from preimage.search.compass import Compass
    from preimage.strategy.strategy import Strategy
    from preimage.task.task import Task

    chosen = PictureOptions(**options)

    def scene(known: ConfigurationSpace | None) -> Scene:
        if task is not None:
            return Scene.of(task, space or known)
        there = space or known
        if there is None:
            raise InputError("picture", "a region is drawn in the space of a task: give either")
        return Scene(there, None, None, None)

    match subject:
        case Strategy():
            return (graph_figure if chosen.graph else strategy_figure)(subject, chosen)
        case Trace():
            return trace_figure(subject, chosen)
        case Report():
            return report_figure(subject, chosen)
        case Compass():
            return compass_figure(subject, chosen)
        case Budget() | ErrorMap() | Explanation() | Views():
            return _own_panels(subject, chosen)
        case Task():
            return stages.task_figure(subject, space, chosen)
        case ConfigurationSpace():
            return stages.space_figure(scene(subject), chosen)
        case Preimage() | Backprojection() | Region():
            return _stage(subject, scene, direction, chosen)


def _own_panels(subject: Analysis | Views, chosen: PictureOptions) -> Figure:
    """Of what says itself what its panels show."""
    from preimage.analysis.budget import Budget
    from preimage.analysis.map import ErrorMap
    from preimage.rendering.budget import budget_figure
    from preimage.rendering.error_map import map_figure
    from preimage.rendering.explanation import explanation_figure
    from preimage.rendering.view_panels import views_figure
    from preimage.rendering.views import Views

    match subject:
        case Budget():
            return budget_figure(subject)
        case ErrorMap():
            return map_figure(subject)
        case Views():
            return views_figure(subject, chosen)
        case _:
            return explanation_figure(subject, chosen)


def _stage(
    subject: Stage,
    scene: Callable[[ConfigurationSpace | None], Scene],
    direction: float | None,
    chosen: PictureOptions,
) -> Figure:
    from preimage.preimages.preimage import Preimage
    from preimage.reachability.backprojection import Backprojection
    from preimage.rendering import stages

    if isinstance(subject, Preimage):
        return stages.preimage_figure(subject, scene(subject.backprojection.space), chosen)
    if isinstance(subject, Backprojection):
        return stages.backprojection_figure(subject, scene(subject.space), chosen)
    return stages.region_figure(subject, scene(None), direction, chosen)


def _rendered(made: Figure, kind: Format, dpi: int | None) -> bytes:
    """The bytes of a picture; there is no date in them."""
    from preimage.rendering.options import PictureOptions

    metadata: dict[Format, dict[str, Any]] = {
        Format.SVG: {"Date": None, "Creator": "preimage"},
        Format.PNG: {"Software": "preimage"},
        Format.PDF: {"CreationDate": None, "Creator": "preimage", "Producer": "matplotlib"},
    }
    title = {"Title": str(made.get_label())} if made.get_label() else {}
    stream = io.BytesIO()
    resolution = PictureOptions().dpi if dpi is None else dpi
    made.savefig(stream, format=kind.value, dpi=resolution, metadata=metadata[kind] | title)
    return stream.getvalue()
