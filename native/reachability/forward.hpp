// Forward projection by sweeps along the commanded direction (theory 4).
#pragma once

#include <cstdint>
#include <vector>

#include "reachability/arrangement.hpp"

namespace preimage {

// What a motion may make of an edge; beside them, `kOpen`.
enum Passage : std::uint8_t {
    kTouches = 1,    // comes to it from free space
    kForward = 2,    // slides along it from its start to its end
    kBackward = 4,
};

struct ForwardProjection {
    // the free part: rings of points, shells and the holes in them
    std::vector<double> ring_points;  // x and y alternating
    std::vector<std::int32_t> ring_start;
    std::vector<std::int32_t> ring_shell;
    // the contact part: intervals of edges, and a flag for each vertex
    std::vector<std::int32_t> edge;
    std::vector<double> low;
    std::vector<double> high;
    std::vector<std::uint8_t> vertex;
    std::vector<std::uint8_t> escapes;  // a flag for each open side of the window that is met
    std::int64_t sweeps = 0;
    // false where the input was not an arrangement (edges that cross): then all else is void
    bool consistent = true;
};

// Where motions go from `start` until they meet `stop`; the two areas do not meet. The edges'
// codes are those of `Passage`, the vertices' are not looked at. `frame` is that of the direction
// turned by half a turn: the sweep rises along the motion. `spread` is the tangent of the control
// uncertainty, more than 0; ties up to `tolerance` are nature's.
ForwardProjection forward_project(const ContactSpaceView& contact, const TargetView& start,
                                  const TargetView& stop, Frame frame, double spread,
                                  double tolerance);

}  // namespace preimage
