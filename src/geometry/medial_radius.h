#pragma once
// How thick a closed surface is, seen from its points.
#include "geometry/triangle_tree.h"

namespace windfall::geometry {

/// Radius of the largest ball inside that touches the surface at `point`, where its unit normal is `normal`
/// (Ma, Bae and Choi 2012, 3D medial axis point approximation using nearest neighbors and the normal field:
/// the shrinking ball), at most `largest`. Touching places nearer to the point than `skin`, or seen from the
/// ball's centre within 20 degrees of it, are bumps of the surface and do not count.
double medial_radius(const TriangleTree& tree, const Vec3& point, const Vec3& normal, double largest,
                     double skin);

}  // namespace windfall::geometry
