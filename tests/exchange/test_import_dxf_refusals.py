"""DXF drawings that are refused, with the place and the cause."""

from pathlib import Path
from typing import Any

import pytest

from preimage.errors import InputError
from preimage.task.goal import Goal
from tests.exchange.dxf_drawings import (
    GOAL,
    ON,
    Draw,
    drawn,
    read,
    square,
)

REFUSED: list[tuple[Draw, str]] = [
    (lambda space: None, "no layer has a role: the names that are known are"),
    (lambda space: space.add_line((0, 0), (5, 5), dxfattribs=ON), "LINE .* is open, from"),
    (
        lambda space: (square(space), space.add_point((0, 0), dxfattribs=ON)),
        "POINT .* is a point, which is no obstacles",
    ),
    (
        lambda space: space.add_lwpolyline(
            [(0, 0), (1, 1), (1, 0), (0, 1)], close=True, dxfattribs=ON
        ),
        "LWPOLYLINE .* crosses itself: edges 0 and 2 cross",
    ),
    (
        lambda space: [
            space.add_line((0, 0), end, dxfattribs=ON) for end in ((1, 0), (0, 1), (1, 1))
        ],
        r"layer obstacles: 3 ends of lines meet at \(0, 0\)",
    ),
    (
        lambda space: space.add_rational_spline(
            [(0, 0), (1, 1), (2, 0), (3, 1)], [1, 2, 1, 1], dxfattribs=ON
        ),
        "SPLINE .* is a rational spline",
    ),
    (
        lambda space: space.add_spline([(0, 0), (1, 1), (2, 0)], dxfattribs=ON),
        "SPLINE .* has fit points only",
    ),
    (
        lambda space: space.add_circle((0, 0), 1, dxfattribs={**ON, "extrusion": (1, 0, 0)}),
        "CIRCLE .* is not in the plane",
    ),
    (
        lambda space: space.add_lwpolyline(
            [(0, 0, 1, 1), (9, 0, 1, 1), (9, 9, 1, 1)], close=True, dxfattribs=ON
        ),
        "LWPOLYLINE .* has a width",
    ),
    (
        lambda space: space.add_lwpolyline(
            [(0, 0), (9, 0), (9, 9)], close=True, dxfattribs={**ON, "const_width": 0.5}
        ),
        "LWPOLYLINE .* has a width",
    ),
    (
        lambda space: space.add_polyline2d(
            [(0, 0), (9, 0), (9, 9)], close=True, dxfattribs={**ON, "default_end_width": 0.5}
        ),
        "POLYLINE .* has a width",
    ),
    (
        lambda space: space.add_3dface([(0, 0), (9, 0), (9, 9)], dxfattribs=ON),
        "3DFACE .* is of a kind that is not understood",
    ),
    (
        lambda space: space.add_blockref("NONE", (0, 0), dxfattribs=ON),
        "layer obstacles, INSERT .* cannot be taken apart",
    ),
    (lambda space: space.add_circle((1e12, 0), 1, dxfattribs=ON), "coordinates must be finite"),
    (
        lambda space: (
            square(space),
            space.add_arc((0, 0), 5, 0, 90, dxfattribs={"layer": "goal"}),
        ),
        "layer goal, ARC .* is curved",
    ),
    (
        lambda space: (
            square(space),
            space.add_line((0, 11), (5, 11), dxfattribs={"layer": "goal"}),
        ),
        r"layer goal, LINE .* \(goal.edges\[1\]\): does not lie in contact space",
    ),
]


@pytest.mark.parametrize(("draw", "rule"), REFUSED)
def test_drawings_are_refused_by_place(tmp_path: Path, draw: Draw, rule: str) -> None:
    goal = Goal(edges=(((0, 10), (5, 10)),)) if "goal" in rule else GOAL
    with pytest.raises(InputError, match=rule):
        read(drawn(tmp_path, draw), goal=goal)


@pytest.mark.slow
def test_a_bomb_of_blocks_is_refused(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        names = [f"B{k}" for k in range(8)]
        for k, name in enumerate(names):
            block = space.doc.blocks.new(name)
            for _ in range(10):
                if k:
                    block.add_blockref(names[k - 1], (0, 0))
                else:
                    block.add_line((0, 0), (1, 1))
        space.add_blockref(names[-1], (0, 0), dxfattribs=ON)

    with pytest.raises(InputError, match="must have 100000 entities or fewer"):
        read(drawn(tmp_path, draw))


@pytest.mark.parametrize(
    "content", [b"", b"0\nSECTION\n", b"\x00\xff" * 50, b"0\nSECTION\n2\nENTITIES\n0\nLINE\n"]
)
def test_damaged_files_are_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "damaged.dxf"
    path.write_bytes(content)
    with pytest.raises(InputError):
        read(path)
