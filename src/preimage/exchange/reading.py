"""Files as bytes and text, of a size that can be looked at."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from preimage.errors import InputError

MAX_BYTES = 64 * 2**20
"""Size of a drawing."""

MAX_IMAGE_BYTES = 512 * 2**20
"""Size of the image of a map, which may be a number a cell in letters."""


def bytes_of(path: str | os.PathLike[str], most: int = MAX_BYTES) -> bytes:
    """The content of a regular file.

    Raises
    ------
    InputError : if it cannot be read, or is larger than `most`; the key is the path.
    """
    try:
        with open(path, "rb", opener=_open_regular) as file:
            content = file.read(most + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InputError(str(path), f"cannot be read: {reason}") from None
    if len(content) > most:
        raise InputError(str(path), f"must be {most // 2**20} MiB or less")
    return content


def text_of(path: str | os.PathLike[str]) -> str:
    """The text of a file in UTF-8.

    Raises
    ------
    InputError : if it cannot be read; the key is the path.
    """
    try:
        return bytes_of(path).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(str(path), f"is not UTF-8 at byte {error.start}") from None


def beside(path: str | os.PathLike[str], name: str) -> Path:
    """The file that another one names, seen from where that lies."""
    return Path(path).parent / name


def _open_regular(path: str, flags: int) -> int:
    """Open a regular file, and wait for no other."""
    file = os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
    mode = os.fstat(file).st_mode
    if not stat.S_ISREG(mode):
        os.close(file)
        raise OSError(None, "Is a directory" if stat.S_ISDIR(mode) else "Is no regular file")
    return file
