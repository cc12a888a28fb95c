#pragma once
// A closed surface without handles laid on the unit sphere, one to one, with areas spread as evenly as that
// allows: every direction stands for one point of the surface.
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/sphere_map_grid.h"
#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// Owns a copy of the surface. Immutable; safe to read from several threads.
class SphereMap {
  public:
    /// The surface must have passed `require_closed`. Throws InputError, with the place and the remedy, where
    /// it cannot be laid on the sphere without folds.
    explicit SphereMap(const SurfaceMesh& mesh);

    const TriangleSurface& surface() const { return m_surface; }
    /// Unit direction of each welded vertex.
    const std::vector<Vec3>& directions() const { return m_directions; }

    /// Where a direction (any length but zero) meets the surface.
    SurfacePlace place(const Vec3& direction) const { return m_grid.place(direction); }
    /// The point (m, as the mesh) in a direction.
    Vec3 point(const Vec3& direction) const { return point(place(direction)); }
    Vec3 point(const SurfacePlace& place) const {
        return at_place(m_surface.positions, m_surface.triangles, place);
    }
    /// Unit normal, smooth across the triangles.
    Vec3 normal(const SurfacePlace& place) const {
        return at_place(m_normals, m_surface.triangles, place).normalized();
    }
    Vec3 normal(const Vec3& direction) const { return normal(place(direction)); }
    /// Unit direction of a place; `place` of it gives the place back.
    Vec3 direction(const SurfacePlace& place) const {
        return at_place(m_directions, m_surface.triangles, place).normalized();
    }

    /// Smallest and largest of a triangle's share of the sphere over its share of the surface.
    std::array<double, 2> area_ratios() const;

  private:
    TriangleSurface m_surface;
    std::vector<Vec3> m_directions, m_normals;
    SphereGrid m_grid;
};

}  // namespace windfall::geometry
