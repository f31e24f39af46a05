"""Tracks of robots: where each was at which instant, straight and evenly in between."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from preimage import _native
from preimage.configuration.contact import Floats, Ints


@dataclass(frozen=True, slots=True, eq=False)
class Tracks:
    """What was noted of m robots at instants, robot after robot.

    Parameters
    ----------
    start : (m + 1,) the instants of robot i are `start[i] : start[i + 1]`.
    time : (k,) since the motion began, ascending for each robot, in units of length.
    places : (k, 2).
    feature : (k,) what was touched at the instant; `between` on the way to the next one.
    angle : (k,) the actual direction from the instant on.
    measured : (k, 2) the position that was read; NaN where nobody looked or without a sensor.
    force : (k,) the force that was read, an angle; NaN where it was 0 or nobody looked.
    """

    start: NDArray[np.int64]
    time: Floats
    places: Floats
    feature: Ints
    between: Ints
    angle: Floats
    measured: Floats
    force: Floats

    def robot(self, number: int) -> slice:
        """The instants of one robot."""
        return slice(int(self.start[number]), int(self.start[number + 1]))


def first_return(tracks: Tracks, period: float, reach: Floats) -> Floats:
    """The first instant at which a robot is no further than `reach` from where it was before.

    Parameters
    ----------
    period : how long before, in units of length.
    reach : (m,) in the unit of length; negative where no displacement is small enough.

    Returns
    -------
    (m,) times since the motion began, at least `period`; infinite where that never happens.
    """
    found: Floats = _native.first_return(
        tracks.start,
        tracks.time,
        np.ascontiguousarray(tracks.places[:, 0]),
        np.ascontiguousarray(tracks.places[:, 1]),
        period,
        np.ascontiguousarray(reach, dtype=np.float64),
    )
    return found


def where(tracks: Tracks, robots: NDArray[np.intp], time: Floats) -> tuple[Floats, Ints, Ints]:
    """Where robots were at a time within their tracks.

    Returns
    -------
    places : (k, 2).
    feature : (k,) what each touched.
    index : (k,) the last instant that was noted before.
    """
    rank = np.empty(len(robots), dtype=np.int32)
    for count, (robot, when) in enumerate(zip(robots.tolist(), time.tolist(), strict=True)):
        span = tracks.robot(robot)
        rank[count] = span.start + np.searchsorted(tracks.time[span], when, side="right") - 1
        rank[count] = min(max(rank[count], span.start), span.stop - 1)
    following = np.minimum(rank + 1, tracks.start[robots + 1].astype(np.int32) - 1)
    length = tracks.time[following] - tracks.time[rank]
    part = np.where(length > 0.0, (time - tracks.time[rank]) / np.where(length > 0, length, 1), 0.0)
    part = np.clip(part, 0.0, 1.0)
    places = tracks.places[rank] + part[:, None] * (tracks.places[following] - tracks.places[rank])
    inner = (part > 0.0) & (part < 1.0)
    feature = np.where(inner, tracks.between[rank], tracks.feature[rank])
    feature = np.where(part >= 1.0, tracks.feature[following], feature)
    return places, feature.astype(np.int32), rank
