"""Configuration space: where the robot's reference point may be."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from preimage.configuration import contact_set
from preimage.configuration.contact import ContactSpace
from preimage.configuration.region import Region
from preimage.display import Shown
from preimage.geometry.area import Area
from preimage.geometry.porous import Porous
from preimage.geometry.tolerance import Tolerance


@dataclass(frozen=True, eq=False)
class ConfigurationSpace(Shown):
    """Free space in the window, its border, and the tolerance that goes with its scale.

    Parameters
    ----------
    window : `xmin, ymin, xmax, ymax`.
    free : free space, closed; noded on the tolerance's grid.
    obstacles : the C-obstacles united, clipped to a box somewhat larger than the window.
    contact : the border of `free`, loop by loop.
    """

    window: tuple[float, float, float, float]
    tolerance: Tolerance
    free: Area
    obstacles: Area
    contact: ContactSpace

    @cached_property
    def porous(self) -> Porous:
        """Free space with its holes in a search tree, for work that is local."""
        return Porous(self.free)

    @property
    def valid(self) -> Region:
        """All of valid space: free space, and contact space but where it meets the open border.

        Who is on an open side of the window has escaped, also at a vertex between it and an edge.
        """
        return Region(self.free, contact_set.inner(self.contact))
