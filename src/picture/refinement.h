#pragma once
// Smooth surfaces from coarse ones, so that no facets are seen.
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/surface_mesh.h"
#include "picture/scene.h"

namespace windfall::picture {

/// One row per vertex.
using Channels = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Catmull-Clark subdivision of one set of faces, made once and applied to as many frames as there are.
/// The refined vertices lie on the limit surface.
class Refinement {
  public:
    /// `levels` >= 1: each splits every edge in two. Throws InputError when a face names a vertex that is not
    /// there.
    Refinement(const std::vector<geometry::Face>& faces, std::size_t vertex_count, int levels);

    const std::vector<std::array<std::uint32_t, 4>>& quads() const { return m_quads; }
    std::size_t vertex_count() const;

    /// The refined vertices' values of channels (positions, colours ...) given at the coarse vertices.
    Channels apply(const Channels& coarse) const;

  private:
    using Matrix = Eigen::SparseMatrix<float, Eigen::RowMajor>;
    std::vector<Matrix> m_steps;  // one per level, then the step to the limit surface
    std::vector<std::array<std::uint32_t, 4>> m_quads;
};

/// Texture coordinates at the corners of the quadrilaterals that `levels` of refinement make of faces, in
/// their order; straight within each face, so that seams stay where they are.
std::vector<std::array<Eigen::Vector2f, 4>> refined_corners(
    const std::vector<geometry::Face>& faces, const std::vector<std::array<geometry::Vec2, 4>>& corner_uvs,
    int levels);

/// Area-weighted unit normals at the vertices.
std::vector<Vec3f> smooth_normals(const std::vector<Vec3f>& positions,
                                  const std::vector<std::array<std::uint32_t, 4>>& quads);

}  // namespace windfall::picture
