#pragma once
// One broken branch or cracked log, complete: what a frame shows, and what is known of it.
#include <vector>

#include "fracture/branch_mesh.h"
#include "fracture/break_ends.h"
#include "fracture/crack_set.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// The parameters with everything that follows from others worked out: what bending and the wood decide
/// stands where it would have been given by hand. Applying it twice changes nothing more.
FractureParameters resolved(const FractureParameters& parameters);

/// A closed branch in its place: normals computed, colours apart.
struct BrokenBranch {
    BreakEnds ends;  ///< stub and piece; of a log, and of a hidden piece, the piece is empty
    std::vector<Vector3f> stub_colours, piece_colours;  ///< linear RGB at the vertices
    CrackCount cracks;
};

/// Makes both ends with bark, cracks and fringe, unplaced: the straight cylinder about z, with gap 0.
/// `parameters` must be resolved and checked.
CrackCount make_unplaced(const FractureParameters& parameters, BreakEnds& ends, BreakWorkspace& workspace);

/// The whole model as it is seen, without colours: what a slider waits for. `parameters` must be resolved and
/// checked.
void make_branch(const FractureParameters& parameters, BreakEnds& ends, BreakWorkspace& workspace);

/// Throws InputError for what only the broken surface itself shows: one that is flat where a mean height is
/// asked for, or reaches beyond the branch. Takes as long as making the ends, some milliseconds.
void check_surface(const FractureParameters& parameters);

/// The whole model with colours. Checks and resolves the parameters itself; throws what `check` throws.
BrokenBranch broken_branch(const FractureParameters& parameters);

}  // namespace windfall::fracture
