// Sets of angles as closed intervals of doubles.
#pragma once

#include <utility>
#include <vector>

namespace preimage {

using Interval = std::pair<double, double>;

// The angles in [-pi, pi] no further from `center` than `half`: all doubles that pass the very
// comparison of the plain definition (recognition/readings.py), and no others.
std::vector<Interval> angles(double center, double half);

// Intervals in ascending order, those that meet united.
std::vector<Interval> united(std::vector<Interval> intervals);

}  // namespace preimage
