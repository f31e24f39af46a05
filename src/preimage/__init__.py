"""Robot motion planning with uncertainty in control and sensing, by preimage backchaining."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from preimage import display

if TYPE_CHECKING:
    from preimage.analysis.budget import budget as budget
    from preimage.analysis.explanation import explain as explain
    from preimage.analysis.map import error_map as error_map
    from preimage.analysis.survey import Survey as Survey
    from preimage.configuration.obstacles import configuration_space as configuration_space
    from preimage.errors import PreimageError as PreimageError
    from preimage.exchange.export import export as export
    from preimage.exchange.importing import import_task as import_task
    from preimage.execution.executor import Executor as Executor
    from preimage.execution.runs import run as run
    from preimage.preimages.methods import preimage as preimage
    from preimage.preimages.setting import Setting as Setting
    from preimage.reachability.backprojection import backproject as backproject
    from preimage.recognition.kernel import kernel as kernel
    from preimage.rendering import animate as animate
    from preimage.rendering import draw as draw
    from preimage.search.margins import margins as margins
    from preimage.search.planner import plan as plan
    from preimage.strategy.describe import describe as describe
    from preimage.strategy.plan_file import read_plan as read_plan
    from preimage.strategy.plan_file import write_plan as write_plan
    from preimage.strategy.strategy import Status as Status
    from preimage.strategy.strategy import Strategy as Strategy
    from preimage.studio.widget import widget as widget
    from preimage.task.examples import named_task as named_task
    from preimage.task.examples import named_tasks as named_tasks
    from preimage.task.files import load_task as load_task
    from preimage.task.options import Method as Method
    from preimage.task.task import Task as Task
    from preimage.task.template import Template as Template
    from preimage.task.template import load_template as load_template
    from preimage.verification.verify import verify as verify

    __version__: str

# The public names and the module that each lives in: loaded when first asked for, so that
# `import preimage` costs nothing. Whoever reads types sees them above.
_HOMES: dict[str, str] = {
    "Executor": "preimage.execution.executor",
    "Method": "preimage.task.options",
    "PreimageError": "preimage.errors",
    "Setting": "preimage.preimages.setting",
    "Status": "preimage.strategy.strategy",
    "Strategy": "preimage.strategy.strategy",
    "Survey": "preimage.analysis.survey",
    "Task": "preimage.task.task",
    "Template": "preimage.task.template",
    "animate": "preimage.rendering",
    "backproject": "preimage.reachability.backprojection",
    "budget": "preimage.analysis.budget",
    "configuration_space": "preimage.configuration.obstacles",
    "describe": "preimage.strategy.describe",
    "draw": "preimage.rendering",
    "error_map": "preimage.analysis.map",
    "explain": "preimage.analysis.explanation",
    "export": "preimage.exchange.export",
    "import_task": "preimage.exchange.importing",
    "kernel": "preimage.recognition.kernel",
    "load_task": "preimage.task.files",
    "load_template": "preimage.task.template",
    "margins": "preimage.search.margins",
    "named_task": "preimage.task.examples",
    "named_tasks": "preimage.task.examples",
    "plan": "preimage.search.planner",
    "preimage": "preimage.preimages.methods",
    "read_plan": "preimage.strategy.plan_file",
    "run": "preimage.execution.runs",
    "verify": "preimage.verification.verify",
    "widget": "preimage.studio.widget",
    "write_plan": "preimage.strategy.plan_file",
}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> object:
    """Load a public name from its room."""
    value: object
    if name == "__version__":
        value = import_module("importlib.metadata").version("preimage")
    elif name in _HOMES:
        value = getattr(import_module(_HOMES[name]), name)
    else:
        raise AttributeError(f"module 'preimage' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """The public names."""
    return sorted({*globals(), *__all__})


def _picture(subject: object) -> str | None:
    """The picture of anything that has one, drawn by the room that draws."""
    svg: str = import_module("preimage.rendering").svg(subject)
    return svg


display.paint_with(_picture)
