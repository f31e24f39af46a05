"""The test tools have teeth: what is wrong on purpose is caught; and the world's closed forms."""

import math
from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest
from shapely import Polygon, box

from preimage.configuration.region import Region
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.preimages.methods import preimage, reach
from preimage.preimages.preimage import Preimage, Target
from preimage.preimages.setting import Setting
from preimage.recognition.kernel import kernel
from preimage.recognition.termination import StickingCondition
from preimage.task.options import Method
from preimage.task.task import SlidingLaw
from tests.laws.adversaries import CONTROLS
from tests.laws.passage import starts
from tests.laws.simulation import Execution, Track, ViolationError
from tests.laws.tasks import random_setting
from tests.laws.world import AtVertex, Doing, Free, Lost, OnEdge, World
from tests.strategies import Scene, space_of

DOWN = math.radians(270)
WRONG = Callable[[Setting, Scene], Preimage | None]


def with_bounds(setting: Setting, **bounds: float) -> Setting:
    senses = setting.uncertainty
    return Setting(
        setting.space,
        replace(
            senses,
            control=bounds.get("control", senses.control),
            position=bounds.get("position", senses.position),
        ),
        setting.friction,
        setting.sliding,
        setting.arc_tolerance,
    )


def too_big(setting: Setting, scene: Scene) -> Preimage | None:
    """A preimage that reaches a little too far."""
    made = preimage(setting, scene.target, scene.direction, Method.COMBINED)
    if made.region.area.is_empty:
        return None
    grown = areas.intersection(Area(made.region.area.geometry.buffer(0.1)), scene.space.free)
    return replace(made, region=Region(grown, made.region.contact))


def for_less_control_noise(setting: Setting, scene: Scene) -> Preimage | None:
    theta = setting.uncertainty.control
    if theta == 0.0:
        return None
    easier = with_bounds(setting, control=0.8 * theta)
    return preimage(easier, scene.target, scene.direction, Method.COMBINED)


def for_a_better_position_sensor(setting: Setting, scene: Scene) -> Preimage | None:
    rho = setting.uncertainty.position
    if rho == 0.0 or math.isinf(rho):
        return None
    easier = with_bounds(setting, position=0.7 * rho)
    return preimage(easier, scene.target, scene.direction, Method.KERNEL)


def without_vertices(setting: Setting, scene: Scene) -> Preimage | None:
    """The paper's kernel, which looks at edges alone."""
    command = setting.command(scene.direction)
    n = command.readings.size
    zero, half = command.readings.zero.copy(), command.readings.half.copy()
    zero[n : 2 * n], half[n : 2 * n] = False, -math.inf
    blind = replace(command.readings, zero=zero, half=half)
    paper = kernel(scene.space, blind, scene.target, setting.uncertainty)
    ours = kernel(scene.space, command.readings, scene.target, setting.uncertainty)
    if paper.contact.total_length - ours.contact.total_length < 1e-3:
        return None
    target = Target.of_kernel(paper)
    return reach(setting, scene.target, scene.direction, Method.KERNEL, target)


def with_a_short_period(setting: Setting, scene: Scene) -> Preimage | None:
    made = preimage(setting, scene.target, scene.direction, Method.STICKING)
    conditions = tuple(
        replace(condition, period=0.6 * condition.period)
        for condition in made.termination
        if isinstance(condition, StickingCondition)
    )
    if not conditions or setting.uncertainty.position == 0.0:
        return None
    return replace(made, termination=conditions)


@pytest.mark.parametrize(
    ("wrong", "seeds"),
    [
        (too_big, range(6)),
        (for_less_control_noise, range(8)),
        (for_a_better_position_sensor, range(8)),
        (without_vertices, range(40)),
        (with_a_short_period, range(40)),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_wrong_preimages_are_caught(wrong: WRONG, seeds: range) -> None:
    tried = caught = 0
    for seed in seeds:
        rng = Random(seed)
        setting, scene = random_setting(rng)
        made = wrong(setting, scene)
        if made is None or made.region.is_empty:
            continue
        tried += 1
        execution = Execution.of(setting, made)
        try:
            for start in starts(execution.world, made.region, rng, 10):
                for control in CONTROLS:
                    execution.run(start, control, rng)
        except ViolationError:
            caught += 1
    assert tried
    assert caught >= 0.6 * tried, (tried, caught)


# --- the world -----------------------------------------------------------------------------


def test_a_slide_on_a_slope() -> None:
    """30 degrees steep, friction 20: straight down it slides, at sin 60 or sin 40 / cos 20 less."""
    rise = 4 * math.tan(math.radians(30))
    slope = Polygon([(-2, -3), (2, -3), (2, rise - 1), (-2, -1)])
    space = space_of([slope])
    for law, expected in (
        (SlidingLaw.PROJECTION, math.sin(math.radians(30))),
        (SlidingLaw.DAMPER, math.sin(math.radians(10)) / math.cos(math.radians(20))),
    ):
        world = World(space, math.radians(20), law)
        [flight] = world.moves(Free(0.0, 5.0), DOWN, math.inf)
        assert flight.doing is Doing.FLIES
        assert flight.stop == pytest.approx((0.0, -1 + 0.5 * rise))
        assert isinstance(flight.end, OnEdge)
        [slide] = world.moves(flight.end, DOWN, 1.0)
        assert slide.doing is Doing.SLIDES
        assert math.dist(slide.start, slide.stop) == pytest.approx(expected)
        assert slide.stop[0] < 0.0
        [force] = world.forces(flight.end, DOWN)
        assert force.angle == pytest.approx(math.radians(90 + 30 - 20))
        magnitude = math.cos(math.radians(30)) / math.cos(math.radians(20))
        assert force.magnitude == pytest.approx(magnitude)
    steep = World(space, math.radians(31))
    assert isinstance(flight.end, OnEdge)
    [rest] = steep.moves(flight.end, DOWN, 1.0)
    assert rest.doing is Doing.STICKS
    [force] = steep.forces(flight.end, DOWN)
    assert (force.angle % math.tau, force.magnitude) == pytest.approx((math.radians(90), 1.0))


def test_a_notch_holds_without_friction_and_a_tip_does_not() -> None:
    notch = Polygon([(-5, 0), (-3, 0), (-1, -4), (1, 0), (2, 0), (3, 2), (4, 0), (5, -5), (-5, -5)])
    space = space_of([notch])
    world = World(space, 0.0)
    bottom, tip = (
        AtVertex(int(abs(space.contact.points - place).sum(axis=1).argmin()))
        for place in ((-1, -4), (3, 2))
    )
    assert [move.doing for move in world.moves(bottom, DOWN, 1.0)] == [Doing.STICKS]
    assert sorted(move.stop[0] > 3 for move in world.moves(tip, DOWN, 0.1)) == [False, True]
    aside = world.moves(tip, math.radians(200), 0.1)
    assert [move.doing for move in aside] == [Doing.FLIES]


def test_what_leaves_through_an_open_side_is_lost() -> None:
    world = World(space_of([box(-1, -1, 1, 1)]), 0.0)
    [flight] = world.moves(Free(3.0, 3.0), 0.0, math.inf)
    assert flight.end is Lost.ESCAPED
    assert flight.time == pytest.approx(3.0)


def test_the_gap_between_two_places_of_a_track() -> None:
    track = Track()
    for time, place in enumerate([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]):
        track.add(float(time), place, Free(*place))
    assert track.nearest_return(4.5) == math.inf
    assert track.nearest_return(4.0) == 0.0
    assert track.nearest_return(1.0) == pytest.approx(math.sqrt(0.5))
