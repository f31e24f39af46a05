#include "reachability/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reachability/events.hpp"
#include "reachability/rings.hpp"
#include "reachability/status.hpp"

namespace preimage {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int32_t none = -1;

// With perfect control a single point takes a line from what is above it, which no area can tell.
// It takes a wedge at least so slim instead, wide enough for kernels to keep away from.
constexpr double least_tip_spread = 1e-7;

// A vertex of contact space where the sweep stands, or a place inside an edge where the target
// begins or ends on it.
struct Corner {
    std::int32_t name;  // the vertex, or -1 - edge inside an edge
    bool escapes;       // on an open side of the window
    bool in_target;
    bool avoidable;
};

// A part of a contact edge, as distances from its start.
struct Stretch {
    std::int32_t edge;
    double low;
    double high;
};

class Sweep {
public:
    Sweep(Arrangement& arrangement, double spread, double tolerance)
        : world_(arrangement),
          spread_(spread),
          tip_spread_(std::max(spread, least_tip_spread)),
          tolerance_(tolerance),
          status_(tolerance),
          node_of_(arrangement.edges.size(), none) {
        result_.vertex.assign(world_.contact.next.size(), 0);
    }

    Backprojection run() {
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
            ++result_.events;
            stop_at(station.point);
            if (!result_.consistent) return std::move(result_);
        }
        result_.consistent = status_.empty();
        if (result_.consistent) {
            write_contact();
            write_rings();
        }
        return std::move(result_);
    }

private:
    // ---- a point of the arrangement -------------------------------------------------------------

    void stop_at(std::int32_t p) {
        gather(p);
        if (!result_.consistent) return;
        judge_corners(p);
        leave_group(p);
        raise(p);
        if (result_.consistent) enter_fresh(p);
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
                result_.consistent = false;
                return;
            }
            status_[node_of_[e]].visit = visit_;
        }
        std::size_t found = 1;
        const std::int32_t seed = node_of_[lower_.front()];
        const std::int32_t left = extend<false>(seed, p, found);
        const std::int32_t right = extend<true>(seed, p, found);
        if (found != lower_.size()) {
            result_.consistent = false;
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
            } else if (b.right == Piece::Avoidable) {
                gaps_.back() = Piece::Avoidable;  // a tie: what lies across the ray is met
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

    // Decides for each corner at `p` whether the robot that is there can be kept from the target:
    // because it may stick, may slide down an avoidable edge, or may leave into avoidable space.
    void judge_corners(std::int32_t p) {
        for (std::int32_t e : world_.incident(p)) {
            const Edge& edge = world_.edges[e];
            if (!world_.is_contact(edge)) continue;
            Corner& corner = corner_of(edge, p);
            if (edge.code & kOpen) corner.escapes = true;
            if (corner.name < 0) {
                corner.in_target |= edge.in_target;
                corner.avoidable |= (edge.code & kMayStick) != 0;
            }
        }
        if (corners_.empty()) return;
        for (std::int32_t node : lower_) {
            const Boundary& b = status_[node];
            if (b.kind != Kind::Contact || b.state != Piece::Avoidable) continue;
            const Edge& edge = world_.edges[b.edge];
            if (edge.code & kMaySlide) corner_of(edge, p).avoidable = true;
        }
        for (std::size_t gap = 0; gap < gaps_.size(); ++gap) {
            if (gaps_[gap] != Piece::Avoidable || !may_leave_into(gap)) continue;
            if (Corner* corner = corner_below(gap, p)) corner->avoidable = true;
        }
        for (Corner& corner : corners_) {
            corner.avoidable = !corner.in_target && (corner.escapes || corner.avoidable);
            if (corner.name >= 0) result_.vertex[corner.name] = !corner.avoidable;
        }
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
        corners_.push_back({name, false, vertex && world_.vertex_in_target[name] != 0,
                            vertex && (world_.contact.vertex_code[name] & kMayStick) != 0});
        return corners_.back();
    }

    // Whether some direction of the control cone points into this piece below `p`.
    bool may_leave_into(std::size_t gap) {
        const double low = gap == 0 ? -infinity : -status_[lower_[gap - 1]].slope();
        const double high = gap == lower_.size() ? infinity : -status_[lower_[gap]].slope();
        const double tie = 1e-10 * (1.0 + spread_ * spread_);  // an angle of 1e-10, as a slope
        return std::max(low, -spread_) < std::min(high, spread_) + tie;
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
    // which avoidable pieces grow between them.
    void raise(std::int32_t p) {
        fresh_.clear();
        leftmost_ = outer_left_;
        for (std::size_t sector = 0; sector <= upper_.size(); ++sector) {
            const bool has_left = sector > 0;
            const bool has_right = sector < upper_.size();
            const std::size_t left = fresh_.size() - 1;
            Boundary right{};
            if (has_right) right = rising(upper_[sector], p);

            const Piece ground = material(sector);
            if (!result_.consistent) return;
            if (ground == Piece::Solid || ground == Piece::Target) {
                set_right(ground);
            } else {
                const bool from_left = has_left ? pushes(fresh_[left])
                                                : outer_left_ == Piece::Avoidable;
                const bool from_right = has_right ? pushes(right)
                                                  : outer_right_ == Piece::Avoidable;
                fill(p, has_left ? fresh_[left].slope() : -infinity,
                     has_right ? right.slope() : infinity, from_left, from_right,
                     from_corner(sector, p));
                if (has_left) touch(fresh_[left], fresh_[left].right);
                if (has_right) touch(right, fresh_.empty() ? leftmost_ : fresh_.back().right);
            }
            if (has_right) fresh_.push_back(right);
        }
    }

    static bool pushes(const Boundary& b) {
        return b.kind == Kind::Contact && b.state == Piece::Avoidable;
    }

    // A contact edge beside avoidable space is avoidable where the robot may leave it.
    void touch(Boundary& b, Piece beside) const {
        if (b.kind == Kind::Contact && beside == Piece::Avoidable && b.state == Piece::Good &&
            (world_.edges[b.edge].code & kMayLeave)) {
            b.state = Piece::Avoidable;
        }
    }

    // What lies between two boundaries that rise from a point, their slopes being `low` < `high`:
    // avoidable pieces lean outward at the spread of the control cone.
    void fill(std::int32_t p, double low, double high, bool from_left, bool from_right,
              bool from_corner) {
        if (from_left && from_right) {
            set_right(Piece::Avoidable);
        } else if (from_left && low < spread_) {
            set_right(Piece::Avoidable);
            if (spread_ < high) cast(Kind::RayRight, p, Piece::Good);
        } else if (from_right && high > -spread_) {
            if (low < -spread_) {
                set_right(Piece::Good);
                cast(Kind::RayLeft, p, Piece::Avoidable);
            } else {
                set_right(Piece::Avoidable);
            }
        } else if (from_corner && std::max(low, -spread_) < std::min(high, spread_)) {
            if (low < -spread_) {
                set_right(Piece::Good);
                cast(Kind::RayLeft, p, Piece::Avoidable, tip_spread_);
            } else {
                set_right(Piece::Avoidable);
            }
            if (spread_ < high) cast(Kind::RayRight, p, Piece::Good, tip_spread_);
        } else {
            set_right(Piece::Good);
        }
    }

    void set_right(Piece piece) { (fresh_.empty() ? leftmost_ : fresh_.back().right) = piece; }

    void cast(Kind kind, std::int32_t p, Piece right) { cast(kind, p, right, spread_); }

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
        b.state = Piece::Good;
        if (b.kind == Kind::Contact) {
            const bool slides = (edge.code & kMaySlide) && corner_of(edge, p).avoidable;
            if (edge.code & kOpen) {
                b.state = Piece::Avoidable;
            } else if (edge.in_target) {
                b.state = Piece::Target;
            } else if ((edge.code & kMayStick) || slides) {
                b.state = Piece::Avoidable;
            }
        }
        return b;
    }

    // What an edge that rises from the point has on its left or right.
    Piece side(std::int32_t e, bool right) const {
        const Edge& edge = world_.edges[e];
        const bool on_left_of_travel = edge.rises != right;
        if (!world_.is_contact(edge)) return on_left_of_travel ? Piece::Target : Piece::Good;
        if (!on_left_of_travel) return Piece::Solid;
        return edge.beside_target ? Piece::Target : Piece::Good;
    }

    // What a sector above the point is made of; Good stands for free space outside the target,
    // avoidable or not. Where the target's border and the pieces below disagree, up to rounding,
    // it is not the target; about obstacles they must not disagree.
    Piece material(std::size_t sector) {
        const bool has_left = sector > 0;
        const bool has_right = sector < upper_.size();
        const Piece left = has_left ? side(upper_[sector - 1], true) : outer_left_;
        const Piece right = has_right ? side(upper_[sector], false) : outer_right_;
        if ((left == Piece::Solid) != (right == Piece::Solid)) result_.consistent = false;
        if (left == Piece::Solid) return Piece::Solid;
        return left == Piece::Target && right == Piece::Target ? Piece::Target : Piece::Good;
    }

    bool from_corner(std::size_t sector, std::int32_t p) {
        if (corners_.empty()) return false;
        for (std::size_t i = sector; i > 0; --i) {
            const Edge& edge = world_.edges[upper_[i - 1]];
            if (world_.is_contact(edge)) return corner_of(edge, p).avoidable;
        }
        for (std::size_t i = sector; i < upper_.size(); ++i) {
            const Edge& edge = world_.edges[upper_[i]];
            if (world_.is_contact(edge)) return corner_of(edge, p).avoidable;
        }
        // no contact above: the wedge is that of the pieces on both sides
        const Corner* corner = corner_below(0, p);
        return corner != nullptr && corner->avoidable;
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
            // so near to the end, the vertex there sees to it
            if (std::abs(end.u - at.u) <= tolerance_ && std::abs(end.h - at.h) <= tolerance_) {
                return;
            }
            // an edge that is level up to rounding and leans to the left
            if (!before(at, end)) at.h = std::nextafter(end.h, -infinity);
        }
        meetings_.push({at, left, right, a.stamp, b.stamp});
    }

    // The piece between the two vanishes, and a ray with it.
    void meet(const Meeting& m) {
        ++result_.events;
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
            // two avoidable pieces grow together
            schedule(previous, next);
        } else if (left_goes) {
            // the edge on the right now borders on what was left of the ray
            face(m.right, status_[previous].right, p);
            refresh(m.right, p);
            schedule(previous, m.right);
        } else {
            status_[m.left].right = beyond;
            face(m.left, beyond, p);
            refresh(m.left, p);
            schedule(m.left, next);
        }
    }

    // A contact edge borders on another piece from `p` on.
    void face(std::int32_t node, Piece beside, std::int32_t p) {
        Boundary& b = status_[node];
        if (b.kind != Kind::Contact) return;
        const std::uint8_t code = world_.edges[b.edge].code;
        if (beside == Piece::Avoidable && b.state == Piece::Good && (code & kMayLeave)) {
            record(b, p);
            b.state = Piece::Avoidable;
            b.since = p;
        } else if (beside == Piece::Good && b.state == Piece::Avoidable &&
                   !(code & (kMayStick | kMaySlide | kOpen))) {
            // an overhang that the robot leaves for sure
            b.state = Piece::Good;
            b.since = p;
        }
    }

    // ---- output ---------------------------------------------------------------------------------

    void retire(std::int32_t node, std::int32_t p) {
        Boundary& b = status_[node];
        close_segment(b, p);
        if (b.kind == Kind::Contact) {
            record(b, p);
        } else if (b.is_ray()) {
            write_ray(world_.points[b.since], world_.points[p]);
        }
        if (b.edge != none) node_of_[b.edge] = none;
        status_.remove(node);
    }

    // Notes the stretch of a contact edge that ends at `p`, if it belongs to the backprojection.
    void record(const Boundary& b, std::int32_t p) {
        const Edge& edge = world_.edges[b.edge];
        if (!in_backprojection(b.state) || b.since == p) return;
        const double from = world_.distance(edge, b.since);
        const double to = world_.distance(edge, p);
        stretches_.push_back({edge.base, std::min(from, to), std::max(from, to)});
    }

    // The stretches in the order of a ContactSet, those that touch made one. What is avoidable
    // between two of them, however short, grows to more than the tolerance.
    void write_contact() {
        std::sort(stretches_.begin(), stretches_.end(), [](const Stretch& a, const Stretch& b) {
            return a.edge != b.edge ? a.edge < b.edge : a.low < b.low;
        });
        std::size_t kept = 0;
        for (Stretch stretch : stretches_) {
            if (kept > 0 && stretches_[kept - 1].edge == stretch.edge) {
                Stretch& last = stretches_[kept - 1];
                if (stretch.low <= last.high) {
                    last.high = std::max(last.high, stretch.high);
                    continue;
                }
                if (stretch.low - last.high <= tolerance_) {
                    last.high -= tolerance_;
                    stretch.low += tolerance_;
                }
            }
            stretches_[kept++] = stretch;
        }
        stretches_.resize(kept);
        for (const Stretch& stretch : stretches_) {
            if (stretch.high - stretch.low <= tolerance_) continue;
            result_.edge.push_back(stretch.edge);
            result_.low.push_back(stretch.low);
            result_.high.push_back(stretch.high);
        }
    }

    // Begins or ends the segment of the border that a boundary draws, as its sides have it. The
    // boundary is at point `p`, or anywhere.
    void refresh(std::int32_t node, std::int32_t p) {
        if (node == Status::first) return;
        Boundary& b = status_[node];
        const bool left = in_backprojection(status_[b.previous].right);
        const bool right = in_backprojection(b.right);
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

    void write_ray(Point from, Point to) {
        for (const Point& p : {from, to}) {
            double x;
            double y;
            world_.frame.leave(p, x, y);
            result_.rays.push_back(x);
            result_.rays.push_back(y);
        }
    }

    void write_rings() {
        Rings rings = join_rings(segments_, world_.points);
        result_.ring_points.reserve(2 * rings.points.size());
        for (std::int32_t p : rings.points) write_point(result_.ring_points, p);
        result_.ring_start = std::move(rings.start);
        result_.ring_shell = std::move(rings.shell);
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
    const double tip_spread_;  // of what a single avoidable point takes from above
    const double tolerance_;
    Status status_;
    Meetings meetings_;
    std::vector<std::int32_t> node_of_;  // by edge: its place in the status
    std::vector<Segment> segments_;
    std::vector<Stretch> stretches_;
    Backprojection result_;
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

}  // namespace

Backprojection backproject(const ContactSpaceView& contact, const TargetView& target, Frame frame,
                           double spread, double tolerance) {
    Arrangement arrangement(contact, target, frame, tolerance);
    return Sweep(arrangement, spread, tolerance).run();
}

}  // namespace preimage
