// The generalized damper, one event at a time, for many robots at once (theory 2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace preimage {

// Contact space as walls, free space on their left; index i is vertex i and the edge from there.
struct WallsView {
    std::span<const double> points;    // 2n
    std::span<const double> tangent;   // 2n, unit vectors along the edges
    std::span<const double> length;    // n
    std::span<const std::int32_t> next;
    std::span<const std::int32_t> previous;
    std::span<const std::uint8_t> open;
    std::span<const std::uint8_t> concave;

    std::int32_t size() const { return static_cast<std::int32_t>(length.size()); }
};

// Where a motion is looked at besides events: borders of an area, and intervals of edges.
struct GatesView {
    std::span<const double> segments;      // 4k: from, to
    std::span<const std::int32_t> start;   // n + 1: the marks of edge i
    std::span<const double> marks;         // distances along edges, ascending on each
};

struct Law {
    double friction;       // phi, radians
    bool damper;           // speed with friction taken off; else the projection's
    double near;           // a length: what is nearer has met
    double tie;            // an angle: what sticks within it may stick
};

enum class Wish : std::uint8_t { any, rest, slide, leave };
enum class Doing : std::uint8_t { flies, slides, rests, escapes };

// Robots: feature is an edge i, a vertex n + i, or 2n in free space; `along` is on edges.
struct RobotsView {
    std::span<const double> x, y, along;
    std::span<const std::int32_t> feature;
};

struct ChoicesView {
    std::span<const double> angle, duration, chance;
    std::span<const std::uint8_t> wish;
};

struct Moves {
    std::vector<double> x, y, along, time;
    std::vector<std::int32_t> feature, between;  // at the end, and on the way
    std::vector<std::uint8_t> doing;

    explicit Moves(std::size_t count)
        : x(count), y(count), along(count), time(count), feature(count), between(count),
          doing(count) {}
};

// Moves every robot along its actual direction until something meets it, or its time is over.
Moves advance(const WallsView& walls, const GatesView& gates, const Law& law,
              const RobotsView& robots, const ChoicesView& choices);

}  // namespace preimage
