// From the segments of an area's border to its rings.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/plane.hpp"

namespace preimage {

// A piece of border, the area on its left.
struct Segment {
    std::int32_t from;
    std::int32_t to;
    std::int32_t enclosing;  // where the area lies to the left: the segment beyond it, or -1
};

struct Rings {
    std::vector<std::int32_t> points;  // ring after ring
    std::vector<std::int32_t> start;   // by ring, and the end
    std::vector<std::int32_t> shell;   // by ring: itself, or of a hole the ring around it
};

// Joins segments to simple rings: shells counter-clockwise, holes clockwise. Rings may touch in
// points, they do not cross.
Rings join_rings(const std::vector<Segment>& segments, const std::vector<Point>& points);

}  // namespace preimage
