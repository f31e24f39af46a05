"""What was understood of a task: its obstacles, its bounds, and what its features do."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from preimage.configuration.components import components
from preimage.configuration.contact import ContactSpace, Ints
from preimage.configuration.goals import goal_region
from preimage.configuration.space import ConfigurationSpace
from preimage.configuration.start import Start, covered, start_region
from preimage.mechanics.behaviour import Behaviour, Codes
from preimage.reachability.sources import Sources, sources
from preimage.strategy.describe import start_words
from preimage.strategy.words import (
    arrow,
    contact_lines,
    count,
    degrees,
    direction_words,
    joined,
    number,
    place,
    region_words,
    shortened,
)
from preimage.task.options import Continuous
from preimage.task.task import Task
from preimage.task.workspace import ChainObstacle, Side

MOST_FEATURES = 40
"""So many edges, and so many vertices, get a line of their own."""

MOST_DIRECTIONS = 8
"""So many directions get a column of their own."""

WORDS: tuple[tuple[str, str], ...] = (
    ("sticks", "sticks for sure"),
    ("may stick", "may stick, slide or leave"),
    ("slides", "slides for sure"),
    ("slides off", "slides or leaves"),
    ("leaves", "leaves for sure, or is never met"),
)
"""What a feature does, from the firmest hold to none, and what that means."""

SHAPES = ("concave", "convex", "at the open border")
"""Of vertices."""

STICKS, MAY_STICK, SLIDES, SLIDES_OFF, LEAVES = range(len(WORDS))


def survey(task: Task, space: ConfigurationSpace) -> str:
    """An account of a task in its configuration space.

    Raises
    ------
    TaskError : if the goal or the start has no place there.
    """
    lines = [*_given(task, space), *_found(task, space), ""]
    chosen = task.options.directions
    if isinstance(chosen, Continuous):
        lines.append("directions   all")
    else:
        every = [
            sources(space.contact, one, task.uncertainty.control, task.friction, space.tolerance)
            for one in chosen
        ]
        lines += _counts(every, space.contact)
        lines += _features(every[:MOST_DIRECTIONS], space.contact)
    return "\n".join(lines)


def edge_words(codes: Codes) -> Ints:
    """(n,) which of `WORDS` says what edges do, by their bits of `Behaviour`."""
    sticks = (codes & Behaviour.STICKS_SURELY) != 0
    may_stick = (codes & Behaviour.MAY_STICK) != 0
    slides = (codes & Behaviour.MAY_SLIDE) != 0
    leaves = (codes & Behaviour.MAY_LEAVE) != 0
    return np.select(
        [sticks, may_stick, slides & ~leaves, slides],
        [STICKS, MAY_STICK, SLIDES, SLIDES_OFF],
        LEAVES,
    ).astype(np.int32)


def vertex_words(codes: Codes) -> Ints:
    """(n,) the same for vertices, which stick, may stick, or do not hold."""
    sticks = (codes & Behaviour.STICKS_SURELY) != 0
    may_stick = (codes & Behaviour.MAY_STICK) != 0
    return np.select([sticks, may_stick], [STICKS, MAY_STICK], LEAVES).astype(np.int32)


# --- what was said --------------------------------------------------------------------------


def _given(task: Task, space: ConfigurationSpace) -> Iterator[str]:
    xmin, ymin, xmax, ymax = (number(bound) for bound in task.workspace.window.bounds)
    walls = [side.value for side in Side if side in task.workspace.walls]
    closed = f"walls on {joined(walls)}" if walls else "no walls"
    yield task.name
    yield f"window       x {xmin} to {xmax}, y {ymin} to {ymax}; {closed}"
    yield f"obstacles    {_obstacles(task)}"
    yield f"robot        {_robot(task)}"
    bounds = task.uncertainty
    position = f"error {number(bounds.position)}" if bounds.has_position_sensor else "no sensor"
    yield f"control      within {degrees(bounds.control)} of the commanded direction"
    yield f"position     {position}"
    yield f"force        {_force(task)}"
    slope = number(float(np.tan(task.friction))) if task.friction < 1.57 else "very large"
    yield (
        f"friction     {degrees(task.friction)} (coefficient {slope}),"
        f" sliding by {task.sliding.value}"
    )


def _obstacles(task: Task) -> str:
    obstacles = task.workspace.obstacles
    if not obstacles:
        return "none"
    chains = sum(isinstance(one, ChainObstacle) for one in obstacles)
    polygons = len(obstacles) - chains
    corners = sum(len(ring) for one in obstacles for _, ring in one.rings)
    kinds = [count(polygons, "polygon")] if polygons else []
    kinds += [count(chains, "unbounded chain")] if chains else []
    return f"{joined(kinds)}, {count(corners, 'vertex', 'vertices')}"


def _robot(task: Task) -> str:
    if task.robot.is_point:
        return "a point"
    shape = np.array(task.robot.shape)
    width, height = (number(float(size)) for size in np.ptp(shape, axis=0))
    return f"a polygon of {count(len(shape), 'vertex', 'vertices')}, {width} wide, {height} tall"


def _force(task: Task) -> str:
    bounds = task.uncertainty
    if not bounds.has_force_sensor:
        return "no sensor"
    low, high = bounds.force_thresholds
    limit = number(low) if low == high else f"{number(low)} to {number(high)}"
    return f"direction within {degrees(bounds.force_angle)}, read as 0 up to {limit}"


# --- what was found -------------------------------------------------------------------------


def _found(task: Task, space: ConfigurationSpace) -> Iterator[str]:
    contact = space.contact
    parts = components(space)
    yield ""
    sizes = shortened(
        (number(part.measure) for part in sorted(parts, key=lambda part: -part.measure)), 6
    )
    yield f"free space   {count(len(parts), 'component')}, of area {joined(sizes)}"
    yield (
        f"contact      {count(len(contact.edges), 'edge')}"
        f" of length {number(float(np.sum(contact.length[contact.edges])))},"
        f" {count(len(contact.vertices), 'vertex', 'vertices')}: {_corners(contact)}"
    )
    border = float(np.sum(contact.length[contact.open]))
    lost = f"of length {number(border)}: who leaves there is lost" if border else "none"
    yield f"open border  {lost}"
    goal = goal_region(task, space)
    yield f"goal         {region_words(goal)}"
    for line in contact_lines(goal, space):
        yield f"             {line}"
    start = start_region(task, space)
    inside = ", in the goal already" if covered(start, goal, space) else ""
    yield f"start        {start_words(task.initial)}, {_where(start)}{inside}"


def _shape(contact: ContactSpace) -> Ints:
    """(n,) of a vertex: 0 if it is concave, 1 if it is convex, 2 at the open border."""
    beside = contact.open | contact.open[contact.previous]
    return np.where(beside, 2, np.where(contact.concave, 0, 1)).astype(np.int32)


def _corners(contact: ContactSpace) -> str:
    many = np.bincount(_shape(contact)[contact.vertices], minlength=len(SHAPES))
    return ", ".join(f"{number} {shape}" for number, shape in zip(many, SHAPES, strict=True))


def _where(start: Start) -> str:
    """What the robot is on at the start."""
    if start.point is None:
        return region_words(start.region)
    return {"free point": "in free space", "vertex": "a contact vertex"}.get(
        start.kind.value, "on a contact edge"
    )


def _counts(every: list[Sources], contact: ContactSpace) -> Iterator[str]:
    """How many features do what, direction by direction."""
    edges, corners = contact.edges, contact.vertices
    names = [f"{arrow(one.direction)} {direction_words(one.direction)}" for one in every]
    width = max(map(len, names), default=0)
    header = "".join(f"{word:>12}" for word, _ in WORDS)
    yield f"{'edges that':<{width}}{header}   vertices that stick / may stick"
    for name, one in zip(names[:360], every, strict=False):
        found = np.bincount(edge_words(one.edges[edges]), minlength=len(WORDS))
        held = np.bincount(vertex_words(one.vertices[corners]), minlength=len(WORDS))
        row = "".join(f"{int(many):>12}" for many in found)
        yield f"{name:<{width}}{row}   {int(held[STICKS])} / {int(held[MAY_STICK])}"


def _features(every: list[Sources], contact: ContactSpace) -> Iterator[str]:
    """What every edge, and every vertex that may hold, does for the first directions."""
    edges, corners = contact.edges, contact.vertices
    if not len(edges):
        return
    shown = edges[:MOST_FEATURES]
    names = [f"{place(contact.points[one])} to {place(contact.ends[one])}" for one in shown]
    rows = np.stack([edge_words(one.edges[shown]) for one in every], axis=1)
    yield ""
    yield from _table("edge", names, rows, every, len(edges) - len(shown))
    held = np.stack([vertex_words(one.vertices[corners]) for one in every], axis=1)
    holds = np.any(held != LEAVES, axis=1)
    corners, held = corners[holds][:MOST_FEATURES], held[holds][:MOST_FEATURES]
    if len(corners):
        yield ""
        shape = _shape(contact)
        names = [f"{place(contact.points[one])} {SHAPES[shape[one]]}" for one in corners]
        more = int(np.sum(holds)) - len(corners)
        yield from _table("vertex that may hold", names, held, every, more)
    yield ""
    for word, meaning in WORDS:
        yield f"{word:<12}{meaning}"


def _table(
    title: str, names: list[str], rows: Ints, every: list[Sources], more: int
) -> Iterator[str]:
    width = max(len(name) for name in (title, *names))
    yield f"{title:<{width}}" + "".join(
        f"{f'{arrow(one.direction)} {degrees(one.direction)}':>12}" for one in every
    )
    for name, row in zip(names, rows, strict=True):
        yield f"{name:<{width}}" + "".join(f"{WORDS[word][0]:>12}" for word in row)
    if more > 0:
        yield f"and {more} more"
