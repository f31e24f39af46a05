// The sweep's status: the boundaries that cross the sweep line, from left to right, and what lies
// between them. A treap for finding a place, threaded as a list for neighbours.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/plane.hpp"

namespace preimage {

// What a piece of the sweep line is, and what a point of a contact edge is.
enum class Piece : std::uint8_t {
    Solid,     // inside an obstacle, or outside the window
    Avoidable, // nature can keep the robot from the target
    Good,      // every motion meets the target
    Target,
    Start,     // of a forward projection: the area that motions start from

    // as both sweeps call what grows, and as a forward projection calls the others
    Grown = Avoidable,
    Reached = Avoidable,
    Untouched = Good,
    Stop = Target,
};

inline bool in_backprojection(Piece piece) {
    return piece == Piece::Good || piece == Piece::Target;
}

enum class Kind : std::uint8_t {
    Contact,  // a contact edge, or an open side of the window
    Border,   // an edge of the target's area inside free space
    RayLeft,  // the left limit of an avoidable piece that grows to the left
    RayRight, // the right limit of one that grows to the right
};

struct Boundary {
    Point origin;
    Vector direction;  // rising
    Kind kind;
    Piece right;       // the piece to the right of it
    Piece state;       // of the contact edge itself, here and now
    std::int8_t emits; // +1 the backprojection lies to the left alone, -1 to the right alone, else 0
    std::int32_t edge; // in the arrangement; -1 for rays
    std::int32_t since;    // the point from which `state` holds; of a ray: where it comes from
    std::int32_t segment;  // the segment of the backprojection's border that it draws, or -1
    std::uint32_t stamp;   // changes when the place is used anew
    std::uint32_t visit;   // the last event that met it
    std::uint32_t priority;
    std::int32_t parent, left, right_child;  // of the treap
    std::int32_t previous, next;             // of the list

    bool is_ray() const { return kind == Kind::RayLeft || kind == Kind::RayRight; }
    double slope() const {
        return direction.h > 0.0 ? direction.u / direction.h
                                 : std::numeric_limits<double>::infinity();
    }
    double at(double h) const {
        return direction.h > 0.0 ? origin.u + slope() * (h - origin.h) : origin.u;
    }
};

// The status order: does `p` lie to the left of boundary `b`? A point on a ray, up to the
// tolerance, lies on its avoidable side.
inline bool left_of(const Boundary& b, Point p, double tolerance) {
    switch (b.kind) {
        case Kind::RayRight: return p.u <= b.at(p.h) + tolerance;
        case Kind::RayLeft: return p.u < b.at(p.h) - tolerance;
        default: return leftness(b.origin, b.direction, p) > 0.0;
    }
}

class Status {
public:
    static constexpr std::int32_t none = -1;
    static constexpr std::int32_t first = 0;  // a sentinel, left of everything

    explicit Status(double tolerance) : tolerance_(tolerance) {
        nodes_.reserve(1024);
        Boundary sentinel{};
        sentinel.right = Piece::Solid;
        sentinel.edge = -1;
        sentinel.parent = sentinel.left = sentinel.right_child = none;
        sentinel.previous = sentinel.next = none;
        nodes_.push_back(sentinel);
    }

    Boundary& operator[](std::int32_t node) { return nodes_[node]; }
    bool empty() const { return root_ == none; }

    // The last boundary that `p` is not to the left of.
    std::int32_t before(Point p) const {
        std::int32_t found = first;
        for (std::int32_t node = root_; node != none;) {
            if (left_of(nodes_[node], p, tolerance_)) {
                node = nodes_[node].left;
            } else {
                found = node;
                node = nodes_[node].right_child;
            }
        }
        return found;
    }

    // Puts `boundary` right behind `node`.
    std::int32_t insert_after(std::int32_t node, const Boundary& boundary) {
        const std::int32_t fresh = allocate(boundary);
        Boundary& b = nodes_[fresh];
        b.priority = random();
        b.left = b.right_child = b.parent = none;
        b.previous = node;
        b.next = nodes_[node].next;
        nodes_[node].next = fresh;
        if (b.next != none) nodes_[b.next].previous = fresh;

        // as a leaf: right child of its predecessor, or left child of its successor
        if (node != first && nodes_[node].right_child == none) {
            nodes_[node].right_child = fresh;
            b.parent = node;
        } else if (b.next != none) {
            nodes_[b.next].left = fresh;
            b.parent = b.next;
        } else {
            root_ = fresh;
        }
        while (b.parent != none && nodes_[b.parent].priority < b.priority) rotate_up(fresh);
        return fresh;
    }

    void remove(std::int32_t node) {
        Boundary& b = nodes_[node];
        while (b.left != none && b.right_child != none) {
            rotate_up(nodes_[b.left].priority > nodes_[b.right_child].priority ? b.left
                                                                               : b.right_child);
        }
        const std::int32_t child = b.left != none ? b.left : b.right_child;
        replace_child(b.parent, node, child);
        nodes_[b.previous].next = b.next;
        if (b.next != none) nodes_[b.next].previous = b.previous;
        ++b.stamp;
        free_.push_back(node);
    }

private:
    std::int32_t allocate(const Boundary& boundary) {
        if (free_.empty()) {
            nodes_.push_back(boundary);
            nodes_.back().stamp = 0;
            return static_cast<std::int32_t>(nodes_.size()) - 1;
        }
        const std::int32_t node = free_.back();
        free_.pop_back();
        const std::uint32_t stamp = nodes_[node].stamp;
        nodes_[node] = boundary;
        nodes_[node].stamp = stamp;
        return node;
    }

    void replace_child(std::int32_t parent, std::int32_t old_child, std::int32_t child) {
        if (parent == none) {
            root_ = child;
        } else if (nodes_[parent].left == old_child) {
            nodes_[parent].left = child;
        } else {
            nodes_[parent].right_child = child;
        }
        if (child != none) nodes_[child].parent = parent;
    }

    void rotate_up(std::int32_t node) {
        const std::int32_t parent = nodes_[node].parent;
        const std::int32_t grandparent = nodes_[parent].parent;
        std::int32_t inner;
        if (nodes_[parent].left == node) {
            inner = nodes_[node].right_child;
            nodes_[parent].left = inner;
            nodes_[node].right_child = parent;
        } else {
            inner = nodes_[node].left;
            nodes_[parent].right_child = inner;
            nodes_[node].left = parent;
        }
        if (inner != none) nodes_[inner].parent = parent;
        nodes_[parent].parent = node;
        nodes_[node].parent = grandparent;
        if (grandparent == none) {
            root_ = node;
        } else if (nodes_[grandparent].left == parent) {
            nodes_[grandparent].left = node;
        } else {
            nodes_[grandparent].right_child = node;
        }
    }

    // xorshift: the same priorities in every run
    std::uint32_t random() {
        seed_ ^= seed_ << 13;
        seed_ ^= seed_ >> 17;
        seed_ ^= seed_ << 5;
        return seed_;
    }

    double tolerance_;
    std::vector<Boundary> nodes_;
    std::vector<std::int32_t> free_;
    std::int32_t root_ = none;
    std::uint32_t seed_ = 2463534242u;
};

}  // namespace preimage
