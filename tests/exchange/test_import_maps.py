import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from preimage.configuration.obstacles import configuration_space
from preimage.errors import InputError
from preimage.exchange.importing import Imported, import_task
from preimage.exchange.occupancy import Mode, classified, map_info
from preimage.exchange.options import Unknown
from preimage.exchange.raster import Raster, read_raster
from preimage.task.goal import Goal
from preimage.task.initial import Everywhere
from preimage.task.workspace import PolygonObstacle

BLACK, GREY, WHITE = 0, 205, 254
INFO = {
    "image": "map.pgm",
    "resolution": 0.05,
    "origin": [-1.0, 2.0, 0.0],
    "negate": 0,
    "occupied_thresh": 0.65,
    "free_thresh": 0.196,
}
Levels = NDArray[np.uint8]


def pgm(levels: Levels) -> bytes:
    rows, columns = levels.shape
    return b"P5\n# CREATOR: map_saver.cpp\n%d %d\n255\n" % (columns, rows) + levels.tobytes()


def write(folder: Path, levels: Levels, **info: object) -> Path:
    (folder / "map.pgm").write_bytes(pgm(levels))
    path = folder / "map.yaml"
    path.write_text("".join(f"{key}: {value}\n" for key, value in {**INFO, **info}.items()))
    return path


def read(path: Path, **options: object) -> Imported:
    goal = Goal(polygons=(((-1e3, -1e3), (1e3, -1e3), (1e3, 1e3), (-1e3, 1e3)),))
    return import_task(path, initial=Everywhere(), goal=goal, **options)


def read_or_refuse(path: Path, **options: object) -> Imported | str:
    try:
        return read(path, **options)
    except InputError as error:
        return str(error)


def solids(found: Imported) -> shapely.Geometry:
    """What the obstacles hold."""
    return shapely.union_all(
        [
            shapely.Polygon(one.exterior, one.holes)
            for one in found.task.workspace.obstacles
            if isinstance(one, PolygonObstacle)
        ]
    )


@st.composite
def levels(draw: st.DrawFn) -> Levels:
    rows, columns = draw(st.integers(2, 8)), draw(st.integers(2, 8))
    cells = st.sampled_from([BLACK, GREY, WHITE, WHITE])
    found = draw(st.lists(cells, min_size=rows * columns, max_size=rows * columns))
    image = np.array(found, dtype=np.uint8).reshape(rows, columns)
    image[0, 0] = WHITE
    return image


@settings(max_examples=40)
@given(
    image=levels(),
    unknown=st.sampled_from(Unknown),
    yaw=st.sampled_from([0.0, 0.3, math.pi / 2, -2.0]),
    simplify=st.sampled_from([None, 0.0, 0.02]),
)
def test_obstacles_hold_all_cells_that_may_be_occupied(
    tmp_path_factory: pytest.TempPathFactory,
    image: Levels,
    unknown: Unknown,
    yaw: float,
    simplify: float | None,
) -> None:
    path = write(tmp_path_factory.mktemp("map"), image, origin=[-1.0, 2.0, yaw])
    found = read_or_refuse(path, unknown=unknown, simplify=simplify)
    if isinstance(found, str):
        assert "no free space" in found or "nothing of it is left" in found
        return
    solid = shapely.buffer(solids(found), 1e-9)
    turn = np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
    free = []
    for (row, column), level in np.ndenumerate(image[::-1]):
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) + np.array([column, row])
        cell = shapely.Polygon(0.05 * corners @ turn + (-1.0, 2.0))
        if level == BLACK or (level == GREY and unknown is Unknown.OCCUPIED):
            assert solid.covers(cell)
        else:
            free.append(cell)
    reach = 0.05 if simplify is None else simplify
    open_space = shapely.buffer(shapely.union_all(free), -reach - 1e-6)
    assert shapely.intersection(solids(found), open_space).area <= 1e-9


def test_a_cell_is_where_map_server_puts_it(tmp_path: Path) -> None:
    image = np.full((4, 6), WHITE, dtype=np.uint8)
    image[0, 5] = BLACK  # the upper right one
    found = read(write(tmp_path, image))
    assert solids(found).bounds == (-0.75, 2.15, -0.7, 2.2)
    assert found.task.workspace.window.bounds == (-1.0, 2.0, -0.7, 2.2)


def test_a_map_may_be_turned(tmp_path: Path) -> None:
    image = np.full((4, 6), WHITE, dtype=np.uint8)
    image[3, 0] = BLACK  # at the origin
    found = read(write(tmp_path, image, origin=[-1.0, 2.0, math.pi / 2]))
    assert found.task.workspace.window.bounds == pytest.approx((-1.2, 2.0, -1.0, 2.3))
    assert solids(found).bounds == pytest.approx((-1.05, 2.0, -1.0, 2.05))


def test_choices_may_be_words(tmp_path: Path) -> None:
    image = np.full((4, 6), WHITE, dtype=np.uint8)
    image[1, 1] = GREY
    path = write(tmp_path, image)
    assert solids(read(path, unknown="occupied")).area == pytest.approx(0.05**2)
    assert solids(read(path, unknown="free")).is_empty


def test_beyond_a_turned_map_nobody_has_seen_anything(tmp_path: Path) -> None:
    image = np.full((4, 6), WHITE, dtype=np.uint8)
    path = write(tmp_path, image, origin=[0.0, 0.0, 0.5])
    free = configuration_space(read(path).task).free.measure
    assert free == pytest.approx(24 * 0.05**2)
    found = read(path, unknown=Unknown.FREE)
    assert found.task.workspace.obstacles == ()


@given(
    st.lists(st.integers(0, 255), min_size=1, max_size=12),
    st.booleans(),
    st.sampled_from([Mode.TRINARY, Mode.SCALE]),
)
def test_levels_mean_what_map_server_says(values: list[int], negate: bool, mode: Mode) -> None:
    info = map_info({**INFO, "negate": int(negate), "mode": mode.value})
    solid, unknown = classified(Raster(np.array([values], dtype=np.uint8), 255), info)
    for place, value in enumerate(values):
        # image_loader.cpp: occ = (255 - color_avg) / 255.0
        occupied = (value if negate else 255 - value) / 255.0
        if occupied > 0.65:
            expected = (True, False)
        elif occupied < 0.196:
            expected = (False, False)
        else:
            expected = (False, True) if mode is Mode.TRINARY else (True, False)
        assert (solid[0, place], unknown[0, place]) == expected


def test_raw_levels_are_percentages() -> None:
    info = map_info({**INFO, "mode": "raw"})
    raster = Raster(np.array([[0, 1, 100, 101, 255]], dtype=np.uint8), 255)
    solid, unknown = classified(raster, info)
    assert solid.tolist() == [[False, True, True, False, False]]
    assert unknown.tolist() == [[False, False, False, True, True]]


IMAGE = np.array([[0, 100, 205], [254, 255, 30]], dtype=np.uint8)


@pytest.mark.parametrize("kind", ["P5", "P2", "P5 of 16 bits", "png", "png of 16 bits", "rgb", "1"])
def test_an_image_is_the_same_in_all_formats(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "image"
    text = " ".join(map(str, IMAGE.ravel()))
    expected = IMAGE / 255
    if kind == "P5":
        path.write_bytes(pgm(IMAGE))
    elif kind == "P2":
        path.write_bytes(b"P2 #a comment\n3 # another\n2\n255\n" + text.encode())
    elif kind == "P5 of 16 bits":
        wide = (IMAGE.astype(np.uint16) * 257).astype(">u2")
        path.write_bytes(b"P5 3 2 65535\n" + wide.tobytes())
    elif kind == "png":
        Image.fromarray(IMAGE).save(path, "PNG")
    elif kind == "png of 16 bits":
        Image.fromarray(IMAGE.astype(np.uint16) * 257).save(path, "PNG")
    elif kind == "rgb":
        Image.fromarray(IMAGE).convert("RGB").save(path, "PNG")
    else:
        Image.fromarray(IMAGE > 127).save(path, "PNG")
        expected = (IMAGE > 127).astype(float)
    raster = read_raster(path)
    np.testing.assert_allclose(raster.levels / raster.most, expected)
    assert raster.opaque is None


@pytest.mark.parametrize("mode", ["LA", "RGBA"])
def test_what_shines_through_was_never_seen(tmp_path: Path, mode: str) -> None:
    image = Image.fromarray(np.full((1, 3), WHITE, dtype=np.uint8)).convert(mode)
    image.putalpha(Image.fromarray(np.array([[255, 254, 0]], dtype=np.uint8)))
    image.save(tmp_path / "map.png")
    raster = read_raster(tmp_path / "map.png")
    solid, unknown = classified(raster, map_info(INFO))
    assert not solid.any()
    assert unknown.tolist() == [[False, True, True]]


def test_alpha_makes_no_cell_free_that_is_not(tmp_path: Path) -> None:
    # averaged with alpha, as map_server does, unseen cells of level 205 would be free
    image = Image.fromarray(np.array([[GREY, BLACK]], dtype=np.uint8)).convert("RGBA")
    image.save(tmp_path / "map.png")
    solid, unknown = classified(read_raster(tmp_path / "map.png"), map_info(INFO))
    assert (solid | unknown).all()


@pytest.mark.parametrize(
    ("changed", "rule"),
    [
        ({"resolution": 0}, "resolution: must be above 0"),
        ({"resolution": ".nan"}, "resolution: must be a finite number"),
        ({"origin": [0, 0]}, r"origin: must be \[x, y, yaw\], not 2 numbers"),
        ({"origin": "[0, 0, .inf]"}, r"origin\[2\]: must be a finite number"),
        ({"negate": "maybe"}, "negate: must be 0 or 1, not 'maybe'"),
        ({"negate": 1, "mode": "raw"}, "negate: must be 0 in the mode raw"),
        ({"free_thresh": 0.7}, "free_thresh: must be at most occupied_thresh"),
        ({"mode": "ternary"}, "mode: must be trinary, scale or raw, not 'ternary'"),
        ({"image": "none.pgm"}, "none.pgm: cannot be read: No such file"),
        ({"image": "/dev/zero"}, "/dev/zero: cannot be read: Is no regular file"),
        ({"image": "map.yaml"}, "map.yaml: is no PGM"),
    ],
)
def test_maps_are_refused_by_key(tmp_path: Path, changed: dict[str, object], rule: str) -> None:
    path = write(tmp_path, np.full((2, 2), WHITE, dtype=np.uint8), **changed)
    with pytest.raises(InputError, match=rule):
        read(path)


@pytest.mark.parametrize(
    ("content", "rule"),
    [
        (b"P5\n3 2\n255\n12345", "ends after 5 of 6 cells"),
        (b"P5\n3 2\n70000\n123456", "the largest value must be 1 to 65535"),
        (b"P5\n99999 99999\n255\n", "must have 64000000 cells or fewer"),
        (b"P5\n0 2\n255\n", "has no cells"),
        (b"P5\nx 2\n255\n", "has no PGM header"),
        (b"P2\n2 1\n255\n1", "ends after 1 of 2 cells"),
        (b"P2\n2 1\n255\n1 2" + b" " * 2000, "has more than 16 characters a cell"),
        (b"P2\n2 1\n255\n1 x", "has cells that are not whole numbers"),
        (b"P2\n2 1\n255\n1 99999999999999999999", "has a value above 255"),
        (b"P5\n2 1\n100\n\x01\xff", "has a value above 100"),
        (b"\x89PNG\r\n\x1a\nrest", "is no PNG that can be read"),
        (b"", "is no PGM"),
    ],
)
def test_damaged_images_are_refused(tmp_path: Path, content: bytes, rule: str) -> None:
    path = tmp_path / "map.pgm"
    path.write_bytes(content)
    with pytest.raises(InputError, match=rule):
        read_raster(path)


@pytest.mark.slow
def test_a_large_map_is_read(tmp_path: Path) -> None:
    size = 4000
    y, x = np.mgrid[:size, :size]
    image = np.full((size, size), WHITE, dtype=np.uint8)
    image[(np.abs((x * 0.98 + y * 0.2) % 400 - 200) < 3) & (y % 500 > 60)] = BLACK
    found = read(write(tmp_path, image))
    assert 100 < shapely.get_num_coordinates(solids(found)) < 5000
