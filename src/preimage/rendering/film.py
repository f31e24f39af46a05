"""What a film of a run shows: instants at even steps of time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from preimage.errors import InputError, shown
from preimage.execution.trace import Leg, Trace


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmOptions:
    """Options of a film.

    Raises
    ------
    InputError : if an option is out of its range.
    """

    seconds: float = field(
        default=6.0, metadata={"unit": "s", "reason": "short enough to be looked at twice"}
    )
    rate: int = field(
        default=20, metadata={"unit": "frames a second", "reason": "smooth, and small files"}
    )
    rest: float = field(
        default=1.0, metadata={"unit": "s", "reason": "the end is seen before it begins again"}
    )
    width: int = field(
        default=640, metadata={"unit": "dots", "reason": "fits beside a text; of gif and mp4"}
    )

    def __post_init__(self) -> None:
        """Refuse options that are out of range."""
        for name, low, high in (
            ("seconds", 0.1, 600.0), ("rate", 1, 100), ("rest", 0.0, 60.0), ("width", 100, 4000),
        ):  # fmt: skip
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int | float):
                raise InputError(f"film.{name}", f"must be a number, not {shown(value)}")
            if not low <= value <= high:
                rule = f"must be at least {low:g} and at most {high:g}, not {shown(value)}"
                raise InputError(f"film.{name}", rule)


@dataclass(frozen=True, slots=True)
class Frame:
    """One instant.

    Parameters
    ----------
    leg : which motion of the run.
    time : since the run began, in units of length.
    place : of the reference point.
    measured : the position as measured, None without a sensor.
    force : the angle of the force as measured, radians; None where 0 was read.
    ended : in a word, why the motion has just ended; empty while it goes on.
    """

    leg: int
    time: float
    place: tuple[float, float]
    measured: tuple[float, float] | None
    force: float | None
    ended: str = ""


def frames_of(trace: Trace, options: FilmOptions) -> list[Frame]:
    """The frames of a run: evenly over its time, and the end of every motion among them."""
    return list(_frames(trace, options))


def _frames(trace: Trace, options: FilmOptions) -> Iterator[Frame]:
    total = trace.time
    count = max(2, round(options.seconds * options.rate))
    step = total / (count - 1) if total > 0.0 else 1.0
    for number, leg in enumerate(trace.legs):
        begin, end = float(leg.times[0]), float(leg.times[-1])
        first = int(np.ceil(begin / step))
        for tick in range(first, int(np.ceil(end / step))):
            yield _frame(number, leg, max(tick * step, begin))
        last = _frame(number, leg, end)
        words = leg.ended_by if number + 1 < len(trace.legs) else trace.outcome.value
        yield Frame(last.leg, last.time, last.place, last.measured, last.force, words)


def _frame(number: int, leg: Leg, time: float) -> Frame:
    x, y = (float(np.interp(time, leg.times, leg.places[:, axis])) for axis in (0, 1))
    at = int(np.searchsorted(leg.times, time, side="right")) - 1
    at = min(max(at, 0), len(leg.times) - 1)
    # in between, the error is that of the last look
    measured, force = leg.measured[at] - leg.places[at] + (x, y), float(leg.forces[at])
    known = bool(np.all(np.isfinite(measured)))
    return Frame(
        number,
        time,
        (x, y),
        (float(measured[0]), float(measured[1])) if known else None,
        force if np.isfinite(force) else None,
    )
