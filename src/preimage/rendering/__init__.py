"""Pictures, the only room that knows matplotlib; it is loaded when the first one is drawn."""

from preimage.rendering.picture import Format, draw, figure, format_of, svg

__all__ = ["Format", "draw", "figure", "format_of", "svg"]
