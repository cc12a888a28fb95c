#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "export/mesh_to_export.h"

namespace windfall::export_ {

/// A mesh in triangles whose texture coordinates belong to vertices, as graphics hardware wants it.
struct SeamSplit {
    std::vector<std::int32_t> source;    ///< per new vertex: the vertex that it is a copy of
    std::vector<geometry::Vec2> uvs;     ///< per new vertex; empty when the mesh has none
    std::vector<std::uint32_t> indices;  ///< three per triangle, of new vertices
};

/// Doubles vertices where corners disagree about texture coordinates, and cuts quadrilaterals along their
/// first diagonal. Without texture coordinates the vertices stay as they are.
SeamSplit split_at_seams(std::size_t vertex_count, const std::vector<geometry::Face>& faces,
                         const std::vector<std::array<geometry::Vec2, 4>>& corner_uvs);

/// The faces of one material by themselves, with the vertices that they need. `apart`: each face has vertices
/// of its own, so that they can carry the face's normal; `face_of` is filled then.
struct MaterialSplit : SeamSplit {
    std::vector<std::uint32_t> face_of;  ///< per new vertex the face of the mesh that it belongs to
};
MaterialSplit split_material(const MeshToExport& mesh, std::size_t material, bool apart);

}  // namespace windfall::export_
