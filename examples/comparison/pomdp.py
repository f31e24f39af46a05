"""Guaranteed plans beside a POMDP solver from PyPI (pomdp_py's POUCT), in the same environment.

Run from anywhere: `python examples/comparison/pomdp.py [--episodes N] [--simulations N] [FILE]`; it
writes the table of docs/environment.md.
"""

from __future__ import annotations

import argparse
import math
import random
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pomdp_py

from preimage import Status, Task, named_task, plan
from preimage.environment.agent import PlanAgent
from preimage.environment.guarded import GuardedMotion
from preimage.environment.world import Place, World, new_lots
from preimage.execution.control import CONTROLS
from preimage.execution.sensing import SENSINGS
from preimage.task.degrees import to_radians

PAGE = Path(__file__).resolve().parents[2] / "docs" / "environment.md"
BEGIN, END = "<!-- table -->", "<!-- end of table -->"

DIRECTIONS = 8
MACRO = 12
"""Steps for which a command is kept: decisions are that far apart, for the solver's sake."""
PARTICLES = 300
DEPTH = 8
DISCOUNT = 0.98
NATURES = (("random", "noise"), ("hunting", "towards"))


def settings() -> list[tuple[str, Task]]:
    """Three named tasks, and one of them with errors that no plan withstands."""
    peg = named_task("peg-in-hole")
    worse = replace(peg.uncertainty, control=to_radians(22.0))
    tasks = [(name, named_task(name)) for name in ("peg-in-hole", "cradle", "rails")]
    return [*tasks, ("peg-in-hole, control 22°", replace(peg, uncertainty=worse))]


# --- the solver's model ---------------------------------------------------------------------------


class Model(pomdp_py.BlackboxModel):  # type: ignore[misc]
    """The environment's own world, with errors drawn at random within their bounds."""

    def __init__(self, world: World, step: float) -> None:
        super().__init__()
        self.world, self.time = world, step * MACRO
        self._rng = np.random.default_rng(0)
        xmin, _, xmax, _ = world.space.window
        errors = world.task.uncertainty
        self.cell = max(2.0 * errors.position, (xmax - xmin) / 20.0)
        if not errors.has_position_sensor:
            self.cell = math.inf

    def sample(self, state: State, action: Move) -> tuple[State, Seen, float, int]:
        """The next state, what is read there, the reward, and that it took one step."""
        if action.number == DIRECTIONS or state.over:
            true = self.world.is_in_goal(state.place)
            gain = 0.0 if state.over else (1.0 if true else -1.0)
            return State(state.place, True), Seen(None, None), gain, 1
        place = self.moved(state.place, action)
        if place.escaped:
            return State(place, True), Seen(None, None), -1.0, 1
        return State(place, False), self.seen(place, action), -0.002, 1

    def moved(self, place: Place, action: Move) -> Place:
        """Where a macro action leads."""
        lots = new_lots(self._rng)
        here = Place(place.robots)
        return self.world.move(here, action.angle, self.time, CONTROLS["random"], lots, self._rng)

    def seen(self, place: Place, action: Move) -> Seen:
        """What is read at a place, coarsely: what is nearly the same is one node of the tree."""
        lots = new_lots(self._rng)
        arguments = (action.angle, CONTROLS["random"], SENSINGS["noise"], lots, self._rng)
        told = self.world.sense(place, *arguments)
        return self.coarse(told.position, told.force)

    def coarse(self, position: tuple[float, float], force: float | None) -> Seen:
        """A reading as a node of the tree."""
        known = math.isfinite(self.cell) and math.isfinite(position[0])
        cell = tuple(math.floor(part / self.cell) for part in position) if known else None
        felt = None if force is None else round(force / (math.pi / 4)) % 8
        return Seen(cell, felt)


@dataclass(frozen=True, eq=False)
class State(pomdp_py.State):  # type: ignore[misc]
    """Where the robot is."""

    place: Place
    over: bool

    def __hash__(self) -> int:
        return id(self)

    def __eq__(self, other: object) -> bool:
        return self is other


@dataclass(frozen=True)
class Seen(pomdp_py.Observation):  # type: ignore[misc]
    """What is read, coarsely."""

    cell: tuple[int, ...] | None
    felt: int | None


@dataclass(frozen=True)
class Move(pomdp_py.Action):  # type: ignore[misc]
    """A direction for a while, or “here I am”."""

    number: int

    @property
    def angle(self) -> float:
        """The direction, radians."""
        return 2.0 * math.pi * self.number / DIRECTIONS


MOVES = [Move(number) for number in range(DIRECTIONS + 1)]


class Policy(pomdp_py.RolloutPolicy):  # type: ignore[misc]
    """Rollouts go for the goal, and say so when they are there: better than chance."""

    def __init__(self, world: World) -> None:
        self._world = world
        goal = world.goal
        contact = world.space.contact
        ends = contact.at(goal.contact.edge, 0.5 * (goal.contact.low + goal.contact.high))
        corners = contact.points[goal.contact.vertices]
        places = np.concatenate((ends, corners, np.array([goal.area.inner_point])))
        self._goals = places[np.all(np.isfinite(places), axis=1)]

    def get_all_actions(self, *_: Any, **__: Any) -> list[Move]:
        """All of them, always."""
        return MOVES

    def sample(self, state: State) -> Move:
        """Any of them."""
        return random.choice(MOVES)

    def rollout(self, state: State, _history: Any = None) -> Move:
        """Towards the goal mostly."""
        if self._world.is_in_goal(state.place):
            return MOVES[-1]
        if random.random() < 0.3:
            return random.choice(MOVES[:-1])
        off = self._goals - np.array(state.place.point)
        x, y = off[int(np.argmin(np.hypot(off[:, 0], off[:, 1])))]
        return MOVES[round(math.atan2(y, x) * DIRECTIONS / (2.0 * math.pi)) % DIRECTIONS]


def believed(
    model: Model, belief: list[State], action: Move, observation: dict[str, Any]
) -> list[State]:
    """The particles after a reading: those that may give it, resampled."""
    errors = model.world.task.uncertainty
    here = observation["position"]
    felt = bool(np.any(observation["force"]))
    moved = [model.moved(state.place, action) for state in belief]
    kept, near = [], []
    for place in moved:
        if place.escaped:
            continue
        away = float(np.hypot(*(np.array(place.point) - here)))
        touches = place.robots.feature[0] < 2 * len(model.world.space.contact)
        if not errors.has_position_sensor:
            away = 0.0
        near.append((away + (0.0 if touches == felt else model.cell), place))
        if away < errors.position and (touches or not felt):
            kept.append(place)
    if len(kept) < 5:  # the errors of all are off: the nearest go on
        near.sort(key=lambda pair: pair[0])
        kept = [place for _, place in near[:20]] or [state.place for state in belief]
    return [State(random.choice(kept), False) for _ in range(PARTICLES)]


# --- episodes -------------------------------------------------------------------------------------


@dataclass
class Score:
    """What became of some episodes."""

    episodes: int = 0
    reached: int = 0
    false: int = 0
    left: int = 0
    seconds: float = 0.0
    decisions: int = 0

    def add(self, outcome: str) -> None:
        """Count one."""
        self.episodes += 1
        self.reached += outcome.startswith("in the goal")
        self.false += outcome.startswith("said so")
        self.left += outcome.startswith("left")


def solve(task: Task, nature: tuple[str, str], episodes: int, simulations: int) -> Score:
    """Episodes of POUCT, with so many simulations for each decision."""
    score = Score()
    environment = _environment(task, nature)
    model = Model(environment.world, environment.step_time)
    policy = Policy(environment.world)
    for seed in range(episodes):
        observation, info = environment.reset(seed=seed)
        rng = np.random.default_rng(seed)
        belief = [State(environment.world.begin(rng), False) for _ in range(PARTICLES)]
        over = False
        while not over:
            began = time.process_time()
            agent = pomdp_py.Agent(pomdp_py.Particles(belief), policy, blackbox_model=model)
            solver = pomdp_py.POUCT(
                max_depth=DEPTH, discount_factor=DISCOUNT, num_sims=simulations,
                exploration_const=1.0, rollout_policy=policy,
            )  # fmt: skip
            action = solver.plan(agent)
            score.seconds += time.process_time() - began
            score.decisions += 1
            for _ in range(1 if action.number == DIRECTIONS else MACRO):
                observation, _, done, late, info = environment.step(action.number)
                over = done or late
                if over:
                    break
            if not over:
                belief = believed(model, belief, action, observation)
        score.add(info["outcome"])
    return score


def carry_out(task: Task, nature: tuple[str, str], episodes: int) -> Score | None:
    """Episodes of the guaranteed plan; None if there is none."""
    score, began = Score(), time.perf_counter()
    strategy = plan(task)
    score.seconds = time.perf_counter() - began
    if strategy.status is not Status.SOLVED:
        return None
    environment = _environment(task, nature)
    agent = PlanAgent(strategy)
    for seed in range(episodes):
        observation, info = environment.reset(seed=seed)
        over = False
        while not over:
            observation, _, done, late, info = environment.step(agent.act(environment, observation))
            over = done or late
        score.decisions += len(strategy.steps)
        score.add(info["outcome"])
    return score


def _environment(task: Task, nature: tuple[str, str]) -> GuardedMotion:
    xmin, _, xmax, _ = task.workspace.window.bounds
    return GuardedMotion(
        task,
        directions=DIRECTIONS,
        control=nature[0],
        sensing=nature[1],
        patience=4.0 * (xmax - xmin),
    )


def interval(many: int, of: int) -> str:
    """Wilson's interval at 95 %, in percent."""
    z, p = 1.96, many / of
    middle = (p + z * z / (2 * of)) / (1 + z * z / of)
    half = z * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of)) / (1 + z * z / of)
    return (
        f"{100 * p:.0f} % ({100 * max(0.0, middle - half):.0f}–{100 * min(1.0, middle + half):.0f})"
    )


def table(episodes: int, simulations: int) -> str:
    """The comparison, as Markdown."""
    lines = [
        "| task | nature | who | in the goal, and said so | false “here I am” | left the window "
        "| planning |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, task in settings():
        for nature in NATURES:
            for who, score in (
                ("plan", carry_out(task, nature, 10 * episodes)),
                ("POUCT", solve(task, nature, episodes, simulations)),
            ):
                head = f"| {name} | {nature[0]}, {nature[1]} | {who} |"
                if score is None:
                    lines.append(f"{head} no plan exists for these directions | – | – | – |")
                    continue
                each = score.seconds / (score.decisions if who == "POUCT" else 1)
                cost = f"{each:.2f} s a decision" if who == "POUCT" else f"{each:.2f} s, once"
                lines.append(
                    f"{head} {interval(score.reached, score.episodes)} | {score.false} of "
                    f"{score.episodes} | {score.left} | {cost} |"
                )
                print(lines[-1], flush=True)
    return "\n".join(lines)


def main() -> None:
    """Write the table into the page, between its marks."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", nargs="?", type=Path, default=PAGE)
    parser.add_argument("--episodes", type=int, default=15)
    parser.add_argument("--simulations", type=int, default=150)
    chosen = parser.parse_args()
    random.seed(0)
    made = table(chosen.episodes, chosen.simulations)
    text = chosen.page.read_text("utf-8")
    head, rest = text.split(BEGIN)
    tail = rest.split(END)[1]
    chosen.page.write_text(f"{head}{BEGIN}\n{made}\n{END}{tail}", "utf-8")


if __name__ == "__main__":
    main()
