#pragma once
// Branch meshes as takes hold them.
#include "fracture/branch_mesh.h"
#include "take/frame.h"

namespace windfall::fracture {

/// The take's axes: y up. (x, y, z) of a branch becomes (x, z, -y).
inline Vector3f take_axes(const Vector3f& p) { return {p.x(), p.z(), -p.y()}; }

/// The mesh with its materials and the constant attributes "tissue", "height", "thorn", "bundle" (0 .. 1) and
/// "colour" (linear RGB), as it stands at rest.
take::TakeMesh take_mesh(const std::string& name, const BranchMesh& mesh,
                         const std::vector<Vector3f>& colours);

/// Positions of a frame.
take::FrameMesh frame_mesh(const std::string& name, const std::vector<Vector3f>& positions);

}  // namespace windfall::fracture
