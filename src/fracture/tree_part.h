#pragma once
// Puts together one of the two parts of a broken tree.
#include <array>
#include <vector>

#include "fracture/tree_cut.h"
#include "fracture/tree_wall.h"
#include "meshfile/face_appender.h"

namespace windfall::fracture {

/// Everything that both parts are made from.
struct TreePartPlan {
    const meshfile::Mesh& mesh;
    const TreeSurface& surface;
    const BranchCut& cut;
    const TreeBranch& branch;
    const FractureParameters& parameters;
    std::array<bool, kPartCount> parts;  ///< that either end has
};

/// The wood of one end: the unplaced mesh and where its vertices go.
struct FittedWood {
    const BranchMesh& mesh;
    const std::vector<geometry::Vec3>& places;
};

/// What is left of the mesh on `side`, then the faces that the cut went through, `bark` and `wood`. Materials
/// of the wood are appended to those of the mesh, the same ones for both sides.
meshfile::Mesh tree_part(const TreePartPlan& plan, TreeSide side, const BranchBark& bark,
                         const FittedWood& wood);

}  // namespace windfall::fracture
