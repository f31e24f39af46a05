// The only file of the native side that knows Python.

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "execution/advance.hpp"
#include "execution/cells.hpp"
#include "execution/tracks.hpp"
#include "reachability/forward.hpp"
#include "reachability/sweep.hpp"

namespace nb = nanobind;

namespace {

template <typename T>
using Input = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

template <typename T>
std::span<const T> view(const Input<T>& array) {
    return {array.data(), array.size()};
}

// An array that owns what was a vector.
template <typename T>
nb::ndarray<nb::numpy, T, nb::ndim<1>> array(std::vector<T>&& values) {
    auto* kept = new std::vector<T>(std::move(values));
    nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return {kept->data(), {kept->size()}, owner};
}

using Ints = Input<std::int32_t>;
using Bytes = Input<std::uint8_t>;
using Doubles = Input<double>;

nb::tuple backproject(Doubles points, Ints next, Ints place, Bytes edge_code, Bytes vertex_code,
                      Ints target_edge, Doubles target_low, Doubles target_high,
                      Ints target_vertices, Ints beside_edge, Doubles beside_low,
                      Doubles beside_high, Doubles nodes, Ints node_vertex, Ints node_edge,
                      Doubles node_distance, Ints segment_from, Ints segment_to, double vx,
                      double vy, double step, double spread, double tolerance) {
    preimage::Backprojection result;
    {
        nb::gil_scoped_release unlocked;
        const preimage::ContactSpaceView contact{view(points), view(next), view(place),
                                                 view(edge_code), view(vertex_code)};
        const preimage::TargetView target{
            {view(target_edge), view(target_low), view(target_high)},
            view(target_vertices),
            {view(beside_edge), view(beside_low), view(beside_high)},
            view(nodes),
            view(node_vertex),
            view(node_edge),
            view(node_distance),
            view(segment_from),
            view(segment_to)};
        result = preimage::backproject(contact, target, {vx, vy, step}, spread, tolerance);
    }
    return nb::make_tuple(result.consistent, array(std::move(result.ring_points)),
                          array(std::move(result.ring_start)), array(std::move(result.ring_shell)),
                          array(std::move(result.edge)), array(std::move(result.low)),
                          array(std::move(result.high)), array(std::move(result.vertex)),
                          array(std::move(result.rays)), result.events);
}

// A set as it lies against contact space: the arrays of a TargetView, in its order.
class GivenSet {
public:
    explicit GivenSet(const nb::tuple& arrays)
        : ints_{at<Ints>(arrays, 0), at<Ints>(arrays, 3), at<Ints>(arrays, 4),
                at<Ints>(arrays, 8), at<Ints>(arrays, 9), at<Ints>(arrays, 11),
                at<Ints>(arrays, 12)},
          doubles_{at<Doubles>(arrays, 1), at<Doubles>(arrays, 2), at<Doubles>(arrays, 5),
                   at<Doubles>(arrays, 6), at<Doubles>(arrays, 7), at<Doubles>(arrays, 10)} {}

    preimage::TargetView target() const {
        return {{view(ints_[0]), view(doubles_[0]), view(doubles_[1])},
                view(ints_[1]),
                {view(ints_[2]), view(doubles_[2]), view(doubles_[3])},
                view(doubles_[4]),
                view(ints_[3]),
                view(ints_[4]),
                view(doubles_[5]),
                view(ints_[5]),
                view(ints_[6])};
    }

private:
    template <typename Array>
    static Array at(const nb::tuple& arrays, std::size_t place) {
        return nb::cast<Array>(arrays[place]);
    }

    std::array<Ints, 7> ints_;
    std::array<Doubles, 6> doubles_;
};

nb::tuple forward_project(Doubles points, Ints next, Ints place, Bytes edge_code, nb::tuple start,
                          nb::tuple stop, double vx, double vy, double step, double spread,
                          double tolerance) {
    const GivenSet from(start);
    const GivenSet until(stop);
    preimage::ForwardProjection result;
    {
        nb::gil_scoped_release unlocked;
        const preimage::ContactSpaceView contact{view(points), view(next), view(place),
                                                 view(edge_code), view(edge_code)};
        result = preimage::forward_project(contact, from.target(), until.target(),
                                           {-vx, -vy, step}, spread, tolerance);
    }
    return nb::make_tuple(result.consistent, array(std::move(result.ring_points)),
                          array(std::move(result.ring_start)), array(std::move(result.ring_shell)),
                          array(std::move(result.edge)), array(std::move(result.low)),
                          array(std::move(result.high)), array(std::move(result.vertex)),
                          array(std::move(result.escapes)), result.sweeps);
}

using Longs = Input<std::int64_t>;

nb::tuple advance(Doubles points, Doubles tangent, Doubles length, Ints next, Ints previous,
                  Bytes open, Bytes concave, Doubles gate_segments, Ints gate_start,
                  Doubles gate_marks, double friction, bool damper, double near, double tie,
                  Doubles x, Doubles y, Doubles along, Ints feature, Doubles angle,
                  Doubles duration, Doubles chance, Bytes wish) {
    preimage::Moves moves(0);
    {
        nb::gil_scoped_release unlocked;
        moves = preimage::advance(
            {view(points), view(tangent), view(length), view(next), view(previous), view(open),
             view(concave)},
            {view(gate_segments), view(gate_start), view(gate_marks)},
            {friction, damper, near, tie}, {view(x), view(y), view(along), view(feature)},
            {view(angle), view(duration), view(chance), view(wish)});
    }
    return nb::make_tuple(array(std::move(moves.x)), array(std::move(moves.y)),
                          array(std::move(moves.along)), array(std::move(moves.feature)),
                          array(std::move(moves.between)), array(std::move(moves.time)),
                          array(std::move(moves.doing)));
}

nb::ndarray<nb::numpy, double, nb::ndim<1>> first_return(Longs start, Doubles time, Doubles x,
                                                         Doubles y, double period,
                                                         Doubles reach) {
    std::vector<double> found;
    {
        nb::gil_scoped_release unlocked;
        found = preimage::first_return({view(start), view(time), view(x), view(y)}, period,
                                       view(reach));
    }
    return array(std::move(found));
}

nb::ndarray<nb::numpy, double, nb::ndim<1>> nearest(Doubles points, Doubles segments) {
    std::vector<double> found;
    {
        nb::gil_scoped_release unlocked;
        preimage::nearest(view(points), view(segments), found);
    }
    return array(std::move(found));
}

preimage::Cells cut_into_cells(Bytes zero, Doubles center, Doubles half, Doubles segments,
                               Ints set, Bytes part, double reach, double slack,
                               std::int32_t few, std::int64_t most) {
    nb::gil_scoped_release unlocked;
    return preimage::cut_into_cells({view(zero), view(center), view(half)},
                                    {view(segments), view(set), view(part)},
                                    {reach, slack, few, most});
}

nb::ndarray<nb::numpy, std::uint8_t, nb::ndim<1>> misses_all(const preimage::Cells& cells,
                                                             Doubles x, Doubles y,
                                                             Doubles force) {
    std::vector<std::uint8_t> found(x.size());
    {
        nb::gil_scoped_release unlocked;
        for (std::size_t i = 0; i < found.size(); ++i) {
            found[i] = cells.misses(x.data()[i], y.data()[i], force.data()[i]) ? 1 : 0;
        }
    }
    return array(std::move(found));
}

}  // namespace

NB_MODULE(_native, module) {
    module.doc() = "Compiled loops of preimage; each is called by one wrapper.";

    module.def(
        "version", [] { return PREIMAGE_VERSION; }, nb::call_guard<nb::gil_scoped_release>(),
        "The version that the module was built as.");
    module.def("backproject", &backproject,
               "Maximal backprojection; see preimage.reachability.backprojection.");
    module.def("forward_project", &forward_project,
               "Forward projection; see preimage.reachability.forward_projection.");
    module.def("advance", &advance,
               "One event of the generalized damper; see preimage.execution.damper.");
    module.def("first_return", &first_return,
               "When tracks come back; see preimage.execution.tracks.");
    // One reading takes less than the lock does: `misses` keeps it.
    nb::class_<preimage::Cells>(module, "Cells")
        .def("misses", &preimage::Cells::misses)
        .def("misses_all", &misses_all)
        .def_prop_ro("bytes", &preimage::Cells::bytes)
        .def_prop_ro("leaves", [](const preimage::Cells& cells) { return cells.leaves.size(); })
        .def_prop_ro("most", [](const preimage::Cells& cells) { return cells.most(); });
    module.def("cut_into_cells", &cut_into_cells,
               "The reading condition, compiled; see preimage.execution.cells.");
    module.def("nearest", &nearest, "Nearest points; see preimage.execution.nearest.");
}
