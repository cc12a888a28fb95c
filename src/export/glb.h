#pragma once
// glTF 2.0 in one binary file. Triangles; a node for each mesh and a primitive for each of its materials;
// vertices are doubled where texture coordinates have a seam, and all that belong to one vertex of the take
// move alike.
#include <cstddef>
#include <span>
#include <vector>

#include "export/curves_to_export.h"
#include "export/mesh_to_export.h"

namespace windfall::export_ {

/// Positions and normals of the vertices of a mesh at a later frame.
struct MorphShape {
    std::vector<Eigen::Vector3f> positions;  ///< metres
    std::vector<Eigen::Vector3f> normals;    ///< unit vectors
};

struct MeshToAnimate {
    MeshToExport mesh;                     ///< at the first frame
    std::vector<MorphShape> later_frames;  ///< as many in all meshes; none: a still
};

/// Meshes as a GLB file. With later frames, one morph target for each (sparse where few vertices move) and an
/// animation that shows `mesh` at 0 s and later_frames[i] at (i + 1) / frames_per_second, straight in
/// between. Attributes become _NAME, as float vertex data; the colour becomes COLOR_0, which the base colour
/// multiplies. Hard faces have vertices of their own with their normals; where there are later frames they
/// have no normals instead, which the standard defines as flat shading in every frame. Curves become nodes
/// with a LINES primitive: positions, COLOR_0, and the radius in metres as _RADIUS. InputError when the file
/// would not fit into 2 GiB.
std::vector<std::byte> glb_bytes(std::span<const MeshToAnimate> meshes, double frames_per_second = 24,
                                 std::span<const CurvesToExport> curves = {});

}  // namespace windfall::export_
