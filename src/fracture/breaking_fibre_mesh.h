#pragma once
// Bridging fibres as thin tubes: of each fibre two closed halves, which meet until it tears.
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/breaking_fibres.h"

namespace windfall::fracture {

/// Faces, texture coordinates and all that does not move; positions as the fibres are now.
BranchMesh fibre_mesh(const FractureParameters& parameters, const BreakingFibres& fibres);

/// The vertices of `fibre_mesh` now, none below `ground`. A fibre thins where it will tear, and a torn half
/// ends in a point.
std::vector<Vector3f> fibre_positions(const BreakingFibres& fibres, double ground);

}  // namespace windfall::fracture
