#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "export/curves_to_export.h"
#include "export/mesh_to_export.h"

namespace windfall::export_ {

/// A binary little-endian PLY file with all meshes in it, one after the other: positions, normals and every
/// attribute that all meshes have as float properties of the vertices, but the colour as the bytes red,
/// green, blue (sRGB); faces with three or four corners; texture coordinates, where all meshes have them, as
/// the faces' list property "texcoord". Where there are several materials or meshes the faces' properties
/// "material" and "mesh" number them; comments say their names.
std::vector<std::byte> ply_bytes(std::span<const MeshToExport> meshes);

/// A binary little-endian PLY file with all curves in it: vertices with the radius of their strand in metres
/// and its colour (sRGB bytes), and edges ("vertex1", "vertex2") along the strands.
std::vector<std::byte> curves_ply_bytes(std::span<const CurvesToExport> curves);

}  // namespace windfall::export_
