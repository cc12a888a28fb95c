#pragma once
// Parts a tree in two at a branch, and takes out what lies between two cross-sections.
#include <cstdint>
#include <vector>

#include "fracture/tree_branch.h"
#include "fracture/tree_break.h"
#include "fracture/tree_section.h"
#include "fracture/tree_surface.h"

namespace windfall::fracture {

/// Turns the branch's axis so that it points to the part that falls, which `options` decide. Throws
/// InputError when the tree holds together elsewhere, so that nothing would fall.
void point_to_falling_side(const TreeSurface& surface, SectionTracer& tracer, const TreeBreakOptions& options,
                           TreeBranch& branch);

enum class TreeSide : std::uint8_t { Tree, Between, Piece };

/// A tree cut at two cross-sections of a branch.
struct BranchCut {
    Section lower, upper;  ///< loops; their planes are those of the axis at these heights
    double low = 0, high = 0;
    std::vector<TreeSide> sides;                  ///< of each welded vertex
    std::vector<bool> crossed_low, crossed_high;  ///< whether a triangle is cut by the loop
};

/// Cuts near the heights `low` and `high`, up to a radius farther out: where the loop is star-shaped about
/// the axis and passes through no vertex. Other bodies go with what they hang on. Throws InputError where
/// there is no such place, and when something leaves the branch between the cuts.
BranchCut cut_branch(const TreeSurface& surface, SectionTracer& tracer, const TreeBranch& branch,
                     const BranchAxis& axis, double low, double high);

}  // namespace windfall::fracture
