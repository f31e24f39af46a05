"""The reading condition compiled: what may be read, cut into cells of equal answer (theory 5)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from preimage import _native
from preimage.configuration.contact import Bools, Floats, Ints
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.border import stored_segments
from preimage.recognition.outside import Outside, contact_segments
from preimage.recognition.readings import Readings
from preimage.recognition.segments import Segments, together

FEW = 16
"""Cells with no more segments to look at are not cut: looking at one takes some 10 ns."""

MOST = (1 << 16, 128)
"""Cutting ends with so many numbers kept, and so many more for every segment."""


class Part(IntEnum):
    """What a segment does for the condition; the native side reads these numbers."""

    CONTACT = 0
    BORDER = 1


@dataclass(frozen=True, slots=True, eq=False)
class ReadingTable:
    """The plain definition of a reading condition, as flat tables: what a compiled one is made of.

    A reading misses the set iff no segment whose kind reads the force is nearer to q than `reach`,
    and, where none is felt, q is not inside the area that the border segments bound.

    Parameters
    ----------
    zero : (m,) by kind, whether 0 is read.
    center, half : (m,) by kind, the directions that are read, tolerance included, radians; `half`
        is -1 where none is.
    segments : (k, 4) from and to.
    kind : (k,) which kind each is of.
    parts : (k,) `Part`.
    reach : a length; infinite without a position sensor.
    """

    zero: Bools
    center: Floats
    half: Floats
    segments: Floats
    kind: Ints
    parts: NDArray[np.uint8]
    reach: float


@dataclass(frozen=True, slots=True, eq=False)
class ReadingCells:
    """Whether `K_v(q, f)` misses a set, by point location: a quadtree over q, its leaves over f.

    A leaf knows the forces that are read all over it, as sorted intervals, and the few segments
    whose distance from q decides about others. So an answer takes O(log n), but where many
    segments are equally far from one place, and equals that of the plain definition to the last
    bit (`recognition.interpretation.contained`), at least on machines whose GEOS does not contract.
    """

    table: ReadingTable
    _cells: _native.Cells

    def misses(self, x: float, y: float, force: float | None) -> bool:
        """Whether no configuration of the set gives this reading.

        False, the safe side of a condition, where the place is NaN though it is measured, or the
        force infinite.

        Parameters
        ----------
        x, y : q, as measured; ignored without a position sensor.
        force : its angle, radians; None or NaN where 0 is read.
        """
        return self._cells.misses(x, y, math.nan if force is None else force)

    def misses_all(self, positions: Floats, forces: Floats) -> Bools:
        """The same for (k, 2) positions and (k,) forces, NaN where 0 is read."""
        places = np.asarray(positions, dtype=np.float64).reshape(-1, 2)
        x, y = (np.ascontiguousarray(places[:, axis]) for axis in (0, 1))
        told = np.ascontiguousarray(np.broadcast_to(forces, len(x)), dtype=np.float64)
        return self._cells.misses_all(x, y, told).view(np.bool_)

    @property
    def leaves(self) -> int:
        """How many cells there are."""
        return self._cells.leaves

    @property
    def most_looked_at(self) -> int:
        """The most segments that a reading may have to be compared with."""
        return self._cells.most

    @property
    def memory(self) -> int:
        """What they take, in bytes."""
        return self._cells.bytes


def reading_cells(
    space: ConfigurationSpace, readings: Readings, rest: Outside, radius: float
) -> ReadingCells:
    """The condition that `K_v(q, f)` misses `rest`, compiled.

    With `rest = outside(space, T, Delta)` it is the termination condition of T (theory 5); with a
    set that certainly holds the robot, what it misses contradicts the model.

    Parameters
    ----------
    radius : rho; infinite without a position sensor; 0 counts as the tolerance.

    Raises
    ------
    ValueError : if the radius is negative or NaN.
    """
    if not radius >= 0.0:
        raise ValueError(f"radius is {radius}, must not be negative")
    margin = space.tolerance.length
    reach = max(radius, margin) + 0.5 * margin
    segments, parts = _parts(space, readings, rest)
    zero, center, half, kind = _sets(readings, segments.feature)
    ends = np.concatenate((segments.starts, segments.ends), axis=1)
    table = ReadingTable(zero, center, half, ends, kind, parts, reach)
    cells = _native.cut_into_cells(
        zero.view(np.uint8),
        center,
        half,
        ends.ravel(),
        kind,
        parts,
        reach,
        space.tolerance.grid + 16.0 * math.ulp(reach),
        FEW,
        MOST[0] + MOST[1] * len(segments),
    )
    return ReadingCells(table, cells)


def _parts(
    space: ConfigurationSpace, readings: Readings, rest: Outside
) -> tuple[Segments, NDArray[np.uint8]]:
    """What is to be looked at, and what each segment is."""
    told = contact_segments(space.contact, rest.contact)
    told = told.part(readings.zero[told.feature] | (readings.half[told.feature] >= 0.0))
    starts, ends = stored_segments(rest.area)
    rim = Segments(starts, ends, np.full(len(starts), readings.free, dtype=np.int32))
    kinds = np.array([Part.CONTACT, Part.BORDER], dtype=np.uint8)
    return together(told, rim), np.repeat(kinds, [len(told), len(rim)])


def _sets(readings: Readings, features: Ints) -> tuple[Bools, Floats, Floats, Ints]:
    """The reading sets of features, each once, with the tolerance, and which feature has which."""
    zero, half = readings.zero[features], readings.half[features]
    felt = half >= 0.0
    half = np.where(felt, half + readings.tolerance, -1.0)
    rows = np.stack((zero, np.where(felt, readings.center[features], 0.0), half), axis=1)
    different, kind = np.unique(rows, axis=0, return_inverse=True)
    zero, center, half = (np.ascontiguousarray(column) for column in different.T)
    return zero != 0.0, center, half, kind.reshape(-1).astype(np.int32)
