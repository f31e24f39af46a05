// What the sweeps share: a line that moves up, and on it a set that grows along the control cone,
// beside edges and over corners. What is in the set where, the rules of each sweep say.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "reachability/arrangement.hpp"
#include "reachability/events.hpp"
#include "reachability/rings.hpp"
#include "reachability/status.hpp"

namespace preimage {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int32_t none = -1;

// With perfect control a single point takes a line from what is above it, which no area can tell.
// It takes a wedge at least so slim instead, wide enough for kernels to keep away from.
constexpr double least_tip_spread = 1e-7;

// An angle of 1e-10 at the side of the cone, as a slope.
inline double angle_tie(double spread) { return 1e-10 * (1.0 + spread * spread); }

// A vertex of contact space where the sweep stands, or a place inside an edge where a target
// begins or ends on it.
struct Corner {
    std::int32_t name;       // the vertex, or -1 - edge inside an edge
    bool escapes;            // on an open side of the window
    std::uint8_t in_target;  // bits of the targets
    bool grown;              // in the set that grows
};

// A part of a contact edge, as distances from its start.
struct Stretch {
    std::int32_t edge;
    double low;
    double high;
};

// `Rules` derive from this. They know, of pieces, which belong to the set that `grows` and which
// are `drawn`; of corners, whether the set `grows_at` a vertex from the start, and, with
// `judge_corners`, whether it comes to them; of edges, the `state` in which one rises, the piece on
// a `side` of it, whether it `clears` the cone's side, whether it `pushes` the set to its side,
// what becomes of it where a piece comes to `touch` or to `face` it, and how to `record` a stretch
// that ends; and what a sector is made of, the `material` between two pieces (Good where it is for
// the sweep to find out).
template <typename Rules>
class LineSweep {
protected:
    LineSweep(Arrangement& arrangement, double spread, double tolerance)
        : world_(arrangement),
          spread_(spread),
          tip_spread_(std::max(spread, least_tip_spread)),
          tolerance_(tolerance),
          status_(tolerance),
          node_of_(arrangement.edges.size(), none) {}

    // Sweeps the plane. False where the input is not an arrangement (edges that cross).
    bool sweep() {
        std::vector<Station> stations;
        stations.reserve(world_.points.size());
        for (std::size_t p = 0; p < world_.points.size(); ++p) {
            const auto name = static_cast<std::int32_t>(p);
            if (!world_.incident(name).empty()) stations.push_back({world_.points[p], name});
        }
        sort_stations(stations);
        for (const Station& station : stations) {
            while (!meetings_.empty() && !before(station.at, meetings_.top().at)) {
                const Meeting meeting = meetings_.top();
                meetings_.pop();
                if (current(meeting)) meet(meeting);
            }
            now_ = station.at;
            ++events_;
            stop_at(station.point);
            if (!consistent_) return false;
        }
        return status_.empty();
    }

    Rules& rules() { return static_cast<Rules&>(*this); }

    // ---- a point of the arrangement -------------------------------------------------------------

    void stop_at(std::int32_t p) {
        gather(p);
        if (!consistent_) return;
        rules().judge_corners(p);
        leave_group(p);
        raise(p);
        if (consistent_) enter_fresh(p);
    }

    // Collects the edges that end and begin at `p`, the boundaries in the status that end there,
    // and the pieces between them. Rays that reach `p` up to the tolerance end there too.
    void gather(std::int32_t p) {
        lower_.clear();
        upper_.clear();
        group_.clear();
        gaps_.clear();
        corners_.clear();
        ++visit_;
        for (std::int32_t e : world_.incident(p)) {
            (world_.lower(world_.edges[e]) == p ? upper_ : lower_).push_back(e);
        }
        if (upper_.size() > 1) std::sort(upper_.begin(), upper_.end(), LeftToRight{world_});

        if (lower_.empty()) {
            before_ = status_.before(world_.points[p]);
            behind_ = status_[before_].next;
            gaps_.push_back(status_[before_].right);
            return;
        }
        for (std::int32_t e : lower_) {
            if (node_of_[e] == none) {
                consistent_ = false;
                return;
            }
            status_[node_of_[e]].visit = visit_;
        }
        std::size_t found = 1;
        const std::int32_t seed = node_of_[lower_.front()];
        const std::int32_t left = extend<false>(seed, p, found);
        const std::int32_t right = extend<true>(seed, p, found);
        if (found != lower_.size()) {
            consistent_ = false;
            return;
        }
        before_ = status_[left].previous;
        behind_ = status_[right].next;
        lower_.clear();
        gaps_.push_back(status_[before_].right);
        for (std::int32_t node = left;; node = status_[node].next) {
            const Boundary& b = status_[node];
            group_.push_back(node);
            if (!b.is_ray()) {
                lower_.push_back(node);
                gaps_.push_back(b.right);
            } else if (Rules::grows(b.right)) {
                gaps_.back() = b.right;  // a tie: what lies across the ray is met
            }
            if (node == right) break;
        }
    }

    template <bool rightwards>
    std::int32_t extend(std::int32_t seed, std::int32_t p, std::size_t& found) {
        const Point at = world_.points[p];
        auto step = [&](std::int32_t node) {
            return rightwards ? status_[node].next : status_[node].previous;
        };
        auto ray_here = [&](std::int32_t node) {
            return status_[node].is_ray() && std::abs(status_[node].at(at.h) - at.u) <= tolerance_;
        };
        std::int32_t reach = seed;
        for (std::int32_t node = step(seed); node != none; node = step(node)) {
            if (status_[node].visit == visit_) {
                reach = node;
                ++found;
            } else if (!ray_here(node)) {
                break;
            }
        }
        const std::int32_t beyond = step(reach);
        const Kind closing = rightwards ? Kind::RayLeft : Kind::RayRight;
        if (beyond != none && status_[beyond].kind == closing && ray_here(beyond)) return beyond;
        return reach;
    }

    Corner& corner_of(const Edge& edge, std::int32_t p) {
        std::int32_t name = -1 - edge.base;
        if (p < static_cast<std::int32_t>(world_.contact.next.size())) {
            name = edge.from == p ? edge.base : world_.contact.next[edge.base];
        }
        for (Corner& corner : corners_) {
            if (corner.name == name) return corner;
        }
        const bool vertex = name >= 0;
        corners_.push_back({name, false,
                            vertex ? world_.vertex_in_target[name] : std::uint8_t{0},
                            vertex && rules().grows_at(name)});
        return corners_.back();
    }

    // Whether some line of the control cone through `p` runs in this piece below it.
    bool cone_meets(std::size_t gap) {
        const double low = gap == 0 ? -infinity : -status_[lower_[gap - 1]].slope();
        const double high = gap == lower_.size() ? infinity : -status_[lower_[gap]].slope();
        return std::max(low, -spread_) < std::min(high, spread_) + angle_tie(spread_);
    }

    // The corner whose wedge of free space holds this piece below `p`: that of the nearest contact
    // edge around the point, since the target's border does not bound it.
    Corner* corner_below(std::size_t gap, std::int32_t p) {
        for (std::size_t i = gap; i < lower_.size(); ++i) {
            const Boundary& b = status_[lower_[i]];
            if (b.kind == Kind::Contact) return &corner_of(world_.edges[b.edge], p);
        }
        for (std::size_t i = gap; i > 0; --i) {
            const Boundary& b = status_[lower_[i - 1]];
            if (b.kind == Kind::Contact) return &corner_of(world_.edges[b.edge], p);
        }
        for (std::int32_t e : upper_) {
            if (world_.is_contact(world_.edges[e])) return &corner_of(world_.edges[e], p);
        }
        return nullptr;
    }

    void leave_group(std::int32_t p) {
        outer_left_ = status_[before_].right;
        outer_right_ = group_.empty() ? outer_left_ : status_[group_.back()].right;
        for (std::int32_t node : group_) retire(node, p);
    }

    // Builds the boundaries that rise from `p`, from left to right: edges, and the rays along
    // which growing pieces grow between them.
    void raise(std::int32_t p) {
        fresh_.clear();
        leftmost_ = outer_left_;
        for (std::size_t sector = 0; sector <= upper_.size(); ++sector) {
            const bool has_left = sector > 0;
            const bool has_right = sector < upper_.size();
            const std::size_t left = fresh_.size() - 1;
            Boundary right{};
            if (has_right) right = rising(upper_[sector], p);

            const Piece ground = rules().material(
                has_left ? rules().side(world_.edges[upper_[sector - 1]], true) : outer_left_,
                has_right ? rules().side(world_.edges[upper_[sector]], false) : outer_right_);
            if (!consistent_) return;
            if (ground != Piece::Good) {
                set_right(ground);
            } else {
                const bool from_left = has_left ? rules().pushes(fresh_[left], true)
                                                : Rules::grows(outer_left_);
                const bool from_right = has_right ? rules().pushes(right, false)
                                                  : Rules::grows(outer_right_);
                fill(p, has_left ? fresh_[left].slope() : -infinity,
                     has_right ? right.slope() : infinity, from_left, from_right,
                     from_corner(sector, p));
            }
            if (has_left) rules().touch(fresh_[left], fresh_[left].right);
            if (has_right) {
                rules().touch(right, fresh_.empty() ? leftmost_ : fresh_.back().right);
            }
            if (has_right) fresh_.push_back(right);
        }
    }

    // What lies between two boundaries that rise from a point, their slopes being `low` < `high`:
    // growing pieces lean outward at the spread of the control cone.
    void fill(std::int32_t p, double low, double high, bool from_left, bool from_right,
              bool from_corner) {
        if (from_left && from_right) {
            set_right(Piece::Grown);
        } else if (from_left && low < spread_) {
            set_right(Piece::Grown);
            if (rules().clears(high - spread_)) cast(Kind::RayRight, p, Piece::Good, spread_);
        } else if (from_right && high > -spread_) {
            if (rules().clears(-spread_ - low)) {
                set_right(Piece::Good);
                cast(Kind::RayLeft, p, Piece::Grown, spread_);
            } else {
                set_right(Piece::Grown);
            }
        } else if (from_corner && std::max(low, -spread_) < std::min(high, spread_)) {
            if (rules().clears(-spread_ - low)) {
                set_right(Piece::Good);
                cast(Kind::RayLeft, p, Piece::Grown, tip_spread_);
            } else {
                set_right(Piece::Grown);
            }
            if (rules().clears(high - spread_)) cast(Kind::RayRight, p, Piece::Good, tip_spread_);
        } else {
            set_right(Piece::Good);
        }
    }

    void set_right(Piece piece) { (fresh_.empty() ? leftmost_ : fresh_.back().right) = piece; }

    void cast(Kind kind, std::int32_t p, Piece right, double spread) {
        Boundary ray{};
        ray.origin = world_.points[p];
        ray.direction = {kind == Kind::RayRight ? spread : -spread, 1.0};
        ray.kind = kind;
        ray.right = right;
        ray.edge = none;
        ray.since = p;
        ray.segment = none;
        fresh_.push_back(ray);
    }

    Boundary rising(std::int32_t e, std::int32_t p) {
        const Edge& edge = world_.edges[e];
        Boundary b{};
        world_.line(edge, b.origin, b.direction);
        b.kind = world_.is_contact(edge) ? Kind::Contact : Kind::Border;
        b.right = Piece::Solid;
        b.edge = e;
        b.since = p;
        b.segment = none;
        b.state = b.kind == Kind::Contact ? rules().state(e, p) : Piece::Good;
        return b;
    }

    bool from_corner(std::size_t sector, std::int32_t p) {
        if (corners_.empty()) return false;
        for (std::size_t i = sector; i > 0; --i) {
            const Edge& edge = world_.edges[upper_[i - 1]];
            if (world_.is_contact(edge)) return corner_of(edge, p).grown;
        }
        for (std::size_t i = sector; i < upper_.size(); ++i) {
            const Edge& edge = world_.edges[upper_[i]];
            if (world_.is_contact(edge)) return corner_of(edge, p).grown;
        }
        // no contact above: the wedge is that of the pieces on both sides
        const Corner* corner = corner_below(0, p);
        return corner != nullptr && corner->grown;
    }

    void enter_fresh(std::int32_t p) {
        if (status_[before_].right != leftmost_) {
            status_[before_].right = leftmost_;
            refresh(before_, none);
        }
        std::int32_t last = before_;
        for (const Boundary& b : fresh_) {
            last = status_.insert_after(last, b);
            if (b.edge != none) node_of_[b.edge] = last;
        }
        for (std::int32_t node = status_[before_].next; node != behind_;
             node = status_[node].next) {
            refresh(node, p);
        }
        if (behind_ != none) refresh(behind_, none);
        schedule(before_, status_[before_].next);
        if (last != before_) schedule(last, behind_);
    }

    // ---- a ray and its neighbour ----------------------------------------------------------------

    bool current(const Meeting& m) {
        return status_[m.left].stamp == m.left_stamp && status_[m.right].stamp == m.right_stamp &&
               status_[m.left].next == m.right;
    }

    // Finds where two neighbours meet, if one is a ray and they meet before the other one ends.
    void schedule(std::int32_t left, std::int32_t right) {
        if (left == Status::first || right == none) return;
        const Boundary& a = status_[left];
        const Boundary& b = status_[right];
        if (!a.is_ray() && !b.is_ray()) return;
        Point at;
        if (a.direction.h == 0.0) {
            at = {std::max(b.at(now_.h), now_.u), now_.h};  // level: it sweeps over the ray at once
        } else if (b.direction.h == 0.0) {
            return;
        } else {
            const double closing = a.slope() - b.slope();
            if (!(closing > 0.0)) return;
            const double gap = std::max(b.at(now_.h) - a.at(now_.h), 0.0);
            at.h = now_.h + gap / closing;
            // on the steeper of the two, which tells the place best
            at.u = (std::abs(a.slope()) < std::abs(b.slope()) ? a : b).at(at.h);
        }
        for (const Boundary* side : {&a, &b}) {
            if (side->is_ray()) continue;
            const Point end = world_.points[world_.upper(world_.edges[side->edge])];
            const Vector rest{end.u - at.u, end.h - at.h};
            if (!(rest.u * side->direction.u + rest.h * side->direction.h > 0.0)) return;
            // so near to the end, the vertex there sees to it, if it still sees the ray
            const Boundary& ray = side == &a ? b : a;
            if (std::abs(end.u - at.u) <= tolerance_ && std::abs(end.h - at.h) <= tolerance_ &&
                std::abs(ray.at(end.h) - end.u) <= tolerance_) {
                return;
            }
            // an edge that is level up to rounding and leans to the left
            if (!before(at, end)) at.h = std::nextafter(end.h, -infinity);
        }
        meetings_.push({at, left, right, a.stamp, b.stamp});
    }

    // The piece between the two vanishes, and a ray with it.
    void meet(const Meeting& m) {
        ++events_;
        if (before(now_, m.at)) now_ = m.at;
        const auto p = static_cast<std::int32_t>(world_.points.size());
        world_.points.push_back(m.at);
        const bool left_goes = status_[m.left].is_ray();
        const bool right_goes = status_[m.right].is_ray();
        const Piece beyond = status_[m.right].right;
        const std::int32_t previous = status_[m.left].previous;
        const std::int32_t next = status_[m.right].next;
        if (right_goes) retire(m.right, p);
        if (left_goes) retire(m.left, p);
        if (left_goes && right_goes) {
            // two pieces grow together
            schedule(previous, next);
        } else if (left_goes) {
            // the edge on the right now borders on what was left of the ray
            rules().face(m.right, status_[previous].right, p);
            refresh(m.right, p);
            schedule(previous, m.right);
        } else {
            status_[m.left].right = beyond;
            rules().face(m.left, beyond, p);
            refresh(m.left, p);
            schedule(m.left, next);
        }
    }

    // ---- output ---------------------------------------------------------------------------------

    void retire(std::int32_t node, std::int32_t p) {
        Boundary& b = status_[node];
        close_segment(b, p);
        if (b.kind == Kind::Contact) {
            rules().record(b, p);
        } else if (b.is_ray()) {
            rules().record_ray(world_.points[b.since], world_.points[p]);
        }
        if (b.edge != none) node_of_[b.edge] = none;
        status_.remove(node);
    }

    // Begins or ends the segment of the border that a boundary draws, as its sides have it. The
    // boundary is at point `p`, or anywhere.
    void refresh(std::int32_t node, std::int32_t p) {
        if (node == Status::first) return;
        Boundary& b = status_[node];
        const bool left = Rules::drawn(status_[b.previous].right);
        const bool right = Rules::drawn(b.right);
        const auto emits = static_cast<std::int8_t>(left - right);
        if (emits == b.emits) return;
        if (p == none) {
            p = static_cast<std::int32_t>(world_.points.size());
            world_.points.push_back({b.at(now_.h), now_.h});
        }
        close_segment(b, p);
        b.emits = emits;
        if (emits == 0) return;
        b.segment = static_cast<std::int32_t>(segments_.size());
        segments_.push_back({p, p, none});
        if (left) {
            std::int32_t beyond = b.previous;
            while (beyond != Status::first && status_[beyond].emits == 0) {
                beyond = status_[beyond].previous;
            }
            if (beyond != Status::first) segments_.back().enclosing = status_[beyond].segment;
        }
    }

    void close_segment(Boundary& b, std::int32_t p) {
        if (b.segment == none) return;
        Segment& segment = segments_[b.segment];
        (b.emits > 0 ? segment.to : segment.from) = p;
        b.segment = none;
        b.emits = 0;
    }

    void write_point(std::vector<double>& into, std::int32_t p) const {
        double x;
        double y;
        if (p < static_cast<std::int32_t>(world_.contact.next.size())) {
            x = world_.contact.points[2 * p];
            y = world_.contact.points[2 * p + 1];
        } else {
            world_.frame.leave(world_.points[p], x, y);
        }
        into.push_back(x);
        into.push_back(y);
    }

    // Where a point is: contact vertices exactly.
    std::array<double, 2> place(std::int32_t p) const {
        if (p < static_cast<std::int32_t>(world_.contact.next.size())) {
            return {world_.contact.points[2 * p], world_.contact.points[2 * p + 1]};
        }
        std::array<double, 2> xy{};
        world_.frame.leave(world_.points[p], xy[0], xy[1]);
        return xy;
    }

    // The border that was drawn, into the rings of a result.
    template <typename Result>
    void write_rings(Result& result) const {
        Rings rings = join_rings(segments_, world_.points);
        result.ring_points.reserve(2 * rings.points.size());
        for (std::int32_t p : rings.points) {
            for (const double value : place(p)) result.ring_points.push_back(value);
        }
        result.ring_start = std::move(rings.start);
        result.ring_shell = std::move(rings.shell);
    }

    // Edges that rise from one point.
    struct LeftToRight {
        const Arrangement& world;

        bool operator()(std::int32_t first, std::int32_t second) const {
            Point origin;
            Vector a;
            Vector b;
            world.line(world.edges[first], origin, a);
            world.line(world.edges[second], origin, b);
            return a.u * b.h - a.h * b.u < 0.0;
        }
    };

    Arrangement& world_;
    const double spread_;
    const double tip_spread_;  // of what a single point of the set takes from above
    const double tolerance_;
    Status status_;
    Meetings meetings_;
    std::vector<std::int32_t> node_of_;  // by edge: its place in the status
    std::vector<Segment> segments_;
    std::int64_t events_ = 0;
    bool consistent_ = true;
    Point now_{};
    std::uint32_t visit_ = 0;

    // of the point at which the sweep stands
    std::vector<std::int32_t> lower_;  // edges that end there; once gathered, their status nodes
    std::vector<std::int32_t> upper_;  // edges that begin there
    std::vector<std::int32_t> group_;  // all status nodes that end there
    std::vector<Piece> gaps_;          // pieces below, around and between `lower_`
    std::vector<Corner> corners_;
    std::vector<Boundary> fresh_;
    std::int32_t before_ = none;  // the neighbours of all this in the status
    std::int32_t behind_ = none;
    Piece outer_left_ = Piece::Solid;
    Piece outer_right_ = Piece::Solid;
    Piece leftmost_ = Piece::Solid;
};

}  // namespace preimage
