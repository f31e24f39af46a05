"""Films of runs: GIF and MP4 frame by frame, HTML as a page that plays by itself."""

from __future__ import annotations

import importlib
import io
import math
import os
import subprocess
from collections.abc import Iterator, Sequence
from enum import Enum
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from preimage.errors import InputError, UnsupportedError, shown
from preimage.execution.report import Report
from preimage.execution.trace import Trace
from preimage.rendering.film import FilmOptions, Frame, frames_of
from preimage.rendering.page import page
from preimage.rendering.picture import settings
from preimage.whole_file import write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Pixels = NDArray[np.uint8]
Floats = NDArray[np.float64]


class FilmFormat(Enum):
    """What a film is written as, by the ending of its file."""

    GIF = "gif"
    MP4 = "mp4"
    HTML = "html"


COLORS = 128
"""Colours of a GIF: enough for flat pictures, and smaller than with 256."""

MOST_ENDS = 12
"""So many frames are looked at for them."""


def film_format_of(path: str | os.PathLike[str]) -> FilmFormat:
    """The format of a film, by its file's ending.

    Raises
    ------
    InputError : no film has this ending.
    UnsupportedError : it is an mp4, and there is nothing to encode it with.

    >>> film_format_of("run.GIF")
    <FilmFormat.GIF: 'gif'>
    """
    ending = Path(path).suffix
    try:
        kind = FilmFormat(ending.lower().removeprefix("."))
    except ValueError:
        rule = f"must end in .gif, .mp4 or .html, not in {shown(ending) if ending else 'nothing'}"
        raise InputError(str(path), rule) from None
    if kind is FilmFormat.MP4 and find_spec("imageio_ffmpeg") is None:
        rule = "needs imageio-ffmpeg, which is not installed: pip install 'preimage[animate]'"
        raise UnsupportedError(str(path), rule)
    return kind


def animate(subject: Trace | Report, path: str | os.PathLike[str], **options: Any) -> None:
    """Write a film of a run; the whole file or nothing.

    The robot moves through its scene, with its position as measured and the error's disc, and the
    force as measured; each motion shows its preimage, its target and its command. Of a report, the
    first run that failed is filmed, else the one that took longest. The same run gives the same
    bytes, but for an mp4 that another encoder makes.

    Parameters
    ----------
    path : ending in .gif, .mp4 or .html; a page needs nothing but a browser.
    options : fields of `FilmOptions`.

    Raises
    ------
    InputError : an unknown ending, an option out of its range, or nothing to film.
    UnsupportedError : matplotlib, or for an mp4 imageio-ffmpeg, is not installed.
    OSError : the file cannot be written.
    """
    kind, chosen = film_format_of(path), FilmOptions(**options)
    trace = (subject.failure or subject.slowest) if isinstance(subject, Report) else subject
    if trace is None or not trace.legs:
        raise InputError(str(path), "there is no motion to film")
    frames = frames_of(trace, chosen)
    content = {
        FilmFormat.GIF: _gif,
        FilmFormat.MP4: _mp4,
        FilmFormat.HTML: lambda *film: page(*film).encode("utf-8"),
    }[kind](trace, frames, chosen)
    write_whole(Path(path), content)


def _gif(trace: Trace, frames: list[Frame], options: FilmOptions) -> bytes:
    image = importlib.import_module("PIL.Image")
    pictures = [image.fromarray(pixels) for pixels in pixels_of(trace, frames, options)]
    extract = image.fromarray(_extract(frames, pictures))
    palette = extract.quantize(COLORS)
    flat = [picture.quantize(palette=palette, dither=0) for picture in pictures]
    stay = [1000.0 / options.rate] * (len(flat) - 1) + [1000.0 * max(options.rest, 0.1)]
    stream = io.BytesIO()
    flat[0].save(
        stream, format="GIF", save_all=True, append_images=flat[1:], loop=0,
        duration=[round(time) for time in stay],
    )  # fmt: skip
    return stream.getvalue()


def _extract(frames: list[Frame], pictures: Sequence[Any]) -> Pixels:
    """The ends of all motions below each other: every colour of the film is in them."""
    ends = [place for place, frame in enumerate(frames) if frame.ended]
    some = ends[:: max(1, -(-len(ends) // MOST_ENDS))]
    return np.concatenate([np.asarray(pictures[place]) for place in sorted({*some, ends[-1]})])


def _mp4(trace: Trace, frames: list[Frame], options: FilmOptions) -> bytes:
    import tempfile

    encoder = importlib.import_module("imageio_ffmpeg").get_ffmpeg_exe()
    pictures = list(pixels_of(trace, frames, options))
    pictures += pictures[-1:] * round(options.rest * options.rate)
    high, wide, _ = pictures[0].shape
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "film.mp4"
        command = [
            encoder, "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
            "-s", f"{wide}x{high}", "-r", str(options.rate), "-i", "-", "-pix_fmt", "yuv420p",
            "-movflags", "+faststart", "-fflags", "+bitexact", "-flags:v", "+bitexact", str(made),
        ]  # fmt: skip
        done = subprocess.run(
            command, input=b"".join(p.tobytes() for p in pictures), capture_output=True, check=False
        )
        if done.returncode or not made.exists():
            words = done.stderr.decode(errors="replace").strip().splitlines()
            raise UnsupportedError("film", f"cannot be encoded: {words[-1] if words else 'ffmpeg'}")
        return made.read_bytes()


# --- pictures ---------------------------------------------------------------------------------


def pixels_of(trace: Trace, frames: list[Frame], options: FilmOptions) -> Iterator[Pixels]:
    """(h, w, 3) the picture of every frame, all of one size, even in both directions."""
    with settings():
        from preimage.rendering.trace import film_figure

        leg, figure, moving = -1, None, None
        size: tuple[int, int] | None = None
        for frame in frames:
            if frame.leg != leg or figure is None or moving is None:
                leg = frame.leg
                figure = film_figure(trace, leg)
                figure.set_dpi(options.width / figure.get_figwidth())
                moving = _Moving(figure, trace)
            pixels = moving.pixels(frame)
            size = size or (pixels.shape[0] & ~1, pixels.shape[1] & ~1)
            yield _fitted(pixels, *size)


def _fitted(pixels: Pixels, high: int, wide: int) -> Pixels:
    """The picture cut, or filled up with white, to a size."""
    fitted = np.full((high, wide, 3), 255, dtype=np.uint8)
    h, w = min(high, pixels.shape[0]), min(wide, pixels.shape[1])
    fitted[:h, :w] = pixels[:h, :w]
    return fitted


class _Moving:
    """What moves in a figure, drawn on what does not."""

    def __init__(self, figure: Figure, trace: Trace) -> None:
        from matplotlib.lines import Line2D
        from matplotlib.patches import Circle, Polygon
        from matplotlib.text import Text

        from preimage.rendering.style import BLUE, INK, ORANGE, PAPER, VERMILLION

        self.axes = figure.axes[0]
        self.canvas = cast(Any, figure.canvas)  # of Agg, whose methods matplotlib leaves untyped
        task = trace.strategy.task
        xmin, xmax = self.axes.get_xlim()
        self.unit = (xmax - xmin) / (72.0 * figure.get_figwidth() * self.axes.get_position().width)
        self.error = task.uncertainty.position if math.isfinite(task.uncertainty.position) else 0.0
        self.shape = None if task.robot.is_point else np.asarray(task.robot.shape)
        self.body = Polygon(
            np.zeros((3, 2)), facecolor=(1.0, 1.0, 1.0, 0.55), edgecolor=INK, lw=1.2, zorder=8.6
        )
        self.dot = Circle((0, 0), 3.2 * self.unit, facecolor=INK, edgecolor=PAPER, lw=0.6, zorder=9)
        self.disc = Circle(
            (0, 0), max(self.error, 2.5 * self.unit), facecolor=(0.9, 0.6, 0.0, 0.15),
            edgecolor=ORANGE, lw=0.9, linestyle=(0.0, (1.0, 1.6)), zorder=8.4,
        )  # fmt: skip
        self.push = Polygon(np.zeros((3, 2)), facecolor=VERMILLION, lw=0.0, zorder=8.8)
        failed = not trace.outcome.as_planned
        self.words = Text(
            0.99, 0.015, "", transform=self.axes.transAxes, ha="right", va="bottom", fontsize=9.5,
            color=VERMILLION if failed else INK, zorder=10.0,
        )  # fmt: skip
        self.words.set_bbox({"facecolor": PAPER, "alpha": 0.85, "edgecolor": "none", "pad": 1.5})
        self.way = Line2D([], [], color=VERMILLION if failed else BLUE, lw=1.4, zorder=8.2)
        self.passed: list[Floats] = []
        self.parts = [self.way, self.body, self.disc, self.dot, self.push, self.words]
        for part in self.parts:
            part.set_animated(True)
            self.axes.add_artist(part)
        self.canvas.draw()
        self.ground = self.canvas.copy_from_bbox(figure.bbox)

    def pixels(self, frame: Frame) -> Pixels:
        """(h, w, 3) the picture of a frame."""
        from preimage.rendering.glyphs import arrow

        place = np.array(frame.place)
        self.passed.append(place)
        self.way.set_data(np.array(self.passed).T)
        self.dot.set_center(frame.place)
        self.body.set_visible(self.shape is not None)
        if self.shape is not None:
            self.body.set_xy(self.shape + place)
        self.disc.set_visible(frame.measured is not None)
        if frame.measured is not None:
            self.disc.set_center(frame.measured)
        self.push.set_visible(frame.force is not None)
        if frame.force is not None:
            along = np.array((math.cos(frame.force), math.sin(frame.force)))
            head = (6.0 * self.unit, 2.2 * self.unit)
            outline = arrow(place - 26.0 * self.unit * along, place, head, 1.3 * self.unit)
            self.push.set_xy(outline)
        ended = f"  {frame.ended}" if frame.ended else ""
        self.words.set_text(f"t = {frame.time:.1f}{ended}")
        canvas = self.canvas
        canvas.restore_region(self.ground)
        for part in self.parts:
            self.axes.draw_artist(part)
        return np.array(canvas.buffer_rgba())[:, :, :3]
