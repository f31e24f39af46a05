"""What is avoidable on an edge stays out, however short it is."""

from __future__ import annotations

import math

import pytest
from shapely import box

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry.area import Area
from preimage.reachability.backprojection import backproject
from preimage.reachability.sources import sources
from preimage.task.workspace import Side
from tests.strategies import space_of


@pytest.mark.parametrize("direction", [270.0, 90.0])
def test_the_line_above_a_tip_is_missing_from_the_ceiling(direction: float) -> None:
    """Perfect control: right above a tip that may hold the robot, nature's line is a line."""
    up = -1.0 if direction == 90.0 else 1.0

    def turned(x: float, y: float, x2: float, y2: float) -> object:
        return box(x, min(up * y, up * y2), x2, max(up * y, up * y2))

    walls = [Side.BOTTOM if up > 0 else Side.TOP]
    shelf, ceiling = turned(-9, -9, 0, 0), turned(-3, 4, 3, 5)
    space = space_of([shelf, ceiling], walls=walls)
    contact = space.contact
    below = [
        edge
        for edge in contact.edges.tolist()
        if contact.points[edge][1] == contact.ends[edge][1] in (0.0, up * -6.0)
    ]
    goal = ContactSet.of(below, [0.0] * len(below), contact.length[below], [], 1e-9)
    command = sources(contact, math.radians(direction), 0.0, math.radians(20), space.tolerance)
    found = backproject(space, Region(Area.empty(), goal), command).region.contact
    (over,) = [
        edge
        for edge in contact.edges.tolist()
        if contact.points[edge][1] == contact.ends[edge][1] == up * 4.0
    ]
    assert not found.contains(over, 3.0, 0.0)
    assert found.contains(over, 1.0, 0.0)
    assert found.contains(over, 5.0, 0.0)
