#include "reachability/sweep.hpp"

#include "reachability/line_sweep.hpp"

namespace preimage {

namespace {

// The set that grows is what nature can keep from the target.
class Sweep : public LineSweep<Sweep> {
    friend class LineSweep<Sweep>;

public:
    Sweep(Arrangement& arrangement, double spread, double tolerance)
        : LineSweep(arrangement, spread, tolerance) {
        result_.vertex.assign(world_.contact.next.size(), 0);
    }

    Backprojection run() {
        result_.consistent = sweep();
        result_.events = events_;
        if (result_.consistent) {
            write_contact();
            write_rings(result_);
        }
        return std::move(result_);
    }

private:
    static bool grows(Piece piece) { return piece == Piece::Avoidable; }
    static bool drawn(Piece piece) { return in_backprojection(piece); }

    bool grows_at(std::int32_t vertex) const {
        return (world_.contact.vertex_code[vertex] & kMayStick) != 0;
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
                corner.grown |= (edge.code & kMayStick) != 0;
            }
        }
        if (corners_.empty()) return;
        for (std::int32_t node : lower_) {
            const Boundary& b = status_[node];
            if (b.kind != Kind::Contact || b.state != Piece::Avoidable) continue;
            const Edge& edge = world_.edges[b.edge];
            if (edge.code & kMaySlide) corner_of(edge, p).grown = true;
        }
        for (std::size_t gap = 0; gap < gaps_.size(); ++gap) {
            if (gaps_[gap] != Piece::Avoidable || !cone_meets(gap)) continue;
            if (Corner* corner = corner_below(gap, p)) corner->grown = true;
        }
        for (Corner& corner : corners_) {
            corner.grown = !corner.in_target && (corner.escapes || corner.grown);
            if (corner.name >= 0) result_.vertex[corner.name] = !corner.grown;
        }
    }

    static bool clears(double gap) { return gap > 0.0; }

    static bool pushes(const Boundary& b, bool) {
        return b.kind == Kind::Contact && b.state == Piece::Avoidable;
    }

    // A contact edge beside avoidable space is avoidable where the robot may leave it.
    void touch(Boundary& b, Piece beside) const {
        if (b.kind == Kind::Contact && beside == Piece::Avoidable && b.state == Piece::Good &&
            (world_.edges[b.edge].code & kMayLeave)) {
            b.state = Piece::Avoidable;
        }
    }

    Piece state(std::int32_t e, std::int32_t p) {
        const Edge& edge = world_.edges[e];
        const bool slides = (edge.code & kMaySlide) && corner_of(edge, p).grown;
        if (edge.code & kOpen) return Piece::Avoidable;
        if (edge.in_target) return Piece::Target;
        return (edge.code & kMayStick) || slides ? Piece::Avoidable : Piece::Good;
    }

    // What an edge that rises from the point has on its left or right.
    Piece side(const Edge& edge, bool right) const {
        const bool on_left_of_travel = edge.rises != right;
        if (!world_.is_contact(edge)) return on_left_of_travel ? Piece::Target : Piece::Good;
        if (!on_left_of_travel) return Piece::Solid;
        return edge.beside_target ? Piece::Target : Piece::Good;
    }

    // What a sector above the point is made of; Good stands for free space outside the target,
    // avoidable or not. Where the target's border and the pieces below disagree, up to rounding,
    // it is not the target; about obstacles they must not disagree.
    Piece material(Piece left, Piece right) {
        if ((left == Piece::Solid) != (right == Piece::Solid)) consistent_ = false;
        if (left == Piece::Solid) return Piece::Solid;
        return left == Piece::Target && right == Piece::Target ? Piece::Target : Piece::Good;
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
    void record_ray(Point from, Point to) {
        for (const Point& p : {from, to}) {
            double x;
            double y;
            world_.frame.leave(p, x, y);
            result_.rays.push_back(x);
            result_.rays.push_back(y);
        }
    }

    std::vector<Stretch> stretches_;
    Backprojection result_;
};

}  // namespace

Backprojection backproject(const ContactSpaceView& contact, const TargetView& target, Frame frame,
                           double spread, double tolerance) {
    Arrangement arrangement(contact, target, frame, tolerance);
    return Sweep(arrangement, spread, tolerance).run();
}

}  // namespace preimage
