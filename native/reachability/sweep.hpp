// Maximal backprojection by one sweep against the commanded direction (theory 4).
#pragma once

#include <cstdint>
#include <vector>

#include "reachability/arrangement.hpp"

namespace preimage {

struct Backprojection {
    // the free part: rings of points, shells and the holes in them
    std::vector<double> ring_points;  // x and y alternating
    std::vector<std::int32_t> ring_start;
    std::vector<std::int32_t> ring_shell;
    // the contact part: intervals of edges, and a flag for each vertex
    std::vector<std::int32_t> edge;
    std::vector<double> low;
    std::vector<double> high;
    std::vector<std::uint8_t> vertex;
    // the rays that bound it: x and y of both ends
    std::vector<double> rays;
    std::int64_t events = 0;
    // false where the input was not an arrangement (edges that cross): then all else is void
    bool consistent = true;
};

// `spread` is the tangent of the control uncertainty, more than 0; ties up to `tolerance` are
// nature's.
Backprojection backproject(const ContactSpaceView& contact, const TargetView& target, Frame frame,
                           double spread, double tolerance);

}  // namespace preimage
