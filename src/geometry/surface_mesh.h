#pragma once
// Polygon surfaces as they are shown, measured and exported.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace windfall::geometry {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// A quadrilateral, or a triangle when the last entry is `kNoVertex`. Counter-clockwise seen from outside.
using Face = std::array<std::int32_t, 4>;
inline constexpr std::int32_t kNoVertex = -1;

inline int corner_count(const Face& face) { return face[3] == kNoVertex ? 3 : 4; }

/// Vertices and faces; texture coordinates, where there are any, per corner of a face so that charts may meet
/// in a seam without doubling vertices.
struct SurfaceMesh {
    std::vector<Vec3> positions;
    std::vector<Face> faces;
    std::vector<std::array<Vec2, 4>> corner_uvs;  ///< one per face, or empty
};

/// Area-weighted unit normals at the vertices (a quadrilateral counts by its diagonals' cross product).
std::vector<Vec3> vertex_normals(const std::vector<Vec3>& positions, const std::vector<Face>& faces);

/// Volume inside a closed surface (quadrilaterals as two triangles about their first diagonal).
double enclosed_volume(const std::vector<Vec3>& positions, const std::vector<Face>& faces);

/// Mixed area belonging to each vertex: a quarter (third) of each adjacent quadrilateral (triangle).
std::vector<double> vertex_areas(const std::vector<Vec3>& positions, const std::vector<Face>& faces);

}  // namespace windfall::geometry
