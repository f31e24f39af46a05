"""Pictures and films of runs: what they contain."""

import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from PIL import Image

from preimage.errors import InputError, UnsupportedError
from preimage.execution.report import Report
from preimage.execution.runs import RunOptions, run
from preimage.execution.trace import Outcome, Trace
from preimage.rendering import FilmFormat, animate, animation, draw, figure, film_format_of
from preimage.rendering.film import FilmOptions, frames_of
from preimage.search.planner import plan
from preimage.strategy.plan_file import plan_to_dict
from preimage.strategy.plan_parse import parse_plan
from preimage.strategy.strategy import Strategy
from preimage.task.examples import named_task

SHORT = {"seconds": 0.5, "rate": 10, "width": 200, "rest": 0.1}


@pytest.fixture(scope="module")
def strategy() -> Strategy:
    return plan(named_task("peg-in-hole"))


@pytest.fixture(scope="module")
def sound(strategy: Strategy) -> Report:
    return run(strategy, control=["bias", "left"], options=RunOptions(3))


@pytest.fixture(scope="module")
def unsound(strategy: Strategy) -> Report:
    data = plan_to_dict(strategy)
    data["task"]["uncertainty"]["control"] = 25.0
    return run(parse_plan(data), control="bias", sensing="noise", options=RunOptions(60))


def labels(drawn: Figure) -> set[str]:
    return {str(a.get_label()) for axes in drawn.axes for a in axes.get_children()}


def one(report: Report) -> Trace:
    assert report.slowest is not None
    return report.slowest


def test_a_run_has_a_panel_for_each_motion_with_its_way(sound: Report) -> None:
    trace = one(sound)
    drawn = figure(trace)
    assert [axes.get_gid() for axes in drawn.axes] == ["motion-1", "motion-2"]
    for axes, leg in zip(drawn.axes, trace.legs, strict=True):
        (way,) = [a for a in axes.get_children() if a.get_label() == "run"]
        assert isinstance(way, LineCollection)
        (path,) = way.get_paths()
        assert np.allclose(path.vertices, leg.places)
        names = {str(a.get_label()) for a in axes.get_children()}
        assert {"begin", "end", "measured", "direction"} <= names
        assert any(name.startswith("target") for name in names)
    assert {"force", "force-cone"} <= {str(a.get_label()) for a in drawn.axes[1].get_children()}
    assert trace.control in str(drawn.get_label())
    words = {text.get_text() for text in drawn.legends[0].get_texts()}
    assert {"way of a run", "position as measured", "force as measured"} <= words
    assert "run that failed" not in words


def test_many_runs_are_drawn_together(sound: Report) -> None:
    drawn = figure(sound)
    assert f"all {sound.runs} runs succeeded" in str(drawn.get_label())
    (way,) = [a for a in drawn.axes[0].get_children() if a.get_label() == "run"]
    assert isinstance(way, LineCollection)
    assert len(way.get_paths()) == len(sound.samples)
    assert "measured" not in labels(drawn)


def test_the_first_failure_stands_out(unsound: Report) -> None:
    assert unsound.failure is not None
    for subject in (unsound, unsound.failure):
        drawn = figure(subject)
        assert {"failure", "failure-end", "failure-words"} <= labels(drawn)
        words = [
            a.get_text()  # type: ignore[attr-defined]
            for axes in drawn.axes
            for a in axes.get_children()
            if a.get_label() == "failure-words"
        ]
        assert words == [unsound.failure.outcome.value]
    assert "runs failed" in str(figure(unsound).get_label())


def test_the_same_runs_give_the_same_bytes(sound: Report, tmp_path: Path) -> None:
    for ending in ("svg", "png", "gif", "html"):
        paths = [tmp_path / f"{name}.{ending}" for name in "ab"]
        for path in paths:
            if ending in ("gif", "html"):
                animate(one(sound), path, **SHORT)
            else:
                draw(sound, path)
        assert paths[0].read_bytes() == paths[1].read_bytes()


def test_a_run_without_motions_is_drawn(strategy: Strategy, tmp_path: Path) -> None:
    nothing = Trace(strategy, (), Outcome.SUCCESS)
    assert len(figure(nothing).axes) == 1
    with pytest.raises(InputError, match="no motion to film"):
        animate(nothing, tmp_path / "run.gif")
    assert list(tmp_path.iterdir()) == []


def test_without_a_position_sensor_nothing_is_measured() -> None:
    strategy = plan(named_task("blind-corner"))
    report = run(strategy, control="bias", sensing="noise", options=RunOptions(2))
    assert "measured" not in labels(figure(one(report)))
    assert all(frame.measured is None for frame in frames_of(one(report), FilmOptions()))


# --- films ----------------------------------------------------------------------------------


def test_frames_are_even_and_end_every_motion(sound: Report) -> None:
    trace, options = one(sound), FilmOptions(seconds=4.0, rate=25)
    frames = frames_of(trace, options)
    assert 100 <= len(frames) <= 100 + len(trace.legs)
    times = [frame.time for frame in frames]
    assert times == sorted(times)
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(trace.time)
    assert [frame.ended for frame in frames if frame.ended] == [
        trace.legs[0].ended_by,
        trace.outcome.value,
    ]
    ends = [frame.place for frame in frames if frame.ended]
    assert np.allclose(ends, [leg.places[-1] for leg in trace.legs])
    rho = trace.strategy.task.uncertainty.position
    for frame in frames:
        assert frame.measured is not None
        assert np.hypot(*np.subtract(frame.measured, frame.place)) <= rho + 1e-9


def test_a_gif_moves(sound: Report, tmp_path: Path) -> None:
    path = tmp_path / "run.gif"
    animate(one(sound), path, **SHORT)
    with Image.open(path) as film:
        assert film.size[0] == 200
        assert 5 <= film.n_frames <= 8  # type: ignore[attr-defined]
        first = np.array(film.convert("RGB"))
        film.seek(film.n_frames - 1)  # type: ignore[attr-defined]
        last = np.array(film.convert("RGB"))
    assert np.any(first != last)


def test_the_colours_of_every_motion_are_kept(sound: Report, tmp_path: Path) -> None:
    path, trace = tmp_path / "run.gif", one(sound)
    animate(trace, path, **SHORT)
    frames = frames_of(trace, FilmOptions(**SHORT))  # type: ignore[arg-type]
    pixels = list(animation.pixels_of(trace, frames, FilmOptions(**SHORT)))  # type: ignore[arg-type]
    with Image.open(path) as film:
        for place in (0, len(frames) - 1):
            film.seek(min(place, film.n_frames - 1))  # type: ignore[attr-defined]
            shown = np.array(film.convert("RGB")).astype(int)
            off = np.abs(shown - pixels[place]).max(axis=2)
            assert np.mean(off > 24) < 0.02


def test_braces_in_a_name_are_text(sound: Report, tmp_path: Path) -> None:
    trace = one(sound)
    task = replace(trace.strategy.task, name="{{run}}")
    trace = replace(trace, strategy=replace(trace.strategy, task=task))
    animate(trace, tmp_path / "run.html")
    assert "<title>{{run}}" in (tmp_path / "run.html").read_text(encoding="utf-8")


def test_an_mp4_can_be_played(sound: Report, tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    path = tmp_path / "run.mp4"
    animate(one(sound), path, **SHORT)
    assert path.read_bytes()[4:8] == b"ftyp"


def test_a_page_holds_the_run_and_needs_nothing_else(sound: Report, tmp_path: Path) -> None:
    path, trace = tmp_path / "run.html", one(sound)
    hostile = replace(trace.strategy.task, name="</script><b>x")
    trace = replace(trace, strategy=replace(trace.strategy, task=hostile))
    animate(trace, path)
    text = path.read_text(encoding="utf-8")
    assert text.count("</script>") == 1
    assert "http" not in text.replace("http-equiv", "")
    found = re.search(r"const run = (.*);\n", text)
    assert found is not None
    data = json.loads(found.group(1))
    assert len(data["motions"]) == len(trace.legs)
    assert data["frames"][-1][2:4] == pytest.approx(trace.legs[-1].places[-1].tolist())
    assert data["frames"][-1][6] == trace.outcome.value


def test_of_a_report_the_failure_is_filmed(unsound: Report, tmp_path: Path) -> None:
    path = tmp_path / "run.html"
    animate(unsound, path)
    assert unsound.failure is not None
    assert unsound.failure.outcome.value in path.read_text(encoding="utf-8")


def test_refusals(sound: Report, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("run.avi", "run", "run.png"):
        with pytest.raises(InputError, match=r"must end in \.gif, \.mp4 or \.html"):
            animate(one(sound), tmp_path / name)
    for options in ({"rate": 0}, {"seconds": "long"}, {"width": 5}, {"rest": -1.0}):
        with pytest.raises(InputError, match="film"):
            animate(one(sound), tmp_path / "run.gif", **options)
    assert film_format_of("RUN.HTML") is FilmFormat.HTML
    monkeypatch.setattr(animation, "find_spec", lambda _: None)
    with pytest.raises(UnsupportedError, match="imageio-ffmpeg"):
        animate(one(sound), tmp_path / "run.mp4")
    assert list(tmp_path.iterdir()) == []


def test_a_figure_can_be_written_to_memory(sound: Report) -> None:
    stream = io.BytesIO()
    figure(one(sound)).savefig(stream, format="png")
    assert stream.getvalue().startswith(b"\x89PNG")
