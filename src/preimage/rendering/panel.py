"""A panel: axes of known scale that show one window, and what lies in them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from preimage.configuration.space import ConfigurationSpace
from preimage.rendering.lanes import Lanes
from preimage.rendering.placing import TAKEN, Lattice
from preimage.rendering.style import Layer

Box = tuple[float, float, float, float]

POINTS_AN_INCH = 72.0

FRAME = 5.0
"""Points: how wide walls and other closed sides are drawn around the window."""

BEYOND = 0.4
"""What it costs to write in a cell beyond the window."""


@dataclass(slots=True, eq=False)
class Panel:
    """Axes that show a window, with equal scales.

    Parameters
    ----------
    axes : their limits are those of the window and a margin around it.
    name : what the panel shows, as in the ids of an SVG: `scene`, `motion-2`, …
    unit : the length of a point on paper, in the task's unit of length.
    lattice : what has been drawn where, for those that look for room.
    lanes : the lines drawn beside contact edges.
    layers : the layers drawn so far, in order, each with its parts; "" is its area.
    """

    axes: Axes
    name: str
    space: ConfigurationSpace
    unit: float
    lattice: Lattice
    lanes: Lanes
    layers: dict[Layer, set[str]] = field(default_factory=dict)
    ids: set[str] = field(default_factory=set)

    @classmethod
    def of(cls, axes: Axes, name: str, space: ConfigurationSpace, unit: float, box: Box) -> Panel:
        """An empty panel.

        Parameters
        ----------
        box : the window, and what else has to be seen; beyond it there may be room for letters.
        """
        lanes = Lanes(space.contact, space.tolerance.length)
        (xmin, xmax), (ymin, ymax) = axes.get_xlim(), axes.get_ylim()
        lattice = Lattice((xmin, ymin, xmax, ymax), unit)
        lattice.cost += BEYOND
        frame = FRAME * unit
        for margin, cost in ((frame, TAKEN), (0.0, -TAKEN - BEYOND)):
            column = (lattice.x > box[0] - margin) & (lattice.x < box[2] + margin)
            row = (lattice.y > box[1] - margin) & (lattice.y < box[3] + margin)
            lattice.cost[np.ix_(row, column)] += cost
        return cls(axes, name, space, unit, lattice, lanes)

    def add(self, artist: Artist, layer: Layer, part: str = "", number: int | None = None) -> None:
        """Draw an artist, named after its layer: its label, and with panel and part its gid.

        Parameters
        ----------
        part : which part of the layer it is; empty for the area itself.
        number : of a region, in the plan.
        """
        words = [layer.value, *([] if number is None else [str(number)]), *([part] if part else [])]
        gid = f"{self.name}-{'-'.join(words)}"
        copy = 1
        while gid in self.ids:
            copy += 1
            gid = f"{self.name}-{'-'.join(words)}-{copy}"
        self.ids.add(gid)
        artist.set_gid(gid)
        artist.set_label("-".join(words))
        self.axes.add_artist(artist)
        self.layers.setdefault(layer, set()).add(part)

    def points(self, length: float) -> float:
        """A length of the task, in points on paper."""
        return length / self.unit
