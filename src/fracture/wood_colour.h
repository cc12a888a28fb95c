#pragma once
// The colour of wood, vertex by vertex.
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// Linear RGB, 0 .. 1, at the vertices of a branch that has not been placed yet (radius 1 about the z axis):
/// tissues, annual rings that wander, rays, differences between fibre bundles, streaks along the fibres, pale
/// tips of thorns, and in wet wood a green cambium. A function of seed, place, tissue, thorn and bundle
/// alone, so that a finer lattice has the same colours. Finer detail (plates of the bark, fibres, pores) is
/// the picture's.
std::vector<Vector3f> vertex_colours(const BranchMesh& mesh, const FractureParameters& parameters);

}  // namespace windfall::fracture
