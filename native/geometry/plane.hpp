// The plane as the sweep sees it: `u` across, `h` up, the commanded direction pointing down.
#pragma once

#include <cmath>

namespace preimage {

struct Point {
    double u;
    double h;
};

struct Vector {
    double u;
    double h;
};

// The order in which the sweep meets points: by height; level points from left to right, as if
// the sweep line leaned by an infinitesimal angle.
inline bool before(Point a, Point b) { return a.h < b.h || (a.h == b.h && a.u < b.u); }

// Positive where `p` lies to the left of the line through `origin` along the rising `direction`.
inline double leftness(Point origin, Vector direction, Point p) {
    return direction.u * (p.h - origin.h) - direction.h * (p.u - origin.u);
}

// Turns the plane so that a commanded direction (vx, vy) points down; lengths are kept, and
// multiples of a quarter turn are exact. Heights are rounded to multiples of `step`, a power of
// two far below the tolerance, so that what is level stays level.
struct Frame {
    double vx;
    double vy;
    double step;

    Point enter(double x, double y) const {
        return {vx * y - vy * x, level(-(vx * x + vy * y))};
    }
    double level(double h) const { return std::nearbyint(h / step) * step; }
    void leave(Point p, double& x, double& y) const {
        x = -vy * p.u - vx * p.h;
        y = vx * p.u - vy * p.h;
    }
};

}  // namespace preimage
