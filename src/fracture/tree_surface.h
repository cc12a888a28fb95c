#pragma once
// The surface of an artist's mesh as a body: triangles whose vertices are welded where they lie at one place.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/surface_mesh.h"
#include "meshfile/mesh.h"

namespace windfall::fracture {

/// A triangle of the surface: vertices are welded ones, corners are those of the mesh. Counter-clockwise from
/// outside, in the world.
struct TreeTriangle {
    std::array<std::int32_t, 3> vertices;
    std::array<std::size_t, 3> corners;
    std::int32_t face;
};

struct TreeSurface {
    std::vector<geometry::Vec3> positions;  ///< of welded vertices, in the world
    std::vector<std::int32_t> welded;       ///< by vertex of the mesh
    std::vector<TreeTriangle> triangles;    ///< those without two corners at one place
    /// Over the edge from corner k to k + 1; -1 where there is no neighbour, or more than one.
    std::vector<std::array<std::int32_t, 3>> neighbours;
    std::vector<std::int32_t> component;  ///< of each welded vertex: bodies that share no vertex differ
    std::int32_t components = 0;

    const geometry::Vec3& corner(const TreeTriangle& triangle, std::size_t k) const {
        return positions[static_cast<std::size_t>(triangle.vertices[k])];
    }
    /// Twice the vector area.
    geometry::Vec3 twice_area(const TreeTriangle& triangle) const;
};

TreeSurface make_tree_surface(const meshfile::Mesh& mesh);

/// A place on a triangle; weights of its corners.
struct SurfacePlace {
    std::int32_t triangle = -1;
    geometry::Vec3 weights = geometry::Vec3::Zero();
    geometry::Vec3 position = geometry::Vec3::Zero();
};

/// The place of the triangle that is nearest to `point` (Ericson, Real-Time Collision Detection, 5.1.5).
SurfacePlace nearest_place(const TreeSurface& surface, std::int32_t triangle, const geometry::Vec3& point);

/// The same over the whole surface.
SurfacePlace nearest_place(const TreeSurface& surface, const geometry::Vec3& point);

/// Joins of numbers 0 .. count - 1 into sets.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count);
    std::int32_t find(std::int32_t i);
    void join(std::int32_t i, std::int32_t j);

  private:
    std::vector<std::int32_t> m_parent;
};

}  // namespace windfall::fracture
