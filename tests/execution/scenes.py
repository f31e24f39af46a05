"""Robots anywhere in random scenes, as arrays and as states of the test suite's own world."""

import math
from random import Random

import numpy as np

from preimage.configuration.space import ConfigurationSpace
from preimage.execution.simulator import Choices, Robots, Wish
from tests.laws.world import AtVertex, Free, Lost, OnEdge, State


def state_of(space: ConfigurationSpace, robots: Robots, index: int) -> State:
    n, feature = len(space.contact), int(robots.feature[index])
    if feature == 2 * n:
        return Free(float(robots.x[index]), float(robots.y[index]))
    if feature >= n:
        return AtVertex(feature - n)
    return OnEdge(feature, float(robots.along[index]))


def somewhere(space: ConfigurationSpace, rng: Random, count: int) -> Robots:
    """Robots in free space, on contact edges, at contact vertices."""
    contact = space.contact
    xmin, ymin, xmax, ymax = space.window
    places = np.array([(rng.uniform(xmin, xmax), rng.uniform(ymin, ymax)) for _ in range(count)])
    inside = np.array([space.free.depth(*p) > 1e-6 for p in places.tolist()])
    inside &= space.free.contains_all(places)
    edge = np.array([rng.choice(contact.edges.tolist()) for _ in range(count)], dtype=np.int32)
    share = np.array([rng.uniform(0.01, 0.99) for _ in range(count)])
    whole = contact.vertices[
        ~(contact.open[contact.vertices] | contact.open[contact.previous[contact.vertices]])
    ]
    corners = whole[[rng.randrange(len(whole)) for _ in range(count)]] if len(whole) else whole
    return Robots.together(
        Robots.free(contact, places[inside]),
        Robots.on_edges(contact, edge, share * contact.length[edge]),
        Robots.at_vertices(contact, corners),
    )


def chosen(rng: Random, count: int, longest: float = math.inf) -> Choices:
    """Any directions, some of them along the axes."""
    angle = [
        rng.choice((rng.uniform(-math.pi, math.pi), rng.randrange(-4, 5) * math.pi / 4))
        for _ in range(count)
    ]
    return Choices(
        np.array(angle),
        np.array([min(longest, rng.choice((0.01, 0.5, math.inf))) for _ in range(count)]),
        np.array([rng.choice(list(Wish)) for _ in range(count)], dtype=np.uint8),
        np.array([rng.random() for _ in range(count)]),
    )


def agree(space: ConfigurationSpace, ours: State | Lost, theirs: State | Lost, near: float) -> bool:
    """Whether two states are one, up to rounding."""
    match ours, theirs:
        case Free(x, y), Free(u, v):
            return math.hypot(x - u, y - v) <= near
        case OnEdge(edge, along), OnEdge(other, there):
            return edge == other and abs(along - there) <= near
        case AtVertex(vertex), AtVertex(other):
            return vertex == other
        case _:
            return ours is theirs
