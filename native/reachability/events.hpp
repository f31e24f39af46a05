// What the sweep stops at: the points of the arrangement, sorted beforehand, and the meetings of
// rays with their neighbours, found on the way.
#pragma once

#include <algorithm>
#include <cstdint>
#include <queue>
#include <vector>

#include "geometry/plane.hpp"

namespace preimage {

// Two neighbours in the status, a ray among them, that meet.
struct Meeting {
    Point at;
    std::int32_t left;
    std::int32_t right;
    std::uint32_t left_stamp;
    std::uint32_t right_stamp;
};

// The event order: by `before`; meetings in one place in the order of their boundaries' names.
inline bool later(const Meeting& a, const Meeting& b) {
    if (before(b.at, a.at)) return true;
    if (before(a.at, b.at)) return false;
    return a.left != b.left ? a.left > b.left : a.right > b.right;
}

struct Later {
    bool operator()(const Meeting& a, const Meeting& b) const { return later(a, b); }
};

using Meetings = std::priority_queue<Meeting, std::vector<Meeting>, Later>;

// A point and its name, side by side for the sort.
struct Station {
    Point at;
    std::int32_t point;
};

inline void sort_stations(std::vector<Station>& stations) {
    std::sort(stations.begin(), stations.end(),
              [](const Station& a, const Station& b) { return before(a.at, b.at); });
}

}  // namespace preimage
