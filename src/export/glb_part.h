#pragma once
// One material of one mesh as a primitive of glTF. For the files of this folder that write GLB.
#include <span>

#include "export/glb.h"
#include "export/glb_buffer.h"
#include "export/seam_split.h"

namespace windfall::export_ {

/// How a primitive gets its normals.
enum class NormalsOfPart {
    OfVertices,
    OfFaces,  ///< every face has vertices of its own
    None,     ///< flat by the standard
};

struct GlbPart {
    MaterialSplit split;
    NormalsOfPart normals = NormalsOfPart::OfVertices;
    tinygltf::Primitive primitive;
};

/// Puts the faces of a material into the buffer. Colours are written in parts of `base_colour`.
GlbPart add_part(BufferBuilder& buffer, const MeshToExport& mesh, std::size_t material,
                 const std::array<double, 3>& base_colour, NormalsOfPart normals);

/// Adds a morph target to the part.
void add_target(BufferBuilder& buffer, GlbPart& part, const MeshToExport& mesh, const MorphShape& shape);

}  // namespace windfall::export_
