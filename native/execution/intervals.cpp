#include "execution/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace preimage {

namespace {

// As geometry/angles.py does.
double wrapped(double angle) {
    constexpr double turn = 2.0 * std::numbers::pi;
    return angle - turn * std::ceil(angle / turn - 0.5);
}

}  // namespace

std::vector<Interval> angles(double center, double half) {
    constexpr double pi = std::numbers::pi, turn = 2.0 * pi;
    if (!(half >= 0.0)) return {};
    const auto passes = [&](double angle) { return std::abs(wrapped(center - angle)) <= half; };
    // The last one that passes on the way from one that does to one that may not.
    const auto last = [&](double inner, double outer) {
        if (passes(outer)) return outer;
        while (true) {
            const double middle = 0.5 * (inner + outer);
            if (middle == inner || middle == outer) return inner;
            (passes(middle) ? inner : outer) = middle;
        }
    };
    const double rounding = 16.0 * (std::nextafter(pi, 4.0) - pi);
    std::vector<Interval> found;
    for (const double shift : {-turn, 0.0, turn}) {
        const double inner = std::clamp(center + shift, -pi, pi);
        if (!passes(inner)) continue;
        found.emplace_back(last(inner, std::max(center - half + shift - rounding, -pi)),
                           last(inner, std::min(center + half + shift + rounding, pi)));
    }
    return found;
}

std::vector<Interval> united(std::vector<Interval> intervals) {
    std::sort(intervals.begin(), intervals.end());
    std::vector<Interval> merged;
    for (const Interval& next : intervals) {
        if (!merged.empty() && next.first <= merged.back().second) {
            merged.back().second = std::max(merged.back().second, next.second);
        } else {
            merged.push_back(next);
        }
    }
    return merged;
}

}  // namespace preimage
