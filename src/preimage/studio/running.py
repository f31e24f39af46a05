"""Plans carried out by the simulator, under adversaries that one chooses."""

from __future__ import annotations

from preimage.configuration.start import Start
from preimage.execution.control import CONTROLS
from preimage.execution.describe import describe_report
from preimage.execution.runs import RunOptions, run, trace_of
from preimage.execution.sensing import SENSINGS
from preimage.strategy.strategy import Strategy
from preimage.studio.plain import trace_of as plain_trace
from preimage.studio.questions import Body, Tell
from preimage.studio.requests import drawable, point, strategy_of, whole, word
from preimage.studio.standing import start_at

MOST_RUNS = 2_000
"""Under each pair of adversaries."""

CONTROL_WORDS = {
    "exact": "moves as it is told",
    "left": "turned left as far as may be",
    "right": "turned right as far as may be",
    "bias": "turned by the same angle all the time",
    "switching": "from one side of the cone to the other at contacts",
    "drifting": "turns slowly about",
    "random": "any direction of the cone, again and again",
    "hunting": "makes for where the plan would fail",
    "fleeing": "keeps away from the target",
    "sticking": "rests wherever it may",
    "mixed": "now one, now another of these",
}

SENSING_WORDS = {
    "true": "reads what is",
    "towards": "reads nearer to the goal's border than it is",
    "away": "reads further from it",
    "persistent": "off by the same all the time",
    "turned-left": "the force turned left",
    "turned-right": "the force turned right",
    "zero": "no force wherever none may be read",
    "noise": "anywhere within the errors, again and again",
}


def adversaries(body: Body, tell: Tell) -> Body:
    """Who may play nature."""
    return {
        "control": [{"name": name, "words": CONTROL_WORDS.get(name, "")} for name in CONTROLS],
        "sensing": [{"name": name, "words": SENSING_WORDS.get(name, "")} for name in SENSINGS],
    }


def one_run(body: Body, tell: Tell) -> Body:
    """One run, whole."""
    strategy = strategy_of(body, solved=True)
    drawable(strategy.space)
    pair = (
        word(body, "control", list(CONTROLS), "hunting"),
        word(body, "sensing", list(SENSINGS), "towards"),
    )
    options = RunOptions(seed=whole(body, "seed", 0, 0, 2**31))
    start = _start(body, strategy)
    made = trace_of(
        strategy, pair, whole(body, "number", 0, 0, MOST_RUNS), start=start, options=options
    )
    return {**plain_trace(made), "control": pair[0], "sensing": pair[1]}


def _start(body: Body, strategy: Strategy) -> Start | None:
    """The place that a run is to begin at; it must be one that the plan is for."""
    if body.get("start") is None:
        return None
    return start_at(strategy, point(body["start"], "start"))


def many_runs(body: Body, tell: Tell) -> Body:
    """Many runs under each pair of adversaries, counted."""
    strategy = strategy_of(body, solved=True)
    runs = whole(body, "runs", 200, 1, MOST_RUNS)
    report = run(
        strategy,
        control=word(body, "control", [*CONTROLS, "all"], "all"),
        sensing=word(body, "sensing", [*SENSINGS, "all"], "all"),
        options=RunOptions(runs=runs, seed=whole(body, "seed", 0, 0, 2**31)),
        progress=lambda done, total: tell({"done": done, "total": total}),
    )
    return {
        "runs": report.runs,
        "failures": report.failures,
        "pairs": [
            {
                "control": tally.control,
                "sensing": tally.sensing,
                "runs": tally.runs,
                "failures": tally.failures,
                "time": round(float(tally.time[1]), 4),
            }
            for tally in report.tallies
        ],
        "words": describe_report(report).splitlines(),
    }
