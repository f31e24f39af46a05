// The reading condition, compiled: what may be read, cut into cells of equal answer (theory 5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace preimage {

// What a segment does for the condition.
enum class Part : std::uint8_t {
    contact = 0,  // contact outside the target: a vertex, or an interval of an edge
    border = 1,   // of the area outside the target
};

// Reading sets, each once: whether 0 is read, and the angles no further from `center` than `half`;
// negative where none are.
struct SetsView {
    std::span<const std::uint8_t> zero;
    std::span<const double> center, half;
};

// What the robot must not be mistaken to touch, and what that is told apart by.
struct PartsView {
    std::span<const double> segments;    // 4m: from, to
    std::span<const std::int32_t> set;   // of a contact part
    std::span<const std::uint8_t> part;  // a `Part`
};

struct CellLimits {
    double reach;       // what is nearer than this may be where the robot is
    double slack;       // far more than what distances are rounded by
    std::int32_t few;   // cells with no more parts to look at are not cut
    std::int64_t most;  // how many parts all cells may have to look at, about
};

// A quadtree. Of each leaf is known what is read all over it, and which parts are to be looked at.
struct Cells {
    struct Vec {
        double x, y;
    };
    struct Box {
        double left, bottom, right, top;
    };
    struct Sets {  // closed intervals of angles in [-pi, pi], ascending, and whether 0 is read
        std::vector<std::int32_t> start{0};
        std::vector<double> low, high;
        std::vector<std::uint8_t> zero;

        bool reads(std::int32_t set, double force) const;  // NaN where 0 is read
    };
    struct Leaf {
        std::int32_t set = 0;    // what is read all over the leaf, of `certain`
        std::int32_t first = 0;  // where its parts begin in `looked_at`
        std::int32_t count = 0;
        bool open = false;       // whether it is in the area depends on the place
        bool inside = false;     // whether the reference is in the area
        Vec reference{};         // a point of the leaf
    };

    double reach = 0.0;
    Box box{};
    std::vector<double> segments;
    std::vector<std::int32_t> set;
    std::vector<Part> part;
    Sets sets, certain;
    std::vector<std::int32_t> child;  // of a node: the first of four, or ~leaf
    std::vector<Leaf> leaves;
    std::vector<std::int32_t> looked_at;

    Vec from(std::int32_t p) const { return {segments[4 * at(p)], segments[4 * at(p) + 1]}; }
    Vec to(std::int32_t p) const { return {segments[4 * at(p) + 2], segments[4 * at(p) + 3]}; }
    std::size_t bytes() const;
    std::int32_t most() const;  // parts to look at in one leaf

    // Whether no configuration of the rest gives this reading; `force` is NaN where 0 is read.
    bool misses(double x, double y, double force) const;

    static std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

private:
    const Leaf& leaf_at(Vec q) const;
    bool misses_near(const Leaf& leaf, Vec q, double force) const;
    bool in_area(const Leaf& leaf, Vec q) const;
};

Cells cut_into_cells(const SetsView& sets, const PartsView& parts, const CellLimits& limits);

// Distances as the plain definitions compute them, to the last bit.
double distance_from_contact(Cells::Vec q, Cells::Vec a, Cells::Vec b);
double distance_from_border(Cells::Vec q, Cells::Vec a, Cells::Vec b);

// Whether p is on the left of the line from a to b, or on it.
inline bool on_left(Cells::Vec a, Cells::Vec b, Cells::Vec p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0.0;
}

// Whether the way from p to q crosses the segment from a to b. A vertex that two segments share is
// on one side of the way for both, so that a border is crossed as often as its sides change.
inline bool crosses(Cells::Vec p, Cells::Vec q, Cells::Vec a, Cells::Vec b) {
    return on_left(p, q, a) != on_left(p, q, b) && on_left(a, b, p) != on_left(a, b, q);
}

}  // namespace preimage
