// Cutting the plane into cells: a quadtree, the fullest cell first.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <utility>
#include <vector>

#include "execution/cells.hpp"
#include "execution/intervals.hpp"

namespace preimage {

namespace {

using Vec = Cells::Vec;
using Box = Cells::Box;

constexpr double infinite = std::numeric_limits<double>::infinity();

// A cell before it is a leaf.
struct Cell {
    Box box{};
    std::int32_t node = 0;
    std::int32_t set = 0;
    bool open = false;
    bool inside = false;
    Vec reference{};
    std::vector<std::int32_t> parts;
};

std::array<Vec, 4> corners(const Box& box) {
    return {{{box.left, box.bottom}, {box.right, box.bottom}, {box.right, box.top},
             {box.left, box.top}}};
}

void append(Cells::Sets& sets, const std::vector<Interval>& intervals, bool zero) {
    for (const auto& [low, high] : intervals) {
        sets.low.push_back(low);
        sets.high.push_back(high);
    }
    sets.start.push_back(static_cast<std::int32_t>(sets.low.size()));
    sets.zero.push_back(zero ? 1 : 0);
}

// Whether a segment meets a closed box.
bool meets(const Box& box, Vec a, Vec b) {
    double low = 0.0, high = 1.0;
    const auto clip = [&](double start, double along, double from, double to) {
        if (along == 0.0) return from <= start && start <= to;
        const double first = (from - start) / along, second = (to - start) / along;
        low = std::max(low, std::min(first, second));
        high = std::min(high, std::max(first, second));
        return low <= high;
    };
    return clip(a.x, b.x - a.x, box.left, box.right) && clip(a.y, b.y - a.y, box.bottom, box.top);
}

double distance_from_box(const Box& box, Vec p) {
    return std::hypot(std::max({box.left - p.x, 0.0, p.x - box.right}),
                      std::max({box.bottom - p.y, 0.0, p.y - box.top}));
}

// The least and the greatest distance of a segment from the points of a box.
std::pair<double, double> distances(const Box& box, Vec a, Vec b) {
    double least = std::min(distance_from_box(box, a), distance_from_box(box, b)), most = 0.0;
    for (const Vec& corner : corners(box)) {
        const double d = distance_from_contact(corner, a, b);
        least = std::min(least, d);
        most = std::max(most, d);  // distance from a segment is convex
    }
    return {least > 0.0 && meets(box, a, b) ? 0.0 : least, most};
}

class Cutter {
public:
    Cutter(const SetsView& sets, const PartsView& parts, const CellLimits& limits)
        : limits_(limits), known_(sets.zero.size(), -1), covered_(sets.zero.size(), {-1, false}) {
        cells_.reach = limits.reach;
        cells_.segments.assign(parts.segments.begin(), parts.segments.end());
        cells_.set.assign(parts.set.begin(), parts.set.end());
        for (const std::uint8_t kind : parts.part) cells_.part.push_back(static_cast<Part>(kind));
        for (std::size_t i = 0; i < sets.zero.size(); ++i) {
            append(cells_.sets, united(angles(sets.center[i], sets.half[i])), sets.zero[i] != 0);
        }
        keep_set({}, false);  // 0: nothing is read
    }

    Cells cut() {
        cells_.child.push_back(0);
        if (std::isinf(limits_.reach)) {
            everywhere();
            return std::move(cells_);
        }
        std::priority_queue<std::pair<std::int64_t, std::int64_t>> order;
        std::vector<Cell> waiting;
        std::int64_t total = 0;
        const auto put = [&](Cell&& cell) {
            const auto count = static_cast<std::int64_t>(cell.parts.size());
            if (count <= limits_.few || !is_large(cell.box)) {
                finish(cell);
                return;
            }
            total += count;
            order.emplace(count, -static_cast<std::int64_t>(waiting.size()));
            waiting.push_back(std::move(cell));
        };
        put(whole_plane());
        while (!order.empty()) {
            Cell cell = std::move(waiting[static_cast<std::size_t>(-order.top().second)]);
            order.pop();
            if (total + kept() > limits_.most) {
                finish(cell);
                continue;
            }
            total -= static_cast<std::int64_t>(cell.parts.size());
            const auto first = static_cast<std::int32_t>(cells_.child.size());
            cells_.child[Cells::at(cell.node)] = first;
            cells_.child.resize(cells_.child.size() + 4, 0);
            const double x = 0.5 * (cell.box.left + cell.box.right);
            const double y = 0.5 * (cell.box.bottom + cell.box.top);
            for (std::int32_t i = 0; i < 4; ++i) {
                Box box = cell.box;
                (i % 2 != 0 ? box.left : box.right) = x;
                (i / 2 != 0 ? box.bottom : box.top) = y;
                put(part_of(cell, box, first + i));
            }
        }
        keep_used_sets();
        return std::move(cells_);
    }

private:
    // --- cells ------------------------------------------------------------------------------

    // Everything, seen from a point outside.
    Cell whole_plane() {
        Box box{infinite, infinite, -infinite, -infinite};
        Cell all;
        for (std::int32_t p = 0; p < static_cast<std::int32_t>(cells_.part.size()); ++p) {
            all.parts.push_back(p);
            for (const Vec& end : {cells_.from(p), cells_.to(p)}) {
                box.left = std::min(box.left, end.x);
                box.right = std::max(box.right, end.x);
                box.bottom = std::min(box.bottom, end.y);
                box.top = std::max(box.top, end.y);
            }
        }
        if (all.parts.empty()) box = {0.0, 0.0, 0.0, 0.0};
        const double grown = limits_.reach + limits_.slack;
        box = {box.left - grown, box.bottom - grown, box.right + grown, box.top + grown};
        cells_.box = box;
        all.box = box;
        all.open = true;
        const double width = box.right - box.left, height = box.top - box.bottom;
        all.reference = {box.left - 0.6180339887 * width, box.bottom - 0.7548776662 * height};
        return part_of(all, box, 0);
    }

    // What of a cell counts in a box of it.
    Cell part_of(const Cell& cell, const Box& box, std::int32_t node) {
        Cell made;
        made.box = box;
        made.node = node;
        made.set = cell.set;
        std::vector<std::int32_t> fresh;
        bool free_everywhere = false;
        ++stamp_;
        for (const std::int32_t p : cell.parts) {
            const auto [least, most] = distances(box, cells_.from(p), cells_.to(p));
            if (least > limits_.reach + limits_.slack) continue;
            if (most >= limits_.reach - limits_.slack) {
                made.parts.push_back(p);
            } else if (cells_.part[Cells::at(p)] == Part::border) {
                free_everywhere = true;
            } else if (std::int32_t& known = known_[Cells::at(cells_.set[Cells::at(p)])];
                       known != stamp_) {
                known = stamp_;
                fresh.push_back(cells_.set[Cells::at(p)]);
            }
        }
        made.open = cell.open && !free_everywhere;
        if (made.open) look_from(cell, made);
        const bool border = std::any_of(made.parts.begin(), made.parts.end(), [&](auto p) {
            return cells_.part[Cells::at(p)] == Part::border;
        });
        if (made.open && !border) {
            made.open = false;
            free_everywhere = made.inside;
        }
        if (!fresh.empty() || free_everywhere) {
            made.set = grown(cell.set, fresh, free_everywhere);
            leave_out_covered(made);
        }
        return made;
    }

    // A reference point far from the lines of the cell's borders, and on which side of them it is.
    void look_from(const Cell& cell, Cell& made) const {
        constexpr std::array<Vec, 5> places{{{0.5141, 0.4877},
                                             {0.2713, 0.3391},
                                             {0.7489, 0.2267},
                                             {0.3359, 0.7621},
                                             {0.6883, 0.6551}}};
        const Box& box = made.box;
        double furthest = -1.0;
        for (const Vec& place : places) {
            const Vec point{box.left + place.x * (box.right - box.left),
                            box.bottom + place.y * (box.top - box.bottom)};
            double nearest = infinite;
            for_borders(cell, [&](Vec a, Vec b) {
                const double twice = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
                const double length = std::hypot(b.x - a.x, b.y - a.y);
                if (length > 0.0) nearest = std::min(nearest, std::abs(twice) / length);
            });
            if (nearest > furthest) {
                furthest = nearest;
                made.reference = point;
            }
        }
        made.inside = cell.inside;
        for_borders(cell, [&](Vec a, Vec b) {
            if (crosses(cell.reference, made.reference, a, b)) made.inside = !made.inside;
        });
    }

    template <typename Visit>
    void for_borders(const Cell& cell, Visit visit) const {
        for (const std::int32_t p : cell.parts) {
            if (cells_.part[Cells::at(p)] == Part::border) visit(cells_.from(p), cells_.to(p));
        }
    }

    // Parts that say nothing new: what they read is read all over the cell.
    void leave_out_covered(Cell& cell) {
        const bool zero = cells_.certain.zero[Cells::at(cell.set)] != 0;
        if (zero) cell.open = false;
        const auto says_nothing = [&](std::int32_t p) {
            if (cells_.part[Cells::at(p)] == Part::border) return zero;
            auto& [when, covered] = covered_[Cells::at(cells_.set[Cells::at(p)])];
            if (when != stamp_) {
                when = stamp_;
                covered = covers(cell.set, cells_.set[Cells::at(p)]);
            }
            return covered;
        };
        std::erase_if(cell.parts, says_nothing);
    }

    bool is_large(const Box& box) const {
        return std::min(box.right - box.left, box.top - box.bottom) > 4.0 * limits_.slack;
    }

    void finish(const Cell& cell) {
        Cells::Leaf leaf;
        leaf.set = cell.set;
        leaf.first = static_cast<std::int32_t>(cells_.looked_at.size());
        leaf.count = static_cast<std::int32_t>(cell.parts.size());
        leaf.open = cell.open;
        leaf.inside = cell.inside;
        leaf.reference = cell.reference;
        cells_.looked_at.insert(cells_.looked_at.end(), cell.parts.begin(), cell.parts.end());
        cells_.child[Cells::at(cell.node)] = ~static_cast<std::int32_t>(cells_.leaves.size());
        cells_.leaves.push_back(leaf);
    }

    // Without a position all parts are near.
    void everywhere() {
        std::vector<std::int32_t> fresh;
        bool area = false;
        for (std::size_t p = 0; p < cells_.part.size(); ++p) {
            if (cells_.part[p] == Part::border) area = true;
            if (cells_.part[p] == Part::contact) fresh.push_back(cells_.set[p]);
        }
        Cell cell;
        cell.set = grown(0, fresh, area);
        finish(cell);
    }

    // --- what is read all over a cell -------------------------------------------------------

    bool covers(std::int32_t set, std::int32_t other) const {
        const Cells::Sets &own = cells_.certain, &others = cells_.sets;
        if (others.zero[Cells::at(other)] != 0 && own.zero[Cells::at(set)] == 0) return false;
        for (auto i = others.start[Cells::at(other)]; i < others.start[Cells::at(other) + 1]; ++i) {
            const auto first = own.high.begin() + own.start[Cells::at(set)];
            const auto last = own.high.begin() + own.start[Cells::at(set) + 1];
            const auto found = std::lower_bound(first, last, others.high[Cells::at(i)]);
            if (found == last) return false;
            const auto place = static_cast<std::size_t>(found - own.high.begin());
            if (own.low[place] > others.low[Cells::at(i)]) return false;
        }
        return true;
    }

    std::int32_t grown(std::int32_t set, const std::vector<std::int32_t>& more, bool zero) {
        std::vector<Interval> intervals;
        const auto add = [&](const Cells::Sets& from, std::int32_t which) {
            zero = zero || from.zero[Cells::at(which)] != 0;
            for (auto i = from.start[Cells::at(which)]; i < from.start[Cells::at(which) + 1]; ++i)
                intervals.emplace_back(from.low[Cells::at(i)], from.high[Cells::at(i)]);
        };
        add(cells_.certain, set);
        for (const std::int32_t other : more) add(cells_.sets, other);
        return keep_set(united(std::move(intervals)), zero);
    }

    // The number of a set; equal sets have one number.
    std::int32_t keep_set(const std::vector<Interval>& intervals, bool zero) {
        const auto number = static_cast<std::int32_t>(cells_.certain.zero.size());
        const auto [place, is_new] = numbers_.try_emplace({intervals, zero}, number);
        if (is_new) append(cells_.certain, intervals, zero);
        return place->second;
    }

    // Sets of cells that were cut are not needed any more.
    void keep_used_sets() {
        const Cells::Sets all = std::exchange(cells_.certain, {});
        std::vector<std::int32_t> number(all.zero.size(), -1);
        for (Cells::Leaf& leaf : cells_.leaves) {
            std::int32_t& found = number[Cells::at(leaf.set)];
            if (found < 0) {
                found = static_cast<std::int32_t>(cells_.certain.zero.size());
                std::vector<Interval> intervals;
                for (auto i = all.start[Cells::at(leaf.set)];
                     i < all.start[Cells::at(leaf.set) + 1]; ++i) {
                    intervals.emplace_back(all.low[Cells::at(i)], all.high[Cells::at(i)]);
                }
                append(cells_.certain, intervals, all.zero[Cells::at(leaf.set)] != 0);
            }
            leaf.set = found;
        }
    }

    std::int64_t kept() const {
        return static_cast<std::int64_t>(cells_.looked_at.size() + 4 * cells_.certain.low.size() +
                                         2 * cells_.child.size());
    }

    CellLimits limits_;
    Cells cells_;
    std::map<std::pair<std::vector<Interval>, bool>, std::int32_t> numbers_;
    std::vector<std::int32_t> known_;  // by set: the cell in which it was met
    std::vector<std::pair<std::int32_t, bool>> covered_;  // by set: when last asked, and whether
    std::int32_t stamp_ = 0;
};

}  // namespace

Cells cut_into_cells(const SetsView& sets, const PartsView& parts, const CellLimits& limits) {
    return Cutter(sets, parts, limits).cut();
}

}  // namespace preimage
