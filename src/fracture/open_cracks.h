#pragma once
// Drying cracks in the wood of a broken branch.
#include "fracture/break_ends.h"
#include "fracture/crack_set.h"
#include "fracture/parameters.h"

namespace windfall::fracture {

/// Opens the recipe's cracks in both ends: the surface is slit along rays and rings of the lattice, up and
/// down the walls between fibre bundles, and the slits are drawn apart in plan, by the same amount in both
/// ends, so that these still fit without overlap. Walls go down into the stub and up into the piece. Rays and
/// rings wander a little, as in a log, though not at the rim, which stays as it is; all cracks, the big check
/// too, stay inside the wood. Meshes are closed and manifold as before (their border is the rim); vertices of
/// the slits follow the surface's, thorns come after them.
CrackCount open_cracks(BreakEnds& ends, const FractureParameters& parameters);

}  // namespace windfall::fracture
