#pragma once
#include <span>
#include <string>
#include <vector>

#include "export/curves_to_export.h"
#include "export/mesh_to_export.h"

namespace windfall::export_ {

/// A Wavefront OBJ file with an object for each mesh: positions, normals (those of the faces where the
/// material is hard), texture coordinates per corner (each pair once), quadrilaterals as they are. The faces
/// of a mesh with several materials stand material by material. OBJ has no place for attributes.
/// `material_file`: name of the file with the materials; empty for none. Curves follow as objects of their
/// own, a line
/// (`l`) a strand.
std::string obj_text(std::span<const MeshToExport> meshes, const std::string& material_file = "",
                     std::span<const CurvesToExport> curves = {});

/// The file with the materials that faces are of (MTL), each name once. Colours are linear, as Blender takes
/// them.
std::string mtl_text(std::span<const MeshToExport> meshes);

}  // namespace windfall::export_
