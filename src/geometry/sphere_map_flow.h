#pragma once
// Lets a closed surface without handles flow until it lies around a point like a sphere.
#include <vector>

#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// Unit directions of the vertices, so that every triangle is a positive one on the sphere. Conformalised
/// mean curvature flow (Kazhdan, Solomon and Ben-Chen 2012, Can mean-curvature flow be modified to be
/// non-singular?) until the surface is star-shaped about its centroid, then radially. Cotangents are held
/// within bounds, so that slivers do no harm. A surface that is star-shaped already does not flow. Throws
/// InputError, naming the place that still folds, when that does not come about.
std::vector<Vec3> flow_to_sphere(const TriangleSurface& surface);

}  // namespace windfall::geometry
