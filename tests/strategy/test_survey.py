import dataclasses
import math

import numpy as np
import pytest

from preimage.configuration.obstacles import configuration_space
from preimage.errors import TaskError
from preimage.mechanics.behaviour import edge_behaviour
from preimage.strategy.survey import WORDS, edge_words, survey
from preimage.task.examples import named_task, named_tasks, task_families
from preimage.task.initial import InitialPoint
from preimage.task.options import Continuous
from preimage.task.task import Task


def told(task: Task) -> list[str]:
    return survey(task, configuration_space(task)).splitlines()


def test_what_is_understood_of_peg_in_hole() -> None:
    lines = told(named_task("peg-in-hole-point"))
    assert lines[0] == "peg-in-hole-point"
    assert "obstacles    1 unbounded chain, 6 vertices" in lines
    assert "free space   1 component, of area 206" in lines
    assert (
        "contact      5 edges of length 26, 6 vertices: "
        + ("2 concave, 2 convex, 2 at the open border")
        in lines
    )
    assert "goal         1 contact edge of length 2 and 2 contact vertices" in lines
    down = next(line for line in lines if line.startswith("↓ down (270°)"))
    assert down.split()[3:8] == ["3", "0", "0", "2", "0"]
    floor = next(line for line in lines if line.startswith("(-1, -3) to (1, -3)"))
    assert floor.split("  ")[-1].strip() == "sticks"
    assert any(line.startswith("(1, -3) concave") for line in lines)


@pytest.mark.parametrize("name", [*named_tasks(), *(f"{one}-3" for one in task_families())])
def test_every_named_task_has_one(name: str) -> None:
    task = named_task(name)
    lines = told(task)
    assert lines[0] == name
    assert not any("nan" in line for line in lines)


def test_many_features_and_directions_are_cut_short() -> None:
    task = named_task("hall-60")
    options = dataclasses.replace(
        task.options, directions=tuple(np.linspace(0.0, 6.0, 720).tolist())
    )
    lines = told(dataclasses.replace(task, options=options))
    assert len(lines) < 500
    assert any(line.startswith("and ") and line.endswith(" more") for line in lines)
    options = dataclasses.replace(task.options, directions=Continuous())
    assert "directions   all" in told(dataclasses.replace(task, options=options))


def test_a_start_without_a_place_is_refused() -> None:
    task = dataclasses.replace(named_task("flat-floor"), initial=InitialPoint((0.0, -1.0)))
    with pytest.raises(TaskError, match=r"initial\.point: .* is inside an obstacle"):
        told(task)


def test_words_of_edges() -> None:
    # a floor under motions that turn from straight down to straight up
    control, friction = math.radians(5), math.radians(20)
    said = [
        WORDS[int(edge_words(edge_behaviour(np.array([math.pi / 2]), turn, control, friction))[0])]
        for turn in (math.radians(angle) for angle in (270, 287, 300, 358, 10))
    ]
    assert [word for word, _ in said] == ["sticks", "may stick", "slides", "slides off", "leaves"]
