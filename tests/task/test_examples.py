import pytest

from preimage.errors import TaskError
from preimage.task import (
    ChainObstacle,
    Task,
    Termination,
    named_task,
    named_tasks,
    parse_task,
    task_families,
)
from preimage.task.examples import named_task_text
from preimage.task.workspace import SolidSide


@pytest.mark.parametrize("name", named_tasks())
def test_named_tasks_bear_their_names(name: str) -> None:
    task = named_task(name)
    assert isinstance(task, Task)
    assert task.name == name
    assert named_tasks()[name].endswith(".")
    assert named_task_text(name).startswith(f"# {named_tasks()[name]}\n")
    assert task.options.termination in Termination


@pytest.mark.parametrize("family", task_families())
@pytest.mark.parametrize("size", [1, 2, 3, 10, 50])
def test_families_have_all_sizes(family: str, size: int) -> None:
    task = named_task(f"{family}-{size}")
    assert task == named_task(f"{family}-{size}")
    assert task.name == f"{family}-{size}"
    assert task_families()[family].endswith(".")


def test_sizes_count() -> None:
    saw, comb = (named_task(name).workspace.obstacles[0] for name in ("saw-tooth-5", "comb-5"))
    assert isinstance(saw, ChainObstacle)
    assert isinstance(comb, ChainObstacle)
    assert sum(y == -1 for _, y in saw.points) == 5
    assert sum(y == -3 for _, y in comb.points) == 10
    assert saw.solid is comb.solid is SolidSide.RIGHT
    assert len(named_task("hall-12").workspace.obstacles) == 12


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("peg-in-hol", "example: 'peg-in-hol' is no named task, did you mean peg-in-hole?"),
        ("comb", "example: 'comb' is no named task"),
        ("comb-0", "example: 'comb-0' is no named task"),
        ("hall-100001", "example: the size must be at most 100000, not 100001"),
        ("../secret", "example: '../secret' is no named task"),
    ],
)
def test_refuses_other_names(name: str, line: str) -> None:
    with pytest.raises(TaskError) as caught:
        named_task(name)
    assert str(caught.value).startswith(line)


def test_the_hole_of_the_peg_is_solid_outside() -> None:
    # Above the floor and in the hole is free: left of the direction of travel.
    chain = named_task("peg-in-hole-point").workspace.obstacles[0]
    assert isinstance(chain, ChainObstacle)
    (ax, ay), (bx, by) = chain.points[:2]
    assert bx > ax
    assert ay == by == 0.0
    assert chain.solid is SolidSide.RIGHT


def test_parse_names_a_task() -> None:
    data = {
        "version": 1,
        "window": [0, 0, 1, 1],
        "uncertainty": {"control": 0, "position": 0},
        "initial": "everywhere",
        "goal": {"points": [[0, 0]]},
    }
    assert parse_task(data).name == "task"
    assert parse_task(data, name="other").name == "other"
