#pragma once
// Thorns go with the wood around them when cracks open.
#include <Eigen/Core>
#include <vector>

#include "fracture/break_ends.h"
#include "fracture/crack_motion.h"

namespace windfall::fracture {

/// How the vertices of the broken surface have moved, in plan.
struct MovedSurface {
    const CrackedSection& section;
    const CrackMotion& motion;
    const CellCorners& cells;
    std::size_t faces;  ///< the first ones of a mesh; behind them are thorns
    const std::vector<Eigen::Vector2d>&
        before;  ///< of the surface's vertices and what stands before the thorns'
    const std::vector<Eigen::Vector2d>& after;
};

/// Moves the thorns of an end, whose vertices follow those in `surface.before`, so that they stay within
/// their holes in the other end: each vertex as the corners of the cell that it stands in, or, of a thorn
/// that stands across a crack, as the side of the crack on which its root is.
void carry_thorns(const MovedSurface& surface, BranchMesh& mesh);

}  // namespace windfall::fracture
