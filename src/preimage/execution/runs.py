"""Runs of a plan against nature, as many as one likes (theory 8)."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar
from zlib import crc32

import numpy as np

from preimage.configuration.region import Region
from preimage.configuration.start import Start, start_region
from preimage.execution.chunk import NO_MARKS, OUTCOMES, Chunk, Scene, carry_out_plan
from preimage.execution.control import CONTROLS, Control
from preimage.execution.report import Report, Tally
from preimage.execution.sensing import SENSINGS, Sensing
from preimage.execution.starts import of_start
from preimage.execution.trace import Trace
from preimage.jobs import Workforce, workforce
from preimage.strategy.strategy import Strategy

CHUNK = 2_000
"""So many robots move at a time."""

SAMPLES = 3
"""Runs of each pair of adversaries that are kept whole."""

Pair = tuple[str, str]
"""Names of an adversary for control and of one for sensing."""

Progress = Callable[[int, int], None]
"""Told how many runs are done, and of how many."""

Adversary = TypeVar("Adversary")


@dataclass(frozen=True, slots=True)
class RunOptions:
    """How runs are made.

    Parameters
    ----------
    runs : under each pair of adversaries.
    seed : the same seed, the same runs.
    workers : processes that share the pairs; adversaries of one's own must then be importable.
    """

    runs: int = 1_000
    seed: int = 0
    workers: int = 1


DEFAULT = RunOptions()


def run(
    strategy: Strategy,
    *,
    control: str | Sequence[str] | Mapping[str, Control] = "all",
    sensing: str | Sequence[str] | Mapping[str, Sensing] = "all",
    start: Start | None = None,
    marks: Mapping[int, Region] = NO_MARKS,
    options: RunOptions = DEFAULT,
    crew: Workforce | None = None,
    progress: Progress | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Report:
    """Carry a plan out many times, under every pair of adversaries (theory 8).

    Parameters
    ----------
    control, sensing : names from `CONTROLS` and `SENSINGS`, `"all"`, or adversaries of one's own
        by name.
    start : where runs begin; the task's start by default.
    marks : by region id, what its motion surely recognises, if that is less than its target: the
        sensors are looked at where its borders are crossed.
    crew : who makes the runs; as many processes as the options say by default.
    progress : told after each pair.
    cancelled : asked after each pair; then what was done so far is reported.

    Raises
    ------
    PlanFileError : the plan is not solved.
    InputError : an adversary's choices are no choices.
    PreimageError : processes are ended from outside again and again.
    ValueError : a name is not known.

    >>> import preimage
    >>> strategy = preimage.plan(preimage.named_task("peg-in-hole"))
    >>> report = run(strategy, control="hunting", sensing="towards", options=RunOptions(runs=50))
    >>> report.runs, report.failures
    (50, 0)
    """
    began = time.perf_counter()
    controls = _named(control, CONTROLS, "control")
    sensings = _named(sensing, SENSINGS, "sensing")
    pairs = [(c, s) for c in controls for s in sensings]
    start = start_region(strategy.task, strategy.space) if start is None else start
    # what is in the tables is found there by every process; functions are not handed over
    own = {name: one for name, one in controls.items() if CONTROLS.get(name) is not one}
    own_sensings = {name: one for name, one in sensings.items() if SENSINGS.get(name) is not one}
    setting = (strategy, start, marks)
    work = partial(_pair, setting, controls=own, sensings=own_sensings, options=options)
    with contextlib.ExitStack() as stack:
        if crew is None:
            crew = stack.enter_context(workforce(min(options.workers, len(pairs))))
        results = crew.carry_out(work, pairs)
        stack.callback(results.close)
        found = _collected(options.runs * len(pairs), progress, cancelled, results)
    return _report(strategy, found, time.perf_counter() - began)


def trace_of(
    strategy: Strategy,
    pair: Pair,
    number: int = 0,
    *,
    start: Start | None = None,
    options: RunOptions = DEFAULT,
) -> Trace:
    """One of the runs, whole: the same as in `run` with the same options."""
    scene = Scene.of(strategy)
    start = start_region(strategy.task, strategy.space) if start is None else start
    adversaries = (CONTROLS[pair[0]], SENSINGS[pair[1]])
    return _chunk(scene, start, pair, adversaries, number // CHUNK, options).trace(number % CHUNK)


def _named(
    chosen: str | Sequence[str] | Mapping[str, Adversary],
    table: Mapping[str, Adversary],
    what: str,
) -> Mapping[str, Adversary]:
    """Adversaries by name.

    Raises
    ------
    ValueError : a name is not known.
    """
    if isinstance(chosen, Mapping):
        return chosen
    names = [chosen] if isinstance(chosen, str) else chosen
    if "all" in names:
        return table
    for name in names:
        if name not in table:
            raise ValueError(f"{what} is {name!r}, must be one of {', '.join(table)}, all")
    return {name: table[name] for name in names}


def _collected(
    total: int,
    progress: Progress | None,
    cancelled: Callable[[], bool] | None,
    results: Iterable[tuple[int, tuple[Tally, list[Trace]]]],
) -> list[tuple[Tally, list[Trace]]]:
    """The results in the order of the pairs, until somebody wants no more."""
    found = {}
    done = 0
    for place, (tally, traces) in results:
        found[place] = (tally, traces)
        done += tally.runs
        if progress is not None:
            progress(done, total)
        if cancelled is not None and cancelled():
            break
    return [found[place] for place in sorted(found)]


_Setting = tuple[Strategy, Start, Mapping[int, Region]]

_prepared: list[tuple[_Setting, Scene]] = []


def _scene(setting: _Setting) -> Scene:
    """The plan compiled, once in each process: work is sent there once."""
    for known, scene in _prepared:
        if known is setting:
            return scene
    strategy, _, marks = setting
    scene = Scene.of(strategy, marks)
    _prepared[:] = [(setting, scene)]
    return scene


def _pair(
    setting: _Setting,
    pair: Pair,
    controls: Mapping[str, Control],
    sensings: Mapping[str, Sensing],
    options: RunOptions,
) -> tuple[Tally, list[Trace]]:
    """All runs under one pair of adversaries; the traces worth keeping come with them.

    Parameters
    ----------
    controls, sensings : adversaries that are not in the tables.
    """
    scene, start = _scene(setting), setting[1]
    adversaries = ({**CONTROLS, **controls}[pair[0]], {**SENSINGS, **sensings}[pair[1]])
    count = -(-options.runs // CHUNK)
    parts = [_chunk(scene, start, pair, adversaries, part, options) for part in range(count)]
    outcomes, times, distances, motions = (
        np.concatenate([getattr(part, name) for part in parts])
        for name in ("outcomes", "time", "distance", "motions")
    )
    counts = {outcome: int(np.sum(outcomes == code)) for code, outcome in enumerate(OUTCOMES)}
    tally = Tally(
        *pair,
        runs=options.runs,
        outcomes={outcome: count for outcome, count in counts.items() if count},
        time=(float(times.mean()), float(times.max())),
        distance=(float(distances.mean()), float(distances.max())),
        motions=(float(motions.mean()), int(motions.max())),
    )
    planned = [code for code, outcome in enumerate(OUTCOMES) if outcome.as_planned]
    won = np.isin(outcomes, planned)
    kept = list(range(min(SAMPLES, options.runs)))
    kept += np.flatnonzero(~won)[:1].tolist()
    kept += [int(np.argmax(np.where(won, times, -1.0)))]
    return tally, [parts[n // CHUNK].trace(n % CHUNK) for n in kept]


def _chunk(
    scene: Scene,
    start: Start,
    pair: Pair,
    adversaries: tuple[Control, Sensing],
    part: int,
    options: RunOptions,
) -> Chunk:
    """Runs number `CHUNK * part` and following, the same whatever else is run."""
    names = [crc32(name.encode()) for name in pair]
    rng = np.random.default_rng([options.seed, *names, part])
    count = min(CHUNK, options.runs - CHUNK * part)
    starts = of_start(scene.strategy.space, start, count, rng)
    return carry_out_plan(scene, pair, adversaries, starts, rng, CHUNK * part)


def _report(strategy: Strategy, found: list[tuple[Tally, list[Trace]]], seconds: float) -> Report:
    """What all pairs came to."""
    traces = [replace(trace, strategy=strategy) for _, kept in found for trace in kept]
    failed = [trace for trace in traces if not trace.outcome.as_planned]
    done = [trace for trace in traces if trace.outcome.as_planned]
    return Report(
        strategy=strategy,
        tallies=tuple(tally for tally, _ in found),
        failure=failed[0] if failed else None,
        slowest=max(done, key=lambda trace: trace.time, default=None),
        samples=tuple(
            replace(trace, strategy=strategy) for _, kept in found for trace in kept[:SAMPLES]
        ),
        seconds=seconds,
    )
