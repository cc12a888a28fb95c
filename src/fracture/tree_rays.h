#pragma once
#include <memory>
#include <vector>

#include "fracture/tree_surface.h"

namespace windfall::fracture {

/// Finds the bark from inside a branch.
class TreeRays {
  public:
    /// `origin` and `unit` scale coordinates to single precision; triangles are numbers of the surface's.
    TreeRays(const TreeSurface& surface, std::vector<std::int32_t> triangles, const geometry::Vec3& origin,
             double unit);
    ~TreeRays();
    TreeRays(const TreeRays&) = delete;
    TreeRays& operator=(const TreeRays&) = delete;

    const TreeSurface& surface() const { return m_surface; }

    /// The first place of the surface from `from` in `direction`, a unit vector. Throws InputError where
    /// there is none.
    SurfacePlace hit(const geometry::Vec3& from, const geometry::Vec3& direction) const;

  private:
    struct Scene;
    const TreeSurface& m_surface;
    std::vector<std::int32_t> m_triangles;
    geometry::Vec3 m_origin;
    double m_unit;
    std::unique_ptr<Scene> m_scene;
};

}  // namespace windfall::fracture
