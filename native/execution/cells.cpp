#include "execution/cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace preimage {

namespace {

using Vec = Cells::Vec;

constexpr double pi = std::numbers::pi;

// As geometry/angles.py wraps; what is in [-pi, pi] stays as it is.
double wrapped(double angle) {
    if (-pi <= angle && angle <= pi) return angle;
    constexpr double turn = 2.0 * pi;
    return std::clamp(angle - turn * std::ceil(angle / turn - 0.5), -pi, pi);
}

}  // namespace

// As `distances` of recognition/segments.py.
double distance_from_contact(Vec q, Vec a, Vec b) {
    const Vec along{b.x - a.x, b.y - a.y}, off{q.x - a.x, q.y - a.y};
    const double square = along.x * along.x + along.y * along.y;
    const double dot = off.x * along.x + off.y * along.y;
    const double place = std::clamp(dot / (square > 0.0 ? square : 1.0), 0.0, 1.0);
    return std::hypot(off.x - place * along.x, off.y - place * along.y);
}

// As GEOS, algorithm/Distance.cpp.
double distance_from_border(Vec q, Vec a, Vec b) {
    const auto apart = [](Vec s, Vec t) {
        const double dx = s.x - t.x, dy = s.y - t.y;
        return std::sqrt(dx * dx + dy * dy);
    };
    if (a.x == b.x && a.y == b.y) return apart(q, a);
    const double square = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
    const double r = ((q.x - a.x) * (b.x - a.x) + (q.y - a.y) * (b.y - a.y)) / square;
    if (r <= 0.0) return apart(q, a);
    if (r >= 1.0) return apart(q, b);
    const double s = ((a.y - q.y) * (b.x - a.x) - (a.x - q.x) * (b.y - a.y)) / square;
    return std::abs(s) * std::sqrt(square);
}

bool Cells::Sets::reads(std::int32_t set, double force) const {
    if (std::isnan(force)) return zero[at(set)] != 0;
    const auto first = high.begin() + start[at(set)], last = high.begin() + start[at(set) + 1];
    const auto found = std::lower_bound(first, last, force);
    return found != last && low[static_cast<std::size_t>(found - high.begin())] <= force;
}

bool Cells::misses(double x, double y, double force) const {
    if (std::isinf(force)) return false;  // nothing measures this: the safe side
    if (!std::isnan(force)) force = wrapped(force);
    if (std::isinf(reach)) return !certain.reads(leaves[0].set, force);
    if (std::isnan(x) || std::isnan(y)) return false;
    if (!(box.left <= x && x <= box.right && box.bottom <= y && y <= box.top)) return true;
    const Vec q{x, y};
    const Leaf& leaf = leaf_at(q);
    if (certain.reads(leaf.set, force)) return false;
    return misses_near(leaf, q, force);
}

const Cells::Leaf& Cells::leaf_at(Vec q) const {
    Box cell = box;
    std::int32_t node = 0;
    while (child[at(node)] >= 0) {
        const double x = 0.5 * (cell.left + cell.right), y = 0.5 * (cell.bottom + cell.top);
        const bool east = q.x >= x, north = q.y >= y;
        (east ? cell.left : cell.right) = x;
        (north ? cell.bottom : cell.top) = y;
        node = child[at(node)] + (east ? 1 : 0) + (north ? 2 : 0);
    }
    return leaves[at(~child[at(node)])];
}

// What is nearer than the reach, and read; free space by the distance from its border, or inside.
bool Cells::misses_near(const Leaf& leaf, Vec q, double force) const {
    const bool zero = std::isnan(force);
    for (std::int32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        const std::int32_t p = looked_at[at(i)];
        if (part[at(p)] == Part::border) {
            if (zero && distance_from_border(q, from(p), to(p)) < reach) return false;
        } else if (sets.reads(set[at(p)], force) &&
                   distance_from_contact(q, from(p), to(p)) < reach) {
            return false;
        }
    }
    return !(zero && leaf.open && in_area(leaf, q));
}

// For places that are not near the border.
bool Cells::in_area(const Leaf& leaf, Vec q) const {
    bool inside = leaf.inside;
    for (std::int32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        const std::int32_t p = looked_at[at(i)];
        if (part[at(p)] != Part::border) continue;
        if (crosses(leaf.reference, q, from(p), to(p))) inside = !inside;
    }
    return inside;
}

std::int32_t Cells::most() const {
    std::int32_t count = 0;
    for (const Leaf& leaf : leaves) count = std::max(count, leaf.count);
    return count;
}

std::size_t Cells::bytes() const {
    const auto size = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    const auto all = [&](const Sets& s) {
        return size(s.start) + size(s.low) + size(s.high) + size(s.zero);
    };
    return size(segments) + size(set) + size(part) + all(sets) + all(certain) + size(child) +
           size(leaves) + size(looked_at);
}

}  // namespace preimage
