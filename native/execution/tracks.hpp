// Tracks of robots: straight and at constant speed between instants.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace preimage {

struct TracksView {
    std::span<const std::int64_t> start;  // m + 1: the instants of track i
    std::span<const double> time, x, y;
};

// For each track the first instant t at which |p(t) - p(t - period)| <= reach, its own bound;
// infinite if there is none.
std::vector<double> first_return(const TracksView& tracks, double period,
                                 std::span<const double> reach);

// For each point the nearest point of any segment (4k numbers: from, to); NaN without segments.
void nearest(std::span<const double> points, std::span<const double> segments,
             std::vector<double>& found);

}  // namespace preimage
