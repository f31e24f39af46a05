"""What may be varied of a task: the bounds on errors, friction, and its named numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from preimage.errors import InputError, TaskError, shown
from preimage.task import checks
from preimage.task.degrees import to_degrees, to_radians
from preimage.task.limits import CONTROL, FORCE_ANGLE, FRICTION
from preimage.task.options import PlannerOptions
from preimage.task.task import Task
from preimage.task.template import Template
from preimage.task.uncertainty import Uncertainty

FINEST = 100.0
"""A bound is found to this part of its given value, unless another resolution is asked for."""

COARSEST = 1000.0
"""And to this part of the range that is looked at, where 0 or nothing is given."""

MOST_STEPS = 1_000_000
"""Steps of an axis."""

NEAR = 1e-9
"""Of a step, this is rounding."""

NEARLY = 89.0
"""Degrees: as wide a control cone, and as much friction, as is looked at."""

LOUDEST = 1.0
"""No reaction to the commanded speed of 1 is stronger: higher thresholds hear nothing."""


class Bound(Enum):
    """The bounds that every task has."""

    CONTROL = "control"
    POSITION = "position"
    FORCE = "force"
    THRESHOLD = "threshold"
    FRICTION = "friction"


KEYS: dict[Bound, str] = {
    Bound.CONTROL: "uncertainty.control",
    Bound.POSITION: "uncertainty.position",
    Bound.FORCE: "uncertainty.force.angle",
    Bound.THRESHOLD: "uncertainty.force.threshold",
    Bound.FRICTION: "friction",
}
"""Where each bound stands in a task file."""

MONOTONE = frozenset({Bound.CONTROL, Bound.POSITION, Bound.FORCE})
"""More of these allows nature more and forbids it nothing: plans can only be lost (theory 8)."""


@dataclass(frozen=True, slots=True)
class Axis:
    """One number of a task, and the values of it that are looked at.

    The values are `low`, `low + step`, … `low + steps * step`, all decimal numbers.

    Parameters
    ----------
    name : the word by which it is asked for.
    key : its place in the task file.
    unit : degrees, or nothing for a length or a plain number.
    given : its value in the task, in the file's unit; infinite without a position sensor.
    low, step : in the file's unit.
    steps : how many.
    monotone : whether more of it can only lose plans; else it is sampled.
    """

    name: str
    key: str
    unit: str
    given: float
    low: float
    step: float
    steps: int
    monotone: bool

    def value(self, place: int) -> float:
        """The value at a place, 0 to `steps`.

        >>> Axis("friction", "friction", "degrees", 20, 0.0, 0.1, 890, False).value(3)
        0.3
        """
        digits = max(0, 4 - _exponent(self.step))
        return round(self.low + place * self.step, digits)

    @property
    def high(self) -> float:
        """The last value."""
        return self.value(self.steps)

    @property
    def values(self) -> tuple[float, ...]:
        """All values, ascending."""
        return tuple(self.value(place) for place in range(self.steps + 1))


Range = tuple[float, float]


def axis_of(
    template: Template,
    name: str,
    within: Range | None = None,
    resolution: float | None = None,
    places: int | None = None,
) -> Axis:
    """The axis of a bound, or of a parameter of the task.

    Parameters
    ----------
    name : of `Bound`, or a parameter; `parameters.NAME` where that is a bound's name too.
    within : the range that is looked at, in the file's unit. By default errors from 0 to all that
        makes a difference, parameters from 0 to twice what is given.
    resolution : the step, in the file's unit; rounded down to 1, 2 or 5 times a power of ten.
    places : so many values, evenly spread over the range, ends included, instead.

    Raises
    ------
    InputError : there is no such number in the task, or it cannot be varied like that.
    """
    task = template.task()
    bound = next((one for one in Bound if one.value == name), None)
    parameter = name.removeprefix("parameters.")
    if bound is None and parameter not in template.parameters:
        known = [*(one.value for one in Bound), *template.parameters]
        raise InputError("bound", f"{shown(name)} is none{checks.suggestion(name, known)}")
    if bound is None:
        given, most, key, unit = template.parameters[parameter], math.inf, "", ""
        key = f"parameters.{parameter}"
        natural = (min(0.0, 2.0 * given), max(0.0, 2.0 * given))
    else:
        key, unit = KEYS[bound], "" if bound in (Bound.POSITION, Bound.THRESHOLD) else "degrees"
        given = _given(task, bound)
        most = _most(task, bound)
        natural = (0.0, most)
    low, high = within or natural
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        rule = f"range must be two numbers that rise, not {low:g} to {high:g}"
        raise InputError(name, rule)
    if bound is not None and (low < 0.0 or high > most):
        raise InputError(name, f"range must lie within 0 to {most:g}, not {low:g} to {high:g}")
    monotone = bound in MONOTONE
    if places is not None:
        return Axis(name, key, unit, given, low, (high - low) / (places - 1), places - 1, monotone)
    if resolution is None:
        resolution = (high - low) / COARSEST
        if 0.0 < abs(given) < math.inf:
            resolution = min(resolution, abs(given) / FINEST)
    elif not 0.0 < resolution < math.inf:
        raise InputError(name, f"resolution must be above 0, not {resolution:g}")
    finest, coarsest = 2.0 * (high - low) / MOST_STEPS, 0.5 * (high - low)
    step = _round_number(min(max(resolution, finest), coarsest))
    low = math.ceil(low / step - NEAR) * step
    steps = math.floor((high - low) / step + NEAR)
    return Axis(name, key, unit, given, low, step, steps, monotone)


def task_at(template: Template, options: PlannerOptions, values: Mapping[str, float]) -> Task:
    """The task with these numbers: by key, in the file's units.

    Raises
    ------
    TaskError : the task is refused with them.
    """
    parameters = {
        key.removeprefix("parameters."): value
        for key, value in values.items()
        if key.startswith("parameters.")
    }
    task = replace(template.task(**parameters), options=options)
    for bound, key in KEYS.items():
        if key in values:
            task = with_bound(task, bound, values[key])
    return task


def with_bound(task: Task, bound: Bound, value: float) -> Task:
    """The task with another bound, given in the file's unit."""
    if bound is Bound.FRICTION:
        return replace(task, friction=to_radians(value))
    return replace(task, uncertainty=_changed(task.uncertainty, bound, value))


def _changed(errors: Uncertainty, bound: Bound, value: float) -> Uncertainty:
    match bound:
        case Bound.CONTROL:
            return replace(errors, control=to_radians(value))
        case Bound.POSITION:
            return replace(errors, position=value)
        case Bound.FORCE:
            return replace(errors, force_angle=to_radians(value))
        case Bound.THRESHOLD:
            low, high = errors.force_thresholds
            # a pair keeps its proportion
            return replace(
                errors, force_thresholds=(value * low / high if high > low else value, value)
            )
        case Bound.FRICTION:
            raise TaskError("friction", "is no error of control or sensing")


def _given(task: Task, bound: Bound) -> float:
    errors = task.uncertainty
    if bound in (Bound.FORCE, Bound.THRESHOLD) and not errors.has_force_sensor:
        raise InputError(bound.value, "cannot be varied: the task has no force sensor")
    match bound:
        case Bound.CONTROL:
            return to_degrees(errors.control)
        case Bound.POSITION:
            return errors.position
        case Bound.FORCE:
            return to_degrees(errors.force_angle)
        case Bound.THRESHOLD:
            return errors.force_thresholds[1]
        case Bound.FRICTION:
            return to_degrees(task.friction)


def _most(task: Task, bound: Bound) -> float:
    """Beyond this nothing changes any more, or nothing is left."""
    window = task.workspace.window
    match bound:
        case Bound.CONTROL:
            return min(NEARLY, CONTROL.high)
        case Bound.POSITION:
            xmin, ymin, xmax, ymax = window.bounds
            return math.hypot(xmax - xmin, ymax - ymin)
        case Bound.FORCE:
            return FORCE_ANGLE.high - 1.0
        case Bound.THRESHOLD:
            return max(LOUDEST, task.uncertainty.force_thresholds[1])
        case Bound.FRICTION:
            return min(NEARLY, FRICTION.high)


def default_bounds(template: Template) -> Sequence[str]:
    """The bounds that a task has a value of, and its parameters."""
    errors = template.task().uncertainty
    bounds = [
        one.value
        for one in Bound
        if errors.has_force_sensor or one not in (Bound.FORCE, Bound.THRESHOLD)
    ]
    return [*bounds, *(name for name in template.parameters if name not in bounds)]


def _round_number(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above the value."""
    exponent = math.floor(math.log10(value))
    for digit in (5, 2, 1):
        number = float(f"{digit}e{exponent}")
        if number <= value * (1.0 + NEAR):
            return number
    return float(f"5e{exponent - 1}")


def _exponent(step: float) -> int:
    return math.floor(math.log10(step) + NEAR)
