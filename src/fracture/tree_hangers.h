#pragma once
#include "fracture/tree_branch.h"
#include "fracture/tree_cut.h"

namespace windfall::fracture {

/// Sets the sides of all bodies but the branch's own, leaves and twigs that only touch it or each other: each
/// goes with the nearest body that is at least twice its size (of bounding boxes), and in the end with the
/// part of the branch that it hangs on. Where it hangs between the cuts, the middle of the break decides.
void assign_hangers(const TreeSurface& surface, const TreeBranch& branch, const BranchAxis& axis,
                    BranchCut& cut);

}  // namespace windfall::fracture
