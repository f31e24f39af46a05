"""Pictures, the only room that knows matplotlib; it is loaded when the first one is drawn."""

from preimage.rendering.animation import FilmFormat, animate, film_format_of
from preimage.rendering.picture import Format, draw, figure, format_of, svg

__all__ = [
    "FilmFormat",
    "Format",
    "animate",
    "draw",
    "figure",
    "film_format_of",
    "format_of",
    "svg",
]
