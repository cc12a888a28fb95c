#pragma once
#include <cstddef>
#include <vector>

#include "export/mesh_to_export.h"

namespace windfall::export_ {

/// A binary little-endian PLY file: positions, normals and every attribute as float properties of the
/// vertices; faces with three or four corners; texture coordinates, where there are any, as the faces' list
/// property "texcoord".
std::vector<std::byte> ply_bytes(const MeshToExport& mesh);

}  // namespace windfall::export_
