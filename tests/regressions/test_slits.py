"""What is avoidable on an edge stays out, however short it is."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shapely import box

from preimage.configuration.contact_set import ContactSet
from preimage.configuration.region import Region
from preimage.geometry.area import Area
from preimage.reachability.backprojection import backproject
from preimage.reachability.sources import sources
from preimage.recognition.kernel import kernel
from preimage.recognition.readings import readings
from preimage.task.uncertainty import Uncertainty
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


def test_kernels_keep_away_from_the_line_above_a_tip() -> None:
    """Perfect control: the line that ends on a tip outside the goal is outside the preimage too.

    So what is read near that line may be read on it.
    """
    walls = [Side.LEFT, Side.RIGHT]
    space = space_of([box(-9, -9, 0, 0), box(-9, -9, 9, -4)], walls=walls)
    contact, down = space.contact, math.radians(270)
    tops = [
        edge
        for edge in contact.edges.tolist()
        if contact.points[edge][1] == contact.ends[edge][1] in (0.0, -4.0)
    ]
    tip = int(np.flatnonzero(np.all(contact.points == (0.0, 0.0), axis=1))[0])
    corners = np.setdiff1d(contact.vertices, [tip])
    goal = ContactSet.of(tops, [0.0] * len(tops), contact.length[tops], corners, 1e-9)
    friction, senses = math.radians(20), Uncertainty(control=0.0, position=0.1)
    command = sources(contact, down, 0.0, friction, space.tolerance)
    starts = backproject(space, Region(Area.empty(), goal), command).region
    assert not starts.area.contains(0.0, 3.0)
    read = readings(contact, 0.0, senses, friction, space.tolerance)
    known = kernel(space, read, starts, senses).area
    assert not known.contains(0.0, 3.0)
    assert not known.contains(0.15, 3.0)
    assert known.contains(0.25, 3.0)
    assert known.contains(-0.25, 3.0)
