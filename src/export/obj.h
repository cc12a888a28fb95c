#pragma once
#include <string>

#include "export/mesh_to_export.h"

namespace windfall::export_ {

/// A Wavefront OBJ file: positions, normals, texture coordinates per corner (each pair once), quadrilaterals
/// as they are. OBJ has no place for attributes.
std::string obj_text(const MeshToExport& mesh);

}  // namespace windfall::export_
