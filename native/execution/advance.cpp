#include "execution/advance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace preimage {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double quarter = 0.5 * std::numbers::pi;
constexpr double full = 2.0 * std::numbers::pi;

// Moves are interrupted so many `near` behind a border, where nothing is taken for a vertex any
// more; a border that a robot stands on, or has just crossed by less than half of that, is ahead.
constexpr double behind = 4.0;

struct Vec {
    double x, y;
};

struct State {
    Vec at;
    std::int32_t feature;
    double along;
};

struct Step {
    State end;
    std::int32_t between;
    Doing doing;
    double time;
};

// What nature may make of an actual direction at a vertex.
struct Option {
    Doing doing;
    std::int32_t edge;
};

struct Options {
    std::array<Option, 4> list{};
    int count = 0;
    void add(Doing doing, std::int32_t edge) {
        list[static_cast<std::size_t>(count++)] = {doing, edge};
    }
};

class World {
public:
    World(const WallsView& walls, const GatesView& gates, const Law& law)
        : walls_(walls), gates_(gates), law_(law), n_(walls.size()) {}

    Step step(const State& from, double angle, double duration, Wish wish, double chance) const {
        const Vec u{std::cos(angle), std::sin(angle)};
        if (from.feature == 2 * n_) return fly(from, u, duration);
        if (from.feature < n_) {
            const double a = pressing(from.feature, u);
            if (std::abs(a) > quarter + law_.tie) return fly(from, u, duration);
            if (std::abs(a) <= law_.friction + law_.tie) return rest(from, duration);
            return slide(from, from.feature, a, duration);
        }
        const std::int32_t vertex = from.feature - n_;
        const Option chosen = choose(options(vertex, u), wish, chance);
        switch (chosen.doing) {
            case Doing::flies: return fly(from, u, duration);
            case Doing::slides:
                return slide(from, chosen.edge, pressing(chosen.edge, u), duration);
            default: return rest(from, duration);
        }
    }

private:
    Vec point(std::int32_t i) const {
        return {walls_.points[2 * at(i)], walls_.points[2 * at(i) + 1]};
    }
    Vec tangent(std::int32_t i) const {
        return {walls_.tangent[2 * at(i)], walls_.tangent[2 * at(i) + 1]};
    }
    static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

    bool is_near(std::int32_t vertex, Vec p) const {
        const Vec q = point(vertex);
        return std::abs(q.x - p.x) <= law_.near && std::abs(q.y - p.y) <= law_.near;
    }

    // a = angle(nu, -v*): positive where v* drives along the edge's own tangent.
    double pressing(std::int32_t edge, Vec u) const {
        const Vec t = tangent(edge);
        return std::atan2(t.x * u.x + t.y * u.y, t.y * u.x - t.x * u.y);
    }

    double speed(double a) const {
        if (!law_.damper) return std::sin(std::abs(a));
        if (law_.friction >= quarter) return 1.0;
        return std::sin(std::abs(a) - law_.friction) / std::cos(law_.friction);
    }

    static Step rest(const State& from, double duration) {
        return {from, from.feature, Doing::rests, duration};
    }

    // --- at a vertex ------------------------------------------------------------------------

    // -v* in [nu1 - phi, nu2 + phi], the hull of both friction cones (theory 2).
    bool held(std::int32_t vertex, Vec u) const {
        const std::int32_t previous = walls_.previous[at(vertex)];
        const Vec in = tangent(previous), out = tangent(vertex);
        const double turn = std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
        const double past = pressing(previous, u);  // from nu1 to -v*
        const double slack = law_.friction + law_.tie;
        return (past >= -slack && past <= turn + slack) || past + full <= turn + slack;
    }

    Options options(std::int32_t vertex, Vec u) const {
        Options found;
        const bool concave = walls_.concave[at(vertex)] != 0;
        if (concave && held(vertex, u)) {
            found.add(Doing::rests, -1);
            return found;
        }
        bool may_rest = false;
        const std::int32_t before = walls_.previous[at(vertex)];
        for (const std::int32_t edge : {before, vertex}) {
            if (walls_.open[at(edge)]) continue;
            const double a = pressing(edge, u);
            const Vec t = tangent(edge);
            const double onward = (t.x * u.x + t.y * u.y) * (edge == vertex ? 1.0 : -1.0);
            if (std::abs(a) <= law_.friction + law_.tie)
                may_rest = true;
            else if (std::abs(a) <= quarter + law_.tie && onward > 0.0)
                found.add(Doing::slides, edge);
        }
        if (may_rest && !concave) found.add(Doing::rests, -1);
        if (in_wedge(vertex, u)) found.add(Doing::flies, -1);
        if (found.count == 0) found.add(Doing::rests, -1);
        return found;
    }

    // Whether a direction points into the free space at a vertex.
    bool in_wedge(std::int32_t vertex, Vec u) const {
        const Vec ahead = tangent(vertex), in = tangent(walls_.previous[at(vertex)]);
        const double left_of_ahead = ahead.x * u.y - ahead.y * u.x;
        const double left_of_in = in.x * u.y - in.y * u.x;
        if (walls_.concave[at(vertex)]) return left_of_ahead > 0.0 && left_of_in > 0.0;
        return left_of_ahead > 0.0 || left_of_in > 0.0;
    }

    static Option choose(const Options& options, Wish wish, double chance) {
        const auto wanted = wish == Wish::rest    ? Doing::rests
                            : wish == Wish::slide ? Doing::slides
                                                  : Doing::flies;
        Options fitting;
        if (wish != Wish::any)
            for (int i = 0; i < options.count; ++i) {
                const Option option = options.list[static_cast<std::size_t>(i)];
                if (option.doing == wanted) fitting.add(option.doing, option.edge);
            }
        const Options& from = fitting.count > 0 ? fitting : options;
        const int pick = static_cast<int>(chance * from.count);
        return from.list[static_cast<std::size_t>(std::min(std::max(pick, 0), from.count - 1))];
    }

    // --- along an edge ------------------------------------------------------------------------

    Step slide(const State& from, std::int32_t edge, double a, double duration) const {
        const double length = walls_.length[at(edge)];
        const double begin = from.feature < n_             ? from.along
                             : from.feature - n_ == edge ? 0.0
                                                         : length;
        const bool forward = a > 0.0;
        const double fast = speed(a);
        double reach = forward ? length - begin : begin;
        if (!(fast > 0.0)) return {from, edge, Doing::slides, duration};
        const double gate = mark_ahead(edge, begin, forward);
        reach = std::min({reach, gate, fast * duration});
        double stop = forward ? begin + reach : begin - reach;
        State end{{}, edge, stop};
        if (stop >= length - law_.near) {
            end.feature = n_ + walls_.next[at(edge)];
            end.at = point(walls_.next[at(edge)]);
            reach = forward ? length - begin : reach;
        } else if (stop <= law_.near) {
            end.feature = n_ + edge;
            end.at = point(edge);
            reach = forward ? reach : begin;
        } else {
            const Vec p = point(edge), t = tangent(edge);
            end.at = {p.x + stop * t.x, p.y + stop * t.y};
        }
        return {end, edge, Doing::slides, reach / fast};
    }

    // How far it is to just behind the next mark on an edge.
    double mark_ahead(std::int32_t edge, double begin, bool forward) const {
        double best = infinite;
        for (auto i = walls_marks(edge); i < walls_marks(edge + 1); ++i) {
            const double mark = gates_.marks[i];
            const double gap = forward ? mark - begin : begin - mark;
            if (gap > -0.5 * behind * law_.near) best = std::min(best, gap + behind * law_.near);
        }
        return best;
    }
    std::size_t walls_marks(std::int32_t edge) const {
        return static_cast<std::size_t>(gates_.start[at(edge)]);
    }

    // --- through free space -------------------------------------------------------------------

    Step fly(const State& from, Vec u, double duration) const {
        const Vec p = from.at;
        const std::int32_t own = from.feature < n_ ? from.feature : -1;
        const bool corner = from.feature >= n_ && from.feature < 2 * n_;
        const double limit = std::min(duration, gate_ahead(p, u));
        double best = limit + law_.near, best_along = 0.0;
        std::int32_t hit = -1;
        for (std::int32_t i = 0; i < n_; ++i) {
            const Vec t = tangent(i);
            const double toward = t.y * u.x - t.x * u.y;
            if (!(toward > 0.0)) continue;
            const Vec off{p.x - walls_.points[2 * at(i)], p.y - walls_.points[2 * at(i) + 1]};
            const double height = t.x * off.y - t.y * off.x;
            if (height > best * toward || height < -law_.near) continue;
            const double reach = std::max(height, 0.0) / toward;
            const double along = t.x * (off.x + reach * u.x) + t.y * (off.y + reach * u.y);
            if (along < -law_.near || along > walls_.length[at(i)] + law_.near) continue;
            if (!(reach < best) || i == own) continue;
            // the wedge is left: what meets there belongs to it or faces the other way
            if (corner && (is_near(i, p) || is_near(walls_.next[at(i)], p))) continue;
            best = reach;
            best_along = along;
            hit = i;
        }
        if (hit < 0) {
            const State end{{p.x + limit * u.x, p.y + limit * u.y}, 2 * n_, 0.0};
            return {end, 2 * n_, Doing::flies, limit};
        }
        const double length = walls_.length[at(hit)];
        if (best_along <= law_.near || best_along >= length - law_.near) {
            const std::int32_t vertex = best_along <= law_.near ? hit : walls_.next[at(hit)];
            const std::int32_t met = met_wedge(vertex, p);
            return {{point(met), n_ + met, 0.0}, 2 * n_, Doing::flies, best};
        }
        const Vec q = point(hit), t = tangent(hit);
        const State end{{q.x + best_along * t.x, q.y + best_along * t.y}, hit, best_along};
        return {end, 2 * n_, walls_.open[at(hit)] ? Doing::escapes : Doing::flies, best};
    }

    // How far a flight is from just behind the next border that it crosses.
    double gate_ahead(Vec p, Vec u) const {
        double best = infinite;
        const std::size_t count = gates_.segments.size() / 4;
        for (std::size_t i = 0; i < count; ++i) {
            const double* s = &gates_.segments[4 * i];
            const double ex = s[2] - s[0], ey = s[3] - s[1];
            const double turn = u.x * ey - u.y * ex;
            if (turn == 0.0) continue;
            const double ox = s[0] - p.x, oy = s[1] - p.y;
            const double part = (ox * u.y - oy * u.x) / turn;
            const double rim = law_.near / std::hypot(ex, ey);
            if (part < -rim || part > 1.0 + rim) continue;
            const double reach = (ox * ey - oy * ex) / turn;
            if (reach > -0.5 * behind * law_.near && reach < best) best = reach;
        }
        return best + behind * law_.near;
    }

    // Of the vertices at one position, that in whose wedge a flight from `p` arrives.
    std::int32_t met_wedge(std::int32_t vertex, Vec p) const {
        const Vec corner = point(vertex);
        const Vec back{p.x - corner.x, p.y - corner.y};
        std::int32_t best = vertex;
        double least = infinite;
        for (std::int32_t i = 0; i < n_; ++i) {
            if (!is_near(i, corner)) continue;
            const double off = beyond_wedge(i, back);
            if (off < least) {
                least = off;
                best = i;
            }
        }
        return best;
    }

    // By which angle a direction lies beyond the free wedge of a vertex; negative inside.
    double beyond_wedge(std::int32_t vertex, Vec back) const {
        const Vec ahead = tangent(vertex), in = tangent(walls_.previous[at(vertex)]);
        double span = std::atan2(-in.y, -in.x) - std::atan2(ahead.y, ahead.x);
        span -= full * std::floor(span / full);
        const double middle = std::atan2(ahead.y, ahead.x) + 0.5 * span;
        return std::abs(std::remainder(std::atan2(back.y, back.x) - middle, full)) - 0.5 * span;
    }

    const WallsView& walls_;
    const GatesView& gates_;
    const Law& law_;
    std::int32_t n_;
};

}  // namespace

Moves advance(const WallsView& walls, const GatesView& gates, const Law& law,
              const RobotsView& robots, const ChoicesView& choices) {
    const World world(walls, gates, law);
    const std::size_t count = robots.x.size();
    Moves moves(count);
    for (std::size_t i = 0; i < count; ++i) {
        const State from{{robots.x[i], robots.y[i]}, robots.feature[i], robots.along[i]};
        const Step step = world.step(from, choices.angle[i], choices.duration[i],
                                     static_cast<Wish>(choices.wish[i]), choices.chance[i]);
        moves.x[i] = step.end.at.x;
        moves.y[i] = step.end.at.y;
        moves.along[i] = step.end.along;
        moves.feature[i] = step.end.feature;
        moves.between[i] = step.between;
        moves.time[i] = step.time;
        moves.doing[i] = static_cast<std::uint8_t>(step.doing);
    }
    return moves;
}

}  // namespace preimage
