import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bytes = NDArray[np.uint8]

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
