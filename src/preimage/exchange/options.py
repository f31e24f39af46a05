"""What a drawing does not say: how to read it, and what the task needs besides."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import MappingProxyType

from preimage.errors import InputError, shown
from preimage.exchange.drawing import Role
from preimage.geometry.outlines import Fill
from preimage.task import checks
from preimage.task.goal import Goal
from preimage.task.initial import Initial
from preimage.task.workspace import Side, SolidSide, Window


class DrawingFormat(Enum):
    """A kind of file that tasks are made of."""

    MAP = "map"
    DXF = "dxf"
    SVG = "svg"
    WKT = "wkt"
    GEOJSON = "geojson"


ENDINGS: Mapping[DrawingFormat, tuple[str, ...]] = MappingProxyType(
    {
        DrawingFormat.MAP: (".yaml", ".yml"),
        DrawingFormat.DXF: (".dxf",),
        DrawingFormat.SVG: (".svg",),
        DrawingFormat.WKT: (".wkt", ".txt"),
        DrawingFormat.GEOJSON: (".geojson", ".json"),
    }
)
"""The endings of their files."""


class Unknown(Enum):
    """What cells of a map are that nobody has seen."""

    OCCUPIED = "occupied"
    FREE = "free"


class Nested(Enum):
    """What a closed outline inside another one of the same layer is, if both are obstacles."""

    SOLID = "solid"
    """Solid too, so it does not matter."""
    HOLE = "hole"
    """A hole, and one within that solid again, and so on."""

    @property
    def fill(self) -> Fill | None:
        """The rule for a whole layer, if there is one."""
        return Fill.EVEN_ODD if self is Nested.HOLE else None


CONTROL, FORCE_ANGLE, THRESHOLD, FRICTION = (
    math.radians(5),
    math.radians(10),
    0.05,
    math.radians(20),
)
"""The bounds of a task whose drawing says nothing, as in the paper's examples."""

POSITION = 200
"""The position error is then the window's larger side by this, to one digit."""

CURVES = 1000
"""Curves are met to the drawing's larger side by this, to one digit, if nothing is said."""

JOIN = 1e-6
"""Ends of lines closer than this part of the drawing's larger side meet, if nothing is said."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportOptions:
    """How a drawing is read, and what the task gets that is not drawn. Angles are radians.

    Parameters
    ----------
    format : of the file; by its ending if it is not given.
    layers : further names of layers, ids and properties, in any case, and what they mean.
    units : a unit of length; coordinates are scaled to it from that of the file.
    curves : how far borders may be from curves, a length; `None` for a 1000th of the drawing.
    join : ends of lines that are so near to each other meet; `None` for a 10⁻⁶ part of the drawing.
    chains : the solid side of open lines that are obstacles; `None` refuses them.
    thickness : open lines that are obstacles become walls so thick, with round ends; or `None`.
    nested : what outlines inside each other are.
    snap : how far the ends of goal edges may be moved onto contact space.
    unknown : what unseen cells of a map are.
    simplify : how far the border of a map's cells may be moved outward; `None` for one cell.
    robot_radius : of a robot that is a disc; 0 for a point, or for the robot that is drawn.
    initial : the start, if it is not drawn.
    goal : goals besides those that are drawn.
    window : `xmin, ymin, xmax, ymax`, if neither the drawing nor what is in it shall say.
    walls : sides of the window that are walls.
    control, position, force_angle, threshold : see `Uncertainty`; an infinite position or
        threshold means no such sensor; `None` for a 200th of the window.
    friction : half-angle of the friction cone.
    """

    format: DrawingFormat | None = None
    layers: Mapping[str, Role] = field(default_factory=dict)
    units: str | None = None
    curves: float | None = None
    join: float | None = None
    chains: SolidSide | None = None
    thickness: float | None = None
    nested: Nested = Nested.SOLID
    snap: float = 0.0
    unknown: Unknown = Unknown.OCCUPIED
    simplify: float | None = None
    robot_radius: float = 0.0
    initial: Initial | None = None
    goal: Goal | None = None
    window: tuple[float, float, float, float] | None = None
    walls: frozenset[Side] = frozenset()
    control: float = CONTROL
    position: float | None = None
    force_angle: float = FORCE_ANGLE
    threshold: float = THRESHOLD
    friction: float = FRICTION

    def __post_init__(self) -> None:
        """Refuse what is not among the choices, and lengths that are none.

        Choices may be words. The task's own values are refused by the task.
        """
        object.__setattr__(self, "nested", checks.choice(self.nested, "nested", Nested))
        object.__setattr__(self, "unknown", checks.choice(self.unknown, "unknown", Unknown))
        if self.format is not None:
            kind_of_file = checks.choice(self.format, "format", DrawingFormat)
            object.__setattr__(self, "format", kind_of_file)
        if self.chains is not None:
            object.__setattr__(self, "chains", checks.choice(self.chains, "chains", SolidSide))
        if self.window is not None:
            if len(checks.items(self.window, "window")) != 4:
                raise InputError("window", f"must be 4 numbers, not {len(self.window)}")
            object.__setattr__(self, "window", Window(*self.window).bounds)
        for key, least in (
            ("curves", "above 0"),
            ("thickness", "above 0"),
            ("join", "0 or more"),
            ("snap", "0 or more"),
            ("simplify", "0 or more"),
            ("robot_radius", "0 or more"),
        ):
            value = getattr(self, key)
            if value is None:
                continue
            number = isinstance(value, int | float) and not isinstance(value, bool)
            if not number or not (0.0 < value < 1e9 or (value == 0.0 and least != "above 0")):
                raise InputError(key, f"must be a length {least}, not {shown(value)}")
        layers = {
            name.strip().casefold(): checks.choice(role, f"layers[{name!r}]", Role)
            for name, role in self.layers.items()
        }
        object.__setattr__(self, "layers", layers)


def one_digit(value: float) -> float:
    """A number to its first digit, downward.

    >>> one_digit(0.0123), one_digit(97.0)
    (0.01, 90.0)
    """
    exponent = math.floor(math.log10(value))
    digit = math.floor(value / 10.0**exponent + 1e-9)
    return float(f"{digit}e{exponent}")
