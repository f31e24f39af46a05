#include "reachability/rings.hpp"

#include <algorithm>
#include <cmath>

namespace preimage {

namespace {

constexpr std::int32_t none = -1;

// Which segment follows each one. Where several meet, the next one clockwise from the way back:
// they bound the same wedge of the area.
std::vector<std::int32_t> follow(const std::vector<Segment>& segments,
                                 const std::vector<Point>& points) {
    std::vector<std::int32_t> first(points.size(), none);  // leaving a point; chained
    std::vector<std::int32_t> sibling(segments.size(), none);
    const auto count = static_cast<std::int32_t>(segments.size());
    for (std::int32_t s = count - 1; s >= 0; --s) {
        if (segments[s].from == segments[s].to) continue;
        sibling[s] = first[segments[s].from];
        first[segments[s].from] = s;
    }
    auto angle = [&](std::int32_t from, std::int32_t to) {
        return std::atan2(points[to].h - points[from].h, points[to].u - points[from].u);
    };
    std::vector<std::int32_t> next(segments.size(), none);
    for (std::int32_t s = 0; s < count; ++s) {
        if (segments[s].from == segments[s].to) continue;
        const std::int32_t p = segments[s].to;
        std::int32_t best = first[p];
        if (best != none && sibling[best] != none) {
            const double back = angle(p, segments[s].from);
            double least = 10.0;
            for (std::int32_t t = first[p]; t != none; t = sibling[t]) {
                double turn = back - angle(p, segments[t].to);  // clockwise
                while (turn <= 0.0) turn += 2.0 * M_PI;
                if (turn < least) {
                    least = turn;
                    best = t;
                }
            }
        }
        next[s] = best;
    }
    return next;
}

double doubled_area(const std::vector<std::int32_t>& ring, std::size_t begin, std::size_t end,
                    const std::vector<Point>& points) {
    const Point origin = points[ring[begin]];
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        const Point a = points[ring[i]];
        const Point b = points[ring[i + 1 < end ? i + 1 : begin]];
        sum += (a.u - origin.u) * (b.h - origin.h) - (b.u - origin.u) * (a.h - origin.h);
    }
    return sum;
}

}  // namespace

Rings join_rings(const std::vector<Segment>& segments, const std::vector<Point>& points) {
    Rings rings;
    rings.start.push_back(0);
    const std::vector<std::int32_t> next = follow(segments, points);
    std::vector<std::int32_t> ring_of(segments.size(), none);
    std::vector<std::int32_t> lowest;  // by ring: the segment that leaves its lowest point
    std::vector<std::int32_t> place(points.size(), none);  // of a point on the path
    std::vector<std::int32_t> path;

    // a walk that comes back to a point closes a ring; the rest of the path goes on
    auto close = [&](std::size_t begin) {
        const auto ring = static_cast<std::int32_t>(rings.start.size()) - 1;
        std::int32_t low = path[begin];
        for (std::size_t i = begin; i < path.size(); ++i) {
            const std::int32_t s = path[i];
            ring_of[s] = ring;
            place[segments[s].from] = none;
            rings.points.push_back(segments[s].from);
            if (before(points[segments[s].from], points[segments[low].from])) low = s;
        }
        lowest.push_back(low);
        rings.start.push_back(static_cast<std::int32_t>(rings.points.size()));
        path.resize(begin);
    };
    for (std::size_t s = 0; s < segments.size(); ++s) {
        if (segments[s].from == segments[s].to || ring_of[s] != none) continue;
        path.clear();
        auto walk = static_cast<std::int32_t>(s);
        while (walk != none && ring_of[walk] == none) {
            place[segments[walk].from] = static_cast<std::int32_t>(path.size());
            path.push_back(walk);
            const std::int32_t reached = place[segments[walk].to];
            walk = next[walk];
            if (reached != none) close(static_cast<std::size_t>(reached));
        }
        for (std::int32_t left : path) place[segments[left].from] = none;
    }

    const std::size_t count = lowest.size();
    std::vector<bool> is_shell(count);
    for (std::size_t r = 0; r < count; ++r) {
        const auto begin = static_cast<std::size_t>(rings.start[r]);
        const auto end = static_cast<std::size_t>(rings.start[r + 1]);
        is_shell[r] = doubled_area(rings.points, begin, end, points) > 0.0;
    }
    rings.shell.assign(count, none);
    for (std::size_t r = 0; r < count; ++r) {
        // from hole to hole to the left, until a shell bounds the area
        auto ring = static_cast<std::int32_t>(r);
        std::size_t steps = 0;
        while (ring != none && !is_shell[ring] && rings.shell[ring] == none && steps++ <= count) {
            const std::int32_t beyond = segments[lowest[ring]].enclosing;
            ring = beyond == none ? none : ring_of[beyond];
        }
        const std::int32_t shell =
            ring == none || is_shell[ring] ? ring : rings.shell[ring];
        rings.shell[r] = is_shell[r] ? static_cast<std::int32_t>(r) : shell;
    }
    return rings;
}

}  // namespace preimage
