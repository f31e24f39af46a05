"""What stands in the way: each reason against motions and readings straight from the theory."""

import math
from collections import Counter
from dataclasses import replace
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region, union
from preimage.configuration.start import Start, StartKind, covered, start_region
from preimage.execution.trace import Outcome
from preimage.geometry import area as areas
from preimage.geometry.area import Area
from preimage.preimages.methods import aim
from preimage.preimages.setting import Setting
from preimage.preimages.shared import share_out, told_part
from preimage.preimages.starts import start_as_region
from preimage.reachability.backprojection import backproject
from preimage.search.lost import deepest, lost_start
from preimage.search.planner import plan
from preimage.search.reasons import MOST_DIRECTIONS, reasons
from preimage.strategy.describe import describe
from preimage.strategy.reason import Reason, ReasonKind, told
from preimage.strategy.strategy import Motion, Status, Strategy, StrategyRegion
from preimage.task.examples import named_task
from preimage.task.options import Method, StrategyKind
from preimage.task.parse import parse_task
from preimage.task.task import InitialPolygon, Task
from preimage.verification.features import features_of
from preimage.verification.forward import ForwardProjection, forward_projection
from preimage.verification.paths import Stop
from preimage.verification.reading_sets import reading_sets
from preimage.verification.trajectory import admissible, trace_of
from tests.laws.tasks import random_task

SLACK = 256.0
"""Tolerances: what rounding may make of a place."""

STOPS = (ReasonKind.TRAP, ReasonKind.CONFUSED, ReasonKind.UNSURE)


def failed(task: Task) -> tuple[Strategy, tuple[Reason, ...]] | None:
    """A planning run without success, and its reasons."""
    strategy = plan(task)
    if strategy.status is Status.SOLVED:
        return None
    setting = Setting.of(task, strategy.space)
    options = task.options
    assert isinstance(options.directions, tuple)
    start = start_region(task, strategy.space)
    found = reasons(
        setting, start, strategy.regions, options.directions, options.method, strategy.kind
    )
    return strategy, found


def why(task: Task) -> dict[float, list[Reason]]:
    """Reasons by direction, in whole degrees."""
    found = failed(task)
    assert found is not None
    by_direction: dict[float, list[Reason]] = {}
    for reason in found[1]:
        assert reason.direction is not None
        by_direction.setdefault(round(math.degrees(reason.direction)), []).append(reason)
    return by_direction


# --- the laws -------------------------------------------------------------------------------


class Judge:
    """Looks at the reasons of one planning run, one direction after the other."""

    def __init__(self, strategy: Strategy, found: tuple[Reason, ...]) -> None:
        self.strategy, self.found = strategy, found
        self.task, self.space = strategy.task, strategy.space
        self.setting = Setting.of(self.task, self.space)
        self.near = SLACK * self.space.tolerance.length
        self.regions = [region.region for region in strategy.regions]

    def place(self) -> Start:
        """The place of the start that all reasons are about."""
        start = lost_start(start_region(self.task, self.space), self.regions, self.space)
        assert start is not None
        return start

    def judge(self) -> Counter[ReasonKind]:
        """Check all reasons."""
        assert self.found
        if self.found[0].kind is ReasonKind.SPLIT:
            self.split(self.found[0])
            return Counter([ReasonKind.SPLIT])
        start = self.place()
        for region in self.regions:
            assert not covered(start, region, self.space)
        directions = self.task.options.directions
        assert isinstance(directions, tuple)
        assert {reason.direction for reason in self.found} == set(directions)
        for direction in directions:
            target = self.target(direction)
            about = [reason for reason in self.found if reason.direction == direction]
            self.along(direction, target, about, start)
        return Counter(reason.kind for reason in self.found)

    def target(self, direction: float) -> Region:
        """What of all regions a strategy of this kind may count on."""
        method, command = self.task.options.method, self.setting.command(direction)
        if self.strategy.kind is StrategyKind.CONDITIONAL:
            shares = [told_part(self.setting, one, command, method) for one in self.regions]
            shared = share_out(self.setting, self.regions, shares, command, method)
            return shared.target.region
        target = Region.empty()
        for region in self.regions:
            part = aim(self.setting, region, direction, method).region
            target = union(target, part, self.space.tolerance)
        return target

    def along(self, direction: float, target: Region, about: list[Reason], start: Start) -> None:
        if target.is_empty:
            assert [one.kind for one in about] == [ReasonKind.NOTHING_RECOGNISED]
            return
        control, friction = self.task.uncertainty.control, self.task.friction
        if about[0].origin != start.point:
            command = self.setting.command(direction)
            reached = backproject(self.space, target, command.sources).region
            assert covered(start, reached, self.space)
            other = lost_start(start_region(self.task, self.space), [reached], self.space)
            assert other is not None
            assert not covered(other, reached, self.space)
            start = other
        spot = start_as_region(start, self.space)
        visited = forward_projection(self.space, spot, direction, control, friction, target)
        for reason in about:
            assert reason.origin == start.point
            if reason.kind in STOPS:
                self.stops(reason, visited)
            if reason.kind is ReasonKind.TRAP:
                assert not any(self.holds(region, reason) for region in self.regions)
            elif reason.kind is ReasonKind.CONFUSED:
                assert any(self.confuses(region, reason) for region in self.regions)
            elif reason.kind is ReasonKind.UNSURE:
                assert self.task.options.method is Method.STICKING
                assert any(self.holds(region, reason) for region in self.regions)
                assert not self.sticks(reason)
            elif reason.kind is ReasonKind.ESCAPE:
                self.escapes(reason, visited)
            elif reason.kind in (ReasonKind.UNEXPLORED, ReasonKind.SEVERAL):
                assert not visited.rests, reason.words
                assert not visited.escapes, reason.words
                if reason.kind is ReasonKind.UNEXPLORED:
                    assert self.strategy.status is Status.STOPPED
            else:
                assert reason.kind is ReasonKind.UNKNOWN

    def split(self, reason: Reason) -> None:
        start = start_region(self.task, self.space)
        assert start.kind is StartKind.REGION
        assert lost_start(start, self.regions, self.space) is None
        assert not any(covered(start, region, self.space) for region in self.regions)

    def stops(self, reason: Reason, visited: ForwardProjection) -> None:
        """A trajectory of nature's own leads there, and may stay."""
        assert reason.feature is not None
        assert reason.place is not None
        count = len(self.space.contact)
        assert any(
            feature == reason.feature
            and (feature >= count or low - self.near <= self.at(reason) <= high + self.near)
            for feature, low, high in visited.rests
        ), reason.words
        if reason.feature < count:
            stops = visited.ways.to_edge(reason.feature, self.at(reason))
        else:
            stops = visited.ways.to_vertex(reason.feature - count)
        end = self.end(reason, visited, stops)
        assert math.dist(end, reason.place) <= self.near

    def end(
        self, reason: Reason, visited: ForwardProjection, stops: tuple[Stop, ...]
    ) -> tuple[float, float]:
        """Where a way ends that nature may take."""
        assert reason.direction is not None
        moving = Motion(reason.direction, (0,), Region.empty(), ())
        strategy = replace(
            self.strategy, regions=(StrategyRegion(1, 1, visited.start, moving),), start=(1,)
        )
        trace = trace_of(strategy, 1, visited, stops, Outcome.ENDLESS, reason.words)
        assert admissible(trace, 1e-6), reason.words
        x, y = trace.legs[0].places[-1].tolist()
        return x, y

    def at(self, reason: Reason) -> float:
        assert reason.place is not None
        assert reason.feature is not None
        return math.dist(self.space.contact.points[reason.feature].tolist(), reason.place)

    def holds(self, region: Region, reason: Reason) -> bool:
        assert reason.feature is not None
        count = len(self.space.contact)
        if reason.feature >= count:
            return region.contact.has_vertex(reason.feature - count)
        near = self.space.tolerance.length
        return region.contact.contains(reason.feature, self.at(reason), near)

    def sticks(self, reason: Reason) -> bool:
        assert reason.direction is not None
        assert reason.feature is not None
        contact = self.space.contact
        features = features_of(
            contact, reason.direction, self.task.uncertainty.control, self.task.friction,
            self.space.tolerance.angle,
        )  # fmt: skip
        surely = np.concatenate((features.surely, features.surely_vertex))
        return bool(surely[reason.feature])

    def confuses(self, region: Region, reason: Reason) -> bool:
        """Whether the other feature reads alike, outside this region and near enough."""
        assert reason.direction is not None
        assert reason.feature is not None
        assert reason.other is not None
        assert reason.place is not None
        if not self.holds(region, reason):
            return False
        sets = reading_sets(
            self.space.contact, reason.direction, self.task.uncertainty, self.task.friction,
            self.space.tolerance.angle,
        )  # fmt: skip
        assert sets.alike(reason.feature)[reason.other], reason.words
        if reason.reading is None:
            assert sets.zero[reason.feature]
            assert sets.zero[reason.other]
        else:
            for feature in (reason.feature, reason.other):
                for angle in reason.reading:
                    off = angle - reason.direction - math.pi
                    slack = 1e-6
                    assert any(
                        sets.low[feature] - slack <= off + turn <= sets.high[feature] + slack
                        for turn in (-2 * math.tau, -math.tau, 0.0, math.tau, 2 * math.tau)
                    ), reason.words
        reach = 2.0 * self.task.uncertainty.position + self.near
        return self.distance(region, reason.other, reason.place) <= reach

    def distance(self, region: Region, feature: int, place: tuple[float, float]) -> float:
        """How far a place is from what of a feature lies outside a region."""
        contact, count = self.space.contact, len(self.space.contact)
        if feature == 2 * count:
            return areas.difference(self.space.free, region.area).distance(*place)
        if feature >= count:
            gone = region.contact.has_vertex(feature - count)
            apart = math.dist(contact.points[feature - count].tolist(), place)
            return math.inf if gone else apart
        length, inside = float(contact.length[feature]), region.contact
        own = inside.edge == feature
        ends = [0.0]
        for low, high in zip(inside.low[own], inside.high[own], strict=True):
            ends += [float(low), float(high)]
        ends.append(length)
        best = math.inf
        for low, high in zip(ends[::2], ends[1::2], strict=True):
            if high - low > self.space.tolerance.length:
                steps = np.linspace(low, high, 2001)
                points = contact.at(np.full(len(steps), feature), steps)
                gaps = np.hypot(*(points - np.array(place)).T) - 0.5 * (high - low) / 2000
                best = min(best, float(np.min(gaps)))
        return best

    def escapes(self, reason: Reason, visited: ForwardProjection) -> None:
        assert reason.feature is not None
        contact, count = self.space.contact, len(self.space.contact)
        assert contact.open[reason.feature]
        ends = {count + reason.feature, count + int(contact.next[reason.feature])}
        met = {reason.feature, *ends} & set(visited.escapes)
        assert met, reason.words
        if reason.feature in met:
            stops = visited.ways.to_side(reason.feature)
        else:
            stops = visited.ways.to_vertex(min(met) - count)
        x, y = self.end(reason, visited, stops)
        xmin, ymin, xmax, ymax = self.space.window
        assert min(x - xmin, xmax - x, y - ymin, ymax - y) <= self.near
        if reason.place is not None:
            x, y = reason.place
            assert min(x - xmin, xmax - x, y - ymin, ymax - y) <= self.near


def judged(seed: int, kind: StrategyKind = StrategyKind.LINEAR) -> Counter[ReasonKind]:
    task = random_task(Random(seed))
    task = replace(task, options=replace(task.options, strategy=kind, max_regions=20))
    found = failed(task)
    return Counter() if found is None else Judge(*found).judge()


def test_every_direction_has_a_reason_and_none_is_wrong() -> None:
    kinds: Counter[ReasonKind] = Counter()
    for seed in range(30):
        kinds += judged(seed, list(StrategyKind)[seed % 2])
    assert kinds[ReasonKind.UNKNOWN] == 0
    assert kinds[ReasonKind.TRAP] > 10
    assert kinds[ReasonKind.ESCAPE] > 3


@pytest.mark.slow
@pytest.mark.parametrize("kind", StrategyKind)
@pytest.mark.parametrize("first", range(200, 600, 100))
def test_every_direction_has_a_reason_and_none_is_wrong_at_length(
    first: int, kind: StrategyKind
) -> None:
    kinds: Counter[ReasonKind] = Counter()
    for seed in range(first, first + 100):
        kinds += judged(seed, kind)
    assert kinds[ReasonKind.UNKNOWN] == 0


@settings(max_examples=8)
@given(st.integers(min_value=10_000, max_value=10_000_000))
def test_no_reason_is_wrong_anywhere(seed: int) -> None:
    judged(seed)


# --- closed cases ---------------------------------------------------------------------------


def with_directions(task: Task, *degrees: float, method: Method = Method.COMBINED) -> Task:
    turns = tuple(math.radians(angle) for angle in degrees)
    return replace(task, options=replace(task.options, directions=turns, method=method))


@pytest.mark.parametrize("method", Method)
def test_a_start_wider_than_the_triangle_is_trapped_beside_the_goal(method: Method) -> None:
    wide = ((-6.0, 1.0), (6.0, 1.0), (6.0, 2.0), (-6.0, 2.0))
    task = replace(named_task("flat-floor"), initial=InitialPolygon(wide))
    (reason,) = why(with_directions(task, 270, method=method))[270]
    assert reason.kind is ReasonKind.TRAP
    assert reason.origin is not None
    assert reason.place is not None
    assert abs(reason.place[0]) > 2.0
    assert reason.place[1] == 0.0
    # as wide as the control cone is where it meets the floor
    half = reason.origin[1] * math.tan(math.radians(10.0))
    assert abs(reason.place[0] - reason.origin[0]) <= half
    assert "on the edge (-20, 0) to (20, 0)" in reason.words
    assert "no region that leads on" in reason.words


def test_a_peg_beside_its_hole_stops_on_the_floor_or_leaves() -> None:
    found = why(with_directions(named_task("peg-in-hole"), 0, 90, 180, 270, method=Method.STICKING))
    (down,) = found[270]
    assert down.kind is ReasonKind.TRAP
    assert down.place == pytest.approx((-4.0, 0.0))
    half = 2.5 * math.tan(math.radians(5.0))
    for end in (-4.0 - half, -4.0 + half):
        assert f"({end:.6g}, 0)" in down.words
    (left,), (right,) = found[180], found[0]
    assert left.kind is right.kind is ReasonKind.ESCAPE
    assert left.words == "left (180°): may leave through the left side of the window"
    assert left.place == pytest.approx((-10.0, 2.5))
    assert right.place == pytest.approx((10.0, 2.5))
    (up,) = found[90]
    assert up.kind is ReasonKind.NOTHING_RECOGNISED


def corridor() -> Task:
    """A smooth corridor, open on the left; the goal is the right half of its floor."""
    return parse_task(
        {
            "version": 1,
            "window": [0, 0, 10, 4],
            "walls": ["top", "bottom", "right"],
            "uncertainty": {
                "control": 10, "position": 0.2, "force": {"angle": 10, "threshold": 0.05}
            },
            "friction": 0,
            "initial": {"point": [5, 2]},
            "goal": {"edges": [[[6, 0], [10, 0]]]},
        },
        name="corridor",
    )  # fmt: skip


def test_a_corridor_is_left_at_its_open_side() -> None:
    (reason,) = why(with_directions(corridor(), 225, method=Method.KERNEL))[225]
    assert reason.kind is ReasonKind.ESCAPE
    assert "left side of the window" in reason.words
    assert reason.place is not None
    assert reason.place[0] == pytest.approx(0.0)
    (nothing,) = why(with_directions(corridor(), 180, method=Method.KERNEL))[180]
    assert nothing.kind is ReasonKind.NOTHING_RECOGNISED
    assert "reads like" in nothing.words


def notches(position: float) -> Task:
    """Two notches alike, a unit apart, and a third far away; the first and the last are goals."""
    outline = [[-20, 0]]
    for left in (-3, -1, 10):
        outline += [[left, 0], [left, -3], [left + 1, -3], [left + 1, 0]]
    outline += [[20, 0]]
    return parse_task(
        {
            "version": 1,
            "window": [-15, -6, 15, 8],
            "obstacles": [{"chain": outline, "solid": "right"}],
            "uncertainty": {
                "control": 5, "position": position, "force": {"angle": 10, "threshold": 0.05}
            },
            "friction": 20,
            "initial": {"point": [-2.5, 0.5]},
            "goal": {"edges": [[[-3, -3], [-2, -3]], [[10, -3], [11, -3]]]},
            "planner": {"directions": [270], "method": "kernel"},
        },
        name="notches",
    )  # fmt: skip


def test_two_notches_alike_are_confused() -> None:
    found = failed(notches(0.8))
    assert found is not None
    strategy, (reason, *_) = found
    contact = strategy.space.contact
    assert reason.kind is ReasonKind.CONFUSED
    assert reason.feature is not None
    assert reason.other is not None
    ends = {tuple(contact.points[reason.feature]), tuple(contact.ends[reason.feature])}
    assert ends == {(-3.0, -3.0), (-2.0, -3.0)}
    ends = {tuple(contact.points[reason.other]), tuple(contact.ends[reason.other])}
    assert ends == {(-1.0, -3.0), (0.0, -3.0)} or reason.other >= len(contact)
    assert reason.reading is not None
    # sticking, the floor of either pushes back against the cone; the force sensor adds its error
    middle = 0.5 * sum(reason.reading)
    assert math.cos(middle - math.radians(90.0)) == pytest.approx(1.0)
    width = reason.reading[1] - reason.reading[0]
    assert width == pytest.approx(math.radians(30.0))
    assert "a force of 75° to 105°" in reason.words


def test_without_a_position_sensor_nothing_of_a_notch_is_recognised() -> None:
    (reason, *_) = why(with_directions(notches(math.inf), 270, method=Method.KERNEL))[270]
    assert reason.kind is ReasonKind.NOTHING_RECOGNISED
    assert reason.other is not None
    assert "a force of 75° to 105°" in reason.words


# --- starts, and what is left out --------------------------------------------------------------


def test_a_start_in_two_regions_is_split() -> None:
    task = named_task("peg-in-hole-point")
    strategy = plan(task)
    setting = Setting.of(task, strategy.space)
    space = strategy.space
    middle = start_region(task, space)
    assert middle.point is not None
    x, y = middle.point
    parts = []
    for place, (low, high) in enumerate(((x - 1.0, x), (x, x + 1.0))):
        box = Area.box(low, y - 1.0, high, y + 1.0)
        goal = strategy.region(0)
        moving = Motion(float(place), (0,), goal.region, ())
        parts.append(StrategyRegion(place + 1, 1, Region(box, ContactSet.empty()), moving))
    inner = Area.box(x - 0.5, y - 0.5, x + 0.5, y + 0.5)
    start = Start.anywhere_in(Region(inner, ContactSet.empty()))
    (reason,) = reasons(setting, start, [strategy.region(0), *parts], (0.0,), Method.COMBINED)
    assert reason.kind is ReasonKind.SPLIT
    assert "region 1" in reason.words
    assert "region 2" in reason.words


def test_of_many_directions_some_are_looked_at() -> None:
    task = named_task("peg-in-hole")
    many = tuple(math.radians(10.0 + 0.8 * step) for step in range(200))
    options = replace(task.options, directions=many, method=Method.STICKING, max_steps=1)
    found = failed(replace(task, options=options))
    assert found is not None
    assert len({reason.direction for reason in found[1]}) == MOST_DIRECTIONS


def test_a_limit_that_came_first_is_no_obstacle() -> None:
    task = named_task("peg-in-hole")
    found = failed(replace(task, options=replace(task.options, max_steps=1)))
    assert found is not None
    strategy, causes = found
    assert strategy.status is Status.STOPPED
    assert causes[0].kind is ReasonKind.UNEXPLORED
    assert causes[0].words.endswith("nothing stands in the way of one more motion")


@pytest.mark.parametrize(
    ("area", "least"),
    [
        (Area.box(0.0, 0.0, 4.0, 1.0), 0.3),
        (Area.polygon(np.array([(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (5.0, 1.0)])), 0.2),
        (Area.box(0.1234567, 0.0, 0.1234667, 1.0), 3e-6),
    ],
)
def test_the_deepest_place_is_well_inside(area: Area, least: float) -> None:
    place = deepest(area, 1e-9)
    assert place is not None
    assert area.contains(*place)
    assert area.depth(*place) > least


def test_a_sliver_has_no_deepest_place() -> None:
    assert deepest(Area.box(0.0, 0.0, 1.0, 1e-9), 1e-8) is None


def test_the_description_tells_a_few() -> None:
    task = with_directions(named_task("peg-in-hole"), 0, 90, 180, 270, method=Method.STICKING)
    found = failed(task)
    assert found is not None
    strategy, causes = found
    told_ones = told(causes)
    assert len(told_ones) <= 4
    text = describe(replace(strategy, why=causes))
    assert "what stands in the way from (-4, 2.5):" in text
    for reason in told_ones:
        assert reason.words in text
    assert "what stands in the way" not in describe(replace(strategy, why=()))
