"""The legend of a picture: one key for each layer in it, and the bounds on all errors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.colors import to_rgba
from matplotlib.legend import Legend
from matplotlib.legend_handler import HandlerBase
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon, Rectangle, Wedge
from matplotlib.transforms import Transform

from preimage.rendering.glyphs import arrow
from preimage.rendering.layers import OPEN_ENDS, marker
from preimage.rendering.scene import Scene
from preimage.rendering.style import (
    BLUE,
    C_OBSTACLE_GREY,
    FADED,
    GREEN,
    INK,
    MARKS,
    OBSTACLE_GREY,
    ORANGE,
    PAPER,
    REGIONS,
    VERMILLION,
    Layer,
)

WORDS: dict[Layer, str] = {
    Layer.C_OBSTACLE: "C-obstacle",
    Layer.OBSTACLE: "obstacle",
    Layer.WALL: "wall",
    Layer.OPEN_SIDE: "open side of the window",
    Layer.ROBOT: "robot",
    Layer.GOAL: r"goal $\mathcal{G}$",
    Layer.START: r"start $\mathcal{I}$",
    Layer.FOUND: "region found",
    Layer.SUBGOAL: "region of the next motion",
    Layer.PREIMAGE: r"preimage $\mathcal{P}$",
    Layer.TARGET: r"target $\mathcal{T}$",
    Layer.STICKING: "target that sticks",
    Layer.CERTAIN: "start that surely succeeds",
    Layer.LOST: "goal out of reach",
    Layer.RAY: "bounding ray",
    Layer.RUN: "way of a run",
    Layer.GIVEN_UP: "run that gives up",
    Layer.FAILURE: "run that failed",
    Layer.BEGIN: "where it begins",
    Layer.END: "where it is ended",
    Layer.MEASURED: "position as measured",
    Layer.STOPS: "readings that end the motion",
    Layer.FORCE: "force as measured",
    Layer.REASON: "what stands in the way",
    Layer.SOLVES: "directions that solve",
    Layer.UNPROVEN: "directions not proven",
}
"""The keys of layers, in their order."""

WAYS: dict[Layer, tuple[str, float]] = {
    Layer.RUN: (BLUE, 1.0),
    Layer.GIVEN_UP: (ORANGE, 1.0),
    Layer.FAILURE: (VERMILLION, 2.2),
}
"""The colors of the ways of runs, and how wide the keys are."""


@dataclass(frozen=True, slots=True, eq=False)
class Key:
    """A key of the legend: what is drawn, and how it is called.

    Parameters
    ----------
    angle : half the opening of a cone, radians; negative for what is not there.
    parts : of a layer that is a region, those that are drawn.
    """

    layer: Layer
    words: str
    angle: float = 0.0
    parts: frozenset[str] = frozenset()


def keys(
    layers: dict[Layer, set[str]], scene: Scene, words: dict[Layer, str], cones: bool
) -> list[Key]:
    """The keys of a picture.

    Parameters
    ----------
    layers : what is drawn in it: layers and their parts.
    words : names of layers that are not the usual ones.
    cones : whether a command is drawn, and so all bounds matter.
    """
    names = {**WORDS, **words}
    if Layer.OBSTACLE not in layers:
        names[Layer.C_OBSTACLE] = "obstacle"
    found = [
        Key(layer, names[layer], parts=frozenset(layers[layer]))
        for layer in WORDS
        if layer in layers
    ]
    if any(OPEN_ENDS in parts for parts in layers.values()):
        found.append(Key(Layer.TARGET, "end not in the target", parts=frozenset({OPEN_ENDS})))
    if scene.task is None:
        return found
    if scene.starts_anywhere:
        found.append(Key(Layer.START, "start: anywhere", parts=frozenset({"nowhere"})))
    return found + (_bounds(scene) if cones else _position(scene))


def _bounds(scene: Scene) -> list[Key]:
    assert scene.task is not None
    bounds, friction = scene.task.uncertainty, scene.task.friction
    found = [
        Key(Layer.CONTROL_CONE, f"direction ± {_degrees(bounds.control)}", bounds.control)
        if bounds.control > 0.0
        else Key(Layer.DIRECTION, "direction, exact"),
        *_position(scene),
    ]
    if bounds.has_force_sensor:
        angle = bounds.force_angle
        words = f"force ± {_degrees(angle)}" if angle > 0.0 else "force, exact"
        found.append(Key(Layer.FORCE_CONE, words, angle))
    else:
        found.append(Key(Layer.FORCE_CONE, "no force sensor", -1.0))
    words = f"friction ± {_degrees(friction)}" if friction > 0.0 else "no friction"
    found.append(Key(Layer.FRICTION_CONE, words, friction))
    return found


def _position(scene: Scene) -> list[Key]:
    assert scene.task is not None
    rho = scene.task.uncertainty.position
    if math.isinf(rho):
        return [Key(Layer.POSITION_ERROR, "no position sensor", -1.0)]
    words = rf"position error $\rho$ = {rho:.4g}" if rho > 0.0 else "position, exact"
    return [Key(Layer.POSITION_ERROR, words)]


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.4g}°"


class Glyph(HandlerBase):
    """Draws the glyph of a key."""

    def create_artists(
        self,
        legend: Legend,
        orig_handle: Artist,
        xdescent: float,
        ydescent: float,
        width: float,
        height: float,
        fontsize: float,
        trans: Transform,
    ) -> Sequence[Artist]:
        """The parts of the glyph, in a box of the given size."""
        key = orig_handle.get_gid()
        assert isinstance(key, str)
        layer, angle, drawn = key.split(":")
        box = (-xdescent, -ydescent, width, height)
        if Layer(layer) in REGIONS:
            parts = _region_glyph(Layer(layer), set(drawn.split(",")), box)
        else:
            parts = _glyph(Layer(layer), float(angle), box)
        for part in parts:
            part.set_transform(trans)
        return parts


def _glyph(layer: Layer, angle: float, box: tuple[float, float, float, float]) -> list[Artist]:
    x, y, wide, high = box
    if layer in (Layer.SOLVES, Layer.UNPROVEN):
        color, hatch = (BLUE, None) if layer is Layer.SOLVES else (ORANGE, "xxxx")
        fill = to_rgba(color, 0.45)
        return [Rectangle((x, y), wide, high, facecolor=fill, edgecolor=color, lw=0.5, hatch=hatch)]
    if layer in (Layer.C_OBSTACLE, Layer.OBSTACLE, Layer.WALL, Layer.ROBOT):
        face, hatch, line = {
            Layer.C_OBSTACLE: (C_OBSTACLE_GREY, None, 0.0),
            Layer.OBSTACLE: (OBSTACLE_GREY, None, 0.0),
            Layer.WALL: (PAPER, "//////", 0.0),
            Layer.ROBOT: (PAPER, None, 1.2),
        }[layer]
        shape = Rectangle(
            (x, y), wide, high, facecolor=face, edgecolor=INK, linewidth=line, hatch=hatch
        )
        edge = Line2D([x, x + wide], [y + high, y + high], color=INK, linewidth=1.1)
        return [shape, edge] if layer is Layer.WALL else [shape]
    middle = y + 0.5 * high
    if layer in MARKS:
        shape_, color = MARKS[layer]
        return [Line2D([x + 0.5 * wide], [middle], color=color, marker=shape_, markersize=4.5)]
    if layer is Layer.FORCE:
        tail, tip = np.array((x, middle)), np.array((x + wide, middle))
        return [Polygon(arrow(tail, tip, (5.0, 1.9), 1.0), facecolor=VERMILLION, linewidth=0.0)]
    if layer in WAYS:
        color, width = WAYS[layer]
        return [Line2D([x, x + wide], [middle] * 2, color=color, linewidth=width)]
    if layer in (Layer.OPEN_SIDE, Layer.RAY):
        color, width, dashes = {
            Layer.OPEN_SIDE: (FADED, 0.8, (5.0, 3.5)),
            Layer.RAY: (INK, 1.1, (4.0, 3.0)),
        }[layer]
        return [Line2D([x, x + wide], [middle] * 2, color=color, linewidth=width, dashes=dashes)]
    return _bound_glyph(layer, angle, box)


def _region_glyph(
    layer: Layer, parts: set[str], box: tuple[float, float, float, float]
) -> list[Artist]:
    """A patch of the area, an interval of a contact edge below it, and a vertex at its end."""
    x, y, wide, high = box
    style, glyph = REGIONS[layer], list[Artist]()
    low = y if "" in parts else y + 0.5 * high
    end = x + wide if parts & {"", "contact"} else x + 0.5 * wide
    if "" in parts:
        patch = Rectangle(
            (x, y), wide, high, facecolor=to_rgba(style.color, style.tint),
            edgecolor=style.color, linewidth=style.outline, linestyle=style.dashes,
        )  # fmt: skip
        hatch = Rectangle(
            (x, y), wide, high, facecolor="none", edgecolor=style.color, linewidth=0.0,
            hatch=style.hatch or None,
        )  # fmt: skip
        glyph += [patch, hatch]
    if "contact" in parts:
        contact = Line2D([x, x + wide], [low, low], color=style.color, linewidth=style.contact)
        contact.set_linestyle(style.contact_dashes)
        glyph.append(contact)
    if parts & {"vertices", "point", OPEN_ENDS}:
        filled = parts != {OPEN_ENDS}
        glyph.append(marker([end], [low], style, filled))
    return glyph or [Line2D([], [])]


def _bound_glyph(
    layer: Layer, angle: float, box: tuple[float, float, float, float]
) -> list[Artist]:
    x, y, wide, high = box
    middle = y + 0.5 * high
    if layer is Layer.POSITION_ERROR:
        ring = Circle(
            (x + 0.5 * wide, middle), 0.62 * high, facecolor="none", edgecolor=INK,
            linewidth=0.8, linestyle=(0.0, (1.0, 1.6)),
        )  # fmt: skip
        dot = Circle((x + 0.5 * wide, middle), 1.0, facecolor=INK, linewidth=0.0)
        return [ring, dot, *([_stroke(box)] if angle < 0.0 else [])]
    color = {
        Layer.CONTROL_CONE: BLUE, Layer.FORCE_CONE: ORANGE, Layer.FRICTION_CONE: GREEN,
    }.get(layer, INK)  # fmt: skip
    parts: list[Artist] = []
    if angle > 0.0:
        half = math.degrees(angle)
        reach = min(wide, 0.8 * high / math.sin(min(angle, 0.5 * math.pi)))
        cone = Wedge(
            (x, middle), reach, -half, half, facecolor=to_rgba(color, 0.25), edgecolor=color,
            linewidth=0.7,
        )  # fmt: skip
        parts.append(cone)
    tail, tip = np.array((x, middle)), np.array((x + wide, middle))
    shaft = arrow(tail, tip, (5.0, 1.9), 1.0)
    dashed = layer in (Layer.FORCE_CONE, Layer.FRICTION_CONE)
    parts.append(Polygon(shaft, facecolor=color if dashed else INK, linewidth=0.0))
    return [*parts, *([_stroke(box)] if angle < 0.0 else [])]


def _stroke(box: tuple[float, float, float, float]) -> Artist:
    """What is not there is crossed out."""
    x, y, wide, high = box
    middle = x + 0.5 * wide
    return Line2D([middle - high, middle + high], [y - 1.0, y + high + 1.0], color=INK, lw=1.0)


def proxy(key: Key) -> Artist:
    """An artist that stands for a key in matplotlib's legend."""
    artist = Line2D([], [])
    artist.set_gid(f"{key.layer.value}:{key.angle!r}:{','.join(sorted(key.parts))}")
    return artist
