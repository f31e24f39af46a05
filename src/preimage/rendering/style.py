"""How pictures look: layers differ by colour and, in grey, by hatch, dash and shape.

Colours are those of Okabe and Ito (2008), which the colour-blind tell apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

BLACK = "#000000"
ORANGE = "#e69f00"
GREEN = "#009e73"
BLUE = "#0072b2"
VERMILLION = "#d55e00"
PURPLE = "#cc79a7"
PAPER = "#ffffff"
C_OBSTACLE_GREY = "#575757"
OBSTACLE_GREY = "#a3a3a3"
INK = "#1a1a1a"
FADED = "#6b6b6b"

FONTS = ["STIXGeneral", "DejaVu Sans"]
"""They come with matplotlib, so that a picture is the same everywhere. The first has the letters of
formulas, the second helps out where a name is in another script."""

TEXT_SIZE = 8.5
SMALL_SIZE = 7.0
TITLE_SIZE = 10.5

PARAMETERS: dict[str, object] = {
    "font.family": FONTS,
    "font.size": TEXT_SIZE,
    "mathtext.fontset": "stix",
    "axes.linewidth": 0.6,
    "lines.solid_capstyle": "butt",
    "lines.dash_capstyle": "butt",
    "lines.scale_dashes": False,
    "hatch.linewidth": 0.7,
    "path.simplify": False,
    "svg.hashsalt": "preimage",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
}
"""What is not left to matplotlib's configuration files."""

Dashes = tuple[float, tuple[float, ...]]
SOLID: Dashes = (0.0, ())


class Layer(Enum):
    """What a picture is made of; its value names artists, and groups of an SVG."""

    OBSTACLE = "obstacle"
    C_OBSTACLE = "c-obstacle"
    WALL = "wall"
    CLOSED_SIDE = "closed-side"
    OPEN_SIDE = "open-side"
    GOAL = "goal"
    START = "start"
    POSITION_ERROR = "position-error"
    ROBOT = "robot"
    FOUND = "found"
    SUBGOAL = "subgoal"
    PREIMAGE = "preimage"
    TARGET = "target"
    STICKING = "sticking"
    CERTAIN = "certain"
    LOST = "lost"
    RAY = "ray"
    DIRECTION = "direction"
    CONTROL_CONE = "control-cone"
    FRICTION_CONE = "friction-cone"
    FORCE_CONE = "force-cone"
    RUN = "run"
    GIVEN_UP = "given-up"
    FAILURE = "failure"
    BEGIN = "begin"
    END = "end"
    MEASURED = "measured"
    STOPS = "stops"
    FORCE = "force"
    REASON = "reason"
    ROSE = "rose"
    SOLVES = "solves"
    UNPROVEN = "unproven"
    NAME = "name"
    EDGE_NUMBER = "edge-number"


@dataclass(frozen=True, slots=True, kw_only=True)
class RegionStyle:
    """How a region is drawn: its area, its intervals of contact edges, its vertices.

    Parameters
    ----------
    color : of lines, hatches and markers.
    tint : opacity of the area's fill.
    hatch : of the area, in matplotlib's letters.
    stripes : whether the hatch runs along the contour alone, as in the paper's figures.
    outline, dashes : width of the area's outline in points, and its dashes.
    contact, contact_dashes : the same of intervals of contact edges.
    marker, size : of vertices; the size in points.
    order : what is drawn later lies above.
    cost : of covering a piece of the area with a letter.
    """

    color: str
    tint: float = 0.0
    hatch: str = ""
    stripes: bool = False
    outline: float = 0.8
    dashes: Dashes = SOLID
    contact: float = 2.0
    contact_dashes: Dashes = SOLID
    marker: str = "o"
    size: float = 5.0
    order: float = 5.0
    cost: float = 1.0


REGIONS: dict[Layer, RegionStyle] = {
    Layer.FOUND: RegionStyle(
        color=BLUE, tint=0.08, outline=0.5, contact=1.0, marker="D", size=2.4, order=4.0,
        cost=0.2,
    ),
    Layer.PREIMAGE: RegionStyle(
        color=BLUE, tint=0.12, hatch="//////", stripes=True, outline=1.0, contact=1.3,
        marker="D", size=3.2, order=4.5,
    ),
    Layer.GOAL: RegionStyle(
        color=GREEN, tint=0.22, hatch="\\\\\\\\", outline=1.1, contact=2.8,
        marker="o", size=7.5, order=5.0, cost=2.0,
    ),
    Layer.SUBGOAL: RegionStyle(
        color=PURPLE, tint=0.10, outline=0.9, dashes=(0.0, (5.0, 1.6, 1.2, 1.6)), contact=1.6,
        contact_dashes=(0.0, (5.0, 1.6, 1.2, 1.6)), marker="P", size=5.0, order=5.2, cost=0.7,
    ),
    Layer.START: RegionStyle(
        color=BLACK, tint=0.06, hatch="xxx", outline=0.9, dashes=(0.0, (1.0, 1.6)), contact=2.2,
        contact_dashes=(0.0, (1.0, 1.2)), marker="X", size=6.0, order=5.4, cost=2.0,
    ),
    Layer.TARGET: RegionStyle(
        color=VERMILLION, tint=0.25, hatch="...", outline=1.0, contact=2.4,
        contact_dashes=(0.0, (4.0, 1.1)), marker="s", size=4.6, order=5.6, cost=2.0,
    ),
    Layer.STICKING: RegionStyle(
        color=ORANGE, tint=0.3, outline=1.0, contact=2.4, contact_dashes=(0.0, (1.4, 1.0)),
        marker="^", size=4.2, order=5.8, cost=2.0,
    ),
    Layer.CERTAIN: RegionStyle(
        color=GREEN, tint=0.3, hatch="++", outline=0.9, contact=2.2, marker="h", size=5.0,
        order=5.5,
    ),
    Layer.LOST: RegionStyle(
        color=PURPLE, tint=0.14, hatch="oo", outline=0.8, dashes=(0.0, (1.0, 1.6)), contact=1.6,
        contact_dashes=(0.0, (1.0, 1.6)), marker="v", size=4.2, order=4.8, cost=0.4,
    ),
    Layer.STOPS: RegionStyle(
        color=BLACK, outline=1.1, dashes=(0.0, (1.0, 1.6)), contact=1.1, marker="*", order=6.2,
        cost=0.2,
    ),
}  # fmt: skip
"""The layers that are regions. On a contact edge they lie beside each other, the goal innermost."""

MARKS: dict[Layer, tuple[str, str]] = {
    Layer.BEGIN: ("o", BLACK),
    Layer.END: ("s", GREEN),
    Layer.MEASURED: ("+", ORANGE),
    Layer.REASON: ("X", VERMILLION),
}
"""Instants of a run, and places of note: a marker, and its colour."""

LEAST_SIZE = 7.0
"""Points: whatever is smaller on paper gets a ring around it."""
