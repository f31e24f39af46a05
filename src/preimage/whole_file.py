"""Files written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import stat
import tempfile
from collections.abc import Iterator
from pathlib import Path


def write_whole(path: str | os.PathLike[str], content: str | bytes) -> None:
    """Write a file: it has its old content until it has all of the new one.

    Text is written as UTF-8, lines end in a line feed. What is no regular file, such as a pipe or
    a terminal, is written to as it stands.

    Raises
    ------
    OSError : if it cannot be written; then nothing of it is left behind.
    """
    data = content.encode("utf-8") if isinstance(content, str) else content
    with written_whole(path) as target:
        target.write_bytes(data)


@contextlib.contextmanager
def written_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A path beside this one, with the same ending, that takes its place at the end.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with written_whole(Path(folder, "plan.json")) as target:
    ...         _ = target.write_text("{}")
    ...     [found.name for found in Path(folder).iterdir()]
    ['plan.json']
    """
    final = Path(os.path.realpath(path))  # a link stays one
    if is_special(final):
        yield final
        return
    handle, name = tempfile.mkstemp(final.suffix, f".{final.stem[:100]}-", final.parent)
    target = Path(name)
    try:
        os.fchmod(handle, _permissions(final))
        os.close(handle)
        yield target
        os.replace(target, final)
    except BaseException:
        target.unlink(missing_ok=True)
        raise


def is_special(path: Path) -> bool:
    """Whether it is there and no regular file: a pipe, a terminal, the null device."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def _permissions(path: Path) -> int:
    """Those of the file that is replaced, or what a new file gets."""
    try:
        return stat.S_IMODE(path.stat().st_mode)
    except FileNotFoundError:
        mask = os.umask(0)
        os.umask(mask)
        return 0o666 & ~mask
