// What a sweep runs over: contact edges, cut where the target begins and ends on them, and the
// border of the target's area inside free space, joined at common points. There may be more than
// one target.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane.hpp"

namespace preimage {

// The bits of mechanics.Behaviour, and one more for the open sides of the window.
enum Code : std::uint8_t { kMayStick = 1, kMaySlide = 2, kMayLeave = 4, kOpen = 16 };

// Contact space, as configuration.ContactSpace has it: index i names a vertex and the edge that
// starts there; free space is on the left.
struct ContactSpaceView {
    std::span<const double> points;            // 2n, x and y alternating
    std::span<const std::int32_t> next;        // n
    std::span<const std::int32_t> place;       // n, the first vertex at the same position
    std::span<const std::uint8_t> edge_code;   // n
    std::span<const std::uint8_t> vertex_code; // n
};

// A set of intervals on contact edges.
struct IntervalsView {
    std::span<const std::int32_t> edge;
    std::span<const double> low;
    std::span<const double> high;
};

// The target: intervals and vertices of contact space, and an area, told by the contact along
// which it lies and by its border inside free space (segments between nodes, area on the left).
struct TargetView {
    IntervalsView contact;
    std::span<const std::int32_t> vertices;
    IntervalsView beside;
    std::span<const double> nodes;               // 2m, x and y alternating
    std::span<const std::int32_t> node_vertex;   // m, the contact vertex at the node, or -1
    std::span<const std::int32_t> node_edge;     // m, the contact edge that it lies on, or -1
    std::span<const double> node_distance;       // m, how far along that edge
    std::span<const std::int32_t> segment_from;  // nodes
    std::span<const std::int32_t> segment_to;
};

// A piece of a contact edge, or of the target area's border.
struct Edge {
    std::int32_t from;  // points; what is free, or the target's area, is on the left
    std::int32_t to;
    std::int32_t base;  // the contact edge, or -1: border of the target's area
    std::uint8_t code;
    std::uint8_t in_target;      // bits of the sets that hold the piece of the edge itself
    std::uint8_t beside_target;  // bits of the sets whose areas lie along it; of a border, its own
    bool rises;                  // `from` is its lower end
};

struct Arrangement {
    Arrangement(const ContactSpaceView& contact_, const TargetView& target, Frame frame_,
                double tolerance)
        : Arrangement(contact_, std::span(&target, 1), frame_, tolerance) {}

    // Several sets at once, whose areas do not meet; set `i` has the bit `1 << i`.
    Arrangement(const ContactSpaceView& contact, std::span<const TargetView> sets, Frame frame,
                double tolerance);

    std::int32_t lower(const Edge& e) const { return e.rises ? e.from : e.to; }
    std::int32_t upper(const Edge& e) const { return e.rises ? e.to : e.from; }
    bool is_contact(const Edge& e) const { return e.base >= 0; }

    // The line that carries an edge: its origin and its rising direction. Pieces of one contact
    // edge have one line.
    void line(const Edge& e, Point& origin, Vector& direction) const;

    // How far point `p`, on the edge, is from the start of its contact edge.
    double distance(const Edge& e, std::int32_t p) const;

    std::span<const std::int32_t> incident(std::int32_t p) const {
        return {incident_.data() + first_[p], incident_.data() + first_[p + 1]};
    }

    ContactSpaceView contact;
    Frame frame;
    std::vector<Point> points;  // contact vertices, then cuts, then free nodes of the area
    std::vector<Edge> edges;
    std::vector<std::uint8_t> vertex_in_target;  // by contact vertex: bits of the sets

private:
    Point cut_between(Point a, Point last, Point b, double t) const;
    void cut_edges(std::span<const TargetView> sets, double tolerance);
    void add_border(std::span<const TargetView> sets);
    void index_incidence();

    std::vector<std::int32_t> node_point_;  // by node of the targets, one after the other
    std::vector<std::int32_t> first_;       // by point: its part of `incident_`
    std::vector<std::int32_t> incident_;
};

}  // namespace preimage
