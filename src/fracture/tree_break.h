#pragma once
// Breaks a branch of an artist's tree: finds it, cuts it, and puts both ends of a break where it was whole.
#include "core/run_context.h"
#include "fracture/parameters.h"
#include "fracture/tree_branch.h"
#include "meshfile/mesh.h"

namespace windfall::fracture {

/// Which part falls. Away from the root: the part that has not got the tree's lowest point; of a branch that
/// is a body of its own, the thinner end.
enum class FallingSide { AwayFromRoot, Smaller, Larger };

struct TreeBreakOptions {
    double unit_m = 1;                            ///< metres of a unit of the file
    geometry::Vec3 up = geometry::Vec3::UnitY();  ///< of the file
    FallingSide falls = FallingSide::AwayFromRoot;
};

/// The tree with the stub, and the fallen piece, both with the groups, materials and attributes of the mesh.
/// What lies outside the break comes first in both and is what it was: same order, same numbers. New faces
/// follow: those that were cut, bark between the cut and the broken edge, the broken surface.
struct TreeBreak {
    meshfile::Mesh tree, piece;
    geometry::Vec3 piece_shift;  ///< the gap, in units of the file
    TreeBranch branch;           ///< what was found at the point
};

/// Breaks the branch nearest to `at`. `parameters` are those of a free branch; its diameter, length, taper,
/// bend and outline are those of the tree's branch, lengths are in its radii, and angles count from its upper
/// side, counter-clockwise seen from the part that falls (of an upright branch: from the x or z axis).
/// Throws InputError when `at` lies off the tree, when the mesh is not closed there, when the branch forks or
/// ends within the length that the break needs: with the place, and how far to go.
TreeBreak break_tree(const meshfile::Mesh& mesh, const geometry::Vec3& at,
                     const FractureParameters& parameters, const TreeBreakOptions& options = {},
                     const RunContext& context = {});

}  // namespace windfall::fracture
