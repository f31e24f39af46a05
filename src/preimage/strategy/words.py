"""Directions, places and regions in words, with the numbers that people want to see."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from preimage.configuration.contact import Floats
from preimage.configuration.region import Region
from preimage.configuration.space import ConfigurationSpace
from preimage.task.degrees import to_degrees

COMPASS = ("right", "up-right", "up", "up-left", "left", "down-left", "down", "down-right")
ARROWS = "→↗↑↖←↙↓↘"


def number(value: float) -> str:
    """A number with six digits.

    >>> number(2.0), number(0.30000000004)
    ('2', '0.3')
    """
    return f"{value + 0.0:.6g}"


def degrees(radians: float) -> str:
    """An angle with its unit."""
    return f"{number(to_degrees(radians))}°"


def direction_words(radians: float) -> str:
    """A direction of motion, in a word and in degrees.

    >>> from math import radians
    >>> direction_words(radians(270)), direction_words(radians(250))
    ('down (270°)', 'down and a little left (250°)')
    """
    angle = to_degrees(radians) % 360.0
    eighth = angle / 45.0
    if abs(eighth - round(eighth)) < 1e-9:
        word = COMPASS[round(eighth) % 8]
    else:
        quarter = round(angle / 90.0)
        main = COMPASS[2 * quarter % 8]
        side = COMPASS[2 * (quarter + (1 if angle > 90.0 * quarter else -1)) % 8]
        word = f"{main} and a little {side}"
    return f"{word} ({number(angle)}°)"


def arrow(radians: float) -> str:
    """The arrow nearest to a direction."""
    return ARROWS[round(to_degrees(radians) / 45.0) % 8]


def place(point: Sequence[float] | Floats) -> str:
    """A point.

    >>> place((1.0, -0.0))
    '(1, 0)'
    """
    return f"({number(float(point[0]))}, {number(float(point[1]))})"


def count(many: int, what: str, plural: str = "") -> str:
    """How many.

    >>> count(1, "edge"), count(2, "vertex", "vertices")
    ('1 edge', '2 vertices')
    """
    return f"{many} {what if many == 1 else plural or f'{what}s'}"


def joined(words: Iterable[str], last: str = "and") -> str:
    """A list in words.

    >>> joined(["a", "b", "c"])
    'a, b and c'
    """
    listed = list(words)
    if len(listed) < 2:
        return "".join(listed)
    return f"{', '.join(listed[:-1])} {last} {listed[-1]}"


def shortened(words: Iterable[str], most: int) -> list[str]:
    """At most so many of the words, and how many more there are."""
    listed = list(words)
    if len(listed) <= most:
        return listed
    return [*listed[: most - 1], f"{len(listed) - most + 1} more"]


def region_words(region: Region) -> str:
    """How large a region is: its free space and its contact."""
    contact = region.contact
    parts = []
    if not region.area.is_empty:
        parts.append(f"free space of area {number(region.area.measure)}")
    if len(contact.edge):
        pieces = count(len(contact.edge), "contact edge")
        parts.append(f"{pieces} of length {number(contact.total_length)}")
    if len(contact.vertices):
        parts.append(count(len(contact.vertices), "contact vertex", "contact vertices"))
    return joined(parts) or "nothing"


def contact_lines(region: Region, space: ConfigurationSpace, most: int = 4) -> list[str]:
    """The contact edges and vertices of a region with their places, one line each kind."""
    contact, inside = space.contact, region.contact
    starts, ends = contact.at(inside.edge, inside.low), contact.at(inside.edge, inside.high)
    edges = [f"{place(a)} to {place(b)}" for a, b in zip(starts[:most], ends[:most], strict=True)]
    corners = [place(point) for point in contact.points[inside.vertices[:most]]]
    lines = []
    for word, plural, shown, total in (
        ("edge", "edges", edges, len(inside.edge)),
        ("vertex", "vertices", corners, len(inside.vertices)),
    ):
        if total:
            more = [f"{total - len(shown)} more"] if total > len(shown) else []
            lines.append(f"{word if total == 1 else plural} {joined([*shown, *more])}")
    return lines
