"""Kernels in big scenes: local work, and the same answer as looking at everything."""

import math
from functools import cache

import numpy as np
import pytest
import shapely

from preimage.configuration.location import inside_area
from preimage.configuration.obstacles import space_among
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.geometry import area as areas
from preimage.geometry import inflate
from preimage.geometry.area import Area
from preimage.geometry.border import border
from preimage.preimages.methods import preimage
from preimage.preimages.setting import Setting
from preimage.recognition import outside, surroundings
from preimage.recognition.kernel import kernel
from preimage.recognition.surroundings import _box
from preimage.task.examples import named_task
from preimage.task.options import Method

REACH = 1.3


@pytest.fixture(autouse=True)
def _always_local(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(outside, "FEW_EDGES", 0)
    monkeypatch.setattr(inflate, "FEW_PIECES", 0)


@cache
def setting_of(size: int) -> Setting:
    return Setting.of(named_task(f"hall-{size}"))


def small_goal(space: ConfigurationSpace, x: float, y: float, size: float = 6.0) -> Region:
    area = areas.intersection(Area.box(x, y, x + size, y + size), space.free)
    return Region(area, inside_area(space.contact, area, space.tolerance.length))


def kernel_of(setting: Setting, target: Region, direction: float) -> Region:
    surroundings.surroundings.cache_clear()
    command = setting.command(direction)
    return kernel(setting.space, command.readings, target, setting.uncertainty)


def assert_same(one: Region, other: Region, near: float) -> None:
    off = shapely.symmetric_difference(one.area.geometry, other.area.geometry, grid_size=2.0**-36)
    assert shapely.buffer(off, -near, quad_segs=1).is_empty
    assert one.contact.edge.tolist() == other.contact.edge.tolist()
    assert one.contact.low == pytest.approx(other.contact.low, abs=near)
    assert one.contact.high == pytest.approx(other.contact.high, abs=near)
    assert one.contact.vertices.tolist() == other.contact.vertices.tolist()


@pytest.mark.parametrize("angle", [0, 45, 90, 200, 315])
def test_near_is_enough(angle: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Wide preimages with many holes: the same kernels when everything is looked at, at once."""
    setting = setting_of(60)
    space, direction = setting.space, math.radians(angle)
    goal = small_goal(space, 20.0, 20.0, 25.0)
    wide = preimage(setting, goal, direction, Method.COMBINED).region
    for target in (goal, wide):
        for command in (direction, direction + 1.0):
            local = kernel_of(setting, target, command)
            with monkeypatch.context() as patched:
                patched.setattr(outside, "FEW_EDGES", 10**9)
                patched.setattr(inflate, "FEW_PIECES", 10**9)
                plain = kernel_of(setting, target, command)
            assert not plain.is_empty
            assert_same(local, plain, 4.0 * space.tolerance.length)


def test_the_rest_of_the_scene_does_not_matter() -> None:
    """The kernel of a small goal among all pillars, and among those near it alone."""
    setting = setting_of(60)
    space = setting.space
    target = small_goal(space, 22.0, 31.0, 9.0)
    pillars = [part for part in space.obstacles.parts if part.distance(26.5, 35.5) < 14.0]
    assert 3 < len(pillars) < len(space.obstacles.parts) // 3
    walls = named_task("hall-60").workspace.walls
    few = space_among(areas.union(*pillars), space.window, walls)
    small = Setting(few, setting.uncertainty, setting.friction, setting.sliding, 0.005)
    other = Region(target.area, inside_area(few.contact, target.area, few.tolerance.length))
    one = kernel_of(setting, target, 1.0)
    two = kernel_of(small, other, 1.0)
    assert not one.area.is_empty
    off = shapely.symmetric_difference(one.area.geometry, two.area.geometry, grid_size=2.0**-36)
    assert shapely.buffer(off, -4.0 * space.tolerance.length).is_empty
    assert one.contact.total_length == pytest.approx(two.contact.total_length, abs=1e-6)
    assert len(one.contact.vertices) == len(two.contact.vertices)


def looked_at(size: int) -> tuple[int, int]:
    """How many contact features, and corners of free space, count for one small goal."""
    space = setting_of(size).space
    target = small_goal(space, 12.0, 12.0)
    box = _box(space, target, None, REACH)
    assert box is not None
    part = outside.contact_beside(space, target, None, REACH)
    beside = outside.area_beside(space, target, None, box, REACH)
    return len(part.edge) + len(part.vertices), len(border(beside)[0])


def test_what_is_looked_at_does_not_grow_with_the_scene() -> None:
    """The pillars of halls of one width are the same near the corner: here near at least."""
    few, many = looked_at(60), looked_at(600)
    assert len(setting_of(600).space.contact) > 3000
    assert max(many) < 80
    assert min(few) > 0
    assert min(many) > 0


def test_a_goal_that_is_contact_alone() -> None:
    space = setting_of(60).space
    target = Region(Area.empty(), small_goal(space, 12.0, 12.0).contact)
    near = outside.contact_beside(space, target, None, REACH)
    assert 0 < len(near.edge) < len(space.contact) // 4
    assert not outside.contact_beside(space, Region.empty(), None, REACH).total_length
    assert np.all(np.diff(near.edge) > 0)
