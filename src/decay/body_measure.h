#pragma once
// Measures of closed surfaces in single precision: volume, area, normals, crossings.
#include <Eigen/Core>
#include <vector>

#include "geometry/surface_mesh.h"

namespace windfall::decay {

using SurfacePoints = std::vector<Eigen::Vector3f>;

double surface_volume_m3(const SurfacePoints& points, const std::vector<geometry::Face>& faces);
double surface_area_m2(const SurfacePoints& points, const std::vector<geometry::Face>& faces);

/// Area-weighted unit normals at the vertices.
SurfacePoints surface_normals(const SurfacePoints& points, const std::vector<geometry::Face>& faces);

/// Edges (sides and first diagonals of the quadrilaterals) that pierce a triangle with which they share no
/// vertex.
int crossing_edges(const SurfacePoints& points, const std::vector<geometry::Face>& faces);

}  // namespace windfall::decay
