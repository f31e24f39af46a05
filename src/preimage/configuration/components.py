"""The components of free space."""

from __future__ import annotations

from preimage.configuration.space import ConfigurationSpace
from preimage.geometry.area import Area


def components(space: ConfigurationSpace) -> tuple[Area, ...]:
    """The connected components of free space; those that touch in a pinch alone are two.

    A pinch is solid (theory 1), so no motion leads from one component to another.
    """
    return space.free.parts
