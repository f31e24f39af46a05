"""Pictures for the documentation, in few bytes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from preimage import draw
from preimage.rendering import svg
from preimage.whole_file import write_whole

LARGEST = 150_000
"""Bytes: larger pictures are written as PNG."""

_CIRCLE = re.compile(r"M (\S+) (\S+) \n((?:C [^\n]*\n){8})z\n")
_HATCH = re.compile(r"<pattern .*?</pattern>", re.DOTALL)
_PATH = re.compile(r' d="[^"]*"')
_DECIMALS = re.compile(r"-?\d+\.\d{3,}")


def write_small(subject: Any, stem: Path, **options: Any) -> Path:
    """Draw as SVG if that is small, else as PNG; the file that was written.

    A picture of the other kind that is there from before is taken away.

    Parameters
    ----------
    stem : the file without its ending.
    options : as of `preimage.draw`.
    """
    text = smaller(svg(subject, **options)).encode("utf-8")
    path, other = (stem.with_name(f"{stem.name}.{ending}") for ending in ("svg", "png"))
    if len(text) > LARGEST:
        path, other = other, path
        draw(subject, path, **{"dpi": 100, **options})
    else:
        write_whole(path, text)
    other.unlink(missing_ok=True)
    return path


def smaller(picture: str) -> str:
    """The same SVG in fewer bytes: paths with two decimals, and arcs for the circles of hatches.

    >>> smaller('<path d="M 0.12345 1" transform="scale(0.085)"/>')
    '<path d="M 0.12 1" transform="scale(0.085)"/>'
    """
    picture = _HATCH.sub(lambda hatch: _CIRCLE.sub(_as_arcs, hatch[0]), picture)
    return _PATH.sub(lambda path: _DECIMALS.sub(_rounded, path[0]), picture)


def _rounded(match: re.Match[str]) -> str:
    return f"{float(match[0]):.2f}"


def _as_arcs(match: re.Match[str]) -> str:
    """Eight curves around a circle, which begin at its top, as two arcs."""
    x, top = float(match[1]), float(match[2])
    bottom = float(match[3].split("\n")[3].split()[-1])
    radius = 0.5 * abs(top - bottom)
    arc = f"a{radius:.2f} {radius:.2f} 0 1 0 0"
    return f"M{x:.2f} {top:.2f}{arc} {bottom - top:.2f}{arc} {top - bottom:.2f}z\n"
