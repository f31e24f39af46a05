"""Many runs of one controller in one scene, and what became of them."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import product

import numpy as np

from preimage.configuration.start import start_region
from preimage.execution.executor import Executor
from preimage.execution.program import Program
from preimage.execution.trace import Outcome
from preimage.physics.drive import Controller, Drive, drive
from preimage.physics.engine import Engine
from preimage.physics.nature import Nature, Sensing, Steering
from preimage.physics.scene import Scene
from preimage.physics.starts import draw_start

PATIENCE = 4.0
"""A run may take so many times the window's half circumference for each motion of a plan."""

Natures = tuple[tuple[Steering, Sensing], ...]

NATURES: Natures = tuple(product(Steering, Sensing))
"""Run `k` plays against number `k` of these, modulo their number."""


def trials(
    scene: Scene,
    controller: Callable[[np.random.Generator], Controller],
    runs: int,
    seed: int,
    patience: float,
    natures: Natures = NATURES,
) -> Iterator[Drive]:
    """So many runs, each with chance of its own: run `k` is the same whatever `runs` is.

    Parameters
    ----------
    controller : makes one for a run; it may draw from the run's chance.
    patience : the longest time of a run, in units of length.
    natures : how errors come, taken in turn.
    """
    engine = Engine(scene)
    start = start_region(scene.task, scene.space)
    for number in range(runs):
        generator = np.random.default_rng((seed, number))
        steering, sensing = natures[number % len(natures)]
        place = draw_start(start, scene.space, generator)
        nature = Nature(scene.task, scene.plant, steering, sensing, generator)
        yield drive(scene, engine, controller(generator), nature, place, patience)


def plan_trials(
    scene: Scene, program: Program, runs: int, seed: int, natures: Natures = NATURES
) -> Iterator[Drive]:
    """The same for a plan, carried out by its executor."""
    patience = patience_of(scene, program)
    return trials(scene, lambda _: Executor(program), runs, seed, patience, natures)


def patience_of(scene: Scene, program: Program) -> float:
    """How long a run of a plan may take until it is called endless."""
    xmin, ymin, xmax, ymax = scene.space.window
    most = PATIENCE * (xmax - xmin + ymax - ymin)
    return math.fsum(min(2.0 * motion.longest, most) for motion in program.motions.values())


def tally(drives: list[Drive]) -> Counter[Outcome]:
    """How many runs ended how."""
    return Counter(one.outcome for one in drives)
