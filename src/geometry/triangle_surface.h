#pragma once
// A polygon mesh as triangles over welded vertices: what geometry is computed on, whatever seams,
// quadrilaterals and doubled vertices the mesh itself has.
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::geometry {

using Triangle = std::array<std::int32_t, 3>;

/// Which corners of which face a triangle was cut from.
struct TriangleOrigin {
    std::int32_t face = 0;
    std::array<std::uint8_t, 3> corner{};
};

struct TriangleSurface {
    std::vector<Vec3> positions;         ///< one per place; places no face uses are left out
    std::vector<Triangle> triangles;     ///< counter-clockwise as the faces are
    std::vector<TriangleOrigin> origin;  ///< one per triangle
    std::vector<std::int32_t>
        vertex_of;  ///< per vertex of the mesh: its place; kNoVertex where no face uses it
};

/// Vertices closer than kWeldingDistance of the mesh's diagonal become one. Quadrilaterals are cut along the
/// diagonal that folds them least. Triangles with two corners in one place (as at the poles of many a sphere)
/// are left out. Throws InputError when a face points to no vertex or a position is not finite.
TriangleSurface welded_triangles(const SurfaceMesh& mesh);
inline constexpr double kWeldingDistance = 1e-6;

/// A place on a triangle: weights of its corners, which sum to 1.
struct SurfacePlace {
    std::int32_t triangle = 0;
    Vec3 weights = Vec3(1, 0, 0);
};

/// Weighted mean of three values at the corners of the place's triangle.
template <class T>
T at_place(const std::vector<T>& values, const std::vector<Triangle>& triangles, const SurfacePlace& place) {
    const auto& [a, b, c] = triangles[place.triangle];
    return place.weights[0] * values[a] + place.weights[1] * values[b] + place.weights[2] * values[c];
}

/// Area-weighted unit normals at the welded vertices.
std::vector<Vec3> vertex_normals(const TriangleSurface& surface);

/// Length of the diagonal of the box around the points; 0 without points.
double diagonal_of(const std::vector<Vec3>& points);

}  // namespace windfall::geometry
