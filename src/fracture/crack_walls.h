#pragma once
// The walls of open cracks.
#include <cstdint>
#include <vector>

#include "fracture/branch_mesh.h"

namespace windfall::fracture {

/// Vertices across a crack at one place along it, from the surface to the bottom, on its left and its right
/// as seen along it; both end in the same vertex, and have no other one where the crack is closed.
struct WallColumn {
    std::vector<std::int32_t> left, right;
    double arc = 0;  ///< along the crack, radii
};

/// Adds the walls between two columns, `b` being the next one along the crack. The wood lies below the
/// surface
/// (`downwards`) or above it, as in a fallen piece. Both columns have `rows` + 1 vertices on a side, or one.
/// Texture coordinates: along the crack and along the branch, a unit for 2 pi radii.
void add_wall_faces(const WallColumn& a, const WallColumn& b, int rows, bool downwards, BranchMesh& mesh);

/// Adds a face whose corners may follow each other twice (then they are one).
void add_face(const geometry::Face& corners, const std::array<Vector2f, 4>& uvs, Part part, BranchMesh& mesh);

}  // namespace windfall::fracture
