"""The little languages inside SVG: path data, transforms, lengths (SVG 1.1, 7.6 and 8.3)."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from preimage.errors import InputError, shown
from preimage.geometry.curves import Arc, Bezier, Curve, Floats

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_COMMAND = re.compile(r"\s*,?\s*([MmZzLlHhVvCcSsQqTtAa])")
_GAP = re.compile(r"\s*,?\s*")
_FLAG = re.compile(r"[01]")
_TRANSFORM = re.compile(r"\s*,?\s*(matrix|translate|scale|rotate|skewX|skewY)\s*\(([^()]*)\)")
_LENGTH = re.compile(rf"\s*({_NUMBER.pattern})\s*([a-zA-Z%]*)\s*")

_ARITY = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}

MAX_STEPS = 1_000_000
"""Steps of a path: as many as a task may have vertices."""

PIXELS = {
    "": 1.0,
    "px": 1.0,
    "mm": 96 / 25.4,
    "cm": 96 / 2.54,
    "in": 96.0,
    "pt": 96 / 72,
    "pc": 16.0,
}
"""User units of lengths with a unit: CSS has 96 to an inch."""


class Course(NamedTuple):
    """A subpath: curves that follow each other, and whether it is closed."""

    curves: tuple[Curve, ...]
    closed: bool


def courses(data: str) -> list[Course]:
    """The subpaths of path data; those of a point alone are left out.

    Raises
    ------
    InputError : anything that is no path data: nothing is drawn up to the first error.

    >>> (square,) = courses("m 1 1 h2 v2 h-2 z")
    >>> square.closed, [curve.end.tolist() for curve in square.curves]
    (True, [[3.0, 1.0], [3.0, 3.0], [1.0, 3.0], [1.0, 1.0]])
    """
    pen = _Pen()
    for command, numbers in _commands(data):
        pen.draw(command, numbers)
    pen.lift(closed=False)
    return pen.found


class _Pen:
    """Where a path has come to."""

    def __init__(self) -> None:
        self.found: list[Course] = []
        self._curves: list[Curve] = []
        self._start = np.zeros(2)
        self._at = np.zeros(2)
        self._handle = np.zeros(2)  # the control point that S and T mirror
        self._last = ""

    def draw(self, command: str, numbers: Sequence[float]) -> None:
        """One step, of a command with its numbers."""
        kind = command.upper()
        base = self._at if command.islower() else np.zeros(2)
        if kind == "Z":
            self._close()
        elif kind == "M":
            self.lift(closed=False)
            self._start = self._at = np.array(numbers) + base
        elif kind == "A":
            end = np.array(numbers[5:]) + base
            arc = _arc(self._at, end, numbers[:5])
            if arc is not None:
                self._curves.append(arc)
            self._at = end
        else:
            self._bend(kind, self._control(kind, np.array(numbers), base))
        self._last = kind

    def lift(self, closed: bool) -> None:
        """The end of a subpath."""
        if self._curves:
            self.found.append(Course(tuple(self._curves), closed))
        self._curves = []

    def _close(self) -> None:
        if np.any(self._at != self._start):
            self._curves.append(Bezier(np.stack((self._at, self._start))))
        self._at = self._start
        self.lift(closed=True)

    def _control(self, kind: str, numbers: Floats, base: Floats) -> Floats:
        """The control points after the first one."""
        if kind == "H":
            return np.array([[numbers[0] + base[0], self._at[1]]])
        if kind == "V":
            return np.array([[self._at[0], numbers[0] + base[1]]])
        points: Floats = numbers.reshape(-1, 2) + base
        if kind in "ST":
            mirrored = self._last in ("CS" if kind == "S" else "QT")
            handle = 2.0 * self._at - self._handle if mirrored else self._at
            points = np.concatenate((handle[None], points))
        return points

    def _bend(self, kind: str, points: Floats) -> None:
        if np.any(points != self._at):
            self._curves.append(Bezier(np.concatenate((self._at[None], points))))
        self._handle = points[-2] if kind in "CSQT" else points[-1]
        self._at = points[-1]


def _commands(data: str) -> list[tuple[str, list[float]]]:
    """The steps of path data, each with its command, also where that is not repeated."""
    found: list[tuple[str, list[float]]] = []
    place = 0
    data = data.strip()
    while place < len(data):
        match = _COMMAND.match(data, place)
        if match is None or (not found and match[1] not in "Mm"):
            raise InputError("d", f"is no path data at {shown(data[place : place + 20])}")
        command, place = match[1], match.end()
        count = _ARITY[command.upper()]
        if not count:
            found.append((command, []))
            continue
        while True:
            if len(found) >= MAX_STEPS:
                raise InputError("d", f"must have {MAX_STEPS} steps or fewer")
            numbers, place = _numbers(data, place, count, command in "Aa")
            found.append((command, numbers))
            command = {"M": "L", "m": "l"}.get(command, command)
            gap = _GAP.match(data, place)
            if gap is None or not _NUMBER.match(data, gap.end()):
                break
    return found


def _numbers(data: str, place: int, count: int, arc: bool) -> tuple[list[float], int]:
    """So many numbers from a place on; of an arc the fourth and fifth are flags of one digit."""
    numbers: list[float] = []
    while len(numbers) < count:
        gap = _GAP.match(data, place)
        place = gap.end() if gap else place
        match = (_FLAG if arc and len(numbers) in (3, 4) else _NUMBER).match(data, place)
        if match is None:
            raise InputError("d", f"must have a number at {shown(data[place : place + 20])}")
        numbers.append(float(match[0]))
        place = match.end()
    return numbers, place


def _arc(start: Floats, end: Floats, shape: Sequence[float]) -> Curve | None:
    """The arc of an ellipse between two points (SVG 1.1, F.6.5); nothing if they are the same."""
    rx, ry, turn, large, sweep = shape
    rx, ry = abs(rx), abs(ry)
    if np.all(start == end):
        return None
    if rx == 0.0 or ry == 0.0:
        return Bezier(np.stack((start, end)))
    cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    axes = np.array([[cosine, sine], [-sine, cosine]])  # rows: the directions of the axes
    x, y = axes @ (0.5 * (start - end))
    size = (x / rx) ** 2 + (y / ry) ** 2
    if size > 1.0:
        rx, ry = rx * math.sqrt(size), ry * math.sqrt(size)
    away = math.sqrt(max(1.0 / size - 1.0, 0.0)) if size < 1.0 else 0.0
    if large == sweep:
        away = -away
    middle = away * np.array([rx * y / ry, -ry * x / rx])
    center = axes.T @ middle + 0.5 * (start + end)
    first = math.atan2((y - middle[1]) / ry, (x - middle[0]) / rx)
    last = math.atan2((-y - middle[1]) / ry, (-x - middle[0]) / rx)
    angle = (last - first) % math.tau
    if not sweep:
        angle -= math.tau
    return Arc(center, rx * axes[0], ry * axes[1], first, angle)


def matrix_of(text: str) -> Floats:
    """The `(2, 3)` matrix of a list of transforms.

    >>> matrix_of("translate(5) scale(2,3)").tolist()
    [[2.0, 0.0, 5.0], [0.0, 3.0, 0.0]]
    """
    matrix = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    place = 0
    while text[place:].strip(" \t\r\n,"):
        match = _TRANSFORM.match(text, place)
        numbers = _NUMBER.findall(match[2]) if match else []
        if match is None or _NUMBER.sub("", match[2]).strip(" \t\r\n,"):
            raise InputError("transform", f"is none at {shown(text[place : place + 20])}")
        values = [float(number) for number in numbers]
        if not all(map(math.isfinite, values)):
            raise InputError("transform", f"has a number that is too large: {shown(match[2])}")
        matrix = composed(matrix, _single(match[1], values))
        place = match.end()
    return matrix


def _single(kind: str, values: list[float]) -> Floats:
    least, most = {"matrix": (6, 6), "translate": (1, 2), "scale": (1, 2), "rotate": (1, 3)}.get(
        kind, (1, 1)
    )
    if not least <= len(values) <= most or (kind == "rotate" and len(values) == 2):
        raise InputError("transform", f"{kind} has {len(values)} numbers")
    if kind == "matrix":
        return np.array(values).reshape(3, 2).T
    if kind == "translate":
        return np.array([[1.0, 0.0, values[0]], [0.0, 1.0, values[1] if len(values) > 1 else 0.0]])
    if kind == "scale":
        return np.array([[values[0], 0.0, 0.0], [0.0, values[-1], 0.0]])
    turn = math.radians(values[0])
    if kind == "skewX":
        return np.array([[1.0, math.tan(turn), 0.0], [0.0, 1.0, 0.0]])
    if kind == "skewY":
        return np.array([[1.0, 0.0, 0.0], [math.tan(turn), 1.0, 0.0]])
    linear = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    middle = np.array(values[1:] or [0.0, 0.0])
    return np.column_stack((linear, middle - linear @ middle))


def composed(outer: Floats, inner: Floats) -> Floats:
    """First the inner matrix, then the outer one."""
    linear = outer[:, :2] @ inner[:, :2]
    return np.column_stack((linear, outer[:, :2] @ inner[:, 2] + outer[:, 2]))


def length_of(text: str, key: str) -> float:
    """A length in user units.

    >>> length_of("1in", "width")
    96.0
    """
    match = _LENGTH.fullmatch(text)
    if match is None or match[2].lower() not in PIXELS or math.isinf(float(match[1])):
        raise InputError(
            key, f"must be a length in user units, mm, cm, in, pt or pc, not {shown(text)}"
        )
    return float(match[1]) * PIXELS[match[2].lower()]


def points_of(text: str) -> Floats:
    """`(n, 2)` of a list of points."""
    numbers = [float(number) for number in _NUMBER.findall(text)]
    if _NUMBER.sub("", text).strip(" \t\r\n,") or len(numbers) % 2:
        raise InputError("points", f"must be pairs of numbers, not {shown(text)}")
    return np.array(numbers).reshape(-1, 2)
