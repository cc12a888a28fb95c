#pragma once
// Where a surface passes through itself.
#include <vector>

#include "geometry/triangle_surface.h"

namespace windfall::geometry {

/// Two triangles that cross, and a point in which an edge of one pierces the other.
struct Crossing {
    std::int32_t first = 0, second = 0;
    Vec3 place = Vec3::Zero();
};

/// All pairs of triangles that share no edge and of which one pierces the other. Triangles in one plane never
/// do.
std::vector<Crossing> self_crossings(const TriangleSurface& surface);

}  // namespace windfall::geometry
