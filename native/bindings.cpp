// The only file of the native side that knows Python.

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

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

}  // namespace

NB_MODULE(_native, module) {
    module.doc() = "Compiled loops of preimage; each is called by one wrapper.";

    module.def(
        "version", [] { return PREIMAGE_VERSION; }, nb::call_guard<nb::gil_scoped_release>(),
        "The version that the module was built as.");
    module.def("backproject", &backproject,
               "Maximal backprojection; see preimage.reachability.backprojection.");
}
