"""How objects show themselves in a notebook, without their rooms knowing the one that draws."""

from __future__ import annotations

from collections.abc import Callable


class Shown:
    """Something that has a picture."""

    __slots__ = ()

    def _repr_svg_(self) -> str | None:
        """The picture that a notebook shows; none without the means to draw it."""
        try:
            return _painter(self)
        except ImportError:
            return None


def _no_picture(_subject: object) -> str | None:
    return None


_painter: Callable[[object], str | None] = _no_picture


def paint_with(painter: Callable[[object], str | None]) -> None:
    """Have objects drawn by this function; the front door of the package names the one."""
    global _painter
    _painter = painter
