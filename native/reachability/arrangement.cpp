#include "reachability/arrangement.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace preimage {

namespace {

// A place on a contact edge at which something about the target changes.
struct Cut {
    std::int32_t edge;
    double distance;
    std::int32_t node;         // the node of a target that lies there, or -1
    std::uint8_t set;          // which target
    std::int8_t in_target;     // +1 where an interval of the target begins, -1 where it ends
    std::int8_t beside_target; // the same for the target's area along the edge
};

constexpr std::size_t most_sets = 8;

// How many intervals of each set are open.
struct Cover {
    std::array<int, most_sets> count{};

    void add(std::uint8_t set, int step) { count[set] += step; }

    std::uint8_t bits() const {
        unsigned found = 0;
        for (std::size_t set = 0; set < most_sets; ++set) {
            if (count[set] > 0) found |= 1u << set;
        }
        return static_cast<std::uint8_t>(found);
    }
};

}  // namespace

Arrangement::Arrangement(const ContactSpaceView& contact_, std::span<const TargetView> sets,
                         Frame frame_, double tolerance)
    : contact(contact_), frame(frame_) {
    const auto n = static_cast<std::int32_t>(contact.next.size());
    points.reserve(n + 64);
    edges.reserve(n + 64);
    for (std::int32_t i = 0; i < n; ++i) {
        points.push_back(frame.enter(contact.points[2 * i], contact.points[2 * i + 1]));
    }
    for (std::int32_t i = 0; i < n; ++i) {
        edges.push_back({contact.place[i], contact.place[contact.next[i]], i, contact.edge_code[i],
                         0, 0, false});
    }
    vertex_in_target.assign(n, 0);
    for (std::size_t set = 0; set < sets.size(); ++set) {
        for (std::int32_t vertex : sets[set].vertices) vertex_in_target[vertex] |= 1u << set;
    }
    cut_edges(sets, tolerance);
    add_border(sets);
    for (Edge& e : edges) e.rises = before(points[e.from], points[e.to]);
    index_incidence();
}

// The point at a part `t` of the way from `a` to `b`, between the last cut and `b` in the order of
// the sweep: rounded to a level, unless that would turn the edge back.
Point Arrangement::cut_between(Point a, Point last, Point b, double t) const {
    const Point exact{a.u + t * (b.u - a.u), a.h + t * (b.h - a.h)};
    const Point level{exact.u, frame.level(exact.h)};
    const bool rises = before(a, b);
    return before(last, level) == rises && before(level, b) == rises ? level : exact;
}

void Arrangement::cut_edges(std::span<const TargetView> sets, double tolerance) {
    std::vector<Cut> cuts;
    for (std::size_t number = 0; number < sets.size(); ++number) {
        const TargetView& target = sets[number];
        const auto set = static_cast<std::uint8_t>(number);
        cuts.reserve(cuts.size() + 2 * (target.contact.edge.size() + target.beside.edge.size()));
        for (std::size_t i = 0; i < target.contact.edge.size(); ++i) {
            cuts.push_back({target.contact.edge[i], target.contact.low[i], -1, set, 1, 0});
            cuts.push_back({target.contact.edge[i], target.contact.high[i], -1, set, -1, 0});
        }
        for (std::size_t i = 0; i < target.beside.edge.size(); ++i) {
            cuts.push_back({target.beside.edge[i], target.beside.low[i], -1, set, 0, 1});
            cuts.push_back({target.beside.edge[i], target.beside.high[i], -1, set, 0, -1});
        }
        const std::size_t base = node_point_.size();
        node_point_.resize(base + target.node_vertex.size(), -1);
        for (std::size_t i = 0; i < target.node_vertex.size(); ++i) {
            if (target.node_vertex[i] >= 0) {
                node_point_[base + i] = contact.place[target.node_vertex[i]];
            } else if (target.node_edge[i] >= 0) {
                cuts.push_back({target.node_edge[i], target.node_distance[i],
                                static_cast<std::int32_t>(base + i), set, 0, 0});
            }
        }
    }
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.distance < b.distance;
    });

    for (std::size_t begin = 0, end = 0; begin < cuts.size(); begin = end) {
        const std::int32_t base = cuts[begin].edge;
        const std::int32_t last_point = contact.place[contact.next[base]];
        const Point a = points[base];
        const Point b = points[contact.next[base]];
        const double length = std::hypot(b.u - a.u, b.h - a.h);

        // cuts within the tolerance of each other, or of an end of the edge, are one place
        double place = 0.0;
        std::int32_t point = contact.place[base];
        std::int32_t piece = base;
        Cover in_target;
        Cover beside_target;
        for (end = begin; end < cuts.size() && cuts[end].edge == base; ++end) {
            const Cut& cut = cuts[end];
            const bool at_end = cut.distance >= length - tolerance;
            if (!at_end && cut.distance > place + tolerance) {
                place = cut.distance;
                point = static_cast<std::int32_t>(points.size());
                points.push_back(cut_between(a, points[edges[piece].from], b, place / length));
                const Edge rest{point, last_point, base, edges[piece].code, 0, 0, false};
                edges[piece].to = point;
                piece = static_cast<std::int32_t>(edges.size());
                edges.push_back(rest);
            }
            if (cut.node >= 0) node_point_[cut.node] = at_end ? last_point : point;
            if (at_end) continue;
            in_target.add(cut.set, cut.in_target);
            beside_target.add(cut.set, cut.beside_target);
            edges[piece].in_target = in_target.bits();
            edges[piece].beside_target = beside_target.bits();
        }
    }
}

void Arrangement::add_border(std::span<const TargetView> sets) {
    // rings of the area that touch have nodes at one place: they become one point
    std::vector<std::pair<Point, std::size_t>> inner;
    std::size_t base = 0;
    for (const TargetView& target : sets) {
        for (std::size_t i = 0; i < target.node_vertex.size(); ++i) {
            if (node_point_[base + i] >= 0) continue;
            inner.emplace_back(frame.enter(target.nodes[2 * i], target.nodes[2 * i + 1]), base + i);
        }
        base += target.node_vertex.size();
    }
    std::sort(inner.begin(), inner.end(),
              [](const auto& a, const auto& b) { return before(a.first, b.first); });
    for (std::size_t i = 0; i < inner.size(); ++i) {
        if (i == 0 || before(inner[i - 1].first, inner[i].first)) points.push_back(inner[i].first);
        node_point_[inner[i].second] = static_cast<std::int32_t>(points.size()) - 1;
    }
    base = 0;
    for (std::size_t set = 0; set < sets.size(); ++set) {
        const TargetView& target = sets[set];
        const auto bit = static_cast<std::uint8_t>(1u << set);
        for (std::size_t i = 0; i < target.segment_from.size(); ++i) {
            const std::int32_t from = node_point_[base + target.segment_from[i]];
            const std::int32_t to = node_point_[base + target.segment_to[i]];
            if (from == to) continue;
            edges.push_back({from, to, -1, 0, 0, bit, false});
        }
        base += target.node_vertex.size();
    }
}

void Arrangement::index_incidence() {
    first_.assign(points.size() + 1, 0);
    for (const Edge& e : edges) {
        ++first_[e.from + 1];
        ++first_[e.to + 1];
    }
    for (std::size_t p = 0; p < points.size(); ++p) first_[p + 1] += first_[p];
    incident_.resize(2 * edges.size());
    std::vector<std::int32_t> fill(first_.begin(), first_.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        incident_[fill[edges[e].from]++] = static_cast<std::int32_t>(e);
        incident_[fill[edges[e].to]++] = static_cast<std::int32_t>(e);
    }
}

void Arrangement::line(const Edge& e, Point& origin, Vector& direction) const {
    const Point a = points[is_contact(e) ? e.base : e.from];
    const Point b = points[is_contact(e) ? contact.next[e.base] : e.to];
    origin = e.rises ? a : b;
    direction = e.rises ? Vector{b.u - a.u, b.h - a.h} : Vector{a.u - b.u, a.h - b.h};
}

double Arrangement::distance(const Edge& e, std::int32_t p) const {
    const Point a = points[e.base];
    const Point b = points[contact.next[e.base]];
    const double length = std::hypot(b.u - a.u, b.h - a.h);
    if (p == contact.place[e.base] && e.from == p) return 0.0;
    if (p == contact.place[contact.next[e.base]] && e.to == p) return length;
    const Point q = points[p];
    return ((q.u - a.u) * (b.u - a.u) + (q.h - a.h) * (b.h - a.h)) / length;
}

}  // namespace preimage
