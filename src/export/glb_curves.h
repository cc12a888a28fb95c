#pragma once
// Hair as a mesh of glTF. For the files of this folder that write GLB.
#include "export/curves_to_export.h"
#include "export/glb_buffer.h"

namespace windfall::export_ {

/// One primitive of separate lines.
tinygltf::Mesh gltf_curves(BufferBuilder& buffer, const CurvesToExport& curves);

}  // namespace windfall::export_
