import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from preimage.errors import InputError
from preimage.task.workspace import ChainObstacle, SolidSide
from tests.exchange.dxf_drawings import (
    ABOVE,
    BELOW,
    ON,
    drawn,
    read,
    sampled_bulge,
    solids,
)


def test_an_open_line_is_what_is_said(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        space.add_lwpolyline(
            [(0, 0, 0, 0, 0.3), (20, 0, 0, 0, 0), (20, 20, 0, 0, 0)], dxfattribs=ON
        )

    path = drawn(tmp_path, draw)
    with pytest.raises(InputError, match="is open"):
        read(path)
    arc = shapely.points(np.array(sampled_bulge((0, 0), (20, 0), 0.3)))
    for side, far, goal in ((SolidSide.LEFT, 90, BELOW), (SolidSide.RIGHT, -90, ABOVE)):
        (chain,) = read(path, chains=side, goal=goal).task.workspace.obstacles
        assert isinstance(chain, ChainObstacle)
        assert chain.solid is side
        # its first edge is the arc's, so the chain is closed far away on the solid side
        solid = shapely.Polygon([*chain.points, (20, 90), (-90, 90), (-90, far), (0, far)])
        if side is SolidSide.RIGHT:
            solid = shapely.Polygon([*chain.points, (90, 20), (90, far), (0, far)])
        assert shapely.distance(solid, arc).max() <= 1e-9
        assert shapely.distance(shapely.LineString(chain.points), arc).max() <= 0.1
    walls = solids(read(path, thickness=2.0))
    assert walls.covers(shapely.LineString([(20, 0), (20, 20)]).buffer(1 - 1e-9, quad_segs=64))
    assert all(walls.covers(disc) for disc in shapely.buffer(arc, 1 - 1e-9, quad_segs=64))


def test_polylines_of_old_files_are_read(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        rows = [(0, 0, 0, 0, 1), (10, 0, 0, 0, 0), (10, 10, 0, 0, 0), (0, 10, 0, 0, 0)]
        space.add_polyline2d(rows, format="xyseb", close=True, dxfattribs=ON)
        corners = [(40, 0, 1), (50, 0, 2), (50, 10, 3)]
        space.add_polyline3d(corners, close=True, dxfattribs=ON)
        space.add_solid([(60, 0), (70, 0), (60, 10), (70, 10)], dxfattribs=ON)

    first, second, third = solids(read(drawn(tmp_path, draw), curves=0.01)).geoms
    assert first.area == pytest.approx(100 + 12.5 * math.pi, abs=0.2)
    assert first.bounds == pytest.approx((0, -5, 10, 10), abs=0.02)
    assert second.equals(shapely.Polygon([(40, 0), (50, 0), (50, 10)]))
    assert third.equals(shapely.box(60, 0, 70, 10))


def test_a_chain_goes_the_way_of_its_first_piece(tmp_path: Path) -> None:
    def right(space: Any) -> None:
        space.add_line((10, 0), (20, 0), dxfattribs=ON)
        space.add_line((10, 0), (0, 5), dxfattribs=ON)

    def left(space: Any) -> None:
        space.add_line((20, 0), (10, 0), dxfattribs=ON)
        space.add_line((0, 5), (10, 0), dxfattribs=ON)

    for draw, turn, goal in ((right, 1, BELOW), (left, -1, ABOVE)):
        found = read(drawn(tmp_path, draw), chains=SolidSide.LEFT, goal=goal)
        (chain,) = found.task.workspace.obstacles
        assert isinstance(chain, ChainObstacle)
        assert chain.points == ((0.0, 5.0), (10.0, 0.0), (20.0, 0.0))[::turn]
