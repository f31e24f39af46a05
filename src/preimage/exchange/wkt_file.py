"""Well-known text with roles: lines `name: WKT`."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from preimage.errors import InputError, one_line
from preimage.exchange.drawing import NAMES, Drawing, Figure, Role, role_named
from preimage.exchange.geojson_file import figures_of
from preimage.exchange.options import ImportOptions
from preimage.exchange.reading import text_of
from preimage.geometry.wkt import from_wkt

_NAMED = re.compile(r"\s*([^\s:(),;][^:(),;]*?)\s*:(.*)", re.DOTALL)


def read_wkt(path: Path, options: ImportOptions) -> Drawing:
    """The drawing of a file of lines `name: WKT`; a line goes on until its brackets close.

    What follows a `#` is a comment, empty lines do not count, and what has no name is an obstacle.

    Raises
    ------
    InputError : with the number of the line.
    """
    if options.units is not None:
        raise InputError("units", "WKT has none: leave this out")
    names = {**NAMES, **options.layers}
    figures: list[Figure] = []
    ignored: Counter[str] = Counter()
    for number, text in _statements(text_of(path)):
        match = _NAMED.fullmatch(text)
        name, geometry = (match[1], match[2]) if match else ("", text)
        role = role_named(name, names) if name else Role.OBSTACLES
        if role is None:
            ignored[f"lines named {one_line(name[:40])}"] += 1
            continue
        place = f"line {number} ({one_line(name[:40])})" if name else f"line {number}"
        figures += figures_of(from_wkt(geometry.strip().rstrip(";"), place), role, place)
    return Drawing("WKT", tuple(figures), ignored=ignored)


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Texts whose brackets close, each with the number of its first line."""
    waiting: list[str] = []
    begun = depth = 0
    for number, line in enumerate(text.splitlines(), 1):
        line = line.partition("#")[0]
        if not line.strip() and not waiting:
            continue
        begun = begun if waiting else number
        waiting.append(line)
        depth += line.count("(") - line.count(")")
        if depth <= 0 and line.rstrip()[-1:] != ":":
            yield begun, "\n".join(waiting)
            waiting, depth = [], 0
    if waiting:
        yield begun, "\n".join(waiting)
