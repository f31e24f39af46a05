"""Pictures of a plan carried out in MuJoCo: a strip of moments, and a short animation.

Run from anywhere, with the extra `physics` and Pillow; without a screen, with MUJOCO_GL=egl:

    python examples/physics/pictures.py [--task peg-in-hole] [--run 2] [--folder docs/images]
"""

from __future__ import annotations

import argparse
import math
import os
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

os.environ.setdefault("MUJOCO_GL", "egl")

import mujoco
import numpy as np
from PIL import Image
from PIL.Image import Image as Picture

from preimage import named_task, plan
from preimage.configuration.contact import Floats
from preimage.execution.program import compiled
from preimage.physics.drive import Drive
from preimage.physics.engine import Engine
from preimage.physics.scene import Scene, scene
from preimage.physics.trials import plan_trials
from preimage.task.task import SlidingLaw

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "images"

WIDTH, HEIGHT, GAP = 480, 360, 8

READING = (0.15, 0.3, 0.85, 0.9)
COMMAND = (0.1, 0.55, 0.25, 1.0)
ERROR = (0.15, 0.3, 0.85, 0.18)

FRAMES, LAST = 60, 8
"""Of the animation; the last one stays for so many."""


def camera(stage: Scene, places: Floats) -> Any:
    """Looks down on where the robot goes, a little from below."""
    length = stage.length
    low, high = places.min(axis=0), places.max(axis=0)
    extent = float(np.max(high - low)) + 0.15 * (stage.space.window[2] - stage.space.window[0])
    made = mujoco.MjvCamera()
    mujoco.mjv_defaultCamera(made)
    made.lookat[:] = *((low + high) / 2.0 / length), 0.0
    made.distance, made.azimuth, made.elevation = 1.25 * extent / length, 90.0, -65.0
    return made


def frame(
    renderer: Any, engine: Engine, stage: Scene, run: Drive, moment: int, view: Any
) -> Picture:
    """The robot at a moment of a run, what was read there, and where it is told to go."""
    length, size = stage.length, 0.012 * (stage.space.window[2] - stage.space.window[0])
    engine.place(*run.places[moment])
    renderer.update_scene(engine.data, view)
    height = 2.0 * size + (stage.space.window[2] - stage.space.window[0]) / 20.0
    x, y = run.measured[moment]
    if math.isfinite(x):
        at = np.array([x, y, height]) / length
        _mark(renderer, mujoco.mjtGeom.mjGEOM_SPHERE, np.full(3, 0.5 * size / length), at, READING)
        wide = np.array([stage.task.uncertainty.position, 0.0, 0.05 * size]) / length
        wide[1] = wide[0]
        _mark(renderer, mujoco.mjtGeom.mjGEOM_ELLIPSOID, wide, at, ERROR)
    command = run.commands[moment]
    if math.isfinite(command):
        start = np.array([*run.places[moment], height]) / length
        along = np.array([math.cos(command), math.sin(command), 0.0])
        geom = _mark(renderer, mujoco.mjtGeom.mjGEOM_ARROW, np.ones(3), start, COMMAND)
        stop = start + 6.0 * size / length * along
        arrow = mujoco.mjtGeom.mjGEOM_ARROW
        mujoco.mjv_connector(geom, arrow, 0.35 * size / length, start, stop)
    return Image.fromarray(renderer.render())


def _mark(renderer: Any, kind: Any, size: Floats, place: Floats, colour: tuple[float, ...]) -> Any:
    drawn = renderer.scene
    geom = drawn.geoms[drawn.ngeom]
    drawn.ngeom += 1
    rgba = np.array(colour, dtype=np.float32)
    mujoco.mjv_initGeom(geom, kind, size, place, np.eye(3).ravel(), rgba)
    return geom


def moments(run: Drive, count: int) -> list[int]:
    """So many looks, evenly spread over a run's time."""
    times = np.linspace(run.times[0], run.times[-1], count)
    return [int(np.searchsorted(run.times, time).clip(0, len(run.times) - 1)) for time in times]


def main() -> None:
    """Write the strip and the animation."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--task", default="peg-in-hole")
    parser.add_argument("--run", type=int, default=2, help="which run (2)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--frames", type=int, default=FRAMES, help="of the animation (60)")
    parser.add_argument("--folder", type=Path, default=FOLDER)
    options = parser.parse_args()
    task = replace(named_task(options.task), sliding=SlidingLaw.DAMPER)
    stage = scene(task)
    runs = plan_trials(stage, compiled(plan(task)), options.run + 1, options.seed)
    run = next(islice(runs, options.run, None))
    engine = Engine(stage)
    renderer = mujoco.Renderer(engine.model, HEIGHT, WIDTH)
    view = camera(stage, run.places)
    strip = Image.new("RGB", (2 * WIDTH + GAP, 2 * HEIGHT + GAP), "white")
    for place, moment in enumerate(moments(run, 4)):
        row, column = divmod(place, 2)
        picture = frame(renderer, engine, stage, run, moment, view)
        strip.paste(picture, (column * (WIDTH + GAP), row * (HEIGHT + GAP)))
    strip.quantize(128).save(options.folder / f"{options.task}-mujoco.png", optimize=True)
    frames = [
        frame(renderer, engine, stage, run, moment, view).quantize(64)
        for moment in moments(run, options.frames)
    ]
    first, *others = frames + LAST * frames[-1:]
    target = options.folder / f"{options.task}-mujoco.gif"
    first.save(target, save_all=True, append_images=others, duration=80, loop=0, optimize=True)
    renderer.close()


if __name__ == "__main__":
    main()
