"""Images of maps as grey levels: PGM, read here to the last bit, and PNG."""

from __future__ import annotations

import io
import re
import warnings
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preimage.errors import InputError, one_line
from preimage.exchange.reading import MAX_IMAGE_BYTES, bytes_of

MAX_PIXELS = 64_000_000
"""Cells of a map: 8000 by 8000."""

CHARACTERS = 16
"""Of a cell in letters: five, and a generous gap."""

_HEADER = re.compile(
    rb"(P[25])(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})"
    rb"(?:#[^\n]*\n|\s)"
)


@dataclass(frozen=True, slots=True, eq=False)
class Raster:
    """Grey levels, from 0 for black to `most` for white, the top row first.

    Parameters
    ----------
    levels : (rows, columns), the mean of an image's colours.
    most : of white.
    opaque : (rows, columns) where nothing shines through; `None` if the image has no alpha.
    colours : how many there are.
    """

    levels: NDArray[Any]
    most: int
    opaque: NDArray[np.bool_] | None = None
    colours: int = 1


def read_raster(path: Path) -> Raster:
    """The image of a map.

    Raises
    ------
    InputError : if it is no PGM or PNG, damaged, or too large; the key is the path.
    """
    content = bytes_of(path, MAX_IMAGE_BYTES)
    if content[:2] in (b"P2", b"P5"):
        return _pgm(content, str(path))
    if content[:8] == b"\x89PNG\r\n\x1a\n":
        return _png(content, str(path))
    raise InputError(str(path), "is no PGM (P2 or P5) and no PNG")


def _pgm(content: bytes, key: str) -> Raster:
    header = _HEADER.match(content)
    if header is None:
        raise InputError(key, "has no PGM header: P2 or P5, width, height, largest value")
    columns, rows, most = (int(header[group]) for group in (2, 3, 4))
    _check_size(columns, rows, key)
    if not 0 < most < 65536:
        raise InputError(key, f"the largest value must be 1 to 65535, not {most}")
    body = memoryview(content)[header.end() :]
    count = rows * columns
    if header[1] == b"P5":
        dtype = np.dtype(">u2" if most > 255 else "u1")
        if len(body) < count * dtype.itemsize:
            there = len(body) // dtype.itemsize
            raise InputError(key, f"ends after {there} of {count} cells")
        levels = np.frombuffer(body, dtype, count)
    else:
        if re.fullmatch(rb"[\d\s]*", body) is None:
            raise InputError(key, "has cells that are not whole numbers")
        if len(body) > CHARACTERS * count + 1000:
            raise InputError(key, f"has more than {CHARACTERS} characters a cell")
        levels = np.fromstring(bytes(body), dtype=np.int64, sep=" ")
        if len(levels) < count:
            raise InputError(key, f"ends after {len(levels)} of {count} cells")
        levels = levels[:count]
    if int(levels.max(initial=0)) > most:
        raise InputError(key, f"has a value above {most}, its largest")
    return Raster(levels.astype(np.uint16).reshape(rows, columns), most)


def _png(content: bytes, key: str) -> Raster:
    try:
        image_room: Any = import_module("PIL.Image")
    except ModuleNotFoundError:
        raise InputError(key, "needs pillow: pip install 'preimage[exchange]'") from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of sizes, which are checked here
            image = image_room.open(io.BytesIO(content), formats=["PNG"])
            _check_size(image.size[0], image.size[1], key)
            if image.mode != "I;16" and any("16" in str(tile[3]) for tile in image.tile):
                raise InputError(key, "has 16 bits a colour: save it in grey, or with 8")
            image.load()
            if image.mode in ("P", "PA") or "transparency" in image.info:
                image = image.convert("RGBA")
            elif image.mode == "1":
                image = image.convert("L")
            levels = np.asarray(image)
    except (OSError, ValueError, SyntaxError, image_room.DecompressionBombError) as error:
        raise InputError(key, f"is no PNG that can be read: {one_line(str(error))}") from None
    if levels.dtype == np.uint16:
        return Raster(levels, 65535)
    if levels.dtype != np.uint8:
        raise InputError(key, f"has pixels of kind {image.mode}, not grey or colours")
    if levels.ndim == 2:
        return Raster(levels, 255)
    has_alpha = levels.shape[2] in (2, 4)
    colours = levels[:, :, : levels.shape[2] - has_alpha]
    count = colours.shape[2]
    mean = colours.mean(axis=2, dtype=np.float64) if count > 1 else colours[:, :, 0]
    return Raster(mean, 255, levels[:, :, -1] == 255 if has_alpha else None, count)


def _check_size(columns: int, rows: int, key: str) -> None:
    if not columns or not rows:
        raise InputError(key, "has no cells")
    if columns * rows > MAX_PIXELS:
        raise InputError(key, f"must have {MAX_PIXELS} cells or fewer, not {columns * rows}")
