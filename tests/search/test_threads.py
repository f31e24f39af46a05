"""Plans that are made at the same time in threads of one process."""

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from random import Random
from threading import Barrier

import pytest

from preimage.preimages.setting import Command, Setting
from preimage.search.planner import plan
from preimage.strategy.plan_file import format_plan
from preimage.task.examples import named_task
from preimage.task.options import StrategyKind, uniform_directions
from preimage.task.task import Task
from tests.laws.tasks import random_task

CREW = 4


@pytest.fixture
def restless() -> Iterator[None]:
    """Threads take turns as often as they can."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def as_asked(task: Task, kind: StrategyKind) -> Task:
    options = replace(
        task.options,
        strategy=kind,
        directions=uniform_directions(8),
        max_steps=2,
        max_regions=50,
        time_limit=None,
    )
    return replace(task, options=options)


def planned(task: Task) -> str:
    strategy = plan(task, reasoned=False)
    statistics = replace(strategy.statistics, seconds=0.0)
    return format_plan(replace(strategy, statistics=statistics))


@pytest.mark.usefixtures("restless")
@pytest.mark.parametrize("kind", StrategyKind)
@pytest.mark.parametrize("name", ["peg-in-hole", "example-1", "hall-12"])
def test_plans_of_one_task_in_threads_are_those_made_alone(name: str, kind: StrategyKind) -> None:
    task = as_asked(named_task(name), kind)
    alone = planned(task)
    with ThreadPoolExecutor(CREW) as crew:
        assert list(crew.map(planned, [task] * CREW)) == [alone] * CREW


@pytest.mark.slow
@pytest.mark.usefixtures("restless")
@pytest.mark.parametrize("kind", StrategyKind)
def test_plans_of_many_tasks_in_threads_are_those_made_alone(kind: StrategyKind) -> None:
    tasks = [as_asked(random_task(Random(seed)), kind) for seed in range(40)]
    alone = [planned(task) for task in tasks]
    with ThreadPoolExecutor(CREW) as crew:
        assert list(crew.map(planned, tasks)) == alone


@pytest.mark.usefixtures("restless")
def test_threads_that_ask_at_once_get_the_same_command() -> None:
    directions = uniform_directions(64)
    for _ in range(20):
        setting, together = Setting.of(named_task("peg-in-hole-point")), Barrier(CREW)

        def all_commands(
            _: int, setting: Setting = setting, together: Barrier = together
        ) -> list[Command]:
            together.wait(timeout=10.0)
            return [setting.command(direction) for direction in directions]

        with ThreadPoolExecutor(CREW) as crew:
            first, *others = crew.map(all_commands, range(CREW))
        for other in others:
            assert all(one is same for one, same in zip(first, other, strict=True))
