"""What the command writes: lines for people, whole files, and refusals on one line."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from preimage.whole_file import is_special, write_whole

STANDARD = "-"
"""The path that stands for standard input and standard output."""


class RefusalError(Exception):
    """Input that is refused, or output that cannot be written: one line, exit status 2."""


def say(text: str, stream: TextIO | None = None) -> None:
    """Print for people; whoever has stopped listening is not talked to any more."""
    stream = sys.stdout if stream is None else stream
    if stream is None:
        return
    try:
        print(text, file=stream, flush=True)
    except BrokenPipeError:
        mute(stream)
    except OSError as error:
        mute(stream)
        raise RefusalError(f"standard output: cannot be written: {reason(error)}") from None


def mute(stream: TextIO) -> None:
    """Let what is still written to a broken stream go nowhere."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def note(text: str) -> None:
    """Print for people on standard error."""
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            print(text, file=sys.stderr, flush=True)


def reason(error: OSError | ValueError) -> str:
    """Why the system refused."""
    return (isinstance(error, OSError) and error.strerror) or str(error)


@contextlib.contextmanager
def about(source: str, renamed: dict[str, str] | None = None) -> Iterator[None]:
    """Refusals of the package inside become the command's, about this file or option.

    Parameters
    ----------
    source : what is read; it leads the line unless the refusal names it already.
    renamed : keys that have another name on the command line, which then stands alone.
    """
    from preimage.errors import InputError, PreimageError, one_line

    try:
        yield
    except InputError as error:
        for key, option in (renamed or {}).items():
            if error.key == key or error.key.startswith((f"{key}.", f"{key}[")):
                raise RefusalError(
                    one_line(f"{option}{error.key[len(key) :]}: {error.rule}")
                ) from None
        same = not source or error.key == source
        raise RefusalError(str(error) if same else f"{one_line(source)}: {error}") from None
    except PreimageError as error:
        words = one_line(": ".join(str(part) for part in error.args))
        raise RefusalError(f"{one_line(source)}: {words}" if source else words) from None


# --- files ----------------------------------------------------------------------------------


def check_outputs(inputs: list[str | None], **outputs: str | None) -> None:
    """Refuse at once files that could not be written at the end, by the option that names them.

    Parameters
    ----------
    inputs : files that are read, and must not be overwritten.
    outputs : by option: `output` may be standard output, `figure` must be a picture.
    """
    taken = {
        os.path.realpath(path): "the input itself"
        for path in inputs
        if path not in (None, STANDARD)
    }
    for option, path in outputs.items():
        if path is None:
            continue
        if option == "figure":
            _check_figure(path)
        elif option == "animate":
            _check_film(path)
        elif path == STANDARD:
            continue
        _check_writable(path)
        place = os.path.realpath(path)
        if place in taken and not is_special(Path(place)):
            raise RefusalError(f"{path}: is {taken[place]}")
        taken[place] = f"the file of --{option} too"


def _check_figure(path: str) -> None:
    from importlib.util import find_spec

    from preimage.rendering import format_of

    with about(path):
        format_of(path)
    if find_spec("matplotlib") is None:
        raise RefusalError("--figure: needs matplotlib: pip install 'preimage[draw]'")


def _check_film(path: str) -> None:
    from importlib.util import find_spec

    if find_spec("matplotlib") is None:
        raise RefusalError("--animate: needs matplotlib: pip install 'preimage[draw]'")
    from preimage.rendering.animation import film_format_of

    with about(path):
        film_format_of(path)


def _check_writable(path: str) -> None:
    import tempfile

    place = Path(os.path.realpath(path))
    try:
        if not path or place.is_dir():
            raise RefusalError(f"{path or repr('')}: is a directory, not a file")
        if is_special(place):
            if not os.access(place, os.W_OK):
                raise RefusalError(f"{path}: cannot be written: permission denied")
            return
        with tempfile.TemporaryFile(dir=place.parent):
            place.exists()  # a name that is too long is refused
    except (OSError, ValueError) as error:
        raise RefusalError(f"{path}: cannot be written: {reason(error)}") from None


def write(path: str, text: str) -> None:
    """Write a text to a file, or to standard output."""
    if path == STANDARD:
        say(text.removesuffix("\n"))
        return

    try:
        write_whole(path, text)
    except OSError as error:
        raise RefusalError(f"{path}: cannot be written: {reason(error)}") from None


def picture(subject: object, path: str, **options: object) -> None:
    """Draw something into a file."""
    from preimage.rendering import draw

    with about(path):
        try:
            draw(subject, path, **options)  # type: ignore[arg-type]  # which draw checks
        except OSError as error:
            raise RefusalError(f"{path}: cannot be written: {reason(error)}") from None
