"""Tasks of every kind, and data that is nearly one."""

from __future__ import annotations

import copy
import math
from typing import Any

from hypothesis import strategies as st

from preimage.task import (
    ChainObstacle,
    Continuous,
    Everywhere,
    Goal,
    Initial,
    InitialDisc,
    InitialEdges,
    InitialPoint,
    InitialPolygon,
    Method,
    PlannerOptions,
    PolygonObstacle,
    Preference,
    Robot,
    SearchOrder,
    Side,
    SlidingLaw,
    SolidSide,
    StrategyKind,
    Task,
    Termination,
    Uncertainty,
    Window,
    Workspace,
    uniform_directions,
)

Point = tuple[float, float]
Ring = tuple[Point, ...]

coordinates = st.one_of(
    st.integers(-20, 20).map(float),
    st.floats(-20, 20).map(lambda value: round(value, 6)),
)
points = st.tuples(coordinates, coordinates)


@st.composite
def rings(draw: st.DrawFn, scale: float = 1.0) -> Ring:
    """A simple polygon around a point, either way round, perhaps with collinear vertices."""
    x, y = draw(points)
    count = draw(st.integers(3, 7))
    reaches = draw(st.lists(st.floats(0.5, 3.0), min_size=count, max_size=count))
    ring = [
        (
            x + scale * reach * math.cos(2 * math.pi * index / count),
            y + scale * reach * math.sin(2 * math.pi * index / count),
        )
        for index, reach in enumerate(reaches)
    ]
    if draw(st.booleans()):
        ring.insert(1, ((ring[0][0] + ring[1][0]) / 2, (ring[0][1] + ring[1][1]) / 2))
    return tuple(ring[::-1] if draw(st.booleans()) else ring)


@st.composite
def polygons(draw: st.DrawFn) -> PolygonObstacle:
    ring = draw(rings())
    if draw(st.booleans()):
        return PolygonObstacle(ring)
    x, y = draw(points)
    outer = ((x, y), (x, y + 9), (x + 9, y + 9), (x + 9, y))
    places = [(0.25, 1.0), (3.0, 3.0), (5.25, 5.0)][: draw(st.integers(1, 3))]
    holes = tuple(
        tuple((x + place + size * u, y + place + size * v) for u, v in ((0, 0), (1, 0), (1, 2)))
        for place, size in places
        if place + 2 * size < 9
    )
    return PolygonObstacle(outer, holes)


@st.composite
def chains(draw: st.DrawFn) -> ChainObstacle:
    places = sorted(draw(st.sets(st.integers(-20, 20), min_size=2, max_size=6)))
    line = tuple((float(x), draw(coordinates)) for x in places)
    way = draw(st.sampled_from((1, -1)))
    return ChainObstacle(line[::way], draw(st.sampled_from(SolidSide)))


edges = st.tuples(points, points).filter(lambda edge: math.dist(*edge) > 1e-3)
edge_tuples = st.lists(edges, min_size=1, max_size=3).map(tuple)
initials: st.SearchStrategy[Initial] = st.one_of(
    points.map(InitialPoint),
    st.builds(InitialDisc, points, st.floats(0.001, 10)),
    rings().map(InitialPolygon),
    edge_tuples.map(InitialEdges),
    st.just(Everywhere()),
)
goals = st.one_of(
    edge_tuples.map(lambda parts: Goal(edges=parts)),
    st.builds(
        Goal,
        edges=st.lists(edges, max_size=2).map(tuple),
        polygons=st.lists(rings(), min_size=1, max_size=2).map(tuple),
        points=st.lists(points, max_size=2).map(tuple),
    ),
    st.lists(points, min_size=1, max_size=3).map(lambda places: Goal(points=tuple(places))),
)
thresholds = st.lists(st.floats(0, 2), min_size=2, max_size=2).map(sorted).map(tuple)
uncertainties = st.builds(
    Uncertainty,
    st.floats(0, 1.57),
    st.one_of(st.just(math.inf), st.floats(0, 100)),
    st.floats(0, 3.14),
    st.one_of(st.just((math.inf, math.inf)), thresholds, st.just((0.05, 0.05))),
)
directions = st.one_of(
    st.just(Continuous()),
    st.integers(1, 40).map(lambda half: uniform_directions(2 * half)),
    st.lists(st.floats(-10, 10), min_size=1, max_size=9).map(tuple),
)
options = st.builds(
    PlannerOptions,
    directions=directions,
    method=st.sampled_from(Method),
    strategy=st.sampled_from(StrategyKind),
    termination=st.sampled_from(Termination),
    max_steps=st.integers(1, 64),
    search=st.sampled_from(SearchOrder),
    time_limit=st.one_of(st.none(), st.floats(1e-3, 1e6)),
    max_regions=st.integers(1, 10**7),
    arc_tolerance=st.floats(1e-6, 0.1),
    resolution=st.floats(1e-5, 0.7),
    or_fail=st.booleans(),
    prefer=st.sampled_from(Preference),
)
robots = st.one_of(st.just(Robot()), st.builds(Robot, rings(0.2), points))
names = st.one_of(
    st.sampled_from(("peg", "true", "1e-3", "null", "no", "a: b", "'\"#", "ρ 😀", "inf", "[x]")),
    st.text(min_size=1, max_size=20).filter(lambda name: name.isprintable() and bool(name.strip())),
)
windows = st.builds(
    Window, st.floats(-50, -25), st.floats(-50, -25), st.floats(30, 90), st.floats(30, 90)
)
workspaces = st.builds(
    Workspace,
    windows,
    st.frozensets(st.sampled_from(Side)),
    st.lists(st.one_of(polygons(), chains()), max_size=4).map(tuple),
)
tasks = st.builds(
    Task,
    name=names,
    workspace=workspaces,
    robot=robots,
    uncertainty=uncertainties,
    friction=st.floats(0, 1.57),
    sliding=st.sampled_from(SlidingLaw),
    initial=initials,
    goal=goals,
    options=options,
)

garbage: st.SearchStrategy[Any] = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(max_size=8),
        st.sampled_from((0, 1, -1, 8, 90, 180, 1e9, 1e-320, 10**400, math.inf, math.nan)),
        st.sampled_from(("inf", ".inf", "none", "point", "everywhere", "continuous", "left")),
        st.binary(max_size=2),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=5),
        st.dictionaries(
            st.one_of(
                st.sampled_from(("polygon", "holes", "chain", "solid", "edges", "points")),
                st.text(max_size=4),
                st.integers(),
            ),
            inner,
            max_size=4,
        ),
    ),
    max_leaves=12,
)


def _places(data: Any, place: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    inner = (
        data.items()
        if isinstance(data, dict)
        else enumerate(data)
        if isinstance(data, list)
        else ()
    )
    return [place, *(deep for key, value in inner for deep in _places(value, (*place, key)))]


@st.composite
def mutated(draw: st.DrawFn, originals: tuple[dict[str, Any], ...]) -> Any:
    """One of the originals with something replaced, removed or repeated in a few places."""
    data: Any = copy.deepcopy(draw(st.sampled_from(originals)))
    for _ in range(draw(st.integers(1, 3))):
        places = _places(data)[1:]
        if not places:
            break
        *outer, last = draw(st.sampled_from(places))
        holder = data
        for key in outer:
            holder = holder[key]
        match draw(st.sampled_from(("replace", "remove", "repeat", "nudge"))):
            case "replace":
                holder[last] = draw(garbage)
            case "remove":
                del holder[last]
            case "repeat" if isinstance(holder, list):
                holder.insert(last, copy.deepcopy(holder[last]))
            case "nudge" if isinstance(holder[last], int | float):
                holder[last] = holder[last] * draw(st.floats(-2, 2)) + draw(st.integers(-5, 5))
            case _:
                pass
    return data
