"""A task or a plan alive in a notebook: the studio's drawing, with a run played."""

from __future__ import annotations

from typing import Any

from preimage.errors import UnsupportedError
from preimage.execution.runs import RunOptions, trace_of
from preimage.strategy.strategy import Status, Strategy
from preimage.studio.bundle import bundled, styles
from preimage.studio.plain import trace_of as plain_trace
from preimage.studio.planned import plan_view
from preimage.studio.scenes import space as space_of
from preimage.task.files import dump_task
from preimage.task.task import Task

HIGH = """
.preimage .drawing { width: 100%; height: 420px; display: block; }
.preimage .transport { display: flex; gap: 6px; align-items: center; }
.preimage p { margin: 4px 0; }
"""


def widget(
    subject: Task | Strategy,
    *,
    control: str = "hunting",
    sensing: str = "towards",
    number: int = 0,
    seed: int = 0,
) -> Any:
    """A widget that shows a task, or a plan with one of its runs, animated (anywidget).

    Parameters
    ----------
    control, sensing : the adversaries of the run, by name (`execution.control`, `sensing`).
    number, seed : which run it is.

    Raises
    ------
    InputError : the scene has more edges than are drawn alive.
    UnsupportedError : anywidget is not installed.
    ValueError : an adversary is not known.
    """
    try:
        import anywidget
        import traitlets
    except ImportError:
        rule = "needs anywidget, which is not installed: pip install 'preimage[notebook]'"
        raise UnsupportedError("widget", rule) from None

    class Drawing(anywidget.AnyWidget):
        """The studio's drawing."""

        _esm = bundled("widget")
        _css = styles() + HIGH
        space = traitlets.Dict().tag(sync=True)
        plan = traitlets.Dict(None, allow_none=True).tag(sync=True)
        run = traitlets.Dict(None, allow_none=True).tag(sync=True)
        words = traitlets.Unicode().tag(sync=True)

    return Drawing(**state(subject, (control, sensing), number, seed))


def state(
    subject: Task | Strategy, pair: tuple[str, str], number: int = 0, seed: int = 0
) -> dict[str, Any]:
    """What the widget shows, as plain data."""
    task = subject if isinstance(subject, Task) else subject.task
    space = space_of({"task": dump_task(task)}, lambda _words: None)
    if isinstance(subject, Task):
        return {"space": space, "plan": None, "run": None, "words": task.name}
    view = plan_view(subject)
    run = None
    if subject.status is Status.SOLVED:
        run = plain_trace(trace_of(subject, pair, number, options=RunOptions(seed=seed)))
    return {"space": space, "plan": view, "run": run, "words": view["words"][0]}
