#pragma once
// glTF 2.0 in one binary file. Triangles; vertices are doubled where texture coordinates have a seam, and all
// that belong to one vertex of the take move alike.
#include <cstddef>
#include <span>
#include <vector>

#include "export/mesh_to_export.h"

namespace windfall::export_ {

/// Positions and normals of the vertices of the first frame's mesh at a later frame.
struct MorphShape {
    std::vector<Eigen::Vector3f> positions;  ///< metres
    std::vector<Eigen::Vector3f> normals;    ///< unit vectors
};

/// A mesh as a GLB file. With `later_frames`, one morph target for each (sparse where few vertices move) and
/// an animation that shows `mesh` at 0 s and later_frames[i] at (i + 1) / frames_per_second, straight in
/// between. Attributes become _NAME, as float vertex data. InputError when the file would not fit into 2 GiB.
std::vector<std::byte> glb_bytes(const MeshToExport& mesh, const ExportMaterial& material,
                                 std::span<const MorphShape> later_frames = {},
                                 double frames_per_second = 24);

}  // namespace windfall::export_
