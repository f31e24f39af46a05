"""The planner's options, one record."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from preimage.errors import TaskError
from preimage.geometry.angles import TAU
from preimage.geometry.tolerance import ANGLE
from preimage.task import checks, limits
from preimage.task.degrees import to_degrees, to_radians


class Method(Enum):
    """How a preimage is computed (theory 6)."""

    STICKING = "sticking"
    KERNEL = "kernel"
    COMBINED = "combined"


class StrategyKind(Enum):
    """The kind of strategy that is searched (theory 7)."""

    LINEAR = "linear"
    CONDITIONAL = "conditional"


class Termination(Enum):
    """What a termination condition knows besides the sensors' reading (theory 5)."""

    INSTANTANEOUS = "instantaneous"
    INITIAL_STATE = "initial-state"
    FINAL_STATE = "final-state"


class SearchOrder(Enum):
    """How a linear search goes about its regions."""

    BREADTH_FIRST = "breadth-first"
    BEST_FIRST = "best-first"
    LED = "led"


class Preference(Enum):
    """Which of the plans with the fewest motions is chosen."""

    SHORTEST = "shortest"  # the first one found
    MARGIN = "margin"  # the one with the largest smallest margin


@dataclass(frozen=True, slots=True)
class Continuous:
    """All directions, none left out."""


Directions = tuple[float, ...] | Continuous


def uniform_directions(count: int) -> tuple[float, ...]:
    """`count` directions, evenly spread, the first along +x; radians.

    >>> [round(to_degrees(direction)) for direction in uniform_directions(4)]
    [0, 90, 180, 270]
    """
    return tuple(to_radians(360.0 * index / count) for index in range(count))


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerOptions:
    """What the planner may command, how it looks for a plan, and when it gives up.

    Each field's `metadata` has its unit and the reason for its default.

    Raises
    ------
    TaskError : if an option is out of its range.
    """

    directions: Directions = field(
        default=uniform_directions(8),
        metadata={"unit": "radians", "reason": "axes and diagonals: most walls are across one"},
    )
    method: Method = field(
        default=Method.COMBINED,
        metadata={"unit": "", "reason": "its preimages contain those of the other two"},
    )
    strategy: StrategyKind = field(
        default=StrategyKind.LINEAR,
        metadata={"unit": "", "reason": "a fixed sequence is the easiest to read and to run"},
    )
    termination: Termination = field(
        default=Termination.INSTANTANEOUS,
        metadata={"unit": "", "reason": "needs no forward projection"},
    )
    max_steps: int = field(
        default=8,
        metadata={"unit": "motions", "reason": "longer plans are rarely meant"},
    )
    search: SearchOrder = field(
        default=SearchOrder.BREADTH_FIRST,
        metadata={"unit": "", "reason": "finds a plan with the fewest motions"},
    )
    time_limit: float | None = field(
        default=None,
        metadata={"unit": "seconds", "reason": "the same answer on a slow machine"},
    )
    max_regions: int = field(
        default=10_000,
        metadata={"unit": "regions", "reason": "some 100 MB"},
    )
    arc_tolerance: float = field(
        default=0.005,
        metadata={"unit": "of the arc's radius", "reason": "a tenth of the usual margin"},
    )
    resolution: float = field(
        default=to_radians(0.1),
        metadata={"unit": "radians", "reason": "finer than drives are built"},
    )
    or_fail: bool = field(
        default=False,
        metadata={"unit": "", "reason": "who asks for a guarantee means it"},
    )

    prefer: Preference = field(
        default=Preference.SHORTEST,
        metadata={"unit": "", "reason": "one plan is found sooner than all"},
    )

    def __post_init__(self) -> None:
        """Refuse options that are out of range."""
        for name, kind in (
            ("method", Method),
            ("strategy", StrategyKind),
            ("termination", Termination),
            ("search", SearchOrder),
            ("prefer", Preference),
        ):
            member = checks.choice(getattr(self, name), f"planner.{name}", kind)
            object.__setattr__(self, name, member)
        steps = checks.integer(self.max_steps, "planner.max_steps", limits.STEPS)
        object.__setattr__(self, "max_steps", steps)
        regions = checks.integer(self.max_regions, "planner.max_regions", limits.REGIONS)
        object.__setattr__(self, "max_regions", regions)
        arc = checks.number(self.arc_tolerance, "planner.arc_tolerance", limits.ARC_TOLERANCE)
        object.__setattr__(self, "arc_tolerance", arc)
        finest = checks.angle(self.resolution, "planner.resolution", limits.DIRECTION_RESOLUTION)
        object.__setattr__(self, "resolution", finest)
        or_fail = checks.truth(self.or_fail, "planner.or_fail")
        object.__setattr__(self, "or_fail", or_fail)
        if self.time_limit is not None:
            limit = checks.number(self.time_limit, "planner.time_limit", limits.TIME_LIMIT)
            object.__setattr__(self, "time_limit", limit)
        if not isinstance(self.directions, Continuous):
            object.__setattr__(self, "directions", _normalised(self.directions))


def _normalised(directions: object) -> tuple[float, ...]:
    """The directions in `[0, 2π)`, sorted, each once."""
    key = "planner.directions"
    given = checks.items(directions, key, least=1)
    if len(given) > limits.MAX_DIRECTIONS:
        raise TaskError(key, f"must be {limits.MAX_DIRECTIONS} or fewer, not {len(given)}")
    angles = []
    for index, direction in enumerate(given):
        degrees = to_degrees(checks.angle(direction, f"{key}[{index}]", limits.DIRECTION)) % 360.0
        # A tiny negative angle is rounded to 360.
        angles.append(to_radians(degrees) if degrees < 360.0 else 0.0)
    kept: list[float] = []
    for turn in sorted(angles):
        if not kept or (turn - kept[-1] > ANGLE and turn < kept[0] + TAU - ANGLE):
            kept.append(turn)
    return tuple(kept)
