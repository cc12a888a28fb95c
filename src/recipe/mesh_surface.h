#pragma once
#include <string>

#include "geometry/surface_mesh.h"
#include "meshfile/mesh.h"

namespace windfall::recipe {

/// An artist's mesh as a surface, in the world of its file: all vertices in their order, faces
/// counter-clockwise from outside, those with more than four corners cut into triangles, texture coordinates
/// with v up (NaN where a corner has none; none at all when the file has none).
geometry::SurfaceMesh surface_of(const meshfile::Mesh& mesh);

/// geometry::require_uvs for a fruit whose take may have another skin: the message says so too.
void require_own_uvs(const geometry::SurfaceMesh& mesh, const std::string& name);

}  // namespace windfall::recipe
