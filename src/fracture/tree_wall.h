#pragma once
// The bark between a cut through a branch and the broken edge.
#include <vector>

#include "fracture/break_ends.h"
#include "fracture/tree_branch.h"
#include "fracture/tree_rays.h"
#include "fracture/tree_section.h"

namespace windfall::fracture {

/// A vertex of the new bark: a place of the old one, on one triangle or between two.
struct BarkVertex {
    geometry::Vec3 position;
    double angle, height;  ///< about the axis and along it
    std::vector<SurfacePlace> places;
};

/// Counter-clockwise from outside; a triangle ends in kNoVertex. `triangle` of the old bark is the one that
/// the middle of the face lies on.
struct BarkFace {
    geometry::Face corners;
    std::int32_t triangle;
};

/// A node of the broken edge: the vertices of the broken surface before and behind it in angle, which are one
/// where the edge is not torn.
struct EdgeNode {
    std::int32_t before, behind;
};

/// The nodes by sector, counter-clockwise from above.
std::vector<EdgeNode> edge_nodes(const BreakEnds& ends);

struct BranchBark {
    std::vector<BarkVertex> vertices;  ///< first those of the loop, in its order, then those of the edge
    std::vector<std::int32_t> edge;    ///< of the edge's vertices: their numbers in the broken surface
    std::vector<BarkFace> faces;
};

/// What a wall is made of.
struct WallPlan {
    const Section& loop;  ///< the cut
    double loop_height;
    bool is_piece;  ///< the wall hangs down from the loop instead of standing on it
    const std::vector<EdgeNode>& nodes;
    const std::vector<Vector3f>& surface;  ///< the unplaced broken surface, unit radius
    double unit, middle;                   ///< height along the axis is unit * (z - middle)
    std::size_t most_rows;
};

/// New bark whose vertices lie on the old one, in a column for each node of the edge; rows gather towards the
/// edge, where the bark is torn.
BranchBark make_bark(const WallPlan& plan, const BranchAxis& axis, const TreeRays& rays);

}  // namespace windfall::fracture
