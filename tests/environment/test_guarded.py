"""The environment keeps Gymnasium's rules, and nature's; plans win in it, others not always."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import preimage
from preimage.environment.agent import PlanAgent
from preimage.environment.guarded import GuardedMotion
from preimage.environment.registration import NAME
from preimage.errors import InputError
from preimage.execution.control import CONTROLS
from preimage.execution.sensing import SENSINGS
from preimage.task.options import StrategyKind

TASKS = ("peg-in-hole", "cradle", "l-room", "blind-corner", "two-bays", "flat-floor")


def make(task: Any = "peg-in-hole", **options: Any) -> GuardedMotion:
    found = gymnasium.make(NAME, task=task, **options).unwrapped
    assert isinstance(found, GuardedMotion)
    return found


@pytest.mark.parametrize("directions", [8, None])
@pytest.mark.parametrize("task", TASKS)
def test_gymnasium_finds_no_fault(task: str, directions: int | None) -> None:
    check_env(make(task, directions=directions, render_mode="ansi"))


@pytest.mark.slow
@pytest.mark.parametrize("task", sorted(preimage.named_tasks()))
def test_gymnasium_finds_no_fault_in_any_named_task(task: str) -> None:
    check_env(make(task))


def episode(env: GuardedMotion, act: Any, seed: int) -> dict[str, Any]:
    observation, info = env.reset(seed=seed)
    for _ in range(100_000):
        observation, _, over, late, info = env.step(act(env, observation))
        if over or late:
            return info
    raise AssertionError("endless")


@pytest.mark.parametrize("task", TASKS)
def test_plans_never_lose(task: str) -> None:
    given = preimage.named_task(task)
    if task == "two-bays":
        given = replace(given, options=replace(given.options, strategy=StrategyKind.CONDITIONAL))
    agent = PlanAgent(preimage.plan(given))
    env = make(task, directions=None, control="any", sensing="any")
    for seed in range(15):
        info = episode(env, agent.act, seed)
        assert info["outcome"] == "in the goal, and said so", (seed, info)
        assert info["truth"]["in_goal"]


def test_stopping_near_the_goal_loses_sometimes() -> None:
    """Straight at the goal, and “here I am” where the reading is within half the error of it."""
    env = make("peg-in-hole", directions=None, control="random", sensing="noise")
    goal = np.array([0.0, -3.0])

    def act(env: GuardedMotion, observation: Any) -> Any:
        x, y = goal - observation["position"]
        here = math.hypot(x, y) < 0.15
        return env.action_of(None if here else math.atan2(y, x))

    outcomes = {episode(env, act, seed)["outcome"] for seed in range(20)}
    assert outcomes - {"in the goal, and said so"}


def test_nature_stays_within_her_bounds() -> None:
    for control, sensing in (("hunting", "towards"), ("switching", "noise"), ("fleeing", "zero")):
        env = make("peg-in-hole", control=control, sensing=sensing)
        senses = env.world.task.uncertainty
        rng = np.random.default_rng(3)
        observation, info = env.reset(seed=5)
        place = info["truth"]["place"]
        for _ in range(200):
            number = int(rng.integers(8))
            observation, _, over, late, info = env.step(number)
            if over or late:
                break
            now = info["truth"]["place"]
            gone = now - place
            assert np.hypot(*gone) <= env.step_time * (1 + 1e-9)
            free = not np.any(observation["force"])
            angle = 2 * math.pi * number / 8
            if free and np.hypot(*gone) > 0.999 * env.step_time:
                off = math.remainder(math.atan2(gone[1], gone[0]) - angle, 2 * math.pi)
                assert abs(off) <= senses.control + 1e-9
            assert np.hypot(*(observation["position"] - now)) < senses.position
            place = now


def test_the_same_seed_gives_the_same_episode() -> None:
    env = make("l-room", control="any", sensing="any")
    traces = []
    for _ in range(2):
        observation, _ = env.reset(seed=11)
        row = [observation["position"].tolist()]
        for number in (0, 0, 3, 6, 6):
            observation, *_ = env.step(number)
            row.append([*observation["position"].tolist(), *observation["force"].tolist()])
        traces.append(row)
    assert traces[0] == traces[1]


def test_who_says_so_falsely_and_who_is_late_end() -> None:
    env = make("peg-in-hole", patience=0.5, cost=0.25, penalty=3.0)
    env.reset(seed=0)
    _, reward, over, late, info = env.step(env.action_of(None))
    assert (reward, over, late) == (-3.0, True, False)
    assert info["outcome"] == "said so, and is not there"
    env.reset(seed=0)
    late = False
    while not late:
        _, reward, over, late, info = env.step(4)
        assert reward == -0.25
        assert not over
    assert info["outcome"] == "took too long"


def test_who_leaves_the_window_has_lost() -> None:
    env = make("peg-in-hole")
    env.reset(seed=0)
    over = False
    while not over:
        _, reward, over, _, info = env.step(2)
    assert (reward, info["outcome"]) == (-1.0, "left the window")
    assert "left the window" in env.render()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"control": "nobody"}, "control: must be one of"),
        ({"sensing": 3}, "sensing: must be one of"),
        ({"directions": 0}, "directions: must be a whole number"),
        ({"step": -1.0}, "step: must be finite and more than 0"),
        ({"patience": math.nan}, "patience: must be finite"),
    ],
)
def test_refusals(options: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        GuardedMotion("flat-floor", **options)


def test_any_nature_is_met() -> None:
    env = make("flat-floor", control="any", sensing="any")
    met = {(env.reset(seed=seed)[1][key]) for seed in range(60) for key in ("control", "sensing")}
    assert met <= {*CONTROLS, *SENSINGS}
    assert len(met) > 12


def test_gymnasium_finds_it_by_its_module() -> None:
    name = f"preimage.environment:{NAME}"
    script = f"import gymnasium; print(gymnasium.make({name!r}, task='flat-floor').action_space)"
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "Discrete(9)", done.stderr


def test_vectors_of_it() -> None:
    env = gymnasium.make_vec(NAME, num_envs=3, vectorization_mode="sync", task="flat-floor")
    observations, _ = env.reset(seed=0)
    assert observations["position"].shape == (3, 2)
    observations, rewards, *_ = env.step(np.array([6, 6, 8]))
    assert rewards.shape == (3,)
    env.close()
