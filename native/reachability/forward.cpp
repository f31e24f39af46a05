#include "reachability/forward.hpp"

#include <array>

#include "reachability/line_sweep.hpp"

namespace preimage {

namespace {

constexpr std::uint8_t in_start = 1;
constexpr std::uint8_t in_stop = 2;

// What is known to be reached, by piece of an edge, by vertex, and by cut inside an edge.
struct Reached {
    Reached(std::size_t edges, std::size_t vertices, std::size_t points)
        : piece(edges, 0), vertex(vertices, 0), cut(points, 0) {}

    // Of a corner: a vertex, or the place of a cut.
    std::uint8_t& corner(std::int32_t name, std::int32_t point) {
        return name >= 0 ? vertex[name] : cut[point];
    }

    std::vector<std::uint8_t> piece;
    std::vector<std::uint8_t> vertex;
    std::vector<std::uint8_t> cut;
};

std::uint8_t slides_up(const Edge& edge) { return edge.code & (edge.rises ? kForward : kBackward); }
std::uint8_t slides_down(const Edge& edge) {
    return edge.code & (edge.rises ? kBackward : kForward);
}

// The set that grows is what is reached. One sweep follows all motions but the slides that go back,
// against the sweep; where those have led is given as seeds.
class Flood : public LineSweep<Flood> {
    friend class LineSweep<Flood>;

public:
    Flood(Arrangement& arrangement, const Reached& seeds, double spread, double tolerance)
        : LineSweep(arrangement, spread, tolerance),
          seeds_(seeds),
          found_(arrangement.edges.size(), arrangement.contact.next.size(),
                 arrangement.points.size()),
          whole_(arrangement.edges.size(), 0) {
        result_.escapes.assign(world_.contact.next.size(), 0);
    }

    bool run() { return sweep(); }

    ForwardProjection result() {
        result_.vertex = found_.vertex;
        write_contact();
        write_rings(result_);
        return std::move(result_);
    }

    // Follows the slides that go back, along edges and over vertices. Adds what they reach, if it
    // is new, to the seeds of the next sweep; false if nothing is.
    bool slide_back(Reached& seeds) {
        std::vector<std::int32_t> waiting;
        for (std::size_t e = 0; e < world_.edges.size(); ++e) {
            const Edge& edge = world_.edges[e];
            if (!goes_back(edge)) continue;
            const std::int32_t top = world_.upper(edge);
            const std::int32_t name = name_of(edge, top);
            if (found_.piece[e] || (found_.corner(name, top) && passes(name, top))) {
                waiting.push_back(static_cast<std::int32_t>(e));
            }
        }
        bool grew = false;
        while (!waiting.empty()) {
            const std::int32_t e = waiting.back();
            waiting.pop_back();
            const Edge& edge = world_.edges[e];
            if (!whole_[e]) {
                whole_[e] = seeds.piece[e] = 1;
                grew = true;
            }
            const std::int32_t foot = world_.lower(edge);
            const std::int32_t name = name_of(edge, foot);
            if (found_.corner(name, foot)) continue;
            found_.corner(name, foot) = seeds.corner(name, foot) = 1;
            grew = true;
            if (!passes(name, foot)) continue;
            for (std::int32_t other : world_.incident(foot)) {
                const Edge& next = world_.edges[other];
                if (other != e && goes_back(next) && world_.upper(next) == foot &&
                    name_of(next, foot) == name) {
                    waiting.push_back(other);
                }
            }
        }
        return grew;
    }

private:
    static bool grows(Piece piece) { return piece == Piece::Reached || piece == Piece::Start; }
    static bool drawn(Piece piece) { return grows(piece); }

    bool goes_back(const Edge& edge) const {
        return world_.is_contact(edge) && !(edge.code & kOpen) && !(edge.in_target & in_stop) &&
               slides_down(edge);
    }

    // The vertex at an end of an edge's piece, or a name for the cut there.
    std::int32_t name_of(const Edge& edge, std::int32_t p) const {
        if (p >= static_cast<std::int32_t>(world_.contact.next.size())) return -1 - edge.base;
        return edge.from == p ? edge.base : world_.contact.next[edge.base];
    }

    // Whether motions go on from a corner: it does not stop them, and they have not escaped.
    bool passes(std::int32_t name, std::int32_t p) const {
        if (name >= 0 && (world_.vertex_in_target[name] & in_stop)) return false;
        for (std::int32_t e : world_.incident(p)) {
            const Edge& edge = world_.edges[e];
            if (!world_.is_contact(edge) || name_of(edge, p) != name) continue;
            if ((edge.code & kOpen) || (name < 0 && (edge.in_target & in_stop))) return false;
        }
        return true;
    }

    // ---- rules ----------------------------------------------------------------------------------

    bool grows_at(std::int32_t vertex) const {
        return (world_.vertex_in_target[vertex] & in_start) || seeds_.vertex[vertex];
    }

    // Decides for each corner at `p` whether the robot gets there: because it starts there, slides
    // up to it, or flies to it; and whether it goes on.
    void judge_corners(std::int32_t p) {
        for (std::int32_t e : world_.incident(p)) {
            const Edge& edge = world_.edges[e];
            if (!world_.is_contact(edge)) continue;
            Corner& corner = corner_of(edge, p);
            if (edge.code & kOpen) corner.escapes = true;
            if (corner.name < 0) {
                corner.in_target |= edge.in_target;
                corner.grown |= (edge.in_target & in_start) || seeds_.cut[p];
            }
        }
        if (corners_.empty()) return;
        for (std::int32_t node : lower_) {
            const Boundary& b = status_[node];
            if (b.kind != Kind::Contact || b.state != Piece::Reached) continue;
            const Edge& edge = world_.edges[b.edge];
            if (!(edge.in_target & in_stop) && slides_up(edge)) corner_of(edge, p).grown = true;
        }
        for (std::size_t gap = 0; gap < gaps_.size(); ++gap) {
            if (!grows(gaps_[gap]) || !cone_meets(gap)) continue;
            if (Corner* corner = corner_below(gap, p)) corner->grown = true;
        }
        for (Corner& corner : corners_) {
            if (!corner.grown) continue;
            found_.corner(corner.name, p) = 1;
            if (corner.in_target & in_stop) {
                corner.grown = false;
            } else if (corner.escapes) {
                escape_at(corner.name, p);
                corner.grown = false;
            }
        }
    }

    void escape_at(std::int32_t name, std::int32_t p) {
        for (std::int32_t e : world_.incident(p)) {
            const Edge& edge = world_.edges[e];
            if (world_.is_contact(edge) && (edge.code & kOpen) && name_of(edge, p) == name) {
                result_.escapes[edge.base] = 1;
            }
        }
    }

    Piece state(std::int32_t e, std::int32_t p) {
        const Edge& edge = world_.edges[e];
        if (edge.code & kOpen) return Piece::Untouched;
        const bool slides =
            !(edge.in_target & in_stop) && slides_up(edge) && corner_of(edge, p).grown;
        const bool reached = (edge.in_target & in_start) || seeds_.piece[e] || slides;
        return reached ? Piece::Reached : Piece::Untouched;
    }

    // An edge along a side of the cone is met, as ties go.
    bool clears(double gap) const { return gap > tie_; }

    // Whether the robot comes from a boundary into the sector on its right, or on its left.
    bool pushes(const Boundary& b, bool rightwards) const {
        const Edge& edge = world_.edges[b.edge];
        if (b.kind == Kind::Border) return side(edge, !rightwards) == Piece::Start;
        return b.state == Piece::Reached && !(edge.in_target & in_stop);
    }

    // An edge beside space that is reached is reached where the robot may fly to it.
    bool is_met(const Boundary& b, Piece beside) {
        if (b.kind != Kind::Contact || !grows(beside)) return false;
        const Edge& edge = world_.edges[b.edge];
        if (!(edge.code & kTouches)) return false;
        if (edge.code & kOpen) result_.escapes[edge.base] = 1;
        return b.state == Piece::Untouched && !(edge.code & kOpen);
    }

    void touch(Boundary& b, Piece beside) {
        if (is_met(b, beside)) b.state = Piece::Reached;
    }

    // A contact edge borders on another piece from `p` on.
    void face(std::int32_t node, Piece beside, std::int32_t p) {
        Boundary& b = status_[node];
        if (is_met(b, beside)) {
            b.state = Piece::Reached;
            b.since = p;
        } else if (b.kind == Kind::Contact && b.state == Piece::Reached && !grows(beside) &&
                   !keeps_on(b.edge)) {
            record(b, p);
            b.state = Piece::Untouched;
            b.since = p;
        }
    }

    // Whether an edge that is reached stays so further up, whatever is beside it.
    bool keeps_on(std::int32_t e) const {
        const Edge& edge = world_.edges[e];
        return (edge.in_target & in_start) || seeds_.piece[e] ||
               (!(edge.in_target & in_stop) && slides_up(edge));
    }

    // What an edge that rises from the point has on its left or right.
    Piece side(const Edge& edge, bool right) const {
        const bool on_left_of_travel = edge.rises != right;
        if (!on_left_of_travel) return world_.is_contact(edge) ? Piece::Solid : Piece::Untouched;
        if (edge.beside_target & in_stop) return Piece::Stop;
        return edge.beside_target & in_start ? Piece::Start : Piece::Untouched;
    }

    // What a sector above the point is made of; Untouched stands for free space that may yet be
    // reached. About obstacles both sides must agree.
    Piece material(Piece left, Piece right) {
        if ((left == Piece::Solid) != (right == Piece::Solid)) consistent_ = false;
        if (left == Piece::Solid) return Piece::Solid;
        return left == right && (left == Piece::Start || left == Piece::Stop) ? left
                                                                              : Piece::Untouched;
    }

    // ---- output ---------------------------------------------------------------------------------

    void record(const Boundary& b, std::int32_t p) {
        if (b.state != Piece::Reached || b.since == p) return;
        const Edge& edge = world_.edges[b.edge];
        found_.piece[b.edge] = 1;
        if (b.since == world_.lower(edge) && p == world_.upper(edge)) whole_[b.edge] = 1;
        const double from = world_.distance(edge, b.since);
        const double to = world_.distance(edge, p);
        stretches_.push_back({edge.base, std::min(from, to), std::max(from, to)});
    }

    // The stretches in the order of a ContactSet; those that nearly touch made one, and those that
    // are next to nothing, widened.
    void write_contact() {
        add_cuts();
        std::sort(stretches_.begin(), stretches_.end(), [](const Stretch& a, const Stretch& b) {
            return a.edge != b.edge ? a.edge < b.edge : a.low < b.low;
        });
        for (Stretch stretch : stretches_) {
            if (stretch.high - stretch.low <= tolerance_) {
                const Point a = world_.points[stretch.edge];
                const Point b = world_.points[world_.contact.next[stretch.edge]];
                stretch.low = std::max(stretch.low - tolerance_, 0.0);
                stretch.high =
                    std::min(stretch.high + tolerance_, std::hypot(b.u - a.u, b.h - a.h));
            }
            if (!result_.edge.empty() && result_.edge.back() == stretch.edge &&
                stretch.low <= result_.high.back() + tolerance_) {
                result_.high.back() = std::max(result_.high.back(), stretch.high);
                continue;
            }
            result_.edge.push_back(stretch.edge);
            result_.low.push_back(stretch.low);
            result_.high.push_back(stretch.high);
        }
    }

    // Cuts that are reached, alone or at the end of a stretch.
    void add_cuts() {
        for (const Edge& edge : world_.edges) {
            if (!world_.is_contact(edge) || (edge.code & kOpen)) continue;
            for (const std::int32_t p : {edge.from, edge.to}) {
                if (name_of(edge, p) >= 0 || !found_.cut[p]) continue;
                const double place = world_.distance(edge, p);
                stretches_.push_back({edge.base, place, place});
            }
        }
    }

    void record_ray(Point, Point) {}

    const double tie_ = angle_tie(spread_);
    const Reached& seeds_;
    Reached found_;
    std::vector<std::uint8_t> whole_;  // by piece of an edge: reached from end to end
    std::vector<Stretch> stretches_;
    ForwardProjection result_;
};

}  // namespace

ForwardProjection forward_project(const ContactSpaceView& contact, const TargetView& start,
                                  const TargetView& stop, Frame frame, double spread,
                                  double tolerance) {
    const std::array<TargetView, 2> sets{start, stop};
    Arrangement arrangement(contact, sets, frame, tolerance);
    const std::size_t given = arrangement.points.size();
    Reached seeds(arrangement.edges.size(), contact.next.size(), given);
    for (std::int64_t sweeps = 1;; ++sweeps) {
        Flood flood(arrangement, seeds, spread, tolerance);
        if (!flood.run()) {
            ForwardProjection failed;
            failed.consistent = false;
            return failed;
        }
        if (!flood.slide_back(seeds)) {
            ForwardProjection result = flood.result();
            result.sweeps = sweeps;
            return result;
        }
        arrangement.points.resize(given);
    }
}

}  // namespace preimage
