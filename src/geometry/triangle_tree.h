#pragma once
// Boxes around triangles in a binary tree: the nearest point of a surface, and the pairs of triangles whose
// boxes meet.
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// The point of a triangle nearest to `point`, as weights of its corners (Ericson 2005, Real-Time Collision
/// Detection, 5.1.5).
Vec3 nearest_weights(const Vec3& point, const std::array<Vec3, 3>& triangle);

/// Owns a copy of the triangles. Immutable; safe to read from several threads.
class TriangleTree {
  public:
    TriangleTree(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles);

    struct Nearest {
        SurfacePlace place;  ///< triangle -1 when there is none
        Vec3 point = Vec3::Zero();
        double distance_sq = std::numeric_limits<double>::infinity();
    };
    /// The nearest point. With a `facing` other than zero only triangles whose normal has a positive
    /// component along it are looked at; with `within` only those nearer than it.
    Nearest nearest(const Vec3& point, const Vec3& facing = Vec3::Zero(),
                    double within = std::numeric_limits<double>::infinity()) const;

    /// Calls visit(i, j), i < j, for every pair of triangles whose boxes meet, in an order that depends on
    /// the triangles alone.
    void for_each_pair(const std::function<void(std::int32_t, std::int32_t)>& visit) const;

  private:
    struct Node {
        Vec3 low = Vec3::Zero(), high = Vec3::Zero();
        std::int32_t begin = 0, end = 0;     ///< of the triangles in it
        std::int32_t left = -1, right = -1;  ///< -1 in leaves
        bool leaf() const { return left < 0; }
    };
    std::int32_t build(std::int32_t begin, std::int32_t end, const std::vector<Vec3>& centres);
    void visit_leaves(const Node& a, const Node& b,
                      const std::function<void(std::int32_t, std::int32_t)>& visit) const;

    std::vector<Node> m_nodes;
    std::vector<std::int32_t> m_order;           ///< triangle of each slot
    std::vector<std::array<Vec3, 3>> m_corners;  ///< per slot
};

}  // namespace windfall::geometry
