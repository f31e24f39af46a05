"""Where nature can hold a robot up: what every feature may do under one command (theory 4, 1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from preimage.configuration.contact import ContactSpace
from preimage.geometry.tolerance import Tolerance
from preimage.mechanics.behaviour import (
    Behaviour,
    Codes,
    concave_vertex_behaviour,
    convex_vertex_behaviour,
    edge_behaviour,
)


@dataclass(frozen=True, eq=False)
class Sources:
    """The behaviour of all features of a contact space for one commanded direction.

    Parameters
    ----------
    direction, control : the command v and its uncertainty theta, radians.
    edges, vertices : (n,) bits of `Behaviour`, by edge and by vertex.
    """

    direction: float
    control: float
    edges: Codes
    vertices: Codes

    def where(self, behaviour: Behaviour) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which edges and which vertices have this behaviour."""
        bit = np.uint8(behaviour)
        return (self.edges & bit) != 0, (self.vertices & bit) != 0


def sources(
    contact: ContactSpace, direction: float, control: float, friction: float, tolerance: Tolerance
) -> Sources:
    """What edges and vertices may do to a motion along `direction` (theory 2), ties for nature.

    Open sides of the window have no behaviour; beside one, a vertex has that of its contact edge.
    """
    slack = tolerance.angle
    edges = edge_behaviour(contact.normal, direction, control, friction, slack)
    edges[contact.open] = 0
    incoming = contact.previous
    convex = convex_vertex_behaviour(edges[incoming], edges)
    concave = concave_vertex_behaviour(
        contact.normal[incoming], contact.normal, direction, control, friction, slack
    )
    both = ~(contact.open | contact.open[incoming])
    vertices = np.where(contact.concave & both, concave, convex)
    return Sources(direction, control, edges, vertices)
