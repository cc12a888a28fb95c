#pragma once
// Plane sections of a tree's surface.
#include <cstdint>
#include <span>
#include <vector>

#include "fracture/tree_surface.h"

namespace windfall::fracture {

/// Where the plane crosses the edge of the welded vertices low < high: at (1 - share) low + share high.
struct SectionPoint {
    std::int32_t low, high;
    double share;
    geometry::Vec3 position;
    std::int32_t triangle;  ///< that lies between this point and the next
};

/// One loop in which a plane cuts the surface, counter-clockwise seen from where the normal points (of a
/// surface whose faces are turned outwards).
struct Section {
    geometry::Vec3 origin, normal;  ///< of the plane
    std::vector<SectionPoint> points;
    bool closed = false;
    geometry::Vec3 centroid;  ///< of the area; of an open loop, of its points
    double area = 0;          ///< negative for a loop that runs the other way round

    /// Of a circle of this area.
    double radius() const;
    /// The end of an open loop.
    const geometry::Vec3& loose_end() const { return points.back().position; }
    /// Largest and smallest distance of its points from `centre`, a point of the plane.
    double outer_radius(const geometry::Vec3& centre) const;
    double inner_radius(const geometry::Vec3& centre) const;
    /// Whether the loop runs around `point` of the plane.
    bool encloses(const geometry::Vec3& point) const;
    double distance(const geometry::Vec3& point) const;
};

/// Cuts a surface with many planes.
class SectionTracer {
  public:
    explicit SectionTracer(const TreeSurface& surface)
        : m_surface(surface), m_stamp(surface.triangles.size(), 0) {}

    /// The loops that pass through one of `triangles`, followed as far as they go.
    std::vector<Section> cut(std::span<const std::int32_t> triangles, const geometry::Vec3& origin,
                             const geometry::Vec3& normal);

  private:
    Section follow(std::int32_t start, const geometry::Vec3& origin, const geometry::Vec3& normal);

    const TreeSurface& m_surface;
    std::vector<std::uint32_t> m_stamp;  // the number of the cut that a triangle was last met in
    std::uint32_t m_cut = 0;
};

}  // namespace windfall::fracture
