"""What the user says: the task and its file."""

from preimage.task.documents import Format
from preimage.task.examples import named_task, named_tasks, task_families
from preimage.task.files import dump_task, format_task, load_task, save_task
from preimage.task.goal import Goal
from preimage.task.initial import (
    Everywhere,
    Initial,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
)
from preimage.task.options import (
    Continuous,
    Method,
    PlannerOptions,
    Preference,
    SearchOrder,
    StrategyKind,
    Termination,
    uniform_directions,
)
from preimage.task.parse import parse_task
from preimage.task.robot import Robot
from preimage.task.schema import task_schema
from preimage.task.task import SlidingLaw, Task
from preimage.task.template import Template, load_template, named_template, parse_template
from preimage.task.uncertainty import Uncertainty
from preimage.task.workspace import (
    ChainObstacle,
    PolygonObstacle,
    Side,
    SolidSide,
    Window,
    Workspace,
)

__all__ = [
    "ChainObstacle",
    "Continuous",
    "Everywhere",
    "Format",
    "Goal",
    "Initial",
    "InitialDisc",
    "InitialEdges",
    "InitialPoint",
    "InitialPolygon",
    "Method",
    "PlannerOptions",
    "PolygonObstacle",
    "Preference",
    "Robot",
    "SearchOrder",
    "Side",
    "SlidingLaw",
    "SolidSide",
    "StrategyKind",
    "Task",
    "Template",
    "Termination",
    "Uncertainty",
    "Window",
    "Workspace",
    "dump_task",
    "format_task",
    "load_task",
    "load_template",
    "named_task",
    "named_tasks",
    "named_template",
    "parse_task",
    "parse_template",
    "save_task",
    "task_families",
    "task_schema",
    "uniform_directions",
]
