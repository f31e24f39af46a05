#include "execution/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace preimage {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Vec {
    double x, y;
};

// Walks along one track; times may only grow from call to call.
class Walker {
public:
    Walker(const TracksView& tracks, std::size_t first, std::size_t last)
        : tracks_(tracks), leg_(first), last_(last) {}

    // Where the track is at `time`, and the end of the leg that goes on from there.
    Vec at(double time) {
        while (leg_ + 1 < last_ && tracks_.time[leg_ + 1] <= time) ++leg_;
        const std::size_t next = std::min(leg_ + 1, last_);
        const double length = tracks_.time[next] - tracks_.time[leg_];
        const double part =
            length > 0.0 ? std::clamp((time - tracks_.time[leg_]) / length, 0.0, 1.0) : 0.0;
        return {tracks_.x[leg_] + part * (tracks_.x[next] - tracks_.x[leg_]),
                tracks_.y[leg_] + part * (tracks_.y[next] - tracks_.y[leg_])};
    }
    double leg_end() const { return leg_ < last_ ? tracks_.time[leg_ + 1] : infinite; }
    // Where the present leg is at its end, or on the way: no step to the next leg.
    Vec on_leg(double time) const {
        const std::size_t next = std::min(leg_ + 1, last_);
        const double length = tracks_.time[next] - tracks_.time[leg_];
        const double part =
            length > 0.0 ? std::clamp((time - tracks_.time[leg_]) / length, 0.0, 1.0) : 1.0;
        return {tracks_.x[leg_] + part * (tracks_.x[next] - tracks_.x[leg_]),
                tracks_.y[leg_] + part * (tracks_.y[next] - tracks_.y[leg_])};
    }

private:
    const TracksView& tracks_;
    std::size_t leg_, last_;
};

// The least s in [0, 1] with |gap + s * change| <= reach; infinite if there is none.
double first_within(Vec gap, Vec change, double reach) {
    if (reach < 0.0) return infinite;
    const double c = gap.x * gap.x + gap.y * gap.y - reach * reach;
    if (c <= 0.0) return 0.0;
    const double a = change.x * change.x + change.y * change.y;
    const double b = gap.x * change.x + gap.y * change.y;
    const double root = b * b - a * c;
    if (!(b < 0.0) || root < 0.0) return infinite;
    const double s = c / (-b + std::sqrt(root));
    return s <= 1.0 ? s : infinite;
}

double return_of(const TracksView& tracks, std::size_t first, std::size_t last, double period,
                 double reach) {
    const double end = tracks.time[last];
    double then = tracks.time[first], now = then + period;
    if (!(now <= end)) return infinite;
    Walker ahead(tracks, first, last), behind(tracks, first, last);
    while (true) {
        const Vec p = ahead.at(now), q = behind.at(then);
        const Vec gap{p.x - q.x, p.y - q.y};
        // to the next instant at which either changes its leg
        const double turn = behind.leg_end();
        const double until = std::min({ahead.leg_end(), turn + period, end});
        const double before = until == turn + period ? turn : until - period;
        const Vec p1 = ahead.on_leg(until), q1 = behind.on_leg(before);
        const double part =
            first_within(gap, {p1.x - q1.x - gap.x, p1.y - q1.y - gap.y}, reach);
        if (part <= 1.0) return now + part * std::max(until - now, 0.0);
        if (until >= end) return infinite;
        now = until;
        then = before;
    }
}

}  // namespace

std::vector<double> first_return(const TracksView& tracks, double period,
                                 std::span<const double> reach) {
    std::vector<double> found(reach.size(), infinite);
    for (std::size_t i = 0; i < reach.size(); ++i) {
        const auto first = static_cast<std::size_t>(tracks.start[i]);
        const auto past = static_cast<std::size_t>(tracks.start[i + 1]);
        if (past > first) found[i] = return_of(tracks, first, past - 1, period, reach[i]);
    }
    return found;
}

void nearest(std::span<const double> points, std::span<const double> segments,
             std::vector<double>& found) {
    found.assign(points.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
        double least = infinite;
        for (std::size_t k = 0; k + 3 < segments.size(); k += 4) {
            const double* s = &segments[k];
            const double ex = s[2] - s[0], ey = s[3] - s[1];
            const double ox = points[i] - s[0], oy = points[i + 1] - s[1];
            const double square = ex * ex + ey * ey;
            const double part =
                square > 0.0 ? std::clamp((ox * ex + oy * ey) / square, 0.0, 1.0) : 0.0;
            const double gx = ox - part * ex, gy = oy - part * ey;
            const double gap = gx * gx + gy * gy;
            if (gap < least) {
                least = gap;
                found[i] = s[0] + part * ex;
                found[i + 1] = s[1] + part * ey;
            }
        }
    }
}

}  // namespace preimage
