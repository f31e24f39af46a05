import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bytes = NDArray[np.uint8]
Longs = NDArray[np.int64]

def version() -> str: ...
def backproject(
    points: Floats,
    next: Ints,
    place: Ints,
    edge_code: Bytes,
    vertex_code: Bytes,
    target_edge: Ints,
    target_low: Floats,
    target_high: Floats,
    target_vertices: Ints,
    beside_edge: Ints,
    beside_low: Floats,
    beside_high: Floats,
    nodes: Floats,
    node_vertex: Ints,
    node_edge: Ints,
    node_distance: Floats,
    segment_from: Ints,
    segment_to: Ints,
    vx: float,
    vy: float,
    step: float,
    spread: float,
    tolerance: float,
    /,
) -> tuple[bool, Floats, Ints, Ints, Ints, Floats, Floats, Bytes, Floats, int]: ...
def forward_project(
    points: Floats,
    next: Ints,
    place: Ints,
    edge_code: Bytes,
    start: tuple[Ints | Floats, ...],
    stop: tuple[Ints | Floats, ...],
    vx: float,
    vy: float,
    step: float,
    spread: float,
    tolerance: float,
    /,
) -> tuple[bool, Floats, Ints, Ints, Ints, Floats, Floats, Bytes, Bytes, int]: ...
def advance(
    points: Floats,
    tangent: Floats,
    length: Floats,
    next: Ints,
    previous: Ints,
    open: Bytes,
    concave: Bytes,
    gate_segments: Floats,
    gate_start: Ints,
    gate_marks: Floats,
    friction: float,
    damper: bool,
    near: float,
    tie: float,
    x: Floats,
    y: Floats,
    along: Floats,
    feature: Ints,
    angle: Floats,
    duration: Floats,
    chance: Floats,
    wish: Bytes,
    /,
) -> tuple[Floats, Floats, Floats, Ints, Ints, Floats, Bytes]: ...
def first_return(
    start: Longs, time: Floats, x: Floats, y: Floats, period: float, reach: Floats, /
) -> Floats: ...
def nearest(points: Floats, segments: Floats, /) -> Floats: ...

class Cells:
    @property
    def bytes(self) -> int: ...
    @property
    def leaves(self) -> int: ...
    @property
    def most(self) -> int: ...
    def misses(self, x: float, y: float, force: float, /) -> bool: ...
    def misses_all(self, x: Floats, y: Floats, force: Floats, /) -> Bytes: ...

def cut_into_cells(
    zero: Bytes,
    center: Floats,
    half: Floats,
    segments: Floats,
    set: Ints,
    part: Bytes,
    reach: float,
    slack: float,
    few: int,
    most: int,
    /,
) -> Cells: ...
