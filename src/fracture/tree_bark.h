#pragma once
// What an artist's bark says at places between its vertices.
#include <span>
#include <vector>

#include "fracture/tree_surface.h"
#include "meshfile/mesh.h"

namespace windfall::fracture {

/// Reads texture coordinates, normals and so on, in the order of `meshfile::corner_values`.
class TreeBark {
  public:
    TreeBark(const meshfile::Mesh& mesh, const TreeSurface& surface);

    std::size_t value_count() const { return m_count; }
    const meshfile::FaceInfo& face_of(std::int32_t triangle) const;

    /// Values at `weights` of a triangle's corners: directions are unit vectors again.
    void read(std::int32_t triangle, const geometry::Vec3& weights, double* values) const;

    /// Values at `position` for a face that lies in `triangle`'s chart. `places` are the triangles, one or
    /// two, that the position lies on. Where the texture jumps between them and `triangle` (a seam), the
    /// chart of `triangle` is continued in its plane instead.
    void read_in_chart(std::int32_t triangle, const geometry::Vec3& position,
                       std::span<const SurfacePlace> places, double* values) const;

  private:
    geometry::Vec3 weights_beyond(std::int32_t triangle, const geometry::Vec3& position) const;

    const meshfile::Mesh& m_mesh;
    const TreeSurface& m_surface;
    std::size_t m_count;
    std::ptrdiff_t m_texture = -1;  // first of the two numbers that show seams; -1: there are none
};

}  // namespace windfall::fracture
